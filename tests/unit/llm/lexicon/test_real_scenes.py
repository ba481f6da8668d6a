"""The lexicon on names of whole scenes: the rooms of the tests, and scenes by others, read from their JSON."""

import json
import struct
from typing import Any, TypeVar

import pytest

from others import SCENES, needed, there
from rooms import ROOMS
from scene2hap.demo import kitchen_path
from scene2hap.llm.lexicon.categories import ObjectFacts, judge
from scene2hap.llm.lexicon.names import read_name
from scene2hap.llm.lexicon.places import kind_of_place

T = TypeVar("T")
BIG_ENOUGH = (1.0, 0.5, 0.1)
DEMO = "the built-in kitchen"
DEMO_SOURCES = {"refrigerator", "cooker_hood", "microwave", "washing_machine", "smartphone"} | {
    "electric_toothbrush",
    "handheld_fan",
}


def others(*names: str) -> list[str]:
    """Scenes by other authors that are available."""
    return there(names, SCENES.joinpath)


def known(cases: dict[str, T]) -> list[tuple[str, T]]:
    """Known facts of scenes by other authors that are available."""
    return [(name, cases[name]) for name in others(*cases)]


def document(relative: str) -> Any:
    content = (kitchen_path() if relative == DEMO else needed(SCENES / relative)).read_bytes()
    if content[:4] == b"glTF":
        (length,) = struct.unpack_from("<I", content, 12)
        content = content[20 : 20 + length]
    return json.loads(content)


def node_names(relative: str) -> list[str]:
    if relative in ROOMS:
        return ROOMS[relative].ids
    return [node.get("name", "") for node in document(relative)["nodes"]]


def top_level_names(relative: str) -> list[str]:
    """Names of the objects: the roots, or the children of a single root."""
    gltf = document(relative)
    nodes, roots = gltf["nodes"], gltf["scenes"][gltf.get("scene", 0)]["nodes"]
    while len(roots) == 1:
        roots = nodes[roots[0]]["children"]
    return [nodes[i]["name"] for i in roots]


def vibrates(name: str) -> bool:
    return judge(ObjectFacts(name, BIG_ENOUGH), ["floor"]).vibrates


@pytest.mark.parametrize(
    ("scene", "vibrating"),
    [
        *((name, room.sources) for name, room in ROOMS.items()),
        *known(
            {
                "composed_kitchen_kaykit/composed_kitchen_kaykit.glb": {"fridge", "oven", "stove", "extractor_hood"}
                | {"radio", "radio(Clone)"},
                "composed_bathroom_kenney/composed_bathroom_kenney.glb": {"washing_machine", "washer(Clone)"}
                | {"tumble_dryer", "dryer(Clone)", "radio", "radio(Clone)", "small_speaker", "speakerSmall(Clone)"},
            }
        ),
    ],
)
def test_exactly_the_machines_vibrate(scene: str, vibrating: set[str]) -> None:
    assert {name for name in node_names(scene) if vibrates(name)} == vibrating


@pytest.mark.parametrize(
    ("scene", "vibrating"),
    [
        (DEMO, DEMO_SOURCES),
        *known(
            {
                "aws_house_living/aws_house_living.glb": {"AirconditionerB_01_001", "TV_01_001", "Tablet_01_001"},
                "aws_house_bedroom/aws_house_bedroom.glb": {"AirconditionerA_01_001", "TV_02_001"},
            }
        ),
    ],
)
def test_most_objects_of_authored_rooms_are_recognised(scene: str, vibrating: set[str]) -> None:
    names = top_level_names(scene)
    recognised = [name for name in names if read_name(name).row is not None]
    assert len(names) >= 20
    assert len(recognised) / len(names) >= 0.95
    assert {name for name in names if vibrates(name)} == vibrating


@pytest.mark.parametrize(
    ("scene", "place"),
    [
        (DEMO, "kitchen"),
        ("storage", "undefined"),
        ("merged", "undefined"),
        *known(
            {
                "composed_kitchen_kaykit/composed_kitchen_kaykit.glb": "kitchen",
                "composed_bathroom_kenney/composed_bathroom_kenney.glb": "bathroom",
                "aws_house_living/aws_house_living.glb": "living room",
                "aws_house_bedroom/aws_house_bedroom.glb": "bedroom",
                "sketchfab_kitchen/scene.gltf": "kitchen",
                "messy_japanese_room/room.glb": "undefined",
            }
        ),
    ],
)
def test_kind_of_place_of_real_scenes_is_recognised(scene: str, place: str) -> None:
    assert kind_of_place("Scene 1", node_names(scene)) == place


@pytest.mark.parametrize(
    ("scene", "stem", "count"),
    [("merged", "mesh", 1), *((x, "Object", 17) for x in others("messy_japanese_room/room.glb"))],
)
def test_opaque_scene_stays_unknown(scene: str, stem: str, count: int) -> None:
    names = [name for name in node_names(scene) if name.startswith(stem)]
    assert len(names) == count
    assert not any(read_name(name).row for name in names)


@pytest.mark.parametrize(
    ("library", "ending", "count"), [("kaykit_restaurant", "gltf", 144), ("kenney_furniture", "glb", 79)]
)
def test_asset_kits_are_covered(library: str, ending: str, count: int) -> None:
    folder = needed(SCENES / f"lib_{library}")
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
