"""Bursts: each sudden beginning of a sound as a short pulse at a frequency that is felt well.

    burst sqrt(2 (E_max - S)) hann(t / T) sin(2 pi f t),   T 8 ms (sharp) to 20 ms, longer on a resonant actuator

E_max is the highest energy of the onset, S the slow mean before it (`onsets`). A steady sound is unchanged, bit for
bit. The stage has a latency of 10 ms, in which it measures the height of an onset.

If the whole sound is known, the level of the bed relative to it is known as well. Then the energy of a burst is the
energy that the bed is spared (at most 60 ms) times this ratio, so that nothing is lost between events and bed. The
latency is 80 ms.
"""

from __future__ import annotations

import math
from collections import deque

import numpy as np

from scene2hap.audio.second_order import high_pass
from scene2hap.audio.tactile.onsets import STEP_S, OnsetDetector, PendingOnset
from scene2hap.audio.tactile.stages import SosStage, Stage
from scene2hap.audio.tactile.step_energies import mean_squares
from scene2hap.common.arrays import Floats

TICKS_HZ = 1000.0
"""Lowest frequency of the part in which ticks are looked for [Hz]."""
SHARP_S, DULL_S = 0.008, 0.020
"""Duration of the burst of an onset that is over within 10 ms, and of one that keeps its energy so long [s]. A burst on
a resonant actuator is longer by the time that its motion needs to rise, at most by `DULL_S`."""
ABOVE_BED, AROUND_S = 8.0, 0.25
"""Largest ratio of a burst to the bed before it (18 dB), and the time over which that bed is measured [s]. A stronger
burst would use up the head-room that the bed needs to reach its level."""
TICK_ABOVE_BED = 3.0
"""Least ratio of a burst to the bed around it, if a hum hides a tick from the energy of the whole sound (10 dB)."""
NO_BED = 0.01
"""Ratio of bed to burst below which there is no bed, as between the ticks of a clock."""
_MEAN_SQUARE = 3.0 / 8.0
"""Mean square of the shape of a burst."""


class WithBursts(Stage):
    """The bed of the sound without its onsets, plus a burst of `carrier_hz` for each onset.

    A bed that follows the level of the sound renders sustained onsets by itself. If the level of the bed relative to
    the sound is known (`bed_db`), a burst has the energy of its onset times that ratio. Bursts are longer by
    `ringing_s`, for which the actuator rings, but at most by `DULL_S`.
    """

    def __init__(
        self,
        bed: Stage,
        carrier_hz: float,
        sample_rate_hz: float,
        *,
        bed_follows: bool = False,
        bed_db: float | None = None,
        ringing_s: float = 0.0,
    ) -> None:
        self._bed, self._rate_hz, self._ringing_s = bed, sample_rate_hz, min(ringing_s, DULL_S)
        self._share = None if bed_db is None else 10 ** (bed_db / 10)
        self.step: int = max(1, round(STEP_S * sample_rate_hz))
        self._high = SosStage(high_pass(min(TICKS_HZ, 0.4 * sample_rate_hz), sample_rate_hz))
        self._waiting = np.empty(0)  # samples whose onsets are not decided
        self._detector, self._n_made = OnsetDetector(spares_sustained=bed_follows), 0
        self._n_around = max(1, round(AROUND_S * sample_rate_hz))
        self._past = deque([np.zeros(self._n_around)])  # of the bed, in parts
        longest = max(1, round((DULL_S + self._ringing_s) * sample_rate_hz))
        self._carrier = np.sin(2.0 * np.pi * carrier_hz / sample_rate_hz * np.arange(longest))
        self._due: list[PendingOnset] = []
        self._bursts: list[tuple[int, Floats]] = []

    def run(self, x: Floats) -> Floats:
        """Return the samples for which onsets are decided."""
        self._waiting = np.concatenate([self._waiting, x])
        n_whole = len(self._waiting) // self.step
        new = self._waiting[self._detector.n_waiting * self.step : n_whole * self.step]
        if new.size == 0:
            return new
        first = self._detector.n_decided
        energies = np.array([mean_squares(new, self.step), mean_squares(self._high.run(new), self.step)])
        onsets, shares = self._detector.decided(energies)
        self._due += [one._replace(begin=(first + one.begin) * self.step) for one in onsets]
        n = (n_whole - self._detector.n_waiting) * self.step
        spared, self._waiting = self._waiting[:n], self._waiting[n:]
        if shares is not None:
            lowered = np.flatnonzero(shares < 1.0)
            spared.reshape(-1, self.step)[lowered] *= shares[lowered, None]
        return self._mixed(self._bed.run(spared))

    def rest(self) -> Floats:
        """Return the last samples, as if silence followed."""
        n_left = len(self._waiting) % self.step
        parts = [self.run(np.zeros(self._detector.look * self.step))]
        parts.append(self._mixed(self._bed.run(self._waiting[:n_left])))
        return np.concatenate([*parts, self._mixed(self._bed.rest())])

    def _mixed(self, bed: Floats) -> Floats:
        """Return the next samples of the bed, with their bursts added."""
        begin, end = self._n_made, self._n_made + len(bed)
        self._n_made = end
        self._past.append(bed)
        while self._due and self._due[0].begin < end:
            due = self._due.pop(0)
            at, n = due.begin - begin, self._n_around
            before = bed[at - n : at] if at >= n else np.concatenate(self._past)[at : at + n]
            self._bursts.append((due.begin, self._burst(due, before)))
        excess = len(bed)
        while excess >= len(self._past[0]):
            excess -= len(self._past.popleft())
        self._past[0] = self._past[0][excess:]
        out = bed.copy() if self._bursts else bed
        for start, burst in self._bursts:
            first, last = max(start, begin), min(start + len(burst), end)
            out[first - begin : last - begin] += burst[first - start : last - start]
        self._bursts = [one for one in self._bursts if one[0] + len(one[1]) > end]
        return out

    def _burst(self, due: PendingOnset, bed_before: Floats) -> Floats:
        n = round((SHARP_S + (DULL_S - SHARP_S) * due.left + self._ringing_s) * self._rate_hz)
        bed = float(max(bed_before.max(), -bed_before.min()))
        amplitude = math.sqrt(2.0 * due.height)
        if self._share is not None:
            least = min(amplitude, TICK_ABOVE_BED * bed) if due.is_hidden else 0.0
            energy = max(due.height, due.energy * self.step / (n * _MEAN_SQUARE))
            amplitude = max(least, math.sqrt(2.0 * self._share * energy))
        if bed > NO_BED * amplitude:
            amplitude = _limited(amplitude, bed)
        shape = 0.5 - 0.5 * np.cos(2.0 * np.pi / n * np.arange(n))
        burst: Floats = amplitude * shape * self._carrier[:n]
        return burst


def _limited(amplitude: float, bed: float) -> float:
    """Return the amplitude of a burst, limited by the bed around it; the limit gives way to a bed as weak as none."""
    excess = math.log(amplitude / (ABOVE_BED * bed)) if amplitude > 0.0 else 0.0
    if excess <= 0.0:
        return amplitude
    return ABOVE_BED * bed * math.exp(excess**2 / -math.log(NO_BED * ABOVE_BED))
