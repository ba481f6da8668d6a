"""The data of a report: levels as in a session, points on surfaces, and playable sounds."""

from __future__ import annotations

import base64
import io
import json
from pathlib import Path

import numpy as np
import pytest
import soundfile

from scene2hap import Box, HapticBundle, Pose, SceneObject, SceneSnapshot, bake
from scene2hap.cli import main
from scene2hap.errors import ConfigError
from scene2hap.report import report_document, write_report
from scene2hap.report.felt_map import ALL_BANDS, ALL_SOURCES, felt_map
from scene2hap.report.page import assemble
from scene2hap.report.surface_points import patches_of
from scene2hap.scene.objects import UpAxis

pytestmark = pytest.mark.usefixtures("short_tones")


@pytest.fixture(scope="module")
def mug() -> HapticBundle:
    """A room with one silent object."""
    return bake(SceneSnapshot.build([SceneObject("mug", geometry=Box((0.1, 0.1, 0.1)))], name="room"))


@pytest.fixture(scope="module")
def kitchen(kitchen_bundle: Path) -> HapticBundle:
    return HapticBundle.load(kitchen_bundle)


def test_band_levels_sum_to_the_total_level(kitchen: HapticBundle) -> None:
    """On the source itself every gain is 1, so that the energies of the bands add up to the total."""
    felt = felt_map(kitchen, most_points=300)
    start = 0
    for patch in felt.patches:
        if patch.object_id == "refrigerator":
            break
        start += len(patch.points_m)
    of = felt.levels_db["exponential_plate"]["refrigerator"]
    parts = [float(of[band][start]) for band in felt.bands if band != ALL_BANDS]
    assert 10.0 * np.log10(sum(10.0 ** (part / 10.0) for part in parts)) == pytest.approx(
        float(of[ALL_BANDS][start]), abs=0.01
    )


def test_points_lie_on_surfaces_in_the_requested_number(kitchen: HapticBundle) -> None:
    table = SceneObject("table", pose=Pose((1.0, 2.0, 3.0)), geometry=Box((1.2, 0.04, 0.8)))
    speck = SceneObject("speck", pose=Pose((0.0, 0.0, 0.0)), geometry=Box((0.001, 0.001, 0.001)))
    board, dot = patches_of([table, speck], 2000)
    own = np.abs(board.points_m - (1.0, 2.0, 3.0)) / (0.6, 0.02, 0.4)
    assert np.allclose(own.max(axis=1), 1.0, atol=1e-3)
    assert 500 < len(board.points_m) <= 2000
    assert board.faces.max() < len(board.points_m)
    assert len(dot.points_m) == 1
    for most in (200, 3000):
        assert sum(len(patch.points_m) for patch in patches_of(kitchen.snapshot.objects, most)) <= most


def test_the_document_is_plain_data_with_sounds_that_play(kitchen: HapticBundle) -> None:
    kitchen = kitchen.override("refrigerator", gain_db=-3.0)
    found = json.loads(json.dumps(report_document(kitchen, most_points=500), allow_nan=False))
    assert [item["id"] for item in found["objects"]] == [item.id for item in kitchen.snapshot.objects]
    fridge = next(item for item in found["objects"] if item["id"] == "refrigerator")
    assert fridge["override"] == {"gain_db": -3.0}
    assert fridge["editable"]["gain_db"] == -3.0
    assert fridge["editable"]["name"] == kitchen.snapshot.object("refrigerator").name
    assert [name for name, *_ in fridge["constants"]] == [
        "density",
        "Young's modulus",
        "Poisson's ratio",
        "loss factor",
    ]
    state = found["loops"][fridge["states"][0]["loop"]]
    for name, seconds in (("sound", state["sound"]["seconds"]), ("touch", state["touch"]["seconds"])):
        data = base64.b64decode(state[name]["audio"].partition(",")[2])
        samples, rate = soundfile.read(io.BytesIO(data))
        assert rate == state[name]["rate_hz"]
        assert len(samples) / rate == pytest.approx(seconds, abs=2 / rate)
        assert 0.0 < np.abs(samples).max() <= 1.0
        assert len(base64.b64decode(state[name]["wave"])) == 2 * state[name]["columns"]
    assert len(state["spectrum"]["hz"]) == len(state["spectrum"]["touch_db"]) == len(state["spectrum"]["threshold_db"])
    mesh = found["meshes"][fridge["mesh"]]
    assert len(base64.b64decode(mesh["vertices"])) == 12 * mesh["n_vertices"]
    n_points = sum(patch["n_points"] for patch in found["felt"]["patches"])
    for bands in found["felt"]["levels"]["exponential_plate"].values():
        assert {len(base64.b64decode(levels)) for levels in bands.values()} == {2 * n_points}


@pytest.mark.parametrize(("up", "turned"), [("y", Pose()), ("z", Pose.from_euler((0, 0, 0), (np.pi / 2,), order="x"))])
def test_points_of_a_mat_lie_on_its_upper_side(up: UpAxis, turned: Pose) -> None:
    """Points on both sides would make a torn surface, which the floor hides in part."""
    mat = SceneObject("mat", pose=turned, geometry=Box((0.7, 0.016, 0.4)))
    (patch,) = patches_of([mat], 400, up)
    heights = patch.points_m[:, "xyz".index(up)]
    assert len(heights) > 50
    np.testing.assert_allclose(heights, heights.max(), atol=1e-6)


def test_a_corrected_name_is_the_one_to_edit(mug: HapticBundle) -> None:
    (item,) = report_document(mug.override("mug", name="beer mug"), most_points=100)["objects"]
    assert item["editable"]["name"] == "beer mug"


