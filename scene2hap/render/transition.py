"""Starts and stops of a loop: its speed and amplitude rise or fall over time.

    u(t) = integral of s           s speed re full, 0..1           a amplitude re full, 0..1

Assumed, with x the share of the time: a motor starts up with the speed s = x (2 - x), and coasts down with s = (1 -
x)^2. Its amplitude is a = s^2, the force of an unbalance. A source that does not spin keeps its pitch, and its
amplitude follows half a cosine. Recorded: a is the recorded amplitude. If the recording shows a speed, s is that speed;
else s = sqrt(a) for a source that spins. A stop fades over its first 10 ms from how the source ran to this course.

A transition begins or ends in phase with the loop itself, so the change between them is seamless. After its end it is
the loop, or silence, for as long as nothing replaces it: a game may not update for a while. A transition that begins
during another one continues from the present amplitude. If the curve has another speed there, the difference fades
over the rest of the transition. A stop also continues from the present place in the loop. A start has to end in phase,
so it continues from the place near its own that sounds most like the present one, and the difference fades as well:
two places out of phase would cancel each other while one fades into the other.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from scene2hap.audio.run_curve import RunCurve
from scene2hap.common.arrays import Floats
from scene2hap.render.loop_bank import CELL, Block, LoopBank, StoredLoop, read_between, stored_cell

LEAD_S = 0.03
"""Time that a decaying loop continues unchanged while it replaces the steady one [s]."""
SEARCH_S = 0.0125
"""Largest distance of that place from the start's own [s of the loop]: half a period of 40 Hz."""
_EASE_S = 0.01
"""Time over which a stop begins to slow down [s]. At once, a motor that stops within 0.1 s would click."""
_ALIKE_S = 0.025
"""Length over which two places are compared [s of the loop]."""
_NEARER = 0.1
"""Likeness that the farthest place must have more than the start's own [-], since a shift bends the pitch."""
_STEPS = 4096
_GRID = np.linspace(0.0, 1.0, _STEPS + 1)
"""Shares of the time at which courses are tabulated: 7 ms apart in the longest transition."""
_PLANNED = 20 * CELL
"""Samples of a transition whose places are computed at once: with up to 500 numbers, see `CELL`."""


class Running(NamedTuple):
    """Speed and amplitude of a source, both relative to steady running, 0..1 [-]."""

    speed: float
    amplitude: float


STEADY, STILL = Running(1.0, 1.0), Running(0.0, 0.0)


class TransitionCurve(NamedTuple):
    """The course of a transition: up or down, spinning or not, along a recorded curve or, for None, an assumed one."""

    goes_up: bool
    spins: bool
    curve: RunCurve | None = None

    def speed(self, x: Floats) -> Floats:
        """Return speeds (n,) [-] at shares x (n,) of the time."""
        recorded = None if self.curve is None else self.curve.speed_at(x)
        if recorded is not None:
            return recorded
        if not self.spins:
            return np.ones_like(x)
        if self.curve is not None:
            return np.sqrt(self.amplitude(x))
        return x * (2 - x) if self.goes_up else (1 - x) ** 2

    def amplitude(self, x: Floats) -> Floats:
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


