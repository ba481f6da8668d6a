"""Geometry of triangles, boxes and polygons as arrays, without bodies or tolerances."""
