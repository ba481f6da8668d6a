"""A lattice within an outline: cells that its rim crosses count by the part of them that lies within.

The grid covers the outline's box. Each cell is divided into pixels, and a pixel counts by the share of it that lies
within (`Outline.coverage`): so are W and A integrated over what is there of a cell. Where a slot or a notch cuts a cell
or the reach of a node into parts, each part has nodes of its own, so that nothing is passed on across the gap.

Source: for cells that are cut, J. Parvizian, A. Duester, E. Rank, Computational Mechanics 41 (2007) 121 (finite cell
method), here without their fictitious stiffness: nodes that have next to nothing of the plate are left out, and all
others scaled to equal masses.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from scene2hap.propagation.lattice.lattice import Lattice
from scene2hap.propagation.lattice.spline_axis import SplineAxis
from scene2hap.propagation.plate import Plate
from scene2hap.scene.outline import Outline

if TYPE_CHECKING:
    from scipy.sparse import csr_array

PIXELS = 8
"""Pixels along each side of a cell: a slot narrower than that is not seen."""
_LEAST = 1e-9
"""Share of a node's usual stiffness below which it is left out."""

Floats = NDArray[np.float64]
Ints = NDArray[np.intp]


def outline_lattice(plate: Plate, outline: Outline, axes: tuple[SplineAxis, SplineAxis]) -> Lattice:
    """The lattice of a plate within its outline, over these lines."""
    from scipy.sparse import csr_array

    x, y = axes
    pixels_x, pixels_y = (_Pixels.of(axis) for axis in axes)
    pieces = _Pieces.of(outline.coverage(pixels_x.lines, pixels_y.lines), (len(x.lines) - 1, len(y.lines) - 1))
    nodes, n_nodes = _nodes_of(pieces)
    integrals = _Integrals(pieces, pixels_x, pixels_y)
    masses = _summed(integrals.of((3, 3), (3, 3)), nodes, nodes, n_nodes, n_nodes)
    springs, weights = _springs(nodes.reshape(-1, 4, 4), pieces.cell, integrals, axes, plate.material.poisson_ratio)

    stiffness = springs.multiply(weights @ springs).sum(axis=0)  # of each node alone
    kept = np.flatnonzero(stiffness > _LEAST * np.median(stiffness))
    number = np.full(n_nodes, -1)
    number[kept] = np.arange(len(kept))
    scale = np.sqrt(np.median(masses.diagonal()) / masses.diagonal()[kept])
    kept_alone = csr_array((scale, (kept, number[kept])), shape=(n_nodes, len(kept)))

    def interpolation(points_m: Floats) -> csr_array:
        piece, at_m = pieces.nearest(points_m, pixels_x.lines, pixels_y.lines)
        share_x, share_y = x.at(at_m[:, 0])[1], y.at(at_m[:, 1])[1]
        node = number[nodes[piece].ravel()]
        here = node >= 0
        row, node = np.repeat(np.arange(len(points_m)), 16)[here], node[here]
        shares = (share_x[:, :, None] * share_y[:, None, :]).ravel()[here] * scale[node]
        return csr_array((shares, (row, node)), shape=(len(points_m), len(kept)))

    cell_m = float(np.diff(x.lines).min()), float(np.diff(y.lines).min())
    return Lattice(
        plate,
        cell_m,
        csr_array(springs @ kept_alone),
        weights,
        csr_array(kept_alone.T @ masses @ kept_alone),
        interpolation,
    )


