"""Damaged files and replies that `stress/hostile_files.py` found: each gives an error of the library that names it."""

from __future__ import annotations

import asyncio
import contextlib
import json
import os
import sys
import time
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import soundfile
from PIL import Image

from gltf_builder import one_cube
from llm_server import GOOD, request
from scene2hap import FunctionBackend, LLMRequest, load_scene
from scene2hap.audio.actuators import read_response_csv
from scene2hap.audio.conversion import convert
from scene2hap.audio.files import read_clip
from scene2hap.audio.sources.disk_cache import Store
from scene2hap.audio.sources.library import FolderLibrary
from scene2hap.baking import BakeConfig
from scene2hap.baking.many.record import read_record
from scene2hap.common.web import WebReply
from scene2hap.errors import AudioError, BadAnswer, ConfigError, Scene2HapError, SceneError, SessionError
from scene2hap.haptics import VibrationDescription
from scene2hap.llm.backends.chat import counts
from scene2hap.llm.batch.folder import BatchFolder, BatchRow
from scene2hap.llm.batch.service import BatchService
from scene2hap.llm.chain import infer_scene
from scene2hap.llm.validation import find_fault
from scene2hap.llm.wrappers import CacheBackend, RepairBackend
from scene2hap.report.account import account_table
from scene2hap.scene.capture.given_pictures import GivenPictures
from scene2hap.session.touch_track import TouchTrack
from scenes import table_with_two_phones

LONGEST = 1500
DIGITS = "9" * 5000
NESTED = "[" * 100_000


def message_of(kind: type[Scene2HapError], act: Callable[[], object]) -> str:
    """The message of the error of this kind that a call raises, without warnings."""
    with warnings.catch_warnings(), pytest.raises(kind) as caught:
        warnings.simplefilter("error", RuntimeWarning)
        act()
    assert len(str(caught.value)) < LONGEST
    return str(caught.value)


# -- scenes -----------------------------------------------------------------------------------------------------------


def test_an_error_of_a_scene_names_its_file(tmp_path: Path) -> None:
    gltf = one_cube()
    gltf.header["accessors"][0]["count"] = 4
    path = gltf.write(tmp_path / "room.glb")
    assert message_of(SceneError, lambda: load_scene(path)).startswith("'room.glb': node 'cube', meshes[0]")


def test_a_signalling_nan_is_refused_without_a_warning_of_numpy(tmp_path: Path) -> None:
    gltf = one_cube()
    gltf.buffer[:4] = bytes.fromhex("0100807f")
    path = gltf.write(tmp_path / "room.glb")
    assert "every coordinate must be finite" in message_of(SceneError, lambda: load_scene(path))


def test_a_long_value_in_the_place_of_a_number_is_shown_shortened(tmp_path: Path) -> None:
    gltf = one_cube()
    gltf.header["accessors"][0]["bufferView"] = [0] * 5000
    path = gltf.write(tmp_path / "room.glb")
    assert "refers to bufferViews" in message_of(SceneError, lambda: load_scene(path))


def test_an_error_of_a_mesh_within_a_scene_names_both_files(tmp_path: Path) -> None:
    (tmp_path / "lid.obj").write_text("v 0 0 0\nf 1 2 9\n")
    path = tmp_path / "chest.urdf"
    shape = '<visual><geometry><mesh filename="lid.obj"/></geometry></visual>'
    path.write_text(f'<robot name="chest"><link name="a">{shape}</link></robot>')
    said = message_of(SceneError, lambda: load_scene(path))
    assert "chest.urdf" in said
    assert "lid.obj" in said


@pytest.mark.parametrize("far", ["geometry", "pose"])
def test_coordinates_of_a_scene_in_json_are_bounded(far: str, tmp_path: Path) -> None:
    corners = [[0, 0, 0], [1, 0, 0], [0, 0, 1], [0, -1e308 if far == "geometry" else 1, 0]]
    mesh = {"kind": "mesh", "vertices_m": corners, "faces": [[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]]}
    pose = {"position_m": [0, 0, -1e300 if far == "pose" else 0]}
    row = {"id": "wedge", "name": "wedge", "pose": pose, "geometry": mesh}
    path = tmp_path / "room.json"
    path.write_text(
        json.dumps({"format": "scene2hap/scene", "version": 1, "name": "r", "up_axis": "y", "objects": [row]})
    )
    said = message_of(SceneError, lambda: load_scene(path))
    assert "room.json" in said
    assert "'wedge' is placed or scaled beyond 1e+06 m" in said


