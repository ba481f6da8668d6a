"""One-shot vibration: decaying sines that are added to the mix, once each.

The sines are computed when a burst starts, and summed while it plays. A scene without impacts costs nothing. Threads:
call `start` and `fade` on the game's thread or a worker, `add_to` on the audio thread; neither waits for the other.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Mapping, Sequence
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Samples = NDArray[np.float32]

ATTACK_S = 0.006
"""Length of a sine's attack [s], x - sin(2 pi x) / (2 pi). It rises from 10 to 90 % as fast as half a cosine of 5 ms,
and has at least 12 dB less energy above 1 kHz. Above 1.15 kHz the strongest impact has that of a step of at most -63 dB
of full scale. Assumed: too short to be felt."""
END_DB = -46.0
"""A wave ends at this level [dB], over such an attack reversed; full scale is 45 dB over the threshold."""
_STEP = 256
_STRETCH = 4096
"""Frames of a burst that are summed at a time."""
MOST_SUM = 0.95
"""Level up to which bursts fill an output, and from which sums are limited [-]."""
HEARD_S = 0.025
"""Time in which the level of an output is looked for before a burst [s]: half a period of 20 Hz."""
_AHEAD = 3
"""Times this time in which the peaks of bursts are looked for: sums of many waves beat."""
_NONE: Samples = np.empty(0, dtype=np.float32)
_FIRST_S, _FIRST_CYCLE_S = 0.06, 0.04
"""Time in which the peak of a sum is searched first, and end of the longest first cycle of a wave (30 Hz, with its
attack) [s]."""

LEAST_SUM = 0.25
"""Lower bound of the peak of a sum of waves with positive weights, relative to the largest weight [-]. They begin in
phase: the weakest sum that an optimiser found had 0.45."""


@lru_cache(maxsize=256)
def wave_of(frequency_hz: float, decay_s: float, sample_rate_hz: int) -> Samples:
    """Return a decaying sine (n_samples,) with a peak of 1, from 0 and back to 0. Cached, since an object has few."""
    n = round((ATTACK_S + decay_s * math.log(10 ** (-END_DB / 20))) * sample_rate_hz)
    per_frame = (2j * math.pi * frequency_hz - 1 / decay_s) / sample_rate_hz
    # exp of a sum is a product, so two short tables replace an exponential for each sample.
    coarse = np.exp(per_frame * _STEP * np.arange(-(-n // _STEP)))
    fine = np.exp(per_frame * np.arange(_STEP))
    # A product of matrices (n / step, 2) and (2, step), in single precision, since a strike waits for the result.
    tables = np.stack([coarse.real, coarse.imag], axis=1), np.stack([fine.imag, fine.real])
    wave: Samples = np.matmul(*(table.astype(np.float32) for table in tables)).ravel()[:n]
    x = np.arange(max(1, round(ATTACK_S * sample_rate_hz))) / (ATTACK_S * sample_rate_hz)
    edge = x - np.sin(2 * np.pi * x) / (2 * np.pi)
    wave[: len(edge)] *= edge
    wave[-len(edge) :] *= edge[::-1]
    wave /= max(wave.max(), -wave.min())
    wave.setflags(write=False)
    return wave


def summed(waves: Sequence[Samples], weights: Sequence[float]) -> Samples:
    """Return the weighted sum (n_longest,) of waves (n,) of any lengths."""
    total = np.zeros(max(map(len, waves)), dtype=np.float32)
    for wave, weight in zip(waves, weights, strict=True):
        total[: len(wave)] += np.float32(weight) * wave
    return total


def peak_of(
    waves: Sequence[Samples], weights: NDArray[np.float64], decays_s: NDArray[np.float64], sample_rate_hz: int
) -> float:
    """Return the greatest magnitude of `summed` waves that decay to 1/e within decays_s."""
    n, n_all = round(_FIRST_S * sample_rate_hz), max(map(len, waves))
    while True:
        peak = float(np.abs(summed([wave[:n] for wave in waves], weights.tolist())).max())
        # The peak of a wave is 1 and within its first cycle, so its envelope begins above 1.
        later = np.abs(weights) * np.exp((_FIRST_CYCLE_S - n / sample_rate_hz) / decays_s)
        if n >= n_all or later.sum() <= peak:
            return peak
        n *= 2


class Fade(NamedTuple):
    """Fades out over `n_frames` from a frame of the session's clock on."""

    begin: int
    n_frames: int

    @property
    def end(self) -> int:
        """The first frame of silence."""
        return self.begin + self.n_frames

    def shares(self, position: int, n_frames: int) -> Samples:
        """Return the factors of frames from `position` on (n_frames,) [-]."""
        x = np.clip((position - self.begin + np.arange(n_frames)) / max(1, self.n_frames), 0.0, 1.0)
        return (0.5 + 0.5 * np.cos(np.pi * x)).astype(np.float32)


