"""Editing bundles with the command line: the command `scene2hap edit`."""

import contextlib
import json
import os
import shutil
import sys
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import soundfile

from batch_server import answered
from files_of import files_of
from llm_server import serving
from scene2hap import Box, HapticBundle, LLMReply, LLMRequest, Pose, SceneObject, SceneSnapshot, bake
from scene2hap.audio.encoding import encoded
from scene2hap.bundle.differences import differences
from scene2hap.cli import main
from scene2hap.cli.console import Console
from scene2hap.cli.sink_output import silence
from scene2hap.errors import BadAnswer
from scene2hap.llm.lexicon.backend import LexiconBackend
from scene2hap.materials import Material
from scene2hap.scene.looks.appearance import Appearance, FaceMaterial
from scene2hap.session import HapticSession, Touch

pytestmark = pytest.mark.usefixtures("short_tones")

THINGS = {
    "radio": (0.3, 0.2, 0.15),
    "fan": (0.4, 0.5, 0.3),
    "refrigerator": (0.7, 1.8, 0.7),
    "oak table": (1.2, 0.7, 0.7),
}


def room(folder: Path, *names: str) -> str:
    """Write a scene of three sources and a table, or of some of them. Returns its path."""
    things = [
        SceneObject(name, pose=Pose((1.5 * i, THINGS[name][1] / 2, 0.0)), geometry=Box(THINGS[name]))
        for i, name in enumerate(names or THINGS)
    ]
    path = folder / "room.json"
    path.write_text(SceneSnapshot.build(things, name="room").to_json(), encoding="utf-8")
    return str(path)


@pytest.fixture(scope="module")
def baked(tmp_path_factory: pytest.TempPathFactory) -> Callable[..., Path]:
    """A function that bakes the room with options of the command, once for equal options."""
    work = tmp_path_factory.mktemp("baked")

    @cache
    def made(*options: str) -> Path:
        folder = work / f"{'_'.join(options)}.bundle"
        assert main(["bake", room(work), "-o", str(folder), "-q", *options]) == 0
        return folder

    return made


@pytest.fixture
def kitchen(baked: Callable[..., Path], tmp_path: Path) -> Callable[..., Path]:
    """A function that gives a copy of the room's bundle, to be edited."""
    return lambda *options: shutil.copytree(baked(*options), tmp_path / "kitchen.bundle")


@pytest.fixture(scope="module")
def baked_fan(tmp_path_factory: pytest.TempPathFactory) -> Path:
    work = tmp_path_factory.mktemp("fan")
    assert main(["bake", room(work, "fan"), "-o", str(work / "fan.bundle"), "-q"]) == 0
    return work / "fan.bundle"


@pytest.fixture
def fan(baked_fan: Path, tmp_path: Path) -> Path:
    """A copy of the bundle of a fan alone, which each edit reads and writes several times as fast as the room's."""
    return shutil.copytree(baked_fan, tmp_path / "kitchen.bundle")


def outcome(capsys: pytest.CaptureFixture[str], *words: str) -> dict[str, object]:
    capsys.readouterr()
    assert main(words) == 0
    found: dict[str, object] = json.loads(capsys.readouterr().out)
    return found


