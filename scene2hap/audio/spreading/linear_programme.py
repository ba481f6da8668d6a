"""Move few sources apart, each as little as possible, by a mixed-integer linear programme.

For source i, x_i [oct] is the logarithm of its frequency and l_i [dB] its level. X and Y are the limits of their moves.
Every pair has three binaries, which source is higher (o) and whether the first or the second is stronger by two JNDs
(m, m'), and a slack s [oct], the missing distance. M and M' switch a row off:

    minimise  sum_i |x_i - x_i0| / X + |l_i - l_i0| / Y + W sum_ij s_ij
    x_j - x_i >= d (2 - m - m') - s - M (1 - o)  d [oct] one JND of frequency: two of them, or one and two of level
    x_i - x_j >= d (2 - m - m') - s - M o
    l_i - l_j >= 2 J - M' (1 - m)                J [dB] one JND of level; m is 0 if i is the weaker of the two
    l_j - l_i >= 2 J - M' (1 - m')               m' is 0 if j is; of equal sources either may become the stronger
    l_i >= l_j + least gap                       the order of intensities

W is so large that slack remains only where the limits force it. The solution is exact, but slow beyond some thirty
pairs, since each pair doubles the work.
"""

from __future__ import annotations

import numpy as np
import scipy
from numpy.typing import ArrayLike

from scene2hap.audio.spreading.placements import LEVEL_STEP_DB, Outcome, Problem
from scene2hap.common.arrays import Floats

_SLACK_WEIGHT = 1000.0
_NODES = 1000
"""Most branches of the search. Unlike a time limit, it gives the same result on every machine."""


class LinearProgramme:
    """The programme. Its variables in order: x, moves of x, l, moves of l (n each), then s, o, m, m' (one per pair)."""

    def __init__(self, problem: Problem) -> None:
        self._problem = problem
        self._n = n = len(problem.x0)
        self._pairs = problem.pairs
        self._rows: list[dict[int, float]] = []
        self._least: list[float] = []
        p = len(self._pairs)
        for i in range(n):
            for value, move, at in ((i, n + i, problem.x0[i]), (2 * n + i, 3 * n + i, problem.l0[i])):
                self._row({move: 1.0, value: -1.0}, -at)
                self._row({move: 1.0, value: 1.0}, at)
        for number, pair in enumerate(self._pairs):
            self._keep_apart(number, *pair)
        for strong, weak, gap in problem.order:
            self._row({2 * n + strong: 1.0, 2 * n + weak: -1.0}, gap)
        self._integrality = np.repeat([0, 1], [4 * n + p, 3 * p])
        self._constraints = scipy.optimize.LinearConstraint(
            self._matrix(len(self._integrality)), np.array(self._least), np.inf
        )

    def is_infeasible(self, shortage_oct: float) -> bool:
        """Return True if at least one pair lacks more than `shortage_oct` [oct] in every placement.

        This takes a millisecond. The best placement of such a programme takes a hundred times as long: the search has
        to weigh the shortages of all pairs against each other.
        """
        infeasible = 2  # of scipy's codes
        return bool(self._answer(0.0, 0.0, 0.0, most_slack=shortage_oct).status == infeasible)

    def solve(self) -> Outcome:
        """Return the best placement found."""
        problem, n = self._problem, self._n
        answer = self._answer(1.0 / problem.octaves, 1.0 / problem.level_db, _SLACK_WEIGHT)
        if answer.x is None:  # the search was cut off before it had any answer
            return Outcome(problem, problem.x0, problem.l0)
        return Outcome(problem, answer.x[:n], answer.x[2 * n : 3 * n])

    def _answer(
        self, move_x: float, move_l: float, slack: float, most_slack: float = np.inf
    ) -> scipy.optimize.OptimizeResult:
        """Search for the least cost: of the moves of x and l, and of slack, per unit; no slack exceeds `most_slack`."""
        problem, n, p = self._problem, self._n, len(self._pairs)
        never = np.full(n, np.inf)
        first, second = np.array(self._pairs, dtype=np.int64).reshape(-1, 2).T
        stronger, weaker = problem.l0[first] >= problem.l0[second], problem.l0[first] <= problem.l0[second]
        cost = _joined(n * [0.0], n * [move_x], n * [0.0], n * [move_l], p * [slack], 3 * p * [0.0])
        low = _joined(problem.x_low, n * [0.0], problem.l_low, n * [0.0], 4 * p * [0.0])
        high = _joined(problem.x_high, never, problem.l_high, never, p * [most_slack], p * [1.0], stronger, weaker)
        return scipy.optimize.milp(
            cost,
            integrality=self._integrality,
            bounds=scipy.optimize.Bounds(low, high),
            constraints=self._constraints,
            options={"node_limit": _NODES},
        )

    def _keep_apart(self, number: int, i: int, j: int) -> None:
        problem, n, p = self._problem, self._n, len(self._pairs)
        jnd = problem.jnd_oct
        slack, order, stronger, weaker = (4 * n + k * p + number for k in range(4))
        # M: the ranges of the pair allow no larger violation.
        most = 2.0 * jnd + max(problem.x_high[i] - problem.x_low[j], problem.x_high[j] - problem.x_low[i])
        modes = {stronger: jnd, weaker: jnd}
        self._row({j: 1.0, i: -1.0, **modes, slack: 1.0, order: -most}, 2.0 * jnd - most)
        self._row({i: 1.0, j: -1.0, **modes, slack: 1.0, order: most}, 2.0 * jnd)
        for mode, strong, weak in ((stronger, i, j), (weaker, j, i)):
            reach = 2.0 * LEVEL_STEP_DB + float(problem.l_high[weak] - problem.l_low[strong])
            self._row({2 * n + strong: 1.0, 2 * n + weak: -1.0, mode: -reach}, 2.0 * LEVEL_STEP_DB - reach)

    def _row(self, coefficients: dict[int, float], least: float) -> None:
        self._rows.append(coefficients)
        self._least.append(least)

    def _matrix(self, width: int) -> scipy.sparse.csr_array:
        values = [value for row in self._rows for value in row.values()]
        columns = [column for row in self._rows for column in row]
        numbers = [number for number, row in enumerate(self._rows) for _ in row]
        # scipy before 1.15 solves with indices of 32 bits alone.
        at = np.array([numbers, columns], dtype=np.int32)
        return scipy.sparse.csr_array((values, (at[0], at[1])), shape=(len(self._rows), width))


def _joined(*parts: ArrayLike) -> Floats:
    return np.concatenate([np.asarray(part, dtype=np.float64) for part in parts])
