"""Raw samples at any rate: little-endian 32-bit floats, channels interleaved, and a header. One pair per track."""

from __future__ import annotations

import numpy as np

from scene2hap.common import checks
from scene2hap.errors import ConfigError
from scene2hap.export.protocol import Exported, json_bytes
from scene2hap.export.track import Channel, Track


class PcmExport:
    """Write samples as raw floats. Parameters: sample_rate_hz [Hz]. Raises: ConfigError."""

    def __init__(self, sample_rate_hz: float = 8000.0) -> None:
        self.sample_rate_hz: float = checks.number(
            "sample_rate_hz", sample_rate_hz, "Hz", at_least=100.0, at_most=384_000.0, error=ConfigError
        )

    def export(self, track: Track) -> Exported:
        """Return a JSON file and a file of samples."""
        frames = track.frames(self.sample_rate_hz).astype("<f4")
        header = {
            "encoding": "float32, little-endian, channels interleaved",
            "sample_rate_hz": self.sample_rate_hz,
            "channels": [name or "vibration" for name in track.channels],
            "frame_count": len(frames),
            "loop": track.is_loop,
            "samples": f"{track.name}.f32",
        }
        played = {
            name: Channel(one.at_rate(self.sample_rate_hz).astype(np.float32), self.sample_rate_hz, one.is_loop)
            for name, one in track.channels.items()
        }
        return Exported({f"{track.name}.json": json_bytes(header), f"{track.name}.f32": frames.tobytes()}, played)
