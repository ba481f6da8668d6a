"""The source that always has an answer: procedural sounds, without network, weights or recordings."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass
from functools import partial

import numpy as np

from scene2hap import checks
from scene2hap.audio.clip import AudioClip, Credit
from scene2hap.audio.sources.synth.signals import SAMPLE_RATE_HZ, Take, unit_peak
from scene2hap.audio.sources.synth.vocabulary import Patch, patch_for
from scene2hap.errors import AudioError, ConfigError
from scene2hap.haptics import VibrationDescription

MAX_TAKES = 5
PEAK = 0.9


@dataclass(frozen=True)
class Synthesizer:
    """Makes up a sound for anything: five seconds, mono, 48 kHz, most of it where touch can feel it.

    The description's category and verb choose a voice, its size shapes frequencies, its intensity the brightness. Equal
    descriptions give equal samples, on every run. `takes` 1..5 is how many variants `find` returns.
    Raises: ConfigError: `takes` is not a whole number within 1..5.
    """

    takes: int = 1

    def __post_init__(self) -> None:
        takes = checks.number("takes", self.takes, "-", at_least=1, at_most=MAX_TAKES, error=ConfigError)
        if takes != int(takes):
            raise ConfigError(f"takes is {takes:g}; it must be a whole number.")
        object.__setattr__(self, "takes", int(takes))

    def find(self, description: VibrationDescription) -> list[AudioClip]:
        """`takes` variants, equally good. Raises: AudioError: intensity outside 0..1, or a negative size."""
        drive = checks.number("intensity", description.intensity, "-", at_least=0.0, at_most=1.0, error=AudioError)
        size = checks.vector("size_m", description.size_m, "m", size=3, at_least=0.0, error=AudioError)
        patch = patch_for(description.object_category, description.keywords, description.state)
        factor = patch.size_factor(max(size))
        return [
            _performed(patch, Take(_chance(description, index), drive, factor), description, index)
            for index in range(self.takes)
        ]


def _performed(patch: Patch, take: Take, description: VibrationDescription, index: int) -> AudioClip:
    y = patch.voice(take)
    voice = patch.voice.func if isinstance(patch.voice, partial) else patch.voice
    title = f"{description.object_category} ({voice.__name__.replace('_', ' ')}), take {index + 1}"
    credit = Credit(title, "scene2hap synthesizer", "CC0-1.0", query=description.keywords)
    return AudioClip((PEAK * unit_peak(y)).astype(np.float32), SAMPLE_RATE_HZ, credit)


def _chance(description: VibrationDescription, index: int) -> np.random.Generator:
    """Chance that depends on the words, the seed and the take alone; Python's own hash changes with every process."""
    words = (description.object_category, description.state, description.sentence, description.keywords)
    text = "\x1f".join((*words, str(description.seed), str(index)))
    return np.random.default_rng(int.from_bytes(hashlib.sha256(text.encode()).digest()[:16], "big"))
