"""From scene file to samples: the rooms of the tests, and scenes by others where they are present."""

import warnings
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from others import SCENES, there
from rooms import ROOMS, room_file
from scene2hap import HapticBundle, HapticSession, SceneSnapshot, Touch, bake, load_scene
from scene2hap.scene.load import UnitWarning

# Baking warns of rooms without sources.
pytestmark = [
    pytest.mark.filterwarnings("ignore:none of:scene2hap.SceneWarning"),
    pytest.mark.usefixtures("short_tones"),
]

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
    return room_file(name) if name in ROOMS else SCENES / name / FILES[name]


@cache
def baked(name: str) -> tuple[SceneSnapshot, HapticBundle]:
    """A scene and its bundle, baked once for all tests."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UnitWarning)
        scene = load_scene(path_of(name))
        return scene, bake(scene)


@pytest.mark.parametrize("name", [*ROOMS, *there(FILES, path_of)])
def test_from_file_to_samples(name: str, tmp_path: Path) -> None:
    scene, made = baked(name)
    bundle = HapticBundle.load(made.save(tmp_path / "b"))
    assert bundle.snapshot == scene
    session = HapticSession(bundle.snapshot, bundle)
    if name in ROOMS:
        assert set(session.source_ids) == ROOMS[name].sources
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


@pytest.mark.parametrize("name", [*ROOMS, *there(VIBRATES, path_of)])
def test_machines_vibrate_and_furniture_does_not(name: str) -> None:
    vibrates = {key for key, haptics in baked(name)[1].objects.items() if haptics.vibrates}
    if name in ROOMS:
        assert vibrates == ROOMS[name].sources
    else:
        assert vibrates >= VIBRATES[name]
        assert not [key for key in vibrates if any(word in key for word in STILL)]
