"""Choose a sound among candidates.

The rule of the paper (Implementation, "Audio Retrieval/Generation"): cut silent ends; keep sounds longer than 2.5 s;
drop sounds with a dynamic range above 5 dB, which would not loop (raise that limit in steps of 5 dB until a sound is
left); choose the one with the lowest spectral flatness, since harmonic sounds please more than noisy ones; normalise
its peak.

A machine's start and stop at the ends are not part of the loop. Range and flatness are measured on the steady part, and
only this part is returned.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from scene2hap.audio import analysis
from scene2hap.audio.clip import AudioClip, Samples
from scene2hap.audio.recorded_runs import RecordedRuns, recorded_runs
from scene2hap.audio.run_curve import RunCurve
from scene2hap.audio.threshold import TACTILE_RANGE_HZ
from scene2hap.common import checks
from scene2hap.common.counted import counted
from scene2hap.common.printable import aligned
from scene2hap.errors import AudioError

MIN_DURATION_S = 2.5
DYNAMIC_RANGE_STEP_DB = 5.0
FADE_S = 0.005
"""Length of the fade at a cut [s]. A cut may be in the middle of noise that is 40 dB below the peak."""

_NYQUIST_MARGIN = 0.45
"""Share of the lowest rate among the candidates below which flatness is compared, to avoid resamplers' slopes."""


@dataclass(frozen=True)
class Candidate:
    """Scores and verdict of one candidate.

    `origin` is its source, `duration_s` its length without silent ends; the scores are None if it was too short.
    Dominant frequencies are the highest peak in the audible range, and in the range of touch.
    `is_chosen` and `verdict` state the outcome and its reason.
    """

    title: str
    origin: str
    duration_s: float
    dynamic_range_db: float | None
    flatness: float | None
    frequency_raw_hz: float | None
    frequency_tactile_hz: float | None
    is_chosen: bool
    verdict: str

    def cells(self) -> tuple[str, ...]:
        """Return the row as text, in the order of `COLUMNS`."""
        return (
            "->" if self.is_chosen else "",
            self.title,
            self.origin,
            f"{self.duration_s:.2f}",
            _shown(self.dynamic_range_db, ".1f"),
            _shown(self.flatness, ".2g"),
            _shown(self.frequency_raw_hz, ".1f"),
            _shown(self.frequency_tactile_hz, ".1f"),
            self.verdict,
        )


COLUMNS = ("", "sound", "origin", ">s", ">range dB", ">flatness", ">peak Hz", ">10-1000 Hz", "verdict")
"""Headings of `Candidate.cells`; a leading ">" sets a column to the right."""


@dataclass(frozen=True, eq=False)
class Choice:
    """The winner, and a row for every candidate in the order given; as text, a table of them.

    The winner has no silent ends, is faded over 5 ms at cuts, and has a peak of 1. `start_up` and `wind_down` are the
    curves of a machine's start and stop that were cut off, None for none.
    """

    winner: AudioClip
    rows: tuple[Candidate, ...]
    start_up: RunCurve | None = None
    wind_down: RunCurve | None = None

    def __str__(self) -> str:
        return "\n".join(aligned(COLUMNS, [row.cells() for row in self.rows]))


def select_clip(clips: Sequence[AudioClip]) -> AudioClip:
    """Return the steadiest and most tonal candidate, without its silent ends, normalised.

    The rule is the paper's (docs/audio.md). Raises: AudioError: see `explain_choice`.
    """
    return explain_choice(clips).winner


