from __future__ import annotations

import logging

import numpy as np
import pytest

from scene2hap.audio.clip import AudioClip, Credit
from scene2hap.audio.sources.chain import SourceWarning, gather
from scene2hap.errors import AudioError, BackendUnavailable
from scene2hap.haptics import VibrationDescription

DESCRIPTION = VibrationDescription("fan", "on", "fan hums", "fan humming", 0.5, (0.3, 0.3, 0.1))


def clip(title: str, seconds: float = 3.0, silent_s: float = 0.0) -> AudioClip:
    samples = np.concatenate([np.sin(np.arange(round(seconds * 1000))), np.zeros(round(silent_s * 1000))])
    return AudioClip(samples.astype(np.float32), 1000, Credit(title, "me", "CC0-1.0"))


class Shelf:
    def __init__(self, *clips: AudioClip) -> None:
        self.clips = clips
        self.asked = 0

    def find(self, description: VibrationDescription) -> list[AudioClip]:
        self.asked += 1
        return list(self.clips)


class Broken(Shelf):
    def __init__(self, error: Exception) -> None:
        super().__init__()
        self.error = error

    def find(self, description: VibrationDescription) -> list[AudioClip]:
        raise self.error


def titles(*sources: Shelf, enough: int = 1) -> list[str]:
    return [found.credit.title for found in gather("fan_01", DESCRIPTION, sources, enough=enough)]


def test_chain_stops_at_the_first_source_with_enough_clips() -> None:
    empty, first, second = Shelf(), Shelf(clip("a"), clip("b")), Shelf(clip("c"))
    assert titles(empty, first, second) == ["a", "b"]
    assert (empty.asked, second.asked) == (1, 0)


def test_chain_queries_sources_until_enough_clips_are_usable() -> None:
    first, second, third = Shelf(clip("a")), Shelf(clip("b"), clip("c")), Shelf(clip("d"))
    assert titles(first, second, third, enough=3) == ["a", "b", "c"]
    assert third.asked == 0
    assert titles(first, second, third, enough=5) == ["a", "b", "c", "d"]


def test_chain_does_not_count_clips_that_selection_would_drop() -> None:
    short = Shelf(clip("short", 2.5), clip("padded", 2.0, silent_s=3.0))
    assert titles(short, Shelf(clip("long", 2.6))) == ["short", "padded", "long"]
    assert titles(short) == ["short", "padded"], "the selection tells best what is wrong with them"


@pytest.mark.parametrize("error", [BackendUnavailable("freesound is away."), ZeroDivisionError("by a guest")], ids=repr)
def test_chain_skips_a_failing_source_with_a_warning(error: Exception, caplog: pytest.LogCaptureFixture) -> None:
    caplog.set_level(logging.INFO)
    with pytest.warns(SourceWarning, match=f"fan_01: no sound from Broken: .*{error}"):
        assert titles(Broken(error), Shelf(clip("a"))) == ["a"]
    # Logged below WARNING: an unconfigured logger would print the text of the warning again.
    assert [record.levelno for record in caplog.records] == [logging.INFO]


def test_chain_raises_when_no_source_has_a_clip() -> None:
    with (
        pytest.warns(SourceWarning),
        pytest.raises(AudioError, match=r"'fan_01' \('fan humming'\) in any of 2 sources: Broken failed: away; Shelf"),
    ):
        titles(Broken(BackendUnavailable("away")), Shelf())
    with pytest.raises(AudioError, match="any of 0 sources. Add the synthesizer"):
        titles()


def test_a_list_of_something_else_than_clips_is_named() -> None:
    with pytest.warns(SourceWarning, match="find gave a list with an? .*ndarray.*; it must give a list of AudioClip"):
        assert titles(Shelf(np.zeros(9)), Shelf(clip("a"))) == ["a"]  # type: ignore[arg-type]  # wrong on purpose
