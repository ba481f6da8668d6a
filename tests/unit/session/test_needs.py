"""Sources that need contact: a pan that needs a stove, on objects of different categories."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from scene2hap import HapticBundle, HapticSession, Pose, SceneSnapshot, Touch
from scenes import box, haptics, scene, tone_loop

ON_PAN = [Touch("left", "pan", (0.0, 0.93, 0.0))]


def kitchen(category: str, needs: str | None, *, hob_is_source: bool = False) -> HapticSession:
    """See `kitchen_of`."""
    return HapticSession(*kitchen_of(category, needs, hob_is_source=hob_is_source), {"propagation": "no_propagation"})


def kitchen_of(category: str, needs: str | None, *, hob_is_source: bool = False) -> tuple[SceneSnapshot, HapticBundle]:
    """A pan on an object of a category; with `hob_is_source`, this object hums."""
    snapshot = scene(box("thing", (0.6, 0.9, 0.6), (0.0, 0.45, 0.0)), box("pan", (0.2, 0.03, 0.2), (0.0, 0.915, 0.0)))
    thing = haptics("steel", (0.6, 0.6, 0.9), *(("on",) if hob_is_source else ()))
    objects = {
        "thing": replace(thing, object_category=category),
        "pan": replace(haptics("steel", (0.2, 0.2, 0.03), "sizzling", needs_contact=needs), object_category="pan"),
    }
    loops = {"pan": {"sizzling": tone_loop(100)}, **({"thing": {"on": tone_loop(50)}} if hob_is_source else {})}
    return snapshot, HapticBundle(snapshot, "kitchen", objects, loops)


@pytest.mark.parametrize("category", ["stove", "cooktop", "hob", "gas hob", "hot plate", "kitchen range"])
def test_stove_is_recognised_by_any_synonym(category: str) -> None:
    assert kitchen(category, "stove").update(touches=ON_PAN).gain("left", "pan") == 1.0


@pytest.mark.parametrize("needs", ["", "none", "null", None])
def test_source_without_needs_always_plays(needs: str | None) -> None:
    assert kitchen("table", needs).update(touches=ON_PAN).gain("left", "pan") == 1.0


@pytest.mark.parametrize("category", ["table", "toy stove", "cooker hood", ""])
def test_pan_is_silent_on_other_objects(category: str) -> None:
    assert kitchen(category, "stove").update(touches=ON_PAN).gain("left", "pan") == 0.0


def test_pan_is_silent_on_a_stove_that_is_off() -> None:
    session = kitchen("hob", "stove", hob_is_source=True)
    assert session.update(touches=ON_PAN).gain("left", "pan") == 1.0
    session.set_source("thing", on=False)
    assert session.update(touches=ON_PAN).gain("left", "pan") == 0.0
    session.set_source("thing", on=True)
    assert session.update(touches=ON_PAN).gain("left", "pan") == 1.0


def test_pan_plays_on_a_muted_stove() -> None:
    session = kitchen("hob", "stove", hob_is_source=True)
    session.set_source("thing", mute=True)
    assert session.update(touches=ON_PAN).gain("left", "pan") == 1.0


def test_a_pan_that_is_lifted_is_silent() -> None:
    touch = [Touch("left", "pan", (0.0, 1.5, 0.0))]
    assert kitchen("hob", "stove").update({"pan": Pose((0.0, 1.5, 0.0))}, touch).gain("left", "pan") == 0.0


def stove_and_pan(**times: Any) -> HapticSession:
    """A pan on a humming stove, and the time that it takes to start and stop."""
    snapshot, bundle = kitchen_of("hob", "stove", hob_is_source=True)
    pan = bundle.objects["pan"]
    states = tuple(replace(state, **times) for state in pan.states)
    bundle = replace(bundle, objects={**bundle.objects, "pan": replace(pan, states=states)})
    return HapticSession(snapshot, bundle, {"propagation": "no_propagation", "prepare": "blocking"})


def levels(session: HapticSession, seconds: float, height_m: float) -> np.ndarray:
    """RMS at the pan in steps of 50 ms, at a height of the pan's middle."""
    touch = [Touch("left", "pan", (0.0, height_m, 0.0))]
    blocks = []
    for _ in range(round(seconds * 100)):
        session.update({"pan": Pose((0.0, height_m, 0.0))}, touch)
        blocks.append(session.render(480))
    return np.asarray(np.sqrt((np.concatenate(blocks)[:, 0].reshape(-1, 2400) ** 2).mean(axis=1)))


