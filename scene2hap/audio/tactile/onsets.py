"""Onsets: replace each sudden beginning by a short burst at a frequency that is felt well.

The energy of a tick lies at 3 to 10 kHz, which no actuator renders; its remainder after a band-pass is masked by hum.
Here the energies E of the whole sound and of its part above 1 kHz, in steps of 2.5 ms, are compared with their slow
means S:

    onset where E > 10 S in either      burst sqrt(2 (E_max - S)) hann(t / T) sin(2 pi f t),   T 8 ms (sharp) to 20 ms

The irregularity of a machine stays below that factor, and a steady sound is unchanged, bit for bit. The stage has a
latency of 10 ms, in which it measures the height of an onset.

If the whole sound is known, the level of the bed relative to it is known as well. Then the energy of a burst is the
energy that the bed is spared (at most 60 ms) times this ratio, so that nothing is lost between events and bed. The
latency is 80 ms.
"""

from __future__ import annotations

import math
from collections import deque
from typing import NamedTuple

import numpy as np
import scipy

from scene2hap.audio.tactile.stages import Signal, SosStage, Stage
from scene2hap.audio.tactile.step_energies import mean_squares
from scene2hap.compiled import compiled

STEP_S = 0.0025
LOOK = 4
"""Steps after an onset in which its height is measured."""
RISE = 10.0
"""Ratio of energy to its slow mean that makes an onset (tuned: ticks of a clock do, pulses of a chainsaw do not)."""
MEAN_S = 0.06
APART_S, LOUDER = 0.025, 4.0
"""Closer onsets [s] are one, unless the later has this many times the energy: a stroke may begin with a scrape."""
FAINTEST = 1e-4
"""Energy relative to the recent maximum below which nothing is an onset (-40 dB)."""
QUIETEST = 1e-7
"""Energy below which there is silence (-70 dB re full scale)."""
LATE_S = 5.0
SHARP_S, DULL_S = 0.008, 0.020
SPARED_S = 0.06
"""How long after an onset the bed's input is limited to the energy before it [s]; otherwise its filters would ring.
A later rise by `RISE` that is no onset of its own, as among dense ticks, ends this time: the bed renders it, if it
follows the level of the sound."""
LOWERED = 2.0
"""Ratio to the energy before an onset above which the bed's input is limited to that energy."""
SUSTAINED, AFTER = 0.5, (2, 4)
"""A sustained onset, like a syllable or a knock, keeps this share of its energy within these steps after its peak."""
TICKS_HZ = 1000.0
ABOVE_BED, AROUND_S = 8.0, 0.25
"""Largest ratio of a burst to the bed before it (18 dB), and the time over which that bed is measured [s]. A stronger
burst would use up the head-room that the bed needs to reach its level."""
TICK_ABOVE_BED = 3.0
"""Least ratio of a burst to the bed around it, if a hum hides a tick from the energy of the whole sound (10 dB)."""
NO_BED = 0.01
"""Ratio of bed to burst below which there is no bed, as between the ticks of a clock."""
_MEAN_SQUARE = 3.0 / 8.0
"""Mean square of the shape of a burst."""
WARM = round(MEAN_S / STEP_S)
"""Number of steps after which the mean of a sound is known."""
FORGET = float(np.exp(-STEP_S / LATE_S))
APART, SPARED = round(APART_S / STEP_S), round(SPARED_S / STEP_S)


