"""Oscillator: cosine and sine of a frequency by sample number, and products of signals with them.

Values come from a table of fixed size, whose phase is rotated to the sample number. So blocks of any size give the same
bits, and the phase does not drift over 10^9 samples.
"""

from __future__ import annotations

import math

import numpy as np

from scene2hap.common.arrays import Floats
from scene2hap.compiled import compiled

SIZE = 4096


class Oscillator:
    """cos and sin of 2 pi f n / f_s for any range of sample numbers n."""

    def __init__(self, frequency_hz: float, sample_rate_hz: float) -> None:
        self._cycles = frequency_hz / sample_rate_hz
        angle = 2.0 * np.pi * self._cycles * np.arange(SIZE)
        self._table = np.array([np.cos(angle), np.sin(angle)])

    def values(self, start: int, n: int) -> Floats:
        """Return cosine and sine from sample `start` on (2, n)."""
        return self.times(np.ones(n), start)

    def times(self, x: Floats, start: int) -> Floats:
        """Return a signal (n,) that begins at sample `start`, times cosine and sine (2, n)."""
        return multiplied(x, self._table, self._cycles, start)

    def joined(self, z: Floats, start: int) -> Floats:
        """Return the first row of a signal (2, n) times cosine plus its second row times sine (n,)."""
        return summed(z, self._table, self._cycles, start)


@compiled
def multiplied(x: Floats, table: Floats, cycles: float, start: int) -> Floats:
    """Multiply a signal (n,) by an oscillator. Returns: (2, n).

    Parameters: table : cosine and sine of the first `SIZE` samples (2, SIZE); cycles : per sample; start : the first
    sample's number.
    """
    return _values(table, cycles, start, len(x)) * x


@compiled
def summed(z: Floats, table: Floats, cycles: float, start: int) -> Floats:
    """Multiply a signal (2, n) by an oscillator and add both rows (n,). Parameters: see `multiplied`."""
    y = z * _values(table, cycles, start, z.shape[1])
    return np.asarray(y[0] + y[1])


def _values(table: Floats, cycles: float, start: int, n: int) -> Floats:
    parts = [np.empty((2, 0))]
    end = start + n
    for number in range(start // SIZE, (end - 1) // SIZE + 1):
        begin = number * SIZE
        angle = 2.0 * math.pi * math.fmod(cycles * begin, 1.0)
        c, s = math.cos(angle), math.sin(angle)
        cos, sin = table[:, max(start - begin, 0) : min(end - begin, SIZE)]
        parts.append(np.array([c * cos - s * sin, s * cos + c * sin]))
    return np.concatenate(parts, axis=1)
