"""Choice of the lattice of a plate: number of cells, positions of their lines, rectangle or outline."""

from __future__ import annotations

import math
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from scene2hap.errors import ModelDomainError
from scene2hap.propagation.lattice.lattice import Lattice
from scene2hap.propagation.lattice.outline_lattice import outline_lattice
from scene2hap.propagation.lattice.outline_lines import outline_lines
from scene2hap.propagation.lattice.rectangle_lattice import rectangle_lattice
from scene2hap.propagation.lattice.spline_axis import SplineAxis
from scene2hap.propagation.plate import Plate

LONGEST = 16
"""Cells along the longer side, in resolutions: on plates more slender than that they are longer than wide."""
MOST_NODES = 100_000
"""Nodes beyond which a lattice is refused: its factors then fill about a gigabyte."""


def cells_of(plate: Plate, resolution: int) -> tuple[int, int]:
    """Cells along length and width: `resolution` along the shorter side and, up to `LONGEST`, square ones."""
    shorter = min(plate.extent_m)
    along, across = (
        min(math.ceil(side / shorter * resolution * (1 - 1e-9)), LONGEST * resolution) for side in plate.extent_m
    )
    return along, across


@lru_cache(maxsize=16)
def lines_of(plate: Plate, resolution: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Positions of the lines of a plate's lattice, along length and width [m]."""
    along, across = cells_of(plate, resolution)
    if plate.outline is not None:
        return outline_lines(plate.outline, (along, across))
    return np.linspace(0.0, plate.length_m, along + 1), np.linspace(0.0, plate.width_m, across + 1)


def n_nodes_of(plate: Plate, resolution: int) -> int:
    """Number of nodes of its lattice, those held by edges included."""
    if plate.outline is not None:
        return math.prod(len(lines) + 2 for lines in lines_of(plate, resolution))
    return math.prod(n + 3 for n in cells_of(plate, resolution))


@lru_cache(maxsize=16)
def bending_lattice(plate: Plate, resolution: int) -> Lattice:
    """The lattice of a plate, see `cells_of`.

    Raises: ModelDomainError: it has more than `MOST_NODES` nodes.
    """
    if (n_nodes := n_nodes_of(plate, resolution)) > MOST_NODES:
        raise ModelDomainError(
            f"a lattice of {' × '.join(map(str, cells_of(plate, resolution)))} cells has {n_nodes} nodes; at most "
            f"{MOST_NODES} are allowed. Ask for a resolution below {resolution}, or use ModalPlate."
        )
    x, y = lines_of(plate, resolution)
    axes = SplineAxis.of(x), SplineAxis.of(y)
    return rectangle_lattice(plate, axes) if plate.outline is None else outline_lattice(plate, plate.outline, axes)
