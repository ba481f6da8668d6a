from __future__ import annotations

import unicodedata
import warnings
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import soundfile

from scene2hap.audio.clip import Credit
from scene2hap.audio.encoding import encoded
from scene2hap.audio.protocol import AudioSource
from scene2hap.audio.sources import SOURCES
from scene2hap.audio.sources.library import FolderLibrary, ShortSound, UnreadableSound
from scene2hap.errors import ConfigError
from scene2hap.haptics import VibrationDescription


def describe(category: str, keywords: str) -> VibrationDescription:
    return VibrationDescription(category, "on", f"{category} runs", keywords, 0.5, (0.6, 0.6, 0.02))


def hum(duration_s: float = 3.0) -> np.ndarray:
    return 0.1 * np.sin(2 * np.pi * 100.0 * np.arange(round(duration_s * 8000)) / 8000)


def fill(folder: Path, *names: str, duration_s: float = 3.0) -> Path:
    for name in names:
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(encoded(hum(duration_s), 8000))
    return folder


def titles(folder: Path, category: str, keywords: str) -> list[str]:
    return [clip.credit.title for clip in FolderLibrary(folder).find(describe(category, keywords))]


def test_library_orders_files_by_shared_words(tmp_path: Path) -> None:
    fill(tmp_path, "fan_1.wav", "computer-fan-hum.wav", "sub/Computer_Fans.WAV", "fridge_hum.wav", "notes.txt.wav")
    assert titles(tmp_path, "computer fan", "computer fan") == ["computer-fan-hum", "Computer_Fans", "fan_1"]


@pytest.mark.parametrize("name", ["Buzz_02", "Red_01", "Box.003", "fan 1"])
def test_a_sound_with_the_whole_name_of_the_object_is_found_alone(tmp_path: Path, name: str) -> None:
    """Words for states, colours and boxes, which many objects have, find nothing by themselves."""
    fill(tmp_path, f"sub/{name.lower()}.wav", "Buzz_03.wav", "Red.wav", "Box_01.wav", "fan.wav", "fan hum.wav")
    library = FolderLibrary(tmp_path)
    found = library.find(replace(describe("fan", "fan hum"), name=name))
    assert [clip.credit.title for clip in found] == [name.lower()]
    assert library.names() >= {name.lower(), "fan hum"}


def test_a_word_for_anything_finds_nothing_by_itself(tmp_path: Path) -> None:
    fill(tmp_path, "box fan.wav", "music box.wav", "sewing machine.wav", "gift box shaking.wav")
    assert titles(tmp_path, "box", "box shaking") == []
    assert titles(tmp_path, "object", "box shaking") == []
    assert titles(tmp_path, "music box", "music box playing") == ["music box"]
    assert titles(tmp_path, "gift box", "gift box shaking") == ["gift box shaking"]


def test_a_sound_that_says_no_more_than_a_word_for_anything_is_found(tmp_path: Path) -> None:
    fill(tmp_path, "box fan.wav", "Box_01.wav", "box shaking.wav", "music box shaking.wav", "shaking.wav")
    assert titles(tmp_path, "box", "box shaking") == ["box shaking"]
    assert titles(tmp_path, "box", "box humming") == ["Box_01"]
    fill(tmp_path, "HummingBox.wav")
    assert titles(tmp_path, "box", "box humming") == ["HummingBox"]
    assert titles(tmp_path, "item", "item humming") == []


def test_sounds_with_the_authors_word_come_alone(tmp_path: Path) -> None:
    """In an earlier version only the type was searched, so that a windmill did not find its file."""
    fill(tmp_path, "windmill creaking.wav", "wind turbine whirring.wav", "water mill.wav")
    windmill = replace(describe("turbine", "turbine whirring"), own_word="windmill")
    assert [clip.credit.title for clip in FolderLibrary(tmp_path).find(windmill)] == ["windmill creaking"]
    assert titles(tmp_path, "turbine", "turbine whirring") == ["wind turbine whirring"]
    # Every word is needed: a stage monitor is a speaker, and no screen.
    monitor = replace(describe("speaker", "speaker playing"), own_word="stage monitor")
    assert FolderLibrary(fill(tmp_path, "computer monitor.wav")).find(monitor) == []


def test_an_authors_word_may_say_what_the_object_does(tmp_path: Path) -> None:
    """In an earlier version its verb did not count, so that the sound of another verb was chosen."""
    fill(tmp_path, "pan boiling.wav", "pan frying.wav")
    pot = replace(describe("pan on a heater", "pan boiling"), own_word="boiling pot")
    assert [clip.credit.title for clip in FolderLibrary(tmp_path).find(pot)] == ["pan boiling"]


