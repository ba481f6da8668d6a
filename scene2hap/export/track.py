"""Vibration to export: a loop of a source, or the signals of all hands over time."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
import scipy

from scene2hap.clips.haptic_clip import HapticClip
from scene2hap.common import checks
from scene2hap.common.arrays import Floats
from scene2hap.common.calls import clear_construction
from scene2hap.errors import ExportError
from scene2hap.export.envelope import Envelope, analyse

ANALYSIS_HZ = 8000
"""Rate at which signals are analysed [Hz]; vibration above 1 kHz is not felt."""
MAX_TRACK_S = 600.0


@clear_construction
@dataclass(frozen=True, eq=False)
class Channel:
    """One actuator's signal (n_samples,) in [-1, 1], played once or, as a loop, endlessly.

    `clip` has its curves if a person drew them.
    Raises: ExportError: no samples, one that is not finite or beyond 1, or more than `MAX_TRACK_S`.
    """

    samples: Floats
    sample_rate_hz: float
    is_loop: bool = False
    clip: HapticClip | None = None

    def __post_init__(self) -> None:
        rate = checks.number(
            "sample_rate_hz", self.sample_rate_hz, "Hz", at_least=100.0, at_most=1e6, error=ExportError
        )
        samples = np.array(self.samples, dtype=np.float64)
        if samples.ndim != 1 or not samples.size:
            raise ExportError(f"samples has shape {samples.shape}; a channel is (n_samples,) with n_samples > 0.")
        if not (np.abs(samples) <= 1.0).all():
            first = int(np.argmin(np.abs(samples) <= 1.0))
            raise ExportError(f"samples[{first}] is {samples[first]:g}; it must be within 1 [-].")
        if len(samples) > MAX_TRACK_S * rate:
            raise ExportError(f"the signal lasts {len(samples) / rate:g} s; it must last at most {MAX_TRACK_S:g} s.")
        samples.flags.writeable = False
        object.__setattr__(self, "samples", samples)
        object.__setattr__(self, "sample_rate_hz", rate)

    @property
    def duration_s(self) -> float:
        """Length [s]."""
        return len(self.samples) / self.sample_rate_hz

    def at_rate(self, sample_rate_hz: float) -> Floats:
        """Return the signal at another rate, limited to [-1, 1].

        A loop is resampled as a periodic signal, to the nearest whole number of samples, so that it stays seamless.
        """
        if sample_rate_hz not in self._resampled:
            self._resampled[sample_rate_hz] = self._at_rate(sample_rate_hz)
        return self._resampled[sample_rate_hz]

    def resampled(self, sample_rate_hz: float) -> Channel:
        """Return the channel at another rate [Hz]; the channel itself if that is its own rate."""
        if sample_rate_hz == self.sample_rate_hz:
            return self
        return Channel(self.at_rate(sample_rate_hz), sample_rate_hz, self.is_loop)

    def _at_rate(self, sample_rate_hz: float) -> Floats:
        if sample_rate_hz == self.sample_rate_hz:
            return self.samples
        n = max(1, round(self.duration_s * sample_rate_hz))
        if self.is_loop:
            resampled = scipy.signal.resample(self.samples, n)
        else:
            # Padded by silence on both sides, since the periodic resampler would mix the end into the beginning.
            pad = max(1, round(0.05 * self.sample_rate_hz))
            padded = np.pad(self.samples, (pad, pad))
            n_padded = max(1, round(len(padded) / self.sample_rate_hz * sample_rate_hz))
            first = round(pad / self.sample_rate_hz * sample_rate_hz)
            resampled = scipy.signal.resample(padded, n_padded)[first : first + n]
            resampled = np.pad(resampled, (0, n - len(resampled)))
        return np.clip(np.asarray(resampled, dtype=np.float64), -1.0, 1.0)

    @cached_property
    def _resampled(self) -> dict[float, Floats]:
        return {}

    @cached_property
    def envelope(self) -> Envelope:
        """Amplitude, frequency and transients over time."""
        return analyse(self.at_rate(ANALYSIS_HZ), ANALYSIS_HZ, is_loop=self.is_loop)

    def envelope_over(self, smoothed_s: float) -> Envelope:
        """Return the envelope with its power smoothed over another time [s]."""
        if smoothed_s == self.envelope.smoothed_s:
            return self.envelope
        return self.envelope.smoothed_over(smoothed_s, self.at_rate(ANALYSIS_HZ), ANALYSIS_HZ)


@clear_construction
@dataclass(frozen=True, eq=False)
class Track:
    """The input of one export: a name, and the channels by actuator ("left", "right"), or one channel named ""."""

    name: str
    channels: Mapping[str, Channel] = field(default_factory=dict)

    def frames(self, sample_rate_hz: float) -> Floats:
        """Return all channels at another rate, (n_samples, n_channels); shorter ones end in silence."""
        channels = [one.at_rate(sample_rate_hz) for one in self.channels.values()]
        n = max(map(len, channels))
        return np.stack([np.pad(one, (0, n - len(one))) for one in channels], axis=1)

    @property
    def is_loop(self) -> bool:
        """True if all channels are loops."""
        return all(one.is_loop for one in self.channels.values())

    @property
    def duration_s(self) -> float:
        """Length of the longest channel [s]."""
        return max(one.duration_s for one in self.channels.values())
