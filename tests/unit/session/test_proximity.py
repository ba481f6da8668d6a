"""Touches of tracked points: which objects they touch, and where."""

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from scene2hap import HapticBundle, HapticSession, Pose, SceneObject, SceneWarning, Touch, TriMesh, bake
from scene2hap.errors import SceneError, SessionError, UnknownObject
from scene2hap.scene.objects import Contact
from scenes import box, haptics, scene, tone_loop

TOP_M = 0.72


def session(*more: SceneObject, **settings: Any) -> HapticSession:
    """A table of 0.8 x 0.6 m whose top face is `TOP_M` high, and a phone of 8 mm on it."""
    table = box("table", (0.8, 0.04, 0.6), (0.0, TOP_M - 0.02, 0.0))
    phone = box("phone", (0.15, 0.008, 0.07), (0.2, TOP_M + 0.004, 0.0))
    objects = {"table": haptics("oak", (0.8, 0.6, 0.04)), "phone": haptics("glass", (0.15, 0.07, 0.008), "ring")}
    room = replace(scene(table, phone, *more), **settings)
    return HapticSession(room, HapticBundle(room, "room", objects, {"phone": {"ring": tone_loop(150)}}))


def touched(found: list[Touch]) -> set[str]:
    return {touch.object_id for touch in found}


@pytest.mark.parametrize(
    ("height_m", "touches"),
    [(0.02, False), (0.011, False), (0.009, True), (0.0, True), (-0.015, True), (-0.055, False)],
)
def test_a_point_touches_from_a_centimetre_above_the_top(height_m: float, touches: bool) -> None:
    found = session().touches_at({"left": (-0.2, TOP_M + height_m, 0.1)})
    assert touched(found) == ({"table"} if touches else set())
    if touches and height_m > -0.02:
        assert found[0].hand == "left"
        assert found[0].point_m == pytest.approx((-0.2, TOP_M, 0.1))


def test_depth_and_distance_are_settings() -> None:
    s, above, inside = session(), {"left": (-0.2, TOP_M + 0.04, 0.1)}, {"left": (-0.2, TOP_M - 0.015, 0.1)}
    assert touched(s.touches_at(above, within_m=0.05)) == {"table"}
    assert not s.touches_at(above, within_m=0.03, depth_m=0.2)
    assert not s.touches_at(inside, depth_m=0.01)
    assert not s.touches_at(inside, within_m=0.2, depth_m=0.0)


def test_a_point_touches_every_object_near_it_and_a_hand_may_have_many_points() -> None:
    tips = [(0.2, TOP_M + 0.009, 0.0), (-0.3, TOP_M, 0.2), (0.0, 1.5, 0.0)]
    found = session().touches_at({"right": tips, "left": None})
    assert [(touch.hand, touch.object_id) for touch in found] == [
        ("right", "table"),
        ("right", "phone"),
        ("right", "table"),
    ]
    on_edge = session().touches_at({"left": (0.275, TOP_M, 0.0)})  # where the phone's side meets the table
    assert touched(on_edge) == {"phone", "table"}


def test_touches_follow_moves_additions_and_removals() -> None:
    s, tip = session(), {"left": (0.2, 1.108, 0.0)}
    raised = {"phone": Pose((0.2, 1.1, 0.0))}
    assert not s.touches_at(tip)
    assert touched(s.touches_at(tip, raised)) == {"phone"}
    assert not s.touches_at(tip)  # a pose that is only given moves nothing
    s.update(raised)
    assert touched(s.touches_at(tip)) == {"phone"}
    s.add(box("lamp", (0.1, 0.1, 0.1), (0.2, 1.16, 0.0)))
    assert touched(s.touches_at(tip)) == {"phone", "lamp"}
    s.remove("phone")
    assert touched(s.touches_at(tip)) == {"lamp"}


@pytest.mark.parametrize("limit_m", [0.01, -0.03])
def test_a_finger_that_trembles_at_the_limit_touches_without_a_break(limit_m: float) -> None:
    """Noise of 1 mm, as of a tracker. In a block of 20 cm, whose other faces are farther away."""
    s, noise = session(box("block", (0.4, 0.2, 0.4), (0.0, 2.0, 0.0))), np.random.default_rng(1)
    touching = []
    for distance_m in limit_m + noise.normal(0.0, 1e-3, 300):
        found = s.touches_at({"left": (0.0, 2.1 + distance_m, 0.0)})
        s.update(touches=found)
        touching.append(bool(found))
    assert touching == sorted(touching)  # none, then always
    assert touching.index(True) < 10


