"""Onsets: replace each sudden beginning by a short burst at a frequency that is felt well.

The energy of a tick lies at 3 to 10 kHz, which no actuator renders; its remainder after a band-pass is masked by hum.
Here the energies E of the whole sound and of its part above 1 kHz, in steps of 2.5 ms, are compared with their slow
means S:

    onset where E > 10 S in either      burst sqrt(2 (E_max - S)) hann(t / T) sin(2 pi f t),   T 8 ms (sharp) to 20 ms

The irregularity of a machine stays within that factor, and a steady sound is unchanged, bit for bit. The stage has a
latency of 10 ms, in which it measures the height of an onset.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.signal import butter

from scene2hap.audio.tactile.stages import Signal, SosStage, Stage, StepEnergies
from scene2hap.compiled import compiled

STEP_S = 0.0025
LOOK = 4
"""Steps after an onset in which its height is measured."""
RISE = 10.0
"""Ratio of energy to its slow mean that makes an onset (tuned: ticks of a clock do, pulses of a chainsaw do not)."""
MEAN_S = 0.06
APART_S, LOUDER = 0.025, 4.0
"""Onsets closer than this [s] are one, unless the later has this much more energy: a stroke may begin with a scrape."""
FAINTEST = 1e-4
"""Energy relative to the recent maximum below which nothing is an onset (-40 dB)."""
QUIETEST = 1e-7
"""Energy below which there is silence (-70 dB re full scale)."""
LATE_S = 5.0
SHARP_S, DULL_S = 0.008, 0.020
SPARED_S = 0.06
"""How long after an onset the bed's input is limited to the energy before it [s]; otherwise its filters would ring."""
SUSTAINED, _AFTER = 0.5, (2, 4)
"""An onset is sustained, like a syllable or a knock, if this share of its energy remains these steps after its peak."""
TICKS_HZ = 1000.0
ABOVE_BED, AROUND_S = 8.0, 0.25
"""Largest ratio of a burst to the bed around it (18 dB), and the extent of that [s]; a stronger burst would use up the
head-room in which the bed must reach its level."""
NO_BED = 0.01
"""Ratio of bed to burst below which there is no bed, as between the ticks of a clock."""
WARM = round(MEAN_S / STEP_S)
"""Number of steps after which the mean of a sound is known."""
FORGET = float(np.exp(-STEP_S / LATE_S))


class WithOnsets:
    """A `Stage`: the bed through its own stages, without onsets, plus a burst of `carrier_hz` for each onset.

    A bed that follows the level of the sound renders sustained onsets by itself.
    """

    def __init__(self, bed: Stage, carrier_hz: float, sample_rate_hz: float, *, bed_follows: bool = False) -> None:
        self._bed, self._carrier_hz, self._rate_hz = bed, carrier_hz, sample_rate_hz
        self._step = max(1, round(STEP_S * sample_rate_hz))
        ticks_hz = min(TICKS_HZ, 0.4 * sample_rate_hz)
        self._high = SosStage(butter(2, ticks_hz, "highpass", fs=sample_rate_hz, output="sos"))
        self._energies = StepEnergies(self._step), StepEnergies(self._step)  # of the sound and of its ticks
        self._waiting = np.empty(0)  # of the sound, not decided
        self._watch, self._n_released, self._n_made = _Watch(spares_sustained=bed_follows), 0, 0
        self._past = np.zeros(round(AROUND_S * sample_rate_hz))  # of the bed
        self._bursts: list[tuple[int, Signal]] = []

    def run(self, x: Signal) -> Signal:
        """Return the samples for which onsets are decided."""
        self._waiting = np.concatenate([self._waiting, x])
        energies = [of.next(heard) for of, heard in zip(self._energies, (x, self._high.run(x)), strict=True)]
        parts = []
        for step in self._watch.decided(energies):
            begin = step.number * self._step
            if step.height > 0.0:
                parts.append(self._felt(begin))
                self._bursts.append((begin, self._burst(step.height, step.left)))
            first = begin - self._n_released
            self._waiting[first : first + self._step] *= step.share
        parts.append(self._felt(self._watch.n_decided * self._step))
        return parts[0] if len(parts) == 1 else np.concatenate(parts)

    def rest(self) -> Signal:
        """Return the last steps, which are not searched for onsets."""
        return np.concatenate([self._mixed(self._bed.run(self._waiting)), self._mixed(self._bed.rest())])

    def _burst(self, height: float, left: float) -> Signal:
        n = round((SHARP_S + (DULL_S - SHARP_S) * left) * self._rate_hz)
        t = np.arange(n)
        shape = 0.5 - 0.5 * np.cos(2 * np.pi * t / n)
        amplitude, bed = np.sqrt(2.0 * height), float(np.abs(self._past).max())
        if bed > NO_BED * amplitude:
            amplitude = min(amplitude, ABOVE_BED * bed)
        burst: Signal = amplitude * shape * np.sin(2 * np.pi * self._carrier_hz / self._rate_hz * t)
        return burst

    def _felt(self, end: int) -> Signal:
        """Return the output up to a sample of the sound."""
        n = end - self._n_released
        x, self._waiting = self._waiting[:n], self._waiting[n:]
        self._n_released = end
        return self._mixed(self._bed.run(x))

    def _mixed(self, bed: Signal) -> Signal:
        """Return the next samples of the bed, with their bursts added."""
        begin, end, out = self._n_made, self._n_made + len(bed), bed
        self._n_made = end
        n_past = len(self._past)
        self._past = bed[-n_past:] if len(bed) >= n_past else np.concatenate([self._past[len(bed) :], bed])
        for start, burst in self._bursts:
            first, last = max(start, begin), min(start + len(burst), end)
            if first < last:
                out = out.copy() if out is bed else out
                out[first - begin : last - begin] += burst[first - start : last - start]
        self._bursts = [one for one in self._bursts if one[0] + len(one[1]) > end]
        return out


