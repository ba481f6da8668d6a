"""How a loop comes up or dies away: itself, played ever faster or slower, louder or weaker.

    u(t) = integral of s           s speed re full, 0..1           amplitude s^2, the force of an unbalance

A motor's speed nears its end as s = x (2 - x), and coasts down as s = (1 - x)^2, x being the share of the time. What
does not spin keeps its pitch, and its amplitude goes along half a cosine. A passage ends, or begins, in step with the
loop itself, so that one goes over into the other without a seam.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from scene2hap.render.loop_bank import Block, LoopBank, StoredLoop, stored_once

HOLD_S = 0.5
"""The tail of a passage, the steady loop or silence, until the player notices that the passage is over."""
LEAD_S = 0.03
"""A loop that dies away goes on for so long, while it takes over from the steady one."""


class Passage(LoopBank):
    """A bank of one loop that is on its way up or down, once.

    Parameters: steady : the bank of the loop itself; begin : tactile sample of the clock at which it starts; lasts_s :
    from standing still to full speed, or back [s]; from_speed : 0..1, where it starts; `end` is the sample from which
    on the steady loop, or silence, may take over.
    """

    def __init__(
        self, steady: LoopBank, begin: int, lasts_s: float, *, goes_up: bool, spins: bool, from_speed: float
    ) -> None:
        rate = self.sample_rate_hz = steady.sample_rate_hz
        self.n_bands = steady.n_bands
        self._begin, self._goes_up, self._lasts = begin, goes_up, lasts_s * rate
        self._from = 1 - math.sqrt(1 - from_speed) if goes_up else 1 - math.sqrt(from_speed)
        lead, n = 0 if goes_up else round(LEAD_S * rate), math.ceil((1 - self._from) * self._lasts)
        self.end = begin + lead + n
        x = np.clip(self._from + (np.arange(lead + n + round(HOLD_S * rate)) - lead) / self._lasts, self._from, 1.0)
        speed = _speed(x, goes_up)
        if spins:
            played = np.concatenate([[0.0], np.cumsum(speed[:-1])])
            # On its way up it is in step at the end, on its way down at the beginning.
            at, amplitude = played - played[n] + n if goes_up else played, speed**2
        else:
            at = np.arange(len(x), dtype=np.float64)
            amplitude = np.sin(np.pi / 2 * (x if goes_up else 1 - x)) ** 2
        low = math.floor(at.min())
        source = steady.taken(0, begin + low, math.ceil(at.max()) - low + 2)
        samples = _between(source, at - low) * amplitude[:, None].astype(np.float32)
        self._samples = samples
        self.loops: list[StoredLoop] = [stored_once(samples, begin)]

    @property
    def nbytes(self) -> int:
        """See `LoopBank`."""
        return self._samples.nbytes

    def speed(self, at: int) -> float:
        """How far up it is at a tactile sample, 0..1."""
        lead = 0 if self._goes_up else round(LEAD_S * self.sample_rate_hz)
        x = self._from + (at - self._begin - lead) / self._lasts
        return float(_speed(np.array(min(max(x, self._from), 1.0)), self._goes_up))


def _speed(x: NDArray[np.float64], goes_up: bool) -> NDArray[np.float64]:
    return x * (2 - x) if goes_up else (1 - x) ** 2


def _between(samples: Block, at: NDArray[np.float64]) -> Block:
    """Samples (n, n_bands) at places between them, along lines: at 8 kHz within 0.5 % up to 250 Hz."""
    below = np.floor(at).astype(np.intp)
    share = (at - below).astype(np.float32)[:, None]
    found: Block = samples[below] * (1 - share) + samples[below + 1] * share
    return found
