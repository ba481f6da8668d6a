"""Readers of scene files: one module or sub-package for each format, with its parts beside it."""
