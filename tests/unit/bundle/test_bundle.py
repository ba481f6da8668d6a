"""The bundle folder: round trips, content, and errors of unreadable bundles."""

import copy
import json
import pickle
import re
import shutil
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from files_of import files_of
from scene2hap import (
    AudioClip,
    Box,
    Credit,
    HapticBundle,
    HapticClip,
    HapticLoop,
    Pose,
    SceneObject,
    SceneSnapshot,
    bake,
    rebake,
)
from scene2hap.audio.sensation import Sensation
from scene2hap.bundle import BundleWarning
from scene2hap.clips.haptic_clip import Curve, Transient
from scene2hap.errors import BundleError, BundleIncomplete, BundleVersionError, CallError, UnknownObject
from scenes import box, haptics, scene, table_with_two_phones, tone_loop


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    return table_with_two_phones()[1].save(tmp_path / "room")


def with_meshes() -> HapticBundle:
    """Two objects that share a mesh, with ids that are difficult as file names."""
    mesh = Box((0.3, 0.3, 0.3)).mesh
    objects = [replace(box(name, (0.3,) * 3, (i, 0, 0)), geometry=mesh) for i, name in enumerate(["Куб/1", "Куб:2"])]
    snapshot = scene(*objects)
    ringing = haptics("oak", (0.3, 0.3, 0.3), "on/off", "on:off")
    loops = {
        name: {"on/off": tone_loop(50 + i), "on:off": tone_loop(90 + i)} for i, name in enumerate(["Куб/1", "Куб:2"])
    }
    return HapticBundle(snapshot, "room", dict.fromkeys(loops, ringing), loops)


def assert_same(a: HapticBundle, b: HapticBundle) -> None:
    assert a.snapshot == b.snapshot
    assert a.scene_category == b.scene_category
    assert a.objects == b.objects
    assert {key: list(states) for key, states in a.loops.items()} == {key: list(s) for key, s in b.loops.items()}
    for key, states in a.loops.items():
        for state, loop in states.items():
            other = b.loops[key][state]
            assert (loop.frequency_raw_hz, loop.frequency_tactile_hz) == (
                other.frequency_raw_hz,
                other.frequency_tactile_hz,
            )
            assert loop.audible.credit == other.audible.credit
            np.testing.assert_allclose(loop.tactile.samples, other.tactile.samples, atol=2**-23)


@pytest.mark.parametrize("make", [lambda: table_with_two_phones()[1], with_meshes])
def test_round_trip(tmp_path: Path, make: object) -> None:
    bundle = make()
    assert_same(HapticBundle.load(bundle.save(tmp_path / "b")), bundle)


def test_a_bundle_as_a_key_says_what_to_use() -> None:
    bundle = table_with_two_phones()[1]
    with pytest.raises(CallError, match="no key of a dictionary.*Use the path of its folder"):
        {bundle: 1}  # noqa: B018
    assert {bundle.snapshot: 1}[bundle.snapshot] == 1


def test_baked_bundle_equals_its_copies_and_no_other_bundle(tmp_path: Path) -> None:
    phone = SceneObject("smartphone", geometry=Box((0.07, 0.008, 0.15)))
    kettle = SceneObject("kettle", pose=Pose((1.0, 0.0, 0.0)), geometry=Box((0.2, 0.25, 0.2)))
    fan = SceneObject("desk fan", pose=Pose((2.0, 0.0, 0.0)), geometry=Box((0.2, 0.4, 0.2)))
    drawn = HapticClip(Curve([0.0, 0.5, 1.0], [0.2, 0.8, 0.3]), transients=[Transient(0.5, 1.0, 0.4)])
    humming = AudioClip(0.5 * np.sin(2 * np.pi * 120.0 * np.arange(4 * 48_000) / 48_000), 48_000)
    bundle = bake(SceneSnapshot.build([phone, kettle, fan]))
    corrected = rebake(bundle.override("kettle", clip=drawn, mass_kg=2.0).override("smartphone", clip=humming))
    for one in (bundle, corrected):
        assert HapticBundle.load(one.save(tmp_path / "b")) == one
        assert pickle.loads(pickle.dumps(one)) == one == copy.deepcopy(one)
    assert bundle != corrected
    (loop,), (other,) = bundle.loops["desk fan"].values(), bundle.loops["smartphone"].values()
    one_sample = loop.tactile.samples.copy()
    one_sample[7] += 2.0**-20
    changed = replace(loop, tactile=replace(loop.tactile, samples=one_sample))
    assert replace(bundle, loops={**bundle.loops, "desk fan": {"on": changed}}) != bundle
    twin = pickle.loads(pickle.dumps(loop))
    assert len({loop, twin, other, changed}) == 3
    assert len({drawn, copy.deepcopy(drawn), replace(drawn, range_hz=(60.0, 200.0))}) == 2
    assert loop.tactile != loop.audible
    assert (loop == "loop", loop.audible == 1, drawn.amplitude == drawn) == (False, False, False)


