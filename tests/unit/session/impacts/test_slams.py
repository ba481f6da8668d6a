"""Doors, lids and drawers that slam, which their contacts do not show."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable

import numpy as np
import pytest
import trimesh

from scene2hap import Box, HapticSession, Impact, MuJoCoLink, Pose, SceneObject, SceneSnapshot, Touch, TriMesh, bake
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
    assert slam.meets()
    assert "tree" not in vars(shape)


# -- drawers -----------------------------------------------------------------------------------------------------------

CARCASS_M, BOARD_M = (0.5, 0.3, 0.5), 0.018


def boards(*boxes: tuple[tuple[float, float, float], tuple[float, float, float]]) -> TriMesh:
    """One mesh of boxes, each by its middle and size [m]."""
    meshes = [trimesh.creation.box(size_m, trimesh.transformations.translation_matrix(at)) for at, size_m in boxes]
    whole = trimesh.util.concatenate(meshes)
    return TriMesh(whole.vertices, whole.faces)


def chest(gap_below_m: float) -> tuple[SceneObject, SceneObject]:
    """A carcass that is open in front, and its closed drawer with a front that covers the opening."""
    w, h, d = CARCASS_M
    t = BOARD_M
    carcass = boards(
        ((0, t / 2, 0), (w, t, d)),
        ((0, h - t / 2, 0), (w, t, d)),
        ((-w / 2 + t / 2, h / 2, 0), (t, h - 2 * t, d)),
        ((w / 2 - t / 2, h / 2, 0), (t, h - 2 * t, d)),
        ((0, h / 2, -d / 2 + t / 2), (w - 2 * t, h - 2 * t, t)),
    )
    inner_w, inner_d, bottom = w - 2 * t - 0.025, d - 0.06, t + gap_below_m
    drawer = boards(
        ((0, bottom + 0.006, 0.03), (inner_w, 0.012, inner_d)),
        ((-inner_w / 2 + 0.006, bottom + 0.08, 0.03), (0.012, 0.136, inner_d)),
        ((inner_w / 2 - 0.006, bottom + 0.08, 0.03), (0.012, 0.136, inner_d)),
        ((0, h / 2, d / 2 + 0.009), (w, h, 0.018)),
    )
    pose = Pose((0.0, 0.0, 0.0))
    return SceneObject("wooden cabinet", pose=pose, geometry=carcass), SceneObject("drawer", pose=pose, geometry=drawer)


def slid(out_m: Angles, *, frames_hz: float = 90.0, gap_below_m: float = 0.012, lasts_s: float = 1.2) -> list[Impact]:
    """The impacts that a hand on the cabinet feels while its drawer is `out_m` far out by time [s]."""
    cabinet, drawer = chest(gap_below_m)
    floor = SceneObject("floor", pose=Pose((0.0, -0.05, 0.0)), geometry=Box((4.0, 0.1, 4.0)))
    scene = SceneSnapshot.build([floor, cabinet, drawer])
    session = HapticSession(scene, bake(scene))
    found: dict[Impact, None] = {}
    for frame in range(-10, round(lasts_s * frames_hz)):
        pose = Pose((0.0, 0.0, out_m(max(0.0, frame / frames_hz))))
        session.update({"drawer": pose}, [Touch("left", "wooden cabinet", (0.25, 0.2, 0.0))])
        session.render_s(1 / frames_hz)
        found |= dict.fromkeys(session.impacts)
    return [*found]


def closing(speed_m_s: float) -> Angles:
    """A drawer that is pushed shut from 30 cm."""
    return lambda time_s: max(0.0, 0.3 - speed_m_s * time_s)


@pytest.mark.parametrize("gap_below_m", [0.003, 0.05])
@pytest.mark.parametrize("frames_hz", [30, 90, 144])
@pytest.mark.parametrize("speed_m_s", [0.5, 2.0])
def test_a_drawer_that_is_pushed_shut_slams_once(speed_m_s: float, frames_hz: float, gap_below_m: float) -> None:
    (slam,) = slid(closing(speed_m_s), frames_hz=frames_hz, gap_below_m=gap_below_m)
    assert (slam.object_id, slam.with_object) == ("wooden cabinet", "drawer")
    assert slam.speed_m_s == pytest.approx(speed_m_s, rel=0.03)
    assert slam.felt["left"] > 0


def test_a_drawer_that_rebounds_slams_once() -> None:
    assert len(slid(lambda time_s: abs(0.3 - time_s) if time_s < 0.32 else 0.004)) == 1


@pytest.mark.parametrize(
    "out_m",
    [
        lambda time_s: 0.3 * (1 - ease(time_s / 0.8)),
        lambda time_s: 0.3 * ease(time_s / 0.8),
        lambda time_s: min(0.3, 1.0 * time_s),
        lambda time_s: max(0.05, 0.3 - 1.0 * time_s),
        lambda time_s: 0.001 * (1 + math.sin(2 * math.pi * 13 * time_s)),
    ],
    ids=["closed by hand", "opened by hand", "stopped when it is open", "let go before it is shut", "rattles"],
)
@pytest.mark.parametrize("frames_hz", [45, 90])
def test_a_drawer_that_meets_nothing_makes_no_impact(out_m: Angles, frames_hz: float) -> None:
    assert slid(out_m, frames_hz=frames_hz) == []


@pytest.mark.parametrize("phase", [0.0, 0.3, 0.6, 0.9])
def test_a_drawer_slams_when_it_is_shut_where_physics_is_slower_than_frames(phase: float) -> None:
    """At 50 Hz of 60 every sixth frame has no step, and the others have a step of a fiftieth of a second."""
    (slam,) = slid(lambda time_s: closing(1.0)((math.floor(50 * time_s + phase) - phase) / 50), frames_hz=60)
    assert 0.6 < slam.speed_m_s < 1.25


def box_drawer(out_m: Angles) -> list[Impact]:
    """The impacts of a drawer that is a box in a solid box, as games have them, while it is `out_m` far out."""
    floor = SceneObject("floor", pose=Pose((0.0, -0.05, 0.0)), geometry=Box((4.0, 0.1, 4.0)))
    cabinet = SceneObject("wooden cabinet", pose=Pose((0.0, 0.45, 0.0)), geometry=Box((0.6, 0.9, 0.6)))
    drawer = SceneObject("drawer", pose=Pose((0.0, 0.6, 0.0)), geometry=Box((0.58, 0.2, 0.6)))
    scene = SceneSnapshot.build([floor, cabinet, drawer])
    session = HapticSession(scene, bake(scene))
    found: dict[Impact, None] = {}
    for frame in range(-10, 90):
        pose = Pose((0.0, 0.6, out_m(max(0.0, frame / 90))))
        session.update({"drawer": pose}, [Touch("left", "wooden cabinet", (0.3, 0.6, 0.0))])
        session.render_s(1 / 90)
        found |= dict.fromkeys(session.impacts)
    return [*found]


@pytest.mark.parametrize("open_m", [0.1, 0.2])
def test_a_drawer_that_comes_out_of_a_solid_box_does_not_strike_its_front(open_m: float) -> None:
    assert box_drawer(lambda time_s: min(open_m, 0.8 * time_s)) == []


def test_a_drawer_that_is_a_box_in_a_solid_box_slams_when_it_is_shut() -> None:
    (slam,) = box_drawer(closing(0.8))
    assert (slam.object_id, slam.with_object) == ("wooden cabinet", "drawer")
    assert slam.speed_m_s == pytest.approx(0.8, rel=0.03)


def test_an_object_that_falls_inside_another_lands_on_its_bottom() -> None:
    """It goes outwards too, but not through the surface."""
    crate, _ = chest(0.012)
    box = SceneObject("box", pose=Pose((0.0, 0.25, 0.0)), geometry=Box((0.1, 0.06, 0.1)))
    scene = SceneSnapshot.build([crate, box])
    session = HapticSession(scene, bake(scene))
    for frame in range(-10, 90):
        session.update({"box": Pose((0.0, max(BOARD_M + 0.03, 0.25 - 4.9 * max(0.0, frame / 90) ** 2), 0.0))})
        session.render_s(1 / 90)
    assert session.stats.impacts == 1


def test_a_hood_that_falls_over_a_post_of_a_merged_room_lands_on_it() -> None:
    """The room's box is around it, and its rim reaches below the contact before it lands, as if it came out there."""
    walls = [((0.0, -0.05, 0.0), (4.0, 0.1, 4.0)), ((-2.0, 1.25, 0.0), (0.05, 2.5, 4.0))]
    room = SceneObject("room", geometry=boards(*walls, ((0.0, 0.25, 0.0), (0.2, 0.5, 0.2))))
    rim = [((0.0, -0.1, z), (0.4, 0.2, 0.02)) for z in (-0.19, 0.19)]
    hood = SceneObject(
        "steel hood", pose=Pose((0.0, 0.9, 0.0)), geometry=boards(((0.0, 0.3, 0.0), (0.4, 0.6, 0.4)), *rim)
    )
    scene = SceneSnapshot.build([room, hood])
    session = HapticSession(scene, bake(scene))
    for frame in range(-10, 60):
        session.update({"steel hood": Pose((0.0, max(0.5, 0.9 - 4.9 * max(0.0, frame / 90) ** 2), 0.0))})
        session.render_s(1 / 90)
    assert session.stats.impacts == 1


