"""The manifest of an export: an engine places files by it, so each number is that of the scene and the bundle."""

from __future__ import annotations

import json
import os
import warnings
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import soundfile
from numpy.typing import NDArray

from scene2hap import SceneWarning
from scene2hap.audio.run_curve import RunCurve
from scene2hap.errors import ExportError
from scene2hap.export import export_bundle, export_clip
from scene2hap.export.protocol import Exported
from scene2hap.export.track import Track
from scenes import table_with_two_phones


def test_objects_and_states_of_a_manifest_are_those_of_the_bundle(tmp_path: Path) -> None:
    _, bundle = table_with_two_phones()
    bundle = bundle.override("table", mass_kg=12.5).override("phone", gain_db=-3.0, start_up_s={"alarm": 0.5})
    known = {name: one for name, one in bundle.objects.items() if name != "cup"}
    export_bundle(replace(bundle, objects=known), tmp_path, "pcm")
    manifest = json.loads((tmp_path / "manifest.json").read_text(encoding="utf-8"))
    objects = {one["id"]: one for one in manifest["objects"]}
    table = objects["table"]
    assert (table["category"], table["material"]) == ("thing", "oak")
    assert table["position_m"] == pytest.approx([0.8, 0.71, 0.4])
    assert table["size_m"] == pytest.approx([1.6, 0.8, 0.02])  # longest first
    assert table["rotation_xyzw"] == [0.0, 0.0, 0.0, 1.0]
    assert table["mass_kg"] == 12.5
    assert objects["phone"]["material"] == "glass"
    assert (objects["block"]["category"], objects["block"]["material"]) == ("thing", None)
    assert (objects["cup"]["category"], objects["cup"]["material"], objects["cup"]["mass_kg"]) == (
        "unknown",
        None,
        None,
    )
    sources = {one["object_id"]: one for one in manifest["sources"]}
    assert (sources["phone"]["gain_db"], sources["phone"]["muted"]) == (-3.0, False)
    states = {state["name"]: state for state in sources["phone"]["states"]}
    assert {name: state["frequency_hz"] for name, state in states.items()} == pytest.approx(
        {"ringing": 100.0, "alarm": 240.0}, abs=0.5
    )
    assert {name: state["start_up_s"] for name, state in states.items()} == {"ringing": 0.0, "alarm": 0.5}
    for state in states.values():
        header = json.loads((tmp_path / state["files"][0]["files"][0]).read_text(encoding="utf-8"))
        assert header["frame_count"] / header["sample_rate_hz"] == pytest.approx(state["duration_s"])


def test_a_manifest_says_which_sources_run_and_rest_in_turns(tmp_path: Path) -> None:
    _, bundle = table_with_two_phones()
    haptics = bundle.objects["phone"]
    ringing = replace(next(one for one in haptics.states if one.name == "ringing"), on_s=2.0, off_s=4.0)
    states = tuple(ringing if one.name == "ringing" else one for one in haptics.states)
    bundle = replace(bundle, objects={**bundle.objects, "phone": replace(haptics, states=states)})
    export_bundle(bundle, tmp_path, "pcm")
    manifest = json.loads((tmp_path / "manifest.json").read_text(encoding="utf-8"))
    phone = next(one for one in manifest["sources"] if one["object_id"] == "phone")
    turns = {state["name"]: (state["on_s"], state["off_s"]) for state in phone["states"]}
    assert turns == {"ringing": (2.0, 4.0), "alarm": (None, None)}


