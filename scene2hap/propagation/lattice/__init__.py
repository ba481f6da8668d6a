"""Plates as lattices of masses and bending springs, rectangular or within an outline, and their motion in time."""
