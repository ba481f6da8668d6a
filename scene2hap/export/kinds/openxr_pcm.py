"""OpenXR, XR_FB_haptic_pcm: samples for controllers with a voice coil. Header and raw floats per channel."""

from __future__ import annotations

from scene2hap.common import checks
from scene2hap.errors import ConfigError
from scene2hap.export.protocol import Exported, file_name, json_bytes
from scene2hap.export.track import Channel, Track

BUFFER_SIZE = 4000
"""Most samples that a runtime stores; a longer signal is sent in parts of this length, appended."""


class OpenXrPcmExport:
    """Write samples for OpenXR as little-endian 32-bit floats.

    Parameters: sample_rate_hz : the rate from xrGetDeviceSampleRateFB of the runtime; 2,000 in Meta's sample program.
    Raises: ConfigError.
    """

    def __init__(self, sample_rate_hz: float = 2000.0) -> None:
        self.sample_rate_hz: float = checks.number(
            "sample_rate_hz", sample_rate_hz, "Hz", at_least=100.0, at_most=48_000.0, error=ConfigError
        )

    def export(self, track: Track) -> Exported:
        """Return a JSON file and a file of samples for each channel."""
        files: dict[str, bytes] = {}
        played = {}
        for name, channel in track.channels.items():
            samples = channel.at_rate(self.sample_rate_hz).astype("<f4")
            raw = file_name(track, name, ".f32")
            header = {
                "extension": "XR_FB_haptic_pcm",
                "sample_rate_hz": self.sample_rate_hz,
                "loop": channel.is_loop,
                "sample_count": len(samples),
                "buffer_size": BUFFER_SIZE,
                "samples": raw,
            }
            files[file_name(track, name, ".json")], files[raw] = json_bytes(header), samples.tobytes()
            played[name] = Channel(samples, self.sample_rate_hz, channel.is_loop)
        return Exported(files, played)
