"""The command `scene2hap export`: files of all formats, and the manifest for engines."""

from __future__ import annotations

import json
import shutil
from pathlib import Path
from typing import Any

import jsonschema
import numpy as np
import pytest
import soundfile

from files_of import files_of
from scene2hap import (
    Box,
    HapticBundle,
    Pose,
    SceneObject,
    SceneSnapshot,
    Touch,
    bake,
    export_bundle,
    export_clip,
)
from scene2hap.audio.encoding import encoded
from scene2hap.audio.files import read_clip
from scene2hap.cli import main
from scene2hap.clips.haptic_format import read_haptic
from scene2hap.clips.reading import read_haptic_clip
from scene2hap.demo import tour_path
from scene2hap.errors import ClipError, ConfigError, ExportError
from scene2hap.export import EXPORTS, Exported, Track
from scene2hap.export.schema import manifest_schema
from scene2hap.session import HapticSession

DOCS = Path(__file__).parents[2] / "docs"
KINDS = tuple(EXPORTS.builtins)


@pytest.fixture(scope="module")
def exported(kitchen_bundle: Path, tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, dict[str, Any]]:
    """Export the kitchen and its tour in every format. Returns the folder and the manifest."""
    folder = tmp_path_factory.mktemp("out")
    assert main(["export", str(kitchen_bundle), "-o", str(folder), "--touches", str(tour_path()), "-q"]) == 0
    return folder, json.loads((folder / "manifest.json").read_text(encoding="utf-8"))


def test_every_state_and_every_hand_has_files_of_every_kind(
    exported: tuple[Path, dict[str, Any]], kitchen_bundle: Path
) -> None:
    folder, manifest = exported
    bundle = HapticBundle.load(kitchen_bundle)
    states = {(one["object_id"], state["name"]): state for one in manifest["sources"] for state in one["states"]}
    assert set(states) == {(key, state) for key, found in bundle.loops.items() for state in found}
    (tour,) = manifest["tours"]
    for entry in [*states.values(), tour]:
        assert {one["kind"] for one in entry["files"]} == set(KINDS)
        for one in entry["files"]:
            assert one["files"]
            assert all((folder / name).is_file() for name in one["files"])
    assert {one["channel"] for one in tour["files"]} == {"left", "right"}


def test_the_manifest_keeps_its_published_schema(exported: tuple[Path, dict[str, Any]]) -> None:
    published = json.loads((DOCS / "manifest.schema.json").read_text(encoding="utf-8"))
    assert published == manifest_schema()
    jsonschema.Draft202012Validator(published).validate(exported[1])


def test_paths_give_the_gains_of_a_session(exported: tuple[Path, dict[str, Any]], kitchen_bundle: Path) -> None:
    """The gain 5 cm beside a contact follows from the manifest's gains and decay."""
    bundle = HapticBundle.load(kitchen_bundle)
    session = HapticSession(bundle, config={"prepare": "blocking"})
    paths = [one for one in exported[1]["paths"] if one["source"] == "smartphone"]
    assert paths
    on = max((one for one in paths if one["decay_per_m"]), key=lambda one: one["gain"])
    mine = [one for one in paths if one["object_id"] == on["object_id"]]
    point = np.array(on["point_m"]) + np.array([0.03, 0.0, 0.04])
    frame = session.update(touches=[Touch("left", on["object_id"], tuple(point))])
    away = [one["gain"] * np.exp(-one["decay_per_m"] * np.linalg.norm(point - one["point_m"])) for one in mine]
    level = 10 ** (bundle.gain_db("smartphone") / 20)
    assert frame.gain("left", "smartphone") == pytest.approx(max(away) * level, rel=0.02)


def test_the_decay_of_a_path_is_at_the_frequency_of_the_law(kitchen_bundle: Path, tmp_path: Path) -> None:
    """Wavenumbers grow with the root of the frequency, so decays at raw and tactile frequencies have that ratio."""
    bundle = HapticBundle.load(kitchen_bundle)
    decays = []
    for frequency in ("raw", "tactile"):
        config = {"propagation": {"kind": "exponential_plate", "frequency": frequency}}
        export_bundle(bundle, tmp_path / frequency, "pcm", config=config)
        paths = json.loads((tmp_path / frequency / "manifest.json").read_text(encoding="utf-8"))["paths"]
        decays.append({(one["source"], one["object_id"]): one["decay_per_m"] for one in paths if one["decay_per_m"]})
    raw, tactile = decays
    shared = raw.keys() & tactile.keys()
    assert {source for source, _ in shared} >= {"smartphone", "refrigerator"}
    for source, on in shared:
        (loop,) = bundle.loops[source].values()
        ratio = np.sqrt(loop.frequency_raw_hz / loop.frequency_tactile_hz)
        assert raw[source, on] / tactile[source, on] == pytest.approx(ratio, rel=1e-9)


