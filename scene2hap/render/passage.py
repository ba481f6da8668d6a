"""Starts and stops of a loop: its speed and amplitude rise or fall over time.

    u(t) = integral of s           s speed re full, 0..1           a amplitude re full, 0..1

Assumed, with x the share of the time: a motor starts up with the speed s = x (2 - x), and coasts down with s = (1 -
x)^2. Its amplitude is a = s^2, the force of an unbalance. A source that does not spin keeps its pitch, and its
amplitude follows half a cosine. Recorded: a is the recorded amplitude. If the recording shows a speed, s is that speed;
else s = sqrt(a) for a source that spins.

A passage begins or ends in phase with the loop itself, so the change between them is seamless. After its end it is the
loop, or silence, for as long as nothing replaces it: a game may not update for a while. A passage that begins during
another one continues from the present amplitude. If the curve has another speed there, the difference fades over
the rest of the passage. A stop also continues from the present place in the loop. A start has to end in phase, so it
continues from the place near its own that sounds most like the present one, and the difference fades as well: two
places out of phase would cancel each other while one fades into the other.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from scene2hap.audio.run_curve import RunCurve
from scene2hap.render.loop_bank import CELL, Block, LoopBank, StoredLoop, stored_once

LEAD_S = 0.03
"""Time that a decaying loop continues unchanged while it replaces the steady one [s]."""
SEARCH_S = 0.0125
"""Largest distance of that place from the start's own [s of the loop]: half a period of 40 Hz."""
_ALIKE_S = 0.025
"""Length over which two places are compared [s of the loop]."""
_NEARER = 0.1
"""Likeness that the farthest place must have more than the start's own [-], since a shift bends the pitch."""
_GRID = np.linspace(0.0, 1.0, 4097)
"""Shares of the time at which an amplitude is searched: 7 ms apart in the longest passage."""

Signal = NDArray[np.float64]


class Running(NamedTuple):
    """Speed and amplitude of a source, both relative to steady running, 0..1 [-]."""

    speed: float
    amplitude: float


STEADY, STILL = Running(1.0, 1.0), Running(0.0, 0.0)


class Course(NamedTuple):
    """The course of a passage: up or down, spinning or not, along a recorded curve or, for None, an assumed one."""

    goes_up: bool
    spins: bool
    curve: RunCurve | None = None

    def speed(self, x: Signal) -> Signal:
        """Return speeds (n,) [-] at shares x (n,) of the time."""
        recorded = None if self.curve is None else self.curve.speed_at(x)
        if recorded is not None:
            return recorded
        if not self.spins:
            return np.ones_like(x)
        if self.curve is not None:
            return np.sqrt(self.amplitude(x))
        return x * (2 - x) if self.goes_up else (1 - x) ** 2

    def amplitude(self, x: Signal) -> Signal:
        """Return amplitudes (n,) [-] at shares x (n,) of the time."""
        if self.curve is not None:
            return self.curve.amplitude_at(x)
        if self.spins:
            return self.speed(x) ** 2
        return np.asarray(np.sin(np.pi / 2 * (x if self.goes_up else 1 - x)) ** 2)

    def share(self, running: Running) -> float:
        """Return the share of the time at which the course has the present amplitude [-]."""
        a = self.amplitude(_GRID)
        up = np.maximum.accumulate(a if self.goes_up else a[::-1])
        if not up[0] < running.amplitude < up[-1]:
            return float((running.amplitude > up[0]) == self.goes_up)
        x = float(np.interp(running.amplitude, up, _GRID))
        return x if self.goes_up else 1.0 - x