@pytest.mark.parametrize("way", ["lifted", "stove switched off", "switched off"])
def test_a_pan_stops_and_starts_over_its_times_however_it_is_stopped(way: str) -> None:
    session = stove_and_pan(start_up_s=1.0, wind_down_s=2.0)
    steady = levels(session, 0.5, 0.915)[-1]
    assert steady > 0.01
    up = 1.5 if way == "lifted" else 0.915
    switched = {"lifted": None, "stove switched off": "thing", "switched off": "pan"}[way]
    if switched is not None:
        session.set_source(switched, on=False)
    down = levels(session, 2.5, up)
    assert down[1] > 0.9 * steady
    assert 0.3 * steady < down[20] < 0.7 * steady
    assert down[-1] == 0.0
    if switched is not None:
        session.set_source(switched, on=True)
    back = levels(session, 1.5, 0.915)
    assert back[1] < 0.1 * steady
    assert back[-1] == pytest.approx(steady, rel=0.02)


def test_a_contact_that_is_lost_for_a_frame_leaves_no_gap() -> None:
    session = stove_and_pan(start_up_s=1.0, wind_down_s=2.0)
    steady = levels(session, 0.5, 0.915)[-1]
    lost = [session.update({"pan": Pose((0.0, 1.5, 0.0))}, [Touch("left", "pan", (0.0, 1.5, 0.0))])]
    assert lost[0].gain("left", "pan") == 1.0
    session.render(480)
    assert levels(session, 0.5, 0.915).min() > 0.95 * steady


def test_a_pan_beside_the_stove_is_silent_from_the_first_update_on() -> None:
    session = stove_and_pan(start_up_s=1.0, wind_down_s=2.0)
    pan = session.snapshot.object("pan")
    assert levels(session, 0.3, 1.5).max() == 0.0
    session.remove("pan")
    session.add(replace(pan, pose=Pose((0.0, 1.5, 0.0))))
    assert levels(session, 0.3, 1.5).max() == 0.0


def test_a_state_without_its_contact_does_not_stop_as_if_it_had_run() -> None:
    snapshot, bundle = kitchen_of("table", "stove")
    pan = bundle.objects["pan"]
    (sizzling,) = pan.states
    states = (replace(sizzling, name="shaken", needs_contact=None), replace(sizzling, wind_down_s=2.0))
    objects = {**bundle.objects, "pan": replace(pan, states=states)}
    loops = {"pan": {"shaken": tone_loop(70), **bundle.loops["pan"]}}
    bundle = replace(bundle, objects=objects, loops=loops)
    session = HapticSession(snapshot, bundle, {"propagation": "no_propagation", "prepare": "blocking"})
    assert levels(session, 0.3, 0.915)[-1] > 0.01
    session.set_source("pan", state="sizzling")
    assert levels(session, 0.3, 0.915)[-1] == 0.0


def test_a_map_before_the_first_update_knows_the_contacts() -> None:
    assert kitchen("hob", "stove").would_feel(ON_PAN).max() == 1.0
    assert kitchen("table", "stove").would_feel(ON_PAN).max() == 0.0


def test_explanation_says_which_contact_a_lifted_pan_lacks() -> None:
    session = kitchen("hob", "stove")
    session.update({"pan": Pose((0.0, 1.5, 0.0))}, [Touch("left", "pan", (0.0, 1.5, 0.0))])
    assert session.explain("left").reasons == (
        "Connected, but without contact with 'stove', switched on: 'pan'; move it there.",
    )