def test_instances_share_a_mesh_file_and_names_stay_apart(tmp_path: Path) -> None:
    folder = with_meshes().save(tmp_path / "b")
    assert len(list((folder / "meshes").iterdir())) == 1
    assert len(list((folder / "sounds").iterdir())) == 8  # all of them different


def test_saving_again_gives_the_same_bytes(tmp_path: Path) -> None:
    bundle = with_meshes()
    first = files_of(bundle.save(tmp_path / "one"))
    assert files_of(bundle.save(tmp_path / "two")) == first
    assert files_of(bundle.save(tmp_path / "one")) == first
    assert files_of(HapticBundle.load(tmp_path / "one").save(tmp_path / "three")) == first
    assert sorted(path.name for path in tmp_path.iterdir()) == ["one", "three", "two"]


def test_a_person_may_edit_the_json(folder: Path) -> None:
    path = folder / "objects.json"
    path.write_text(path.read_text(encoding="utf-8").replace('"usage": "stands there"', '"usage": "for eating"'))
    assert HapticBundle.load(folder).objects["table"].usage == "for eating"


def test_another_folder_is_not_overwritten(tmp_path: Path) -> None:
    (tmp_path / "letters").mkdir()
    (tmp_path / "letters" / "dear.txt").write_text("Dear Ann")
    with pytest.raises(BundleError, match="not empty and not a bundle"):
        table_with_two_phones()[1].save(tmp_path / "letters")
    assert (tmp_path / "letters" / "dear.txt").read_text() == "Dear Ann"


