"""Invalid edits of objects.json, and their messages."""

import json
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import soundfile
from numpy.typing import NDArray

from scene2hap import ActuatorProfile, HapticBundle, materials
from scene2hap.audio.spreading import SpreadLimits
from scene2hap.bundle import MadeWith
from scene2hap.bundle.checking import BundleWarning
from scene2hap.errors import BundleError
from scenes import table_with_two_phones


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    return table_with_two_phones()[1].save(tmp_path / "room")


def edit(folder: Path, object_id: str, **fields: Any) -> None:
    file = folder / "objects.json"
    rows = json.loads(file.read_text())
    for name, value in fields.items():
        target = rows[object_id]["states"][0] if name == "needs_contact" else rows[object_id]
        target[name] = value
    file.write_text(json.dumps(rows))


def test_object_that_was_marked_as_silent_but_has_loops_brings_a_warning(folder: Path) -> None:
    edit(folder, "phone", vibrates=False)
    with pytest.warns(BundleWarning, match="'phone' does not vibrate, but it has loops, which still play.*rebake"):
        HapticBundle.load(folder)


def test_a_material_that_was_renamed_without_its_constants_brings_a_warning(folder: Path) -> None:
    row = json.loads((folder / "objects.json").read_text())["table"]
    assert row["material"]["name"] != "rubber"
    edit(folder, "table", material_category="rubber")
    with pytest.warns(BundleWarning, match=r"'table' .* 'rubber', .* constants of 'oak'.* material table NAME"):
        HapticBundle.load(folder)
    edit(folder, "table", material="rubber")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert HapticBundle.load(folder).objects["table"].material == materials.lookup("rubber")
        edit(folder, "table", material_category="a word that the table does not have")
        HapticBundle.load(folder)


def test_file_that_an_editor_saved_in_a_code_page_is_refused(folder: Path) -> None:
    (folder / "overrides.json").write_bytes('{"Küche": {}}'.encode("cp1252"))
    with pytest.raises(BundleError, match=r"overrides\.json cannot be read: .* not UTF-8; save the text as UTF-8"):
        HapticBundle.load(folder)


@pytest.mark.parametrize("value", [True, "1", [1]])
@pytest.mark.parametrize("name", ["mass_kg", "confidence", "material", "states"])
def test_true_or_a_text_in_place_of_a_number_is_refused(folder: Path, name: str, value: object) -> None:
    row = json.loads((folder / "objects.json").read_text())["phone"]
    within = {
        "material": {**row["material"], "loss_factor": value},
        "states": [{**row["states"][0], "intensity": value}],
    }
    edit(folder, "phone", **{name: within.get(name, value)})
    with pytest.raises(BundleError, match=r"objects\.json: phone\..* is .*: it must be a number"):
        HapticBundle.load(folder)


def test_true_is_no_seed(folder: Path) -> None:
    path = table_with_two_phones()[1].save(folder.parent / "made") / "bundle.json"
    manifest = json.loads(path.read_text())
    manifest["made_with"] = MadeWith(ActuatorProfile(), {"kind": "auto"}, SpreadLimits(), 3).to_document() | {
        "seed": True
    }
    path.write_text(json.dumps(manifest))
    with pytest.raises(BundleError, match="made_with is wrong: seed is True; it must be a number"):
        HapticBundle.load(path.parent)


@pytest.mark.parametrize("text", ['{"phone": {}, "phone": {}}', '{"phone": {"gain_db": -3, "gain_db": -6}}'])
def test_key_that_is_given_twice_is_refused(folder: Path, text: str) -> None:
    (folder / "overrides.json").write_text(text)
    with pytest.raises(BundleError, match=r"overrides.json cannot be read: the key '(phone|gain_db)' is given twice"):
        HapticBundle.load(folder)


