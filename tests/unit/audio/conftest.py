"""Real recordings, which are kept beside the repository and not in it."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from scene2hap.audio.clip import AudioClip
from scene2hap.audio.files import read_clip

_FOLDER = Path(__file__).parents[4] / "shared" / "audio"


@pytest.fixture
def recording() -> Callable[[str], AudioClip]:
    def read(name: str) -> AudioClip:
        if not (_FOLDER / name).is_file():
            pytest.skip(f"the recording {name} is not beside the repository (../shared/audio)")
        return read_clip(_FOLDER / name)

    return read
