"""Grouping of nodes into objects: the rules of "authored", the other groupings, names and ids."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from gltf_builder import CUBE, CUBE_FACES
from scene2hap.errors import SceneError, SceneFormatError
from scene2hap.scene.grouping.groups import Group, group_objects, unique_ids
from scene2hap.scene.grouping.split import has_own_noun
from scene2hap.scene.tree import AuthoredNode, Piece


def mesh(name: str, *children: AuthoredNode, at: float = 0.0) -> AuthoredNode:
    """A node with one piece, whose key is the node's name."""
    return AuthoredNode(name, _along_x(at), (Piece(name, CUBE, CUBE_FACES.astype(np.int32)),), children)


def group(name: str, *children: AuthoredNode, at: float = 0.0) -> AuthoredNode:
    """A node without a mesh."""
    return AuthoredNode(name, _along_x(at), (), children)


def _along_x(at: float) -> Any:
    matrix = np.eye(4)
    matrix[0, 3] = at
    return matrix


def objects(*roots: AuthoredNode, how: Any = "authored") -> dict[str, list[object]]:
    """Object names, each with the keys of its pieces."""
    return {item.name: [piece.key for _, piece in item.parts] for item in group_objects(roots, how)}


def test_a_mesh_with_leaf_children_is_one_object() -> None:
    assert objects(mesh("fridge", mesh("door_top"), mesh("door_bottom"))) == {
        "fridge": ["fridge", "door_top", "door_bottom"]
    }


def test_a_child_with_children_of_its_own_is_an_object() -> None:
    assert objects(mesh("desk", mesh("drawer", mesh("handle")), mesh("leg"))) == {
        "desk": ["desk", "leg"],
        "drawer": ["drawer", "handle"],
    }


def test_a_group_below_a_mesh_is_an_object() -> None:
    assert objects(mesh("oven", group("knobs", mesh("knobs_mat_0")))) == {"oven": ["oven"], "knobs": ["knobs_mat_0"]}


def test_material_pieces_are_one_object() -> None:
    tree = group(
        "Cooktop", mesh("Cooktop_mat_0"), mesh("Cooktop_Grid_mat_0"), group("Controller", mesh("Controller_mat_0"))
    )
    assert objects(tree) == {
        "Cooktop": ["Cooktop_mat_0", "Cooktop_Grid_mat_0"],
        "Controller": ["Controller_mat_0"],
    }


def test_pieces_without_names_are_one_object() -> None:
    assert list(objects(group("Bed", mesh(""), mesh("")))) == ["Bed"]


def test_children_whose_names_say_nothing_belong_to_the_node_that_has_a_name() -> None:
    tree = group("table", group("cube", mesh("mesh_geom")), group("mug", group("sphere", mesh("mesh_geom"))))
    assert {name: len(pieces) for name, pieces in objects(tree).items()} == {"table": 1, "mug": 1}


def test_joined_children_whose_names_say_nothing_are_one_object() -> None:
    assert objects(group("table", mesh("Cube"), mesh("Cube.001", at=0.5))) == {"table": ["Cube", "Cube.001"]}


def test_joined_children_that_are_only_numbered_are_one_object() -> None:
    assert objects(group("table", mesh("p0"), mesh("p1", at=0.5))) == {"table": ["p0", "p1"]}


def test_parts_of_copies_are_in_one_order_whatever_order_the_file_has() -> None:
    seat, leg = mesh("seat", mesh("cube")), mesh("leg", mesh("cube"), at=0.5)
    assert objects(group("chair", seat, leg)) == objects(group("chair", leg, seat))


def test_children_that_stand_apart_are_separate_objects_whatever_their_names() -> None:
    assert list(objects(group("table", mesh("Cube"), mesh("Cube.001", at=5.0)))) == ["Cube", "Cube.001"]


def test_leaves_with_different_names_are_separate_objects() -> None:
    assert list(objects(group("Set", mesh("Set_base"), mesh("Vase")))) == ["Set", "Vase"]


@pytest.mark.parametrize(
    "piece", ["Table_mat_0", "Table.001", "Table 2", "Table(Clone)", "Table", "Table1", "TableTop"]
)
def test_leaves_that_continue_a_name_are_one_object(piece: str) -> None:
    assert list(objects(group("Table", mesh(piece), mesh("Lamp")))) == ["Table", "Lamp"]


def test_longer_word_is_a_different_name() -> None:
    assert list(objects(group("Table", mesh("Tablet"), mesh("Lamp")))) == ["Tablet", "Lamp"]