class Transition:
    """A loop that starts or stops once; a `Slot`.

    Its course is tabulated when it is made, in the same time for any duration. Its samples are computed while it plays,
    one cell at a time, since those of 30 s take longer than a frame of a game.

    Parameters: steady : the bank of the loop itself; begin : tactile sample of the clock at which it starts;
        lasts_s : from standstill to full speed, or back [s]; since : speed and amplitude at its start; after : the
        transition that it interrupts, if any. From the sample `end` on, it is the steady loop or silence.
    """

    def __init__(
        self,
        steady: LoopBank,
        begin: int,
        lasts_s: float,
        course: TransitionCurve,
        since: Running,
        after: Transition | None = None,
    ) -> None:
        rate = steady.sample_rate_hz
        self._begin, self._lead = begin, 0 if course.goes_up else round(LEAD_S * rate)
        share, lasts = course.share(since), lasts_s * rate
        self._n = math.ceil((1 - share) * lasts)
        self.end: int = begin + self._lead + self._n
        x = np.minimum(share + _GRID * (self._n / lasts), 1.0)
        self._speed, self._amplitude = course.speed(x), course.amplitude(x)
        if not course.goes_up:
            eased = 0.5 - 0.5 * np.cos(np.pi * np.minimum(_GRID * max(1.0, self._n / (_EASE_S * rate)), 1.0))
            for values in (self._speed, self._amplitude):
                values[:] = values[0] + eased * (values - values[0])
        # At standstill and in steady running there is no difference of speed to fade.
        is_under_way = 0.0 < since.amplitude < 1.0
        if is_under_way:
            self._speed = np.maximum(0.0, self._speed + (since.speed - self._speed[0]) * (1.0 - _GRID))
        self._step = self._n / _STEPS
        self._played = np.concatenate([[0.0], np.cumsum((self._speed[1:] + self._speed[:-1]) * (self._step / 2))])
        # A start is in phase with the loop at its end, a stop at its beginning.
        self._from = self._n - float(self._played[-1]) if course.goes_up else self._lead * float(self._speed[0])
        self._shift = 0.0
        if after is not None and is_under_way:
            present = after._place(begin) - begin
            if course.goes_up:
                self._shift = self._nearest_alike(steady, self._from, present)
            else:
                self._from += present
        self._steady = steady.loops[0]
        self._planned = self.end
        self._below = np.zeros(0, dtype=np.intp)
        self._weights: Block = np.zeros((4, _PLANNED), dtype=np.float32)
        self._read: Block = np.zeros((steady.n_bands, CELL), dtype=np.float32)
        self._samples: Block = np.zeros((CELL, steady.n_bands), dtype=np.float32)
        self._cell = stored_cell(self._samples)
        self._afterwards = self._steady if course.goes_up else None

    def only(self, begin: int) -> StoredLoop | None:
        """Return a cell of the transition, valid until the next call, or from its end on the steady loop or silence."""
        if begin >= self.end:
            return self._afterwards
        if not self._planned <= begin <= self._planned + _PLANNED - CELL:
            self._plan(begin)
        own = slice(begin - self._planned, begin - self._planned + CELL)
        read_between(self._steady, self._below[own], self._weights[:, own], self._read, self._samples)
        return self._cell

    def running(self, at: int) -> Running:
        """Return speed and amplitude at a tactile sample."""
        k, part = self._knots(np.array([at - self._begin - self._lead]))
        return Running(float(_line(self._speed, k, part)[0]), float(_line(self._amplitude, k, part)[0]))

    def _plan(self, begin: int) -> None:
        """Compute which samples of the loop make up the next samples of the transition, and their weights."""
        at = np.arange(begin, begin + _PLANNED) - self._begin - self._lead
        k, part = self._knots(at)
        place, amplitude = self._places(at, k, part), _line(self._amplitude, k, part)
        below = np.floor(place)
        # Lagrange's cubic. A straight line between two samples had images above 1 kHz, of -52 dB for 380 Hz.
        x = place - below
        before, after, later = x + 1, x - 1, x - 2
        weights = (x * after * later / -6, before * after * later / 2, before * x * later / -2, before * x * after / 6)
        for own, weight in zip(self._weights, weights, strict=True):
            own[:] = weight * amplitude
        self._below, self._planned = below.astype(np.intp) + self._begin, begin

    def _knots(self, at: NDArray[np.int_]) -> tuple[NDArray[np.intp], Floats]:
        """Return the intervals of the tables in which samples after the lead are, and the parts of them passed."""
        j = np.minimum(np.maximum(at / max(self._step, 1e-9), 0.0), _STEPS)
        k = np.minimum(j.astype(np.intp), _STEPS - 1)
        return k, j - k

    def _places(self, at: NDArray[np.int_], k: NDArray[np.intp], part: Floats) -> Floats:
        """Return the samples of the loop that are played, counted from the beginning of the transition."""
        first = self._speed[k]
        within = part * (first + part / 2 * (self._speed[k + 1] - first)) * self._step
        # The speed is constant before and after the tables.
        before, behind = np.minimum(at, 0) * self._speed[0], np.maximum(at - self._n, 0) * self._speed[-1]
        place: Floats = self._from + self._played[k] + within + before + behind
        if self._shift:
            place += self._shift * (0.5 + 0.5 * np.cos((k + part) * (np.pi / _STEPS)))
        return place

    def _place(self, at: int) -> float:
        """Return the sample of the loop that is played at a tactile sample; both on the common clock."""
        after_lead = np.array([at - self._begin - self._lead])
        return self._begin + float(self._places(after_lead, *self._knots(after_lead))[0])

    def _nearest_alike(self, steady: LoopBank, own: float, present: float) -> float:
        """Return how far from its own place in the loop a start begins, to sound like the present place."""
        farthest, n = round(SEARCH_S * steady.sample_rate_hz), round(_ALIKE_S * steady.sample_rate_hz)
        first = math.floor(own) - farthest
        near = steady.taken(0, self._begin + first, 2 * farthest + n).astype(np.float64)
        heard = steady.taken(0, self._begin + math.floor(present), n).astype(np.float64)
        # The sum over time and bands of the product at each place, and the energy there.
        spectrum = np.fft.rfft(near, axis=0) * np.fft.rfft(heard, len(near), axis=0).conj()
        product = np.fft.irfft(spectrum.sum(axis=1), len(near))[: 2 * farthest + 1]
        energy = np.concatenate([[0.0], np.cumsum((near**2).sum(axis=1))])
        size = np.sqrt(np.maximum(0.0, energy[n:] - energy[:-n])) + 1e-9
        likeness = product / (size * (float(np.sqrt((heard**2).sum())) + 1e-9))
        shifts = first + np.arange(len(product)) + present % 1.0 - own
        return float(shifts[np.argmax(likeness - _NEARER * np.abs(shifts) / farthest)])


def _line(values: Floats, k: NDArray[np.intp], part: Floats) -> Floats:
    """Return values between the knots k and k + 1 of a table."""
    first = values[k]
    return first + part * (values[k + 1] - first)
