from __future__ import annotations

import os
from pathlib import Path

import pytest

from scene2hap.audio.conversion.writing import written_whole
from scene2hap.errors import AudioError


def test_failed_write_keeps_the_old_file_and_no_temporary_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "a.wav"
    path.write_bytes(b"before")

    def fail(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "replace", fail)
    said = r"a\.wav cannot be written: No space left on device\. Make room on its disk"
    with pytest.raises(AudioError, match=said), written_whole(path) as draft:
        draft.write_bytes(b"after")
    assert [child.name for child in tmp_path.iterdir()] == ["a.wav"]
    assert path.read_bytes() == b"before"


def test_a_missing_folder_is_named(tmp_path: Path) -> None:
    refused = pytest.raises(AudioError, match="Choose a folder that exists")
    with refused, written_whole(tmp_path / "absent" / "a.wav") as draft:
        draft.write_bytes(b"after")
