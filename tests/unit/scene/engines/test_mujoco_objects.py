"""Objects of a MuJoCo model, and their names."""

from __future__ import annotations

from typing import Any

import pytest

from mujoco_scenes import scene_of
from scene2hap import SceneSnapshot
from scene2hap.errors import SceneError


def names(scene: SceneSnapshot) -> dict[str, str]:
    return {item.id: item.name for item in scene.objects}


def test_jointed_bodies_are_objects_and_bodies_without_geoms_are_skipped() -> None:
    scene = scene_of(
        '<worldbody><body name="room"><body name="cabinet"><geom size="1"/>'
        '<body name="door"><joint/><geom size="0.5"/><body name="knob"><geom size="0.1"/></body></body></body>'
        '<body name="shelf"><geom size="1"/></body></body></worldbody>'
    )
    assert names(scene) == {name: name for name in ("cabinet", "door", "knob", "shelf")}


def test_body_without_geoms_gives_its_name_to_its_only_child() -> None:
    scene = scene_of(
        '<worldbody><body name="microwave"><body name="microroot"><geom size="1"/>'
        '<body name="microdoor"><joint/><geom size="0.5"/></body></body></body>'
        '<body name="kitchen"><body name="table"><geom size="1"/></body></body>'
        '<body name="rail"><body name="slider"><joint/><geom size="1"/></body></body></worldbody>'
    )
    # Names of places are not passed on, nor names of wrappers in which the child moves.
    assert names(scene) == {
        "microroot": "microwave", "microdoor": "microdoor", "table": "table", "slider": "slider"
    }  # fmt: skip


def test_abbreviated_wrapper_leaves_the_body_its_own_name() -> None:
    scene = scene_of(
        '<worldbody><body name="bsktball"><body name="basketball"><geom size="0.1"/></body></body></worldbody>'
    )
    assert names(scene) == {"basketball": "basketball"}


def test_unnamed_bodies_get_ids_from_their_place_in_the_tree() -> None:
    xml = (
        '<asset><mesh name="wedge" file="wedge.obj"/></asset>'
        '<worldbody><geom type="plane" size="1 1 1"/><geom name="wall" type="box" size="1 1 1"/>'
        '<body><geom name="top" size="1"/><body/><body><geom size="1"/></body></body>'
        '<body name="cup"><geom size="1"/><body><geom type="mesh" mesh="wedge"/></body></body></worldbody>'
    )
    scene = scene_of(xml)
    assert names(scene) == {
        "world/body1": "top",
        "world/body1/body2": "world/body1/body2",
        "cup": "cup",
        "cup/body1": "wedge",
        "world/geom1": "floor",
        "wall": "wall",
    }
    again = scene_of(xml)
    assert names(again) == names(scene)
    assert [item.geometry for item in again.objects] == [item.geometry for item in scene.objects]


@pytest.mark.parametrize(
    ("body", "name"),
    [
        # Kits of objects call every body "object", and name its mesh or its geoms.
        ('<body name="object"><geom type="mesh" mesh="milk_mesh"/></body>', "milk_mesh"),
        ('<body name="object0"><geom name="kettle_visual" size="1"/></body>', "kettle_visual"),
        # The common words name the whole, each name by itself a part.
        ('<body><geom name="club_handle" size="1"/><geom name="club_head" size="1"/></body>', "club"),
        ('<body><geom name="shelf_0" size="1"/><geom name="shelf_1" size="1"/></body>', "shelf_0"),
        ('<body name="Object"><geom name="handle" size="1"/><geom name="head" size="1"/></body>', "Object"),
        # Without a word in the body, its parent names it.
        ('<body name="lamp"><geom size="1"/><body name=""><geom name="geom0" size="1"/></body></body>', "lamp/body1"),
        # A name that says something stays, whatever its geoms are called.
        ('<body name="cup"><geom name="kettle" size="1"/></body>', "cup"),
        ('<geom type="plane" size="1 1 1" euler="90 0 0"/>', "world/geom1"),
        ('<geom name="ground_plane" type="plane" size="1 1 1"/>', "ground_plane"),
        ('<geom name="plane" type="plane" size="1 1 1"/>', "floor"),
    ],
)
def test_bodies_whose_name_says_nothing_are_named_after_their_geoms(body: str, name: str) -> None:
    mesh = '<asset><mesh name="milk_mesh" file="wedge.obj"/></asset>'
    assert list(names(scene_of(f"{mesh}<worldbody>{body}</worldbody>")).values())[-1] == name


def test_body_and_geom_with_one_name_get_different_ids() -> None:
    scene = scene_of('<worldbody><geom name="a" size="1"/><body name="a"><geom size="2"/></body></worldbody>')
    assert {item.id: round(item.bounds_m[1, 0]) for item in scene.objects} == {"a": 2, "a#2": 1}


def test_geoms_without_collision_give_the_appearance_of_a_body() -> None:
    body = (
        '<worldbody><body name="drawer">'
        '<geom size="1" group="1" contype="0" conaffinity="0"/><geom size="2" group="4" contype="0" conaffinity="1"/>'
        '<geom size="3" group="2" contype="0" conaffinity="0" rgba="1 1 1 0"/></body>'
        '<body name="block"><geom size="2" group="4"/></body></worldbody>'
    )

    def radii(**options: Any) -> dict[str, int]:
        return {item.id: round(item.bounds_m[1, 0]) for item in scene_of(body, **options).objects}

    assert radii() == {"drawer": 1, "block": 2}
    assert radii(geom_groups={4}) == {"drawer": 2, "block": 2}
    assert radii(geom_groups=[1, 2]) == {"drawer": 3}
    with pytest.raises(SceneError, match="no geom is in geom_groups {0}"):
        radii(geom_groups=(0,))
    with pytest.raises(SceneError, match="geom_groups is 4; it must be a set of group numbers"):
        radii(geom_groups=4)


def test_markers_that_cannot_collide_are_no_objects() -> None:
    """Targets of a gripper are drawn as mocap bodies. As objects they would land, and carry vibration."""
    bodies = (
        '<worldbody><body name="target" mocap="true"><geom size="1" contype="0" conaffinity="0"/></body>'
        '<body name="hand" mocap="true"><geom size="1"/></body>'
        '<body name="cup"><geom size="1" contype="0" conaffinity="0"/></body></worldbody>'
    )
    assert {item.id for item in scene_of(bodies).objects} == {"hand", "cup"}
    assert {item.id for item in scene_of(bodies, geom_groups={0}).objects} == {"target", "hand", "cup"}


def test_hidden_world_geoms_are_left_out() -> None:
    scene = scene_of(
        '<worldbody><geom name="floor" size="1"/><geom name="hidden" size="1" group="3"/>'
        '<geom name="poster" size="1" group="3" contype="0" conaffinity="0"/></worldbody>'
    )
    assert {item.id for item in scene.objects} == {"floor", "poster"}


def test_copies_share_a_mesh() -> None:
    thing = '<geom type="cylinder" size="0.1 0.2" pos="0 0 0.2"/><geom type="box" size="0.2 0.2 0.01"/>'
    scene = scene_of(
        f'<worldbody><body name="a" pos="1 2 3">{thing}</body><body name="b" euler="10 20 30">{thing}</body>'
        f'<body name="c"><geom type="box" size="0.2 0.2 0.01" rgba="1 0 0 1"/></body></worldbody>'
    )
    a, b, c = scene.objects
    assert a.geometry is b.geometry
    assert a.instance_key == b.instance_key != c.instance_key
