"""Which of several candidate sounds an object gets.

The rule of the paper (Implementation, "Audio Retrieval/Generation"): cut silent ends; keep what is longer than 2.5 s;
drop what has a dynamic range above 5 dB, since it would not loop, raising that limit by 5 dB until something is left;
of the rest take the lowest spectral flatness, since harmonic sounds please more than noisy ones; normalise its peak.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from scene2hap.audio import analysis
from scene2hap.audio.clip import AudioClip
from scene2hap.errors import AudioError

MIN_DURATION_S = 2.5
DYNAMIC_RANGE_STEP_DB = 5.0

_NYQUIST_MARGIN = 0.45
"""Flatness is compared below this share of the lowest rate among the candidates, clear of resamplers' slopes."""


@dataclass(frozen=True)
class Candidate:
    """How one candidate fared: its length without silent ends, and, where that was enough, what was measured."""

    title: str
    duration_s: float
    dynamic_range_db: float | None
    flatness: float | None
    verdict: str


@dataclass(frozen=True)
class Choice:
    """The winner, without silent ends and with a peak of 1, and a row for every candidate in the order given."""

    winner: AudioClip
    rows: tuple[Candidate, ...]


def select_clip(clips: Sequence[AudioClip]) -> AudioClip:
    """The candidate that loops and pleases best, ready for use. Raises: AudioError: see `explain_choice`."""
    return explain_choice(clips).winner


def explain_choice(clips: Sequence[AudioClip]) -> Choice:
    """Choose as `select_clip` does, and tell why. Of equal candidates the steadier wins, then the earlier.

    Raises: AudioError: there are no candidates, or none is longer than `MIN_DURATION_S` without its silent ends.
    """
    trimmed = [analysis.trim_silence(clip.samples, clip.sample_rate_hz) for clip in clips]
    durations = [len(samples) / clip.sample_rate_hz for samples, clip in zip(trimmed, clips, strict=True)]
    eligible = [i for i, duration in enumerate(durations) if duration > MIN_DURATION_S]
    if not eligible:
        raise AudioError(_nothing_long_enough(clips, durations))
    band = (
        analysis.FLATNESS_BAND_HZ[0],
        min(analysis.FLATNESS_BAND_HZ[1], _NYQUIST_MARGIN * min(clips[i].sample_rate_hz for i in eligible)),
    )
    ranges = {i: analysis.dynamic_range_db(trimmed[i], clips[i].sample_rate_hz) for i in eligible}
    flatness = {i: analysis.spectral_flatness(trimmed[i], clips[i].sample_rate_hz, band_hz=band) for i in eligible}
    limit_db = DYNAMIC_RANGE_STEP_DB
    while min(ranges.values()) > limit_db:
        limit_db += DYNAMIC_RANGE_STEP_DB
    best = min((i for i in eligible if ranges[i] <= limit_db), key=lambda i: (flatness[i], ranges[i], i))

    def verdict(i: int) -> str:
        if durations[i] == 0.0:
            return "silent"
        if i not in ranges:
            return f"too short: not longer than {MIN_DURATION_S:g} s"
        if ranges[i] > limit_db:
            return f"not steady: dynamic range above {limit_db:g} dB"
        return "chosen" if i == best else "noisier than the chosen one"

    rows = tuple(
        Candidate(clip.credit.title, durations[i], ranges.get(i), flatness.get(i), verdict(i))
        for i, clip in enumerate(clips)
    )
    peak = np.abs(trimmed[best]).max()
    return Choice(replace(clips[best], samples=trimmed[best] / peak), rows)


def _nothing_long_enough(clips: Sequence[AudioClip], durations: Sequence[float]) -> str:
    if not clips:
        return "there is no candidate to choose from. Add a sound to the library or enable another audio source."
    longest = int(np.argmax(durations))
    return (
        f"none of {len(clips)} candidates is long enough: the longest, {clips[longest].credit.title!r}, lasts "
        f"{durations[longest]:.2f} s without its silent ends; it must be above {MIN_DURATION_S:g} s. Use longer sounds."
    )
