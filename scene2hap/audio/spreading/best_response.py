"""Move many sources apart by iterated best response: each in turn takes the place of least cost, until none moves.

The cost is that of the move plus the weighted missing distances to other sources [oct]. Places are a grid of 49
frequencies and 13 levels. Unlike `linear_programme`, this is not exact, but a hundred sources take only seconds.
"""

from __future__ import annotations

import numpy as np

from scene2hap.audio.spreading.placements import Outcome, Problem, shortage_oct
from scene2hap.common.arrays import Floats, Ints

_N_X, _N_L = 49, 13
_SWEEPS = 40
_SHORTAGE_WEIGHT = 1000.0


def iterated_best_response(problem: Problem) -> Outcome:
    """Return the better of two results: from the present frequencies, and from the ends of the ranges."""
    n = len(problem.x0)
    ranks = np.argsort(np.argsort(problem.x0, kind="stable"), kind="stable")
    apart = np.where(ranks < n / 2, problem.x_low, problem.x_high)
    outcomes = [_settled(problem, start) for start in (problem.x0, apart)]
    return min(outcomes, key=lambda outcome: _SHORTAGE_WEIGHT * outcome.shortage_oct + outcome.moves)


def _settled(problem: Problem, start: Floats) -> Outcome:
    x, level = start.copy(), problem.l0.copy()
    neighbours = [_Neighbours(problem, i) for i in range(len(problem.x0))]
    for _ in range(_SWEEPS):
        before = x.copy(), level.copy()
        for i, others in enumerate(neighbours):
            x[i], level[i] = _best_place(problem, i, x, level, others)
        if np.array_equal(before[0], x) and np.array_equal(before[1], level):
            break
    return Outcome(problem, x, level)


class _Neighbours:
    """The sources from which one must differ, and those whose level must stay below or above it, with the gaps [dB]."""

    def __init__(self, problem: Problem, i: int) -> None:
        self.partners = np.array([b if a == i else a for a, b in problem.pairs if i in (a, b)], dtype=np.int64)
        below = [(weak, gap) for strong, weak, gap in problem.order if strong == i]
        above = [(strong, gap) for strong, weak, gap in problem.order if weak == i]
        self.below, self.below_gap = _columns(below)
        self.above, self.above_gap = _columns(above)


def _columns(rows: list[tuple[int, float]]) -> tuple[Ints, Floats]:
    return np.array([i for i, _ in rows], dtype=np.int64), np.array([gap for _, gap in rows], dtype=np.float64)


def _best_place(problem: Problem, i: int, x: Floats, level: Floats, others: _Neighbours) -> tuple[float, float]:
    lowest = np.max(level[others.below] + others.below_gap, initial=problem.l_low[i])
    highest = np.min(level[others.above] - others.above_gap, initial=problem.l_high[i])
    partners = others.partners
    xs = np.append(np.linspace(problem.x_low[i], problem.x_high[i], _N_X), x[i])
    ls = np.append(np.linspace(lowest, max(lowest, highest), _N_L), level[i])
    apart = np.abs(xs[:, None, None] - x[partners])
    lacking = shortage_oct(apart, np.abs(ls[None, :, None] - level[partners]), problem.jnd_oct).sum(axis=2)
    moved = np.abs(xs - problem.x0[i])[:, None] / problem.octaves + np.abs(ls - problem.l0[i]) / problem.level_db
    a, b = np.unravel_index(np.argmin(_SHORTAGE_WEIGHT * lacking + moved), lacking.shape)
    return float(xs[a]), float(ls[b])
