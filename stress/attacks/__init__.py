"""Families of hostile input for `stress/attack.py`: each module yields `Attack`s from a seed."""