def test_the_report_is_text_and_json(exported: tuple[Path, dict[str, Any]]) -> None:
    folder, _ = exported
    report = json.loads((folder / "report.json").read_text(encoding="utf-8"))
    assert "\\" not in report["folder"]  # also on Windows: it is read elsewhere
    rows = report["files"]
    lines = (folder / "report.txt").read_text(encoding="utf-8").splitlines()
    assert len(rows) == len(lines)
    assert all(row["fidelity"]["median_db"] < 1.0 for row in rows)
    assert any("JND" in line for line in lines)


def test_one_clip_is_turned_into_other_formats_and_back(tmp_path: Path) -> None:
    points = [{"time": t, "amplitude": a} for t, a in ((0.0, 0.1), (0.4, 0.9), (1.0, 0.2))]
    points[1]["emphasis"] = {"amplitude": 1.0, "frequency": 0.5}
    envelopes = {"amplitude": points, "frequency": [{"time": 0.0, "frequency": 0.25}]}
    clip = tmp_path / "kettle.haptic"
    clip.write_text(json.dumps({"version": {"major": 1}, "signals": {"continuous": {"envelopes": envelopes}}}))
    export_clip(clip, tmp_path / "a", ["haptic", "ahap"])
    export_clip(tmp_path / "a" / "ahap" / "kettle.continuous.ahap", tmp_path / "b", "haptic")
    for made in ("a/haptic/kettle.haptic", "b/haptic/kettle-continuous.haptic"):
        path = next(tmp_path.glob(made.replace("kettle-continuous", "kettle*")))
        found = json.loads(path.read_text())["signals"]["continuous"]["envelopes"]
        for one, other in zip(found["amplitude"], points, strict=True):
            assert one["time"] == other["time"]
            assert one["amplitude"] == pytest.approx(other["amplitude"], abs=1e-6)
        assert found["amplitude"][1]["emphasis"] == pytest.approx(points[1]["emphasis"])
        assert found["frequency"][0]["frequency"] == pytest.approx(0.25, abs=1e-6)


def test_both_hands_of_a_sound_file_are_exported(tmp_path: Path) -> None:
    """In an earlier version a tour that `render` wrote was exported as the mean of both hands."""
    t = np.arange(8000) / 8000
    hands = np.stack([0.5 * np.sin(2 * np.pi * 100.0 * t), 0.2 * np.sin(2 * np.pi * 150.0 * t)], axis=1)
    soundfile.write(tmp_path / "tour.wav", hands, 8000, subtype="PCM_24")
    export_clip(tmp_path / "tour.wav", tmp_path / "out", ["haptic", {"kind": "wav", "sample_rate_hz": 8000}])
    played, _ = soundfile.read(tmp_path / "out" / "wav" / "tour.wav")
    np.testing.assert_allclose(played, hands, atol=1e-6)
    for hand, amplitude in (("left", 0.5), ("right", 0.2)):
        clip = read_haptic(tmp_path / "out" / "haptic" / f"tour.{hand}.haptic")
        assert clip.amplitude.at([0.5])[0] == pytest.approx(amplitude, rel=0.06)


def test_a_sound_beyond_full_scale_is_scaled_down(tmp_path: Path) -> None:
    loud = np.linspace(-2.0, 2.0, 801)
    soundfile.write(tmp_path / "loud.wav", loud, 48_000, subtype="FLOAT")
    export_clip(tmp_path / "loud.wav", tmp_path / "out", "wav")
    played, _ = soundfile.read(next((tmp_path / "out" / "wav").glob("*.wav")))
    np.testing.assert_allclose(played, loud / 2.0, atol=1e-4)


@pytest.mark.parametrize("loop", [None, (0, 1000), (200, 1000)])
def test_a_sound_file_that_is_marked_as_a_loop_stays_one(loop: tuple[int, int] | None, tmp_path: Path) -> None:
    hum = 0.5 * np.sin(2 * np.pi * 104 * np.arange(1000) / 8000)  # 13 cycles
    (tmp_path / "hum.wav").write_bytes(encoded(hum, 8000, loop=loop))
    export_clip(tmp_path / "hum.wav", tmp_path / "out", [{"kind": "pcm", "sample_rate_hz": 2000}, "wav"])
    header = json.loads((tmp_path / "out" / "pcm" / "hum.json").read_text())
    is_loop = loop == (0, 1000)
    assert header["loop"] is is_loop
    played = read_clip(tmp_path / "out" / "wav" / "hum.wav")
    assert played.loop == ((0, len(played.samples)) if is_loop else None)


def test_a_constant_offset_is_no_vibration(tmp_path: Path) -> None:
    t = np.arange(16000) / 8000
    ticks = np.where(np.arange(16000) % 1600 < 40, 0.6, 0.0)
    signals = {
        "constant": (0 * t + 0.3, 0 * t),
        "hum": (0.3 * np.sin(2 * np.pi * 100 * t) + 0.2, 0.3 * np.sin(2 * np.pi * 100 * t)),
        "ticks": (ticks, ticks),
        "offset_ticks": (ticks + 0.1, ticks),
        "half": (np.where(t < 1.4, np.abs(np.sin(2 * np.pi * 60 * t)), 0.0),) * 2,
    }
    for name, (given, expected) in signals.items():
        soundfile.write(tmp_path / f"{name}.wav", given, 8000, subtype="FLOAT")
        export_clip(tmp_path / f"{name}.wav", tmp_path / name, ["ahap", {"kind": "wav", "sample_rate_hz": 8000}])
        (made,) = (tmp_path / name / "wav").glob("*.wav")
        np.testing.assert_allclose(soundfile.read(made)[0], expected, atol=0.003, err_msg=name)
    clip = read_haptic_clip(tmp_path / "constant" / "ahap" / "constant.ahap")
    assert clip.amplitude.values.max() == 0.0


