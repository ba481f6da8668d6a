"""Scenes made in Python: objects measure themselves, and `check` reports almost certain mistakes."""

import math
import tracemalloc
import warnings
from collections.abc import Sequence
from contextlib import nullcontext
from dataclasses import replace

import numpy as np
import pytest
import trimesh

from contact_scenes import boxes
from edge_scenes import EDGE_SCENES
from others import SCENES, needed
from scene2hap import Box, DominantSurface, Hinge, Pose, SceneObject, SceneSnapshot, TriMesh, bake, load_scene
from scene2hap.common.warning import SceneWarning
from scene2hap.contact.graph import ContactGraph
from scene2hap.errors import SceneError
from scene2hap.llm.chain.sharing import copies
from scene2hap.scene.geometry import distances
from scene2hap.scene.hinges import kinematic_chains
from scene2hap.scene.plausibility.units import UnitWarning

ROOM = [
    SceneObject("floor", pose=Pose((0.0, -0.05, 0.0)), geometry=Box((4.0, 0.1, 4.0))),
    SceneObject("table", pose=Pose((0.0, 0.36, 0.0)), geometry=Box((1.2, 0.72, 0.7))),
    SceneObject("phone", pose=Pose((0.3, 0.724, 0.1)), geometry=Box((0.07, 0.008, 0.15))),
    SceneObject("mug", pose=Pose((-0.3, 0.77, 0.1)), geometry=Box((0.08, 0.1, 0.08))),
    SceneObject("crate", pose=Pose((1.2, 0.2, 1.0)), geometry=Box((0.4, 0.4, 0.4))),
]


def moved(item: SceneObject, **changes: object) -> SceneObject:
    return replace(item, **changes)


def halved(objects: Sequence[SceneObject]) -> list[SceneObject]:
    """Boxes of half the sizes."""
    return [
        moved(item, geometry=Box(tuple(x / 2 for x in item.geometry.size_m)), surface=None)
        for item in objects
        if isinstance(item.geometry, Box)
    ]


def lowered(objects: Sequence[SceneObject], up: int = 1) -> list[SceneObject]:
    """The objects with their middles where their bottoms were."""
    down_m = [np.eye(3)[up] * np.ptp(item.bounds_m, axis=0)[up] / 2 for item in objects]
    poses = [
        Pose(tuple(item.pose.position_m - by_m), item.pose.rotation_xyzw)
        for item, by_m in zip(objects, down_m, strict=True)
    ]
    return [moved(item, pose=pose, surface=None) for item, pose in zip(objects, poses, strict=True)]


def test_object_measures_its_surface() -> None:
    phone = ROOM[2]
    assert phone.name == "phone"
    assert phone.size_m == pytest.approx((0.15, 0.07, 0.008))
    # The plate's normal points up.
    np.testing.assert_allclose(np.abs(phone.surface.pose.rotation[:, 2]), (0.0, 1.0, 0.0), atol=1e-9)


def test_heights_are_above_the_lowest_of_the_scene() -> None:
    scene = SceneSnapshot.build(ROOM)
    heights = {item.id: item.relative_height_m for item in scene.objects}
    assert heights == pytest.approx({"floor": 0.0, "table": 0.1, "phone": 0.82, "mug": 0.82, "crate": 0.1})
    assert scene.up_axis == "y"
    assert SceneSnapshot.from_json(scene.to_json()) == scene


def test_copies_share_a_key_and_an_analysis() -> None:
    """Four chairs of one mesh cost one question, a box of the same size under another name one more."""
    chair = trimesh.creation.box((0.4, 0.9, 0.4))
    row = [SceneObject(f"chair {k}", pose=Pose((0.6 * k, 0.45, 0)), geometry=chair) for k in range(4)]
    stool = SceneObject("stool", pose=Pose((3, 0.45, 0)), geometry=chair)
    given = SceneObject("bench", pose=Pose((4, 0.45, 0)), geometry=chair, instance_key="mine")
    scene = SceneSnapshot.build([*row, stool, given])
    assert len({item.instance_key for item in scene.objects[:5]}) == 1
    assert scene.object("bench").instance_key == "mine"
    assert scene.object("stool").instance_key != SceneSnapshot.build(ROOM).object("mug").instance_key
    shared = copies(scene, ContactGraph(scene), {})
    assert [shared[item.id] for item in scene.objects] == [*["chair 0"] * 4, "stool", "bench"]