def test_wrapper_node_names_its_content() -> None:
    tree = group("house", group("vanity_sink", group("planforge-root", mesh("bathroomSinkSquare(Clone)"))), mesh("mat"))
    assert list(objects(tree)) == ["vanity_sink", "mat"]


def test_wrapper_node_names_only_its_main_object() -> None:
    tree = group("washing_machine", mesh("washer(Clone)", mesh("washerDoor", mesh("handle"))))
    assert list(objects(tree)) == ["washing_machine", "washerDoor"]


@pytest.mark.parametrize("wrapper", ["pivot", "entity", "Empty.001", "GameObject"])
def test_a_wrapper_whose_name_says_nothing_takes_no_name_away(wrapper: str) -> None:
    """Games turn things about a pivot, and engines name nodes that nobody has named."""
    assert list(objects(group(wrapper, group("desk fan", mesh("cube"))))) == ["desk fan"]
    assert list(objects(group("desk fan", group(wrapper, mesh("cube"))))) == ["desk fan"]
    assert list(objects(group(wrapper, mesh("cube")))) == [wrapper]
    assert list(objects(group("candle holder", mesh("candle")))) == ["candle holder"]


@pytest.mark.parametrize("root", ["SketchUp", "<3DSRoot>", "Collection", "Persistent Level"])
def test_nodes_of_exporters_join_no_children(root: str) -> None:
    """They hold the whole scene, whose unnamed groups touch: it was one object."""
    assert list(objects(group(root, mesh("group_0"), mesh("Fan", at=1.0), mesh("Cube.001")))) == [
        "group_0",
        "Fan",
        "Cube.001",
    ]


def test_wrapper_node_gives_the_object_frame() -> None:
    (item,) = group_objects([group("radio", mesh("radio(Clone)", at=1.0), at=5.0)])
    assert item.frame[0, 3] == 5.0
    assert item.parts[0][0][0, 3] == 6.0


@pytest.mark.parametrize(
    "wrapper",
    [
        "RootNode",
        "RootNode (gltf orientation matrix)",
        "Sketchfab_model",
        "SketchUp",
        "<3DSRoot>",
        "VisualSceneNode",
        "Collada visual scene group",
        "Scene Collection",
        "Collection 2",
        "Workspace",
        "PersistentLevel",
        "root",
        "Scene",
        "Kitchen.fbx",
        "pokoj japonski.obj.cleaner",
        "house",
        "Living Room",
        "bedroom_2",
        "Modern Kitchen",
        "hotel_room",
        "Scene.001",
        "",
    ],
)
def test_names_of_exporters_and_places_are_not_object_names(wrapper: str) -> None:
    assert list(objects(group(wrapper, mesh("chair")))) == ["chair"]
    assert list(objects(group(wrapper, mesh(f"{wrapper}_chair"), mesh(f"{wrapper}_table")))) == [
        f"{wrapper}_chair",
        f"{wrapper}_table",
    ]


@pytest.mark.parametrize("thing", ["Doll House", "world map", "Room divider", "broom"])
def test_a_thing_whose_name_holds_that_of_a_place_is_an_object(thing: str) -> None:
    assert list(objects(group(thing, mesh("Cube"), mesh("Sphere")))) == [thing]


def test_outer_name_is_used_across_an_exporter_node() -> None:
    assert list(objects(group("kettle", group("RootNode", mesh("Object_3"))))) == ["kettle"]


def test_container_nodes_are_skipped() -> None:
    tree = group("", group("things", mesh("cup"), mesh("pan")), group("more", mesh("lid")))
    assert list(objects(tree)) == ["cup", "pan", "more"]


def test_empty_nodes_are_ignored() -> None:
    tree = group("lamp", group("camera"), mesh("Object_1", group("bone", group("bone_end"))), group("light"))
    assert objects(tree) == {"lamp": ["Object_1"]}


def test_file_order_is_kept() -> None:
    tree = [mesh("a"), group("x", mesh("b", mesh("c", mesh("d"))), mesh("e")), mesh("f")]
    assert list(objects(*tree)) == ["a", "b", "c", "e", "f"]


def test_leaf_grouping_makes_one_object_per_leaf() -> None:
    tree = group("table", mesh("table_top", mesh("table_leg")), mesh("table_cloth"))
    assert objects(tree, how="leaf") == {
        "table_top": ["table_top"],
        "table_leg": ["table_leg"],
        "table_cloth": ["table_cloth"],
    }