def test_silent_and_single_scenes_have_a_page_too(mug: HapticBundle) -> None:
    found = report_document(mug)
    assert found["felt"]["sources"] == [ALL_SOURCES]
    assert found["contacts"] == []
    assert found["objects"][0]["states"] == []


def test_a_source_that_encloses_its_scene_is_on_the_felt_map() -> None:
    """In an earlier version a dishwasher with its rack counted as a room, and a hand on it felt nothing."""
    dishwasher = SceneObject("dishwasher", geometry=Box((0.6, 0.8, 0.6)))
    rack = SceneObject("rack", pose=Pose((0.0, -0.37, 0.0)), geometry=Box((0.5, 0.06, 0.5)))
    bundle = bake(SceneSnapshot.build([dishwasher, rack], name="kitchen"))
    document = report_document(bundle, most_points=200)
    assert {patch["object"] for patch in document["felt"]["patches"]} == {"dishwasher", "rack"}
    assert not any("hides the room" in row["why"] for row in document["left_out"])
    # The page still cuts it open, so that the rack is visible.
    assert document["objects"][0]["is_shell"]


def test_every_view_shows_the_same_frequency_of_a_melody(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """In an earlier version the report showed the mean of a radio's notes, 83 Hz, at which nothing vibrates."""
    bundle = bake(SceneSnapshot.build([SceneObject("radio", geometry=Box((0.3, 0.2, 0.12)))]))
    loop = bundle.loops["radio"]["playing"].tactile
    power = np.abs(np.fft.rfft(loop.samples)) ** 2
    hz = np.fft.rfftfreq(len(loop.samples), 1 / loop.sample_rate_hz)
    (radio,) = report_document(bundle)["objects"]
    shown_hz = radio["states"][0]["felt"]["target_hz"]
    near = np.abs(hz - shown_hz) < 2.0
    assert power[near].max() > 0.1 * power.max()
    bundle.save(tmp_path / "b")
    assert main(["report", str(tmp_path / "b")]) == 0
    assert f" at {shown_hz:.0f} Hz" in capsys.readouterr().out


def test_a_report_is_a_file_of_json(mug: HapticBundle, tmp_path: Path) -> None:
    path = write_report(mug, tmp_path / "mug.json", most_points=200)
    assert json.loads(path.read_text())["format"] == "scene2hap/report"
    assert write_report(mug, tmp_path / "new" / "mug.json", most_points=200).is_file()
    with pytest.raises(ConfigError, match=r"must end in \.html"):
        write_report(mug, tmp_path / "mug.pdf")
    with pytest.raises(ConfigError, match=r"'\.' must end in \.html"):
        write_report(mug, ".")
    with pytest.raises(ConfigError, match="most_points is 0"):
        write_report(mug, path, most_points=0)


def test_a_place_that_cannot_be_written_is_refused_before_the_work(
    mug: HapticBundle, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("scene2hap.report.report_document", lambda *_, **__: pytest.fail("computed"))
    (tmp_path / "file").write_text("mine")
    (tmp_path / "folder.html").mkdir()
    for wrong in ("file/mug.html", "file/deeper/mug.html", "folder.html", f"{'x' * 300}.html"):
        with pytest.raises(ConfigError, match=r"cannot be written: .*\. (Choose|Give)"):
            write_report(mug, tmp_path / wrong)


def test_the_command_writes_a_page(kitchen: HapticBundle, tmp_path: Path) -> None:
    bundle = kitchen.save(tmp_path / "kitchen.bundle")
    assert main(["report", str(bundle), "-o", str(tmp_path / "report.html"), "-q"]) == 0
    page = (tmp_path / "report.html").read_text(encoding="utf-8")
    assert page.startswith("<!")
    assert 'id="report"' in page
    assert len(page) < 5_000_000


def test_a_page_of_many_sources_is_small_enough_for_a_mail() -> None:
    rows = [SceneObject("floor", pose=Pose((8, -0.05, 8)), geometry=Box((18, 0.1, 18)))]
    at = [(float(x), float(z)) for x in range(1, 16, 2) for z in range(1, 16, 2)]
    rows += [SceneObject(f"fan {x} {z}", pose=Pose((x, 0.2, z)), geometry=Box((0.3, 0.4, 0.3))) for x, z in at]
    document = report_document(bake(SceneSnapshot.build(rows)))
    assert len(document["felt"]["sources"]) == 1 + len(at)
    assert len(assemble(document)) < 0.3 * len(json.dumps(document))


def test_copies_of_an_object_share_their_sound_in_the_document() -> None:
    """Three equal phones and a fan on a table: one phone's sound and the fan's."""
    said = {"table": "oak table", "p1": "smartphone", "p2": "smartphone", "p3": "smartphone", "fan": "desk fan"}
    scene = SceneSnapshot.build(
        [
            SceneObject(key, name, Pose((0.3 * i, 0.0 if key == "table" else 0.06, 0.0)), Box((0.15, 0.02, 0.08)))
            for i, (key, name) in enumerate(said.items())
        ],
        name="room",
    )
    found = report_document(bake(scene), most_points=200)
    shown = {item["id"]: found["loops"][item["states"][0]["loop"]] for item in found["objects"] if item["is_source"]}
    assert set(shown) == {"p1", "p2", "p3", "fan"}
    assert shown["p1"] is shown["p2"] is shown["p3"]
    assert shown["p1"]["sound"] != shown["fan"]["sound"]
    assert len(found["loops"]) == 2