def test_sounds_of_what_the_object_does_come_alone(tmp_path: Path) -> None:
    """In an earlier version the states of a car had one sound, and a clock that ticks rang, since ringing is tonal."""
    clocks, cars = ("alarm clock ringing.wav", "wall clock ticking.wav"), ("car idle.wav", "car drives.wav")
    fill(tmp_path, *clocks, *cars)
    assert titles(tmp_path, "clock", "clock ticking") == ["wall clock ticking"]
    assert titles(tmp_path, "alarm clock", "alarm clock ticking") == ["wall clock ticking"]
    assert titles(tmp_path, "alarm clock", "alarm clock ringing") == ["alarm clock ringing"]
    assert titles(tmp_path, "car", "car idling") == ["car idle"]
    assert titles(tmp_path, "car", "car driving") == ["car drives"]
    assert titles(tmp_path, "car", "car shaking") == ["car drives", "car idle"]


def test_a_short_sound_of_what_the_object_does_does_not_come_alone(tmp_path: Path) -> None:
    fill(fill(tmp_path, "horn sounding.wav", duration_s=0.5), "horn.wav", "horn of a car.wav")
    assert titles(tmp_path, "horn", "horn sounding") == ["horn of a car", "horn", "horn sounding"]


def test_library_takes_only_files_of_sound(tmp_path: Path) -> None:
    """A file of another kind would come back as an unreadable sound, with a warning."""
    fill(tmp_path, "fan.wav")
    (tmp_path / "fan.txt").write_text("where the fan was recorded")
    assert titles(tmp_path, "fan", "fan humming") == ["fan"]


def test_library_ignores_files_that_share_only_a_verb_or_a_modifier(tmp_path: Path) -> None:
    fill(tmp_path, "fridge_humming.wav", "electric_toothbrush.wav")
    assert titles(tmp_path, "electric fan", "electric fan humming") == []
    assert titles(tmp_path, "refrigerators", "refrigerator hums") == ["fridge_humming"]


def test_library_returns_at_most_five_clips_in_a_fixed_order(tmp_path: Path) -> None:
    fill(tmp_path, *(f"pump_{letter}.wav" for letter in "gecafbd"))
    assert titles(tmp_path, "pump", "pump pumping") == [f"pump_{letter}" for letter in "abcde"]


@pytest.mark.parametrize("separator", [",", ";", "\t"])
def test_library_reads_keywords_and_credits_from_its_index(tmp_path: Path, separator: str) -> None:
    fill(tmp_path, "a.wav", "b.wav", "pump.wav")
    table = (
        "\ufefffile,keywords,title,author,licence,address\n"
        "a.wav,pump bubbling,Aquarium,Ann,CC0-1.0,https://example.org/1\n"
        "\n"
        "b.wav,water pump\n"
        ",pump,no file,,,\n"
    )
    (tmp_path / "sounds.csv").write_text(table.replace(",", separator), encoding="utf-8")
    found = FolderLibrary(tmp_path).find(describe("pump", "pump"))
    assert [clip.credit for clip in found] == [
        Credit("Aquarium", "Ann", "CC0-1.0", "https://example.org/1", "pump", "library"),
        Credit("b", "unknown", "unknown", "", "pump", "library"),
    ]


def test_malformed_index_is_refused(tmp_path: Path) -> None:
    (tmp_path / "sounds.csv").write_text("name;keywords\n")
    with pytest.raises(ConfigError, match=r"sounds\.csv: the first line is .*at least 'file'"):
        FolderLibrary(tmp_path).find(describe("pump", "pump"))
    (tmp_path / "sounds.csv").write_bytes(b"file\n\xff\xfe.wav\n")
    with pytest.raises(ConfigError, match="Save it as CSV in UTF-8"):
        FolderLibrary(tmp_path).find(describe("pump", "pump"))


@pytest.mark.parametrize("name", ["../fan.wav", "sub/../../fan.wav", "{outside}/fan.wav"])
def test_index_reads_no_file_outside_the_folder(tmp_path: Path, name: str) -> None:
    folder = tmp_path / "library"
    folder.mkdir()
    fill(tmp_path, "fan.wav")
    (folder / "sounds.csv").write_text(f"file\n{name.format(outside=tmp_path)}\n", encoding="utf-8")
    with pytest.raises(ConfigError, match=r"sounds\.csv: file is .*fan\.wav', which lies outside .*library"):
        FolderLibrary(folder).find(describe("fan", "fan humming"))


def test_library_skips_unreadable_files_with_a_warning(tmp_path: Path) -> None:
    fill(tmp_path, "pump_b.wav")
    (tmp_path / "pump_a.wav").write_text("no sound")
    with pytest.warns(UnreadableSound, match=r"skipped: .*pump_a\.wav"):
        assert titles(tmp_path, "pump", "pump") == ["pump_b"]
    (tmp_path / "sounds.csv").write_text("file,keywords\ngone.wav,fan\n")
    with pytest.warns(UnreadableSound, match=r"gone\.wav"):
        assert titles(tmp_path, "fan", "fan") == []


