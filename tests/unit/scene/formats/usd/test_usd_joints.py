"""Joints of USD stages as hinges; skipped where usd-core is not installed."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from scene2hap.errors import SceneFormatError
from scene2hap.scene.load import load_scene
from scene2hap.scene.snapshot import SceneSnapshot
from usd_writing import CUBE_POINTS, mesh, new_stage, scene_of, usd

Point = tuple[float, float, float]


def body(stage: Any, path: str, at: Point, *, is_drawn: bool = True) -> Any:
    """A rigid body, by default with a cube of edge 1 around its origin."""
    xform = usd("UsdGeom").Xform.Define(stage, path)
    xform.AddTranslateOp().Set(at)
    usd("UsdPhysics").RigidBodyAPI.Apply(xform.GetPrim())
    if is_drawn:
        mesh(stage, f"{path}/visuals", np.subtract(CUBE_POINTS, 0.5))
    return xform


def joint(stage: Any, kind: str, on: str, held: str, at: Point = (0, 0, 0), axis: str = "") -> Any:
    """A joint of a kind ("Revolute") at a point of the prim `on`, "" for the world."""
    path = f"/joints/{kind}_{on.replace('/', '_')}_{held.replace('/', '_')}_{axis}"
    made = getattr(usd("UsdPhysics"), f"{kind}Joint").Define(stage, path)
    for relation, target in ((made.CreateBody0Rel(), on), (made.CreateBody1Rel(), held)):
        if target:
            relation.SetTargets([target])
    made.CreateLocalPos0Attr(at)
    if axis:
        made.CreateAxisAttr(axis)
    return made


def hinges(scene: SceneSnapshot) -> dict[str, str]:
    return {item.id: item.hinge.to for item in scene.objects if item.hinge is not None}


def arm(stage: Any) -> None:
    """A base that stands, a cart that slides on it, and a row of links along x on the cart."""
    for x, name in enumerate(("base", "cart", "elbow", "hand", "tool")):
        body(stage, f"/robot/{name}", (float(x), 0.0, 0.0))
    joint(stage, "Fixed", "", "/robot/base")
    joint(stage, "Prismatic", "/robot/base", "/robot/cart", (0.5, 0, 0))
    joint(stage, "Revolute", "/robot/cart", "/robot/elbow", (0.5, 0.0, 0.3), "Z")
    joint(stage, "Spherical", "/robot/elbow", "/robot/hand", (0.5, 0.2, 0.1))
    joint(stage, "Fixed", "/robot/hand", "/robot/tool")


def test_bodies_that_turn_on_others_or_are_fixed_to_them_have_hinges(tmp_path: Path) -> None:
    scene = scene_of(arm, tmp_path)
    assert hinges(scene) == {"elbow": "cart", "hand": "elbow", "tool": "hand"}
    held = {item.id: item.hinge for item in scene.objects if item.hinge is not None}
    # The middle of the axis along which both extend; a ball keeps its point; a weld is in the middle of what is common.
    assert held["elbow"].point_m == pytest.approx((-0.5, 0.0, 0.0), abs=1e-6)
    assert held["elbow"].other_point_m == pytest.approx((0.5, 0.0, 0.0), abs=1e-6)
    assert held["hand"].point_m == pytest.approx((-0.5, 0.2, 0.1), abs=1e-6)
    assert held["tool"].point_m == pytest.approx((-0.5, 0.0, 0.0), abs=1e-6)


def test_a_hinge_does_not_depend_on_where_the_robot_is(tmp_path: Path) -> None:
    def moved(stage: Any) -> None:
        robot = usd("UsdGeom").Xform.Define(stage, "/robot")
        robot.AddTranslateOp().Set((5.0, 1.0, 0.0))
        robot.AddRotateXYZOp().Set((0.0, 0.0, 90.0))
        arm(stage)

    here, there = scene_of(arm, tmp_path), scene_of(moved, tmp_path)
    for name in ("elbow", "hand", "tool"):
        one, other = here.object(name).hinge, there.object(name).hinge
        assert one is not None
        assert other is not None
        assert other.point_m == pytest.approx(one.point_m, abs=1e-6)
        assert other.other_point_m == pytest.approx(one.other_point_m, abs=1e-6)


def test_hinges_come_from_the_child_process(tmp_path: Path, child: None) -> None:
    stage = new_stage(tmp_path / "arm.usdc")
    arm(stage)
    stage.Save()
    assert len(hinges(load_scene(tmp_path / "arm.usdc"))) == 3


def test_what_does_not_move_holds_only_what_turns_on_it(tmp_path: Path) -> None:
    def fill(stage: Any) -> None:
        for name in ("cabinet", "door", "shelf", "lid", "swing"):
            body(stage, f"/{name}", (0.0, 0.0, 0.0))
        mesh(stage, "/wall")
        joint(stage, "Fixed", "", "/cabinet")
        joint(stage, "Fixed", "/cabinet", "/shelf")
        joint(stage, "Revolute", "/cabinet", "/door", axis="Z")
        joint(stage, "Revolute", "/shelf", "/lid", axis="Z")
        joint(stage, "Revolute", "/wall", "/swing", axis="Z")  # a wall is no rigid body

    assert hinges(scene_of(fill, tmp_path)) == {"door": "cabinet", "lid": "shelf"}


def test_disabled_joints_and_bodies_hold_nothing(tmp_path: Path) -> None:
    def fill(stage: Any) -> None:
        for name in ("a", "b", "c", "d"):
            body(stage, f"/{name}", (0.0, 0.0, 0.0))
        joint(stage, "Revolute", "/a", "/b", axis="Z").CreateJointEnabledAttr(False)
        joint(stage, "Revolute", "/c", "/d", axis="Z")
        usd("UsdPhysics").RigidBodyAPI(stage.GetPrimAtPath("/c")).CreateRigidBodyEnabledAttr(False)

    assert hinges(scene_of(fill, tmp_path)) == {}


def test_points_and_axes_are_in_the_frame_of_the_first_body(tmp_path: Path) -> None:
    """A base that is turned and scaled, a stage in centimetres, and a joint that is turned once more."""

    def fill(stage: Any) -> None:
        base = body(stage, "/world/base", (100.0, 0.0, 0.0))
        base.AddRotateXYZOp().Set((0.0, 0.0, 90.0))  # its x is the world's y
        base.AddScaleOp().Set((100.0, 100.0, 100.0))
        door = body(stage, "/world/door", (100.0, 100.0, 20.0))
        door.AddScaleOp().Set((100.0, 100.0, 100.0))
        made = joint(stage, "Revolute", "/world/base/visuals", "/world/door", (0.5, -0.1, 0.2), "X")
        # The joint's x is the base's z.
        made.CreateLocalRot0Attr(usd("Gf").Quatf(np.sqrt(0.5), 0.0, -np.sqrt(0.5), 0.0))

    scene = scene_of(fill, tmp_path, unit_m=0.01)
    door, base = scene.object("door"), scene.object("base")
    assert door.hinge is not None
    # The base extends along z to 0.5 m, and the door from -0.3 m to 0.7 m.
    at = door.pose.to_world([door.hinge.point_m])[0]
    np.testing.assert_allclose(at, (1.1, 0.5, 0.1), atol=1e-6)
    np.testing.assert_allclose(base.pose.to_world([door.hinge.other_point_m])[0], at, atol=1e-6)


def test_equal_names_in_several_robots_are_told_apart(tmp_path: Path) -> None:
    def fill(stage: Any) -> None:
        for row, robot in enumerate(("a", "b")):
            for x, name in enumerate(("base", "arm")):
                body(stage, f"/{robot}/{name}", (float(x), 3.0 * row, 0.0))
            joint(stage, "Revolute", f"/{robot}/base", f"/{robot}/arm", (0.5, 0, 0), "Z")

    assert hinges(scene_of(fill, tmp_path)) == {"arm": "base", "arm#2": "base#2"}


def test_a_body_without_geometry_passes_on_what_it_is_fixed_to(tmp_path: Path) -> None:
    def fill(stage: Any) -> None:
        body(stage, "/a", (0.0, 0.0, 0.0))
        body(stage, "/frame", (0.5, 0.0, 0.0), is_drawn=False)
        body(stage, "/b", (1.0, 0.0, 0.0))
        joint(stage, "Fixed", "/a", "/frame")
        joint(stage, "Revolute", "/frame", "/b", axis="Z")

    assert hinges(scene_of(fill, tmp_path)) == {"b": "a"}


def test_joints_in_the_other_order_and_loops_make_one_chain(tmp_path: Path) -> None:
    def fill(stage: Any) -> None:
        for x, name in enumerate("abcd"):
            body(stage, f"/{name}", (0.1 * x, 0.0, 0.0))
        joint(stage, "Revolute", "/b", "/a", axis="Z")
        joint(stage, "Revolute", "/c", "/a", axis="Z")
        joint(stage, "Revolute", "/c", "/d", axis="Z")
        joint(stage, "Revolute", "/b", "/d", axis="Z").CreateExcludeFromArticulationAttr(True)

    assert hinges(scene_of(fill, tmp_path)) == {"a": "b", "c": "a", "d": "c"}


def test_several_joints_of_one_pair_are_a_ball(tmp_path: Path) -> None:
    def fill(stage: Any) -> None:
        body(stage, "/pelvis", (0.0, 0.0, 0.0))
        body(stage, "/thigh", (1.0, 0.0, 0.0))
        for axis in "XYZ":
            joint(stage, "Revolute", "/pelvis", "/thigh", (0.5, 0.2, 0.3), axis)

    hinge = scene_of(fill, tmp_path).object("thigh").hinge
    assert hinge is not None
    assert hinge.point_m == pytest.approx((-0.5, 0.2, 0.3), abs=1e-6)


@pytest.mark.parametrize(("locked", "held"), [("transX transY transZ", True), ("transX transY", False), ("", False)])
def test_general_joints_hold_if_they_lock_all_translations(tmp_path: Path, locked: str, held: bool) -> None:
    def fill(stage: Any) -> None:
        body(stage, "/pelvis", (0.0, 0.0, 0.0))
        body(stage, "/thigh", (1.0, 0.0, 0.0))
        made = usd("UsdPhysics").Joint.Define(stage, "/hip")
        made.CreateBody0Rel().SetTargets(["/pelvis"])
        made.CreateBody1Rel().SetTargets(["/thigh"])
        made.CreateLocalPos0Attr((0.5, 0.2, 0.0))
        for name in locked.split():
            limit = usd("UsdPhysics").LimitAPI.Apply(made.GetPrim(), name)
            limit.CreateLowAttr(1.0)
            limit.CreateHighAttr(-1.0)

    assert hinges(scene_of(fill, tmp_path)) == ({"thigh": "pelvis"} if held else {})


@pytest.mark.parametrize(
    ("at", "axis", "why"),
    [
        ((0.0, 0.0, 0.0), "W", "turns about the axis 'W'; it must be X, Y or Z"),
        ((np.nan, 0.0, 0.0), "X", r"is at \[nan.*; every coordinate must be finite"),
    ],
)
def test_broken_joints_are_refused(tmp_path: Path, at: Point, axis: str, why: str) -> None:
    def fill(stage: Any) -> None:
        body(stage, "/a", (0.0, 0.0, 0.0))
        body(stage, "/b", (0.5, 0.0, 0.0))
        joint(stage, "Revolute", "/a", "/b", at, axis)

    with pytest.raises(SceneFormatError, match=why):
        scene_of(fill, tmp_path)


def test_missing_prims_rings_and_flat_bodies_do_no_harm(tmp_path: Path) -> None:
    def fill(stage: Any) -> None:
        for name in "abcde":
            made = body(stage, f"/{name}", (0.0, 0.0, 0.0))
        made.AddScaleOp().Set((0.0, 1.0, 1.0))
        joint(stage, "Revolute", "/a/nothing", "/b", axis="X")
        joint(stage, "Revolute", "/b", "/b", axis="X")
        joint(stage, "Fixed", "/c", "/d")
        joint(stage, "Fixed", "/d", "/c")
        joint(stage, "Revolute", "/e", "/d", axis="X")

    assert hinges(scene_of(fill, tmp_path)) == {"d": "c", "e": "d"}
