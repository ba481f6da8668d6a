"""A lattice within an outline: each cell that the rim crosses counts by its part within.

The grid covers the outline's box. W, A and K are sums over the connected parts of its cells (`cell_pieces`), each
integrated pixel by pixel (`pixel_integrals`).

Source: for cut cells, J. Parvizian, A. Duester, E. Rank, Computational Mechanics 41 (2007) 121 (finite cell method),
here without its fictitious stiffness: nodes with next to nothing of the plate are left out, and all others are scaled
to equal masses.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from scene2hap.common.arrays import Floats, Indices
from scene2hap.propagation.lattice.assembly import Pattern, copies_of, sparse
from scene2hap.propagation.lattice.cell_pieces import CellPieces, nodes_of, places
from scene2hap.propagation.lattice.lattice import Lattice, rounding_k4
from scene2hap.propagation.lattice.pixel_integrals import PieceIntegrals, PixelProducts
from scene2hap.propagation.lattice.spline_axis import SplineAxis
from scene2hap.propagation.plate import Plate
from scene2hap.scene.surface.outline import Outline

if TYPE_CHECKING:
    from scipy.sparse import csr_array

_LEAST = 1e-9
"""Stiffness of a node, relative to the median of all, below which the node is left out."""


def outline_lattice(plate: Plate, outline: Outline, axes: tuple[SplineAxis, SplineAxis]) -> Lattice:
    """Return the lattice of a plate within its outline, over the lines of these axes."""
    x, y = axes
    pixels_x, pixels_y = (PixelProducts.of(axis) for axis in axes)
    pixels = pixels_x.lines, pixels_y.lines
    pieces = CellPieces.of(outline, pixels)
    integrals, nu = PieceIntegrals(pieces, pixels_x, pixels_y), plate.material.poisson_ratio
    mass = integrals.of((1.0, ("3", "3"), ("3", "3")))
    elastic = integrals.of(
        (1.0, ("bend", "bend"), ("3", "3")),
        (1.0, ("3", "3"), ("bend", "bend")),
        (nu, ("bend", "3"), ("3", "bend")),
        (nu, ("3", "bend"), ("bend", "3")),
        (2 * (1 - nu), ("slope", "slope"), ("slope", "slope")),
    )
    nodes = _Nodes.of(pieces, mass, elastic)
    masses, stiffness = nodes.summed(mass, elastic, places(range(4), range(4), pieces.steps))

    def springs() -> tuple[csr_array, csr_array]:
        found = _Springs.of(nodes, pieces, axes)
        return found.strains, found.weights(integrals, nu)

    def interpolation(points_m: Floats) -> csr_array:
        piece, at_m = pieces.nearest(points_m, *pixels)
        share_x, share_y = x.at(at_m[:, 0])[1], y.at(at_m[:, 1])[1]
        node = nodes.of_pieces[piece].ravel()
        shares = (share_x[:, :, None] * share_y[:, None, :]).ravel()
        return nodes.rows(node, shares, np.full(len(points_m), 16))

    cell_m = float(np.diff(x.lines).min()), float(np.diff(y.lines).min())
    rounding = rounding_k4(nodes.stiffness[nodes.scale > 0.0], plate.area_m2)
    return Lattice(plate, cell_m, masses, stiffness, rounding, interpolation, springs)


@dataclass(frozen=True, eq=False)
class _Nodes:
    """The nodes of all pieces.

    of_pieces : (n_pieces, 16) nodes of each piece; place : (n_nodes,) in the grid, rising; number : (n_nodes,) index
    among the kept nodes, in the same order, -1 of the others; scale : (n_nodes,) deflection per value of a kept node, 0
    of the others; stiffness : (n_nodes,) diagonal of K without these scales [m^-2].
    """

    of_pieces: Indices
    place: Indices
    number: Indices
    scale: Floats
    stiffness: Floats

    @classmethod
    def of(cls, pieces: CellPieces, mass: Floats, elastic: Floats) -> _Nodes:
        """Make the nodes of pieces, given the mass and stiffness matrices (n_pieces, 4, 4, 4, 4) of the pieces."""
        of_pieces, place = nodes_of(pieces)
        masses, alone = (
            np.bincount(of_pieces.ravel(), np.einsum("niikk->nik", each).ravel()).astype(np.float64)
            for each in (mass, elastic)
        )
        is_kept = alone > _LEAST * np.median(alone)
        number = np.where(is_kept, is_kept.cumsum() - 1, -1)
        scale = np.zeros(len(place))
        scale[is_kept] = np.sqrt(np.median(masses) / masses[is_kept])
        return cls(of_pieces, place, number, scale, alone)

    @property
    def n_kept(self) -> int:
        """Number of kept nodes."""
        return int(np.count_nonzero(self.scale))

    def summed(self, mass: Floats, elastic: Floats, local: Indices) -> tuple[csr_array, csr_array]:
        """Assemble A and K from the matrices of all pieces and the place of each node, relative to its piece (16,)."""
        row, column, sums = Pattern(self.of_pieces, local, self.place).summed([(mass, 0, 0)], [(elastic, 0, 0)])
        scale = self.scale[row] * self.scale[column]
        is_kept = scale > 0.0
        row, column = self.number[row[is_kept]], self.number[column[is_kept]]
        masses, stiffness = (sparse(row, column, (each * scale)[is_kept], (self.n_kept, self.n_kept)) for each in sums)
        return masses, stiffness

    def rows(self, node: Indices, values: Floats, counts: Indices) -> csr_array:
        """Rows over the kept nodes, each with `counts` of the `values` at these nodes; nodes left out are dropped."""
        row, is_kept = np.repeat(np.arange(len(counts)), counts), self.scale[node] > 0.0
        values = values[is_kept] * self.scale[node[is_kept]]
        return sparse(row[is_kept], self.number[node[is_kept]], values, (len(counts), self.n_kept))


@dataclass(frozen=True, eq=False)
class _Springs:
    """The springs of all pieces, which bend along x or y, or twist. Pieces share springs between the same nodes.

    strains : B (n_springs, n_nodes); bending, twisting : patterns of the sums of the weights of each piece's 8 and 8
    bending springs and 9 twisting springs.
    """

    strains: csr_array
    bending: Pattern
    twisting: Pattern

    @classmethod
    def of(cls, nodes: _Nodes, pieces: CellPieces, axes: tuple[SplineAxis, SplineAxis]) -> _Springs:
        """Make the springs between nodes, over the lines of these axes."""
        cell, n = pieces.cell, len(pieces.cell)
        grid = nodes.of_pieces.reshape(n, 4, 4)
        bend_x, bend_y = (axis.bend[cell[:, k, None] + np.arange(2)] for k, axis in enumerate(axes))
        slope_x, slope_y = (axis.slope[cell[:, k, None] + np.arange(3)] for k, axis in enumerate(axes))
        strains = [
            np.broadcast_to(bend_x[:, :, None], (n, 2, 4, 3)),
            np.broadcast_to(bend_y[:, None, :], (n, 4, 2, 3)),
            (slope_x[:, :, None, :, None] * slope_y[:, None, :, None, :]).reshape(n, 3, 3, 4),
        ]
        ends = [
            np.stack([grid[:, k : k + 2] for k in range(3)], axis=-1),
            np.stack([grid[:, :, k : k + 2] for k in range(3)], axis=-1),
            np.stack([grid[:, i : i + 3, j : j + 3] for i in (0, 1) for j in (0, 1)], axis=-1),
        ]
        copy = copies_of(nodes.place)
        n_copies, n_places = int(copy.max()) + 1, int(nodes.place[-1]) + 1
        node, strain, counts, number, local, place = [], [], [], [], [], []
        for end, part in zip(ends, strains, strict=True):
            each, parts = end.reshape(-1, end.shape[3]), part.reshape(-1, part.shape[3])
            # Two opposite ends identify a spring, since the part between them is connected.
            key = each[:, 0] * n_copies + copy[each[:, -1]]
            is_one = np.zeros(len(nodes.place) * n_copies, dtype=bool)
            is_one[key] = True
            spring = (is_one.cumsum() - 1)[key]
            one = np.empty(int(spring.max()) + 1, dtype=np.intp)
            one[spring] = np.arange(len(spring))
            node.append(each[one].ravel())
            strain.append(parts[one].ravel())
            counts.append(np.full(len(one), each.shape[1]))
            number.append(spring.reshape(n, -1))
            local.append(places(range(end.shape[1]), range(end.shape[2]), pieces.steps))
            place.append(nodes.place[each[one, 0]])
        # Both kinds of bending springs share one pattern, one after the other, each in its own grid.
        number[1] += len(place[0])
        local[1] += 2 * n_places
        place[1] += 2 * n_places
        return cls(
            nodes.rows(*(np.concatenate(several) for several in (node, strain, counts))),
            Pattern(*(np.concatenate(both[:2], axis=-1) for both in (number, local, place))),
            Pattern(number[2], local[2], place[2]),
        )

    def weights(self, integrals: PieceIntegrals, nu: float) -> csr_array:
        """Weights W of the springs (n_springs, n_springs)."""
        poisson = integrals.of((nu, ("1", "3"), ("3", "1")))
        bending = [
            (integrals.of((1.0, ("1", "1"), ("3", "3"))), 0, 0),
            (poisson, 0, 8),
            (poisson.transpose(0, 2, 1, 4, 3), 8, 0),
            (integrals.of((1.0, ("3", "3"), ("1", "1"))), 8, 8),
        ]
        (row, column, (value,)), (other_row, other_column, (other,)) = (
            self.bending.summed(bending),
            self.twisting.summed([(integrals.of((2 * (1 - nu), ("2", "2"), ("2", "2"))), 0, 0)]),
        )
        n_bending, n = len(self.bending), len(self.bending) + len(self.twisting)
        return sparse(
            np.append(row, other_row + n_bending),
            np.append(column, other_column + n_bending),
            np.append(value, other),
            (n, n),
        )
