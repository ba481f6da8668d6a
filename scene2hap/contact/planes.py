"""Planes that bound the region of a body: vertical walls, level roofs and floors."""

from __future__ import annotations

Plane = tuple[float, float, float, float, bool]
"""(n_u, n_v, n_h, most_m, is_square): every point p of the body must satisfy n p <= most_m [m].

For a level direction, the body is its footprint: the rectangle if `is_square`, else the narrower of rectangle and
circle along n.
"""


def wall_at(n_u: float, n_v: float, most_m: float, *, is_square: bool = False) -> Plane:
    """Return a vertical plane that keeps the body where n_u u + n_v v <= most_m."""
    return (n_u, n_v, 0.0, most_m, is_square)


def roof_at(height_m: float) -> Plane:
    """Return a level plane above the body."""
    return (0.0, 0.0, 1.0, height_m, False)


def floor_at(height_m: float) -> Plane:
    """Return a level plane below the body."""
    return (0.0, 0.0, -1.0, -height_m, False)