@pytest.mark.parametrize("line", [f"f 1 2 {DIGITS}", f"f 1 2 {'x' * 5000}", f"v 0 {'x' * 5000} 1"])
def test_a_long_line_of_an_obj_file_is_shown_shortened(line: str, tmp_path: Path) -> None:
    path = tmp_path / "room.obj"
    path.write_text(f"v 0 0 0\nv 1 0 0\nv 0 1 0\n{line}\n")
    assert "line 4" in message_of(SceneError, lambda: load_scene(path))


def test_a_long_name_in_a_ply_file_is_shown_shortened(tmp_path: Path) -> None:
    path = tmp_path / "box.ply"
    head = f"ply\nformat ascii 1.0\nelement vertex 1\nproperty {'x' * 5000} x\nend_header\n0\n"
    path.write_text(head)
    assert "box.ply" in message_of(SceneError, lambda: load_scene(path))


@pytest.mark.parametrize("number", ["nan", "inf", "-1e999"])
def test_a_texture_coordinate_that_is_not_finite_becomes_0(number: str, tmp_path: Path) -> None:
    (tmp_path / "room.mtl").write_text("newmtl oak\nmap_Kd oak.png\n")
    Image.new("RGB", (20, 20)).save(tmp_path / "oak.png")
    path = tmp_path / "room.obj"
    square = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0.5 0.5\n"
    path.write_text(f"mtllib room.mtl\n{square}vt {number} 0.5\nusemtl oak\nf 1/1 2/2 3/1\n")
    (item,) = load_scene(path).objects
    assert item.appearance is not None
    assert item.appearance.uv is not None
    assert np.isfinite(item.appearance.uv).all()


def test_a_damaged_picture_is_named_with_its_file(tmp_path: Path) -> None:
    Image.new("RGB", (20, 20)).save(tmp_path / "a.png")
    whole = (tmp_path / "a.png").read_bytes()
    (tmp_path / "a.png").write_bytes(whole[:12] + b"XXXX" + whole[16:])
    index = tmp_path / "pictures.json"
    index.write_text(json.dumps([{"object": "phone", "kind": "isolated", "view": "front", "file": "a.png"}]))
    said = message_of(SceneError, lambda: GivenPictures.load(tmp_path))
    assert "a.png" in said
    assert " at 0x" not in said, "an address says nothing; the random name of a folder may hold 0x"
    index.write_text(json.dumps([{"object": "phone", "kind": None, "view": "front", "file": "a.png"}]))
    assert "picture 0 of" in message_of(SceneError, lambda: GivenPictures.load(tmp_path))


# -- sounds and tables ------------------------------------------------------------------------------------------------


def test_samples_far_beyond_full_scale_are_damage(tmp_path: Path) -> None:
    path = tmp_path / "tone.wav"
    samples = np.full(8000, 0.1, np.float32)
    samples[500] = 3e38
    soundfile.write(path, samples, 8000, subtype="FLOAT")
    for read in (lambda: read_clip(path), lambda: convert(path, tmp_path / "felt.wav")):
        said = message_of(AudioError, read)
        assert "tone.wav: sample 500 is [3.e+38]" in said
        assert "within 1e+09" in said


def test_a_sample_rate_that_is_no_rate_is_named_with_its_file(tmp_path: Path) -> None:
    path = tmp_path / "tone.wav"
    soundfile.write(path, np.zeros(100), 8000)
    data = path.read_bytes()
    path.write_bytes(data[:24] + (10**9).to_bytes(4, "little") + data[28:])
    assert "tone.wav: sample_rate_hz is 1e+09 Hz" in message_of(AudioError, lambda: read_clip(path))


def test_long_cells_of_tables_are_shown_shortened(tmp_path: Path) -> None:
    response, touches = tmp_path / "response.csv", tmp_path / "touches.csv"
    response.write_text(f"Hz,dB\n20,{'x' * 5000}\n")
    touches.write_text(f"time,{'x' * 5000}\n")
    assert "response.csv has a row" in message_of(ConfigError, lambda: read_response_csv(response))
    assert "touches.csv" in message_of(SessionError, lambda: TouchTrack.load(touches))


def test_a_sample_rate_below_any_that_is_converted_is_named_with_its_file(tmp_path: Path) -> None:
    path = tmp_path / "tone.wav"
    soundfile.write(path, np.zeros(100), 320)
    said = message_of(ConfigError, lambda: convert(path, tmp_path / "felt.wav"))
    assert "tone.wav: sample_rate_hz is 320 Hz" in said