def test_a_failed_save_leaves_the_old_bundle(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(*_: object, **__: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("scene2hap.bundle.sounds.encoded", full)
    with pytest.raises(BundleError, match="No space left"):
        with_meshes().save(folder)
    monkeypatch.undo()
    assert_same(HapticBundle.load(folder), table_with_two_phones()[1])
    assert [path.name for path in folder.parent.iterdir()] == [folder.name]


def test_a_newer_version_is_refused(folder: Path) -> None:
    manifest = json.loads((folder / "bundle.json").read_text())
    (folder / "bundle.json").write_text(json.dumps({**manifest, "version": 2}))
    with pytest.raises(BundleVersionError, match=r"bundle version 2; this scene2hap reads up to 1\. Upgrade"):
        HapticBundle.load(folder)


@pytest.mark.parametrize(
    "name", ["bundle.json", "scene.json", "objects.json", "loops.json", "sounds/phone.ringing.tactile.wav"]
)
def test_missing_file_is_reported(folder: Path, name: str) -> None:
    (folder / name).unlink()
    with pytest.raises(BundleIncomplete, match=f"has no {name}|lacks {name} .1 missing"):
        HapticBundle.load(folder)


@pytest.mark.parametrize(
    "name", ["bundle.json", "scene.json", "objects.json", "loops.json", "sounds/phone.ringing.tactile.wav"]
)
def test_truncated_file_is_reported(folder: Path, name: str) -> None:
    whole = (folder / name).read_bytes()
    (folder / name).write_bytes(whole[: len(whole) // 2])
    with pytest.raises(BundleIncomplete, match=re.escape(str(Path(name)))):
        HapticBundle.load(folder)


def test_truncated_mesh_is_reported(tmp_path: Path) -> None:
    folder = with_meshes().save(tmp_path / "b")
    mesh = next((folder / "meshes").iterdir())
    mesh.write_bytes(mesh.read_bytes()[:-7])
    with pytest.raises(BundleIncomplete, match="PLY"):
        HapticBundle.load(folder)


def test_a_folder_that_is_no_bundle_is_refused(tmp_path: Path) -> None:
    with pytest.raises(BundleIncomplete, match="has no bundle.json"):
        HapticBundle.load(tmp_path)
    (tmp_path / "bundle.json").write_text("{}")
    with pytest.raises(BundleError, match="not a bundle"):
        HapticBundle.load(tmp_path)
    with pytest.raises(BundleIncomplete):
        HapticBundle.load(tmp_path / "nowhere")


def test_a_value_out_of_bounds_names_file_and_field(folder: Path) -> None:
    path = folder / "objects.json"
    path.write_text(path.read_text().replace('"density_kg_m3": 750.0', '"density_kg_m3": -750.0'))
    with pytest.raises(BundleError, match=r"objects\.json: table\.material.*density_kg_m3 is -750 kg/m3"):
        HapticBundle.load(folder)


def test_bundle_reads_only_files_in_its_folder(folder: Path) -> None:
    shutil.copy(folder / "sounds" / "phone.ringing.tactile.wav", folder.parent / "elsewhere.wav")
    path = folder / "loops.json"
    path.write_text(path.read_text().replace("sounds/phone.ringing.tactile.wav", "../elsewhere.wav"))
    with pytest.raises(BundleError, match=r"refers to '\.\./elsewhere\.wav', outside itself"):
        HapticBundle.load(folder)


def test_loops_of_a_missing_object_are_refused() -> None:
    snapshot, bundle = table_with_two_phones()
    with pytest.raises(UnknownObject, match="no object 'sofa'"):
        HapticBundle(snapshot, "room", bundle.objects, {"sofa": {"on": tone_loop(50)}})


def test_credits_are_written_once_each(tmp_path: Path) -> None:
    snapshot, bundle = table_with_two_phones()
    loop = bundle.loops["alarm"]["ringing"]
    owed = Credit("Buzz", "Ann", "CC-BY-4.0", "https://example.org/buzz")
    credited = HapticLoop(replace(loop.audible, credit=owed), loop.tactile, 100.0, 100.0)
    both = HapticBundle(
        snapshot, "room", bundle.objects, {"alarm": {"ringing": credited}, "phone": {"ringing": credited}}
    )
    text = (both.save(tmp_path / "b") / "credits.txt").read_text()
    assert text.count("Buzz, by Ann, CC-BY-4.0, https://example.org/buzz") == 1


def test_a_credit_in_broken_unicode_is_written(tmp_path: Path) -> None:
    """JSON of a service may hold half of a surrogate pair."""
    _, bundle = table_with_two_phones()
    loop = bundle.loops["alarm"]["ringing"]
    owed = Credit("Buzz", "Ann \ud83d", "CC-BY-4.0")
    credited = replace(loop, audible=replace(loop.audible, credit=owed))
    folder = replace(bundle, loops={**bundle.loops, "alarm": {"ringing": credited}}).save(tmp_path / "b")
    assert "Buzz, by Ann ?, CC-BY-4.0" in (folder / "credits.txt").read_text(encoding="utf-8")
    assert HapticBundle.load(folder).loops["alarm"]["ringing"].audible.credit == owed


def test_sensation_of_a_loop_round_trips(tmp_path: Path) -> None:
    _, bundle = table_with_two_phones()
    loop = bundle.loops["alarm"]["ringing"]
    felt = Sensation(14.0, 20.0, 98.0, loop.frequency_tactile_hz)
    loop = replace(loop, felt=felt)
    folder = replace(bundle, loops={**bundle.loops, "alarm": {"ringing": loop}}).save(tmp_path / "b")
    again = HapticBundle.load(folder)
    assert again.loops["alarm"]["ringing"].felt == felt
    assert again.loops["phone"]["ringing"].felt is None
    rows = json.loads((folder / "loops.json").read_text(encoding="utf-8"))
    rows["alarm"]["ringing"]["felt"]["level_db"] = "loud"
    (folder / "loops.json").write_text(json.dumps(rows), encoding="utf-8")
    with pytest.raises(BundleError, match="level_db"):
        HapticBundle.load(folder)


def test_a_melody_of_an_earlier_bundle_is_told_at_its_note(tmp_path: Path) -> None:
    """Earlier versions stored the middle of the notes: 88 Hz, moved by 10 Hz."""
    _, bundle = table_with_two_phones()
    folder = bundle.save(tmp_path / "b")
    rows = json.loads((folder / "loops.json").read_text(encoding="utf-8"))
    note_hz = rows["alarm"]["ringing"]["frequency_tactile_hz"]
    rows["alarm"]["ringing"]["felt"] = {"level_db": 14.0, "asked_level_db": 14.0, "own_hz": 88.0, "target_hz": 98.0}
    (folder / "loops.json").write_text(json.dumps(rows), encoding="utf-8")
    felt = HapticBundle.load(folder).loops["alarm"]["ringing"].felt
    assert felt is not None
    assert (felt.target_hz, felt.own_hz) == (note_hz, pytest.approx(note_hz - 10.0))


def test_a_misspelt_field_is_named(folder: Path) -> None:
    path = folder / "objects.json"
    document = json.loads(path.read_text())
    document["table"]["materal"] = "oak"
    document["table"]["material"]["los_factor"] = 0.1
    document["phone"]["states"][0]["spin"] = True
    path.write_text(json.dumps(document))
    with pytest.warns(BundleWarning) as found:
        HapticBundle.load(folder)
    warnings = [str(one.message) for one in found]
    assert len(warnings) == 3
    for name, right in (("materal", "material"), ("los_factor", "loss_factor"), ("spin", "spins")):
        assert any(f"field {name!r}, which" in one and f"Did you mean {right!r}" in one for one in warnings), warnings


def test_a_byte_order_mark_of_a_windows_editor_is_read_over(folder: Path) -> None:
    for name in ("objects.json", "overrides.json", "bundle.json", "loops.json", "scene.json"):
        path = folder / name
        path.write_bytes(b"\xef\xbb\xbf" + path.read_bytes())
    assert HapticBundle.load(folder).objects
