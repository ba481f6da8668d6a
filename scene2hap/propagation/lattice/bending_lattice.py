"""Choice of the lattice of a plate: number of cells, positions of their lines, rectangle or outline.

Plates of one shape share a lattice, that of a plate of unit size, whatever their size, thickness or material.
"""

from __future__ import annotations

import math
from dataclasses import replace
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from scene2hap.errors import ModelDomainError
from scene2hap.materials import Material
from scene2hap.propagation.lattice.lattice import Lattice
from scene2hap.propagation.lattice.outline_lattice import outline_lattice
from scene2hap.propagation.lattice.outline_lines import outline_lines
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
        return outline_lines(aligned(plate.outline)[0], (along, across))
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