def test_a_full_disk_keeps_the_earlier_export(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Some file systems report a full disk only when a file is flushed."""
    for name, level in (("before", 0.1), ("after", 0.2)):
        (tmp_path / name).mkdir()
        soundfile.write(tmp_path / name / "x.wav", np.full(800, level), 8000)
    export_clip(tmp_path / "before" / "x.wav", tmp_path / "out")
    written = files_of(tmp_path / "out")

    def full(descriptor: int) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("os.fsync", full)
    with pytest.raises(ExportError, match="No space left on device"):
        export_clip(tmp_path / "after" / "x.wav", tmp_path / "out")
    assert files_of(tmp_path / "out") == written


@pytest.mark.parametrize("name", ["../x.bin", "below/x.bin", ""])
def test_an_exporter_writes_into_its_own_folder_only(tmp_path: Path, name: str) -> None:
    class Elsewhere:
        def export(self, track: Track) -> Exported:
            return Exported({name: b"x"})

    soundfile.write(tmp_path / "x.wav", np.zeros(800), 8000)
    with pytest.raises(ExportError, match="a name without a folder"):
        export_clip(tmp_path / "x.wav", tmp_path / "out", Elsewhere())
    assert [path.name for path in tmp_path.iterdir()] == ["x.wav"]


def test_invalid_requests_get_an_error_and_write_nothing(
    kitchen_bundle: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    bundle = HapticBundle.load(kitchen_bundle)
    monkeypatch.setattr("scene2hap.export.exporting.file_stems", lambda _: pytest.fail("the work was begun"))
    out = tmp_path / "out"
    for to, told in (
        ("hapic", "no kind 'hapic'. Did you mean 'haptic'?"),
        ({"kind": "haptic", "range_hz": [200, 55]}, r"range_hz\[1\] is 55 Hz; it must be above 200"),
        ({"kind": "hjif", "profile": "Simple"}, "it must be Simple Parametric or Main"),
        ({"kind": "openxr_pcm", "sample_rate_hz": 0}, "sample_rate_hz is 0 Hz; it must be at least 100"),
        ({"kind": "ahap", "colour": 1}, r"does not take {'colour': 1}: .*Call CurveSettings\(.*\)\.$"),
        ([], "it must name a kind"),
        (out, "to is a path, '.*out'; it names kinds, as 'wav'. Give it as folder="),
    ):
        with pytest.raises(ConfigError, match=told):
            export_bundle(bundle, out, to)
    assert not out.exists()
    (tmp_path / "file").write_text("")
    with pytest.raises(ExportError, match="cannot be written"):
        export_bundle(bundle, tmp_path / "file", "haptic")
    with pytest.raises(ClipError, match="absent.haptic"):
        export_clip(tmp_path / "absent.haptic", out)
    assert main(["export", str(tmp_path / "nowhere"), "-o", str(out)]) == 1
    assert "there is no folder" in capsys.readouterr().err
    sound = tmp_path / "x.haptic"
    sound.write_text("{}")
    assert main(["export", str(sound), "-o", str(out), "--touches", "t.json"]) == 1
    assert "need a bundle" in capsys.readouterr().err
    assert not out.exists()


def test_a_bundle_is_no_folder_for_an_export(
    kitchen_bundle: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    folder = shutil.copytree(kitchen_bundle, tmp_path / "kitchen.bundle")
    written = files_of(folder)
    assert main(["export", str(folder), "--to", "wav", "-o", str(folder)]) == 1
    assert "is a bundle; an export is no part of it" in capsys.readouterr().err
    with pytest.raises(ExportError, match="is a bundle"):
        export_clip(next((folder / "sounds").glob("*.tactile.wav")), folder, "wav")
    assert files_of(folder) == written


def test_scenes_without_sources_or_with_one_object_are_exported(tmp_path: Path) -> None:
    table = SceneObject("oak table", geometry=Box((1.2, 0.05, 0.7)))
    silent = bake(SceneSnapshot.build([table]))
    report = export_bundle(silent, tmp_path / "silent")
    assert report.rows == ()
    assert json.loads((tmp_path / "silent" / "manifest.json").read_text())["paths"] == []
    phone = SceneObject("smartphone", pose=Pose((5.0, 1.0, 0.0)), geometry=Box((0.07, 0.01, 0.15)))
    alone = bake(SceneSnapshot.build([phone]))
    assert {row.kind for row in export_bundle(alone, tmp_path / "alone").rows} == set(KINDS)
    assert json.loads((tmp_path / "alone" / "manifest.json").read_text())["paths"] == []
