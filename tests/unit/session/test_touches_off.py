"""Touches more than 5 cm off the bounding box of their object are counted, with one warning per hand."""

import warnings

import pytest

from scene2hap import Box, HapticSession, Pose, SceneObject, SceneSnapshot, SceneWarning, Touch, bake
from scene2hap.session.likely_mistakes import LOOKED_AT

TABLE = SceneObject("table", pose=Pose((0.0, 0.7, 0.0)), geometry=Box((1.6, 0.04, 0.8)))
PHONE = SceneObject("phone", pose=Pose((0.5, 0.725, 0.2)), geometry=Box((0.08, 0.01, 0.15)))
ROOM = SceneSnapshot.build([TABLE, PHONE])


@pytest.fixture(scope="module")
def bundle() -> object:
    return bake(ROOM)


@pytest.fixture
def session(bundle: object) -> HapticSession:
    return HapticSession(bundle)


@pytest.mark.parametrize(
    ("point", "is_off"),
    [
        ((0.3, 0.72, 0.1), False),
        ((0.3, 0.769, 0.1), False),
        ((0.3, 0.7711, 0.1), True),
        ((0.3, 0.7, 0.1), False),  # inside, 2 cm from both faces
        ((0.86, 0.7, 0.1), True),  # beside the table
        ((300.0, 720.0, 100.0), True),  # given in millimetres
        ((0.3, 0.02, 0.1), True),  # given in the object's frame
    ],
)
def test_a_touch_more_than_5_cm_off_the_box_is_counted(
    session: HapticSession, point: tuple[float, float, float], is_off: bool
) -> None:
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        session.update(touches=[Touch("left", "table", point)])
    assert session.stats.touches_off_surface == is_off
    assert len(caught) == is_off
    if is_off:
        assert caught[0].category is SceneWarning
        assert caught[0].filename == __file__
        assert str(caught[0].message).startswith("hand 'left' touches 'table' at (")


def test_warning_appears_once_per_hand_and_each_touch_is_counted(session: HapticSession) -> None:
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        for k in range(10):
            point = (0.3 + 0.001 * k, 1.0, 0.1)
            session.update(touches=[Touch("left", "table", point), Touch("right", "table", point)])
    assert [str(one.message).split()[1] for one in caught] == ["'left'", "'right'"]
    assert "0.28 m off the box around it" in str(caught[0].message)
    assert session.stats.touches_off_surface == 20


@pytest.mark.filterwarnings("error::scene2hap.SceneWarning")
def test_resting_hand_on_a_leaving_object_is_detected(session: HapticSession) -> None:
    on_phone = [Touch("left", "phone", (0.5, 0.73, 0.2))]
    session.update(touches=on_phone)
    assert session.stats.touches_off_surface == 0
    with pytest.warns(SceneWarning, match="'phone'"):
        session.update({"phone": Pose((-0.5, 0.725, 0.2))}, on_phone)
    session.update(touches=[Touch("left", "phone", (-0.5, 0.73, 0.2))])
    assert session.stats.touches_off_surface == 1


def test_object_readded_with_another_shape_is_measured_again(session: HapticSession) -> None:
    touches = [Touch("left", "table", (0.3, 0.9, 0.1))]
    session.remove("table")
    session.add(SceneObject("table", pose=TABLE.pose, geometry=Box((1.6, 0.4, 0.8))))
    session.update(touches=touches)
    assert session.stats.touches_off_surface == 0
    session.remove("table")
    session.add(TABLE)
    with pytest.warns(SceneWarning, match=r"0.18 m"):
        session.update(touches=touches)


def test_slow_motion_off_the_box_is_detected_at_5_cm(session: HapticSession) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        for k in range(LOOKED_AT):
            session.update(touches=[Touch("left", "table", (0.3, 0.7625 + 0.001 * k, 0.1))])
    assert session.stats.touches_off_surface == LOOKED_AT - 8  # 50.5 mm and more


def test_one_update_in_16_is_checked_after_the_first_16(session: HapticSession) -> None:
    on, off = ([Touch("left", "table", (0.3, height, 0.1))] for height in (0.72, 1.0))
    for _ in range(LOOKED_AT):
        session.update(touches=on)
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        for _ in range(10 * LOOKED_AT):
            session.update(touches=off)
    assert len(caught) == 1
    assert session.stats.touches_off_surface == 10


@pytest.mark.parametrize(("height_m", "is_off"), [(0.72, False), (0.769, False), (0.7711, True), (720.0, True)])
def test_a_strike_more_than_5_cm_off_the_box_warns_once(session: HapticSession, height_m: float, is_off: bool) -> None:
    session.update(touches=[Touch("left", "table", (0.3, 0.72, 0.1))])
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        session.strike("table", (0.3, height_m, 0.1))
        session.strike("table", (0.3, height_m, 0.1))
    assert len(caught) == is_off
    if is_off:
        assert caught[0].category is SceneWarning
        assert caught[0].filename == __file__
        assert str(caught[0].message).startswith(f"a strike of 'table' at (0.3, {height_m:g}, 0.1), ")


def test_a_point_of_would_feel_is_named_once_and_not_counted(session: HapticSession) -> None:
    near, far = Touch("left", "table", (0.3, 0.72, 0.1)), Touch("left", "table", (300.0, 720.0, 100.0))
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        session.would_feel([near])
        assert not caught
        session.would_feel([near, far])
        session.would_feel([far])
    assert [one.filename for one in caught] == [__file__]
    assert str(caught[0].message).startswith("would_feel is given 'table' at (300, 720, 100), 785 m off the box")
    assert session.stats.touches_off_surface == 0
