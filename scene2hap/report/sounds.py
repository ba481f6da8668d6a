"""Sounds and tactile loops for display and playback on a page: FLAC, waveform, spectrogram, spectrum."""

from __future__ import annotations

import base64
import io
from typing import Any

import numpy as np
import scipy
import soundfile
from numpy.typing import NDArray
from PIL import Image

from scene2hap.audio.clip import AudioClip
from scene2hap.audio.haptic_loop import HapticLoop
from scene2hap.audio.threshold import threshold_db

SOUND_RATE_HZ, TOUCH_RATE_HZ = 24_000, 8_000
"""Sample rates on the page: enough for sounds of machines, and the least rate that browsers accept."""
SOUND_TOP_HZ, TOUCH_TOP_HZ = 4_000.0, 1_000.0
"""Highest frequency of each spectrogram."""
COLUMNS = 600
_ROWS = 96
_RANGE_DB = 70.0
_FULL_SCALE = 32767
# Viridis at even steps (Smith and van der Walt, matplotlib 1.5, CC0). Colours between them are interpolated.
_VIRIDIS = np.array(
    [
        *((68, 1, 84), (72, 40, 120), (62, 74, 137), (49, 104, 142), (38, 130, 142)),
        *((31, 158, 137), (53, 183, 121), (110, 206, 88), (181, 222, 43), (253, 231, 37)),
    ],
    dtype=np.float64,
)


class LoopPairs:
    """Sounds and tactile loops of states, each once, since copies of an object share theirs."""

    def __init__(self) -> None:
        self.shown: list[dict[str, Any]] = []
        self._numbers: dict[tuple[int, int], int] = {}

    def number(self, loop: HapticLoop) -> int:
        """Return the number in `shown` of the loops of a state. Call it while a bundle holds them."""
        key = id(loop.audible.samples), id(loop.tactile.samples)
        if key not in self._numbers:
            self._numbers[key] = len(self.shown)
            self.shown.append(_pair(loop))
        return self._numbers[key]


def _pair(loop: HapticLoop) -> dict[str, Any]:
    """Return the sound and the tactile loop of a state, and the tactile spectrum with the threshold of touch."""
    return {
        "sound": _clip(loop.audible, SOUND_RATE_HZ, SOUND_TOP_HZ),
        "touch": _clip(loop.tactile, TOUCH_RATE_HZ, TOUCH_TOP_HZ),
        "spectrum": _spectrum(loop.tactile),
    }


def _clip(clip: AudioClip, rate_hz: int, top_hz: float) -> dict[str, Any]:
    samples = np.asarray(clip.samples, dtype=np.float64)
    return {
        "audio": f"data:audio/flac;base64,{base64.b64encode(_flac(samples, clip.sample_rate_hz, rate_hz)).decode()}",
        "rate_hz": rate_hz,
        "seconds": len(samples) / clip.sample_rate_hz,
        "wave": base64.b64encode(_wave(samples)).decode(),
        "columns": COLUMNS,
        "spectrogram": f"data:image/png;base64,{base64.b64encode(_spectrogram(samples, clip, top_hz)).decode()}",
        "spectrogram_hz": [0.0, top_hz],
    }


def _flac(samples: NDArray[np.float64], from_hz: float, to_hz: int) -> bytes:
    """Return a loop as FLAC at another rate. It is resampled as a periodic signal, so that it stays seamless."""
    n = max(2, round(len(samples) * to_hz / from_hz))
    there = samples if n == len(samples) else scipy.signal.resample(samples, n)
    file = io.BytesIO()
    peak = max(1.0, float(np.abs(there).max(initial=0.0)))
    whole = np.round(there / peak * _FULL_SCALE).astype(np.int16)
    soundfile.write(file, whole, to_hz, format="FLAC", subtype="PCM_16")
    return file.getvalue()


def _wave(samples: NDArray[np.float64]) -> bytes:
    """Return the lowest and the highest sample of each column as bytes, with 128 for 0."""
    edges = np.linspace(0, len(samples), COLUMNS + 1).astype(int)
    starts = np.minimum(edges[:-1], len(samples) - 1)
    lowest, highest = np.minimum.reduceat(samples, starts), np.maximum.reduceat(samples, starts)
    both = np.stack([lowest, highest], axis=1).ravel()
    return bytes(np.clip(np.round(both * 127.0) + 128.0, 1, 255).astype(np.uint8))


def _spectrogram(samples: NDArray[np.float64], clip: AudioClip, top_hz: float) -> bytes:
    """Return a PNG with time to the right, frequency upwards, and the strongest bin brightest."""
    size = min(len(samples), max(256, round(0.05 * clip.sample_rate_hz)))
    hz, _, found = scipy.signal.spectrogram(
        samples, clip.sample_rate_hz, nperseg=size, noverlap=size // 2, mode="magnitude"
    )
    levels = 20.0 * np.log10(np.maximum(found, 1e-9))
    wanted = np.linspace(0.0, top_hz, _ROWS)
    rows = np.array([np.interp(wanted, hz, column) for column in levels.T]).T[::-1]
    shade = np.clip((rows - rows.max() + _RANGE_DB) / _RANGE_DB, 0.0, 1.0) * (len(_VIRIDIS) - 1)
    steps = np.arange(len(_VIRIDIS))
    colours = np.stack([np.interp(shade, steps, _VIRIDIS[:, channel]) for channel in range(3)], axis=-1)
    file = io.BytesIO()
    Image.fromarray(colours.astype(np.uint8)).save(file, "PNG", optimize=True)
    return file.getvalue()


def _spectrum(clip: AudioClip) -> dict[str, list[float]]:
    """Return the tactile level in twelfths of octaves, and the threshold of touch there [dB re full scale]."""
    samples = np.asarray(clip.samples, dtype=np.float64)
    power = (np.abs(np.fft.rfft(samples)) / len(samples)) ** 2 * 4.0
    hz = np.fft.rfftfreq(len(samples), 1.0 / clip.sample_rate_hz)
    edges = 10.0 * 2.0 ** (np.arange(0, 81) / 12.0)
    total = np.concatenate(([0.0], np.cumsum(power)))
    places = np.searchsorted(hz, edges)
    in_band = total[places[1:]] - total[places[:-1]]
    middles = np.sqrt(edges[1:] * edges[:-1])
    level = 10.0 * np.log10(np.maximum(in_band, 1e-12))
    return {
        "hz": [round(float(value), 2) for value in middles],
        "touch_db": [round(float(value), 1) for value in level],
        "threshold_db": [round(float(value), 1) for value in threshold_db(middles)],
    }
