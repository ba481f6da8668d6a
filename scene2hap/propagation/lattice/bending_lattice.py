"""Choice of the lattice of a plate: number of cells, positions of their lines, rectangle or outline.

Plates of one shape share a lattice, that of a plate of unit size, whatever their size, thickness or material.

Within an outline, lines are closer where it has a notch. At a corner that points into the plate, as of a slot, a sink
or an L, curvature grows without bound. Cells must be small there, and grow with the distance from the corner. Lines
also run through such corners. A round hole concentrates curvature near its rim, so cells there follow its radius.
"""

from __future__ import annotations

import itertools
import math
from dataclasses import replace
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from scene2hap.common.arrays import Floats
from scene2hap.errors import ModelDomainError
from scene2hap.materials import Material
from scene2hap.propagation.lattice.lattice import Lattice
from scene2hap.propagation.lattice.outline_lattice import outline_lattice
from scene2hap.propagation.lattice.rectangle_lattice import rectangle_lattice
from scene2hap.propagation.lattice.spline_axis import SplineAxis
from scene2hap.propagation.plate import Plate
from scene2hap.scene.surface.outline import Outline, Ring

LONGEST = 16
"""Most cells along the longer side, in multiples of the resolution; more slender plates have cells longer than wide."""
_SLACK = 0.01
"""Fraction by which cells of outlines may be larger, so that a polygon for a circle has as many cells as the circle."""
_STRAIGHT_RAD = 1e-3
"""Slant of an outline up to which its notches count as along the grid [rad]: a millimetre on a metre."""
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
MOST_NODES = 100_000
"""Most nodes of a lattice: its factors then fill about a gigabyte."""


@lru_cache(maxsize=64)
def of_size_one(plate: Plate) -> tuple[Plate, float]:
    """Return a plate of the same shape, of 1 m and of a material with the same Poisson's ratio, and the size of the
    given plate [m]. Corners are rounded to a thousand millionth, so that rounding makes no other shape."""
    size_m = max(plate.extent_m)
    outline = plate.outline
    if outline is not None:
        outline = outline_of(
            tuple(tuple((round(x / size_m, 9), round(y / size_m, 9)) for x, y in ring) for ring in outline.rings_m)
        )
    material = Material("any", 1e3, 1e9, plate.material.poisson_ratio, 0.0)
    length_m, width_m = plate.length_m / size_m, plate.width_m / size_m
    return Plate(length_m, width_m, 1e-3, material, plate.boundary, outline=outline), size_m


@lru_cache(maxsize=32)
def outline_of(rings_m: tuple[Ring, ...]) -> Outline:
    """Outline shared by all plates of a shape, so that it is checked and measured once."""
    return Outline(rings_m)


@lru_cache(maxsize=64)
def aligned(outline: Outline) -> tuple[Outline, NDArray[np.float64], NDArray[np.float64]]:
    """Outline turned so that the sides of its notches run along the grid's lines, with the matrix and shift of
    `Outline.turned`. Fine lines around the ends of a slanted slot would cross at four places, not two."""
    slant = outline.slant_rad
    if abs(slant) < _STRAIGHT_RAD:
        return outline, np.eye(2), np.zeros(2)
    return outline.turned(-slant)


def narrow_side_m(plate: Plate) -> float:
    """Side [m] that `resolution` counts: the shorter one, or the least width of an outline, turned or not."""
    return min(plate.extent_m) if plate.outline is None else min(plate.outline.width_m, *plate.extent_m)


def cells_of(plate: Plate, resolution: int) -> tuple[int, int]:
    """Numbers of cells along length and width: `resolution` along the narrow side, and square cells up to `LONGEST`."""
    narrow, slack = narrow_side_m(plate), 1e-9 if plate.outline is None else _SLACK
    extent_m = plate.extent_m if plate.outline is None else aligned(plate.outline)[0].extent_m
    along, across = (
        min(math.ceil(side / narrow * resolution * (1 - slack)), LONGEST * resolution) for side in extent_m
    )
    return along, across


@lru_cache(maxsize=16)
def lines_of(plate: Plate, resolution: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Positions of the lines of a plate's lattice, along length and width [m]."""
    along, across = cells_of(plate, resolution)
    if plate.outline is not None:
        return _outline_lines(aligned(plate.outline)[0], (along, across))
    return np.linspace(0.0, plate.length_m, along + 1), np.linspace(0.0, plate.width_m, across + 1)


def n_nodes_of(plate: Plate, resolution: int) -> int:
    """Number of nodes of a plate's lattice, those held by edges included."""
    if plate.outline is not None:
        return math.prod(len(lines) + 2 for lines in lines_of(of_size_one(plate)[0], resolution))
    return math.prod(n + 3 for n in cells_of(plate, resolution))


@lru_cache(maxsize=16)
def bending_lattice(plate: Plate, resolution: int) -> Lattice:
    """Return the lattice of a plate, see `cells_of`.

    Raises: ModelDomainError: it would have more than `MOST_NODES` nodes.
    """
    if (n_nodes := n_nodes_of(plate, resolution)) > MOST_NODES:
        raise ModelDomainError(
            f"a lattice of {' × '.join(map(str, cells_of(plate, resolution)))} cells has {n_nodes} nodes; at most "
            f"{MOST_NODES} are allowed. Ask for a resolution below {resolution}, or use ModalPlate."
        )
    x, y = lines_of(plate, resolution)
    axes = SplineAxis.of(x), SplineAxis.of(y)
    if plate.outline is None:
        return rectangle_lattice(plate, axes)
    outline, turn, shift = aligned(plate.outline)
    lattice = outline_lattice(plate, outline, axes)
    if outline is plate.outline:
        return lattice
    return replace(lattice, interpolation=lambda points_m: lattice.interpolation(points_m @ turn.T + shift))


def _outline_lines(outline: Outline, cells: tuple[int, int]) -> tuple[Floats, Floats]:
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