DEEP = group("house", group("room", mesh("table", mesh("cup")), mesh("lamp")), mesh("roof"))


@pytest.mark.parametrize(
    ("depth", "expected"),
    [
        (0, {"": ["table", "cup", "lamp", "roof"]}),
        (1, {"house": ["table", "cup", "lamp", "roof"]}),
        (2, {"room": ["table", "cup", "lamp"], "roof": ["roof"]}),
        (3, {"table": ["table", "cup"], "lamp": ["lamp"], "roof": ["roof"]}),
        (9, {"table": ["table"], "cup": ["cup"], "lamp": ["lamp"], "roof": ["roof"]}),
    ],
)
def test_depth_grouping_merges_all_nodes_below_the_depth(depth: int, expected: dict[str, list[object]]) -> None:
    assert objects(DEEP, how=depth) == expected


def test_depth_zero_is_one_object_with_the_name_of_the_scene() -> None:
    (item,) = group_objects([mesh("blade"), mesh("motor", at=2.0)], 0, scene_name="fan")
    assert item.name == "fan"
    assert [matrix[0, 3] for matrix, _ in item.parts] == [0.0, 2.0]
    assert group_objects([group("empty")], 0) == []


def test_mapping_merges_only_the_named_nodes() -> None:
    tree = group("set", mesh("table", mesh("cloth")), mesh("chair"), mesh("lamp", at=3.0))
    assert objects(tree, how={"cloth": "linen", "lamp": "linen"}) == {
        "linen": ["cloth", "lamp"],
        "table": ["table"],
        "chair": ["chair"],
    }


def test_mapped_node_includes_its_unmapped_descendants() -> None:
    assert objects(DEEP, how={"room": "inside", "cup": "cup"}) == {
        "inside": ["table", "lamp"],
        "cup": ["cup"],
        "roof": ["roof"],
    }


def test_mapped_pieces_keep_their_place() -> None:
    tree = group("set", mesh("lamp", at=3.0), mesh("shade", at=4.0), at=10.0)
    (item,) = group_objects([tree], {"lamp": "light", "shade": "light"})
    assert [matrix[0, 3] for matrix, _ in item.parts] == [13.0, 14.0]
    assert item.frame[0, 3] == 13.0


def test_mapping_error_names_the_nearest_node() -> None:
    with pytest.raises(SceneError, match=r"maps the node 'tabel', .*Did you mean 'table'\?"):
        group_objects([mesh("table")], {"tabel": "x"})


@pytest.mark.parametrize("how", ["", "auto", -1, False, True, 1.5, None, ["table"]])
def test_unknown_grouping_is_refused(how: Any) -> None:
    with pytest.raises(SceneError, match="must be 'authored', 'leaf', 'loose', a depth from 0, or a mapping"):
        group_objects([mesh("table")], how)


def test_empty_scene_has_no_objects() -> None:
    assert group_objects([group("a", group("b"))]) == []


def test_large_group_of_leaves_is_grouped_fast() -> None:
    (item,) = group_objects([mesh("floor", *(mesh(f"tile{i}") for i in range(20_000)))])
    assert isinstance(item, Group)
    assert len(item.parts) == 20_001


@pytest.mark.parametrize(
    ("names", "ids"),
    [
        (["a", "b"], ["a", "b"]),
        (["Hemi", "Hemi", "x", "Hemi"], ["Hemi", "Hemi#2", "x", "Hemi#3"]),
        (["", "  ", "object"], ["object", "object#2", "object#3"]),
        (["a", "a", "a#2", "a"], ["a", "a#3", "a#2", "a#4"]),
        (["a#2", "a", "a", "a#2"], ["a#2", "a", "a#3", "a#2#2"]),
        ([" spaced "], ["spaced"]),
    ],
)
def test_ids_are_the_names_made_unique_in_file_order(names: list[str], ids: list[str]) -> None:
    assert unique_ids(names) == ids
    assert len(set(ids)) == len(ids)


def test_a_group_of_a_pot_with_its_lid_and_cups_with_saucers_is_several_objects() -> None:
    tree = group(
        "tea_set",
        mesh("tea_set_pot", at=0.0),
        mesh("tea_set_pot_lid", at=0.1),
        mesh("tea_set_cup_1", at=5.0),
        mesh("tea_set_saucer_1", at=5.0),
        mesh("tea_set_cup_2", at=9.0),
        mesh("tea_set_saucer_2", at=9.0),
    )
    assert objects(tree) == {
        "tea_set_pot": ["tea_set_pot", "tea_set_pot_lid"],
        "tea_set_cup_1": ["tea_set_cup_1"],
        "tea_set_saucer_1": ["tea_set_saucer_1"],
        "tea_set_cup_2": ["tea_set_cup_2"],
        "tea_set_saucer_2": ["tea_set_saucer_2"],
    }


