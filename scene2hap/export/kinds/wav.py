"""WAV at any rate, for a sound card, an engine's audio, or another program. One file per track, a channel per hand."""

from __future__ import annotations

import io

import numpy as np
import soundfile
from numpy.typing import NDArray

from scene2hap import checks
from scene2hap.errors import ConfigError
from scene2hap.export.protocol import Exported
from scene2hap.export.track import Track


class WavExport:
    """Write samples as 24-bit WAV. Parameters: sample_rate_hz : whole hertz. Raises: ConfigError."""

    def __init__(self, sample_rate_hz: int = 48_000) -> None:
        self.sample_rate_hz = checks.whole(
            "sample_rate_hz", sample_rate_hz, "Hz", at_least=100, at_most=384_000, error=ConfigError
        )

    def export(self, track: Track) -> Exported:
        """Return one file with all channels."""
        channels = [one.at_rate(self.sample_rate_hz) for one in track.channels.values()]
        frames = np.zeros((max(map(len, channels)), len(channels)))
        for i, samples in enumerate(channels):
            frames[: len(samples), i] = samples
        played = {name: one.resampled(self.sample_rate_hz) for name, one in track.channels.items()}
        return Exported({f"{track.name}.wav": wav_bytes(frames, self.sample_rate_hz)}, played)


def wav_bytes(frames: NDArray[np.float64], sample_rate_hz: int, bits: int = 24) -> bytes:
    """Return frames (n, channels) in [-1, 1] as a WAV file of 16 or 24 bits; equal frames give equal bytes."""
    full = 2.0 ** (bits - 1)
    steps = np.minimum(np.rint(frames * full), full - 1).astype(np.int32) << (32 - bits)
    encoded = io.BytesIO()
    soundfile.write(encoded, steps, sample_rate_hz, subtype=f"PCM_{bits}", format="WAV")
    return encoded.getvalue()
