"""TextToAudio with a real process: a fake generator that works."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from generator_asking import GENERATOR, assert_nothing_left, describe, generator, runs
from scene2hap.audio.sources.text_to_audio import TextToAudio, UnusableTake
from scene2hap.audio.sources.text_to_audio.process import environment
from scene2hap.haptics import VibrationDescription


def test_the_sentence_goes_out_and_sounds_with_their_origin_come_in(tmp_path: Path) -> None:
    clips = generator(tmp_path).find(describe())
    (asked,) = runs(tmp_path)
    del asked["environment"]
    assert asked == {
        "contract": "scene2hap/text-to-audio",
        "version": 1,
        "prompt": "fan humming softly",
        "count": 2,
        "duration_s": 3.0,
        "seed": 7,
    }
    assert [clip.duration_s for clip in clips] == [3.0, 3.0]
    assert [clip.credit.title for clip in clips] == ["fan humming softly, take 1", "fan humming softly, take 2"]
    credit = clips[0].credit
    assert (credit.author, credit.licence, credit.address) == ("fake-1", "CC0-1.0", "https://example.org/fake")
    assert (credit.query, credit.origin) == ("fan humming softly", "text_to_audio")
    assert_nothing_left(tmp_path)


def test_five_takes_are_generated_by_default(tmp_path: Path) -> None:
    source = TextToAudio([sys.executable, "-S", str(GENERATOR), "good"], cache=tmp_path / "cache")
    assert len(source.find(describe())) == 5
    assert [(run["count"], run["duration_s"]) for run in runs(tmp_path)] == [(5, 5.0)]


def test_generated_sounds_are_cached(tmp_path: Path) -> None:
    first = generator(tmp_path).find(describe())
    again = generator(tmp_path).find(describe())
    assert len(runs(tmp_path)) == 1
    assert [clip.credit for clip in again] == [clip.credit for clip in first]
    assert all((a.samples == b.samples).all() for a, b in zip(again, first, strict=True))
    generator(tmp_path).find(describe(seed=8))
    generator(tmp_path).find(describe("fan rattling"))
    generator(tmp_path, count=3).find(describe())
    generator(tmp_path, "more").find(describe())
    assert len(runs(tmp_path)) == 5, "seed, words, count and program each matter"


@pytest.mark.parametrize(
    "junk",
    [b"", b"{}", b'{"files": ["0.wav"]}', b'{"files": ["../x"], "credits": [{}]}', b'{"files": 3, "credits": 3}'],
)
def test_a_damaged_entry_is_generated_again(tmp_path: Path, junk: bytes) -> None:
    generator(tmp_path).find(describe())
    (entry,) = (tmp_path / "cache").rglob("takes.json")
    entry.write_bytes(junk)
    assert len(generator(tmp_path).find(describe())) == 2
    assert len(runs(tmp_path)) == 2


def test_a_damaged_take_is_generated_again(tmp_path: Path) -> None:
    generator(tmp_path).find(describe())
    next((tmp_path / "cache").rglob("1.wav")).write_bytes(b"RIFF")
    assert len(generator(tmp_path).find(describe())) == 2
    assert len(runs(tmp_path)) == 2


def test_paths_replace_placeholders_of_the_command(tmp_path: Path) -> None:
    swapped = "import sys; a = sys.argv; sys.argv = ['', 'good', a[2][2:], a[1][2:]]; exec(open(a[3]).read())"
    command = [sys.executable, "-S", "-c", swapped, "o={folder}", "i={request}", str(GENERATOR)]
    assert len(TextToAudio(command, count=1, cache=tmp_path / "cache").find(describe())) == 1


def test_empty_description_generates_nothing(tmp_path: Path) -> None:
    silent = VibrationDescription("", "", " \n", " ", 0.5, (0.0, 0.0, 0.0))
    assert generator(tmp_path).find(silent) == []
    assert runs(tmp_path) == []


def test_bad_take_is_skipped_and_extra_takes_are_ignored(tmp_path: Path) -> None:
    with pytest.warns(UnusableTake, match="skipped take 2"):
        assert len(generator(tmp_path, "one-junk", count=3).find(describe())) == 2
    assert len(generator(tmp_path, "more").find(describe())) == 2


def test_model_without_identity_is_refused(tmp_path: Path) -> None:
    credit = generator(tmp_path, "nameless").find(describe())[0].credit
    assert (credit.author, credit.licence, credit.address) == ("an unnamed model", "free as in beer", "")


def test_program_gets_only_the_configured_environment_keys(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("OPENAI_API_KEY", "FREESOUND_TOKEN", "HF_TOKEN", "AWS_SECRET_ACCESS_KEY", "DB_PASSWORD", "HF_HOME"):
        monkeypatch.setenv(name, "0123456789")
    generator(tmp_path).find(describe())
    seen = set(runs(tmp_path)[0]["environment"])
    assert {"HF_TOKEN", "HF_HOME", "PATH"} <= seen
    assert seen.isdisjoint({"OPENAI_API_KEY", "FREESOUND_TOKEN", "AWS_SECRET_ACCESS_KEY", "DB_PASSWORD"})
    assert environment((), {"HF_TOKEN": "x", "LANG": "C"}) == {"LANG": "C"}