def test_copies_stand_on_the_same_kind_or_touch_the_same_kinds() -> None:
    """What stands on an object makes no difference."""
    room = [
        SceneObject("floor", pose=Pose((0, -0.05, 0)), geometry=Box((6.0, 0.1, 4.0))),
        SceneObject("ceiling", pose=Pose((0, 2.55, 0)), geometry=Box((6.0, 0.1, 4.0))),
        SceneObject("wall", pose=Pose((0, 1.25, -2.05)), geometry=Box((6.0, 2.5, 0.1))),
    ]
    table, pan, lamp = Box((0.8, 0.7, 0.8)), Box((0.3, 0.1, 0.3)), Box((0.2, 0.2, 0.2))
    things = {
        "table 0": (table, (-2.0, 0.35, 0.0)),
        "table 1": (table, (0.0, 0.35, 0.0)),
        "pan 0": (pan, (-2.0, 0.75, 0.0)),
        "pan 1": (pan, (1.0, 0.05, 0.0)),
        "lamp 0": (lamp, (0.0, 2.4, 0.0)),
        "lamp 1": (lamp, (0.0, 1.5, -1.9)),
    }
    items = [SceneObject(name, pose=Pose(at), geometry=geometry) for name, (geometry, at) in things.items()]
    scene = SceneSnapshot.build([*room, *items])
    shared = copies(scene, ContactGraph(scene), {})
    assert [shared[name] for name in things] == ["table 0", "table 0", "pan 0", "pan 1", "lamp 0", "lamp 1"]


def test_equal_links_of_different_robots_are_no_copies() -> None:
    on = {"link 1": "joint 1", "joint 1": "robot", "link 2": "joint 2", "joint 2": "crane"}
    things = [
        SceneObject(
            name,
            pose=Pose((2.0 * k, 0.0, 0.0)),
            geometry=Box((0.1, 0.1, 0.1)),
            hinge=Hinge(on[name], (1.0, 0, 0), (-1.0, 0, 0)) if name in on else None,
        )
        for k, name in enumerate(["link 1", "joint 1", "robot", "link 2", "joint 2", "crane"])
    ]
    snapshot = SceneSnapshot.build(things)
    assert len({item.instance_key for item in snapshot.objects}) == 1
    assert copies(snapshot, ContactGraph(snapshot), kinematic_chains(snapshot.objects))["link 2"] == "link 2"


def test_surface_faces_up_with_z_up() -> None:
    cube = SceneObject("cube", geometry=Box((0.5, 0.5, 0.5)))
    assert np.abs(cube.surface.pose.rotation[1, 2]) == pytest.approx(1.0)
    for one in (cube, replace(cube, pose=Pose((0.0, 0.0, 0.25)))):
        scene = SceneSnapshot.build([one], up_axis="z")
        assert np.abs(scene.objects[0].surface.pose.rotation[2, 2]) == pytest.approx(1.0)
    # A given surface is kept.
    given = DominantSurface(Pose(), 0.3, 0.2, 0.01)
    kept = SceneSnapshot.build([SceneObject("cube", geometry=Box((0.5, 0.5, 0.5)), surface=given)], up_axis="z")
    assert kept.objects[0].surface == given


