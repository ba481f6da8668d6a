"""A damaged bundle is read, or refused with a `BundleError`: no other error, and no wait for a pipe."""

import contextlib
import json
import os
from pathlib import Path
from typing import Any

import pytest
import soundfile

from scene2hap import HapticBundle, materials
from scene2hap.bundle import BundleWarning
from scene2hap.cli import main
from scene2hap.cli.console import Console
from scene2hap.cli.tables import show_bundle
from scene2hap.errors import BundleError, BundleIncomplete
from scenes import scene, table_with_two_phones, tone_loop

DOCUMENTS = ("bundle.json", "scene.json", "objects.json", "loops.json", "overrides.json")
ODD: tuple[Any, ...] = (
    None,
    True,
    -1,
    10**400,
    1e308,
    float("nan"),
    "",
    "\ud800",
    "\0",
    "a" * 10_000,
    [],
    {},
    [[]],
    ["x"],
)

pytestmark = pytest.mark.filterwarnings("ignore::scene2hap.bundle.checking.BundleWarning")


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    bundle = table_with_two_phones()[1].override("phone", gain_db=-3.0, material="oak")
    return bundle.override("alarm", clip=bundle.loops["alarm"]["ringing"].audible).save(tmp_path / "room")


@pytest.fixture
def small_folder(tmp_path: Path) -> Path:
    """A bundle with one object and one source, both with corrections."""
    snapshot, whole = table_with_two_phones()
    kept = ("table", "phone")
    loops = {"phone": {name: tone_loop(120.0, seconds=0.1) for name in whole.loops["phone"]}}
    bundle = HapticBundle(
        scene(*(snapshot.object(name) for name in kept)), "room", {name: whole.objects[name] for name in kept}, loops
    )
    bundle = bundle.override("table", material="steel").override("phone", gain_db=-3.0, material="oak")
    return bundle.override("phone", clip=loops["phone"]["ringing"].audible).save(tmp_path / "room")


def read(folder: Path) -> None:
    told = str(folder)
    try:
        bundle = HapticBundle.load(folder)
        show_bundle(Console(quiet=True), bundle)  # what is read can be shown
    except BundleError as error:
        told = str(error)
    assert str(folder) in told
    assert len(told) < 12_000


def places(document: Any) -> list[tuple[Any, Any]]:
    items = list(document.items() if isinstance(document, dict) else enumerate(document))
    below = [place for _, value in items if isinstance(value, dict | list) for place in places(value)]
    return [(document, key) for key, _ in items] + below


@pytest.mark.parametrize("name", DOCUMENTS)
def test_any_changed_or_removed_value_is_read_or_refused(small_folder: Path, name: str) -> None:
    path = small_folder / name
    whole = path.read_text(encoding="utf-8")
    for at in range(len(places(json.loads(whole)))):
        for value in (*ODD[at % 3 :: 3], ...):
            document = json.loads(whole)
            holder, key = places(document)[at]
            if value is ...:
                del holder[key]
            else:
                holder[key] = value
            path.write_text(json.dumps(document), encoding="utf-8")
            read(small_folder)


def test_any_readable_bundle_can_be_written(folder: Path) -> None:
    """A bundle with texts that no encoding can write can be saved and loaded again."""
    path = folder / "overrides.json"
    whole = path.read_text(encoding="utf-8")
    written = 0
    for at in range(len(places(json.loads(whole)))):
        document = json.loads(whole)
        holder, key = places(document)[at]
        holder[key] = "\ud800"
        path.write_text(json.dumps(document), encoding="utf-8")
        try:
            bundle = HapticBundle.load(folder)
        except BundleError:
            continue
        bundle.save(folder.parent / "again")
        HapticBundle.load(folder.parent / "again")
        written += 1
    assert written > 3


@pytest.mark.parametrize("name", DOCUMENTS)
@pytest.mark.parametrize(
    "content",
    [b"", b"null", b"[]", b"{}", b"NaN", b"[" * 100_000, b'{"a":' * 100_000, b"1" * 9000, b"\xff\xfe{\0}\0", b"\x80"],
    ids=lambda content: repr(content[:6]),
)
def test_any_replaced_document_is_read_or_refused(folder: Path, name: str, content: bytes) -> None:
    (folder / name).write_bytes(content)
    read(folder)


@pytest.mark.skipif(os.name != "posix", reason="pipes and links")
@pytest.mark.parametrize("kind", ["folder", "pipe", "circle", "outside", "device", "dangling", "sparse"])
@pytest.mark.parametrize("name", [*DOCUMENTS, "sounds/phone.ringing.tactile.wav"])
def test_special_file_in_place_of_a_file_is_refused(folder: Path, name: str, kind: str) -> None:
    path = folder / name
    path.unlink(missing_ok=True)
    path = path if name in DOCUMENTS else sorted((folder / "sounds").glob("*.wav"))[0]
    path.unlink(missing_ok=True)
    (folder.parent / "outside").write_text("{}")
    if kind == "folder":
        path.mkdir()
    elif kind == "pipe":
        os.mkfifo(path)
    elif kind == "sparse":
        with path.open("wb") as file:
            file.truncate(1 << 36)
    else:
        where = {"circle": path.name, "outside": folder.parent / "outside", "device": "/dev/zero", "dangling": "none"}
        path.symlink_to(where[kind])
    if kind == "dangling" and name == "overrides.json":
        read(folder)
        return
    with pytest.raises(BundleError):
        HapticBundle.load(folder)