def test_edits_of_a_designer_stay_when_the_actuator_changes(
    kitchen: Callable[..., Path], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    folder, sound = str(kitchen("--actuator", "voice_coil")), tmp_path / "mine.wav"
    baked = HapticBundle.load(folder)
    assert baked.actuator is not None
    assert baked.actuator.name == "voice_coil"
    first, *others = baked.loops
    t = np.arange(3 * 44100) / 44100
    sound.write_bytes(encoded((0.5 * np.sin(2 * np.pi * 110.0 * t)).astype(np.float32), 44100))

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


def test_play_keeps_the_mute_of_the_bundle(kitchen: Callable[..., Path]) -> None:
    """`play` without options is felt like `render`; a muted source plays only by an option."""
    folder = str(kitchen())
    first, *others = HapticBundle.load(folder).loops
    assert main(["edit", folder, "mute", first, "-q"]) == 0
    bundle = HapticBundle.load(folder)
    for muted, solo, silent in (
        ([], [], {first}),
        (others[:1], [], {first, *others[:1]}),
        ([], [first], {*others}),
        ([], others[:1], {first, *others[1:]}),
    ):
        session = HapticSession(bundle)
        silence(session, muted, solo)
        touches = [Touch("left", item.id, item.pose.position_m) for item in bundle.snapshot.objects]
        gains = session.would_feel([one for one in touches if one.object_id in session.source_ids])
        felt = {one for i, one in enumerate(session.source_ids) if gains[:, i].any()}
        assert felt == set(session.source_ids) - silent


def test_wrong_id_or_material_keeps_the_bundle_unchanged(fan: Path, capsys: pytest.CaptureFixture[str]) -> None:
    folder = fan
    before = (folder / "bundle.json").stat().st_ino
    some = next(iter(HapticBundle.load(folder).objects))
    for words in (["gain", "no_such_thing", "3"], ["material", some, "no_such_stuff"]):
        assert main(["edit", str(folder), *words]) == 1
        assert words[1 if words[0] == "gain" else 2] in capsys.readouterr().err
    assert (folder / "bundle.json").stat().st_ino == before


def test_a_material_that_no_table_has_is_given_by_its_constants(
    fan: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    constants = {"name": "my abs", "density_kg_m3": 1111, "youngs_modulus_pa": 2.2e9, "poisson_ratio": 0.33}
    assert main(["edit", str(fan), "material", "fan", "my abs"]) == 1
    assert f"a Material of your own: {', '.join(constants)}, loss_factor." in capsys.readouterr().err
    assert main(["edit", str(fan), "material", "fan", json.dumps(constants)[:-1]]) == 1
    assert "material is no JSON" in capsys.readouterr().err
    own = Material("my abs", 1111.0, 2.2e9, 0.33)
    assert main(["edit", str(fan), "material", "fan", json.dumps(constants)]) == 0
    assert HapticBundle.load(fan).objects["fan"].material == own
    corrections = {"format": "scene2hap/overrides", "version": 1, "overrides": {"fan": {"feet": constants}}}
    (tmp_path / "c.json").write_text(json.dumps(corrections))
    assert main(["edit", str(fan), "apply", str(tmp_path / "c.json")]) == 0
    assert HapticBundle.load(fan).objects["fan"].feet == own


def test_a_locked_loop_stays_byte_for_byte(
    kitchen: Callable[..., Path], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Bake, set a custom sound, lock it, change the actuator, compare, undo, and repeat."""
    folder, sound = kitchen("--actuator", "voice_coil"), tmp_path / "mine.wav"
    mine, *others = HapticBundle.load(folder).loops
    t = np.arange(2 * 44100) / 44100
    sound.write_bytes(encoded((0.5 * np.sin(2 * np.pi * 130.0 * t)).astype(np.float32), 44100))
    assert main(["edit", str(folder), "sound", mine, str(sound), "-q"]) == 0
    assert main(["edit", str(folder), "lock", mine, "-q"]) == 0
    locked = contents(folder, mine)

    remade = outcome(capsys, "edit", str(folder), "rebake", "--actuator", "lra", "--json")["remade"]
    assert isinstance(remade, dict)
    assert set(remade) == set(others)
    assert contents(folder, mine) == locked
    found = outcome(capsys, "edit", str(folder), "diff", f"{folder}.before", "--json")["differences"]
    assert isinstance(found, list)
    assert {row[0] for row in found if row[1].startswith("loop")} == set(others)
    assert [mine, "actuator", "lra", "voice_coil"] in found

    rebaked = {key: contents(folder, key) for key in (mine, *others)}
    assert main(["edit", str(folder), "undo", "-q"]) == 0
    assert contents(folder, mine) == locked
    assert all(contents(folder, key) != rebaked[key] for key in others)
    assert main(["edit", str(folder), "redo", "-q"]) == 0
    assert {key: contents(folder, key) for key in (mine, *others)} == rebaked

    assert main(["edit", str(folder), "unlock", mine, "-q"]) == 0
    remade = outcome(capsys, "edit", str(folder), "rebake", "--json")["remade"]
    assert isinstance(remade, dict)
    assert remade[mine] == {state: ["actuator"] for state in HapticBundle.load(folder).loops[mine]}


def test_a_comparison_lists_only_what_an_edit_changed(fan: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """An override has values for gain, sound, lock and mute; values that were not set are not listed."""
    folder = fan
    source = next(iter(HapticBundle.load(folder).loops))
    said = outcome(capsys, "edit", str(folder), "gain", source, "-3", "--json")["differences"]
    found = outcome(capsys, "edit", str(folder), "diff", f"{folder}.before", "--json")["differences"]
    assert isinstance(said, list)
    assert [[key, what, before, after] for key, what, after, before in said] == found
    assert outcome(capsys, "edit", str(folder), "gain", source, "-3", "--json")["differences"] == []
    assert found == [[source, "gain", "-3.0 dB", "+0.0 dB"]]


def test_undo_of_another_actuator_tells_of_the_loops(
    kitchen: Callable[..., Path], capsys: pytest.CaptureFixture[str]
) -> None:
    folder = str(kitchen())
    assert main(["edit", folder, "rebake", "--actuator", "lra", "-q"]) == 0
    capsys.readouterr()
    assert main(["edit", folder, "undo"]) == 0
    told = capsys.readouterr().out
    assert "3 loops of the bundle before" in told
    assert "the values stay" not in told
    assert main(["edit", folder, "material", "oak table", "oak", "-q"]) == 0
    assert main(["edit", folder, "undo"]) == 0
    assert "the corrections of the bundle before" in capsys.readouterr().out


def test_undo_goes_back_several_steps_and_redo_forward(fan: Path, capsys: pytest.CaptureFixture[str]) -> None:
    folder = fan
    beside = folder.with_name("kitchen.bundle.before")

    def gain(*words: str) -> float:
        assert main(["edit", str(folder), *words, "-q"]) == 0
        return HapticBundle.load(folder).gain_db("fan")

    for db in range(1, 8):
        assert gain("gain", "fan", str(-db)) == -db
    beside.joinpath("notes.txt").write_text("mine")
    assert [gain("undo") for _ in range(5)] == [-6, -5, -4, -3, -2]
    assert main(["edit", str(folder), "undo"]) == 1
    assert "nothing to undo" in capsys.readouterr().err
    assert [gain("redo") for _ in range(3)] == [-3, -4, -5]
    assert gain("undo") == -4
    assert gain("gain", "fan", "2") == 2  # an edit after an undo: the steps forward are gone
    assert main(["edit", str(folder), "redo"]) == 1
    assert "nothing to redo" in capsys.readouterr().err
    assert gain("undo") == -4
    steps = sorted(path.name for path in folder.parent.iterdir())
    assert steps == ["kitchen.bundle", *(f"kitchen.bundle.{one}" for one in ("after", "before", "before-2"))]
    assert [path.read_text() for path in folder.parent.rglob("notes*.txt")].count("mine") >= 1
    # Steps take hardly any space, and none shares a file with the bundle, which people edit in place.
    for name in (name for name in files_of(folder) if name.endswith(".wav")):
        assert (beside / name).stat().st_ino == beside.with_name(f"{beside.name}-2").joinpath(name).stat().st_ino
        assert (beside / name).stat().st_ino != (folder / name).stat().st_ino


def test_an_undo_that_was_interrupted_does_not_stop_the_next(fan: Path) -> None:
    folder = fan
    for db in ("-1", "-2"):
        assert main(["edit", str(folder), "gain", "fan", db, "-q"]) == 0
    shutil.rmtree(folder)
    shutil.copytree(folder.with_name("kitchen.bundle.before"), folder)  # the step was written, and not removed
    assert main(["edit", str(folder), "undo", "-q"]) == 0
    assert HapticBundle.load(folder).gain_db("fan") == 0.0


def test_undo_without_edits_is_refused(fan: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    folder = fan
    assert main(["edit", str(folder), "undo"]) == 1
    assert "there is nothing to undo" in capsys.readouterr().err
    # Another user's folder at the path where the previous bundle would be kept.
    other = tmp_path / "kitchen.bundle.before" / "thesis.txt"
    other.parent.mkdir()
    other.write_text("mine")
    some = next(iter(HapticBundle.load(folder).loops))
    assert main(["edit", str(folder), "gain", some, "-3"]) == 1
    assert other.read_text() == "mine"
    assert HapticBundle.load(folder).gain_db(some) == 0.0


@pytest.mark.skipif(sys.platform != "linux", reason="files are found in /proc, on Linux")
@pytest.mark.parametrize("n_saved", [0, 1])
def test_a_disk_that_is_full_at_either_bundle_leaves_both_as_they_were(
    n_saved: int, fan: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    folder = fan
    kept = folder.with_name("kitchen.bundle.before")
    assert main(["edit", str(folder), "gain", "fan", "-3", "-q"]) == 0
    before = files_of(folder), files_of(kept)
    manifests: list[int] = []

    def full(descriptor: int) -> None:
        if "bundle.json" in os.readlink(f"/proc/self/fd/{descriptor}"):
            manifests.append(descriptor)
            if len(manifests) > n_saved:
                raise OSError(28, "No space left on device")

    monkeypatch.setattr("os.fsync", full)
    assert main(["edit", str(folder), "gain", "fan", "-9", "-q"]) == 1
    assert "cannot be written: No space left on device. Make room" in capsys.readouterr().err
    assert (files_of(folder), files_of(kept)) == before
    assert {path.name for path in folder.parent.iterdir()} == {folder.name, kept.name}


def contents(folder: Path, object_id: str) -> list[bytes]:
    """The content of the files of an object's loops on disk."""
    rows = json.loads((folder / "loops.json").read_text(encoding="utf-8"))[object_id]
    names = [row[kind] for _, row in sorted(rows.items()) for kind in ("audible", "tactile")]
    return [(folder / name).read_bytes() for name in names]


def test_an_edit_says_what_changed(kitchen: Callable[..., Path], capsys: pytest.CaptureFixture[str]) -> None:
    folder = str(kitchen())
    capsys.readouterr()
    assert main(["edit", folder, "gain", "fan", "-6"]) == 0
    assert "fan, gain: +0.0 dB -> -6.0 dB" in capsys.readouterr().out
    assert main(["edit", folder, "gain", "fan", "-6"]) == 0
    assert "nothing changed" in capsys.readouterr().out
    assert main(["edit", folder, "material", "oak table", "oak"]) == 0
    assert "the values stay; noted as yours" in capsys.readouterr().out
    assert main(["edit", folder, "pitch", "fan", "200"]) == 0
    said = capsys.readouterr().out
    assert "fan, pitch: - -> 200 Hz" in said
    assert "its place among the sources" in said


def test_inspect_shows_a_corrected_thickness_as_corrected(fan: Path, capsys: pytest.CaptureFixture[str]) -> None:
    def row() -> list[str]:
        capsys.readouterr()
        assert main(["inspect", str(fan)]) == 0
        rows = [line.split("│") for line in capsys.readouterr().out.splitlines() if line.startswith("│ fan ")]
        return [cell.strip() for cell in rows[0]]

    before = row()
    assert main(["edit", str(fan), "thickness", "fan", "0.042"]) == 0
    after = row()
    changed = [(one, other) for one, other in zip(before, after, strict=True) if one != other]
    assert len(changed) == 2
    assert changed[0][1] == "0.042"
    assert changed[1] == ("well", "thickness corrected")
    told: Any = outcome(capsys, "inspect", str(fan), "--json")["objects"]
    assert told["fan"]["size_m"][2] == 0.042
    assert told["fan"]["corrected"] == ["thickness_m"]


def test_an_edit_without_effect_can_still_be_followed_by_undo(fan: Path, capsys: pytest.CaptureFixture[str]) -> None:
    folder = str(fan)
    assert main(["edit", folder, "gain", "fan", "-6", "-q"]) == 0
    capsys.readouterr()
    for nothing in (("unmute", "fan"), ("unlock", "fan"), ("gain", "fan", "-6"), ("rebake",)):
        assert main(["edit", folder, *nothing]) == 0
        said = capsys.readouterr().out
        assert "nothing changed" in said
        assert "wrote" not in said
    assert main(["edit", folder, "undo"]) == 0
    assert "fan, gain: -6.0 dB -> +0.0 dB" in capsys.readouterr().out
    assert HapticBundle.load(folder).gain_db("fan") == 0.0


def test_a_silent_object_can_be_made_to_vibrate(
    kitchen: Callable[..., Path], capsys: pytest.CaptureFixture[str]
) -> None:
    folder = str(kitchen())
    assert main(["edit", folder, "intensity", "oak table", "0.5"]) == 0
    said = capsys.readouterr().err
    assert "intensity will change nothing until it does" in said
    assert "scene2hap edit BUNDLE vibrate oak table" in said
    assert main(["edit", folder, "vibrate", "oak table"]) == 0
    assert "inference: " not in capsys.readouterr().out  # the lexicon has no account
    assert "oak table" in HapticBundle.load(folder).loops


def test_commands_play_on_the_actuator_of_the_bundle(
    kitchen: Callable[..., Path], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    folder, touches = str(kitchen("--actuator", "lra")), tmp_path / "touches.csv"
    touches.write_text("time_s,hand,touch,glide_s\n0.1,left,fan,\n0.3,,,\n", encoding="utf-8")
    capsys.readouterr()
    assert main(["render", folder, "--touches", str(touches), "-o", str(tmp_path / "a.wav")]) == 0
    assert main(["report", folder, "-o", str(tmp_path / "a.html")]) == 0
    assert "actuator" not in capsys.readouterr().err


def test_an_edit_keeps_an_edit_of_another_process_during_it(
    kitchen: Callable[..., Path], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Another terminal lowers the radio after this edit has read the bundle."""
    folder, load, loaded = kitchen(), HapticBundle.load, []

    def load_and_be_overtaken(path: str | Path) -> HapticBundle:
        loaded.append(load(path))
        if len(loaded) == 1:
            loaded[0].override("radio", gain_db=-5.0).save(path)
        return loaded[-1]

    monkeypatch.setattr("scene2hap.cli.edit.HapticBundle.load", load_and_be_overtaken)
    assert main(["edit", str(folder), "gain", "fan", "-6", "-q"]) == 0
    edited = load(folder)
    assert (edited.gain_db("radio"), edited.gain_db("fan")) == (-5.0, -6.0)
    before = load(folder.with_name(f"{folder.name}.before"))
    assert (before.gain_db("radio"), before.gain_db("fan")) == (-5.0, 0.0)


def test_vibrate_keeps_the_material_that_was_inferred_from_colours(tmp_path: Path) -> None:
    """The name of the box says nothing; its material was inferred from the name of a texture, as in a glTF file."""
    looks = Appearance((FaceMaterial((0.4, 0.3, 0.1, 1.0), name="walnut"),), np.zeros(12, np.int32))
    thing = SceneObject("Object_7", pose=Pose((0, 0.3, 0)), geometry=Box((0.6, 0.6, 0.6)), appearance=looks)
    fan = SceneObject("fan", pose=Pose((1, 0.3, 0)), geometry=Box((0.4, 0.6, 0.3)))
    folder = bake(SceneSnapshot.build([thing, fan], name="room")).save(tmp_path / "room.bundle")
    inferred = HapticBundle.load(folder).objects["Object_7"]
    assert inferred.material is not None
    assert inferred.material.name == "walnut"
    assert main(["edit", str(folder), "vibrate", "Object_7", "-q"]) == 0
    edited = HapticBundle.load(folder)
    assert edited.objects["Object_7"].material == inferred.material
    assert edited.objects["Object_7"].vibrates
    assert edited.loops["Object_7"]


def test_a_name_is_inferred_by_the_model_of_the_options(
    kitchen: Callable[..., Path],
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
    no_proxies: None,
) -> None:
    """The lexicon does not know the word; the model answers that it is a fridge."""
    stages: list[tuple[str, int, int]] = []
    show = contextlib.nullcontext(lambda stage, what, done, total: stages.append((stage, done, total)))
    monkeypatch.setattr(Console, "progress", lambda console: show)
    folder = str(kitchen())
    before = HapticBundle.load(folder)
    with serving(by=answered) as server:
        model = ["--llm", "local:scripted", "--base-url", f"{server.base_url}/v1", "--cache", str(tmp_path / "cache")]
        assert main(["edit", folder, "name", "oak table", "flurbelgurk", *model]) == 0
        assert ("inference", 1, 1) in stages  # shown while a model answers
        asked = [one.prompt for one in server.asked]
        assert any("flurbelgurk" in prompt for prompt in asked)
        assert "inference: " in capsys.readouterr().out
        assert main(["edit", folder, "rebake", "-q", *model]) == 0
        assert len(server.asked) == len(asked)
    named = HapticBundle.load(folder)
    assert named.objects["oak table"].object_category == "fridge"
    assert named.loops["oak table"]
    assert {key for key in before.objects if named.objects[key] != before.objects[key]} == {"oak table"}


def test_audition_writes_as_long_as_asked(fan: Path, tmp_path: Path) -> None:
    wav = tmp_path / "fan.wav"
    assert main(["audition", str(fan), "fan", "-o", str(wav), "--seconds", "60", "-q"]) == 0
    assert soundfile.info(str(wav)).duration == pytest.approx(60.0, abs=1.0)


def test_locked_loops_stay_when_the_scene_is_baked_again(kitchen: Callable[..., Path], tmp_path: Path) -> None:
    """Also for another actuator, which changes all other loops."""
    folder = kitchen()
    assert main(["edit", str(folder), "pitch", "fan", "97", "-q"]) == 0
    assert main(["edit", str(folder), "lock", "fan", "-q"]) == 0
    before = HapticBundle.load(folder)
    assert main(["bake", room(tmp_path), "-o", str(folder), "--actuator", "lra", "-q"]) == 0
    after = HapticBundle.load(folder)
    for state, loop in before.loops["fan"].items():
        np.testing.assert_array_equal(after.loops["fan"][state].tactile.samples, loop.tactile.samples)
    assert after.objects["fan"].states == before.objects["fan"].states
    radio = next(iter(before.loops["radio"]))
    assert not np.array_equal(after.loops["radio"][radio].tactile.samples, before.loops["radio"][radio].tactile.samples)


def test_a_sound_that_cannot_reach_its_level_warns_as_convert_does(
    kitchen: Callable[..., Path], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A click cannot be amplified to the level of a steady sound; a steady hum needs no warning."""
    folder, t = kitchen(), np.arange(4 * 44100) / 44100
    click, hum = tmp_path / "click.wav", tmp_path / "hum.wav"
    click.write_bytes(encoded((0.9 * (np.arange(len(t)) == 44100)).astype(np.float32), 44100))
    hum.write_bytes(encoded((0.5 * np.sin(2 * np.pi * 110.0 * t)).astype(np.float32), 44100))
    for sound, is_weak in ((click, True), (hum, False)):
        capsys.readouterr()
        assert main(["edit", str(folder), "sound", "radio", str(sound), "-q"]) == 0
        said = " ".join(capsys.readouterr().err.split())
        assert ("dB weaker than planned for its intensity" in said) == is_weak, said
        assert ("warning: radio, " in said) == is_weak, said


def test_a_bake_says_which_corrections_it_drops_and_can_be_undone(
    kitchen: Callable[..., Path], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """The table was renamed in the scene: its corrections are named, with the likely new id, and nothing is lost."""
    folder = kitchen()
    assert main(["edit", str(folder), "material", "oak table", "steel", "-q"]) == 0
    assert main(["edit", str(folder), "pitch", "fan", "97", "-q"]) == 0
    assert main(["edit", str(folder), "lock", "fan", "-q"]) == 0
    corrected = HapticBundle.load(folder)
    document = json.loads(Path(room(tmp_path)).read_text(encoding="utf-8"))
    for item in document["objects"]:
        if item["id"] == "oak table":
            item["id"] = item["name"] = "oak table.001"
    renamed = tmp_path / "renamed.json"
    renamed.write_text(json.dumps(document), encoding="utf-8")

    capsys.readouterr()
    assert main(["bake", str(renamed), "-o", str(folder)]) == 0
    shown = capsys.readouterr()
    assert "'oak table' is dropped" in shown.err
    assert "material. Did you mean 'oak table.001'?" in shown.err
    assert "undo" in shown.out
    assert main(["edit", str(folder), "undo", "-q"]) == 0
    assert HapticBundle.load(folder).overrides == corrected.overrides

    corrections = folder / "overrides.json"
    corrections.write_text(corrections.read_text().replace('"oak table"', '"oak table.001"'))
    assert main(["bake", str(renamed), "-o", str(folder), "-q"]) == 0
    baked = HapticBundle.load(folder)
    assert baked.overrides == {
        "oak table.001": corrected.overrides["oak table"],
        "fan": corrected.overrides["fan"],
    }
    assert baked.loops["fan"] == corrected.loops["fan"]


def test_a_bake_keeps_the_folder_that_it_cannot_read(
    kitchen: Callable[..., Path], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """After a typing mistake in one file, the edits by hand in all others are still there, and undo can be mended."""
    folder = kitchen()
    assert main(["edit", str(folder), "gain", "fan", "-6", "-q"]) == 0
    assert main(["edit", str(folder), "undo", "-q"]) == 0
    path = folder / "objects.json"
    objects = path.read_text(encoding="utf-8").replace('"usage": "', '"usage": "by hand: ', 1)
    path.write_text(objects[:-3], encoding="utf-8")
    capsys.readouterr()
    assert main(["bake", room(tmp_path), "-o", str(folder)]) == 0
    kept = folder.with_name(f"{folder.name}.before")
    said = " ".join(capsys.readouterr().out.split())
    assert "objects.json cannot be read" in said
    assert str(kept.name) in said
    assert (kept / "objects.json").read_text(encoding="utf-8") == objects[:-3]
    assert not folder.with_name(f"{folder.name}.after").exists()
    assert main(["edit", str(folder), "undo", "-q"]) == 1
    assert f"{kept.name}/objects.json" in capsys.readouterr().err.replace("\\", "/")
    (kept / "objects.json").write_text(objects, encoding="utf-8")
    assert main(["edit", str(folder), "undo", "-q"]) == 0
    assert any(one.usage.startswith("by hand: ") for one in HapticBundle.load(folder).objects.values())


def test_a_comparison_shows_sizes_and_constants(
    kitchen: Callable[..., Path], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    folder = kitchen()
    before = shutil.copytree(folder, tmp_path / "before.bundle")
    path = folder / "objects.json"
    objects = json.loads(path.read_text())
    objects["oak table"]["estimated_size_m"][2] = 0.03
    objects["oak table"]["material"]["youngs_modulus_pa"] = 8e9
    path.write_text(json.dumps(objects))
    rows = differences(HapticBundle.load(before), HapticBundle.load(folder))
    assert [row.what for row in rows] == ["material", "size"]
    assert "8e+09 Pa" in rows[0].other
    assert rows[1].other.endswith("0.03 m")


def test_a_comparison_says_whether_an_object_vibrates_and_runs_in_turns(
    fan: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    before = shutil.copytree(fan, tmp_path / "before.bundle")
    path = fan / "objects.json"
    objects = json.loads(path.read_text())
    objects["fan"]["states"][0].update(on_s=4.0, off_s=6.5)
    path.write_text(json.dumps(objects))
    (row,) = differences(HapticBundle.load(before), HapticBundle.load(fan))
    assert tuple(row) == ("fan", "turns on", "-", "4 s on, 6.5 s off")
    assert main(["edit", str(fan), "silence", "fan"]) == 0
    assert "fan, vibrates: yes -> no" in capsys.readouterr().out


def test_muting_an_object_that_does_not_vibrate_warns(
    kitchen: Callable[..., Path], capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["edit", str(kitchen()), "mute", "oak table", "-q"]) == 0
    assert "'oak table' does not vibrate; muted will change nothing until it does" in capsys.readouterr().err


def unreadable(folder: Path) -> dict[str, bytes]:
    """Edit a bundle by hand so that it cannot be read, and return its files."""
    (folder / "overrides.json").write_text('{"fann": {"gain_db": -6}}', encoding="utf-8")
    return files_of(folder)


def test_undo_replaces_a_bundle_that_cannot_be_read_and_keeps_it(fan: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["edit", str(fan), "gain", "fan", "-3", "-q"]) == 0
    edited = unreadable(fan)
    assert main(["edit", str(fan), "gain", "fan", "-9"]) == 1
    assert main(["edit", str(fan), "undo"]) == 0
    said = capsys.readouterr().out
    assert "the bundle that could not be read is in" in said
    assert "'fann'" in said
    assert HapticBundle.load(fan).gain_db("fan") == 0.0
    kept = fan.with_name("kitchen.bundle.after")
    assert files_of(kept) == edited
    assert main(["edit", str(fan), "redo"]) == 1
    assert "kitchen.bundle.after" in capsys.readouterr().err
    assert HapticBundle.load(fan).gain_db("fan") == 0.0


def test_a_bake_keeps_a_bundle_that_cannot_be_read(fan: Path, tmp_path: Path) -> None:
    answers = (fan / "objects.json").read_bytes().replace(b'"vibrates": true', b'"vibrates": ture')
    (fan / "objects.json").write_bytes(answers)
    assert main(["bake", room(tmp_path, "fan"), "-o", str(fan), "-q"]) == 0
    assert HapticBundle.load(fan).objects["fan"].vibrates
    assert (fan.with_name("kitchen.bundle.before") / "objects.json").read_bytes() == answers


@pytest.mark.parametrize("factor", [0.5, 8.0])
def test_a_bake_keeps_a_loop_that_was_edited_by_hand_or_the_folder_that_has_it(
    fan: Path, tmp_path: Path, factor: float, capsys: pytest.CaptureFixture[str]
) -> None:
    """A file of floats may peak over full scale, and no bundle can store it."""
    file = next((fan / "sounds").glob("*.tactile.wav"))
    samples, rate = soundfile.read(file)
    soundfile.write(file, samples * factor, rate, subtype="FLOAT")
    edited = file.read_bytes()
    assert main(["bake", room(tmp_path, "fan"), "-o", str(fan)]) == 0
    said = " ".join(capsys.readouterr().out.split())
    now, _ = soundfile.read(next((fan / "sounds").glob("*.tactile.wav")))
    assert (", edited" in said) == (factor < 1.0)
    if factor < 1.0:
        np.testing.assert_allclose(now, samples * factor, atol=2**-23)
    else:
        np.testing.assert_allclose(now, samples, atol=2**-23)
        assert "peaks over full scale" in said
        assert (fan.with_name("kitchen.bundle.before") / "sounds" / file.name).read_bytes() == edited


def test_reset_takes_back_the_corrections_of_one_object(
    kitchen: Callable[..., Path], capsys: pytest.CaptureFixture[str]
) -> None:
    folder = kitchen()
    baked = HapticBundle.load(folder)
    for words in (["silence", "fan"], ["material", "oak table", "steel"]):
        assert main(["edit", str(folder), *words, "-q"]) == 0
    capsys.readouterr()
    assert main(["edit", str(folder), "reset", "fan"]) == 0
    assert "fan, vibrates: no -> yes" in capsys.readouterr().out
    found = HapticBundle.load(folder)
    assert found.objects["fan"] == baked.objects["fan"]
    assert found.loops == baked.loops
    assert list(found.overrides) == ["oak table"]
    assert main(["edit", str(folder), "undo", "-q"]) == 0
    assert "fan" not in HapticBundle.load(folder).loops


def test_equal_bundles_are_said_to_be_equal(fan: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["edit", str(fan), "diff", str(fan)]) == 0
    assert capsys.readouterr().out == "no differences\n"


def test_an_answer_that_a_backend_without_a_network_loses_is_named(
    fan: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    complete = LexiconBackend.complete

    async def fails(self: LexiconBackend, request: LLMRequest) -> LLMReply:
        if request.component == "vibration_describer":
            raise BadAnswer("there is no answer today.")
        return await complete(self, request)

    monkeypatch.setattr(LexiconBackend, "complete", fails)
    assert main(["edit", str(fan), "name", "fan", "washing machine"]) == 0
    assert "there is no answer today" in capsys.readouterr().err