def test_an_object_that_is_slid_to_its_place_on_a_table_does_not_slam() -> None:
    """Nothing encloses it."""
    table = SceneObject("wooden table", pose=Pose((0.0, 0.375, 0.0)), geometry=Box((1.0, 0.75, 1.0)))
    box = SceneObject("box", pose=Pose((0.0, 0.8, 0.0)), geometry=Box((0.1, 0.1, 0.1)))
    scene = SceneSnapshot.build([table, box])
    session = HapticSession(scene, bake(scene))
    for frame in range(90):
        session.update({"box": Pose((closing(1.0)(frame / 90), 0.8, 0.0))})
        session.render_s(1 / 90)
    assert session.stats.impacts == 0


DRAWER_MJCF = """
<mujoco><worldbody>
  <body name="wooden cabinet" pos="0 0 .3">
    <geom type="box" size=".25 .25 .009" pos="0 0 -.141"/><geom type="box" size=".25 .25 .009" pos="0 0 .141"/>
    <geom type="box" size=".009 .25 .132" pos="-.241 0 0"/><geom type="box" size=".009 .25 .132" pos=".241 0 0"/>
    <geom type="box" size=".232 .009 .132" pos="0 .241 0"/>
  </body>
  <body name="drawer" pos="0 0 .3">
    <joint type="slide" axis="0 -1 0" range="0 .35" limited="true"/>
    <geom type="box" size=".218 .22 .006" pos="0 -.03 -.114"/><geom type="box" size=".25 .009 .15" pos="0 -.259 0"/>
    <geom type="box" size=".006 .22 .068" pos="-.212 -.03 -.05"/>
    <geom type="box" size=".006 .22 .068" pos=".212 -.03 -.05"/>
  </body>
</worldbody><contact><exclude body1="wooden cabinet" body2="drawer"/></contact></mujoco>
"""


@pytest.mark.parametrize("frames_hz", [30, 90])
def test_a_drawer_slams_at_the_speed_at_which_mujoco_stops_it(frames_hz: int) -> None:
    mujoco = pytest.importorskip("mujoco")
    from scene2hap.scene.engines.mujoco import snapshot

    model = mujoco.MjModel.from_xml_string(DRAWER_MJCF)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    scene = snapshot(model, data)
    session = HapticSession(scene, bake(scene))
    link = MuJoCoLink(model, data, session)
    data.qpos[0], data.qvel[0] = 0.3, -1.2
    found: dict[Impact, None] = {}
    for frame in range(frames_hz):
        while data.time < frame / frames_hz:
            mujoco.mj_step(model, data)
        link.update([Touch("left", "wooden cabinet", (0.25, 0.0, 0.4))])
        session.render_s(1 / frames_hz)
        found |= dict.fromkeys(session.impacts)
    (slam,) = found
    assert slam.with_object == "drawer"
    assert slam.speed_m_s == pytest.approx(1.2, rel=0.06)
