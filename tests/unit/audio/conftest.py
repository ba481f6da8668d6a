"""Sounds by name: those that the tests make, and recordings that are kept beside the repository and not in it."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from others import RECORDINGS, needed
from own_sounds import OWN_SOUNDS, own_sound
from scene2hap.audio.clip import AudioClip
from scene2hap.audio.files import read_clip


@pytest.fixture
def sound() -> Callable[[str], AudioClip]:
    return lambda name: own_sound(name) if name in OWN_SOUNDS else read_clip(needed(RECORDINGS / name))