class PlannedBurst:
    """Waves (n,) of any lengths that are played once, from a frame of the session's clock on.

    They are summed a stretch at a time while they play: summing half a second takes too long for a frame of a game.
    Parameters: weights : of each wave, by the token of each output that feels the burst.
    """

    def __init__(self, begin: int, waves: Sequence[Samples], weights: Mapping[int, Sequence[float]]) -> None:
        self.begin = begin
        self._waves, self._weights = waves, weights
        self.n_frames: int = max(map(len, waves), default=0)
        # By token: the first frame of the latest stretch, and its samples.
        self._stretches: dict[int, tuple[int, Samples]] = {}
        self.fade: Fade | None = None
        self.is_fitted: bool = False

    @property
    def end(self) -> int:
        """The first frame after its waves, or after its fade."""
        end = self.begin + self.n_frames
        return end if self.fade is None else min(end, self.fade.end)

    def delayed(self, begin: int) -> PlannedBurst:
        """Return the same burst from a later frame on."""
        return PlannedBurst(begin, self._waves, self._weights)

    def fit(self, rooms: Mapping[int, float], n_ahead: int) -> None:
        """Make the burst weaker at each output that its first frames would fill beyond its room [-]."""
        self.is_fitted = True
        weights = dict(self._weights)
        for token in weights.keys() & rooms.keys():
            stretch = summed([wave[: max(n_ahead, _STRETCH)] for wave in self._waves], weights[token])
            peak = float(np.abs(stretch).max(initial=0.0))
            if peak > rooms[token]:
                share = rooms[token] / peak
                weights[token] = [share * weight for weight in weights[token]]
                stretch *= np.float32(share)
            self._stretches[token] = 0, stretch
        self._weights = weights

    def samples(self, token: int, begin: int, end: int) -> Samples | None:
        """Return the samples of an output from `begin` to before `end`, or fewer; None for one without the burst."""
        if token not in self._weights:
            return None
        first, stretch = self._stretches.get(token, (0, _NONE))
        if begin < first or min(end, self.n_frames) > first + len(stretch):
            first, last = begin, max(end, begin + _STRETCH)
            stretch = summed([wave[first:last] for wave in self._waves], self._weights[token])
            self._stretches[token] = first, stretch
        return stretch[begin - first : end - first]


class Bursts:
    """All bursts that wait or play.

    Where an output is so loud that the sum would be limited, which clicks, a burst begins weaker.
    Parameters: n_heard : frames in which the level of the mix is looked for before a burst; 0 leaves bursts as they
        are.
    """

    def __init__(self, n_heard: int = 0) -> None:
        self._incoming: deque[PlannedBurst | Fade] = deque()
        self._playing: list[PlannedBurst] = []
        self._n_heard, self._n_ahead = n_heard, _AHEAD * n_heard
        # The last frames of the mix without bursts (n_heard, n_outputs), and the tokens of the columns.
        self._heard: Samples = np.zeros((n_heard, 0), dtype=np.float32)
        self._outputs: tuple[int, ...] = ()

    @property
    def are_silent(self) -> bool:
        """True if no burst waits or plays."""
        return not self._playing and not self._incoming

    @property
    def n_playing(self) -> int:
        """Number of bursts that wait or play."""
        return len(self._playing) + len(self._incoming)

    def start(self, burst: PlannedBurst) -> None:
        """Play a burst from its frame on, or from the next frame if that is past."""
        self._incoming.append(burst)

    def fade(self, fade: Fade) -> None:
        """Fade out the bursts that were started before, and remove them."""
        self._incoming.append(fade)

    def hear(self, mix: Samples, outputs: Sequence[int]) -> None:
        """Remember the end of a mix without bursts (n_frames, n_outputs), after `add_to`, for later bursts."""
        if self._n_heard:
            self._arrange(outputs)
            self._heard = np.concatenate([self._heard[len(mix) :], mix[-self._n_heard :]])

    def _arrange(self, outputs: Sequence[int]) -> None:
        """Give the remembered frames the columns of these outputs; those of a new one are silent."""
        if self._outputs == (now := tuple(outputs)):
            return
        before, self._heard = self._heard, np.zeros((self._n_heard, len(now)), dtype=np.float32)
        for column, token in enumerate(now):
            if token in self._outputs:
                self._heard[:, column] = before[:, self._outputs.index(token)]
        self._outputs = now

    def _rooms(self, mix: Samples, others: Samples, first: int, outputs: Sequence[int]) -> dict[int, float]:
        """Return the room [-] at each output for a burst that begins at a frame of a mix, beside other bursts."""
        n = self._n_heard
        if not n:
            return {}
        self._arrange(outputs)
        before = np.concatenate([self._heard[first:], mix[max(0, first - n) : first]])
        levels = np.abs(before).max(axis=0) + np.abs(others[first : first + self._n_ahead]).max(axis=0)
        return dict(zip(outputs, np.maximum(MOST_SUM - levels, 0.0).tolist(), strict=True))

    def add_to(self, mix: Samples, position: int, outputs: Sequence[int]) -> None:
        """Add to a mix (n_frames, n_outputs) that begins at a frame; `outputs` are the tokens of its columns."""
        while self._incoming:
            one = self._incoming.popleft()
            if isinstance(one, PlannedBurst):
                self._playing.append(one.delayed(max(one.begin, position)))
                continue
            for burst in self._playing:
                burst.fade = burst.fade or one
        n_frames, end = len(mix), position + len(mix)
        starts = any(not burst.is_fitted and burst.begin < end for burst in self._playing)
        # A burst that begins is fitted to how the others go on after this mix.
        n_summed = n_frames + self._n_ahead if starts else n_frames
        total = np.zeros((n_summed, len(outputs)), dtype=np.float32)
        for burst in self._playing:
            first = max(0, burst.begin - position)
            if first >= n_frames:
                continue
            if not burst.is_fitted:
                burst.fit(self._rooms(mix, total, first, outputs), self._n_ahead)
            for channel, token in enumerate(outputs):
                begin = position + first - burst.begin
                part = burst.samples(token, begin, begin + n_summed - first)
                if part is not None:
                    share = 1.0 if burst.fade is None else burst.fade.shares(position + first, len(part))
                    total[first : first + len(part), channel] += part * share
        mix += total[:n_frames]
        self._playing = [burst for burst in self._playing if burst.end > end]
