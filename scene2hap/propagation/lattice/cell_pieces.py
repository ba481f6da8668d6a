"""Connected parts of the cells of a grid over an outline, and the nodes that they share.

Each cell is divided into pixels. A pixel counts by the share of it that lies within the outline. At the rim, this share
is split between the pixel and its neighbours so that its centroid does not move. Otherwise the rim would move outwards,
by an error of second order in the pixel size. Where a slot or a notch cuts a cell or the support of a node into parts,
each part has its own nodes, so that the gap transmits nothing.

Source: for the split, C. K. Birdsall, D. Fuss, Journal of Computational Physics 3 (1969) 494 (clouds in cells).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from scene2hap.common.arrays import Floats, Indices
from scene2hap.scene.surface.outline import Outline

PIXELS = 5
"""Pixels along each side of a cell: the rim is known to a fraction of a pixel. Tuned: with more pixels, frequencies at
the default resolution are no better, since the size of cells then determines the error."""
_WHOLE = 1 - 1e-12
"""Least share from which a pixel counts as wholly within, but for rounding."""


@dataclass(frozen=True, eq=False)
class CellPieces:
    """Connected parts of cells.

    cells : (nx, ny), numbers of cells of the grid; inside : (nx PIXELS, ny PIXELS) whether each pixel belongs to the
    plate; piece : index of the piece of each pixel inside; cell : (n_pieces, 2) cell of each piece; shares : (n_pieces,
    PIXELS, PIXELS) of each pixel of the piece's cell, above 1 beside the rim.
    """

    cells: tuple[int, int]
    inside: NDArray[np.bool_]
    piece: Indices
    cell: Indices
    shares: Floats

    @classmethod
    def of(cls, outline: Outline, lines: tuple[Floats, Floats]) -> CellPieces:
        """Make pieces from an outline and the lines between pixels [m]; only the largest part of a plate counts."""
        from scipy.ndimage import label

        cells = (len(lines[0]) - 1) // PIXELS, (len(lines[1]) - 1) // PIXELS
        coverage, off = outline.covered(*lines)
        inside = (coverage > 0.5) & ~outline.narrow_gaps(*lines)
        parts, n_parts = label(inside)
        if n_parts > 1:
            largest = np.argmax(np.bincount(parts[inside]))
            beside = _nearest(inside)
            coverage = np.where(parts[tuple(beside)] == largest, coverage, 0.0)
            inside = parts == largest
        # With a gap around each cell, a part never reaches into the next cell.
        apart = np.zeros((cells[0], PIXELS + 1, cells[1], PIXELS + 1), dtype=bool)
        apart[:, :PIXELS, :, :PIXELS] = inside.reshape(cells[0], PIXELS, cells[1], PIXELS)
        labels, n_pieces = label(apart.reshape(cells[0] * (PIXELS + 1), -1))
        piece = labels.reshape(apart.shape)[:, :PIXELS, :, :PIXELS].reshape(inside.shape).astype(np.intp) - 1
        row, column = np.nonzero(inside)
        own = piece[row, column]
        cell = np.empty((n_pieces, 2), dtype=np.intp)
        cell[own] = np.column_stack([row, column]) // PIXELS
        shares = np.zeros((n_pieces, PIXELS, PIXELS))
        is_rim = (coverage > 0.0) & ~(inside & (coverage > _WHOLE))
        shares[own, row % PIXELS, column % PIXELS] = ~is_rim[row, column]
        found = cls(cells, inside, piece, cell, shares)
        found._add_rim(np.stack(np.nonzero(is_rim)), coverage, off, [np.diff(each) for each in lines])
        return found

    def _add_rim(self, rim: Indices, coverage: Floats, off: Floats, sides_m: list[Floats]) -> None:
        """Add rim pixels (2, n), which lie partly within or in narrow gaps, to the shares.

        Parameters: coverage, off : share and centroid of pixels, see `Outline.covered`; sides_m : along x and y [m].
        """
        if not rim.size:
            return
        off = off[:, rim[0], rim[1]]
        # The pixel itself, its neighbours on the side of the centroid along x and along y, and the diagonal neighbour.
        is_beside = np.array([[0, 1, 0, 1], [0, 0, 1, 1]])[..., None]
        share = np.where(is_beside, np.abs(off)[:, None], 1 - np.abs(off)[:, None]).prod(axis=0).ravel()
        own = np.tile(rim, 4)
        there = (rim[:, None] + is_beside * np.sign(off)[:, None].astype(np.intp)).reshape(2, -1)
        there = there.clip(0, np.array(self.inside.shape)[:, None] - 1)
        there = np.where(self.inside[tuple(there)], there, own)
        # Pixels beside all pieces count with the nearest piece, at its nearest pixel if the piece is in another cell.
        is_in = self.inside[tuple(there)]
        near = there if is_in.all() else np.where(is_in, there, self.nearest_pixel[:, there[0], there[1]])
        piece = self.piece[tuple(near)]
        at = np.where((there // PIXELS == self.cell[piece].T).all(axis=0), there, near)
        area_m2, area_there_m2 = (sides_m[0][x] * sides_m[1][y] for x, y in (own, at))
        share *= coverage[tuple(own)] * area_m2 / area_there_m2
        slot = (piece * PIXELS + at[0] % PIXELS) * PIXELS + at[1] % PIXELS
        self.shares[:] += np.bincount(slot, share, self.shares.size).reshape(self.shares.shape)

    @property
    def steps(self) -> tuple[int, int]:
        """Steps in place from a node of the grid to the next along x and y. Places are counted along the shorter side
        first, which keeps the band of matrices narrow."""
        nx, ny = self.cells
        return (ny + 3, 1) if nx >= ny else (1, nx + 3)

    @cached_property
    def nearest_pixel(self) -> Indices:
        """Nearest pixel of the plate to each pixel (2, nx PIXELS, ny PIXELS)."""
        return _nearest(self.inside)

    @property
    def is_whole(self) -> NDArray[np.bool_]:
        """Whether each piece (n_pieces,) is a whole cell, but for rounding."""
        whole: NDArray[np.bool_] = np.abs(self.shares - 1.0).max(axis=(1, 2), initial=0.0) < 1e-14
        return whole

    @property
    def beside(self) -> tuple[Indices, Indices]:
        """Pairs of pieces (n, 2) that touch across the side of a cell, along x and along y."""
        found = []
        for piece, inside in ((self.piece, self.inside), (self.piece.T, self.inside.T)):
            low, high = slice(PIXELS - 1, -1, PIXELS), slice(PIXELS, None, PIXELS)
            both = inside[low] & inside[high]
            pairs = np.unique(piece[low][both] * len(self.cell) + piece[high][both])
            found.append(np.stack(np.divmod(pairs, len(self.cell)), axis=1))
        return found[0], found[1]

    def nearest(self, points_m: Floats, x_m: Floats, y_m: Floats) -> tuple[Indices, Floats]:
        """Piece of each point, given the lines between pixels, and the point's position; for a point beside the plate,
        the middle of the nearest pixel."""
        pixel = [
            np.clip(np.searchsorted(lines, points_m[:, axis], side="right") - 1, 0, len(lines) - 2)
            for axis, lines in enumerate((x_m, y_m))
        ]
        is_in = self.inside[pixel[0], pixel[1]]
        if is_in.all():
            return self.piece[pixel[0], pixel[1]], points_m
        near = self.nearest_pixel[:, pixel[0], pixel[1]]
        middle = np.stack(
            [(lines[1:] + lines[:-1])[at] / 2 for lines, at in zip((x_m, y_m), near, strict=True)], axis=1
        )
        return self.piece[near[0], near[1]], np.where(is_in[:, None], points_m, middle)


def nodes_of(pieces: CellPieces) -> tuple[Indices, Indices]:
    """Nodes (n_pieces, 16) of each piece, and the place (n_nodes,) of each node in the grid, rising.

    A node whose support of 4 by 4 cells is cut into parts has one copy in each part. Adjacent pieces share the nodes
    whose support includes both; nodes that are connected in this way are one node.
    """
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    grid = np.arange(16 * len(pieces.cell), dtype=np.int32).reshape(-1, 4, 4)
    along, across = pieces.beside
    shared = [
        (grid[along[:, 0], 1:], grid[along[:, 1], :-1]),
        (grid[across[:, 0], :, 1:], grid[across[:, 1], :, :-1]),
    ]
    a, b = (np.concatenate([pair[side].ravel() for pair in shared]) for side in (0, 1))
    same = coo_array((np.ones(len(a), dtype=np.int8), (a, b)), shape=(grid.size, grid.size))
    n_nodes, part = connected_components(same, directed=False)
    place = np.empty(n_nodes, dtype=np.intp)
    place[part] = ((pieces.cell @ pieces.steps)[:, None] + places(range(4), range(4), pieces.steps)).ravel()
    order = np.argsort(place, kind="stable")
    rank = np.empty(n_nodes, dtype=np.intp)
    rank[order] = np.arange(n_nodes)
    return rank[part].reshape(-1, 16), place[order]


def places(along: range, across: range, steps: tuple[int, int]) -> Indices:
    """Places of a block of the grid (n_along n_across,), counted along y first; see `CellPieces.steps`."""
    found: Indices = np.add.outer(steps[0] * np.array(along), steps[1] * np.array(across)).ravel()
    return found


def _nearest(inside: NDArray[np.bool_]) -> Indices:
    from scipy.ndimage import distance_transform_edt

    indices: Indices = distance_transform_edt(~inside, return_distances=False, return_indices=True).astype(np.intp)
    return indices
