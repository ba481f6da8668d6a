"""Attacks: a sudden rise of the sound is felt about as clearly as it is heard.

The filters of the bed (the continuous part of a vibration) and the windows of its level take 1 to 4 dB from a sudden
rise. Touch notices a difference in level from 2.5 dB on, hearing from 1 dB on, and the vibration before a rise masks
the rise. So the whole vibration, bed and bursts, is lifted for the first 20 ms of an attack:

    lift = min(R_sound `JND`, `CLEAR`) / R_felt,   at least 1, at most `JND`

R is the ratio of the highest energy in 5 ms of the attack to the mean of the 50 ms before. There is an attack where the
energy of the sound exceeds this mean by `RISE`, as at an onset (`onsets`); the irregularity of a machine does not. An
attack may be sustained, as that of a syllable. A rise that is clear anyway, as that of the burst of a tick, is
unchanged, so that strokes keep their strengths. The stage has a latency of 20 ms.
"""

from __future__ import annotations

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from scene2hap.audio.tactile.following import faded, rising_over
from scene2hap.audio.tactile.onsets import QUIETEST, RISE, STEP_S
from scene2hap.audio.tactile.stages import Stage
from scene2hap.audio.tactile.step_energies import StepEnergies
from scene2hap.audio.threshold import LEVEL_JND_DB
from scene2hap.common.arrays import Floats

JND = 10 ** (LEVEL_JND_DB / 10)
"""Ratio of energies that touch just notices, and the largest lift. Only those of dense ticks that follow a pause are
lifted, and a larger lift would distort their envelope."""
CLEAR = 10**1.5
"""Rise that is clear without a lift (15 dB, six just noticeable differences; assumed)."""
BEFORE, LASTS = round(0.05 / STEP_S), round(0.02 / STEP_S)
"""Steps before an attack whose mean it exceeds (50 ms; assumed), and steps of the lift (20 ms: the longest burst)."""
APART = LASTS + 4
"""Least steps from one attack to the next; a lift ends before the next one begins."""


class EmphasizedAttacks(Stage):
    """A vibration whose rises are lifted where they are less clear than those of its sound.

    Parameters: felt : the stage that makes the vibration; step : samples of the steps in which energies are taken.
    """

    def __init__(self, felt: Stage, step: int) -> None:
        self._felt, self._step = felt, step
        self._of_sound, self._of_felt = StepEnergies(step), StepEnergies(step)
        # From `BEFORE` steps before the next one on. The beginning of a sound is no attack: its mean is not known.
        self._sound, self._made = np.full(BEFORE, np.inf), np.full(BEFORE, np.inf)
        self._waiting = np.empty(0)
        self._rising = rising_over(step)
        self._gains = np.ones(LASTS + 1)  # at the beginnings of the next steps
        self._since = APART  # steps since the last attack

    def run(self, x: Floats) -> Floats:
        """Return the samples whose attacks are known."""
        return self._emphasized(x, self._felt.run(x))

    def rest(self) -> Floats:
        """Return the last samples, as if silence followed."""
        left = self._felt.rest()
        n = len(self._waiting) + len(left)
        silence = np.zeros((LASTS + 2) * self._step)
        return self._emphasized(silence, np.concatenate([left, silence]))[:n]

    def _emphasized(self, x: Floats, y: Floats) -> Floats:
        self._waiting = np.concatenate([self._waiting, y])
        self._sound = np.concatenate([self._sound, self._of_sound.next(x)])
        self._made = np.concatenate([self._made, self._of_felt.next(y)])
        n = len(self._made) - BEFORE - LASTS
        if n <= 0:
            return y[:0]
        gains = np.concatenate([self._gains, np.ones(n)])
        for k in self._attacks(n):
            rise, felt = (_rise(energies[k : k + BEFORE + LASTS]) for energies in (self._sound, self._made))
            gains[k : k + LASTS] = min(max(min(rise * JND, CLEAR) / felt, 1.0), JND) ** 0.5
        out = self._waiting[: n * self._step]
        if (gains[: n + 1] != 1.0).any():
            out = faded(out, gains[: n + 1], self._rising)
        self._waiting, self._gains = self._waiting[n * self._step :], gains[n:]
        self._sound, self._made = self._sound[n:], self._made[n:]
        return out

    def _attacks(self, n: int) -> list[int]:
        """Return those of the n steps after the next one at which an attack begins; the gain rises one step earlier."""
        before = sliding_window_view(self._sound, BEFORE)[1 : n + 1].copy().mean(axis=1)  # a copy: sums in one order
        rising = 1 + np.flatnonzero(self._sound[BEFORE + 1 : BEFORE + 1 + n] > RISE * before + QUIETEST)
        found: list[int] = []
        last = -self._since
        for k in rising.tolist():
            if k - last >= APART:
                last = k
                found.append(k)
        self._since = n - last
        return found


def _rise(energies: Floats) -> float:
    """Return the ratio of the highest mean of two steps from `BEFORE` on to the mean of the steps before."""
    highest = 0.5 * float((energies[BEFORE:-1] + energies[BEFORE + 1 :]).max())
    return (highest + QUIETEST) / (float(energies[:BEFORE].mean()) + QUIETEST)