def test_a_surface_is_that_of_the_pose_and_the_geometry_in_the_scene() -> None:
    """A tray, open on one side, that was made first and laid, tipped or exchanged later, is measured as it is."""
    sides = trimesh.creation.box((0.4, 0.1, 0.3))
    sides.update_faces(sides.face_normals[:, 1] < 0.5)
    tipped = Pose.from_euler((0.0, 0.0, 0.0), (math.pi / 2, 0.0, 0.0))
    for up_axis in ("y", "z"):
        for pose, geometry in ((tipped, sides), (Pose(), Box((0.2, 0.5, 0.01)))):
            later = moved(SceneObject("tray", geometry=sides), pose=pose, geometry=geometry)
            at_once = SceneObject("tray", pose=pose, geometry=geometry)
            assert SceneSnapshot("room", up_axis, (later,)) == SceneSnapshot("room", up_axis, (at_once,))
    assert moved(SceneObject("tray", geometry=sides), geometry=Box((0.2, 0.5, 0.01))).size_m == (0.5, 0.2, 0.01)
    # In a scene an object keeps its surface, wherever it is moved.
    scene = SceneSnapshot.build([SceneObject("tray", geometry=sides)])
    assert scene.with_poses({"tray": tipped}).objects[0].surface == scene.objects[0].surface


@pytest.mark.parametrize(
    "make",
    [
        lambda: SceneObject("rock", geometry=Box((3e6, 1, 1))),
        lambda: SceneObject("rock", geometry=TriMesh(np.eye(3) * 1e200, [[0, 1, 2]])),
        lambda: SceneSnapshot.build([SceneObject("rock", pose=Pose((0, 1e308, 0)), geometry=Box((1, 1, 1)))]),
    ],
)
def test_coordinates_are_bounded(make: object) -> None:
    with pytest.raises(SceneError, match=r"object 'rock' is placed or scaled beyond 1e\+06 m"):
        make()


def test_meshes_of_other_packages_are_accepted() -> None:
    ball = trimesh.creation.icosphere(radius=0.1)
    one, other = SceneObject("ball", geometry=ball), SceneObject("other", geometry=(ball.vertices, ball.faces))
    assert isinstance(one.geometry, TriMesh)
    assert one.geometry == other.geometry
    assert one.surface is other.surface  # measured once


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: SceneObject("mug", Pose(), Box((1, 1, 1))), "Give what follows the id by name"),
        (lambda: SceneObject("mug"), "geometry of object 'mug' is missing"),
        (lambda: SceneObject("mug", geometry="cube"), r"must be a Box\(\(x, y, z\)\) of edges"),
        (lambda: SceneObject("mug", pose=(0, 1, 0), geometry=Box((1, 1, 1))), "pose of object 'mug' is"),
        (
            lambda: SceneObject("mug", geometry=Box((1, 1, 1)), surface="top"),
            "surface of object 'mug' is 'top'; it must",
        ),
        (lambda: SceneSnapshot.build(ROOM[0]), "must be a list of SceneObject"),
        (lambda: SceneSnapshot.build(["mug"]), "an object is 'mug'"),
        (lambda: SceneSnapshot.build([]), "has no object"),
        (lambda: SceneSnapshot.build([ROOM[0], ROOM[0]]), "used more than once"),
    ],
)
def test_invalid_scenes_are_refused(make: object, words: str) -> None:
    with pytest.raises(SceneError, match=words):
        make()


def test_check_finds_nothing_in_a_valid_room() -> None:
    assert SceneSnapshot.build(ROOM).check() == ()
    expected = {"no_contact": ["floating"]}
    for name, made in EDGE_SCENES.items():
        snapshot, _ = made()
        assert [found.kind for found in snapshot.check()] == expected.get(name, [])


