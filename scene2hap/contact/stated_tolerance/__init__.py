"""Contacts within one stated tolerance, all pairs in one sweep of numpy."""
