"""A scene from above as text: the object that a hand would touch at each place."""

from __future__ import annotations

import string
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from scene2hap.scene.from_above import NOTHING, TopView
from scene2hap.scene.snapshot import SceneSnapshot

_LETTERS = string.ascii_letters + string.digits
_N_CELLS = 512
"""Cells of the view along the longer side of the scene: 2 cm in a room of ten metres, so that no phone is missed."""
_LARGE = 0.8
"""Least share of the scene's extent along both axes from which an object counts as floor, shown as a dot."""


@dataclass(frozen=True)
class Plan:
    """A grid over the scene's ground.

    `top` (n_rows, n_columns) is the index of the smallest object seen from above in each cell, `NOTHING` for none.
    `points_m` (n_rows, n_columns, 3) is a point on it [m, world].
    """

    scene: SceneSnapshot
    top: NDArray[np.intp]
    points_m: NDArray[np.float64]

    @classmethod
    def of(cls, scene: SceneSnapshot, n_columns: int = 64, n_rows: int = 22) -> Plan:
        """Return the plan of a scene. A ceiling that hides most of the objects is left out."""
        view = TopView.of(scene, _N_CELLS)
        cells, seen_m = view.points_m()
        numbers = view.top.ravel()[cells]
        # Of several objects in a cell, numpy keeps the last: the smallest, which no other cell may have.
        order = np.argsort(-np.bincount(numbers)[numbers], kind="stable")
        row, column = np.divmod(cells[order], view.top.shape[1])
        place = row * n_rows // view.top.shape[0], column * n_columns // view.top.shape[1]
        top, points_m = np.full((n_rows, n_columns), NOTHING, dtype=np.intp), np.zeros((n_rows, n_columns, 3))
        top[place], points_m[place] = numbers[order], seen_m[order]
        return cls(scene, top, points_m)

    def touched(self, row: int, column: int) -> tuple[str, tuple[float, float, float]] | None:
        """Return the object in a cell and the touched point on it [m, world]; None for an empty cell."""
        number = self.top[row, column]
        if number == NOTHING:
            return None
        x, y, z = self.points_m[row, column].tolist()
        return self.scene.objects[number].id, (x, y, z)

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