@pytest.mark.parametrize(
    ("kind", "object_ids", "objects", "up_axis"),
    [
        ("floating", ("mug",), [*ROOM[:3], moved(ROOM[3], pose=Pose((-0.3, 1.9, 0.1))), ROOM[4]], "y"),
        ("sunk", ("crate",), [*ROOM[:4], moved(ROOM[4], pose=Pose((1.2, -0.5, 1.0)))], "y"),
        ("up-axis", tuple(item.id for item in ROOM), ROOM, "z"),
        (
            "half-sizes",
            tuple(item.id for item in ROOM),
            halved(ROOM),
            "y",
        ),
        ("bottoms", tuple(item.id for item in ROOM), lowered(ROOM), "y"),
        ("mass", ("mug",), [*ROOM[:3], moved(ROOM[3], mass_kg=20.0), ROOM[4]], "y"),  # 31 kg/l in its box
        (
            "quaternions",
            tuple(item.id for item in ROOM),
            [
                moved(item, pose=Pose(item.pose.position_m, (math.cos(0.1 * k), 0.0, math.sin(0.1 * k), 0.0)))
                for k, item in enumerate(ROOM)
            ],
            "y",
        ),
        (
            "quaternions",
            tuple(item.id for item in ROOM),
            [
                moved(item, pose=Pose(item.pose.position_m, (math.cos(0.1 * k), 0.0, 0.0, math.sin(0.1 * k))))
                for k, item in enumerate(ROOM)
            ],
            "z",
        ),
        (
            "units",
            tuple(item.id for item in ROOM),
            [
                moved(
                    item,
                    pose=Pose(tuple(1000 * x for x in item.pose.position_m)),
                    geometry=Box(tuple(1000 * x for x in item.geometry.size_m)),
                    surface=None,
                )
                for item in ROOM
            ],
            "y",
        ),
    ],
)
def test_check_finds_each_kind_of_mistake(
    kind: str, object_ids: tuple[str, ...], objects: list[SceneObject], up_axis: str
) -> None:
    with pytest.warns(UnitWarning) if kind == "units" else nullcontext():
        scene = SceneSnapshot.build(objects, up_axis=up_axis)
    found = scene.check()
    assert [(one.kind, one.object_ids) for one in found][:1] == [(kind, object_ids)]
    assert str(found[0]).endswith(".")


def test_half_sizes_of_few_flat_objects_are_found() -> None:
    """Objects of less than 6 cm do not rest on themselves."""
    sizes_m = {"floor": (3, 0.05, 2), "table": (0.6, 0.36, 0.35), "phone": (0.035, 0.004, 0.075)}
    objects = [moved(item, geometry=Box(sizes_m[item.id])) for item in ROOM[:3]]
    (found,) = SceneSnapshot.build(objects).check()
    assert found.kind == "half-sizes"
    assert "33% of 3 objects rest on others, 100% if all were twice as large" in str(found)


@pytest.mark.parametrize("up_axis", ["y", "z"])
def test_boxes_whose_middles_are_at_one_height_are_not_taken_for_bottoms(up_axis: str) -> None:
    """As a shaft with its wheels, or the modules of a space station."""
    sizes_m = {
        "motor": (0.4, 0.3, 0.3),
        "shaft": (0.8, 0.05, 0.05),
        "pulley": (0.1, 0.4, 0.4),
        "wheel": (0.1, 0.8, 0.8),
    }
    objects = [
        SceneObject(name, pose=Pose((0.4 * column, 0.0, 0.0)), geometry=Box(size_m))
        for column, (name, size_m) in enumerate(sizes_m.items())
    ]
    assert SceneSnapshot.build(objects, up_axis=up_axis).check() == ()


def test_things_on_the_boards_of_a_rack_are_not_taken_for_halves() -> None:
    """Meshes of files have the sizes that they show. Twice as large, each of these would rest on the one below."""
    rack = boxes("rack", *(((2.0, 0.02, 0.6), (0.0, 0.4 * row + 0.01, 0.0)) for row in range(4)))
    tins = [
        boxes(f"tin {row} {x}", ((0.2, 0.2, 0.2), (x, 0.4 * row + 0.12, 0.0))) for row in range(4) for x in (-0.6, 0.6)
    ]
    assert SceneSnapshot.build([rack, *tins]).check() == ()


