"""Short tones in place of synthesized sounds, for tests of bakes that look at no sound."""

from __future__ import annotations

from zlib import crc32

import numpy as np

from scene2hap import AudioClip, Credit
from scene2hap.audio.sources.synth import Synthesizer
from scene2hap.haptics import VibrationDescription

RATE_HZ = 8000
DURATION_S = 2.6  # a bake asks for more than 2.5
SYNTHESIZED = Synthesizer.find


def find(self: Synthesizer, description: VibrationDescription) -> list[AudioClip]:
    """Return tones that depend on the description, as those of `Synthesizer.find` do. Their loops take a fifth."""
    t = np.arange(round(DURATION_S * RATE_HZ)) / RATE_HZ
    words = f"{description.object_category}, {description.state}, {description.seed}"
    tone = 0.5 * np.sin(2 * np.pi * (80 + crc32(words.encode()) % 120) * t)
    credit = Credit(description.object_category, "short tones", "CC0-1.0", query=description.keywords, origin="synth")
    return [AudioClip(tone.astype(np.float32), RATE_HZ, credit)] * self.takes