def test_a_long_heading_of_a_sound_library_is_shown_shortened(tmp_path: Path) -> None:
    (tmp_path / "sounds.csv").write_text(f"{'x' * 5000},keywords\na,b\n")
    wanted = VibrationDescription("fan", "on", "A fan hums.", "fan hum", 0.5, (0.2, 0.2, 0.2))
    assert "sounds.csv" in message_of(ConfigError, lambda: FolderLibrary(tmp_path).find(wanted))


@pytest.mark.parametrize("field", ["kind", "x" * 5000])
def test_long_names_in_settings_are_shown_shortened(field: str) -> None:
    message_of(ConfigError, lambda: BakeConfig.parse({"audio": [{"kind": "synth", field: "a" * 100_000}]}))
    message_of(ConfigError, lambda: BakeConfig.parse({"llm": {"kind": "openai", field: "a" * 100_000}}))


def test_a_key_of_many_parts_in_a_toml_file_is_refused_at_once(tmp_path: Path) -> None:
    path = tmp_path / "settings.toml"
    path.write_text(f"[bake]\n{'a.' * 100_000}a = 1\n")
    begin = time.process_time()
    assert "settings.toml cannot be read: a key has more than 32 parts" in message_of(
        ConfigError, lambda: BakeConfig.parse(path)
    )
    assert time.process_time() - begin < 5.0
    path.write_text('[bake]\nprices = {"gpt-4.1" = [2.5, 10.0]}\n[user]\ncurve_db = [[50.0, 1.5], [200.0, -3.5]]\n')
    assert BakeConfig.parse(path).prices == {"gpt-4.1": (2.5, 10.0)}


@pytest.mark.parametrize("field", ["point_m", "to_m", "by_m", "rotation_xyzw"])
def test_coordinates_of_a_touch_file_are_bounded(field: str) -> None:
    who = {"hand": "left", "touch": "table"} if field == "point_m" else {"move": "table"}
    numbers = [0.0] * (4 if field == "rotation_xyzw" else 3)
    step = {"time_s": 0.0, **who, "to_m": [0, 0, 0], field: [1e300, *numbers[1:]]}
    if field in ("point_m", "by_m"):
        del step["to_m"]
    track = {"duration_s": 1.0, "steps": [step]}
    assert f"step 1, {field}.0" in message_of(SessionError, lambda: TouchTrack.parse(track))


