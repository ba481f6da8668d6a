"""What is one object for a person is one object, in the trees that different programs write.

The expected objects were listed before the rule was run. Sizes are in metres.
"""

from __future__ import annotations

import numpy as np
import pytest

from gltf_builder import CUBE, CUBE_FACES
from scene2hap.scene.grouping.groups import group_objects
from scene2hap.scene.names import names_part
from scene2hap.scene.tree import AuthoredNode, Piece, transform

CORNER, EXTENT = CUBE.min(axis=0), np.ptp(CUBE, axis=0)
Place = tuple[float, float, float]


def box(name: str, low: Place, high: Place, *children: AuthoredNode) -> AuthoredNode:
    vertices = (CUBE - CORNER) / EXTENT * (np.array(high) - low) + low
    return AuthoredNode(name, np.eye(4), (Piece((name, low, high), vertices, CUBE_FACES.astype(np.int32)),), children)


def group(name: str, *children: AuthoredNode, at: Place = (0, 0, 0)) -> AuthoredNode:
    return AuthoredNode(name, transform(np.eye(3), at), (), children)


def legs(name: str, x: float, z: float, height: float) -> list[AuthoredNode]:
    places = [(-x, -z), (x, -z), (-x, z), (x, z)]
    return [
        box(f"{name}{k or ''}", (px - 0.02, 0, pz - 0.02), (px + 0.02, height, pz + 0.02))
        for k, (px, pz) in enumerate(places)
    ]


def chair(seat: str, leg: str, back: str) -> list[AuthoredNode]:
    low = [box(seat, (-0.2, 0.43, -0.2), (0.2, 0.47, 0.2)), *legs(leg, 0.17, 0.17, 0.43)]
    return [*low, box(back, (-0.2, 0.47, 0.16), (0.2, 0.9, 0.2))]


def table(top: str, leg: str) -> list[AuthoredNode]:
    return [box(top, (-0.6, 0.7, -0.4), (0.6, 0.74, 0.4)), *legs(leg, 0.5, 0.3, 0.7)]


def lamp(base: str, pole: str, shade: str) -> list[AuthoredNode]:
    return [
        box(base, (3, 0, 0), (3.3, 0.04, 0.3)),
        box(pole, (3.14, 0.04, 0.14), (3.16, 1.4, 0.16)),
        box(shade, (3, 1.3, 0), (3.3, 1.6, 0.3)),
    ]


def door(name: str, x: float) -> AuthoredNode:
    panel = box("Panel", (x, 0.02, 0.5), (x + 0.3, 0.78, 0.52))
    return group(name, panel, box("Handle", (x + 0.1, 0.3, 0.52), (x + 0.12, 0.5, 0.55)))


def cabinet(name: str, at: Place) -> AuthoredNode:
    return group(name, box("Body", (0, 0, 0), (0.6, 0.8, 0.5)), door("Door_L", 0), door("Door_R", 0.3), at=at)


FLOOR = box("Floor", (-5, -0.1, -5), (5, 0, 5))
WALLS = [box("Wall_N", (-5, 0, -5.1), (5, 2.5, -5)), box("Wall_E", (5, 0, -5), (5.1, 2.5, 5))]
SEAT, BACK = ((0, 0, 0), (0.4, 0.45, 0.4)), ((0, 0.45, 0.36), (0.4, 0.9, 0.4))

