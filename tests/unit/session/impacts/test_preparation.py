"""Scenes prepared in advance for impacts: when, and what hands feel with them."""

from __future__ import annotations

import math
import time
from concurrent.futures import Future
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from scene2hap import (
    Box,
    HapticSession,
    InfinitePlate,
    ModalPlate,
    Pose,
    SceneObject,
    SceneSnapshot,
    Touch,
    bake,
)
from scene2hap.common.deadline import Deadline
from scene2hap.propagation.coupled import impact_solution
from scene2hap.propagation.impact import burst_of
from scene2hap.propagation.plate import Plate
from scene2hap.session.impacts.felt_impacts import struck_later
from scene2hap.session.impacts.preparation import ImpactPreparation
from scenes import table_with_two_phones
from struck_table import FAR, NEAR, PHYSICAL, STRUCK, TOP_M, amplitudes, burst_at, rendered, session, touches


def test_scene_is_prepared_again_when_its_contacts_rest_and_once_a_second_while_they_change(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    now_s, ordered_s = [100.0], list[float]()
    monkeypatch.setattr(time, "monotonic", lambda: now_s[0])

    def submit(work: Any) -> Future[None]:
        ordered_s.append(now_s[0])
        done: Future[None] = Future()
        done.set_result(None)
        return done

    state: Any = SimpleNamespace(
        graph=SimpleNamespace(version=0),
        bodies={"table": None},
        touches_a_body=lambda object_id: True,
        network=lambda touched: None,
    )
    ahead = ImpactPreparation(None, state, submit)  # type: ignore[arg-type]
    for frame in range(500):  # of 10 ms
        now_s[0] = 100.0 + 0.01 * frame
        if frame == 50 or 200 <= frame < 350:
            state.graph.version += 1
        ahead.expect(("table",))
    # At once; 50 ms after the change at 0.5 s; while contacts change, a second after the last; when they rest again.
    assert ordered_s == pytest.approx([100.0, 100.55, 102.0, 103.0, 103.54], abs=0.011)


@pytest.mark.parametrize("model", [ModalPlate(), InfinitePlate()])
def test_prepared_touched_object_feels_an_impact_with_the_next_block(
    model: ModalPlate | InfinitePlate,
) -> None:
    scene, bundle = table_with_two_phones()
    made = HapticSession(scene, bundle, {"propagation": model, "gain_limit_db": None})
    for source_id in made.source_ids:
        made.set_source(source_id, on=False)
    away = {x: Pose((10.0 + i, 10.0, 10.0)) for i, x in enumerate(("phone", "alarm", "block"))}
    made.update(away, touches())
    assert made.wait_prepared(30.0)
    impact = made.strike("table", STRUCK, with_object="cup", speed_m_s=1.0)
    assert set(impact.felt) == {"left", "right"}
    burst = burst_at(made, STRUCK)
    found = amplitudes(rendered(made), burst)
    plate = made._state.bodies["table"]
    assert isinstance(plate, Plate)
    at, near, far = (np.array(made._state.on_plate("table", point)) for point in (STRUCK, NEAR, FAR))
    for k, f in enumerate(burst.frequencies_hz):
        band = np.linspace(f * 2**-0.25, f * 2**0.25, 400)
        one, other = (
            np.sqrt((np.abs(model.plate_receptance(plate, at, [to], band) * band**2) ** 2).mean()) for to in (near, far)
        )
        assert 20 * abs(math.log10(found[1, k] / found[0, k] * one / other)) < 1.0


def test_prepared_impact_equals_the_field_of_the_impact_alone() -> None:
    """The scene is a table on a block, with two phones on the table."""
    for model in PHYSICAL:
        scene, bundle = table_with_two_phones()
        made = HapticSession(scene, bundle, {"propagation": model})
        made.update(touches=touches())
        assert made.wait_prepared(60.0)
        assert made._impacts._ahead is not None
        burst, hands = burst_at(made, STRUCK), {"left": [("table", NEAR)], "right": [("table", FAR), ("table", STRUCK)]}
        f = burst.frequencies_hz
        expected = struck_later(model, made._state, "table", STRUCK, [*hands.values()], f)()
        answer = made._impacts._ahead.answer("table", STRUCK, hands, f)
        assert answer is not None
        assert list(answer.among) == ["left", "right"]
        found = answer.gains
        assert np.abs(20 * np.log10(found / expected)).max() < 0.5
        assert (found[1] > 0.999).all()  # this hand touches the struck point


@pytest.mark.filterwarnings("ignore:of 2 objects none vibrates")
def test_a_strike_on_an_upright_board_pushes_along_its_normal_alone() -> None:
    """What strikes a board aside stands on nothing, but the board does not carry its weight."""
    floor = SceneObject("ceramic floor", pose=Pose((0.0, -0.05, 0.0)), geometry=Box((2.0, 0.1, 2.0)))
    board = SceneObject("oak board", pose=Pose((0.0, 0.6, 0.0)), geometry=Box((1.0, 1.2, 0.03)))
    model = ModalPlate()
    made = HapticSession(bake(SceneSnapshot.build([floor, board])), config={"propagation": model})
    struck, hand = (0.2, 0.7, 0.015), [("oak board", (-0.2, 0.4, 0.015))]
    made.update(touches=[Touch("left", *hand[0])])
    assert made.wait_prepared(60.0)
    assert made._impacts._ahead is not None
    f = np.array([60.0, 120.0, 240.0])
    expected = struck_later(model, made._state, "oak board", struck, [hand], f)()
    answer = made._impacts._ahead.answer("oak board", struck, {"left": hand}, f)
    assert answer is not None
    assert np.abs(20 * np.log10(answer.gains / expected)).max() < 0.5


def test_last_prepared_impact_is_used_until_a_new_one_is_ready() -> None:
    made = session(propagation="modal_plate")
    made.update(touches=touches())
    assert made.wait_prepared(30.0)
    made.update({"cup": Pose((0.6, TOP_M + 0.05, 0.4))}, touches())
    first = made.strike("table", STRUCK, with_object="cup", speed_m_s=1.0)
    assert set(first.felt) == {"left", "right"}
    rendered(made, 1.0)
    assert made.wait_prepared(30.0)
    second = made.strike("table", STRUCK, with_object="cup", speed_m_s=1.0)
    assert set(second.felt) == {"left", "right"}
    assert second.felt != first.felt


@pytest.mark.parametrize("model", PHYSICAL, ids=lambda one: f"{one.kind} {'under a hand' if one.hand else ''}")
@pytest.mark.parametrize(
    ("touched", "struck"), [("cup", "table"), ("phone", "table"), ("phone", "cup"), ("table", "cup")]
)
def test_a_hand_on_another_object_feels_an_impact_with_the_next_block_as_the_model_says(
    model: Any, touched: str, struck: str
) -> None:
    """The scene is a table with a phone and a cup, which has the mass of a box."""
    scene, bundle = table_with_two_phones()
    made = HapticSession(scene, bundle, {"propagation": model, "gain_limit_db": None}, hands=("hand",))
    for source_id in made.source_ids:
        made.set_source(source_id, on=False)
    places = {"table": STRUCK, "cup": (0.6, TOP_M + 0.05, 0.4), "phone": (0.1, TOP_M + 0.005, 0.4)}
    x, y, z = places[touched]
    hand = (x + 0.02, y, z + 0.01)
    made.update({"cup": Pose(places["cup"])}, [Touch("hand", touched, hand)])
    assert made.wait_prepared(60.0)
    impact = made.strike(struck, places[struck], speed_m_s=3.0)
    assert set(impact.felt) == {"hand"}
    assert made.render(256).any()

    state = made._state
    burst = burst_of(state.bodies[struck], state.on_plate(struck, places[struck]), speed_m_s=3.0, is_finger=True)
    f, weights = burst.frequencies_hz, burst.accelerations_m_s2**2
    own = struck_later(model, state, struck, places[struck], [[(touched, hand)]], f)()
    assert made._impacts._ahead is not None
    answer = made._impacts._ahead.answer(struck, places[struck], {"left": [(touched, hand)]}, f)
    assert answer is not None
    expected, found = (float((weights * gains[0] ** 2).sum()) for gains in (own, answer.gains))
    assert abs(10 * math.log10(found / expected)) < 0.5


def test_hands_on_several_objects_feel_an_impact_at_once_and_it_counts_once() -> None:
    made = session(propagation="modal_plate")
    both = [Touch("left", "table", NEAR), Touch("right", "phone", made._state.poses["phone"].position_m)]
    made.update(touches=both)
    assert made.wait_prepared(30.0)
    impact = made.strike("table", STRUCK, with_object="cup", speed_m_s=2.0)
    assert set(impact.felt) == {"left", "right"}
    assert made.wait_prepared(30.0)
    assert made.stats.impacts_felt == 1
    assert made.impacts == (impact,)


def test_a_hand_on_two_objects_feels_the_larger_answer() -> None:
    made = session(propagation="modal_plate")
    phone = made._state.poses["phone"].position_m
    made.update(touches=[Touch("left", "table", FAR), Touch("left", "phone", phone)])
    assert made.wait_prepared(30.0)
    ahead, f = made._impacts._ahead, np.array([60.0, 150.0])
    assert ahead is not None
    answers = [
        ahead.answer("table", STRUCK, {"left": hand}, f)
        for hand in ([("table", FAR)], [("phone", phone)], [("table", FAR), ("phone", phone)])
    ]
    one, other, both = (answer.gains[0] for answer in answers if answer is not None)
    np.testing.assert_allclose(both, np.maximum(one, other))


def test_without_memory_for_a_pair_a_worker_prepares_the_impact(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(impact_solution, "MOST_HELD_BYTES", 0)
    made = session(propagation="modal_plate")
    made.update(touches=touches())
    assert made.wait_prepared(30.0)
    impact = made.strike("table", STRUCK, with_object="cup", speed_m_s=2.0)
    assert made.wait_prepared(30.0)
    assert set(impact.felt) == {"left", "right"}


def test_an_object_that_is_touched_next_is_prepared_beside_the_last_ones() -> None:
    made = session(propagation="modal_plate")
    phone = made._state.poses["phone"].position_m
    for touched, point in (("table", NEAR), ("phone", phone), ("cup", made._state.poses["cup"].position_m)):
        made.update(touches=[Touch("left", touched, point)])
        assert made.wait_prepared(30.0)
    made.update(touches=[Touch("left", "phone", phone)])
    assert made._impacts._ahead is not None
    assert made._impacts._ahead.wait(Deadline(0.0))
    assert made.strike("table", STRUCK, with_object="cup", speed_m_s=2.0).felt