def test_distant_child_of_a_mesh_is_a_separate_object() -> None:
    assert objects(mesh("tray", mesh("teapot", at=3.0), mesh("tray_handle", at=0.1))) == {
        "tray": ["tray", "tray_handle"],
        "teapot": ["teapot"],
    }


@pytest.mark.parametrize(
    "names",
    [["table_top", "table_leg_1", "table_leg_2"], ["table_1", "table_2"], ["table_mat_0", "table_wood"], ["", ""]],
)
def test_parts_numbers_and_materials_are_not_items_at_any_distance(names: list[str]) -> None:
    tree = group("table", *(mesh(name, at=5.0 * k) for k, name in enumerate(names)))
    assert objects(tree) == {"table": names}


def test_items_at_one_place_are_one_object() -> None:
    tree = group("lamp", mesh("lampFlex", at=0.0), mesh("lampGlobe", at=0.5))
    assert objects(tree) == {"lamp": ["lampFlex", "lampGlobe"]}


@pytest.mark.parametrize(
    ("name", "is_item"),
    [("set_cup", True), ("setTeaCup2", True), ("Tasse", True), ("set_cup_mat_0", True), ("set_cup_handle", False),
     ("set_doors", False), ("set_LEFT", False), ("set.001", False), ("set_XY", False), ("", False)],
)  # fmt: skip
def test_items_are_recognised_by_their_own_noun(name: str, is_item: bool) -> None:
    assert has_own_noun(name, "set") is is_item


def test_every_piece_of_a_collection_belongs_to_one_object() -> None:
    names = ["set_pot", "set_lid", "", "set_cup", "set_knob", "set_1"]
    tree = group("set", *(mesh(name, at=3.0 * k) for k, name in enumerate(names)))
    assert sorted(key for keys in objects(tree).values() for key in keys) == sorted(names)


@pytest.mark.parametrize("corner", [-1, len(CUBE)])
def test_a_face_of_a_vertex_that_does_not_exist_is_refused(corner: int) -> None:
    with pytest.raises(SceneFormatError, match=f"node 'x': a face uses vertex {corner}; there are 8"):
        Piece.checked("x", CUBE, [[0, 1, corner]], "", "node 'x'")


def test_mass_is_assigned_only_when_the_node_is_a_whole_object() -> None:
    """A mass is dropped if the node contains other objects, or if it is one of several parts of the object."""

    def masses(*roots: AuthoredNode, how: Any = "authored") -> dict[str, float | None]:
        return {item.name: item.mass_kg for item in group_objects(roots, how)}

    door = replace(mesh("door"), mass_kg=2.0)
    fridge = replace(mesh("fridge", door), mass_kg=50.0)
    assert masses(fridge) == {"fridge": 50.0}
    assert masses(replace(group("kitchen_fridge", mesh("a")), mass_kg=7.0)) == {"kitchen_fridge": 7.0}
    assert masses(group("fridge_1", fridge)) == {"fridge_1": 50.0}
    assert masses(group("room", fridge, mesh("table"))) == {"fridge": 50.0, "table": None}
    desk = replace(mesh("desk", mesh("drawer", mesh("handle"))), mass_kg=9.0)
    assert masses(desk) == {"desk": None, "drawer": None}
    assert masses(replace(group("workbench", desk), mass_kg=9.0)) == {"workbench": None, "drawer": None}
    assert masses(fridge, how="leaf") == {"fridge": None, "door": 2.0}
    assert masses(group("room", fridge), how=2) == {"fridge": 50.0}
    assert masses(group("room", fridge), how={"fridge": "icebox"}) == {"icebox": 50.0}
    assert masses(group("room", fridge), how={"fridge": "icebox", "door": "icebox"}) == {"icebox": 50.0}
    assert masses(group("room", fridge), how={"fridge": "icebox", "door": "lid"}) == {"icebox": None, "lid": 2.0}
    assert masses(group("room", fridge), how={"door": "lid"}) == {"lid": 2.0, "fridge": None}
    assert masses(fridge, replace(door, name="gate"), how={"fridge": "both", "gate": "both"}) == {"both": None}
    assert masses(group("room", fridge), how=9) == {"fridge": None, "door": 2.0}