SCENES = {
    "Blender's collection instances": (
        "Chair, Chair.001, Dining table, Vase, Floor, Floor lamp",
        group("Chair", *chair("seat", "leg.00", "backrest"), at=(0, 0, 2)),
        group("Chair.001", *chair("seat", "leg.00", "backrest"), at=(1, 0, 2)),
        group("Dining table", *table("tabletop", "table leg.00")),
        box("Vase", (0, 0.74, 0), (0.1, 0.95, 0.1)),
        FLOOR,
        group("Floor lamp", *lamp("foot", "stem", "shade")),
    ),
    "Unity's prefabs": (
        "Kitchen_Cabinet (1), Kitchen_Cabinet (2), Pan, Floor, Wall_N, Wall_E",
        cabinet("Kitchen_Cabinet (1)", (0, 0, 0)),
        cabinet("Kitchen_Cabinet (2)", (1, 0, 0)),
        group(
            "Pan",
            box("Pan_Body", (2.1, 0.85, 0.1), (2.35, 0.9, 0.35)),
            box("Pan_Handle", (2.35, 0.87, 0.2), (2.5, 0.89, 0.23)),
        ),
        group("Environment", FLOOR, *WALLS),
    ),
    "Unreal's objects": (
        "BP_Chair_C_1, BP_Lamp_C_3, Floor_4",
        group(
            "World",
            group(
                "BP_Chair_C_1",
                group("DefaultSceneRoot", box("StaticMeshComponent0", *SEAT), box("Section1", *BACK)),
            ),
            group("BP_Lamp_C_3", group("Root", *lamp("Base", "Pole", "Shade"))),
            group("Floor_4", box("StaticMeshComponent0", (-5, -0.1, -5), (5, 0, 5))),
        ),
    ),
    "Godot's scenes": (
        "Chair, Desk, Monitor, TV",
        group(
            "Main",
            group("Chair", box("MeshInstance3D", *SEAT), box("MeshInstance3D2", *BACK)),
            group("Desk", group("StaticBody3D", *table("Top", "Leg")), at=(3, 0, 0)),
            group(
                "Monitor",
                box("Screen", (2.8, 0.85, 0), (3.3, 1.2, 0.03)),
                box("Stand", (2.95, 0.74, -0.1), (3.15, 0.9, 0.1)),
            ),
            box("TV", (2.0, 0.85, 0), (2.7, 1.2, 0.03)),
        ),
    ),
    "a desk with things on it": (
        "Desk, Monitor, Keyboard, TV",
        group(
            "Desk",
            *table("desk_top", "desk_leg_"),
            group(
                "Monitor",
                box("screen", (-0.3, 0.85, -0.2), (0.3, 1.2, -0.17)),
                box("stand", (-0.1, 0.74, -0.3), (0.1, 0.9, -0.1)),
            ),
            box("Keyboard", (-0.2, 0.74, 0.1), (0.2, 0.76, 0.25)),
            box("TV", (0.3, 0.74, -0.2), (0.5, 1.0, -0.15)),
        ),
    ),
    "SketchUp's components": (
        "Wooden_Chair, Bookcase",
        group(
            "SketchUp",
            group("instance_0", group("Wooden_Chair", box("group_0", *SEAT), box("group_1", *BACK))),
            group(
                "instance_2",
                group(
                    "Bookcase",
                    box("Side", (3, 0, 0), (3.02, 1.8, 0.3)),
                    box("Side#1", (3.78, 0, 0), (3.8, 1.8, 0.3)),
                    *(box(f"Shelf#{k}", (3.02, 0.4 * k, 0), (3.78, 0.4 * k + 0.02, 0.3)) for k in range(5)),
                ),
            ),
        ),
    ),
    "groups of three.js": ("lamp, table", group("", group("lamp", *lamp("", "", "")), group("table", *table("", "")))),
    "Sketchfab's wrappers": (
        "Chair, Guitar",
        group(
            "Sketchfab_model",
            group(
                "scene.fbx",
                group(
                    "RootNode",
                    group("Chair", box("Chair_Wood_0", *SEAT), box("Chair_Metal_0", *BACK)),
                    group(
                        "Guitar",
                        group("Body", box("Body_wood_0", (5, 0, 0), (5.4, 0.5, 0.1))),
                        group("Neck", box("Neck_wood_0", (5.18, 0.5, 0.03), (5.22, 1, 0.07))),
                    ),
                ),
            ),
        ),
    ),
    "Maya's shapes": (
        "chair",
        group(
            "group5",
            group("chair", group("pCube1", box("pCubeShape1", *SEAT)), group("pCube2", box("polySurface2", *BACK))),
        ),
    ),
    "electronics": (
        "Laptop, Desk fan, Phone",
        group(
            "Laptop",
            box("Base", (0, 0, 0), (0.33, 0.02, 0.23)),
            group("Lid", box("Screen", (0, 0.02, 0), (0.33, 0.23, 0.01))),
        ),
        group(
            "Desk fan",
            *lamp("Base", "Stem", "Cage"),
            box("Motor", (3.1, 1.35, 0.1), (3.2, 1.45, 0.2)),
        ),
        group(
            "Phone", box("Case", (2, 0, 0), (2.07, 0.01, 0.15)), box("Battery", (2.01, 0.002, 0.03), (2.06, 0.008, 0.1))
        ),
    ),
    "a partly named wardrobe": (
        "Wardrobe",
        group(
            "Wardrobe",
            box("Cube.003", (0, 0, 0), (1.2, 2, 0.6)),
            box("Door", (0, 0.05, 0.6), (0.6, 1.95, 0.62)),
            box("Door.001", (0.6, 0.05, 0.6), (1.2, 1.95, 0.62)),
        ),
    ),
    "a bed": (
        "Bed, Mattress",
        group(
            "Bed",
            box("Frame", (0, 0, 0), (2, 0.3, 1.6)),
            box("Headboard", (-0.05, 0, 0), (0, 1, 1.6)),
            box("Mattress", (0, 0.3, 0), (2, 0.5, 1.6)),
        ),
    ),
    "place settings": (
        "plate, knife, fork",
        group(
            "Place setting",
            box("plate", (0, 0, 0), (0.25, 0.02, 0.25)),
            box("knife", (0.25, 0, 0.05), (0.27, 0.01, 0.22)),
            box("fork", (-0.02, 0, 0.05), (0, 0.01, 0.22)),
        ),
    ),
    "a table with its chairs": (
        "Table, Chair_0, Chair_1",
        group(
            "Table set",
            group("Table", *table("Top", "Leg")),
            *(group(f"Chair_{k}", *chair("Seat", "Leg", "Back"), at=(k - 0.5, 0, 0.5)) for k in range(2)),
        ),
    ),
    "groups that are no things": (
        "Clock, Mirror, Door.001, Door.002, Wall.001, Wall.002, Door, Doormat, Wall, Door, Window",
        group("Decoration", box("Clock", (0, 2, 0), (0.3, 2.3, 0.05)), box("Mirror", (0.3, 2, 0), (0.6, 2.3, 0.05))),
        group("Doors", box("Door.001", (3, 0, 0), (3.8, 2, 0.05)), box("Door.002", (3.8, 0, 0), (4.6, 2, 0.05))),
        group("Walls", box("Wall.001", (-5, 0, -5), (5, 2.5, -4.9)), box("Wall.002", (-5, 0, -5), (-4.9, 2.5, 5))),
        group("Entrance", box("Door", (-3, 0, 5), (-2, 2, 5.05)), box("Doormat", (-3, 0, 5.05), (-2, 0.02, 5.6))),
        group(
            "Facade",
            box("Wall", (-5, 0, 8), (5, 3, 8.2)),
            box("Door", (0, 0, 7.98), (0.9, 2, 8)),
            box("Window", (0.9, 1, 7.98), (1.8, 2, 8)),
        ),
    ),
}