def test_what_stands_in_a_valley_is_not_sunk() -> None:
    """The box of hilly ground ends at the highest hill."""
    x, z = np.meshgrid(np.linspace(-50, 50, 41), np.linspace(-50, 50, 41), indexing="ij")
    height = 5 * np.clip(np.hypot(x, z) - 20, 0, 20) / 20
    row, column = np.divmod(np.arange(40 * 40), 40)
    corner = 41 * row + column
    faces = np.concatenate(
        [np.stack([corner, corner + 1, corner + 42], 1), np.stack([corner, corner + 42, corner + 41], 1)]
    )
    hills = SceneObject("terrain", geometry=(np.stack([x, height, z], -1).reshape(-1, 3), faces))
    for up_m, kinds in {0.5: [], 0.2: ["sunk"]}.items():
        crates = [SceneObject(f"crate {k}", pose=Pose((2.0 * k, up_m, 1)), geometry=Box((1, 1, 1))) for k in range(5)]
        assert [found.kind for found in SceneSnapshot.build([hills, *crates]).check()] == kinds


@pytest.mark.parametrize(
    ("up_m", "kind", "words"),
    [
        (0.0, None, ""),
        (0.1, None, ""),
        (0.4, "floating", "the room floats: the lowest of 4 objects over 'floor' is 0.40 m above it"),
        (-0.09, None, ""),
        (-0.15, "sunk", "'floor'"),
    ],
)
def test_check_finds_a_room_above_or_below_its_floor(up_m: float, kind: str | None, words: str) -> None:
    """As after an export with two origins: all objects except the floor are shifted."""
    crates = [moved(ROOM[4], id=f"crate {k}", pose=Pose((1.2 - 0.6 * k, 0.2, -1.0))) for k in range(4)]
    things = crates if kind == "sunk" else ROOM[1:]
    lifted = [
        moved(item, pose=Pose((item.pose.position_m[0], item.pose.position_m[1] + up_m, item.pose.position_m[2])))
        for item in things
    ]
    found = SceneSnapshot.build([ROOM[0], *lifted]).check()
    assert [one.kind for one in found] == ([kind] if kind else [])
    if kind:
        assert set(found[0].object_ids) == {item.id for item in things}
        assert words in str(found[0])


def gallery(*more: str) -> list[SceneObject]:
    """A floor, a wall, and pictures on the wall: most things touch what is beside them, and not what is below them."""
    wall = SceneObject("wall", pose=Pose((0, 1.25, -2.05)), geometry=Box((4.0, 2.5, 0.1)))
    names = ("picture", "clock", *more)
    return [
        ROOM[0],
        wall,
        *(
            SceneObject(name, pose=Pose((k - 1.0, 1.5, -1.98)), geometry=Box((0.4, 0.4, 0.04)))
            for k, name in enumerate(names)
        ),
    ]


def test_three_objects_beside_each_other_do_not_tip_the_up_axis() -> None:
    books = [
        SceneObject(f"book {k}", pose=Pose((0, 0.1 * k, 0.1 * k)), geometry=Box((0.2, 0.2, 0.1))) for k in range(3)
    ]
    assert SceneSnapshot.build(books).check() == ()


def test_a_floor_on_edge_tips_the_up_axis_of_few_objects() -> None:
    """Sizes and positions of a scene with z up, as they are given first: without `up_axis`."""
    floor = SceneObject("wooden floor", pose=Pose((0, 0, -0.05)), geometry=Box((4, 4, 0.1)))
    table = SceneObject("wooden table", pose=Pose((0, 0, 0.36)), geometry=Box((1.2, 0.7, 0.72)))
    phone = SceneObject("smartphone", pose=Pose((0.3, 0.1, 0.724)), geometry=Box((0.07, 0.15, 0.008)))
    (found,) = SceneSnapshot.build([floor, table, phone]).check()
    assert found.kind == "up-axis"
    assert "Give up_axis='z'" in str(found)
    assert SceneSnapshot.build([floor, table, phone], up_axis="z").check() == ()


