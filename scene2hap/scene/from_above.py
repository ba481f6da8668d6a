"""A scene from above: the topmost object at each place of a grid, and its height there.

A ceiling or a roof would hide the room, so it is left out: a wide object whose surface is so high that a person stands
under it, and without which several times as many objects are visible.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from scene2hap.common.arrays import Bools, Floats, Indices
from scene2hap.scene.geometry import counted_up, joined
from scene2hap.scene.objects import VERTICAL
from scene2hap.scene.snapshot import SceneSnapshot

NOTHING = -1
_MOST_CELLS = 1_000_000
"""Cells under triangles that are computed at once: about 100 MB."""
_HEADROOM_M = 1.8
"""Least height of a ceiling above the lowest point of the scene; assumed. A table that covers its own legs is none."""
_WIDE_SHARE = 0.7
"""Least share of the scene's width and depth of a ceiling, or of a room whose ceiling is part of it."""
_UNCOVERED = 2.0
"""Without a ceiling, more than this many times as many objects are visible; assumed. Terrain uncovers nothing."""
_AROUND_M = 1.0
"""Least width of the strip of ground that is drawn around everything else; assumed, the reach of a hand."""
_FAR_LARGER = 3.0
"""The ground is cut off if the drawing becomes at least this many times larger; assumed."""
_MOST_LAYERS = 8
"""Most surfaces above each other that are tried: top and underside of a ceiling, of an attic and of a roof."""


@dataclass(frozen=True, eq=False)
class TopView:
    """Square cells over a scene's ground.

    Parameters: top : (n_rows, n_columns) index in the scene of the object on top in the middle of each cell, `NOTHING`
        for none; height_m : (n_rows, n_columns) height of its surface there along the up axis, world [m]; low_m : (2,)
        corner of the grid [m]; cell_m : side of a cell [m]; level : numbers of the two level axes; up : number of the
        up axis; is_uncovered : True if a ceiling is left out.
    """

    scene: SceneSnapshot
    top: Indices
    height_m: Floats
    low_m: Floats
    cell_m: float
    level: tuple[int, int]
    up: int
    is_uncovered: bool = False

    @classmethod
    def of(cls, scene: SceneSnapshot, n_cells: int, up_to_m: float | None = None) -> TopView:
        """Return a view with `n_cells` along the longer side.

        Parameters: up_to_m : surfaces higher than this above the lowest point of the scene are left out; None to leave
            out only ceilings and roofs that hide most of the objects.
        """
        bounds = np.array([item.bounds_m for item in scene.objects])
        up = VERTICAL[scene.up_axis]
        lowest = float(bounds[:, 0, up].min())
        if up_to_m is not None:
            return cls._up_to(scene, n_cells, np.full(len(bounds), lowest + up_to_m))
        limits = np.full(len(bounds), np.inf)
        view = best = cls._up_to(scene, n_cells, limits)
        is_wide = np.ptp(bounds, axis=1) >= _WIDE_SHARE * np.ptp(joined(bounds), axis=0)
        wide = np.flatnonzero(is_wide[:, view.level].all(axis=1))
        for _ in range(_MOST_LAYERS):
            is_cover = np.isin(view.top, wide) & (view.height_m >= lowest + _HEADROOM_M)
            if not is_cover.any():
                break
            for number in np.unique(view.top[is_cover]):
                limits[number] = np.nextafter(view.height_m[is_cover & (view.top == number)].min(), -np.inf)
            view = cls._up_to(scene, n_cells, limits)
            if view._n_visible > _UNCOVERED * best._n_visible:
                best = replace(view, is_uncovered=True)
        return best

    @classmethod
    def _up_to(cls, scene: SceneSnapshot, n_cells: int, limits_m: Floats) -> TopView:
        """Return the view of the surfaces up to a height (n_objects,) [m] for each object."""
        up = VERTICAL[scene.up_axis]
        across, deep = (axis for axis in range(3) if axis != up)
        order = [across, deep, up]
        bounds = np.array([item.bounds_m for item in scene.objects])[:, :, order]
        low, high = _frame(bounds[..., :2])
        cell = max(float((high - low).max()) / n_cells, 1e-9)
        n_columns, n_rows = (int(n) for n in np.maximum(1, np.ceil((high - low) / cell - 1e-9)))
        # The grid extends beyond the frame by the same length on both sides.
        corner = (low + high) / 2 - cell * np.array([n_columns, n_rows]) / 2
        highest = HighestSurface(n_columns, n_rows)
        for number, item in enumerate(scene.objects):
            mesh = item.geometry.mesh
            triangles = item.pose.to_world(mesh.vertices_m)[:, order][mesh.faces]
            triangles[..., :2] = (triangles[..., :2] - corner) / cell
            highest.add(triangles, np.full(len(triangles), number), limits_m[number])
        return cls(scene, highest.top, highest.height, corner, cell, (across, deep), up)

    @property
    def _n_visible(self) -> int:
        return len(np.unique(self.top[self.top != NOTHING]))

    @property
    def extent_m(self) -> tuple[float, float, float, float]:
        """Left, right, lower and upper edge [m]."""
        (left, lower), (n_rows, n_columns) = self.low_m.tolist(), self.top.shape
        return left, left + n_columns * self.cell_m, lower, lower + n_rows * self.cell_m

    def points_m(self) -> tuple[Indices, Floats]:
        """Return flat numbers (n_seen,) of cells with a surface, and the surface points (n_seen, 3) [m] in their
        middles."""
        cells = np.flatnonzero(self.top.ravel() != NOTHING)
        row, column = np.divmod(cells, self.top.shape[1])
        points = np.empty((len(cells), 3))
        points[:, self.level[0]] = self.low_m[0] + (column + 0.5) * self.cell_m
        points[:, self.level[1]] = self.low_m[1] + (row + 0.5) * self.cell_m
        points[:, self.up] = self.height_m.ravel()[cells]
        return cells, points

    def edges_m(self, among: Bools | None = None) -> Floats:
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


