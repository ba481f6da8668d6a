"""Relations of objects for pictures: support, nearness, shells, containers, and copies that share pictures."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from scene2hap import SceneObject
from scene2hap.scene.capture.faces import planes, separates
from scene2hap.scene.capture.render_scene import RenderScene
from scene2hap.scene.capture.surroundings import Copies, containers, holders, near, shells, supports
from scenes import box, scene

ROOM = (
    box("floor", (6, 0.1, 4), (0, -0.05, 0)),
    box("wall", (6, 2.5, 0.1), (0, 1.25, -1.95)),
    box("tile", (0.8, 2.5, 0.1), (2, 1.25, 1.95)),
    box("table", (1.2, 0.7, 0.8), (0, 0.35, 0)),
    box("cup", (0.1, 0.1, 0.1), (0.2, 0.76, 0)),
    box("saucer", (0.2, 0.02, 0.2), (0.2, 0.699, 0)),
    box("lamp", (0.3, 0.3, 0.3), (0, 2.2, 0)),
    box("chair", (0.4, 0.9, 0.4), (2, 0.45, 1)),
    box("fridge", (0.7, 2.0, 0.7), (-2.6, 1.0, -1.5)),
)


def render_scene(*objects: SceneObject) -> RenderScene:
    return RenderScene.of(scene(*objects))


def names(room: RenderScene, numbers: frozenset[int]) -> set[str]:
    return {room.objects[k].id for k in numbers}


def test_support_is_the_first_object_below() -> None:
    room = render_scene(*ROOM)
    below = {item.id: under for item, under in zip(room.objects, supports(room), strict=True)}
    found = {key: None if under is None else room.objects[under].id for key, under in below.items()}
    # The saucer is sunk into the table by half its height, and the cup hovers 1 mm above the saucer.
    assert found == {
        "floor": None,
        "wall": "floor",
        "tile": "floor",
        "table": "floor",
        "cup": "saucer",
        "saucer": "table",
        "lamp": "table",
        "chair": "floor",
        "fridge": "floor",
    }


def test_support_follows_the_up_axis() -> None:
    objects = (box("floor", (4, 4, 0.1), (0, 0, -0.05)), box("cube", (1, 1, 1), (0, 0, 0.5)))
    upright = RenderScene.of(replace(scene(*objects), up_axis="z"))
    assert supports(upright) == (None, 0)


def test_floor_walls_and_pieces_of_wall_are_shells() -> None:
    room = render_scene(*ROOM)
    assert names(room, shells(room)) == {"floor", "wall", "tile"}


def test_near_distance_scales_with_the_target() -> None:
    room = render_scene(*ROOM)
    table = room.index["table"]
    assert names(room, near(room, table, 0.1)) == {"floor", "cup", "saucer"}
    assert "chair" in names(room, near(room, table, 1.0))


def test_container_encloses_most_of_the_target() -> None:
    room = render_scene(
        box("cabinet", (1, 1, 1), (0, 0.5, 0)),
        box("plate", (0.2, 0.02, 0.2), (0, 0.5, 0)),
        box("door", (0.5, 0.5, 0.5), (0.5, 0.5, 0)),
    )
    assert names(room, containers(room, room.index["plate"])) == {"cabinet"}
    assert names(room, containers(room, room.index["door"])) == set()


def test_touching_faces_are_separated_far_from_the_origin() -> None:
    far = 1e5
    room = render_scene(box("table", (1, 0.7, 1), (far, 0.35, far)), box("cup", (0.1, 0.1, 0.1), (far, 0.75, far)))
    table, cup = (room.objects[k].box_m for k in (0, 1))
    gap = cup[0, 1] - table[1, 1]
    assert 0 < gap < 1e-3
    np.testing.assert_allclose(np.ptp(cup, axis=0), 0.1, rtol=1e-2)


def test_plane_hides_only_points_behind_it() -> None:
    triangle = np.array([[(0, 0, 0), (1, 0, 0), (0, 1, 0)]], np.float32)
    wall = planes(np.concatenate((triangle, triangle[:, ::-1], np.zeros_like(triangle))))
    across, beside = np.array([5.0, 5.0, -1.0]), np.array([5.0, 5.0, 1.0])
    eye = np.array([0.0, 0.0, 3.0])
    assert separates(wall, eye, across).tolist() == [True, True, False]
    assert separates(wall, eye, beside).tolist() == [False, False, False]


def test_copies_on_equal_supports_share_context_pictures() -> None:
    keys = {"floor": "f", "table": "t", "cup": "c", "cup2": "c", "cup3": "c", "bowl": "", "bowl2": ""}
    below = [None, 0, 1, 1, 0, 1, 1]
    objects = [replace(box(name, (1, 1, 1), (0, 0, 0)), instance_key=key) for name, key in keys.items()]
    copies = Copies(objects, below, (frozenset(),) * len(objects), share=True)
    assert [copies.isolated[key] for key in keys] == ["floor", "table", "cup", "cup", "cup", "bowl", "bowl2"]
    assert [copies.context[key] for key in keys] == ["floor", "table", "cup", "cup", "cup3", "bowl", "bowl2"]
    apart = Copies(objects, below, (frozenset(),) * len(objects), share=False)
    assert apart.isolated == {key: key for key in keys} == apart.context


def test_copies_that_hang_on_different_things_have_context_pictures_of_their_own() -> None:
    frames = {"frame": (-1.0, 1.5, -1.87), "frame#2": (1.0, 1.5, -1.87), "frame#3": (0, 0.6, 1.07)}
    objects = (
        box("floor", (6, 0.1, 4), (0, -0.05, 0)),
        box("wall", (6, 2.5, 0.1), (0, 1.25, -1.95)),
        box("cupboard", (1, 1.2, 0.3), (0, 0.65, 1.25)),
        *(replace(box(key, (0.3, 0.4, 0.05), place), name="frame", instance_key="f") for key, place in frames.items()),
    )
    room = render_scene(*objects)
    below = supports(room)
    held_by = holders(room, below, 0.1)
    assert [names(room, by) for by in held_by[3:]] == [{"wall"}, {"wall"}, {"cupboard"}]
    copies = Copies(objects, below, held_by, share=True)
    assert [copies.isolated[key] for key in frames] == ["frame"] * 3
    assert [copies.context[key] for key in frames] == ["frame", "frame", "frame#3"]