class WithOnsets(Stage):
    """The bed of the sound without its onsets, plus a burst of `carrier_hz` for each onset.

    A bed that follows the level of the sound renders sustained onsets by itself. If the level of the bed relative to
    the sound is known (`bed_db`), a burst has the energy of its onset times that ratio.
    """

    def __init__(
        self,
        bed: Stage,
        carrier_hz: float,
        sample_rate_hz: float,
        *,
        bed_follows: bool = False,
        bed_db: float | None = None,
    ) -> None:
        self._bed, self._rate_hz = bed, sample_rate_hz
        self._share = None if bed_db is None else 10 ** (bed_db / 10)
        self.step: int = max(1, round(STEP_S * sample_rate_hz))
        ticks_hz = min(TICKS_HZ, 0.4 * sample_rate_hz)
        self._high = SosStage(scipy.signal.butter(2, ticks_hz, "highpass", fs=sample_rate_hz, output="sos"))
        self._waiting = np.empty(0)  # samples whose onsets are not decided
        self._detector, self._n_made = _OnsetDetector(spares_sustained=bed_follows), 0
        self._n_around = max(1, round(AROUND_S * sample_rate_hz))
        self._past = deque([np.zeros(self._n_around)])  # of the bed, in parts
        longest = max(1, round(DULL_S * sample_rate_hz))
        self._carrier = np.sin(2.0 * np.pi * carrier_hz / sample_rate_hz * np.arange(longest))
        self._due: list[_PendingOnset] = []
        self._bursts: list[tuple[int, Signal]] = []

    def run(self, x: Signal) -> Signal:
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

    def rest(self) -> Signal:
        """Return the last samples, as if silence followed."""
        n_left = len(self._waiting) % self.step
        parts = [self.run(np.zeros(self._detector.look * self.step))]
        parts.append(self._mixed(self._bed.run(self._waiting[:n_left])))
        return np.concatenate([*parts, self._mixed(self._bed.rest())])

    def _mixed(self, bed: Signal) -> Signal:
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

    def _burst(self, due: _PendingOnset, bed_before: Signal) -> Signal:
        n = round((SHARP_S + (DULL_S - SHARP_S) * due.left) * self._rate_hz)
        bed = float(max(bed_before.max(), -bed_before.min()))
        amplitude = math.sqrt(2.0 * due.height)
        if self._share is not None:
            least = min(amplitude, TICK_ABOVE_BED * bed) if due.is_hidden else 0.0
            energy = max(due.height, due.energy * self.step / (n * _MEAN_SQUARE))
            amplitude = max(least, math.sqrt(2.0 * self._share * energy))
        if bed > NO_BED * amplitude:
            amplitude = _limited(amplitude, bed)
        shape = 0.5 - 0.5 * np.cos(2.0 * np.pi / n * np.arange(n))
        burst: Signal = amplitude * shape * self._carrier[:n]
        return burst


def _limited(amplitude: float, bed: float) -> float:
    """Return the amplitude of a burst, limited by the bed around it; the limit gives way to a bed as weak as none."""
    excess = math.log(amplitude / (ABOVE_BED * bed)) if amplitude > 0.0 else 0.0
    if excess <= 0.0:
        return amplitude
    return ABOVE_BED * bed * math.exp(excess**2 / -math.log(NO_BED * ABOVE_BED))


class _PendingOnset(NamedTuple):
    """An onset whose burst is not made yet: begin [samples or steps], energy of its highest step, share of this energy
    after `LOOK` steps, sum of the energies that the bed is spared, and True if the energy of the whole sound hardly
    rises."""

    begin: int
    height: float
    left: float
    energy: float
    is_hidden: bool


@compiled
def followed(energies: Signal, memory: Signal, n_known: int) -> Signal:
    """Return the energies of two bands (2, n), with slow mean and recent maximum before each: (2, 3, n).

    Parameters: memory : slow mean and recent maximum after the n_known earlier steps (2, 2), updated by this function.
    """
    found = np.empty((2, 3, energies.shape[1]))
    found[:, 0] = energies
    for band, of_band in enumerate(energies.tolist()):
        (mean, loudest), before = memory[band].tolist(), []
        for n, energy in enumerate(of_band, n_known):
            before.append((mean, loudest))
            if n < WARM:
                mean += (energy - mean) / (n + 1)
            else:
                # The mean rises slowly in an onset; otherwise the next onset would be missed.
                mean += (min(energy, 8.0 * mean + QUIETEST) - mean) / WARM
            loudest = max(energy, FORGET * loudest)
        found[band, 1:] = np.reshape(before, (-1, 2)).T
        memory[band] = mean, loudest
    return found


@compiled
def onsets_among(
    steps: Signal, n: int, n_known: int, memory: Signal, spares_sustained: bool
) -> tuple[list[tuple[int, float, float]], Signal | None]:
    """Find the onsets that begin in the first n steps, and the attenuation of the bed's input after each.

    Parameters: steps : energy, slow mean and recent maximum of each step of sound and ticks (2, 3, m), where m exceeds
    n by the steps that measure an onset; n_known : number of earlier steps; memory : step of the last onset, energy of
    the sound before it, energy of the onset, and the least energy since, 0 once the bed is spared no longer (4,),
    updated by this function; spares_sustained : no burst for sustained onsets.
    Returns: onsets (step, energy, share of the energy after `LOOK` steps); amplitude of the bed's input (n,) [-], None
    if all are 1.
    """
    onsets, shares = [], np.ones(n)
    sound, ticks = steps
    last, before, height_before, lowest = memory.tolist()
    rising = (sound[0] > RISE * sound[1]) | (ticks[0] > RISE * ticks[1])
    for k in range(n):
        number = n_known + k
        # The beginning of a sound is no onset: its mean is not known yet.
        if rising[k] and number >= WARM:
            height, left, is_sustained = _highest(steps, k)
            since = number - last
            least = 0.0 if since >= APART else LOUDER * height_before
            if height > least and not (is_sustained and spares_sustained):
                # Between quick strokes the mean does not recover, so the energy before the first stroke is kept.
                before = float(sound[1, k]) if since >= SPARED else before
                last, height_before, lowest = number, height, np.inf
                onsets.append((k, height, left))
        energy, since = float(sound[0, k]), number - last
        if since > LOOK:
            rises_again = spares_sustained and since >= APART and energy > RISE * lowest
            lowest = 0.0 if rises_again else min(lowest, max(energy, QUIETEST))
        if since < SPARED and lowest > 0.0 and energy > LOWERED * before:
            shares[k] = (before / energy) ** 0.5
    memory[:] = last, before, height_before, lowest
    return onsets, shares if (shares < 1.0).any() else None


