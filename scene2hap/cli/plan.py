"""A scene from above as text: the object that a hand would touch at each place."""

from __future__ import annotations

import string
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from scene2hap.scene.geometry import joined
from scene2hap.scene.objects import VERTICAL
from scene2hap.scene.snapshot import SceneSnapshot

_LETTERS = string.ascii_letters + string.digits
_NOTHING = -1
_LARGE = 0.8
"""Least share of the scene's extent along both axes from which the lowest object counts as floor, shown as a dot."""


@dataclass(frozen=True)
class Plan:
    """A grid over the scene's ground.

    `top` (n_rows, n_columns) is the index of the object that is highest in each cell, -1 for none. `height_m` is its
    height. `low_m` and `cell_m` are the grid's origin and cell size on the two horizontal axes `level`.
    """

    scene: SceneSnapshot
    top: NDArray[np.intp]
    height_m: NDArray[np.float64]
    low_m: NDArray[np.float64]
    cell_m: NDArray[np.float64]
    level: tuple[int, int]

    @classmethod
    def of(cls, scene: SceneSnapshot, n_columns: int = 64, n_rows: int = 22) -> Plan:
        """Return the plan of a scene. The highest bounding box decides the object of a cell."""
        up = VERTICAL[scene.up_axis]
        across, deep = (axis for axis in range(3) if axis != up)
        bounds = np.array([item.bounds_m for item in scene.objects]).reshape(-1, 2, 3)
        low, high = joined(bounds)[:, [across, deep]]
        cell = np.maximum((high - low) / (n_columns, n_rows), 1e-6)
        x = low[0] + (np.arange(n_columns) + 0.5) * cell[0]
        y = low[1] + (np.arange(n_rows) + 0.5) * cell[1]
        top = np.full((n_rows, n_columns), _NOTHING, dtype=np.intp)
        height = np.full((n_rows, n_columns), -np.inf)
        for number, (least, most) in enumerate(bounds):
            inside = np.outer(
                (least[deep] <= y + cell[1] / 2) & (y - cell[1] / 2 <= most[deep]),
                (least[across] <= x + cell[0] / 2) & (x - cell[0] / 2 <= most[across]),
            )
            higher = inside & (most[up] > height)
            top[higher], height[higher] = number, most[up]
        return cls(scene, top, height, low, cell, (across, deep))

    def touched(self, row: int, column: int) -> tuple[str, tuple[float, float, float]] | None:
        """Return the object in a cell and the touched point on it [m, world]; None for an empty cell."""
        number = self.top[row, column]
        if number == _NOTHING:
            return None
        item = self.scene.objects[number]
        point = np.zeros(3)
        point[list(self.level)] = self.low_m + (np.array([column, row]) + 0.5) * self.cell_m
        up = 3 - sum(self.level)
        point[up] = self.height_m[row, column]
        x, y, z = np.clip(point, *item.bounds_m).tolist()
        return item.id, (x, y, z)

    def lines(self, sources: frozenset[str], hand: tuple[int, int]) -> list[str]:
        """Return the plan as text: letters for objects, "*" for sources, "." for the floor, "@" for the hand."""
        n_rows, n_columns = self.top.shape
        shown = np.full((n_rows, n_columns), " ")
        for number in np.unique(self.top[self.top >= 0]):
            is_floor = (self.top == number).any(axis=0).mean() > _LARGE and (self.top == number).any(
                axis=1
            ).mean() > _LARGE
            is_source = self.scene.objects[number].id in sources
            shown[self.top == number] = "*" if is_source else "." if is_floor else _LETTERS[number % len(_LETTERS)]
        shown[hand] = "@"
        return ["".join(row) for row in shown]
