"""A designer's work through the command line alone."""

import json
from pathlib import Path

import numpy as np
import pytest

from scene2hap import HapticBundle
from scene2hap.audio.files import write_wav
from scene2hap.cli import main
from scene2hap.cli.play import silence
from scene2hap.demo import kitchen_path
from scene2hap.session import HapticSession


def outcome(capsys: pytest.CaptureFixture[str], *words: str) -> dict[str, object]:
    capsys.readouterr()
    assert main(words) == 0
    found: dict[str, object] = json.loads(capsys.readouterr().out)
    return found


def test_edits_of_a_designer_stay_when_the_actuator_changes(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    folder, sound = str(tmp_path / "kitchen.bundle"), tmp_path / "mine.wav"
    assert main(["bake", str(kitchen_path()), "-o", folder, "--actuator", "voice_coil", "-q"]) == 0
    baked = HapticBundle.load(folder)
    assert baked.actuator is not None
    assert baked.actuator.name == "voice_coil"
    first, *others = baked.loops
    t = np.arange(3 * 44100) / 44100
    write_wav(sound, (0.5 * np.sin(2 * np.pi * 110.0 * t)).astype(np.float32), 44100)

    remade = outcome(capsys, "edit", folder, "sound", first, str(sound), "--json")["remade"]
    assert isinstance(remade, dict)
    assert first in remade
    assert main(["edit", folder, "gain", first, "-6", "-q"]) == 0
    assert main(["edit", folder, "material", first, "oak", "-q"]) == 0
    if others:
        assert main(["edit", folder, "silence", others[0], "-q"]) == 0
    remade = outcome(capsys, "edit", folder, "rebake", "--actuator", "lra", "--json")["remade"]
    assert isinstance(remade, dict)
    assert set(remade) == {first, *others[1:]}

    edited = HapticBundle.load(folder)
    assert edited.actuator is not None
    assert edited.actuator.name == "lra"
    assert edited.gain_db(first) == -6.0
    material = edited.objects[first].material
    assert material is not None
    assert material.name == "oak"
    assert not others or others[0] not in edited.loops
    assert all(loop.frequency_raw_hz == pytest.approx(110.0, rel=0.02) for loop in edited.loops[first].values())

    session = HapticSession(edited.snapshot, edited, {"actuator": "lra"})
    silence(session, [], [first])
    muted = {key for key in session.source_ids if session._sources[key].level.is_muted}
    assert muted == set(session.source_ids) - {first}


def test_a_wrong_id_or_material_leaves_the_bundle_as_it_was(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    folder = tmp_path / "kitchen.bundle"
    assert main(["bake", str(kitchen_path()), "-o", str(folder), "-q"]) == 0
    before = (folder / "bundle.json").stat().st_ino
    some = next(iter(HapticBundle.load(folder).objects))
    for words in (["gain", "no_such_thing", "3"], ["material", some, "no_such_stuff"]):
        assert main(["edit", str(folder), *words]) == 1
        assert words[1 if words[0] == "gain" else 2] in capsys.readouterr().err
    assert (folder / "bundle.json").stat().st_ino == before