class HighestSurface:
    """The topmost of all triangles that were added, in the middle of each cell of a grid.

    `top` (n_rows, n_columns) has the number of its triangle, `NOTHING` for none; `height` its height there.
    """

    def __init__(self, n_columns: int, n_rows: int) -> None:
        self.top: Indices = np.full((n_rows, n_columns), NOTHING, dtype=np.intp)
        self.height: Floats = np.full((n_rows, n_columns), -np.inf)

    def add(self, triangles: Floats, numbers: Indices, limit: float = np.inf) -> None:
        """Add triangles (n, 3, 3): column and row in cells, and height. Their numbers (n,) need not differ.

        Surface above the limit is left out. A vertical triangle covers no cell.
        """
        n_rows, n_columns = self.top.shape
        top, height = self.top.reshape(-1), self.height.reshape(-1)
        for which, cells, heights in _surface(triangles, n_columns, n_rows):
            seen = (heights > height[cells]) & (heights <= limit)
            which, cells, heights = which[seen], cells[seen], heights[seen]
            # numpy keeps the last of several values for one cell, so the highest must come last
            rising = np.argsort(heights, kind="stable")
            top[cells[rising]], height[cells[rising]] = numbers[which[rising]], heights[rising]


def _frame(bounds_m: Floats) -> tuple[Floats, Floats]:
    """Return the corners (2,) [m] of the drawn ground, from the bounds (n_objects, 2, 2) [m] of all objects over it.

    A ground that is far larger than the rest, such as the endless floor of a simulator, is drawn around the rest only.
    """
    low, high = joined(bounds_m)
    largest = np.ptp(bounds_m, axis=1).prod(axis=1).argmax()
    rest = np.delete(bounds_m, largest, axis=0)
    if not len(rest):
        return low, high
    inner_low, inner_high = joined(rest)
    margin = max(float((inner_high - inner_low).max()), _AROUND_M)
    inner_low, inner_high = np.maximum(inner_low - margin, low), np.minimum(inner_high + margin, high)
    is_far_larger = (high - low).max() > _FAR_LARGER * (inner_high - inner_low).max()
    return (inner_low, inner_high) if is_far_larger else (low, high)


def _surface(triangles: Floats, n_columns: int, n_rows: int) -> Iterator[tuple[Indices, Indices, Floats]]:
    """Yield triangles, the cells whose middle is below them, and their height there.

    `triangles` (n, 3, 3) have their first two coordinates in cells. A triangle covers one run of cells in each row. To
    bound the memory, triangles are taken in parts.
    """
    least = np.ceil(triangles[..., :2].min(axis=1) - 0.5).clip(0, [n_columns, n_rows]).astype(np.intp)
    most = np.floor(triangles[..., :2].max(axis=1) - 0.5).clip(-1, [n_columns - 1, n_rows - 1]).astype(np.intp)
    size = np.maximum(most - least + 1, 0)
    p, q = triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]
    area = p[:, 0] * q[:, 1] - p[:, 1] * q[:, 0]
    most_cells = size.prod(axis=1)
    kept = np.flatnonzero((most_cells > 0) & (area != 0))
    part = np.cumsum(most_cells[kept]) // _MOST_CELLS
    for chosen in np.split(kept, np.flatnonzero(np.diff(part)) + 1):
        which, down = counted_up(size[chosen, 1])
        which = chosen[which]
        row = least[which, 1] + down
        corners = triangles[which]
        x, y = corners[..., 0], corners[..., 1]
        x_next, y_next = np.roll(x, -1, axis=1), np.roll(y, -1, axis=1)
        middle = (row + 0.5)[:, None]
        crosses = (np.minimum(y, y_next) <= middle) & (middle <= np.maximum(y, y_next)) & (y != y_next)
        with np.errstate(divide="ignore", invalid="ignore"):
            at = x + (x_next - x) * ((middle - y) / (y_next - y))
        first = np.ceil(np.where(crosses, at, np.inf).min(axis=1) - 0.5 - 1e-9).clip(0, n_columns)
        last = np.floor(np.where(crosses, at, -np.inf).max(axis=1) - 0.5 + 1e-9).clip(-1, n_columns - 1)
        along = (p[which, 2] * q[which, 1] - q[which, 2] * p[which, 1]) / area[which]
        across = (q[which, 2] * p[which, 0] - p[which, 2] * q[which, 0]) / area[which]
        start = corners[:, 0, 2] + along * (first + 0.5 - x[:, 0]) + across * (middle[:, 0] - y[:, 0])
        run, right = counted_up(np.maximum(last - first + 1, 0).astype(np.intp))
        # The plane of a nearly vertical triangle is steep, so that rounding could leave the triangle's heights.
        lowest, highest = corners[..., 2].min(axis=1), corners[..., 2].max(axis=1)
        heights = np.clip(start[run] + along[run] * right, lowest[run], highest[run])
        yield which[run], (row * n_columns + first.astype(np.intp))[run] + right, heights
