"""Lines of a lattice within an outline: closer where the outline has a notch.

At a corner that points into the plate, as of a slot, a sink or an L, curvature grows without bound, and cells are to be
small there; away from it they grow with the distance. Lines also run through such corners. A round hole squeezes
curvature into its neighbourhood, so cells there follow its radius.
"""

from __future__ import annotations

import itertools

import numpy as np
from numpy.typing import NDArray

from scene2hap.scene.surface.outline import Outline

FINER = 3.0
"""How much smaller than others cells at a notch are, per cell along the box's shorter side: 24 times with 8. So they
shrink as the square of the others, and frequencies converge by the second order, which they would not in cells of one
size."""
FINEST = 48.0
"""And at most; the stiffest springs would bury the longest waves in rounding."""
GROWTH = 0.85
"""How much larger a cell is, per its distance from a notch."""
PER_RADIUS = 2.4
"""Cells along a curve that points into the plate, such as the rim of a round hole, are at most so much of its radius
over the cells along the box's shorter side: 0.3 with 8."""

Floats = NDArray[np.float64]


def outline_lines(outline: Outline, cells: tuple[int, int]) -> tuple[Floats, Floats]:
    """The lines of a lattice of at least this many cells along the outline's box, across both axes [m]."""
    x0, y0, x1, y1 = outline.box_m
    (corners, radii_m), n = outline.inward, min(cells)
    finer, curves_m = min(FINER * n, FINEST), PER_RADIUS / n * radii_m
    return (
        _lines(x0, x1, cells[0], corners[:, 0], curves_m, finer),
        _lines(y0, y1, cells[1], corners[:, 1], curves_m, finer),
    )


def _lines(low: float, high: float, n: int, inward: Floats, curves_m: Floats, finer: float) -> Floats:
    """Lines from `low` to `high` and through the notches, as far as these are not closer than the smallest cell.

    inward : where corners point into the plate (n,) [m]; curves_m : largest cells on the curve there, 0 at a notch (n,)
    [m].
    """
    usual = (high - low) / n
    least = usual / finer
    fixed = [low]
    for place in np.sort(inward[curves_m == 0.0]):
        if place > fixed[-1] + least and place < high - least:
            fixed.append(float(place))
    fixed.append(high)
    x = np.linspace(low, high, 64 * n + 1)
    widest = np.maximum(least, curves_m) + GROWTH * np.abs(x[:, None] - inward)
    cell_m = np.minimum(widest.min(axis=1, initial=np.inf), usual)
    cells_before = np.concatenate([[0.0], np.cumsum(np.diff(x) / cell_m[:-1])])
    lines = []
    for a, b in itertools.pairwise(fixed):
        first, last = np.interp([a, b], x, cells_before)
        count = max(round(last - first), 1)
        between = np.interp(np.linspace(first, last, count + 1), cells_before, x)
        lines.append([a, *between[1:-1]])
    return np.array([*(place for some in lines for place in some), high])
