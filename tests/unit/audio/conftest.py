"""Sounds by name: synthetic ones made by the tests, and recordings in `../shared`."""

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
