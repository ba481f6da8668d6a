"""From Habitat scenes to samples, one scene and many scenes."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
import pytest
import soundfile

from habitat_builder import CHAIR, HASH, Dataset, instance
from scene2hap import HapticBundle, bake_many
from scene2hap.baking.many.record import scene_digest
from scene2hap.cli import main


@pytest.fixture
def dataset(tmp_path: Path) -> Dataset:
    """Two homes with a washer, whose name is only in a table."""
    found = Dataset(tmp_path / "home")
    found.write("semantics/objects.csv", f"id,name,main_category\n{HASH},W 9000,washing machine\n")
    for name, x in (("flat", 1.0), ("house", 2.0)):
        found.scene(instance(at=[0, 0, 1]), instance(HASH, [x, 0, 0]), name=f"scenes/{name}.scene_instance.json")
    return found


def test_from_a_habitat_scene_to_samples(dataset: Dataset, tmp_path: Path) -> None:
    scene, bundle, wav = dataset.folder / "scenes/flat.scene_instance.json", tmp_path / "b", tmp_path / "o.wav"
    assert main(["bake", str(scene), "-o", str(bundle), "-q"]) == 0
    baked = HapticBundle.load(bundle)
    assert [item.name for item in baked.snapshot.objects] == ["floor", "wall", CHAIR, "washing machine"]
    assert baked.objects["washing machine"].vibrates
    touches = tmp_path / "t.csv"
    touches.write_text("time_s,hand,touch\n0.0,right,washing machine\n0.5,,\n")
    assert main(["render", str(bundle), "--touches", str(touches), "-o", str(wav), "-q"]) == 0
    samples, _ = soundfile.read(wav)
    assert np.isfinite(samples).all()
    assert float(np.abs(samples).max()) > 0.01


def test_a_table_of_names_is_an_argument(dataset: Dataset, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "mine.csv").write_text(f"id,name\n{HASH},radio\n")
    scene = dataset.folder / "scenes/flat.scene_instance.json"
    command = ["inspect", str(scene), "--names", str(tmp_path / "mine.csv"), "--assets-root", str(dataset.folder)]
    assert main([*command, "--json"]) == 0
    assert "radio" in capsys.readouterr().out


def test_many_scenes_of_a_dataset(dataset: Dataset, tmp_path: Path) -> None:
    scenes = sorted((dataset.folder / "scenes").glob("*.scene_instance.json"))
    report = bake_many(scenes, tmp_path / "out")
    assert [Path(one.bundle).name for one in report.scenes] == ["flat.bundle", "house.bundle"]
    assert report.count("baked") == 2
    assert bake_many(scenes, tmp_path / "out").count("kept") == 2
    # A model that both scenes use is replaced, then the table of names that they share.
    model = dataset.folder / f"objects/f/{CHAIR}.glb"
    model.write_bytes((dataset.folder / f"objects/0/{HASH}.glb").read_bytes())
    assert bake_many(scenes, tmp_path / "out").count("baked") == 2


def test_all_files_of_a_scene_count(dataset: Dataset, tmp_path: Path) -> None:
    scene = dataset.folder / "scenes/flat.scene_instance.json"
    names = tmp_path / "names.csv"
    names.write_text("id,name\n")
    before = scene_digest(scene, {"names": names})
    assert scene_digest(scene, {"names": names}) == before
    names.write_text(f"id,name\n{HASH},radio\n")
    assert scene_digest(scene, {"names": names}) != before
    table = dataset.folder / "semantics/objects.csv"
    before = scene_digest(scene)
    table.write_text(table.read_text() + "\n")
    assert scene_digest(scene) != before
    before = scene_digest(scene)
    (dataset.folder / "objects/f/another.glb").write_bytes(b"not in this scene")
    assert scene_digest(scene) == before
    os.remove(dataset.folder / f"objects/f/{CHAIR}.glb")
    assert scene_digest(scene) != before