def test_library_opens_matching_files_only(tmp_path: Path) -> None:
    (tmp_path / "fan.wav").write_text("no sound")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert titles(tmp_path, "pump", "pump") == []


def test_missing_folder_is_refused_at_construction_and_at_each_search(tmp_path: Path) -> None:
    with pytest.raises(ConfigError, match="absent is not a folder"):
        FolderLibrary(tmp_path / "absent")
    folder = tmp_path / "there"
    folder.mkdir()
    library = FolderLibrary(folder)
    folder.rmdir()
    with pytest.raises(ConfigError, match="there is not a folder"):
        library.find(describe("pump", "pump"))


def test_empty_query_matches_nothing(tmp_path: Path) -> None:
    fill(tmp_path, "pump.wav")
    assert titles(tmp_path, "", "") == []


def test_library_is_registered_by_its_kind(tmp_path: Path) -> None:
    assert SOURCES.load("library") is FolderLibrary
    assert {"library", "synth"} <= set(SOURCES.kinds())
    assert isinstance(FolderLibrary(tmp_path), AudioSource)


def test_index_with_a_field_of_a_megabyte_is_refused(tmp_path: Path) -> None:
    (tmp_path / "sounds.csv").write_text(f"file,keywords\na.wav,{'x' * 200_000}\n", encoding="utf-8")
    with pytest.raises(ConfigError, match="cannot be read as CSV"):
        FolderLibrary(tmp_path).find(describe("pump", "pump"))


@pytest.mark.parametrize("suffix", [".aif", ".aiff", ".caf", ".AU"])
def test_library_finds_every_kind_of_sound_that_convert_finds(tmp_path: Path, suffix: str) -> None:
    """Sounds of a recording program need not be converted before a bake; docs/sound-sources.md lists the kinds."""
    kind = {".aif": "AIFF", ".aiff": "AIFF", ".caf": "CAF", ".au": "AU"}[suffix.lower()]
    soundfile.write(tmp_path / f"desk fan{suffix}", hum(), 8000, format=kind)
    assert titles(tmp_path, "fan", "fan whirring") == ["desk fan"]


def test_words_for_anything_match_no_other_kind_of_thing(tmp_path: Path) -> None:
    """A vending machine would be felt as the user's sewing machine, and an ice maker as a bread maker."""
    fill(tmp_path, "sewing machine.wav", "bread maker kneading.wav", "steam cleaner.wav")
    assert titles(tmp_path, "vending machine", "vending machine humming") == []
    assert titles(tmp_path, "ice maker", "ice maker humming") == []
    assert titles(tmp_path, "old Sewing Machines", "sewing machine clattering") == ["sewing machine"]
    assert len(titles(tmp_path, "machine", "machine humming")) == 1


def test_names_of_macos_match(tmp_path: Path) -> None:
    """They have each accent as a character of its own; "Kühlschrank" became the words "Ku" and "hlschrank"."""
    fill(tmp_path, unicodedata.normalize("NFD", "Kühlschrank Küche.wav"))
    assert len(titles(tmp_path, "Kühlschrank", "Kühlschrank brummt")) == 1


def test_words_may_be_written_as_one(tmp_path: Path) -> None:
    fill(tmp_path, "WindMill1.wav", "garbage-disposer.wav")
    assert titles(tmp_path, "windmill", "windmill turning") == ["WindMill1"]
    assert titles(tmp_path, "garbagedisposer", "garbagedisposer grinding") == ["garbage-disposer"]


def test_sounds_that_are_all_too_short_are_said(tmp_path: Path) -> None:
    """In an earlier version the bake synthesized a sound beside them, without a word."""
    fill(tmp_path, "jackhammer.wav", "old jackhammer.wav", duration_s=0.7)
    said = r"sounds of 'jackhammer', but none lasts more than 2\.5 s .*: 'jackhammer', 'old jackhammer'\. Record"
    with pytest.warns(ShortSound, match=said):
        assert len(titles(tmp_path, "jackhammer", "jackhammer hammering")) == 2
    with pytest.warns(ShortSound, match=said):
        titles(tmp_path, "jackhammer", "old jackhammer running down")
    fill(tmp_path, "new jackhammer.wav")
    assert len(titles(tmp_path, "jackhammer", "jackhammer hammering")) == 3


def test_many_short_sounds_do_not_hide_a_long_one(tmp_path: Path) -> None:
    """In an earlier version the first five files counted, so that the sixth was called too short as well."""
    fill(tmp_path, *(f"jackhammer hit {i}.wav" for i in range(9)), duration_s=0.2)
    fill(tmp_path, "jackhammer loop.wav")
    found = titles(tmp_path, "jackhammer", "jackhammer hammering")
    assert (found[0], len(found)) == ("jackhammer loop", 5)