def test_names_that_are_not_utf_8_round_trip(tmp_path: Path) -> None:
    """Such names come from file systems; JSON can escape them, but UTF-8 cannot encode them."""
    bundle = table_with_two_phones()[1]
    odd = HapticBundle(bundle.snapshot, "caf\udce9", bundle.objects, bundle.loops)
    assert HapticBundle.load(odd.save(tmp_path / "room")).scene_category == "caf\udce9"


def test_number_beyond_any_bound_is_refused(folder: Path) -> None:
    path = folder / "objects.json"
    path.write_text(path.read_text().replace('"density_kg_m3": 750.0', '"density_kg_m3": 1' + "0" * 400))
    with pytest.raises(BundleError, match=r"objects\.json: table.*(finite|number)"):
        HapticBundle.load(folder)


def test_source_missing_from_objects_json_is_refused(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = folder / "objects.json"
    whole = json.loads(path.read_text())
    path.write_text(json.dumps({key: row for key, row in whole.items() if key != "phone"}))
    with pytest.raises(BundleError, match=r"objects\.json lacks 'phone'"):
        HapticBundle.load(folder)
    path.write_text(json.dumps({key: row for key, row in whole.items() if key != "table"}))
    assert main(["report", str(folder), "table"]) == 1
    assert "no properties were inferred for it" in capsys.readouterr().err


def test_a_loop_that_an_audio_editor_has_cut_is_named_by_object_and_state(folder: Path) -> None:
    path = folder / "sounds" / "phone.ringing.tactile.wav"
    samples, rate_hz = soundfile.read(path)
    soundfile.write(path, samples[:-1], rate_hz, subtype="PCM_24")
    with pytest.raises(BundleIncomplete, match=r"loops\.json: 'phone', state 'ringing': the audible loop has"):
        HapticBundle.load(folder)


def test_a_file_that_is_too_large_is_not_read(folder: Path) -> None:
    with (folder / "scene.json").open("wb") as file:
        file.truncate(1 << 40)
    with pytest.raises((BundleError, BundleIncomplete), match="bytes; it must be at most"):
        HapticBundle.load(folder)


@pytest.mark.parametrize(
    ("corrections", "sentence"),
    [
        ({"phone": {"gain": -6}}, r"'phone': there is no field 'gain'. Did you mean 'gain_db'\?"),
        ({"phone": {"gain_db": "-6"}}, "'phone': gain_db is '-6'; it must be a number"),
        ({"phone": {"pitch_hz": 0.12}}, "'phone': pitch_hz is 0.12 Hz; it must be at least 10"),
        ({"table": {"material": "oka"}}, "'table': no material 'oka'.* 'oak'"),
        ({"phone": {"clip": "my_fan.wav"}}, "'phone': clip is 'my_fan.wav'; .* edit BUNDLE sound ID FILE"),
        ({"phon": {"gain_db": -6.0}}, r"no object 'phon'. Did you mean 'phone'\?"),
        ({"phone": -6}, "'phone': corrections are -6; they must be an object"),
        ({"format": "scene2hap/overrides", "version": 1, "overrides": {}}, "report page.* edit .* apply FILE"),
    ],
)
def test_a_wrong_correction_names_file_object_and_field(tmp_path: Path, corrections: object, sentence: str) -> None:
    """The folder has the name of one letter, which also occurs in the names of fields."""
    folder = table_with_two_phones()[1].save(tmp_path / "h")
    with contextlib.chdir(tmp_path):
        (folder / "overrides.json").write_text(json.dumps(corrections))
        with pytest.raises(BundleError, match=rf"^h.overrides\.json.*{sentence}"):
            HapticBundle.load("h")


def test_a_correction_of_a_missing_state_warns(folder: Path) -> None:
    (folder / "overrides.json").write_text(json.dumps({"phone": {"pitch_hz": {"Ringing!": 120.0}, "state": "high"}}))
    with pytest.warns(BundleWarning) as found:
        HapticBundle.load(folder)
    sentences = [str(one.message) for one in found]
    assert any("no state 'Ringing!', so that pitch_hz has no effect" in one for one in sentences)
    assert any("no state 'high', so that state has no effect" in one for one in sentences)


def change_table(folder: Path, **fields: object) -> None:
    path = folder / "objects.json"
    answers = json.loads(path.read_text())
    answers["table"] |= fields
    path.write_text(json.dumps(answers))


def test_a_material_in_objects_json_may_be_a_name(folder: Path) -> None:
    change_table(folder, material="oak")
    assert HapticBundle.load(folder).objects["table"].material == materials.lookup("oak")
    change_table(folder, material="oka")
    with pytest.raises(BundleError, match=r"objects\.json: 'table': no material 'oka'"):
        HapticBundle.load(folder)


def test_a_value_of_another_type_is_named(folder: Path) -> None:
    change_table(folder, mass_kg="75 kg")
    with pytest.raises(BundleError, match=r"objects\.json: table\.mass_kg is '75 kg': "):
        HapticBundle.load(folder)


def test_the_name_of_an_actuator_in_the_manifest_points_to_the_command(folder: Path) -> None:
    path = folder / "bundle.json"
    manifest = json.loads(path.read_text())
    actuator = {"actuator": "lra", "tactile": {}, "spread": {}, "seed": 0}
    path.write_text(json.dumps({**manifest, "made_with": actuator}))
    with pytest.raises(BundleError, match="made_with.actuator is 'lra'; .* rebake --actuator NAME"):
        HapticBundle.load(folder)
