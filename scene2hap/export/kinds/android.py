"""Android's VibrationEffect.createWaveform: amplitudes of 0 to 255 at steps of 10 ms. One file per channel."""

from __future__ import annotations

import numpy as np

from scene2hap.export.kinds.steps import amplitudes_at_steps, steps_as_clip
from scene2hap.export.protocol import Exported, file_name, json_bytes
from scene2hap.export.track import Track

STEP_S = 0.01
_FULL = 255


class AndroidExport:
    """Write timings, amplitudes and repeat of Android's call, in this order. The format has no frequency."""

    def export(self, track: Track) -> Exported:
        """Return one file for each channel."""
        files, played = {}, {}
        for name, channel in track.channels.items():
            amplitudes = np.rint(amplitudes_at_steps(channel, STEP_S) * _FULL)
            last_ms = max(1, round((channel.duration_s - STEP_S * (len(amplitudes) - 1)) * 1000))
            document = {
                "timings_ms": [round(STEP_S * 1000)] * (len(amplitudes) - 1) + [last_ms],
                "amplitudes": [int(value) for value in amplitudes],
                "repeat": 0 if channel.is_loop else -1,
            }
            files[file_name(track, name, ".json")] = json_bytes(document)
            played[name] = steps_as_clip(amplitudes / _FULL, STEP_S, channel.duration_s)
        return Exported(files, played)
