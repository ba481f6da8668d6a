"""A plate as a lattice of masses and bending springs, of a rectangle or within an outline, and its motion in time."""