@pytest.mark.parametrize(
    ("size_m", "told"),
    [
        ([1.6, 0.8, 0.0], r"thickness must be above 0 \[m\]"),
        ([1.6, 0.8, 2.0], r"thickness is 2 m, but it was measured as 0.02 m; give 2e-05 to 0.267 m"),
        ([180.0, 70.0, 0.05], r"length is 180 m, but it was measured as 1.6 m; give 0.533 to 4.8 m; width is 70 m"),
        ([1.6, 0.8, 1e-9], "thickness is 1e-09 m"),
    ],
)
def test_implausible_size_is_refused(folder: Path, size_m: list[float], told: str) -> None:
    edit(folder, "table", estimated_size_m=size_m)
    with pytest.raises(BundleError, match=rf"objects\.json: table.*{told}"):
        HapticBundle.load(folder)


def test_a_size_that_is_corrected_within_bounds_is_read(folder: Path) -> None:
    edit(folder, "table", estimated_size_m=[0.8, 1.5, 0.04])
    assert HapticBundle.load(folder).objects["table"].estimated_size_m == (0.8, 1.5, 0.04)


def test_an_unknown_sheet_of_an_earlier_version_is_read_and_takes_a_material(folder: Path) -> None:
    edit(folder, "block", estimated_size_m=[0.4, 0.4, 0.0])
    bundle = HapticBundle.load(folder).override("block", material="oak")
    assert bundle.objects["block"].estimated_size_m == (0.4, 0.4, pytest.approx(0.02))


def test_unmet_contact_need_warns(folder: Path) -> None:
    edit(folder, "phone", needs_contact="stove")
    with pytest.warns(
        BundleWarning, match="'phone': state 'ringing' needs contact with 'stove', which no other"
    ) as caught:
        HapticBundle.load(folder)
    assert caught[0].filename == __file__


@pytest.mark.parametrize("needs", ["", "none", "null", "table", None])
def test_met_or_absent_contact_need_does_not_warn(folder: Path, needs: str | None) -> None:
    edit(folder, "phone", needs_contact=needs)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        HapticBundle.load(folder)


def edit_loop(folder: Path, change: Callable[[NDArray[np.float64]], NDArray[np.float64]], **written: Any) -> None:
    file = folder / json.loads((folder / "loops.json").read_text())["phone"]["ringing"]["tactile"]
    samples, rate = soundfile.read(file)
    soundfile.write(file, change(samples), rate, **{"subtype": "PCM_24", **written})


@pytest.mark.parametrize(
    ("change", "told"),
    [
        (lambda x: x * np.linspace(1.0, 0.0, len(x)) + np.linspace(0.3, 0.0, len(x)), r"jumps by 0\.\d+ of full scale"),
        (lambda x: 0 * x, "is silent.*mute ID"),
        (lambda x: 4 * x, r"peaks 1\.6 dB over full scale"),  # 20 lg (4 * 0.3)
    ],
    ids=["ends that do not meet", "silence", "too hot"],
)
def test_a_loop_that_an_editor_has_spoilt_brings_a_warning(
    folder: Path, change: Callable[[NDArray[np.float64]], NDArray[np.float64]], told: str
) -> None:
    edit_loop(folder, change, subtype="FLOAT")
    with pytest.warns(BundleWarning, match=f"the tactile loop of 'phone', state 'ringing', {told}"):
        HapticBundle.load(folder)


@pytest.mark.parametrize(
    "change",
    [lambda x: x, lambda x: np.roll(x, 25), lambda x: 0.001 * x, lambda x: np.sign(x) * 0.5, lambda x: 0 * x + 0.2],
    ids=["untouched", "another seam", "faint", "square", "offset"],
)
def test_a_loop_that_repeats_without_a_jump_brings_none(
    folder: Path, change: Callable[[NDArray[np.float64]], NDArray[np.float64]]
) -> None:
    edit_loop(folder, change)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        HapticBundle.load(folder)


def test_a_loop_with_the_name_of_its_author_is_read(folder: Path) -> None:
    before = HapticBundle.load(folder)
    file = folder / json.loads((folder / "loops.json").read_text())["phone"]["ringing"]["tactile"]
    samples, rate = soundfile.read(file)
    with soundfile.SoundFile(file, "w", rate, 1, "PCM_24") as written:
        written.artist, written.comment = "me", "take 3"
        written.write(samples)
    assert b"take 3" in file.read_bytes()
    assert HapticBundle.load(folder) == before