@dataclass(frozen=True, eq=False)
class _Pieces:
    """Connected parts of cells.

    cells : (nx, ny) of the grid; inside : pixels (nx PIXELS, ny PIXELS) that belong to the plate; nearest_pixel : to
    each, of those (2, ...); number : the piece of that; cell : of each piece (n_pieces, 2); one : a pixel of each
    (n_pieces, 2); shares : of each pixel of its cell (n_pieces, PIXELS, PIXELS).
    """

    cells: tuple[int, int]
    inside: NDArray[np.bool_]
    number: Ints
    nearest_pixel: Ints
    cell: Ints
    one: Ints
    shares: Floats

    @classmethod
    def of(cls, coverage: Floats, cells: tuple[int, int]) -> _Pieces:
        """From the share of each pixel; of a plate in parts, the largest counts."""
        from scipy.ndimage import distance_transform_edt, label

        inside = coverage > 0.5
        parts, n_parts = label(inside)
        if n_parts > 1:
            largest = np.argmax(np.bincount(parts[inside]))
            beside = distance_transform_edt(~inside, return_distances=False, return_indices=True)
            coverage = np.where(parts[tuple(beside)] == largest, coverage, 0.0)
            inside = parts == largest
        # With a gap around each cell, a part never reaches into the next one.
        apart = np.zeros((cells[0], PIXELS + 1, cells[1], PIXELS + 1), dtype=bool)
        apart[:, :PIXELS, :, :PIXELS] = inside.reshape(cells[0], PIXELS, cells[1], PIXELS)
        labels, _ = label(apart.reshape(cells[0] * (PIXELS + 1), -1))
        number = labels.reshape(apart.shape)[:, :PIXELS, :, :PIXELS].reshape(inside.shape).astype(np.intp) - 1
        nearest = distance_transform_edt(~inside, return_distances=False, return_indices=True).astype(np.intp)
        number = number[nearest[0], nearest[1]]
        _, first = np.unique(np.where(inside, number, -1), return_index=True)
        at: Ints = first[-(int(number.max()) + 1) :].astype(np.intp)
        one = np.column_stack([at // inside.shape[1], at % inside.shape[1]])
        cell = one // PIXELS
        # What is on the rim counts with its piece; where that is in another cell, at the piece's nearest pixel.
        pixel = np.indices(inside.shape)
        is_own = (cell[number] == np.moveaxis(pixel, 0, -1) // PIXELS).all(axis=-1)
        row, column = np.where(is_own, pixel, nearest) % PIXELS
        shares = np.zeros((len(cell), PIXELS, PIXELS))
        np.add.at(shares, (number, row, column), coverage)
        return cls(cells, inside, number, nearest, cell, one, shares)

    @property
    def beside(self) -> tuple[Ints, Ints]:
        """Pairs of pieces (n, 2) that touch across the side of a cell, along x and along y."""
        found = []
        for number, inside in ((self.number, self.inside), (self.number.T, self.inside.T)):
            low, high = slice(PIXELS - 1, -1, PIXELS), slice(PIXELS, None, PIXELS)
            both = inside[low] & inside[high]
            pairs = np.unique(number[low][both] * len(self.cell) + number[high][both])
            found.append(np.stack(np.divmod(pairs, len(self.cell)), axis=1))
        return found[0], found[1]

    def nearest(self, points_m: Floats, x_m: Floats, y_m: Floats) -> tuple[Ints, Floats]:
        """The piece of each point, given the lines between pixels, and where it is; beside the plate, the middle of
        the nearest pixel."""
        pixel = [
            np.clip(np.searchsorted(lines, points_m[:, axis], side="right") - 1, 0, len(lines) - 2)
            for axis, lines in enumerate((x_m, y_m))
        ]
        near = self.nearest_pixel[:, pixel[0], pixel[1]]
        middle = np.stack(
            [(lines[1:] + lines[:-1])[at] / 2 for lines, at in zip((x_m, y_m), near, strict=True)], axis=1
        )
        is_in = self.inside[pixel[0], pixel[1]]
        return self.number[pixel[0], pixel[1]], np.where(is_in[:, None], points_m, middle)


def _nodes_of(pieces: _Pieces) -> tuple[Ints, int]:
    """The nodes (n_pieces, 16) of each piece, and how many there are: a node whose reach of 4 by 4 cells is cut into
    parts has one copy in each of them.

    Pieces side by side share the nodes that reach both; what so hangs together is one node.
    """
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    grid = np.arange(16 * len(pieces.cell)).reshape(-1, 4, 4)
    along, across = pieces.beside
    shared = [
        (grid[along[:, 0], 1:], grid[along[:, 1], :-1]),
        (grid[across[:, 0], :, 1:], grid[across[:, 1], :, :-1]),
    ]
    a, b = (np.concatenate([pair[side].ravel() for pair in shared]) for side in (0, 1))
    same = coo_array((np.ones(len(a), dtype=np.int8), (a, b)), shape=(grid.size, grid.size))
    n_nodes, part = connected_components(same, directed=False)
    # In the order of the grid.
    place = (pieces.cell[:, :1, None] + np.arange(4)[:, None]) * (pieces.cells[1] + 3)
    place = place + pieces.cell[:, 1:, None] + np.arange(4)
    first = np.empty(n_nodes, dtype=np.intp)
    first[part] = place.ravel()
    rank = np.empty(n_nodes, dtype=np.intp)
    rank[np.argsort(first, kind="stable")] = np.arange(n_nodes)
    return rank[part].reshape(-1, 16), int(n_nodes)


@dataclass(frozen=True, eq=False)
class _Pixels:
    """The pixels along one axis.

    lines : between them, which include the axis's own [m]; weights : of four places of Gauss in each (n_pixels, 4)
    [m]; splines : at those places, of degrees 1 to 3, the values of those that a cell has (n_pixels, 4, degree + 1).
    """

    lines: Floats
    weights: Floats
    splines: dict[int, Floats]

    @classmethod
    def of(cls, axis: SplineAxis) -> _Pixels:
        """`PIXELS` in each cell."""
        step = np.diff(axis.lines)[:, None] / PIXELS
        lines = np.append(axis.lines[:-1, None] + step * np.arange(PIXELS), axis.lines[-1])
        places, weights = np.polynomial.legendre.leggauss(4)
        h = np.diff(lines)[:, None]
        x = (lines[:-1, None] + h * (places + 1) / 2).ravel()
        splines = {degree: axis.splines(x, degree).data.reshape(len(h), 4, degree + 1) for degree in (1, 2, 3)}
        return cls(lines, h * weights / 2, splines)

    def products(self, degree: int, other_degree: int) -> Floats:
        """Integrals over each pixel of products of the splines of two degrees that its cell has (n_cells, PIXELS,
        degree + 1, other_degree + 1) [m]."""
        a, b = self.splines[degree], self.splines[other_degree]
        each: Floats = (self.weights[..., None] * a).transpose(0, 2, 1) @ b
        return each.reshape(-1, PIXELS, degree + 1, other_degree + 1)


@dataclass(frozen=True, eq=False)
class _Integrals:
    """Integrals over pieces of cells."""

    pieces: _Pieces
    x: _Pixels
    y: _Pixels

    def of(self, along: tuple[int, int], across: tuple[int, int]) -> Floats:
        """Products of one spline along x times one along y, and another such two, of these degrees: (n_pieces, a, b)
        [m^2], each counted along y first."""
        (i, j), (k, m) = ((d + 1 for d in degrees) for degrees in (along, across))
        n, cell = len(self.pieces.cell), self.pieces.cell
        x = self.x.products(*along).reshape(-1, PIXELS, i * j)[cell[:, 0]]
        y = self.y.products(*across).reshape(-1, PIXELS, k * m)[cell[:, 1]]
        both = x.transpose(0, 2, 1) @ (self.pieces.shares @ y)
        return both.reshape(n, i, j, k, m).transpose(0, 1, 3, 2, 4).reshape(n, i * k, j * m)


def _springs(
    grid: Ints, cell: Ints, integrals: _Integrals, axes: tuple[SplineAxis, SplineAxis], nu: float
) -> tuple[csr_array, csr_array]:
    """B and W from the nodes (n_pieces, 4, 4) of each piece and its cell."""
    from scipy.sparse import block_diag, csr_array, hstack, vstack

    n, n_nodes = len(grid), int(grid.max()) + 1
    bend_x, bend_y = (axis.bend.data.reshape(-1, 3)[cell[:, k, None] + np.arange(2)] for k, axis in enumerate(axes))
    slope_x, slope_y = (axis.slope.data.reshape(-1, 2)[cell[:, k, None] + np.arange(3)] for k, axis in enumerate(axes))
    strains = [
        np.broadcast_to(bend_x[:, :, None], (n, 2, 4, 3)),
        np.broadcast_to(bend_y[:, None, :], (n, 4, 2, 3)),
        slope_x[:, :, None, :, None] * slope_y[:, None, :, None, :],
    ]
    ends = [
        np.stack([grid[:, k : k + 2] for k in range(3)], axis=-1),
        np.stack([grid[:, :, k : k + 2] for k in range(3)], axis=-1),
        np.stack([grid[:, i : i + 3, j : j + 3] for i in (0, 1) for j in (0, 1)], axis=-1),
    ]
    (bx, x), (by, y), (bt, t) = (_joined(end, strain, n_nodes) for end, strain in zip(ends, strains, strict=True))
    poisson = _summed(nu * integrals.of((1, 3), (3, 1)), x, y, bx.shape[0], by.shape[0])
    bend_xx = _summed(integrals.of((1, 1), (3, 3)), x, x, bx.shape[0], bx.shape[0])
    bend_yy = _summed(integrals.of((3, 3), (1, 1)), y, y, by.shape[0], by.shape[0])
    twist = _summed(2 * (1 - nu) * integrals.of((2, 2), (2, 2)), t, t, bt.shape[0], bt.shape[0])
    bend = vstack([hstack([bend_xx, poisson]), hstack([poisson.T, bend_yy])])
    return csr_array(vstack([bx, by, bt])), csr_array(block_diag([bend, twist]))


def _joined(ends: Ints, strains: Floats, n_nodes: int) -> tuple[csr_array, Ints]:
    """Springs between nodes: the `ends` of those of each piece (n_pieces, k, m, n_ends, ...), and each end's part in
    the strain. Returns: B, (n_springs, n_nodes), and which spring each is (n_pieces, k m): pieces share those between
    the same nodes."""
    from scipy.sparse import csr_array

    n = len(ends)
    each, parts = ends.reshape(n * ends.shape[1] * ends.shape[2], -1), strains.reshape(-1, ends.shape[3])
    # Two opposite ends tell a spring: what lies between them is connected.
    _, first, spring = np.unique(each[:, 0] * n_nodes + each[:, -1], return_index=True, return_inverse=True)
    row = np.repeat(np.arange(len(first)), each.shape[1])
    b = csr_array((parts[first].ravel(), (row, each[first].ravel())), shape=(len(first), n_nodes))
    return b, spring.reshape(n, -1)


def _summed(values: Floats, rows: Ints, columns: Ints, n_rows: int, n_columns: int) -> csr_array:
    """Values (n, a, b) of each piece, at its rows (n, a) and columns (n, b)."""
    from scipy.sparse import coo_array

    row = np.broadcast_to(rows[:, :, None], values.shape)
    column = np.broadcast_to(columns[:, None, :], values.shape)
    return coo_array((values.ravel(), (row.ravel(), column.ravel())), shape=(n_rows, n_columns)).tocsr()
