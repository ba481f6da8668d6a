"""Move many sources apart by iterated best response: each in turn takes the place of least cost, until none moves.

The cost is that of the move plus the weighted missing distances to other voices [oct]. Places are a grid of 49
frequencies and 13 levels. Unlike `linear_programme`, this is not exact, but a hundred voices take only seconds.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from scene2hap.audio.spreading.placements import Array, Outcome, Room, shortage_oct

_N_X, _N_L = 49, 13
_SWEEPS = 40
_SHORTAGE_WEIGHT = 1000.0


def give_way(room: Room) -> Outcome:
    """Return the better of two results: from the present frequencies, and from the ends of the ranges."""
    n = len(room.x0)
    ranks = np.argsort(np.argsort(room.x0, kind="stable"), kind="stable")
    apart = np.where(ranks < n / 2, room.x_low, room.x_high)
    outcomes = [_settled(room, start) for start in (room.x0, apart)]
    return min(outcomes, key=lambda outcome: _SHORTAGE_WEIGHT * outcome.shortage_oct + outcome.moves)


def _settled(room: Room, start: Array) -> Outcome:
    x, level = start.copy(), room.l0.copy()
    neighbours = [_Neighbours(room, i) for i in range(len(room.x0))]
    for _ in range(_SWEEPS):
        before = x.copy(), level.copy()
        for i, others in enumerate(neighbours):
            x[i], level[i] = _best_place(room, i, x, level, others)
        if np.array_equal(before[0], x) and np.array_equal(before[1], level):
            break
    return Outcome(room, x, level)


class _Neighbours:
    """The voices from which a voice must differ, and those whose level must stay below or above, with the gaps [dB]."""

    def __init__(self, room: Room, i: int) -> None:
        self.partners = np.array([b if a == i else a for a, b in room.pairs if i in (a, b)], dtype=np.int64)
        below = [(weak, gap) for strong, weak, gap in room.order if strong == i]
        above = [(strong, gap) for strong, weak, gap in room.order if weak == i]
        self.below, self.below_gap = _columns(below)
        self.above, self.above_gap = _columns(above)


def _columns(rows: list[tuple[int, float]]) -> tuple[NDArray[np.int64], Array]:
    return np.array([i for i, _ in rows], dtype=np.int64), np.array([gap for _, gap in rows], dtype=np.float64)


def _best_place(room: Room, i: int, x: Array, level: Array, others: _Neighbours) -> tuple[float, float]:
    lowest = np.max(level[others.below] + others.below_gap, initial=room.l_low[i])
    highest = np.min(level[others.above] - others.above_gap, initial=room.l_high[i])
    partners = others.partners
    xs = np.append(np.linspace(room.x_low[i], room.x_high[i], _N_X), x[i])
    ls = np.append(np.linspace(lowest, max(lowest, highest), _N_L), level[i])
    apart = np.abs(xs[:, None, None] - x[partners])
    lacking = shortage_oct(apart, np.abs(ls[None, :, None] - level[partners]), room.jnd_oct).sum(axis=2)
    moved = np.abs(xs - room.x0[i])[:, None] / room.octaves + np.abs(ls - room.l0[i]) / room.level_db
    a, b = np.unravel_index(np.argmin(_SHORTAGE_WEIGHT * lacking + moved), lacking.shape)
    return float(xs[a]), float(ls[b])
