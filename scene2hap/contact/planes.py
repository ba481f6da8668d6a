"""Planes that bound where a body may be: walls, roofs and floors."""

from __future__ import annotations

Plane = tuple[float, float, float, float, bool]
"""(n_u, n_v, n_h, most_m, is_square): a body reaches no farther than that along the direction; where that is level,
with the rectangle of its footprint, or with whichever of rectangle and circle is narrower."""


def wall_at(n_u: float, n_v: float, most_m: float, *, is_square: bool = False) -> Plane:
    """An upright plane, the body being where n u <= most_m."""
    return (n_u, n_v, 0.0, most_m, is_square)


def roof_at(height_m: float) -> Plane:
    """A level plane above the body."""
    return (0.0, 0.0, 1.0, height_m, False)


def floor_at(height_m: float) -> Plane:
    """A level plane below the body."""
    return (0.0, 0.0, -1.0, -height_m, False)
