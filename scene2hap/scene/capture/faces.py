"""The planes of triangles, and which of them can hide a point."""

from __future__ import annotations

import numpy as np

from scene2hap.common.arrays import Bools, Floats, Floats32


def planes(triangles_m: Floats32) -> Floats:
    """Return planes (m, 4) of triangles (m, 3, 3): unit normal and offset, x . normal = offset. Zero for triangles of
    no area."""
    a, b, c = np.moveaxis(triangles_m.astype(np.float64), 1, 0)
    normals = np.cross(b - a, c - a)
    lengths = np.linalg.norm(normals, axis=1, keepdims=True)
    np.divide(normals, lengths, out=normals, where=lengths > 0)
    return np.column_stack((normals, np.einsum("ij,ij->i", normals, a)))


def separates(planes_m: Floats, eye_m: Floats, focus_m: Floats) -> Bools:
    """Return a mask of the planes (m, 4) that separate eye and focus. Only a face on such a plane can hide the
    focus."""
    of_eye = planes_m[:, :3] @ eye_m - planes_m[:, 3]
    of_focus = planes_m[:, :3] @ focus_m - planes_m[:, 3]
    is_between: Bools = of_eye * of_focus < 0
    return is_between
