"""Connected parts of the cells of a grid over an outline, and the nodes that they share.

Each cell is divided into pixels, and a pixel counts by the share of it that lies within. At the rim that share is split
between the pixel and its neighbours so that its centroid stays where it is. Without this the rim would move outwards,
by an error of the second order in the pixel. Where a slot or a notch cuts a cell or the reach of a node into parts,
each part has its own nodes, so that the gap transmits nothing.

Source: for the split, C. K. Birdsall, D. Fuss, Journal of Computational Physics 3 (1969) 494 (clouds in cells).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from scene2hap.scene.surface.outline import Outline

PIXELS = 5
"""Pixels along each side of a cell: the rim is known to a fraction of one of them. Tuned: with more, frequencies at the
default resolution are no better, since cells then decide their error."""
_WHOLE = 1 - 1e-12
"""Share from which a pixel lies within as a whole, but for rounding."""

Floats = NDArray[np.float64]
Ints = NDArray[np.intp]


@dataclass(frozen=True, eq=False)
class CellPieces:
    """Connected parts of cells.

    cells : (nx, ny) of the grid; inside : pixels (nx PIXELS, ny PIXELS) that belong to the plate; piece : of each of
    these pixels; cell : of each piece (n_pieces, 2); shares : of each pixel of its cell, above 1 beside the rim
    (n_pieces, PIXELS, PIXELS).
    """

    cells: tuple[int, int]
    inside: NDArray[np.bool_]
    piece: Ints
    cell: Ints
    shares: Floats

    @classmethod
    def of(cls, outline: Outline, lines: tuple[Floats, Floats]) -> CellPieces:
        """From an outline and the lines between pixels [m]; of a plate in parts, the largest counts."""
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
        # With a gap around each cell, a part never reaches into the next one.
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

    def _add_rim(self, rim: Ints, coverage: Floats, off: Floats, sides_m: list[Floats]) -> None:
        """Count pixels (2, n) that lie within in part, or in narrow gaps, given the shares of all pixels, where their
        centroids are (`Outline.covered`), and their sides along x and y [m]."""
        if not rim.size:
            return
        off = off[:, rim[0], rim[1]]
        # The pixel itself, its neighbours to that side along x and along y, and the one between these two.
        is_beside = np.array([[0, 1, 0, 1], [0, 0, 1, 1]])[..., None]
        share = np.where(is_beside, np.abs(off)[:, None], 1 - np.abs(off)[:, None]).prod(axis=0).ravel()
        own = np.tile(rim, 4)
        there = (rim[:, None] + is_beside * np.sign(off)[:, None].astype(np.intp)).reshape(2, -1)
        there = there.clip(0, np.array(self.inside.shape)[:, None] - 1)
        there = np.where(self.inside[tuple(there)], there, own)
        # Pixels beside all pieces count with the nearest one; where that is in another cell, at its nearest pixel.
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
        """Places from a node of the grid to the next along x and y: they run fastest across the longer side, which
        keeps matrices in a narrow band."""
        nx, ny = self.cells
        return (ny + 3, 1) if nx >= ny else (1, nx + 3)

    @cached_property
    def nearest_pixel(self) -> Ints:
        """To each pixel, the nearest of those that belong to the plate (2, nx PIXELS, ny PIXELS)."""
        return _nearest(self.inside)

    @property
    def is_whole(self) -> NDArray[np.bool_]:
        """The pieces (n_pieces,) that are whole cells, but for rounding."""
        whole: NDArray[np.bool_] = np.abs(self.shares - 1.0).max(axis=(1, 2), initial=0.0) < 1e-14
        return whole

    @property
    def beside(self) -> tuple[Ints, Ints]:
        """Pairs of pieces (n, 2) that touch across the side of a cell, along x and along y."""
        found = []
        for piece, inside in ((self.piece, self.inside), (self.piece.T, self.inside.T)):
            low, high = slice(PIXELS - 1, -1, PIXELS), slice(PIXELS, None, PIXELS)
            both = inside[low] & inside[high]
            pairs = np.unique(piece[low][both] * len(self.cell) + piece[high][both])
            found.append(np.stack(np.divmod(pairs, len(self.cell)), axis=1))
        return found[0], found[1]

    def nearest(self, points_m: Floats, x_m: Floats, y_m: Floats) -> tuple[Ints, Floats]:
        """The piece of each point, given the lines between pixels, and where it is; beside the plate, the middle of
        the nearest pixel."""
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


def nodes_of(pieces: CellPieces) -> tuple[Ints, Ints]:
    """The nodes (n_pieces, 16) of each piece, and the place (n_nodes,) in the grid of each node, rising: a node whose
    reach of 4 by 4 cells is cut into parts has one copy in each of them.

    Pieces side by side share the nodes that reach both; what so hangs together is one node.
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


def places(along: range, across: range, steps: tuple[int, int]) -> Ints:
    """The places in the grid of a block of it, counted along y first (n_along n_across,); see `CellPieces.steps`."""
    found: Ints = np.add.outer(steps[0] * np.array(along), steps[1] * np.array(across)).ravel()
    return found


def _nearest(inside: NDArray[np.bool_]) -> Ints:
    from scipy.ndimage import distance_transform_edt

    indices: Ints = distance_transform_edt(~inside, return_distances=False, return_indices=True).astype(np.intp)
    return indices
