"""Synthesizer: a source of procedural sounds for any object, without network, weights or recordings."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass
from functools import cache, partial

import numpy as np

from scene2hap.audio.clip import AudioClip, Credit
from scene2hap.audio.sources.candidates import how_many
from scene2hap.audio.sources.synth.patch import Patch
from scene2hap.audio.sources.synth.signals import REFERENCE_MAINS_HZ, SAMPLE_RATE_HZ, Take, unit_peak
from scene2hap.audio.sources.synth.table import MOTOR, TABLE
from scene2hap.audio.sources.word_stems import noun_phrase, stems
from scene2hap.common import checks
from scene2hap.errors import AudioError, ConfigError
from scene2hap.haptics import VibrationDescription

PEAK = 0.9


@dataclass(frozen=True)
class Synthesizer:
    """Synthesize a sound for any object: five seconds, mono, 48 kHz, mostly at frequencies that touch can feel.

    The description's category and verb choose a voice. Its size sets the frequencies, its intensity the brightness and
    speed. Equal descriptions give equal samples, on every run. `takes` 1..5 is the number of variants that `find`
    returns; `mains_hz` is the mains frequency of the scene, 50 in most of the world, 60 in North America.
    Raises: ConfigError: `takes` is not a whole number within 1..5, or `mains_hz` not within 40..70.
    """

    takes: int = 1
    mains_hz: float = REFERENCE_MAINS_HZ

    def __post_init__(self) -> None:
        object.__setattr__(self, "takes", how_many("takes", self.takes))
        mains = checks.number("mains_hz", self.mains_hz, "Hz", at_least=40.0, at_most=70.0, error=ConfigError)
        object.__setattr__(self, "mains_hz", mains)

    def find(self, description: VibrationDescription) -> list[AudioClip]:
        """Return `takes` variants, equally good. Raises: AudioError: intensity outside 0..1, or a negative size."""
        drive = checks.number("intensity", description.intensity, "-", at_least=0.0, at_most=1.0, error=AudioError)
        size = checks.vector("size_m", description.size_m, "m", size=3, at_least=0.0, error=AudioError)
        patch = patch_for(description.object_category, description.keywords, description.state)
        factor = patch.size_factor(max(size))
        return [
            _performed(patch, Take(_chance(description, index), drive, factor, self.mains_hz), description, index)
            for index in range(self.takes)
        ]


def patch_for(category: str, *phrases: str) -> Patch:
    """Return the patch whose name fits a category best, given phrases that may have the verb; `MOTOR` if none fits.

    The order of preference: names that have the category's head noun, names that share another word, patches made for
    the verb, names that share more words.
    """
    nouns = noun_phrase(category)
    # A boiling frying pan does not fry: words of the name are no verbs.
    spoken = {stem for phrase in phrases for stem in stems(phrase)}.difference(nouns)
    best, best_fit = MOTOR, (False, False, False, 0)
    for name, verbs, patch in _rows():
        if verbs and not verbs & spoken:
            continue
        if not name <= set(nouns):
            continue
        fit = (bool(name.intersection(nouns[-1:])), bool(name), bool(verbs), len(name))
        if fit > best_fit:
            best, best_fit = patch, fit
    return best


@cache
def _rows() -> tuple[tuple[frozenset[str], frozenset[str], Patch], ...]:
    """Return one row for each name, in stems."""
    return tuple(
        (frozenset(stems(name)), frozenset(stems(verbs)), patch)
        for names, verbs, patch in TABLE
        for name in names.split(",")
    )


def _performed(patch: Patch, take: Take, description: VibrationDescription, index: int) -> AudioClip:
    y = patch.voice(take)
    if patch.rhythm is not None:
        y = patch.rhythm.applied(y, take)
    # Strokes are asymmetric. Their offset is neither heard nor felt, and would use up head-room.
    y = y - y.mean()
    voice = patch.voice.func if isinstance(patch.voice, partial) else patch.voice
    title = f"{description.object_category} ({voice.__name__.replace('_', ' ')}), take {index + 1}"
    credit = Credit(title, "scene2hap synthesizer", "CC0-1.0", query=description.keywords, origin="synth")
    return AudioClip((PEAK * unit_peak(y)).astype(np.float32), SAMPLE_RATE_HZ, credit)


def _chance(description: VibrationDescription, index: int) -> np.random.Generator:
    """Return a generator that depends only on words, seed and take; Python's own hash changes with every process."""
    words = (description.object_category, description.state, description.sentence, description.keywords)
    text = "\x1f".join((*words, str(description.seed), str(index)))
    return np.random.default_rng(
        int.from_bytes(hashlib.sha256(text.encode("utf-8", "surrogatepass")).digest()[:16], "big")
    )
