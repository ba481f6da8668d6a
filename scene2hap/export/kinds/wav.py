"""WAV at any rate, for a sound card, an engine's audio, or another program. One file per track, a channel per hand."""

from __future__ import annotations

from scene2hap.audio.encoding import encoded
from scene2hap.common import checks
from scene2hap.errors import ConfigError
from scene2hap.export.protocol import Exported
from scene2hap.export.track import Track


class WavExport:
    """Write samples as 24-bit WAV. Parameters: sample_rate_hz : whole hertz. Raises: ConfigError."""

    def __init__(self, sample_rate_hz: int = 48_000) -> None:
        self.sample_rate_hz: int = checks.whole(
            "sample_rate_hz", sample_rate_hz, "Hz", at_least=100, at_most=384_000, error=ConfigError
        )

    def export(self, track: Track) -> Exported:
        """Return one file with all channels."""
        played = {name: one.resampled(self.sample_rate_hz) for name, one in track.channels.items()}
        content = encoded(track.frames(self.sample_rate_hz), self.sample_rate_hz, "PCM_24", is_loop=track.is_loop)
        return Exported({f"{track.name}.wav": content}, played)
