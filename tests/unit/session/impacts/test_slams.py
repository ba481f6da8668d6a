"""Doors and lids that slam against what a hinge holds them on, which the contact at the hinge does not show."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable

import numpy as np
import pytest
import trimesh

from scene2hap import Box, HapticSession, Impact, Pose, SceneObject, SceneSnapshot, Touch, TriMesh, bake
from scene2hap.contact.shape import shape_of
from scene2hap.session.impacts.slams import slam_of

WIDTH_M, THICK_M = 0.6, 0.02
FRONT_M = 0.2
PIVOT_M = (0.3, 1.0, FRONT_M)

Angles = Callable[[float], float]
"""The angle of the door [rad] by time [s]; closed at 0."""


def door_pose(angle: float) -> Pose:
    """The door in front of its cabinet, turned about the upright edge at its right."""
    return Pose.from_yaw(PIVOT_M, angle).compose(Pose((-WIDTH_M / 2, 0.0, THICK_M / 2)))


CABINET = SceneObject("cabinet", pose=Pose((0.0, 1.0, 0.0)), geometry=Box((WIDTH_M, 2.0, 2 * FRONT_M)))


def hinged(*more: SceneObject, cabinet: SceneObject = CABINET) -> HapticSession:
    floor = SceneObject("floor", pose=Pose((0.0, -0.05, 0.0)), geometry=Box((4.0, 0.1, 4.0)))
    door = SceneObject("cabinet door", pose=door_pose(0.0), geometry=Box((WIDTH_M, 1.9, THICK_M)))
    scene = SceneSnapshot.build([floor, cabinet, door.hinged_on(cabinet, PIVOT_M), *more])
    return HapticSession(scene, bake(scene))


def impacts_of(
    session: HapticSession, angles: Angles, *, touched: str = "cabinet", frames_hz: float = 90.0, lasts_s: float = 1.5
) -> list[Impact]:
    """The impacts that a hand feels while the door moves."""
    touches = [Touch("left", touched, (-0.28, 1.5, FRONT_M))]
    found = dict.fromkeys(session.impacts)
    for frame in range(round(lasts_s * frames_hz)):
        session.update({"cabinet door": door_pose(angles(frame / frames_hz))}, touches)
        session.render_s(1 / frames_hz)
        found |= dict.fromkeys(session.impacts)
    return [*found]


def pushed(speed_rad_s: float) -> Angles:
    """A door that a push closes from a right angle."""
    return lambda time_s: max(0.0, math.pi / 2 - speed_rad_s * time_s)


@pytest.mark.parametrize("frames_hz", [30, 45, 90, 144])
@pytest.mark.parametrize("speed_rad_s", [1.5, 3.0, 6.0])
def test_a_door_that_slams_is_felt_once_where_its_edge_meets_the_cabinet(speed_rad_s: float, frames_hz: float) -> None:
    (slam,) = impacts_of(hinged(), pushed(speed_rad_s), frames_hz=frames_hz)
    assert (slam.object_id, slam.with_object) == ("cabinet", "cabinet door")
    assert slam.point_m == pytest.approx((-0.3, 1.0, FRONT_M), abs=2 * THICK_M)
    assert slam.speed_m_s == pytest.approx(speed_rad_s * WIDTH_M, rel=0.03)
    assert slam.felt["left"] > 0


def test_a_door_that_bounces_slams_once() -> None:
    (slam,) = impacts_of(hinged(), lambda time_s: abs(math.pi / 2 - 3 * time_s) if time_s < 0.6 else 0.23)
    assert slam.with_object == "cabinet door"


def ease(share: float) -> float:
    """A movement of a hand from rest to rest."""
    return (1 - math.cos(math.pi * min(1.0, max(0.0, share)))) / 2


SOFT: dict[str, Angles] = {
    "closed by hand": lambda time_s: math.pi / 2 * (1 - ease(time_s / 1.2)),
    "opened by hand": lambda time_s: math.pi / 2 * ease(time_s / 1.2),
    "stopped when it is open": lambda time_s: min(1.4, 2.0 * time_s),
    "pushed to and fro while it is open": lambda time_s: 1.0 + 0.1 * math.sin(2 * math.pi * 2 * time_s),
    "rattles": lambda time_s: 0.002 * (1 + math.sin(2 * math.pi * 13 * time_s)),
    "at rest": lambda time_s: 0.0,
}


@pytest.mark.parametrize("name", SOFT)
@pytest.mark.parametrize("frames_hz", [45, 90])
def test_a_door_that_meets_nothing_makes_no_impact(name: str, frames_hz: float) -> None:
    session = hinged()
    impacts_of(session, lambda _: SOFT[name](0.0), lasts_s=0.3)
    assert impacts_of(session, SOFT[name], frames_hz=frames_hz) == []


@pytest.mark.parametrize(("angles", "n_slams"), [(pushed(3.0), 1), (lambda time_s: 0.0, 0)])
def test_only_motion_against_the_cabinet_counts_aboard_a_lorry(angles: Angles, n_slams: int) -> None:
    session = hinged()
    parked = {item.id: item.pose for item in session.snapshot.objects}
    for frame in range(135):
        lorry = Pose((10.0 * frame / 90, 0.0, 0.0))
        here = {**parked, "cabinet door": door_pose(angles(frame / 90))}
        point = lorry.to_world([(0.0, 1.5, FRONT_M)])[0].tolist()
        session.update({x: lorry.compose(pose) for x, pose in here.items()}, [Touch("left", "cabinet", point)])
        session.render_s(1 / 90)
    assert session.stats.impacts == n_slams


def test_a_door_that_was_taken_off_does_not_slam() -> None:
    """It is held beside the cabinet, 2 cm off its hinge, and turns as before."""
    session = hinged()
    off = Pose((0.0, 0.0, 0.02))
    for frame in range(90):
        session.update({"cabinet door": off.compose(door_pose(pushed(3.0)(frame / 90)))})
        session.render_s(1 / 90)
    assert session.stats.impacts == 0


def test_a_door_strikes_a_seal_before_its_cabinet() -> None:
    """The contact with the seal shows where the two meet, that at the hinge does not."""
    seal = SceneObject("wooden frame", pose=Pose((-0.28, 1.0, FRONT_M + 0.005)), geometry=Box((0.04, 1.8, 0.01)))
    closed = math.asin(0.01 / (WIDTH_M - 0.04))
    (slam,) = impacts_of(hinged(seal), lambda time_s: max(closed, pushed(3.0)(time_s)), touched="wooden frame")
    assert slam.object_id == "wooden frame"


def turned_mesh(size_m: tuple[float, float, float], angle: float) -> TriMesh:
    """A box whose own frame is turned against its sides, as meshes in the coordinates of a room are."""
    mesh = Box(size_m).mesh
    return TriMesh(Pose.from_yaw((0.0, 0.0, 0.0), angle).to_world(mesh.vertices_m), mesh.faces)


@pytest.mark.parametrize(("angles", "n_slams"), [(pushed(3.0), 1), (SOFT["stopped when it is open"], 0)])
@pytest.mark.parametrize("axis_deg", [0, 45])
def test_a_cabinet_counts_by_its_shape_and_not_by_the_box_around_it(
    angles: Angles, n_slams: int, axis_deg: float
) -> None:
    """A canopy reaches as far to the front as the open door: the box around both is no cabinet."""
    turn = math.radians(axis_deg)
    cabinet = turned_mesh((WIDTH_M, 2.0, 2 * FRONT_M), turn)
    shelf = Pose.from_yaw((0.0, 0.0, 0.0), turn).to_world(
        Box((WIDTH_M, 0.05, 1.4)).mesh.vertices_m + np.array([0.0, 1.1, 0.5])
    )
    faces = np.concatenate([cabinet.faces, Box((1, 1, 1)).mesh.faces + len(cabinet.vertices_m)])
    mesh = TriMesh(np.concatenate([cabinet.vertices_m, shelf]), faces)
    session = hinged(cabinet=SceneObject("cabinet", pose=Pose.from_yaw((0.0, 1.0, 0.0), -turn), geometry=mesh))
    impacts_of(session, angles)
    assert session.stats.impacts == n_slams


def test_the_links_of_a_robot_that_stop_strike_nothing() -> None:
    """Thick links lie close to each other, and every joint of a position-controlled arm stops within a frame."""
    base = SceneObject("robot base", pose=Pose((0.0, 0.1, 0.0)), geometry=Box((0.2, 0.2, 0.2)))
    links = [SceneObject(f"link {k}", geometry=Box((0.12, 0.3, 0.12))) for k in range(3)]

    def poses(angle: float) -> dict[str, Pose]:
        found, end = {}, Pose((0.0, 0.2, 0.0))
        for link in links:
            joint = end.compose(Pose.from_euler((0.0, 0.0, 0.0), (angle, 0.0, 0.0)))
            found[link.id], end = joint.compose(Pose((0.0, 0.12, 0.0))), joint.compose(Pose((0.0, 0.24, 0.0)))
        return found

    joints_m = [(0.0, 0.2 + 0.24 * k, 0.0) for k in range(3)]
    posed = [dataclasses.replace(link, pose=poses(0.0)[link.id]) for link in links]
    before = [base, *posed]
    arm = [link.hinged_on(on, point) for link, on, point in zip(posed, before, joints_m, strict=False)]
    scene = SceneSnapshot.build([base, *arm])
    session = HapticSession(scene, bake(scene))
    angle = 0.0
    for k, goal in enumerate([0.9, 0.2, 1.2, 0.0, -1.0, 0.5, -0.3, 1.1]):
        start = angle
        for frame in range(36):
            angle = start + (goal - start) * min(1.0, frame / (20 + k))
            session.update(poses(angle), [Touch("left", "robot base", (0.0, 0.1, 0.1))])
            session.render_s(1 / 90)
    assert session.stats.impacts == 0


def test_a_door_slams_at_the_middle_of_its_edge_also_if_its_hinge_is_given_at_the_bottom() -> None:
    door = SceneObject("cabinet door", pose=door_pose(0.0), geometry=Box((WIDTH_M, 1.9, THICK_M)))
    scene = SceneSnapshot.build([CABINET, door.hinged_on(CABINET, (PIVOT_M[0], 0.1, FRONT_M))])
    (slam,) = impacts_of(HapticSession(scene, bake(scene)), pushed(3.0))
    assert slam.point_m == pytest.approx((-0.3, 1.0, FRONT_M), abs=2 * THICK_M)
    assert slam.speed_m_s == pytest.approx(3.0 * WIDTH_M, rel=0.03)


def test_the_door_of_a_cabinet_that_a_hinge_holds_on_the_wall_slams() -> None:
    wall = SceneObject("wall", pose=Pose((0.0, 1.25, -0.25)), geometry=Box((3.0, 2.5, 0.1)))
    door = SceneObject("cabinet door", pose=door_pose(0.0), geometry=Box((WIDTH_M, 1.9, THICK_M)))
    cabinet = CABINET.hinged_on(wall, (0.0, 1.5, -0.2))
    scene = SceneSnapshot.build([wall, cabinet, door.hinged_on(cabinet, PIVOT_M)])
    (slam,) = impacts_of(HapticSession(scene, bake(scene)), pushed(3.0))
    assert slam.object_id == "cabinet"


def test_a_slam_on_a_detailed_mesh_builds_no_search_tree_of_it() -> None:
    """That of 3,072 triangles takes longer than a frame, and none is prepared with contacts of an engine."""
    fine = trimesh.creation.box((WIDTH_M, 2.0, 2 * FRONT_M)).subdivide().subdivide().subdivide().subdivide()
    mesh = TriMesh(fine.vertices, fine.faces)
    cabinet = dataclasses.replace(CABINET, geometry=mesh)
    door = SceneObject("cabinet door", pose=door_pose(0.0), geometry=Box((WIDTH_M, 1.9, THICK_M)))
    way = [(door_pose(angle), cabinet.pose) for angle in (0.5, 0.1, 0.03)]
    shape = shape_of(mesh)
    hinged_door = door.hinged_on(cabinet, PIVOT_M)
    assert hinged_door.hinge is not None
    slam = slam_of(hinged_door, hinged_door.hinge, cabinet, way)
    assert slam is not None
    assert slam.meets
    assert "tree" not in vars(shape)