def test_an_engine_can_start_and_stop_sources_by_a_manifest(tmp_path: Path) -> None:
    _, bundle = table_with_two_phones()
    haptics, loops = bundle.objects["phone"], bundle.loops["phone"]
    ringing, alarm = haptics.states
    states = (replace(ringing, spins=True, start_up_s=2.0, wind_down_s=1.0), replace(alarm, start_up_s=0.5))
    recorded = RunCurve(1.0, (1.0, 0.4, 0.1, 0.0), (1.0, 0.9, 0.5, 0.2))
    loops = {**loops, "ringing": replace(loops["ringing"], wind_down=recorded)}
    objects = {**bundle.objects, "phone": replace(haptics, states=states)}
    export_bundle(replace(bundle, objects=objects, loops={**bundle.loops, "phone": loops}), tmp_path, "pcm")
    manifest = json.loads((tmp_path / "manifest.json").read_text(encoding="utf-8"))
    phone = next(one for one in manifest["sources"] if one["object_id"] == "phone")
    first, second = phone["states"]
    assert (first["spins"], second["spins"]) == (True, False)
    assert first["wind_down"] == {"amplitude": [1.0, 0.4, 0.1, 0.0], "speed": [1.0, 0.9, 0.5, 0.2]}
    assert second["wind_down"] is None
    # Between the points an engine draws lines. A motor's speed is x (2 - x), and the force of an unbalance its square.
    x = np.linspace(0, 1, 1001)

    def at(course: list[float]) -> NDArray[np.float64]:
        return np.interp(x, np.linspace(0, 1, len(course)), course)

    speed = x * (2 - x)
    assert at(first["start_up"]["speed"]) == pytest.approx(speed, abs=0.002)
    assert at(first["start_up"]["amplitude"]) == pytest.approx(speed**2, abs=0.002)
    assert at(second["start_up"]["speed"]) == pytest.approx(np.ones(1001))
    assert at(second["start_up"]["amplitude"]) == pytest.approx((1 - np.cos(np.pi * x)) / 2, abs=0.002)


def test_files_of_sources_that_are_gone_are_removed(tmp_path: Path) -> None:
    _, bundle = table_with_two_phones()
    export_bundle(bundle, tmp_path, ["wav", "haptic"])
    (tmp_path / "wav" / "mine.wav").write_bytes(b"mine")
    gone = next(key for key in bundle.loops if key != "phone")
    before = {path.relative_to(tmp_path).as_posix() for path in tmp_path.rglob("*.*")}
    with pytest.warns(SceneWarning, match=r"manifest\.json no longer lists 3 files of an earlier export"):
        report = export_bundle(bundle.override(gone, vibrates=False), tmp_path, "wav")
    after = {path.relative_to(tmp_path).as_posix() for path in tmp_path.rglob("*.*")}
    # The format that was not written again stays, and so does what no manifest lists.
    assert before - after == {*report.removed}
    assert report.removed
    assert all(name.startswith("wav/") for name in report.removed)
    assert "wav/mine.wav" in after
    assert not any(b"smpl" not in path.read_bytes() for path in (tmp_path / "wav").glob("phone*.wav"))


def test_an_export_beside_one_of_another_scene_or_kind_warns(tmp_path: Path) -> None:
    scene, bundle = table_with_two_phones()
    export_bundle(bundle, tmp_path, ["wav", "haptic"])
    n_loops = sum(map(len, bundle.loops.values()))
    with pytest.warns(
        SceneWarning, match=rf"lists {n_loops} files .* of 'test room', which stay in the folder: haptic\. "
    ):
        export_bundle(bundle, tmp_path, "wav")
    other = replace(bundle, snapshot=replace(scene, name="attic")).override("phone", vibrates=False)
    with pytest.warns(SceneWarning, match="an earlier export of 'test room', which stay in the folder: wav"):
        export_bundle(other, tmp_path, "wav")
    with warnings.catch_warnings():
        warnings.simplefilter("error", SceneWarning)
        for _ in range(2):
            export_bundle(other, tmp_path / "attic", "wav")


def test_no_file_outside_is_removed_for_a_manifest_that_lists_it(tmp_path: Path) -> None:
    _, bundle = table_with_two_phones()
    out = tmp_path / "out"
    export_bundle(bundle, out, "wav")
    victim = tmp_path / "victim.wav"
    victim.write_bytes(b"mine")
    text = (out / "manifest.json").read_text(encoding="utf-8")
    listed = next(path.name for path in (out / "wav").iterdir())
    (out / "manifest.json").write_text(text.replace(f"wav/{listed}", "wav/../../victim.wav"), encoding="utf-8")
    assert export_bundle(bundle, out, "wav").removed == ()
    assert victim.exists()


