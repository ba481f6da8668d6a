"""Onsets: sudden beginnings in the energies of a sound and of its ticks.

The energy of a tick lies at 3 to 10 kHz, which no actuator renders; its remainder after a band-pass is masked by hum.
Here the energies E of the whole sound and of its part above 1 kHz, in steps of 2.5 ms, are compared with their slow
means S. There is an onset where E > 10 S in either. The irregularity of a machine stays below that factor.

The detector also tells by how much the input of the bed (the continuous part of a vibration) is lowered after an onset,
so that its filters do not ring on. `bursts` makes the vibration of the onsets.
"""

from __future__ import annotations

from collections import deque
from typing import NamedTuple

import numpy as np

from scene2hap.common.arrays import Floats
from scene2hap.compiled import compiled

STEP_S = 0.0025
"""Length of the steps in which energies are taken [s]."""
LOOK = 4
"""Steps after an onset in which its height is measured."""
RISE = 10.0
"""Ratio of energy to its slow mean that makes an onset (tuned: ticks of a clock do, pulses of a chainsaw do not)."""
MEAN_S = 0.06
"""Time of the slow mean [s]."""
APART_S, LOUDER = 0.025, 4.0
"""Closer onsets [s] are one, unless the later has this many times the energy: a stroke may begin with a scrape."""
FAINTEST = 1e-4
"""Energy relative to the recent maximum below which nothing is an onset (-40 dB)."""
QUIETEST = 1e-7
"""Energy below which there is silence (-70 dB re full scale)."""
LATE_S = 5.0
"""Time in which the recent maximum falls to 1/e [s]."""
SPARED_S = 0.06
"""How long after an onset the bed's input is limited to the energy before it [s]; otherwise its filters would ring.
A later rise by `RISE` that is no onset of its own, as among dense ticks, ends this time: the bed renders it, if it
follows the level of the sound."""
LOWERED = 2.0
"""Ratio to the energy before an onset above which the bed's input is limited to that energy."""
SUSTAINED, AFTER = 0.5, (2, 4)
"""A sustained onset, like a syllable or a knock, keeps this share of its energy within these steps after its peak. The
bed follows it, if the energy of the whole sound rises; a rumble may hide a knock from it."""
WARM = round(MEAN_S / STEP_S)
"""Number of steps after which the mean of a sound is known."""
FORGET = float(np.exp(-STEP_S / LATE_S))
APART, SPARED = round(APART_S / STEP_S), round(SPARED_S / STEP_S)


class PendingOnset(NamedTuple):
    """An onset whose burst is not made yet: begin [samples or steps], energy of its highest step, share of this energy
    after `LOOK` steps, sum of the energies that the bed is spared, and True if the energy of the whole sound hardly
    rises."""

    begin: int
    height: float
    left: float
    energy: float
    is_hidden: bool


@compiled
def followed(energies: Floats, memory: Floats, n_known: int) -> Floats:
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
    steps: Floats, n: int, n_known: int, memory: Floats, spares_sustained: bool
) -> tuple[list[tuple[int, float, float]], Floats | None]:
    """Find the onsets that begin in the first n steps, and the attenuation of the bed's input after each.

    Parameters: steps : energy, slow mean and recent maximum of each step of sound and ticks (2, 3, m), where m exceeds
    n by the steps that measure an onset; n_known : number of earlier steps; memory : step of the last onset, energy of
    the sound before it, energy of the onset, the least energy since, 0 once the bed is spared no longer, and begin
    [steps] and energy of the last sustained onset, 0 once the sound is 1 / `RISE` of it, and energy of the last hidden
    one, 0 once the ticks are 1 / `RISE` of it (7,), updated by this function; spares_sustained : no burst for sustained
    onsets, unless they are hidden.
    Returns: onsets (step, energy, share of the energy after `LOOK` steps); amplitude of the bed's input (n,) [-], None
    if all are 1.
    """
    onsets, shares = [], np.ones(n)
    sound, ticks = steps
    last, before, height_before, lowest, began, sustained, hidden = memory.tolist()
    rising = (sound[0] > RISE * sound[1]) | (ticks[0] > RISE * ticks[1])
    for k in range(n):
        number = n_known + k
        # The beginning of a sound is no onset: its mean is not known yet.
        if rising[k] and number >= WARM:
            height, left, is_sustained = _highest(steps, k)
            is_sustained = is_sustained and spares_sustained
            is_followed = is_sustained and (sustained > 0.0 or not _is_hidden(steps, k))
            since = number - last
            # A sustained sound may end before the mean has reached it. Its last steps are no onset.
            of_sustained = max(sustained if number - began >= APART else 0.0, hidden)
            least = LOUDER * (of_sustained if since >= APART else max(of_sustained, height_before))
            if is_followed:
                began, sustained = began if sustained else number, max(sustained, height)
            elif height > least:
                # Between quick strokes the mean does not recover, so the energy before the first stroke is kept.
                before = float(sound[1, k]) if since >= SPARED else before
                last, height_before, lowest = number, height, np.inf
                hidden = height if is_sustained else 0.0
                onsets.append((k, height, left))
        energy, since = float(sound[0, k]), number - last
        if RISE * energy < sustained:
            sustained = 0.0
        if since > LOOK and RISE * float(ticks[0, k]) < hidden:
            hidden = 0.0
        if hidden and not _is_hidden(steps, k):
            lowest = 0.0  # it has grown, as an "s" at the end of a vowel does, and the bed follows it
        if since > LOOK:
            rises_again = spares_sustained and since >= APART and energy > RISE * lowest
            lowest = 0.0 if rises_again else min(lowest, max(energy, QUIETEST))
        if since < SPARED and lowest > 0.0 and energy > LOWERED * before:
            shares[k] = (before / energy) ** 0.5
    memory[:] = last, before, height_before, lowest, began, sustained, hidden
    return onsets, shares if (shares < 1.0).any() else None


