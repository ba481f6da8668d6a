"""Scenes made by other people, from file to samples."""

import warnings
from pathlib import Path

import numpy as np
import pytest

from scene2hap import HapticBundle, HapticSession, Touch, bake, load_scene
from scene2hap.scene.load import UnitWarning

SCENES = Path(__file__).parents[3] / "shared" / "scenes"
FILES = {
    "aws_house_bedroom": "aws_house_bedroom.glb",
    "aws_house_living": "aws_house_living.glb",
    "composed_bathroom_kenney": "composed_bathroom_kenney.glb",
    "composed_kitchen_kaykit": "composed_kitchen_kaykit.glb",
    "messy_japanese_room": "room.glb",
    "messy_merged_bathroom": "bathroom.glb",
    "sketchfab_kitchen": "scene.gltf",
}
VIBRATES = {
    "composed_kitchen_kaykit": {"fridge", "extractor_hood", "radio"},
    "composed_bathroom_kenney": {"washing_machine", "tumble_dryer", "radio", "small_speaker"},
}
STILL = ("plate", "chair", "wall", "towel")


def path_of(name: str) -> Path:
    path = SCENES / name / FILES[name]
    if not path.is_file():
        pytest.skip("needs the shared folder beside the checkout (scenes)")
    return path


@pytest.mark.parametrize("name", FILES)
def test_from_file_to_samples(name: str, tmp_path: Path) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UnitWarning)
        scene = load_scene(path_of(name))
    bundle = HapticBundle.load(bake(scene).save(tmp_path / "b"))
    assert bundle.snapshot == scene
    session = HapticSession(bundle.snapshot, bundle)
    for item in scene.objects:
        middle = item.bounds_m.mean(axis=0)
        session.update(touches=[Touch("left", item.id, tuple(middle.tolist()))])
        out = session.render(480)
        assert np.isfinite(out).all()
        assert np.abs(out).max() <= 1.0
    for source in session.source_ids:
        middle = scene.object(source).bounds_m.mean(axis=0)
        frame = session.update(touches=[Touch("right", source, tuple(middle.tolist()))])
        assert frame.gain("right", source) == 1.0


@pytest.mark.parametrize("name", VIBRATES)
def test_machines_vibrate_and_furniture_does_not(name: str) -> None:
    scene = load_scene(path_of(name))
    vibrates = {key for key, haptics in bake(scene).objects.items() if haptics.vibrates}
    assert vibrates >= VIBRATES[name]
    assert not [key for key in vibrates if any(word in key for word in STILL)]
