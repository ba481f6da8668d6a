"""DualSense on USB: a sound card of four channels. The third and fourth move the left and right actuator."""

from __future__ import annotations

import numpy as np

from scene2hap.audio.files import encoded
from scene2hap.export.protocol import Exported
from scene2hap.export.track import Track

SAMPLE_RATE_HZ = 48_000
_N_CHANNELS = 4
_ACTUATOR = {"left": 2, "right": 3}


class DualSenseExport:
    """Write a WAV of four channels, 16 bits, 48 kHz, for the DualSense's sound card.

    A track of one channel moves both actuators.
    """

    def export(self, track: Track) -> Exported:
        """Return one file with all channels. If there is a left or right channel, others are left out."""
        at_rate = {name: one.at_rate(SAMPLE_RATE_HZ) for name, one in track.channels.items()}
        hands = {name: samples for name, samples in at_rate.items() if name in _ACTUATOR}
        if not hands:
            only = next(iter(at_rate.values()))
            hands = {"left": only, "right": only}
        frames = np.zeros((max(map(len, hands.values())), _N_CHANNELS))
        for name, samples in hands.items():
            frames[: len(samples), _ACTUATOR[name]] = samples
        played = {
            name: one.resampled(SAMPLE_RATE_HZ)
            for name, one in track.channels.items()
            if name in hands or len(at_rate) == 1
        }
        return Exported({f"{track.name}.wav": encoded(frames, SAMPLE_RATE_HZ, "PCM_16")}, played)