def test_a_touch_ends_at_one_and_a_half_times_the_distance_at_which_it_begins() -> None:
    s = session()

    def touches_at(height_m: float, hand: str = "left") -> bool:
        return bool(s.touches_at({hand: (-0.2, TOP_M + height_m, 0.1)}, within_m=0.02))

    assert not touches_at(0.021)
    s.update(touches=[Touch("left", "table", (-0.2, TOP_M, 0.1))])
    assert touches_at(0.021)
    assert touches_at(0.0299)
    assert touches_at(0.0299)  # as often as it is called
    assert not touches_at(0.0301)
    assert not touches_at(0.021, "right")
    over_phone = {"left": (0.2, TOP_M + 0.008 + 0.021, 0.0)}
    assert touched(s.touches_at(over_phone, within_m=0.02)) == {"table"}
    s.update()
    assert not touches_at(0.021)


def test_a_touched_object_that_is_removed_is_not_touched() -> None:
    s, tip = session(), {"left": (0.2, TOP_M + 0.012, 0.0)}
    s.update(touches=s.touches_at(tip))
    s.remove("phone")
    assert not s.touches_at(tip)


def test_a_rotated_object_is_touched_where_it_is() -> None:
    s = session()
    turned = Pose((0.0, 2.0, 0.0), (0.0, 0.0, math.sin(math.pi / 4), math.cos(math.pi / 4)))  # the table on its edge
    found = s.touches_at({"left": (0.025, 2.3, 0.1)}, {"table": turned})
    assert touched(found) == {"table"}
    assert found[0].point_m == pytest.approx((0.02, 2.3, 0.1))


def test_the_touches_are_felt() -> None:
    s = session()
    frame = s.update(touches=s.touches_at({"left": (0.2, TOP_M + 0.009, 0.0), "right": (-0.3, TOP_M, 0.0)}))
    assert frame.gain("left", "phone") == 1.0
    assert 0.0 < frame.gain("right", "phone") < 1.0
    assert s.explain("right").touches == ("table",)


def test_a_mesh_gives_the_same_touches_before_and_after_it_is_prepared() -> None:
    corners = np.random.default_rng(3).normal(size=(300, 3))
    corners *= 0.2 / np.linalg.norm(corners, axis=1)[:, None]
    faces = np.random.default_rng(4).integers(0, 300, (400, 3))
    ball = SceneObject("ball", geometry=TriMesh(corners, faces[(np.diff(np.sort(faces), axis=1) > 0).all(axis=1)]))
    tips = {"left": np.random.default_rng(5).uniform(-0.25, 0.25, (100, 3))}
    s = session(ball, contacts=(Contact("phone", "table", (0.2, TOP_M, 0.0)),))
    before = s.touches_at(tips)
    s._proximity._shapes[2].prepare()
    assert touched(before) == {"ball"}
    assert s.touches_at(tips) == before


def test_no_points_no_touches() -> None:
    s = session()
    assert s.touches_at({}) == []
    assert s.touches_at({"left": np.empty((0, 3)), "right": None}) == []
    assert s.touches_at({"left": []}) == []


@pytest.mark.parametrize(
    ("points", "settings", "message"),
    [
        ({"third": (0.0, 0.0, 0.0)}, {}, "no hand 'third'"),
        ([(0.0, 0.0, 0.0)], {}, "mapping of hands to points"),
        ({"left": (0.0, 0.0)}, {}, r"points_m\['left'\] has shape \(2,\)"),
        ({"left": np.zeros((2, 2, 3))}, {}, r"shape \(2, 2, 3\)"),
        ({"left": np.zeros((1025, 3))}, {}, "n <= 1024"),
        ({"left": (0.0, math.nan, 0.0)}, {}, "not finite"),
        ({"left": "near the phone"}, {}, "not a table of numbers"),
        ({"left": (0.0, 0.0, 0.0)}, {"within_m": -0.01}, "within_m is -0.01 m"),
        ({"left": (0.0, 0.0, 0.0)}, {"depth_m": 30.0}, "depth_m is 30 m"),
    ],
)
def test_errors_name_the_value(points: Any, settings: dict[str, Any], message: str) -> None:
    with pytest.raises(SessionError, match=message):
        session().touches_at(points, **settings)


def test_moved_objects_need_poses() -> None:
    with pytest.raises(SceneError, match="it must be a Pose"):
        session().touches_at({"left": (0.0, 0.0, 0.0)}, {"phone": (0.0, 1.0, 0.0)})  # type: ignore[dict-item]
    with pytest.raises(SessionError, match="moved is a list; it must be a mapping"):
        session().touches_at({"left": (0.0, 0.0, 0.0)}, [("phone", Pose())])  # type: ignore[arg-type]
    with pytest.raises(UnknownObject, match="fone"):
        session().touches_at({"left": (0.0, 0.0, 0.0)}, {"fone": Pose()})


def test_a_single_object_is_touched() -> None:
    alone = scene(box("cube", (0.1, 0.1, 0.1), (0.0, 0.0, 0.0)))
    with pytest.warns(SceneWarning, match="nothing will be felt"):
        s = HapticSession(alone, bake(alone))
    (touch,) = s.touches_at({"left": (0.0, 0.0, 0.045)})
    assert (touch.object_id, touch.point_m) == ("cube", pytest.approx((0.0, 0.0, 0.05)))
