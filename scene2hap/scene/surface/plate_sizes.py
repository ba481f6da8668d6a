"""Bounds of a stated plate size, relative to the measured one.

A language model may correct sizes that a mesh lacks: the thickness of a floor of two triangles, or of a table modelled
as a solid block. Length and width of the mesh are more reliable than a model's estimate.
"""

from __future__ import annotations

from collections.abc import Sequence

THINNEST_M = 2e-5
"""Thickness of a foil [m]; a stated thickness must not be less."""

NOTHING = 1e-7
"""A thickness below this share of the shorter edge counts as none."""

# All assumed. An L-shaped top and the box around it differ by less than a factor of 3. The thickest walls and slabs are
# half a metre. A shape thicker than a third of its width is no plate, unless it was measured so.
FACTOR = 3.0
_THICKEST_M = 0.5
_THICK_SHARE = 1 / 3
_ASSUMED_M, _ASSUMED_SHARE = 0.02, 0.1

Size = tuple[float, float, float]


def faults(stated_m: Sequence[float], measured_m: Sequence[float]) -> dict[str, str]:
    """Return the errors of a stated length, width and thickness [m], by field: the value and the violated bounds.

    Length and width may be exchanged. An edge that was measured as 0 has only the upper bound of the other edge.
    """
    wrong: dict[str, str] = {}
    shorter, longer = sorted(measured_m[:2])
    is_turned = stated_m[0] < stated_m[1]
    for name, stated, is_longer in (("length", stated_m[0], not is_turned), ("width", stated_m[1], is_turned)):
        measured = longer if is_longer else shorter
        low, high = max(measured / FACTOR, THINNEST_M), (measured or longer) * FACTOR
        if stated != measured and not low <= stated <= max(low, high):
            wrong[name] = f"{stated:.3g} m, but it was measured as {measured:.3g} m; give {low:.3g} to {high:.3g} m"
    high = thickest_m(measured_m)
    if not THINNEST_M <= stated_m[2] <= high:
        wrong["thickness"] = (
            f"{stated_m[2]:.3g} m, but it was measured as {measured_m[2]:.3g} m; give {THINNEST_M:g} to {high:.3g} m"
        )
    return wrong


def thickest_m(measured_m: Sequence[float]) -> float:
    """Return the largest thickness that may be stated for a measured surface [m]."""
    return max(FACTOR * measured_m[2], min(_THICKEST_M, _THICK_SHARE * min(measured_m[:2])), THINNEST_M)


def assumed_thickness_m(measured_m: Sequence[float]) -> float:
    """Return the assumed thickness of a sheet of unknown thickness [m]."""
    return max(min(_ASSUMED_M, _ASSUMED_SHARE * min(measured_m[:2])), THINNEST_M)


def with_thickness(measured_m: Sequence[float]) -> Size:
    """Return a measured size, with an assumed thickness if the mesh has none."""
    length, width, thickness = measured_m
    return length, width, thickness if thickness >= THINNEST_M else assumed_thickness_m(measured_m)
