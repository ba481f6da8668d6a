"""Lines of a lattice within an outline: closer where the outline has a notch.

At a corner that points into the plate, as of a slot, a sink or an L, curvature grows without bound. Cells must be small
there, and grow with the distance from the corner. Lines also run through such corners. A round hole concentrates
curvature near its rim, so cells there follow its radius.
"""

from __future__ import annotations

import itertools

import numpy as np

from scene2hap.common.arrays import Floats
from scene2hap.scene.surface.outline import Outline

FINER = 3.0
"""Usual cell size over that at a notch, per cell along the box's shorter side: 24 with 8 cells. Cells at notches thus
shrink as the square of the others, and frequencies converge with second order, which cells of one size do not give."""
FINEST = 48.0
"""Largest usual cell size over that at a notch; beyond it, the longest waves are lost in rounding of stiff springs."""
GROWTH = 0.85
"""Growth of the cell size per distance from a notch."""
PER_RADIUS = 2.4
"""Largest cell size along a curve that points into the plate, such as the rim of a round hole, over its radius, times
the number of cells along the box's shorter side: 0.3 of the radius with 8 cells."""


def outline_lines(outline: Outline, cells: tuple[int, int]) -> tuple[Floats, Floats]:
    """Return the lines of a lattice along both axes [m], with at least this many cells along the outline's box."""
    x0, y0, x1, y1 = outline.box_m
    (corners, radii_m), n = outline.inward, min(cells)
    finer, curves_m = min(FINER * n, FINEST), PER_RADIUS / n * radii_m
    return (
        _lines(x0, x1, cells[0], corners[:, 0], curves_m, finer),
        _lines(y0, y1, cells[1], corners[:, 1], curves_m, finer),
    )


def _lines(low: float, high: float, n: int, inward: Floats, curves_m: Floats, finer: float) -> Floats:
    """Lines from `low` to `high` and through the notches, unless these are closer than the smallest cell.

    inward : (n,) positions of corners that point into the plate [m]; curves_m : (n,) largest cell size on the curve
    there, 0 at a notch [m].
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