class _Step(NamedTuple):
    """A step during or after an onset: energy of the onset that begins in it, 0 for none; the share of that energy
    after `LOOK` steps; and the share of the sound that the bed gets."""

    number: int
    height: float = 0.0
    left: float = 0.0
    share: float = 1.0


@compiled
def followed(energies: Signal, mean: float, loudest: float, n_known: int) -> tuple[Signal, Signal, float, float]:
    """Return the slow mean and the recent maximum of energies (n,) before each of them (n,), and both at the end.

    Parameters: mean, loudest : both after the n_known earlier steps.
    """
    means, loudests = [], []
    for n, energy in enumerate(energies.tolist(), n_known):
        means.append(mean)
        loudests.append(loudest)
        if n < WARM:
            mean += (energy - mean) / (n + 1)
        else:
            # An onset raises the mean little by little, or the next one would be missed.
            mean += (min(energy, 8.0 * mean + QUIETEST) - mean) / WARM
        loudest = max(energy, FORGET * loudest)
    return np.array(means), np.array(loudests), mean, loudest


class _Rise:
    """Energies by step, with the slow mean and the recent maximum before each step (3, n)."""

    def __init__(self) -> None:
        self.steps = np.empty((3, 0))
        self._mean = self._loudest = 0.0

    def follow(self, energies: Signal, n_known: int) -> None:
        """Append the energies of steps, after `n_known` earlier ones."""
        means, loudests, self._mean, self._loudest = followed(energies, self._mean, self._loudest, n_known)
        self.steps = np.concatenate([self.steps, [energies, means, loudests]], axis=1)

    @property
    def rises(self) -> NDArray[np.bool_]:
        """A mask (n,) of the steps: True where the energy rises over the mean before it."""
        rises: NDArray[np.bool_] = self.steps[0] > RISE * self.steps[1]
        return rises

    def goes_on(self, k: int, top: float) -> bool:
        """Return True if the onset at a step is sustained beyond its highest energy."""
        at = k + int(np.argmax(self.steps[0, k:] == top))
        return float(self.steps[0, at + _AFTER[0] : at + _AFTER[1] + 1].max()) > SUSTAINED * top


class _Watch:
    """Finds onsets in the energies of the sound and of its ticks, step by step."""

    _APART, _SPARED = round(APART_S / STEP_S), round(SPARED_S / STEP_S)

    def __init__(self, *, spares_sustained: bool) -> None:
        self._bands, self._spares_sustained = (_Rise(), _Rise()), spares_sustained
        self._look = LOOK + _AFTER[1] if spares_sustained else LOOK
        self.n_decided, self._last = 0, -self._SPARED
        self._before = self._height = 0.0  # energy of the sound before the last onset, and of that

    def decided(self, energies: Sequence[Signal]) -> list[_Step]:
        """Return the steps during or after onsets that these energies (n,) of the sound and its ticks decide."""
        sound, ticks = self._bands
        n_known = self.n_decided + sound.steps.shape[1]
        for band, of_band in zip(self._bands, energies, strict=True):
            band.follow(of_band, n_known)
        n = max(0, sound.steps.shape[1] - self._look)
        is_rise = (sound.rises | ticks.rises)[:n]
        # The beginning of a sound is no onset: its mean is not known yet.
        is_rise[: max(0, WARM - self.n_decided)] = False
        rising, found, k = np.flatnonzero(is_rise), [], 0
        while k < n:
            number = self.n_decided + k
            is_spared = number - self._last < self._SPARED
            if is_rise[k] or is_spared:
                step = self._onset(number, k) if is_rise[k] else None
                energy = float(sound.steps[0, k])
                if number - self._last < self._SPARED and energy > 2.0 * self._before:
                    step = (step or _Step(number))._replace(share=(self._before / energy) ** 0.5)
                if step is not None:
                    found.append(step)
                k += 1
            else:
                later = int(np.searchsorted(rising, k))
                k = int(rising[later]) if later < len(rising) else n
        for band in self._bands:
            band.steps = band.steps[:, n:]
        self.n_decided += n
        return found

    def _onset(self, number: int, k: int) -> _Step | None:
        height, left, is_sustained = 0.0, 0.0, False
        for band in self._bands:
            energy, mean, loudest = band.steps[:, k].tolist()
            if energy > max(RISE * mean, QUIETEST, FAINTEST * loudest):
                around = band.steps[0, k : k + LOOK + 1].tolist()
                top = max(around)
                if top - mean > height:
                    height, left = top - mean, min(around[LOOK] / top, 1.0)
                    is_sustained = self._spares_sustained and band.goes_on(k, top)
        since = number - self._last
        if is_sustained or height <= (0.0 if since >= self._APART else LOUDER * self._height):
            return None
        # Between strokes in quick succession the mean has not recovered, so the energy before the first is kept.
        self._before = float(self._bands[0].steps[1, k]) if since >= self._SPARED else self._before
        self._last, self._height = number, height
        return _Step(number, height, left)