def _highest(bands: Floats, k: int) -> tuple[float, float, bool]:
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


def _is_hidden(steps: Floats, k: int) -> bool:
    """Return True if the energy of the whole sound hardly rises at an onset of steps (2, 3, m): no bed follows it.

    The mean may still be that of a vowel that has faded. So ticks that make up the sound alone are not hidden.
    """
    sound, ticks = steps[:, 0, k : k + LOOK + 1]
    return bool(sound.max() <= RISE * steps[0, 1, k] and RISE * (sound - ticks).sum() >= sound.sum())


class OnsetDetector:
    """Finds onsets in the energies of the sound and of its ticks, block by block."""

    def __init__(self, *, spares_sustained: bool) -> None:
        self._spares_sustained = spares_sustained
        self._n_measuring = LOOK + AFTER[1] if spares_sustained else LOOK
        self.look: int = self._n_measuring + SPARED if spares_sustained else LOOK
        self.n_decided: int = 0
        self._steps = np.empty((2, 3, 0))  # energy, slow mean and recent maximum of sound and ticks
        self._shares = np.empty(0)  # of those of these steps that were searched for onsets
        self._found: deque[tuple[int, float, float]] = deque()  # onsets among them
        self._means = np.zeros((2, 2))
        self._memory = np.array([-float(SPARED), 0.0, 0.0, np.inf, 0.0, 0.0, 0.0])

    @property
    def n_waiting(self) -> int:
        """The number of steps that are not decided."""
        return self._steps.shape[2]

    def decided(self, energies: Floats) -> tuple[list[PendingOnset], Floats | None]:
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
            due.append(_measured(steps, self._shares, *onset, end))
        self._found = deque((k - n, height, left) for k, height, left in self._found)
        shares, self._shares = self._shares[:n], self._shares[n:]
        self._steps = steps[:, :, n:]
        self.n_decided += n
        return due, shares if (shares < 1.0).any() else None

    def _search(self, steps: Floats) -> None:
        """Find the onsets of those steps whose onsets can be measured."""
        first = len(self._shares)
        n = max(0, steps.shape[2] - self._n_measuring - first)
        rest = np.ascontiguousarray(steps[:, :, first:])
        onsets, shares = onsets_among(rest, n, self.n_decided + first, self._memory, self._spares_sustained)
        self._found += [(first + k, height, left) for k, height, left in onsets]
        self._shares = np.concatenate([self._shares, np.ones(n) if shares is None else shares])


def _measured(steps: Floats, shares: Floats, k: int, height: float, left: float, end: int) -> PendingOnset:
    """Return an onset at step k of steps (2, 3, m), with the energy that the bed is spared until step `end`."""
    before, energies = float(steps[0, 1, k]), steps[0, 0, k:end]
    is_beds = (shares[k:end] == 1.0) & (energies > LOWERED * before)
    spared = float(np.where(is_beds, 0.0, np.maximum(energies - before, 0.0)).sum())
    return PendingOnset(k, height, left, spared, is_hidden=_is_hidden(steps, k))
