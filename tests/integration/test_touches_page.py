"""The tracks of docs/touches.md fit the built-in kitchen, whose objects they name."""

import re
import warnings
from pathlib import Path

import pytest

from scene2hap import HapticSession, MemorySink, SceneWarning, TouchTrack, play_track

PAGE = Path(__file__).parents[2] / "docs" / "touches.md"


@pytest.mark.parametrize("form", ["json", "csv"])
def test_hands_feel_the_kitchen_along_the_tracks_of_the_page(kitchen_bundle: Path, tmp_path: Path, form: str) -> None:
    (block,) = re.findall(rf"```{form}\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL)
    (tmp_path / f"touches.{form}").write_text(block, encoding="utf-8")
    track = TouchTrack.load(tmp_path / f"touches.{form}")
    sink = MemorySink()
    with warnings.catch_warnings():
        warnings.simplefilter("error", SceneWarning)  # such as a point off its object
        with HapticSession(kitchen_bundle, sink=sink) as session:
            play_track(session, track, sink)
    assert track.duration_s == 6.0
    assert abs(sink.samples[:, 0]).max() > 0.01
