"""TextToAudio set up to run the fake generator, and checks of the files that a run leaves behind."""

from __future__ import annotations

import json
import os
import sys
from pathlib import Path
from typing import Any

import pytest

from scene2hap.audio.sources.text_to_audio import TextToAudio
from scene2hap.errors import BackendError
from scene2hap.haptics import VibrationDescription

GENERATOR = Path(__file__).with_name("fake_generator.py")
posix = pytest.mark.skipif(os.name != "posix", reason="process groups, links and pipes of POSIX")


def describe(sentence: str = "fan humming softly", **changes: Any) -> VibrationDescription:
    fields: dict[str, Any] = {"intensity": 0.5, "size_m": (0.3, 0.3, 0.1), "seed": 7} | changes
    return VibrationDescription("fan", "on", sentence, "fan humming", **fields)


def generator(tmp_path: Path, manner: str = "good", **settings: Any) -> TextToAudio:
    defaults = {"count": 2, "duration_s": 3.0, "timeout_s": 10.0, "cache": tmp_path / "cache"}
    return TextToAudio([sys.executable, "-S", str(GENERATOR), manner], **{**defaults, **settings})


def failed(tmp_path: Path, manner: str, **settings: Any) -> BackendError:
    with pytest.raises(BackendError) as caught:
        generator(tmp_path, manner, **settings).find(describe())
    assert_nothing_left(tmp_path)
    assert not list((tmp_path / "cache").rglob("*.json")), "nothing of it is kept"
    return caught.value


def assert_nothing_left(tmp_path: Path) -> None:
    assert list((tmp_path / "work").iterdir()) == []


def runs(tmp_path: Path) -> list[dict[str, Any]]:
    counter = tmp_path / "counter.jsonl"
    return [json.loads(line) for line in counter.read_text().splitlines()] if counter.exists() else []