class Passage(LoopBank):
    """A bank of one loop that starts or stops, once.

    Parameters: steady : the bank of the loop itself; begin : tactile sample of the clock at which the passage starts;
        lasts_s : from standstill to full speed, or back [s]; since : speed and amplitude at its start; after : the
        passage that it interrupts, if any. From the sample `end` on, it is the steady loop or silence.
    """

    def __init__(
        self,
        steady: LoopBank,
        begin: int,
        lasts_s: float,
        course: Course,
        since: Running,
        after: Passage | None = None,
    ) -> None:
        rate = steady.sample_rate_hz
        self.sample_rate_hz: int = rate
        self.n_bands: int = steady.n_bands
        self._begin, self._course, self._lasts = begin, course, lasts_s * rate
        self._from = course.share(since)
        # At standstill and in steady running there is no difference of speed to fade.
        is_under_way = 0.0 < since.amplitude < 1.0
        self._ahead = since.speed - float(course.speed(np.array([self._from]))[0]) if is_under_way else 0.0
        lead, n = self._lead, math.ceil((1 - self._from) * self._lasts)
        self.end: int = begin + lead + n
        x = self._share(np.arange(begin, self.end + CELL))
        speed, amplitude = self._speed(x), course.amplitude(x)
        played = np.concatenate([[0.0], np.cumsum(speed[:-1])])
        # A start is in phase with the loop at its end, a stop at its beginning.
        at = played - played[n] + n if course.goes_up else played
        if after is not None and is_under_way:
            at += self._shift(steady, at[0], after._place(begin) - begin, len(at))
        self._at = at
        low = math.floor(at.min())
        source = steady.taken(0, begin + low - 1, math.ceil(at.max()) - low + 4)
        samples = _between(source, at - low + 1) * amplitude[:, None].astype(np.float32)
        self.loops: list[StoredLoop] = [stored_once(samples, begin)]
        self._afterwards = steady.loops[0] if course.goes_up else None

    def only(self, begin: int) -> StoredLoop | None:
        """Return the passage, or from its end on the steady loop or silence."""
        return self.loops[0] if begin < self.end else self._afterwards

    @property
    def _lead(self) -> int:
        return 0 if self._course.goes_up else round(LEAD_S * self.sample_rate_hz)

    def running(self, at: int) -> Running:
        """Return speed and amplitude at a tactile sample."""
        x = self._share(np.array([at]))
        return Running(float(self._speed(x)[0]), float(self._course.amplitude(x)[0]))

    def _place(self, at: int) -> float:
        """Return the sample of the loop that is played at a tactile sample; both on the common clock."""
        k = min(at - self._begin, len(self._at) - 1)
        return float(self._at[k]) + at - k

    def _shift(self, steady: LoopBank, own: float, present: float, n_samples: int) -> Signal:
        """Return how far the places in the loop are shifted (n_samples,), to continue from the present one."""
        if not self._course.goes_up:
            return np.full(n_samples, present - own)
        farthest, n = round(SEARCH_S * self.sample_rate_hz), round(_ALIKE_S * self.sample_rate_hz)
        first = math.floor(own) - farthest
        near = steady.taken(0, self._begin + first, 2 * farthest + n)
        heard = steady.taken(0, self._begin + math.floor(present), n)
        places = np.lib.stride_tricks.sliding_window_view(near, n, axis=0)
        size = np.sqrt((places**2).sum(axis=(1, 2))) + 1e-9
        likeness = np.einsum("pbn,nb->p", places, heard) / (size * (float(np.sqrt((heard**2).sum())) + 1e-9))
        shifts = first + np.arange(len(places)) + present % 1.0 - own
        shift = shifts[np.argmax(likeness - _NEARER * np.abs(shifts) / farthest)]
        x = np.minimum(np.arange(n_samples) / (self.end - self._begin), 1.0)
        return np.asarray(shift * (0.5 + 0.5 * np.cos(np.pi * x)))

    def _share(self, at: NDArray[np.int_]) -> Signal:
        """Return shares of the time (n,) at tactile samples (n,)."""
        return np.clip(self._from + (at - self._begin - self._lead) / self._lasts, self._from, 1.0)

    def _speed(self, x: Signal) -> Signal:
        left = (1.0 - x) / max(1.0 - self._from, 1e-9)
        return np.maximum(0.0, self._course.speed(x) + self._ahead * left)


def _between(samples: Block, at: NDArray[np.float64]) -> Block:
    """Return samples (n, n_bands) at fractional positions, one or more behind the first and two before the last.

    Interpolated by Lagrange's cubic. A straight line between two samples had images above 1 kHz, of -52 dB for 380 Hz.
    """
    below = np.floor(at).astype(np.intp)
    x: Block = (at - below).astype(np.float32)[:, None]
    before, after, later = x + 1, x - 1, x - 2
    sixth, half = np.float32(1 / 6), np.float32(0.5)
    found: Block = samples[below - 1] * (x * after * later * -sixth)
    found += samples[below] * (before * after * later * half)
    found += samples[below + 1] * (before * x * later * -half)
    found += samples[below + 2] * (before * x * after * sixth)
    return found