class FailsAt:
    """Exports the first tracks, and fails at the last one."""

    def __init__(self, cause: BaseException, n_tracks: int) -> None:
        self._cause, self._n_left = cause, n_tracks

    def export(self, track: Track) -> Exported:
        self._n_left -= 1
        if self._n_left == 0:
            raise self._cause
        return Exported({f"{track.name}.txt": b"new"})


@pytest.mark.parametrize("cause", [ExportError("no such rate"), OSError(28, "No space left"), KeyboardInterrupt()])
def test_an_export_that_fails_midway_leaves_the_files_of_the_one_before(tmp_path: Path, cause: BaseException) -> None:
    _, bundle = table_with_two_phones()
    n_tracks = sum(map(len, bundle.loops.values()))
    export_bundle(bundle, tmp_path, "wav")
    before = {path: path.read_bytes() for path in tmp_path.rglob("*") if path.is_file()}
    with pytest.raises(type(cause)):
        export_bundle(bundle, tmp_path, [{"kind": "wav", "sample_rate_hz": 1000}, FailsAt(cause, n_tracks)])
    assert {path: path.read_bytes() for path in tmp_path.rglob("*") if path.is_file()} == before


def test_a_folder_in_the_place_of_a_file_is_found_before_any_is_replaced(tmp_path: Path) -> None:
    _, bundle = table_with_two_phones()
    last = tmp_path / export_bundle(bundle, tmp_path, "wav").files[-1]
    last.unlink()
    last.mkdir()
    before = {path: path.read_bytes() for path in tmp_path.rglob("*") if path.is_file()}
    with pytest.raises(ExportError, match=rf"{last.name} cannot be written: "):
        export_bundle(bundle, tmp_path, {"kind": "wav", "sample_rate_hz": 1000})
    assert {path: path.read_bytes() for path in tmp_path.rglob("*") if path.is_file()} == before


def test_a_file_that_cannot_be_replaced_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """On Windows, because an engine has it open."""
    _, bundle = table_with_two_phones()
    held = tmp_path / export_bundle(bundle, tmp_path, "wav").files[-1]
    rename = os.replace

    def refuse(draft: str, path: str) -> None:
        if Path(path) == held:
            raise PermissionError(13, "Access is denied")
        rename(draft, path)

    monkeypatch.setattr(os, "replace", refuse)
    with pytest.raises(ExportError, match=rf"{held.name} cannot be written: Access is denied"):
        export_bundle(bundle, tmp_path, "wav")
    assert not any(path.name.startswith(".") for path in tmp_path.rglob("*"))


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("manifest.json", '{"name": "my web page", "start_url": "index.html"}'),
        ("manifest.json", "[1]"),
        ("manifest.json", "{"),
        ("report.json", '{"scenes": [{"cost_usd": 1.5}]}'),
    ],
)
def test_a_file_of_another_program_is_not_replaced(tmp_path: Path, name: str, text: str) -> None:
    _, bundle = table_with_two_phones()
    (tmp_path / name).write_text(text, encoding="utf-8")
    with pytest.raises(ExportError, match=rf"{name} was not written by an export .* folder of its own"):
        export_bundle(bundle, tmp_path, "wav")
    assert [path.name for path in tmp_path.iterdir()] == [name]
    assert (tmp_path / name).read_text(encoding="utf-8") == text


def test_a_clip_replaces_neither_a_report_nor_the_files_beside_it(tmp_path: Path) -> None:
    clip = tmp_path / "clip.wav"
    soundfile.write(clip, np.sin(np.arange(4000) * 0.2), 8000)
    out = tmp_path / "out"
    out.mkdir()
    (out / "manifest.json").write_text('{"name": "my web page"}', encoding="utf-8")  # a clip has no manifest
    for _ in range(2):
        export_clip(clip, out, "pcm")
    (out / "report.json").write_text('{"scenes": []}', encoding="utf-8")
    before = {path: path.read_bytes() for path in out.rglob("*.*")}
    with pytest.raises(ExportError, match=r"report\.json was not written by an export"):
        export_clip(clip, out, "haptic")
    assert {path: path.read_bytes() for path in out.rglob("*.*")} == before
