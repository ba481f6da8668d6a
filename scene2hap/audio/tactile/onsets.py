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
_WARM = round(MEAN_S / STEP_S)


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


class _Rise:
    """Energies by step, with the slow mean and the recent maximum before each step."""

    _FORGET = float(np.exp(-STEP_S / LATE_S))

    def __init__(self) -> None:
        self.energies: list[float] = []
        self.means: list[float] = []
        self.loudests: list[float] = []
        self._mean = self._loudest = 0.0

    def follow(self, energies: list[float], n_known: int) -> None:
        """Append the energies of steps, after `n_known` earlier ones."""
        mean, loudest = self._mean, self._loudest
        for n, energy in enumerate(energies, n_known):
            self.means.append(mean)
            self.loudests.append(loudest)
            if n < _WARM:
                mean += (energy - mean) / (n + 1)
            else:
                # An onset raises the mean little by little, or the next one would be missed.
                most = 8.0 * mean + QUIETEST
                mean += ((energy if energy < most else most) - mean) / _WARM
            faded = self._FORGET * loudest
            loudest = energy if energy > faded else faded
        self._mean, self._loudest = mean, loudest
        self.energies += energies

    def rises(self, n: int) -> NDArray[np.bool_]:
        """Return a mask (n,) of the first n steps: True where the energy rises over the mean before it."""
        return np.array(self.energies[:n]) > RISE * np.array(self.means[:n])

    def drop(self, n: int) -> None:
        """Drop the first n steps."""
        del self.energies[:n], self.means[:n], self.loudests[:n]

    def goes_on(self, k: int, top: float) -> bool:
        """Return True if the onset at a step is sustained beyond its highest energy."""
        at = self.energies.index(top, k)
        return max(self.energies[at + _AFTER[0] : at + _AFTER[1] + 1]) > SUSTAINED * top


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
        n_known = self.n_decided + len(self._bands[0].energies)
        for band, of_band in zip(self._bands, energies, strict=True):
            band.follow(of_band.tolist(), n_known)
        n = max(0, len(self._bands[0].energies) - self._look)
        rises = [band.rises(n) for band in self._bands]
        found = []
        for k, is_rise in enumerate((rises[0] | rises[1]).tolist()):
            number = self.n_decided
            # The beginning of a sound is no onset: its mean is not known yet.
            step = self._onset(number, k) if is_rise and number >= _WARM else None
            energy = self._bands[0].energies[k]
            if number - self._last < self._SPARED and energy > 2.0 * self._before:
                step = (step or _Step(number))._replace(share=(self._before / energy) ** 0.5)
            if step is not None:
                found.append(step)
            self.n_decided += 1
        for band in self._bands:
            band.drop(n)
        return found

    def _onset(self, number: int, k: int) -> _Step | None:
        height, left, is_sustained = 0.0, 0.0, False
        for band in self._bands:
            if band.energies[k] > max(RISE * band.means[k], QUIETEST, FAINTEST * band.loudests[k]):
                top = max(band.energies[k : k + LOOK + 1])
                if top - band.means[k] > height:
                    height, left = top - band.means[k], min(band.energies[k + LOOK] / top, 1.0)
                    is_sustained = self._spares_sustained and band.goes_on(k, top)
        since = number - self._last
        if is_sustained or height <= (0.0 if since >= self._APART else LOUDER * self._height):
            return None
        # Between strokes in quick succession the mean has not recovered, so the energy before the first is kept.
        self._before = self._bands[0].means[k] if since >= self._SPARED else self._before
        self._last, self._height = number, height
        return _Step(number, height, left)
