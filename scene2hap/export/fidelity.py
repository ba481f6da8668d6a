"""Errors of an export: differences between the played file and its original signal."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from scene2hap.audio.threshold import FREQUENCY_WEBER
from scene2hap.clips.haptic_clip import HapticClip
from scene2hap.clips.synthesis import synthesize
from scene2hap.common.arrays import Floats
from scene2hap.export.envelope import FLOOR_DB, amplitude_of, decibels
from scene2hap.export.frequency_ridge import ridge_hz
from scene2hap.export.track import ANALYSIS_HZ, Channel

Played = HapticClip | Channel


@dataclass(frozen=True)
class Fidelity:
    """Differences between an export, played by the rule of its format, and the original signal.

    Parameters: median_db, p95_db : of amplitude over time, median and 95th percentile [dB]; median_jnd, p95_jnd : of
        frequency, in just noticeable differences, None if the format has no frequency; amplitude_points,
        frequency_points, transients : their numbers in the file.
    """

    median_db: float
    p95_db: float
    median_jnd: float | None = None
    p95_jnd: float | None = None
    amplitude_points: int = 0
    frequency_points: int = 0
    transients: int = 0

    def __str__(self) -> str:
        text = f"amplitude within {self.median_db:.2f} dB (median), {self.p95_db:.2f} dB (95 %)"
        if self.median_jnd is not None and self.p95_jnd is not None:
            text += f"; frequency within {self.median_jnd:.2f} JND (median), {self.p95_jnd:.2f} JND (95 %)"
        return text


def fidelity(channel: Channel, played: Played) -> Fidelity:
    """Compare a channel with the signal that a player makes of its export.

    Times at which the channel is more than 40 dB below its peak are ignored, since they are not felt.
    """
    envelope = channel.envelope
    samples = played_samples(played)
    n = round(channel.duration_s * ANALYSIS_HZ)
    samples = np.pad(samples, (0, max(0, n - len(samples))))[:n]
    amplitude, times = amplitude_of(samples, ANALYSIS_HZ, is_loop=channel.is_loop)
    amplitude = np.interp(envelope.times_s, times, amplitude)
    peak = float(envelope.amplitude.max())
    is_felt = decibels(envelope.amplitude, peak) > FLOOR_DB
    if peak <= 0.0 or not is_felt.any():
        return Fidelity(0.0, 0.0)
    missed = np.abs(decibels(amplitude, peak) - decibels(envelope.amplitude, peak))[is_felt]
    jnds = _frequency_jnds(channel, played, samples)
    jnds = jnds[is_felt] if jnds is not None else None
    found = Fidelity(
        float(np.median(missed)),
        float(np.percentile(missed, 95)),
        float(np.median(jnds)) if jnds is not None else None,
        float(np.percentile(jnds, 95)) if jnds is not None else None,
    )
    if not isinstance(played, HapticClip):
        return found
    n_frequency = len(played.frequency) if played.frequency is not None else 0
    n_amplitude = len(np.unique(played.amplitude.times_s))
    return replace(found, amplitude_points=n_amplitude, frequency_points=n_frequency, transients=len(played.transients))


def played_samples(played: Played) -> Floats:
    """Return the played signal, at `ANALYSIS_HZ`."""
    return synthesize(played, ANALYSIS_HZ) if isinstance(played, HapticClip) else played.at_rate(ANALYSIS_HZ)


def _frequency_jnds(channel: Channel, played: Played, samples: Floats) -> Floats | None:
    times, own = channel.envelope.times_s, channel.envelope.frequency_hz
    if isinstance(played, Channel):
        other = ridge_hz(samples, ANALYSIS_HZ, times, is_loop=channel.is_loop)
    elif played.frequency is not None:
        other = played.frequency_hz(times)
    else:
        return None
    return np.asarray(np.abs(np.log(other / own)) / np.log1p(FREQUENCY_WEBER))
