"""Mean squares of a signal in steps of equal length."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from scene2hap.compiled import compiled

Floats = NDArray[np.float64]


class StepEnergies:
    """Mean squares of a signal in steps of `step` samples, for any block size."""

    def __init__(self, step: int) -> None:
        self._step, self._left = step, np.empty(0)

    def next(self, x: Floats) -> Floats:
        """Return the mean squares (n,) of the steps that the next samples complete."""
        if self._left.size == 0 and len(x) % self._step == 0:  # as in live streams
            return mean_squares(x, self._step)
        n_first = -len(self._left) % self._step
        if len(x) < n_first:
            self._left = np.concatenate([self._left, x])
            return np.empty(0)
        first, whole = np.concatenate([self._left, x[:n_first]]), x[n_first:]
        n = len(whole) // self._step * self._step
        self._left = whole[n:].copy()
        return np.concatenate([mean_squares(first, self._step), mean_squares(whole[:n], self._step)])


@compiled
def mean_squares(x: Floats, step: int) -> Floats:
    """Return the mean square of each step of a signal (n steps,)."""
    return np.asarray((x.reshape(-1, step) ** 2).mean(axis=1))
