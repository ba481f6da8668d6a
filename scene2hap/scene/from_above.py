"""A scene from above: the topmost object at each place of a grid, and its height there.

A ceiling or a roof would hide the room, so it is left out: a wide object whose surface is so high that a person stands
under it, and without which several times as many objects are visible.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from scene2hap.scene.bounds import joined
from scene2hap.scene.objects import VERTICAL
from scene2hap.scene.snapshot import SceneSnapshot

Floats = NDArray[np.float64]
NOTHING = -1
_MOST_PAIRS = 1_000_000
"""Pairs of triangle and cell that are tested at once: about 100 MB."""
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
    top: NDArray[np.intp]
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
        top = np.full(n_rows * n_columns, NOTHING, dtype=np.intp)
        height = np.full(n_rows * n_columns, -np.inf)
        for number, item in enumerate(scene.objects):
            mesh = item.geometry.mesh
            triangles = item.pose.to_world(mesh.vertices_m)[:, order][mesh.faces]
            triangles[..., :2] = (triangles[..., :2] - corner) / cell
            for cells, heights in _surface(triangles, n_columns, n_rows):
                seen = (heights > height[cells]) & (heights <= limits_m[number])
                cells, heights = cells[seen], heights[seen]
                # numpy keeps the last of several values for one cell, so the highest must come last
                rising = np.argsort(heights, kind="stable")
                top[cells[rising]], height[cells[rising]] = number, heights[rising]
        shape = (n_rows, n_columns)
        return cls(scene, top.reshape(shape), height.reshape(shape), corner, cell, (across, deep), up)

    @property
    def _n_visible(self) -> int:
        return len(np.unique(self.top[self.top != NOTHING]))

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
