"""A scene from above: the topmost object at each place of a grid, and its height there."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from scene2hap.scene.snapshot import SceneSnapshot

Floats = NDArray[np.float64]
NOTHING = -1
_MOST_PAIRS = 1_000_000
"""Pairs of triangle and cell that are tested at once: about 100 MB."""


@dataclass(frozen=True, eq=False)
class TopView:
    """Square cells over a scene's ground.

    Parameters: top : (n_rows, n_columns) index in the scene of the object on top in the middle of each cell, `NOTHING`
        for none; height_m : (n_rows, n_columns) height of its surface there along the up axis, world [m]; low_m : (2,)
        corner of the grid [m]; cell_m : side of a cell [m]; level : numbers of the two level axes; up : number of the
        up axis.
    """

    scene: SceneSnapshot
    top: NDArray[np.intp]
    height_m: Floats
    low_m: Floats
    cell_m: float
    level: tuple[int, int]
    up: int

    @classmethod
    def of(cls, scene: SceneSnapshot, n_cells: int, up_to_m: float | None = None) -> TopView:
        """Return a view with `n_cells` along the longer side.

        Parameters: up_to_m : surfaces higher than this above the lowest point of the scene, such as a ceiling, are left
            out; None for no limit.
        """
        up = {"y": 1, "z": 2}[scene.up_axis]
        across, deep = (axis for axis in range(3) if axis != up)
        order = [across, deep, up]
        bounds = np.array([item.bounds_m for item in scene.objects])[:, :, order]
        low, high = bounds[:, 0].min(axis=0), bounds[:, 1].max(axis=0)
        cell = max(float((high - low)[:2].max()) / n_cells, 1e-9)
        n_columns, n_rows = (int(n) for n in np.maximum(1, np.ceil((high - low)[:2] / cell - 1e-9)))
        # The grid extends beyond the scene by the same length on both sides.
        corner = (low + high)[:2] / 2 - cell * np.array([n_columns, n_rows]) / 2
        top = np.full(n_rows * n_columns, NOTHING, dtype=np.intp)
        height = np.full(n_rows * n_columns, -np.inf)
        highest = np.inf if up_to_m is None else float(low[2]) + up_to_m
        for number, item in enumerate(scene.objects):
            mesh = item.geometry.mesh
            triangles = item.pose.to_world(mesh.vertices_m)[:, order][mesh.faces]
            triangles[..., :2] = (triangles[..., :2] - corner) / cell
            for cells, heights in _surface(triangles, n_columns, n_rows):
                seen = (heights > height[cells]) & (heights <= highest)
                cells, heights = cells[seen], heights[seen]
                # numpy keeps the last of several values for one cell, so the highest must come last
                rising = np.argsort(heights, kind="stable")
                top[cells[rising]], height[cells[rising]] = number, heights[rising]
        shape = (n_rows, n_columns)
        return cls(scene, top.reshape(shape), height.reshape(shape), corner, cell, (across, deep), up)

    @property
    def extent_m(self) -> tuple[float, float, float, float]:
        """Left, right, lower and upper edge [m]."""
        (left, lower), (n_rows, n_columns) = self.low_m.tolist(), self.top.shape
        return left, left + n_columns * self.cell_m, lower, lower + n_rows * self.cell_m

    def points_m(self) -> tuple[NDArray[np.intp], Floats]:
        """Return flat numbers (n_seen,) of cells with a surface, and the surface points (n_seen, 3) [m] in their
        middles."""
        cells = np.flatnonzero(self.top.ravel() != NOTHING)
        row, column = np.divmod(cells, self.top.shape[1])
        points = np.empty((len(cells), 3))
        points[:, self.level[0]] = self.low_m[0] + (column + 0.5) * self.cell_m
        points[:, self.level[1]] = self.low_m[1] + (row + 0.5) * self.cell_m
        points[:, self.up] = self.height_m.ravel()[cells]
        return cells, points

    def edges_m(self, among: NDArray[np.bool_] | None = None) -> Floats:
        """Return edges (n_edges, 2, 2) [m] between cells of different objects, or around a set of cells (n_rows,
        n_columns)."""
        numbers, beside = (self.top, NOTHING) if among is None else (among.astype(np.intp), 0)
        shown = np.pad(numbers, 1, constant_values=beside)
        row, column = np.nonzero(shown[1:-1, 1:] != shown[1:-1, :-1])
        upright = np.stack([np.stack([column, row], -1), np.stack([column, row + 1], -1)], 1)
        row, column = np.nonzero(shown[1:, 1:-1] != shown[:-1, 1:-1])
        level = np.stack([np.stack([column, row], -1), np.stack([column + 1, row], -1)], 1)
        edges: Floats = np.concatenate([upright, level]) * self.cell_m + self.low_m
        return edges


def _surface(triangles: Floats, n_columns: int, n_rows: int) -> Iterator[tuple[NDArray[np.intp], Floats]]:
    """Yield the cells whose middle is below a triangle, and the height there.

    `triangles` (n, 3, 3) have their first two coordinates in cells. To bound the memory, they are tested in parts.
    """
    least = np.ceil(triangles[..., :2].min(axis=1) - 0.5).clip(0, [n_columns, n_rows]).astype(np.intp)
    most = np.floor(triangles[..., :2].max(axis=1) - 0.5).clip(-1, [n_columns - 1, n_rows - 1]).astype(np.intp)
    size = np.maximum(most - least + 1, 0)
    n_pairs = size.prod(axis=1)
    kept = np.flatnonzero(n_pairs)
    part = np.cumsum(n_pairs[kept]) // _MOST_PAIRS
    for chosen in np.split(kept, np.flatnonzero(np.diff(part)) + 1):
        if not len(chosen):
            continue
        count = n_pairs[chosen]
        which = np.repeat(chosen, count)
        within = np.arange(len(which)) - np.repeat(np.cumsum(count) - count, count)
        down, right = np.divmod(within, size[which, 0])
        column, row = least[which, 0] + right, least[which, 1] + down
        a, b, c = np.moveaxis(triangles[which], 1, 0)
        x, y = column + 0.5 - a[:, 0], row + 0.5 - a[:, 1]
        p, q = b - a, c - a
        area = p[:, 0] * q[:, 1] - p[:, 1] * q[:, 0]
        with np.errstate(divide="ignore", invalid="ignore"):
            s, t = (x * q[:, 1] - y * q[:, 0]) / area, (p[:, 0] * y - p[:, 1] * x) / area
            inside = (area != 0) & (s >= -1e-9) & (t >= -1e-9) & (s + t <= 1 + 1e-9)
        height = a[inside, 2] + s[inside] * p[inside, 2] + t[inside] * q[inside, 2]
        yield (row * n_columns + column)[inside], height
