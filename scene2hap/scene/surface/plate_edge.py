"""The boundary between a plate and parts fixed to its edge: a television's stand, a radio's handle, a bookcase's feet.

Seen along the plate's normal, the rows of such a part next to the plate are filled less than half as much as the
plate's. And the part is not level with the plate. The arm of an L-shaped top and the wall beside a doorway are level
with their plate and belong to it. A disc narrows gradually and has no such boundary.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from scene2hap.common.arrays import Bools, Floats, Ints

# Tuned on real scenes, with the labels in tests/data/dominant_surfaces.csv unchanged.
_NARROW = 0.5  # rows filled by less than this share of the fullest row's rays are no part of the plate ...
_ABRUPT = 0.9  # ... if the row beside them is filled by this share of the median ...
_LEVEL = 0.5  # ... and less than this share of their hits is level with the plate
_LEAST_ROWS = 0.5  # the plate has at least this share of all rows, else the mesh is no plate with a part at its edge


class Window(NamedTuple):
    """Rows of the grid that belong to the plate, from `first` up to, but not including, `last`, of n."""

    first: int
    last: int
    n: int

    @property
    def is_all(self) -> bool:
        """True if nothing is fixed to the plate's edge."""
        return self.last - self.first == self.n

    def bounds_m(self, segments: Floats, along: int, low_m: float, high_m: float) -> tuple[float, float]:
        """Return the plate's ends [m] along a coordinate of segments (2, 2, k), from the ends of the grid.

        An end inside the grid is at the longest edge across within a cell of that row; without such an edge, at the
        row's own boundary.
        """
        cell_m = (high_m - low_m) / self.n
        return (
            low_m if self.first == 0 else _edge_m(segments, along, low_m + self.first * cell_m, cell_m),
            high_m if self.last == self.n else _edge_m(segments, along, low_m + self.last * cell_m, cell_m),
        )


def windows(seen: Bools, level: Bools) -> tuple[Window, Window]:
    """Return the plate's rows along u and v. `seen` and `level` mark rays (n, n) that meet anything, or the plate's
    level."""
    along_u, along_v = (_window(seen.sum(axis=axis), level.sum(axis=axis)) for axis in (1, 0))
    return along_u, along_v


def _window(n_seen: Ints, n_level: Ints) -> Window:
    n = len(n_seen)
    is_wide = n_seen >= _NARROW * n_seen.max()
    ends = np.flatnonzero(np.diff(is_wide, prepend=False, append=False)).reshape(-1, 2)
    first, last = max(ends.tolist(), key=lambda run: int(n_seen[run[0] : run[1]].sum()))
    if last - first < _LEAST_ROWS * n:
        return Window(0, n, n)
    usual = np.median(n_seen[first:last])

    def is_fixed(beyond: slice, edge: int) -> bool:
        return bool(n_seen[edge] >= _ABRUPT * usual and n_level[beyond].sum() < _LEVEL * n_seen[beyond].sum())

    return Window(
        first if is_fixed(slice(0, first), first) else 0, last if is_fixed(slice(last, n), last - 1) else n, n
    )


def _edge_m(segments: Floats, along: int, near_m: float, cell_m: float) -> float:
    """Return the coordinate [m] of the longest of the segments (2, 2, k) across it, within a cell of `near_m`."""
    places, lengths = segments[along], np.abs(np.diff(segments[1 - along], axis=0)[0])
    lengths = np.where((np.abs(places - near_m) <= cell_m).all(axis=0), lengths, 0.0)
    if not lengths.max(initial=0.0) > 0:
        return near_m
    return float(places[:, lengths.argmax()].mean())