@pytest.mark.parametrize("scene", SCENES)
def test_objects_are_those_that_a_person_sees(scene: str) -> None:
    expected, *roots = SCENES[scene]
    found = group_objects([root for root in roots if isinstance(root, AuthoredNode)])
    assert sorted(item.name for item in found) == sorted(str(expected).split(", "))


def test_a_part_with_children_below_a_mesh_is_another_object() -> None:
    """As a cupboard of Sketchfab, whose own mesh is cut by material, and whose doors are groups."""
    body = box("Cupboard_Wood_0", (0, 0, 0), (0.6, 0.8, 0.5))
    assert [item.name for item in group_objects([group("Cupboard", body, door("Cupboard_Door", 0))])] == [
        "Cupboard",
        "Cupboard_Door",
    ]


@pytest.mark.parametrize(("gap_m", "n_objects"), [(0.005, 1), (0.05, 2)])
def test_parts_may_have_a_small_gap(gap_m: float, n_objects: int) -> None:
    body, front = box("body", (0, 0, 0), (0.6, 0.85, 0.6)), box("door", (0, 0, 0.6 + gap_m), (0.6, 0.85, 0.62 + gap_m))
    assert len(group_objects([group("Washer", body, front)])) == n_objects


@pytest.mark.parametrize(
    ("name", "group_name", "is_part"),
    [("leg.001", "Chair", True), ("table leg", "Dining table", True), ("OvenDoor", "Stove", True),
     ("chair.001", "Desk Chair", True), ("Glass", "Window", True), ("Door.001", "Doors", False),
     ("tyre", "Bicycle", True), ("leaves.001", "Bush", True), ("maker_logo_Curve", "Radio", True),
     ("TV", "Desk", False), ("Tablet", "Table", False), ("Keyboard", "Desk", False), ("table", "Table set", False)],
)  # fmt: skip
def test_names_of_parts(name: str, group_name: str, is_part: bool) -> None:
    assert names_part(name, group_name) is is_part
