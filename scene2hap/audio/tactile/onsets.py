"""Onsets apart from the bed: each sudden beginning becomes a short burst at a frequency that is felt well.

The energy of a tick lies at 3 to 10 kHz, where no actuator reaches; what a band-pass leaves of it drowns in hum. Here
the energy E of the whole sound, and that above 1 kHz, in steps of 2.5 ms, are held against their own slow means S:

    onset where E > 10 S in either      burst sqrt(2 (E_max - S)) hann(t / T) sin(2 pi f t),   T 8 ms (sharp) to 20 ms

A machine's unevenness stays within that factor, and a steady sound goes through untouched, bit for bit. To know how
high an onset rises, the stage holds back 10 ms.
"""

from __future__ import annotations

import numpy as np
from scipy.signal import butter

from scene2hap.audio.tactile.stages import Signal, SosStage, Stage

STEP_S = 0.0025
LOOK = 4
"""Steps after an onset in which its height is looked for."""
RISE = 10.0
"""Of energy over its slow mean, for an onset (10 dB; tuned: ticks of a clock pass, pulses of a chainsaw do not)."""
MEAN_S = 0.06
APART_S = 0.045
"""Onsets closer together are one."""
FAINTEST = 1e-4
"""Of the loudest of late, below which nothing is an onset (40 dB)."""
QUIETEST = 1e-7
"""Energy that is silence (-70 dB re full scale)."""
LATE_S = 5.0
SHARP_S, DULL_S = 0.008, 0.020
TICKS_HZ = 1000.0
ABOVE_BED, AROUND_S = 3.0, 0.25
"""A burst is at most so much stronger than the bed around it (10 dB): what is stronger takes the room in which the bed
is to reach its level."""
NO_BED = 0.01
"""Of a burst, below which a bed is none: between the ticks of a clock."""
_WARM = round(MEAN_S / STEP_S)


class WithOnsets:
    """A `Stage`: the bed through its own stages, plus a burst of `carrier_hz` for each onset."""

    def __init__(self, bed: list[Stage], carrier_hz: float, sample_rate_hz: float) -> None:
        self._bed, self._carrier_hz, self._rate_hz = bed, carrier_hz, sample_rate_hz
        self._step = max(1, round(STEP_S * sample_rate_hz))
        ticks_hz = min(TICKS_HZ, 0.4 * sample_rate_hz)
        self._high = SosStage(butter(2, ticks_hz, "highpass", fs=sample_rate_hz, output="sos"))
        self._bands = [_Rise(), _Rise()]
        self._apart = round(APART_S / STEP_S)
        self._heard = np.empty((2, 0))  # the sound and its ticks, not yet a whole step
        self._n_decided, self._last = 0, -self._apart
        self._held = np.empty(0)  # of the bed
        self._n_released = 0
        self._past = np.zeros(round(AROUND_S * sample_rate_hz))  # of the bed
        self._bursts: list[tuple[int, Signal]] = []

    def run(self, x: Signal) -> Signal:
        """What is decided of the samples so far."""
        self._heard = np.concatenate([self._heard, [x, self._high.run(x)]], axis=1)
        for stage in self._bed:
            x = stage.run(x)
        self._held = np.concatenate([self._held, x])
        n_steps = self._heard.shape[1] // self._step
        whole, self._heard = np.split(self._heard, [n_steps * self._step], axis=1)
        for band, energies in zip(self._bands, (whole.reshape(2, n_steps, self._step) ** 2).mean(axis=2), strict=True):
            band.energies += energies.tolist()
        while len(self._bands[0].energies) > LOOK:
            self._decide()
        return self._released(self._n_decided * self._step)

    def rest(self) -> Signal:
        """The last steps, in which no onset is looked for any more."""
        return self._released(self._n_released + len(self._held))

    def _decide(self) -> None:
        """Whether the oldest step that is not decided is an onset, and go on to the next."""
        if self._n_decided - self._last >= self._apart:
            height, left = max(band.height() for band in self._bands)
            if height > 0.0:
                self._last = self._n_decided
                self._bursts.append((self._n_decided * self._step, self._burst(height, left)))
        for band in self._bands:
            band.go_on()
        self._n_decided += 1

    def _burst(self, height: float, left: float) -> Signal:
        n = round((SHARP_S + (DULL_S - SHARP_S) * left) * self._rate_hz)
        t = np.arange(n)
        shape = 0.5 - 0.5 * np.cos(2 * np.pi * t / n)
        amplitude, bed = np.sqrt(2.0 * height), self._bed_around()
        if bed > NO_BED * amplitude:
            amplitude = min(amplitude, ABOVE_BED * bed)
        burst: Signal = amplitude * shape * np.sin(2 * np.pi * self._carrier_hz / self._rate_hz * t)
        return burst

    def _bed_around(self) -> float:
        """The bed's peak around the step that is decided."""
        here = self._n_decided * self._step - self._n_released
        n = len(self._past)
        around = np.concatenate([self._past, self._held])[here : here + n + (LOOK + 1) * self._step]
        return float(np.abs(around).max())

    def _released(self, end: int) -> Signal:
        n = min(end - self._n_released, len(self._held))
        if n <= 0:
            return np.empty(0)
        out, self._held = self._held[:n].copy(), self._held[n:]
        self._past = np.concatenate([self._past, out])[n:]
        begin, end = self._n_released, self._n_released + n
        for start, burst in self._bursts:
            first, last = max(start, begin), min(start + len(burst), end)
            if first < last:
                out[first - begin : last - begin] += burst[first - start : last - start]
        self._bursts = [one for one in self._bursts if one[0] + len(one[1]) > end]
        self._n_released = end
        return out


class _Rise:
    """The energies of steps that are not decided yet, and their slow mean before."""

    _FORGET = float(np.exp(-STEP_S / LATE_S))

    def __init__(self) -> None:
        self.energies: list[float] = []
        self._mean = self._loudest = 0.0
        self._n_known = 0

    def height(self) -> tuple[float, float]:
        """Energy of the onset that the first step is, and the share of it after `LOOK` steps; 0, 0 for none."""
        energy = self.energies[0]
        if self._n_known < _WARM or energy <= RISE * self._mean or energy <= max(QUIETEST, FAINTEST * self._loudest):
            return 0.0, 0.0
        top = max(self.energies[: LOOK + 1])
        return top - self._mean, min(self.energies[LOOK] / top, 1.0)

    def go_on(self) -> None:
        """Forget the first step. What a sound begins with is no onset: the mean is not known yet."""
        energy = self.energies.pop(0)
        if self._n_known < _WARM:
            self._n_known += 1
            self._mean += (energy - self._mean) / self._n_known
        else:
            # An onset raises the mean little by little, or the next one would be missed.
            self._mean += (min(energy, 8.0 * self._mean + QUIETEST) - self._mean) / _WARM
        self._loudest = max(energy, self._FORGET * self._loudest)
