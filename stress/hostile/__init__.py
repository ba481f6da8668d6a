"""Damaged files and messages of every kind that the library reads; `hostile_files.py` runs them."""
