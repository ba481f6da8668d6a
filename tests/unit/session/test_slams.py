"""Doors and lids that slam against what a hinge holds them on, which the contact at the hinge does not show."""

from __future__ import annotations

import math
from collections.abc import Callable

import pytest

from scene2hap import Box, HapticSession, Impact, Pose, SceneObject, SceneSnapshot, Touch, bake

WIDTH_M, THICK_M = 0.6, 0.02
FRONT_M = 0.2
PIVOT_M = (0.3, 1.0, FRONT_M)

Angles = Callable[[float], float]
"""The angle of the door [rad] by time [s]; closed at 0."""


def door_pose(angle: float) -> Pose:
    """The door in front of its cabinet, turned about the upright edge at its right."""
    return Pose.from_yaw(PIVOT_M, angle).compose(Pose((-WIDTH_M / 2, 0.0, THICK_M / 2)))


def hinged(*more: SceneObject) -> HapticSession:
    floor = SceneObject("floor", pose=Pose((0.0, -0.05, 0.0)), geometry=Box((4.0, 0.1, 4.0)))
    cabinet = SceneObject("cabinet", pose=Pose((0.0, 1.0, 0.0)), geometry=Box((WIDTH_M, 2.0, 2 * FRONT_M)))
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


@pytest.mark.parametrize("frames_hz", [45, 90, 144])
@pytest.mark.parametrize("speed_rad_s", [1.5, 3.0, 6.0])
def test_a_door_that_slams_is_felt_once_where_its_edge_meets_the_cabinet(speed_rad_s: float, frames_hz: float) -> None:
    (slam,) = impacts_of(hinged(), pushed(speed_rad_s), frames_hz=frames_hz)
    assert (slam.object_id, slam.with_object) == ("cabinet", "cabinet door")
    assert slam.point_m == pytest.approx((-0.3, 1.0, FRONT_M), abs=2 * THICK_M)
    assert slam.speed_m_s == pytest.approx(speed_rad_s * WIDTH_M, rel=0.25)  # its last step may be shorter
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
