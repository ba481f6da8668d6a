"""The names that real scenes carry, read from the files' JSON by hand."""

import json
import struct
from pathlib import Path
from typing import Any

import pytest

from scene2hap.llm.lexicon.judging import Measured, judge
from scene2hap.llm.lexicon.names import read_name
from scene2hap.llm.lexicon.places import kind_of_place

SCENES = Path(__file__).parents[4].parent / "shared" / "scenes"
BIG_ENOUGH = (1.0, 0.5, 0.1)


def document(relative: str) -> Any:
    path = SCENES / relative
    if not path.exists():
        pytest.skip(f"the shared scene {relative} is not here")
    content = path.read_bytes()
    if content[:4] == b"glTF":
        (length,) = struct.unpack_from("<I", content, 12)
        content = content[20 : 20 + length]
    return json.loads(content)


def node_names(relative: str) -> list[str]:
    return [node.get("name", "") for node in document(relative)["nodes"]]


def top_level_names(relative: str) -> list[str]:
    """Names of the objects: the roots, or the children of a single root."""
    gltf = document(relative)
    nodes, roots = gltf["nodes"], gltf["scenes"][gltf.get("scene", 0)]["nodes"]
    while len(roots) == 1:
        roots = nodes[roots[0]]["children"]
    return [nodes[i]["name"] for i in roots]


def vibrates(name: str) -> bool:
    return judge(Measured(name, BIG_ENOUGH), ["floor"]).vibrates


@pytest.mark.parametrize(
    ("scene", "vibrating"),
    [
        ("composed_kitchen_kaykit", {"fridge", "oven", "stove", "extractor_hood", "radio", "radio(Clone)"}),
        (
            "composed_bathroom_kenney",
            {"washing_machine", "washer(Clone)", "tumble_dryer", "dryer(Clone)", "radio", "radio(Clone)"}
            | {"small_speaker", "speakerSmall(Clone)"},
        ),
    ],
)
def test_exactly_the_machines_vibrate(scene: str, vibrating: set[str]) -> None:
    names = node_names(f"{scene}/{scene}.glb")
    assert {name for name in names if vibrates(name)} == vibrating


@pytest.mark.parametrize(
    ("scene", "vibrating"),
    [
        ("aws_house_living", {"AirconditionerB_01_001", "TV_01_001", "Tablet_01_001"}),
        ("aws_house_bedroom", {"AirconditionerA_01_001", "TV_02_001"}),
    ],
)
def test_most_objects_of_authored_rooms_are_recognised(scene: str, vibrating: set[str]) -> None:
    names = top_level_names(f"{scene}/{scene}.glb")
    known = [name for name in names if read_name(name).row is not None]
    assert len(names) >= 20
    assert len(known) / len(names) >= 0.95
    assert {name for name in names if vibrates(name)} == vibrating


@pytest.mark.parametrize(
    ("relative", "place"),
    [
        ("composed_kitchen_kaykit/composed_kitchen_kaykit.glb", "kitchen"),
        ("composed_bathroom_kenney/composed_bathroom_kenney.glb", "bathroom"),
        ("aws_house_living/aws_house_living.glb", "living room"),
        ("aws_house_bedroom/aws_house_bedroom.glb", "bedroom"),
        ("sketchfab_kitchen/scene.gltf", "kitchen"),
        ("messy_japanese_room/room.glb", "undefined"),
    ],
)
def test_kind_of_place(relative: str, place: str) -> None:
    assert kind_of_place("Scene 1", node_names(relative)) == place


def test_opaque_scene_stays_unknown() -> None:
    names = [name for name in node_names("messy_japanese_room/room.glb") if name.startswith("Object")]
    assert len(names) == 17
    assert not any(read_name(name).row for name in names)


@pytest.mark.parametrize(
    ("library", "ending", "count"), [("kaykit_restaurant", "gltf", 144), ("kenney_furniture", "glb", 79)]
)
def test_asset_kits_are_covered(library: str, ending: str, count: int) -> None:
    folder = SCENES / f"lib_{library}"
    if not folder.exists():
        pytest.skip(f"the shared library {library} is not here")
    names = [path.stem for path in sorted(folder.glob(f"*.{ending}"))]
    assert len(names) == count
    assert sum(read_name(name).row is not None for name in names) / count >= 0.9
    machines = (
        "fridge",
        "oven",
        "hood",
        "washer",
        "dryer",
        "radio",
        "speaker",
        "television",
        "stove",
    )
    assert {name for name in names if vibrates(name)} == {
        name for name in names if any(machine in name.lower() for machine in machines)
    }
