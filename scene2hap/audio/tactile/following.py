"""A bed that rises and falls with the whole sound, and not by itself.

A narrow band of a steady noise has an envelope of its own, as beats have that of few partials: a fan whose level stays
within 1 dB would surge by 6 dB. With the levels L of sound and bed in 60 ms, and M the mean of their difference over
two seconds, in which loud places count for more:

    difference d = L_bed - L_sound        gain -(d - M) + sign(d - M) `FREE_DB`   where |d - M| > `FREE_DB`, else 0 dB

What stays within `FREE_DB` goes through untouched, bit for bit. To know a level the stage holds back 40 ms.
"""

from __future__ import annotations

import numpy as np
from scipy.signal import lfilter

from scene2hap.audio.tactile.stages import Signal, Stage, StepEnergies

STEP_S = 0.01
FREE_DB = 0.5
"""The range of what is felt exceeds that of the sound by at most twice as much; touch notices 2.5 dB."""
MOST_LIFTED_DB, MOST_LOWERED_DB = 15.0, 20.0
"""What is lifted by more is mostly noise; assumed."""
_STEPS = 6
_MEAN_S = 2.0
_NOTHING = 1e-12
"""Energy below which there is neither sound nor bed (-120 dB re full scale)."""


class Following:
    """A `Stage`: a bed held to the level of the sound that it is made of."""

    def __init__(self, bed: Stage, sample_rate_hz: float) -> None:
        self._bed = bed
        self._step = max(1, round(STEP_S * sample_rate_hz))
        self._waiting = np.empty(0)
        self._heard = StepEnergies(self._step), StepEnergies(self._step)
        self._energies = np.zeros((2, _STEPS // 2))  # of sound and bed, by steps, from half a window before
        window = np.hanning(_STEPS + 2)[1:-1]
        self._window = window / window.sum()
        self._forget = float(np.exp(-STEP_S / _MEAN_S))
        self._means = np.zeros((2, 1))
        self._gain: float | None = None  # where the next step begins

    def run(self, x: Signal) -> Signal:
        """The samples whose level is known by now."""
        return self._followed(x, self._bed.run(x))

    def rest(self) -> Signal:
        """The last samples, after which there is silence."""
        left = self._bed.rest()
        parts = [self._followed(np.zeros(len(left)), left)] if left.size else []
        n_waiting, n_after = len(self._waiting), (_STEPS // 2 + 2) * self._step
        silence = np.zeros(n_after)
        parts.append(self._followed(silence, silence)[:n_waiting])
        return np.concatenate(parts)

    def _followed(self, x: Signal, y: Signal) -> Signal:
        self._waiting = np.concatenate([self._waiting, y]) if self._waiting.size else y
        energies = [of.next(part) for of, part in zip(self._heard, (x, y), strict=True)]
        self._energies = np.concatenate([self._energies, energies], axis=1)
        n = self._energies.shape[1] - _STEPS + 1
        if n < 1:
            return np.empty(0)
        gains = self._gains(n)
        self._energies = self._energies[:, n:]
        if self._gain is not None:
            gains = np.concatenate([[self._gain], gains])
        self._gain = float(gains[-1])
        return self._released(gains)

    def _gains(self, n: int) -> Signal:
        """The gain at the beginnings of n steps (n,), each in the middle of a window."""
        # Sums of shifted rows, since those of a convolution depend on how a sound is cut.
        around = sum(w * self._energies[:, k : k + n] for k, w in enumerate(self._window))
        share = [1.0 - self._forget], [1.0, -self._forget]
        means, self._means = lfilter(*share, around, axis=1, zi=self._means)
        now, usual = (10.0 * np.log10((e[1] + _NOTHING) / (e[0] + _NOTHING)) for e in (around, means))
        beyond = now - usual
        beyond -= np.clip(beyond, -FREE_DB, FREE_DB)
        gains: Signal = 10.0 ** (np.clip(-beyond, -MOST_LOWERED_DB, MOST_LIFTED_DB) / 20.0)
        return gains

    def _released(self, gains: Signal) -> Signal:
        """The steps between gains (n,), n - 1 of them, each from one gain to the next."""
        n = (len(gains) - 1) * self._step
        y, self._waiting = self._waiting[:n], self._waiting[n:]
        rising = np.arange(self._step) / self._step
        ramp = (gains[1:] - gains[:-1])[:, None] * rising
        ramp += gains[:-1, None]
        felt = ramp.reshape(-1)
        felt *= y
        return felt