def test_a_hinge_on_an_id_is_refused() -> None:
    door = SceneObject("door", geometry=Box((1.0, 2.0, 0.04)))
    with pytest.raises(SceneError, match=r"other is 'wall'.*must be the SceneObject that holds 'door'"):
        door.hinged_on("wall", (0.0, 1.0, 0.0))  # type: ignore[arg-type]


@pytest.mark.parametrize("more", [(), ("mirror", "shelf")])
def test_pictures_on_a_wall_do_not_tip_the_up_axis(more: tuple[str, ...]) -> None:
    assert SceneSnapshot.build(gallery(*more)).check() == ()


def test_an_object_in_the_air_is_felt_by_a_hand_on_it() -> None:
    ball = SceneObject("tennis ball", pose=Pose((0, 2.0, 0)), geometry=Box((0.07, 0.07, 0.07)))
    (found,) = SceneSnapshot.build([*ROOM, ball]).check()
    assert str(found).endswith("Move it onto something; until then only a hand on it feels it.")


def test_a_roof_is_no_floor() -> None:
    roof = SceneObject("roof", pose=Pose((0, 2.6, 0)), geometry=Box((3.0, 0.2, 3.0)))
    posts = [
        SceneObject(f"post {k}", pose=Pose((x, 1.25, z)), geometry=Box((0.1, 2.5, 0.1)))
        for k, (x, z) in enumerate([(-1.4, -1.4), (1.4, -1.4), (-1.4, 1.4), (1.4, 1.4)])
    ]
    bench = SceneObject("bench", pose=Pose((0, 0.25, 0)), geometry=Box((1.5, 0.5, 0.4)))
    assert SceneSnapshot.build([roof, *posts, bench]).check() == ()


def test_the_lowest_floor_of_a_house_is_its_floor() -> None:
    """Things on the lower one are below the upper one, and not sunk."""
    floors = [
        SceneObject(name, pose=Pose((0, y, 0)), geometry=Box((5.0, 0.1, 5.0)))
        for name, y in (("upper floor", 2.55), ("lower floor", -0.05))
    ]
    stools = [
        SceneObject(f"stool {k}", pose=Pose((k - 2.0, y, 0)), geometry=Box((0.4, 0.4, 0.4)))
        for k, y in enumerate((0.2, 0.2, 0.2, 2.8, 2.8))
    ]
    assert SceneSnapshot.build([*floors, *stools]).check() == ()


def test_check_finds_real_scene_lifted_off_its_floor() -> None:
    scene = load_scene(needed(SCENES / "composed_kitchen_kaykit/composed_kitchen_kaykit.glb"))
    up = {"y": 1, "z": 2}[scene.up_axis]
    low = np.array([item.bounds_m[0] for item in scene.objects])
    floor = scene.objects[int(low[:, up].argmin())].id
    shift = np.eye(3)[up]
    lifted = {
        item.id: Pose(tuple(np.add(item.pose.position_m, shift)), item.pose.rotation_xyzw)
        for item in scene.objects
        if item.id != floor
    }
    assert "floating" in {one.kind for one in scene.with_poses(lifted).check()}


def test_two_upside_down_objects_suggest_quaternions_with_w_first() -> None:
    flipped = [moved(item, pose=Pose(item.pose.position_m, (1.0, 0.0, 0.0, 0.0))) for item in ROOM[:2]]
    assert [one.kind for one in SceneSnapshot.build(flipped).check()] == ["quaternions"]
    assert SceneSnapshot.build([flipped[1], ROOM[0]]).check() == ()


