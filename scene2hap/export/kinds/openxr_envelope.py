"""OpenXR, XR_FB_haptic_amplitude_envelope: amplitudes at equal steps, for any controller. One file per channel."""

from __future__ import annotations

import numpy as np

from scene2hap.common import checks
from scene2hap.errors import ConfigError
from scene2hap.export.kinds.steps import amplitudes_at_steps, steps_as_clip
from scene2hap.export.protocol import Exported, file_name, json_bytes, nanoseconds
from scene2hap.export.track import Channel, Track

MAX_AMPLITUDES = 4000
"""Most amplitudes of one call (XR_MAX_HAPTIC_AMPLITUDE_ENVELOPE_SAMPLES_FB)."""


class OpenXrEnvelopeExport:
    """Write OpenXR calls with amplitudes, at most 4,000 each, to be made one after the other.

    Parameters: step_s : time between two amplitudes [s].
    Raises: ConfigError.
    """

    def __init__(self, step_s: float = 0.005) -> None:
        self.step_s: float = checks.number("step_s", step_s, "s", at_least=0.001, at_most=0.1, error=ConfigError)

    def export(self, track: Track) -> Exported:
        """Return one file for each channel."""
        files, played = {}, {}
        for name, channel in track.channels.items():
            # A whole number of equal steps, since a call has a duration and no step.
            n = max(1, round(channel.duration_s / self.step_s))
            step_s = channel.duration_s / n
            amplitudes = np.round(amplitudes_at_steps(channel, step_s)[:n], 6)
            document = {
                "extension": "XR_FB_haptic_amplitude_envelope",
                "loop": channel.is_loop,
                "calls": _calls(amplitudes.tolist(), channel),
            }
            files[file_name(track, name, ".json")] = json_bytes(document)
            played[name] = steps_as_clip(amplitudes, step_s, channel.duration_s)
        return Exported(files, played)


def _calls(amplitudes: list[float], channel: Channel) -> list[dict[str, object]]:
    n = len(amplitudes)
    edges = [nanoseconds(channel.duration_s * first / n) for first in [*range(0, n, MAX_AMPLITUDES), n]]
    return [
        {"duration_ns": edges[i + 1] - edges[i], "amplitudes": amplitudes[first : first + MAX_AMPLITUDES]}
        for i, first in enumerate(range(0, n, MAX_AMPLITUDES))
    ]
