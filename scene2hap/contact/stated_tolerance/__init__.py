"""Contacts within one stated tolerance, all pairs at once in numpy."""