def test_a_scene_of_thousands_is_checked_in_bounded_memory() -> None:
    crates = [
        moved(ROOM[4], id=f"{k}", pose=Pose((k % 60, 0.2, k // 60)), surface=ROOM[4].surface) for k in range(3000)
    ]
    scene = SceneSnapshot("crowd", "y", tuple(crates))
    tracemalloc.start()
    assert scene.check() == ()
    assert tracemalloc.get_traced_memory()[1] < 150e6
    tracemalloc.stop()


@pytest.mark.parametrize(
    "name",
    [
        "aws_house_living/aws_house_living.glb",
        "aws_house_bedroom/aws_house_bedroom.glb",
        "composed_kitchen_kaykit/composed_kitchen_kaykit.glb",
        "composed_bathroom_kenney/composed_bathroom_kenney.glb",
    ],
)
def test_real_scenes_pass_the_check_and_fail_with_another_up_axis(name: str) -> None:
    scene = load_scene(needed(SCENES / name))
    assert scene.check() == ()
    as_boxes = [
        SceneObject(
            item.id, pose=Pose(tuple(item.bounds_m.mean(axis=0))), geometry=Box(tuple(np.ptp(item.bounds_m, 0)))
        )
        for item in scene.objects
    ]
    right = SceneSnapshot.build(as_boxes, up_axis=scene.up_axis).check()
    assert {found.kind for found in right} <= {"floating"}  # some lie within the box of what they lean on
    (found,) = SceneSnapshot.build(halved(as_boxes), up_axis=scene.up_axis).check()
    assert found.kind == "half-sizes"
    bottoms = lowered(as_boxes, "xyz".index(scene.up_axis))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UnitWarning)  # appliances end lower above the floor than usual ones
        found = SceneSnapshot.build(bottoms, up_axis=scene.up_axis).check()[-1]
    # The floors of the houses are thin, so that most other objects sink deeper.
    assert found.kind == ("sunk" if name.startswith("aws") else "bottoms")
    other = replace(scene, up_axis="z" if scene.up_axis == "y" else "y")
    assert "up-axis" in {found.kind for found in other.check()}


FRIDGE = SceneObject("fridge", pose=Pose((1.0, 0.9, -1.5)), geometry=Box((0.6, 1.8, 0.6)))


def milk_at(x: float, y: float) -> SceneObject:
    return SceneObject("milk", pose=Pose((x, y, -1.5)), geometry=Box((0.1, 0.2, 0.1)))


def test_an_object_that_floats_inside_another_is_found() -> None:
    scene = SceneSnapshot.build([*ROOM, FRIDGE, milk_at(1.0, 1.0)])
    (found,) = scene.check()
    assert (found.kind, found.object_ids) == ("floating", ("milk",))
    assert "at least 0.25 m from the surface of 'fridge'" in str(found)
    assert not list(ContactGraph(scene).neighbours("milk"))


def test_nothing_floats_inside_another_object_in_a_wrong_unit() -> None:
    """The bottom of the refrigerator is 50 mm below the milk, and read as 50 m."""
    near = [
        moved(
            item,
            pose=Pose(tuple(1000 * x for x in item.pose.position_m)),
            geometry=Box(tuple(1000 * x for x in item.geometry.size_m)),
            surface=None,
        )
        for item in (*ROOM, FRIDGE, milk_at(1.0, 0.15))
    ]
    with pytest.warns(UnitWarning):
        found = SceneSnapshot.build(near).check()
    assert found[0].kind == "units"
    assert not any("inside another object" in str(one) for one in found)


@pytest.mark.parametrize(
    ("others", "why"),
    [
        ([FRIDGE, milk_at(1.0, 0.15)], "near the bottom"),
        ([FRIDGE, milk_at(1.22, 1.0)], "near a side"),
        ([FRIDGE, milk_at(1.0, 1.0), SceneObject("rack", pose=Pose((1.0, 0.85, -1.5)), geometry=Box((0.7, 0.1, 0.5)))],
         "on a rack"),
        ([SceneObject("desk", pose=Pose((1.0, 0.7, -1.5)), geometry=trimesh.creation.box((0.9, 0.04, 0.6))),
          SceneObject("legs", pose=Pose((1.0, 0.35, -1.5)), geometry=trimesh.util.concatenate(
              [trimesh.creation.box((0.04, 0.7, 0.6)).apply_translation((x, 0, 0)) for x in (-0.4, 0.4)])),
          milk_at(1.0, 0.4)], "open at the front"),
    ],
)  # fmt: skip
def test_an_object_that_is_near_a_surface_or_in_the_open_does_not_float_inside(
    others: list[SceneObject], why: str
) -> None:
    assert SceneSnapshot.build([*ROOM, *others]).check() == (), why


def test_bake_warns_of_floating_objects_and_scenes_without_sources() -> None:
    objects = [*ROOM[:3], moved(ROOM[3], pose=Pose((-0.3, 1.9, 0.1))), ROOM[4]]
    with pytest.warns(SceneWarning, match="'mug' floats"):
        bake(SceneSnapshot.build(objects))
    with pytest.warns(
        SceneWarning, match=r"none of 2 objects of 'scene' vibrates; .* or override\(id, vibrates=True\)\.$"
    ):
        bake(SceneSnapshot.build(ROOM[:2]))
    parts = [moved(ROOM[1], id="Cylinder.003"), moved(ROOM[2], id="Circle.022"), ROOM[4]]
    parts = [moved(item, name=item.id) for item in parts]
    with pytest.warns(SceneWarning, match="one model of many parts, load it with group=0"):
        bake(SceneSnapshot.build(parts))


def test_bake_leaves_warnings_of_units_to_load_scene() -> None:
    with pytest.warns(UnitWarning):
        scene = SceneSnapshot.build([SceneObject("table", geometry=Box((1200.0, 720.0, 700.0)))])
    assert [found.kind for found in scene.check()] == ["units"]
    with warnings.catch_warnings():
        warnings.simplefilter("error", SceneWarning)
        bake(scene)


def test_check_does_not_depend_on_batch_size(monkeypatch: pytest.MonkeyPatch) -> None:
    rng = np.random.default_rng(5)
    boxes = [
        SceneObject(f"box{i}", pose=Pose(tuple(rng.uniform(0, 6, 3))), geometry=Box(tuple(rng.uniform(0.1, 1, 3))))
        for i in range(60)
    ]
    scene = SceneSnapshot.build([*ROOM, *boxes])
    whole = scene.check()
    assert whole
    for n in (1, 7, 64):
        monkeypatch.setattr("scene2hap.scene.plausibility.resting._BATCH", n)
        assert scene.check() == whole


def test_check_compares_each_object_with_those_near_it_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    """A level of 10,000 objects took 14 s, most of it for pairs at opposite ends."""
    n_compared = 0

    def counted(boxes_m: np.ndarray, others_m: np.ndarray) -> np.ndarray:
        nonlocal n_compared
        found = distances(boxes_m, others_m)
        n_compared += found.size
        return found

    monkeypatch.setattr("scene2hap.scene.plausibility.resting.distances", counted)
    n = 2000
    crates = [
        SceneObject(f"crate_{i}", "Crate", pose=Pose((2.0 * i, 0.2, 0.0)), geometry=Box((0.4, 0.4, 0.4)))
        for i in range(n)
    ]
    assert not SceneSnapshot.build(crates).check()
    assert n_compared < n * n / 4


def test_a_floating_object_is_found_far_from_all_others_and_its_distance_is_to_the_nearest() -> None:
    crates = [
        SceneObject(f"crate_{i}", "Crate", pose=Pose((2.0 * i, 0.2, 0.0)), geometry=Box((0.4, 0.4, 0.4)))
        for i in range(400)
    ]
    lamp = SceneObject("lamp", pose=Pose((900.0, 3.0, 0.0)), geometry=Box((0.2, 0.2, 0.2)))
    (found,) = SceneSnapshot.build([*crates, lamp]).check()
    assert found.object_ids == ("lamp",)
    assert "floats: it is 101.73 m from the nearest" in str(found)