def explain_choice(clips: Sequence[AudioClip]) -> Choice:
    """Choose a candidate, and give the reasons. Of equal candidates the steadier wins, then the earlier.

    Raises: AudioError: there are no candidates, or none is longer than `MIN_DURATION_S` without its silent ends.
    """
    clips = checks.items("clips", clips, error=AudioError)
    wrong = [clip for clip in clips if not isinstance(clip, AudioClip)]
    if wrong:
        raise AudioError(f"clips has {checks.described(wrong[0])}; it must be a list of AudioClip.")
    spans = [analysis.sounding_span(clip.samples, clip.sample_rate_hz) for clip in clips]
    durations = [(end - first) / clip.sample_rate_hz for (first, end), clip in zip(spans, clips, strict=True)]
    eligible = [i for i, duration in enumerate(durations) if duration > MIN_DURATION_S]
    if not eligible:
        raise AudioError(_nothing_long_enough(clips, durations))
    band = (
        analysis.FLATNESS_BAND_HZ[0],
        min(analysis.FLATNESS_BAND_HZ[1], _NYQUIST_MARGIN * min(clips[i].sample_rate_hz for i in eligible)),
    )
    runs = {i: recorded_runs(clips[i].samples, clips[i].sample_rate_hz, clips[i].loop) for i in eligible}
    steady_spans = {
        i: clips[i].loop or (max(spans[i][0], runs[i].first), min(spans[i][1], runs[i].end)) for i in eligible
    }
    scores = {i: _Scores.of(clips[i].samples[slice(*steady_spans[i])], clips[i].sample_rate_hz, band) for i in eligible}
    limit_db = DYNAMIC_RANGE_STEP_DB
    while min(score.dynamic_range_db for score in scores.values()) > limit_db:
        limit_db += DYNAMIC_RANGE_STEP_DB
    steady = [i for i in eligible if scores[i].dynamic_range_db <= limit_db]
    best = min(steady, key=lambda i: (scores[i].flatness, scores[i].dynamic_range_db, i))

    def row(i: int) -> Candidate:
        credit, score = clips[i].credit, scores.get(i)
        return Candidate(
            title=credit.title,
            origin=credit.origin or credit.address or credit.author,
            duration_s=durations[i],
            **(score._asdict() if score else dict.fromkeys(_Scores._fields)),
            is_chosen=i == best,
            verdict=_verdict(durations[i], score, limit_db, scores[best], runs[i] if i == best else None),
        )

    winner, found = _ready(clips[best], *steady_spans[best]), runs[best]
    return Choice(winner, tuple(map(row, range(len(clips)))), found.start_up, found.wind_down)


class _Scores(NamedTuple):
    dynamic_range_db: float
    flatness: float
    frequency_raw_hz: float
    frequency_tactile_hz: float

    @classmethod
    def of(cls, samples: Samples, rate: int, band_hz: tuple[float, float]) -> _Scores:
        raw_hz, tactile_hz = analysis.dominant_frequencies_hz(samples, rate, analysis.HEARD_RANGE_HZ, TACTILE_RANGE_HZ)
        return cls(
            analysis.dynamic_range_db(samples, rate, dominant_hz=tactile_hz),
            analysis.spectral_flatness(samples, rate, band_hz=band_hz),
            raw_hz,
            tactile_hz,
        )


def _verdict(
    duration_s: float, score: _Scores | None, limit_db: float, best: _Scores, chosen: RecordedRuns | None
) -> str:
    """Return the outcome and its reason; `chosen` are the runs of the best candidate, None for any other."""
    if duration_s == 0.0:
        return "silent"
    if score is None:
        return f"too short: not longer than {MIN_DURATION_S:g} s"
    if score.dynamic_range_db > limit_db:
        return f"not steady: dynamic range above {limit_db:g} dB"
    if chosen is not None:
        ends = [("start", chosen.start_up), ("stop", chosen.wind_down)]
        shown = [f"{name} of {curve.lasts_s:.1f} s" for name, curve in ends if curve is not None]
        return f"chosen; has a {' and a '.join(shown)}" if shown else "chosen"
    return "noisier than the chosen one" if score.flatness > best.flatness else "as tonal as the chosen one"


def _ready(clip: AudioClip, first: int, end: int) -> AudioClip:
    """Return the samples from `first` to `end`, faded at cuts except those of a marked loop, with a peak of 1."""
    cut = clip.part(first, end)
    if cut.loop is not None:
        return replace(cut, samples=cut.samples / np.abs(cut.samples).max())
    samples = cut.samples.copy()
    n_fade = min(round(FADE_S * clip.sample_rate_hz), len(samples) // 2)
    rising = (0.5 - 0.5 * np.cos(np.pi * np.arange(n_fade) / max(1, n_fade))).astype(np.float32)
    if first > 0:
        samples[:n_fade] *= rising
    if end < len(clip.samples):
        samples[len(samples) - n_fade :] *= rising[::-1]
    return replace(clip, samples=samples / np.abs(samples).max())


def _shown(value: float | None, form: str) -> str:
    return "-" if value is None else format(value, form)


def _nothing_long_enough(clips: Sequence[AudioClip], durations: Sequence[float]) -> str:
    if not clips:
        return "there is no candidate to choose from. Add a sound to the library or enable another audio source."
    longest = int(np.argmax(durations))
    return (
        f"none of {counted(len(clips), 'candidate')} is long enough: the longest, {clips[longest].credit.title!r}, "
        f"lasts {durations[longest]:.2f} s without its silent ends; it must be above {MIN_DURATION_S:g} s. "
        "Use longer sounds."
    )
