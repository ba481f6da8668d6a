"""Mean squares of a signal in steps of equal length."""

from __future__ import annotations

import numpy as np

from scene2hap.common.arrays import Floats
from scene2hap.compiled import compiled


class StepEnergies:
    """Mean squares of a signal in steps of `step` samples, for any block size."""

    def __init__(self, step: int) -> None:
        self._step, self._left = step, np.empty(0)

    def next(self, x: Floats) -> Floats:
        """Return the mean squares (n,) of the steps that the next samples complete."""
        whole = np.concatenate([self._left, x]) if self._left.size else x
        n = len(whole) // self._step * self._step
        self._left = whole[n:].copy()
        return mean_squares(whole[:n], self._step)


@compiled
def mean_squares(x: Floats, step: int) -> Floats:
    """Return the mean square of each step of a signal (n steps,)."""
    return np.asarray((x.reshape(-1, step) ** 2).mean(axis=1))
