"""The contract of `AudioSource`."""

from __future__ import annotations

from contextlib import suppress

import numpy as np

from scene2hap.audio.clip import AudioClip
from scene2hap.audio.protocol import AudioSource
from scene2hap.audio.sources import SOURCES
from scene2hap.errors import AudioError, BackendUnavailable
from scene2hap.haptics import VibrationDescription
from scene2hap.plugins import lacking

PHONE = VibrationDescription(
    "smartphone", "ringing", "A smartphone buzzes on a table.", "smartphone buzzing", 0.6, (0.15, 0.07, 0.008), "glass"
)
_NOTHING_LIKE_IT = VibrationDescription("unknown", "on", "Wrzl brmft.", "wrzl brmft", 1.0, (1.0, 1.0, 1.0))


def check_audio_source(source: AudioSource, description: VibrationDescription = PHONE, *, repeats: bool = True) -> None:
    """Check a source against its protocol, with a sound that it has and one that no source has.

    Parameters: description : a sound that the source has; repeats : True if it returns the same answer twice, like a
    synthesizer with a seed, or a folder of files.
    Raises: AssertionError: names the broken promise.
    """
    problem = lacking(source, SOURCES.members)
    assert not problem, problem
    name, found = type(source).__name__, _clips(source, description)
    assert found, f"{name} finds nothing for {description.keywords!r}; give a description of what it has"
    for clip in found:
        assert np.isfinite(clip.samples).all(), f"{name} has a clip with a sample that is not finite"
        assert clip.samples.any(), f"{name} has a clip that is silent"
        assert clip.credit.title, f"{name} has a clip without a title in its credit"
    if repeats:
        again = _clips(source, description)
        same = len(again) == len(found) and all(
            np.array_equal(one.samples, other.samples) for one, other in zip(found, again, strict=True)
        )
        assert same, f"{name} finds something else for the same description; say so by repeats=False"
    with suppress(AudioError, BackendUnavailable):  # the protocol allows these errors
        _clips(source, _NOTHING_LIKE_IT)


def _clips(source: AudioSource, description: VibrationDescription) -> list[AudioClip]:
    by, found = f"{type(source).__name__}.find", source.find(description)
    assert isinstance(found, list), f"{by} gives a {type(found).__name__}; it must give a list, which may be empty"
    for clip in found:
        assert isinstance(clip, AudioClip), f"{by} gives a {type(clip).__name__}; it must give AudioClip alone"
    return found
