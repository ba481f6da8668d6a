"""Peak, envelope and dominant frequency of a stream, in constant memory."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
import scipy

from scene2hap.audio import analysis
from scene2hap.audio.levels import over_threshold_db
from scene2hap.audio.spectra.windows import hann
from scene2hap.audio.threshold import TACTILE_RANGE_HZ
from scene2hap.common.arrays import Floats32
from scene2hap.haptics import ActuatorProfile

Block = Floats32
"""Samples (n, channels)."""

SEGMENT_S = 2.5
"""Length of the pieces whose power spectra are averaged [s]; peaks are then accurate to 0.02 Hz."""
MOST_SEGMENTS = 4
"""Most pieces that are analysed, spread evenly over the sound."""
AT_ONCE = 4
"""Channels that are transformed together: as many as a processor's registers hold. Each takes a third of the time."""


class Meter:
    """Measures a stream in blocks of any size.

    Parameters: n_frames : expected number; n_columns : points of the envelope over these frames, 0 for no envelope.
    """

    def __init__(self, sample_rate_hz: int, channels: int, *, n_frames: int = 0, n_columns: int = 0) -> None:
        self.peak: float = 0.0
        self.n_frames: int = 0
        self.n_expected: int = max(1, n_frames)
        self.envelope: Floats32 = np.zeros(n_columns, dtype=np.float32)
        self._rate = sample_rate_hz
        size = scipy.fft.next_fast_len(round(SEGMENT_S * sample_rate_hz) or 2, real=True)
        n_segments = int(np.clip(self.n_expected // size, 1, MOST_SEGMENTS))
        self._starts = np.linspace(0, max(0, self.n_expected - size), n_segments).astype(int).tolist()
        self._segment = np.zeros((channels, size), dtype=np.float32)
        self._window = _window(size)
        self._filled = 0
        self._full: list[Floats32] = []
        self._power = np.zeros(size // 2 + 1)
        self._is_measured = False

    def add(self, block: Block) -> None:
        """Measure the next frames. A sample that is not finite makes the peak not finite."""
        if len(block) == 0:
            return
        # Not Python's max(), which ignores nan.
        self.peak = float(np.max([self.peak, block.max(), -block.min()]))
        if len(self.envelope):
            self._trace(block)
        at = self._skip(0, len(block))
        while at < len(block):
            n = min(len(block) - at, self._segment.shape[1] - self._filled)
            self._segment[:, self._filled : self._filled + n] = block[at : at + n].T
            self._filled += n
            at += n
            if self._filled == self._segment.shape[1]:
                self._full.append(self._segment * self._window)
                if len(self._full) * len(self._segment) >= AT_ONCE:
                    self._add_full()
                self._filled = 0
                self._starts.pop(0)
                at = self._skip(at, len(block))
        self.n_frames += len(block)

    def dominant_frequency_hz(self) -> float | None:
        """Return the highest peak of the mean power spectrum of all channels [Hz]; None for silence.

        A sound shorter than one segment is analysed whole.
        """
        return self._peak_hz(analysis.HEARD_RANGE_HZ, None)

    def most_felt_hz(self, actuator: ActuatorProfile) -> float | None:
        """Return the peak that is farthest over the threshold of touch [Hz], as `levels.most_felt_hz` of a loop."""
        return self._peak_hz(TACTILE_RANGE_HZ, lambda f: over_threshold_db(f, actuator))

    def _peak_hz(self, range_hz: tuple[float, float], weight_db: analysis.Weight | None) -> float | None:
        self._add_full()
        if not self._is_measured and self._filled > 1:
            rest = self._segment[:, : self._filled]
            rest -= rest.mean(axis=1, keepdims=True)
            rest *= _window(self._filled)
            self._full.append(self._segment)
            self._add_full()
        if not self._power[1:].any():
            return None
        low, high = range_hz
        bin_hz = self._rate / self._segment.shape[1]
        within_hz = low, min(high, 0.5 * self._rate)
        return analysis.peak_frequency_hz(np.sqrt(self._power), bin_hz, within_hz, weight_db)

    def _skip(self, at: int, end: int) -> int:
        """Return the index in the block at which the next segment begins or continues; `end` if none does."""
        if not self._starts:
            return end
        return at if self._filled else min(end, max(at, self._starts[0] - self.n_frames))

    def _add_full(self) -> None:
        if self._full:
            parts = scipy.fft.rfft(np.stack(self._full), axis=2).view(np.float32)  # real and imaginary in turn
            np.square(parts, out=parts)
            for power in (parts[:, :, ::2] + parts[:, :, 1::2]).sum(axis=1):
                self._power += power
            self._full, self._is_measured = [], True

    def _trace(self, block: Block) -> None:
        """Update the envelope with the largest absolute sample of each column's frames."""
        places = (self.n_frames + np.arange(len(block))) * len(self.envelope) // self.n_expected
        places = np.minimum(places, len(self.envelope) - 1)
        first = np.flatnonzero(np.diff(places, prepend=-1))
        largest = np.maximum.reduceat(np.abs(block).max(axis=1), first)
        np.maximum.at(self.envelope, places[first], largest)


@lru_cache(maxsize=2)
def _window(size: int) -> Floats32:
    return hann(size).astype(np.float32)
