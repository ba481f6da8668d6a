"""JSON scenes without surfaces and heights, which the reader then measures."""

from __future__ import annotations

import json
import subprocess
import sys
from typing import Any

import pytest

from scene2hap import ContactGraph, SceneSnapshot
from scene2hap.errors import SceneError

SLAB = [[x, y, z] for x in (0.0, 2.0) for y in (0.0, 0.1) for z in (0.0, 1.0)]
QUADS = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
FACES = [list(corners) for a, b, c, d in QUADS for corners in ((a, b, c), (a, c, d))]


def read(*objects: dict[str, Any], up_axis: str = "y", **more: Any) -> SceneSnapshot:
    head = {"format": "scene2hap/scene", "version": 1, "name": "s", "up_axis": up_axis}
    return SceneSnapshot.from_json(json.dumps({**head, "objects": objects, **more}))


def row(object_id: str, geometry: Any, at_m: tuple[float, float, float] = (0, 0, 0), **more: Any) -> dict[str, Any]:
    return {"id": object_id, "name": object_id, "pose": {"position_m": at_m}, "geometry": geometry, **more}


def test_missing_surface_is_measured() -> None:
    scene = read(row("slab", {"kind": "mesh", "vertices_m": SLAB, "faces": FACES}))
    surface = scene.object("slab").surface
    assert (surface.length_m, surface.width_m, surface.thickness_m) == pytest.approx((2.0, 1.0, 0.1))
    assert surface.flags == ()
    # The z axis of the corner frame points up, and its origin is in the middle of the thickness.
    assert surface.pose.rotation[:, 2] == pytest.approx((0, 1, 0))
    assert surface.pose.position_m[1] == pytest.approx(0.05)


def test_measured_surface_faces_up_for_any_up_axis() -> None:
    board = {"kind": "box", "size_m": [1, 0.1, 0.6]}
    lying = {"rotation_xyzw": [0.5**0.5, 0, 0, 0.5**0.5]}  # a quarter turn about x: y becomes world z
    scene = read({"id": "a", "name": "a", "pose": lying, "geometry": board}, up_axis="z")
    item = scene.object("a")
    assert item.pose.compose(item.surface.pose).rotation[:, 2] == pytest.approx((0, 0, 1))


def test_heights_are_measured_from_the_lowest_object() -> None:
    cube = {"kind": "box", "size_m": [1, 1, 1]}
    scene = read(row("a", cube, (0, 5, 0)), row("b", cube, (0, 7, 0)), row("c", cube, (0, 6, 0), relative_height_m=9))
    assert [item.relative_height_m for item in scene.objects] == pytest.approx([0, 2, 9])
    scene = read(row("a", cube, (0, 0, 5)), row("b", cube, (0, 0, 7)), up_axis="z")
    assert [item.relative_height_m for item in scene.objects] == pytest.approx([0, 2])


def test_a_given_surface_is_kept() -> None:
    surface = {"pose": {}, "length_m": 7, "width_m": 6, "thickness_m": 2}
    cube = {"kind": "box", "size_m": [1, 1, 1]}
    scene = read(row("told", cube, surface=surface), row("open", cube, (3, 0, 0)))
    assert scene.object("told").size_m == (7, 6, 2)
    assert scene.object("open").size_m == (1, 1, 1)


def test_shared_geometry_is_measured_and_round_trips() -> None:
    cube = {"kind": "box", "size_m": [1, 1, 1]}
    scene = read(row("a", "cube"), row("b", "cube", (0, 1, 0)), geometries={"cube": cube}, contacts=[])
    assert scene.object("a").geometry is scene.object("b").geometry
    assert scene.contacts == ()
    assert SceneSnapshot.from_json(scene.to_json()) == scene
    assert ContactGraph(scene).contacts == ()


def test_scene_with_given_surfaces_is_read_without_measuring() -> None:
    scene = read(row("a", {"kind": "box", "size_m": [1, 1, 1]}))
    code = (
        "import sys\nfrom scene2hap import SceneSnapshot\nSceneSnapshot.from_json(sys.stdin.read())\n"
        "print('scene2hap.scene.surface.dominant_surface' in sys.modules)"
    )
    run = subprocess.run(
        [sys.executable, "-c", code], input=scene.to_json(), capture_output=True, text=True, check=True
    )
    assert run.stdout.strip() == "False"


@pytest.mark.parametrize(("thickness_m", "told"), [(0.0, "it must be above"), (2.0, "geometry is 0.1 m thick there")])
@pytest.mark.parametrize("rotation", [(-(0.5**0.5), 0, 0, 0.5**0.5), (-0.5, -0.5, -0.5, 0.5)])
def test_implausible_stated_thickness_is_refused(rotation: tuple[float, ...], thickness_m: float, told: str) -> None:
    turned = {"rotation_xyzw": rotation, "position_m": [-2.5, 0, 2]}  # both turn the surface's z to the floor's y
    surface = {"pose": turned, "length_m": 5, "width_m": 4, "thickness_m": thickness_m}
    floor = {"kind": "box", "size_m": [5, 0.1, 4]}
    with pytest.raises(SceneError, match=told):
        read(row("floor", floor, surface=surface))
    assert read(row("floor", floor, surface={**surface, "thickness_m": 0.3})).object("floor").size_m == (5, 4, 0.3)


def test_plausible_thickness_can_be_stated_for_a_sheet() -> None:
    sheet = {
        "kind": "mesh",
        "vertices_m": [[0, 0, 0], [5, 0, 0], [5, 4, 0], [0, 4, 0]],
        "faces": [[0, 1, 2], [0, 2, 3]],
    }
    surface = {"pose": {}, "length_m": 5, "width_m": 4, "thickness_m": 0.15}
    assert read(row("floor", sheet, surface=surface)).object("floor").size_m == (5, 4, 0.15)
    with pytest.raises(SceneError, match=r"at most 0.5 \[m\]"):
        read(row("floor", sheet, surface={**surface, "thickness_m": 2}))
