"""Errors about files that cannot be read name the file once, and the reason in words."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from scene2hap.bundle.corrections import read_corrections
from scene2hap.errors import Scene2HapError, reason_of
from scene2hap.session.touch_track import TouchTrack


@pytest.mark.parametrize(
    ("read", "name"),
    [(TouchTrack.load, "touches.csv"), (read_corrections, "corrections.json")],
    ids=["touches", "corrections"],
)
def test_a_missing_file_is_named_once(tmp_path: Path, read: Callable[[Path], object], name: str) -> None:
    with pytest.raises(Scene2HapError) as caught:
        read(tmp_path / name)
    message = str(caught.value)
    assert message.count(name) == 1
    assert "No such file or directory" in message
    assert "Errno" not in message


def test_the_reason_of_an_error() -> None:
    assert reason_of(OSError(28, "No space left on device", "a.wav")) == "No space left on device"
    assert reason_of(OSError("the library is missing")) == "the library is missing"
    assert reason_of(ValueError("line 3")) == "line 3"