def _highest(bands: Signal, k: int) -> tuple[float, float, bool]:
    """Return the higher onset of both bands at a step: its energy (0 without an onset), the share of this energy after
    `LOOK` steps, and True if it is sustained."""
    found = 0.0, 0.0, False
    for band in bands:
        energy, mean, loudest = band[:, k].tolist()
        around = band[0, k : k + LOOK + 1]
        at = int(np.argmax(around))
        top = float(around[at])
        if energy > max(RISE * mean, QUIETEST, FAINTEST * loudest) and top - mean > found[0]:
            after = band[0, k + at + AFTER[0] : k + at + AFTER[1] + 1].max(initial=0.0)
            found = top - mean, min(float(around[LOOK]) / top, 1.0), bool(after > SUSTAINED * top)
    return found


class _OnsetDetector:
    """Finds onsets in the energies of the sound and of its ticks, block by block."""

    def __init__(self, *, spares_sustained: bool) -> None:
        self._spares_sustained = spares_sustained
        self._n_measuring = LOOK + AFTER[1] if spares_sustained else LOOK
        self.look = self._n_measuring + SPARED if spares_sustained else LOOK
        self.n_decided = 0
        self._steps = np.empty((2, 3, 0))  # energy, slow mean and recent maximum of sound and ticks
        self._shares = np.empty(0)  # of those of these steps that were searched for onsets
        self._found: deque[tuple[int, float, float]] = deque()  # onsets among them
        self._means = np.zeros((2, 2))
        self._memory = np.array([-float(SPARED), 0.0, 0.0, np.inf])

    @property
    def n_waiting(self) -> int:
        """The number of steps that are not decided."""
        return self._steps.shape[2]

    def decided(self, energies: Signal) -> tuple[list[_PendingOnset], Signal | None]:
        """Return the result of `onsets_among` for the steps that these energies (2, n) of sound and ticks decide."""
        found = followed(energies, self._means, self.n_decided + self.n_waiting)
        steps = np.concatenate([self._steps, found], axis=2)
        self._search(steps)
        n = max(0, steps.shape[2] - self.look)
        due = []
        while self._found and self._found[0][0] < n:
            onset = self._found.popleft()
            # A live stream waits less, and measures no energies.
            end = min(onset[0] + SPARED, len(self._shares), *(k for k, *_ in self._found))
            due.append(_measured(steps[0], self._shares, *onset, end))
        self._found = deque((k - n, height, left) for k, height, left in self._found)
        shares, self._shares = self._shares[:n], self._shares[n:]
        self._steps = steps[:, :, n:]
        self.n_decided += n
        return due, shares if (shares < 1.0).any() else None

    def _search(self, steps: Signal) -> None:
        """Find the onsets of those steps whose onsets can be measured."""
        first = len(self._shares)
        n = max(0, steps.shape[2] - self._n_measuring - first)
        rest = np.ascontiguousarray(steps[:, :, first:])
        onsets, shares = onsets_among(rest, n, self.n_decided + first, self._memory, self._spares_sustained)
        self._found += [(first + k, height, left) for k, height, left in onsets]
        self._shares = np.concatenate([self._shares, np.ones(n) if shares is None else shares])


def _measured(sound: Signal, shares: Signal, k: int, height: float, left: float, end: int) -> _PendingOnset:
    """Return an onset at step k of the sound (3, m), with the energy that the bed is spared until step `end`."""
    before, energies = float(sound[1, k]), sound[0, k:end]
    is_beds = (shares[k:end] == 1.0) & (energies > LOWERED * before)
    spared = float(np.where(is_beds, 0.0, np.maximum(energies - before, 0.0)).sum())
    is_hidden = float(sound[0, k : k + LOOK + 1].max()) <= RISE * before
    return _PendingOnset(k, height, left, spared, is_hidden=is_hidden)