@pytest.mark.parametrize("at", [1.0, 0.99, -1.0])
def test_things_that_stand_on_a_mesh_are_objects(at: float) -> None:
    table = mesh("Table", mesh("Mug", at=at), mesh("Desk Lamp", at=at), mesh("Leg.001", at=at), at=5.0)
    assert objects(table) == {"Table": ["Table", "Leg.001"], "Mug": ["Mug"], "Desk Lamp": ["Desk Lamp"]}


@pytest.mark.parametrize(
    ("above", "name", "at"),
    [
        ("washer", "drum", 0.3),  # inside
        ("Table", "Table_Mug", 1.0),  # continues the name
        ("chairDesk(Clone)", "chair", 1.0),  # repeats a word of it
        ("Toilet", "Lid", 1.0),  # a part
        ("Table", "Cube.001", 1.0),  # says nothing
        ("Table", "", 1.0),
    ],
)
def test_other_leaves_stay_part_of_a_mesh(above: str, name: str, at: float) -> None:
    assert list(objects(mesh(above, mesh(name, at=at)))) == [above]


@pytest.mark.parametrize("above", ["Walls", "Floor", "Apartment", "hotel_room"])
def test_the_mesh_of_a_room_takes_no_furniture(above: str) -> None:
    pieces = mesh(f"{above}_trim"), mesh("Cube.003"), mesh("Wood"), mesh("Tile.001")
    room = mesh(above, mesh("Table"), mesh("Fan"), mesh("Door"), *pieces)
    assert objects(room) == {
        above: [above, f"{above}_trim", "Cube.003", "Wood", "Tile.001"],
        "Table": ["Table"],
        "Fan": ["Fan"],
        "Door": ["Door"],
    }


# -- what engines do not draw ----------------------------------------------------------------------------------------


def test_of_levels_of_detail_the_finest_is_read() -> None:
    tree = group("Room", mesh("Lamp_LOD0"), mesh("Lamp_LOD1"), group("Chair", *(mesh(f"Chair_LOD{i}") for i in (2, 1))))
    assert objects(tree) == {"Lamp_LOD0": ["Lamp_LOD0"], "Chair": ["Chair_LOD1"]}
    assert objects(group("Room", mesh("Vase"), mesh("Vase_LOD1.001"), mesh("MugLOD0"), mesh("MugLOD1"))) == {
        "Vase": ["Vase"],
        "MugLOD0": ["MugLOD0"],
    }
    assert objects(mesh("Chair", mesh("LOD1"), mesh("Chair_LOD2"))) == {"Chair": ["Chair"]}


def test_copies_of_one_level_are_all_read() -> None:
    assert list(objects(group("Room", mesh("A_LOD0"), mesh("A_LOD0.001"), mesh("B_LOD1"), mesh("Melod2")))) == [
        "A_LOD0",
        "A_LOD0.001",
        "B_LOD1",
        "Melod2",
    ]


@pytest.mark.parametrize(
    "name",
    ["UCX_Table_01", "UBX_Table", "Table-colonly", "Table-convcolonly.001", "TableCollider", "Table_Collision_Mesh"],
)
def test_collision_shapes_are_no_objects(name: str) -> None:
    assert objects(group("Room", mesh("Table"), mesh(name))) == {"Table": ["Table"]}
    assert objects(group("Room", group("Crate", mesh("visuals"), group("collisions", mesh("box"))))) == {
        "Crate": ["visuals"]
    }


def test_what_only_sounds_like_a_collision_shape_is_read() -> None:
    names = ["Wall-col", "Collie", "Collision course board", "ucx_x", "collider" + "1" * 200 + "x"]
    assert list(objects(group("Room", *map(mesh, names)))) == names


def test_undrawn_nodes_are_read_if_they_are_asked_for_or_all_that_is_there() -> None:
    tree = group("Room", mesh("Table"), group("Colliders", mesh("UCX_Table")))
    assert list(objects(tree, how="leaf")) == ["Table", "UCX_Table"]
    assert list(objects(tree, how={"UCX_Table": "block"})) == ["block", "Table"]
    assert list(objects(mesh("UCX_Table"))) == ["UCX_Table"]
    link = replace(group("link", mesh("link_collision")), is_object=True)
    assert objects(group("robot", link, mesh("mug"))) == {"link": ["link_collision"], "mug": ["mug"]}