@pytest.mark.skipif(sys.platform == "win32", reason="needs links to devices")
def test_a_device_in_the_place_of_a_kept_document_is_not_read(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A device has a size of 0 and no end; reading it filled the memory."""
    monkeypatch.setattr(Path, "read_bytes", lambda path: pytest.fail(f"{path} is read to its end"))
    (tmp_path / "found.json").symlink_to("/dev/zero")
    assert Store(tmp_path).document("found.json") is None
    (tmp_path / "whole.json").write_text('{"results": []}')
    assert Store(tmp_path).document("whole.json") == {"results": []}


# -- answers and batches ----------------------------------------------------------------------------------------------

ROW: dict[str, Any] = {"number": 1, "requests": ["a"], "stage": "written", "faults": []}


@pytest.mark.parametrize(
    "content",
    [
        json.dumps({**ROW, "number": "x"}),
        json.dumps({**ROW, "number": 2}),
        json.dumps({**ROW, "requests": [["a"]]}),
        json.dumps({**ROW, "stage": "paid"}),
        json.dumps({**ROW, "estimate_usd": float("inf")}),
        json.dumps({**ROW, "input_file": 5}),
        json.dumps({**ROW, "of a later version": 5}),
        NESTED,
        f'{{"number": {DIGITS}}}',
    ],
)
def test_a_damaged_state_of_a_batch_is_refused(content: str, tmp_path: Path) -> None:
    (tmp_path / "0001.json").write_text(content)
    said = message_of(ConfigError, lambda: BatchFolder(tmp_path).rows())
    assert "0001.json cannot be read" in said
    assert "restore it" in said


def test_the_state_of_a_batch_is_read_as_it_was_written(tmp_path: Path) -> None:
    row = BatchRow(1, ("a", "b"), "begun", 0.5, "file", "batch", "in_progress", 3, 1, ("a fault",))
    folder = BatchFolder(tmp_path)
    folder.save(row)
    assert folder.rows() == [row]


def test_damaged_results_of_a_batch(tmp_path: Path) -> None:
    folder = BatchFolder(tmp_path)
    good = json.dumps({"custom_id": "a", "response": {"status_code": 200, "body": {}}})
    (tmp_path / "0001.output.jsonl").write_text(f"{NESTED}\n{good}\n[]\n{DIGITS}\n")
    assert [key for key, _ in folder.outcomes()] == ["a"]
    (tmp_path / "0002.error.jsonl").mkdir()
    assert "0002.error.jsonl cannot be read" in message_of(ConfigError, lambda: list(folder.outcomes()))


def test_requests_of_a_batch_that_are_lost(tmp_path: Path) -> None:
    folder = BatchFolder(tmp_path)
    row = folder.save(BatchRow(1, ("a",)))
    assert "0001.input.jsonl cannot be read" in message_of(ConfigError, lambda: folder.requests(row))


class RepeatingServer:
    """A server that gives the same reply to every question."""

    base_url, timeout_s = "http://server/v1", 1.0

    def __init__(self, **body: Any) -> None:
        self.reply, self.n_asked = WebReply("http://server/v1/batches", 200, json.dumps(body).encode()), 0

    async def get(self, path: str, timeout_s: float) -> WebReply:
        self.n_asked += 1
        assert self.n_asked < 5000, "the search does not end"
        return self.reply


def begun_with(server: Any) -> object:
    return asyncio.run(BatchService(server).begun_with("file"))


def test_a_list_of_batches_without_end() -> None:
    server = RepeatingServer(data=[{"id": "b", "input_file_id": "other"}], has_more=True)
    assert "more than 100,000 batches" in message_of(BadAnswer, lambda: begun_with(server))


@pytest.mark.parametrize("data", [1.5, True, {"a": 1}, "text", [1]])
def test_a_list_of_batches_that_is_none(data: object) -> None:
    assert begun_with(RepeatingServer(data=data, has_more=True)) is None


@pytest.mark.parametrize("faults", [1.5, True, "text", [1]])
def test_faults_of_a_batch_that_are_no_list(faults: object) -> None:
    row = {"id": "b", "status": "failed", "input_file_id": "file", "errors": {"data": faults}}
    found: Any = begun_with(RepeatingServer(data=[row]))
    assert found.faults == ()


def test_a_count_of_tokens_beyond_any_is_none() -> None:
    assert counts({"prompt_tokens": 10**400, "completion_tokens": 3}) == {"completion_tokens": 3}


@pytest.mark.skipif(sys.platform == "win32", reason="needs sparse files")
def test_a_huge_file_in_the_cache_counts_as_missing(tmp_path: Path) -> None:
    def backend() -> CacheBackend:
        return CacheBackend(FunctionBackend(lambda request: json.dumps(GOOD[request.component])), tmp_path)

    first = asyncio.run(backend().complete(request()))
    (entry,) = tmp_path.glob("*.json")
    os.truncate(entry, 1 << 40)
    assert asyncio.run(backend().complete(request())).text == first.text
    assert entry.stat().st_size < 10_000


@pytest.mark.parametrize(
    ("component", "field"),
    [("material_estimator", name) for name in GOOD["material_estimator"]]
    + [("object_analyzer", name) for name in ("estimated_length_m", "estimated_mass_kg", "confidence")]
    + [("vibration_describer", name) for name in ("start_up_s", "on_s")],
)
def test_an_answer_with_a_number_of_400_digits_is_one_invalid_answer(component: Any, field: str) -> None:
    def answer(asked: LLMRequest) -> str:
        return json.dumps({**GOOD[asked.component], **({field: 10**400} if asked.component == component else {})})

    scene = table_with_two_phones()[0]
    problem = find_fault(component, json.dumps({**GOOD[component], field: 10**400}), {"material_category": "steel"})
    assert problem is not None
    assert field in problem.reason
    with contextlib.suppress(BadAnswer):  # no object has an answer
        asyncio.run(infer_scene(scene, RepairBackend(FunctionBackend(answer))))


# -- records ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("kept", [float("inf"), float("nan"), "x", None])
def test_an_account_with_counts_that_are_none(kept: object) -> None:
    account = {"calls": {}, "kept": kept, "skipped": {}, "tokens": {}}
    assert "another shape" in message_of(ConfigError, lambda: account_table(account))


@pytest.mark.parametrize("content", [NESTED, '{"stage": []}', '{"stage": {}}', "[]", DIGITS])
def test_a_damaged_record_of_a_scene_counts_as_missing(content: str, tmp_path: Path) -> None:
    path = tmp_path / "room.json"
    path.write_text(content)
    assert read_record(path) == {}
    path.write_text('{"stage": "baked"}')
    assert read_record(path) == {"stage": "baked"}
