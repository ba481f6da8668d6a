"""DualSense on USB: a sound card of four channels. The third and fourth move the left and right actuator."""

from __future__ import annotations

import numpy as np

from scene2hap.audio.encoding import encoded
from scene2hap.export.protocol import Exported
from scene2hap.export.track import Track

SAMPLE_RATE_HZ = 48_000
_N_CHANNELS = 4
_ACTUATOR = {"left": 2, "right": 3}


class DualSenseExport:
    """Write a WAV of four channels, 16 bits, 48 kHz, for the DualSense's sound card.

    A track of one channel moves both actuators. If there is a left or right channel, others are left out; if there is
    none, the first two are left and right.
    """

    def export(self, track: Track) -> Exported:
        """Return one file with all channels."""
        places = {name: [_ACTUATOR[name]] for name in track.channels if name in _ACTUATOR}
        if not places:
            in_order = [[2], [3]] if len(track.channels) > 1 else [[2, 3]]
            places = dict(zip(track.channels, in_order, strict=False))
        at_rate = {name: track.channels[name].at_rate(SAMPLE_RATE_HZ) for name in places}
        frames = np.zeros((max(map(len, at_rate.values())), _N_CHANNELS))
        for name, samples in at_rate.items():
            frames[: len(samples), places[name]] = samples[:, None]
        played = {name: track.channels[name].resampled(SAMPLE_RATE_HZ) for name in places}
        return Exported({f"{track.name}.wav": encoded(frames, SAMPLE_RATE_HZ, "PCM_16", is_loop=track.is_loop)}, played)
