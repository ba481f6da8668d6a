"""Sources that need contact: a pan that needs a stove, on objects of different categories."""

from dataclasses import replace

import pytest

from scene2hap import HapticBundle, HapticSession, Pose, Touch
from scenes import box, haptics, scene, tone_loop

ON_PAN = [Touch("left", "pan", (0.0, 0.93, 0.0))]


def kitchen(category: str, needs: str | None, *, hob_is_source: bool = False) -> HapticSession:
    """A pan on an object of a category; with `hob_is_source`, this object hums."""
    snapshot = scene(box("thing", (0.6, 0.9, 0.6), (0.0, 0.45, 0.0)), box("pan", (0.2, 0.03, 0.2), (0.0, 0.915, 0.0)))
    thing = haptics("steel", (0.6, 0.6, 0.9), *(("on",) if hob_is_source else ()))
    objects = {
        "thing": replace(thing, object_category=category),
        "pan": replace(haptics("steel", (0.2, 0.2, 0.03), "sizzling", needs_contact=needs), object_category="pan"),
    }
    loops = {"pan": {"sizzling": tone_loop(100)}, **({"thing": {"on": tone_loop(50)}} if hob_is_source else {})}
    return HapticSession(snapshot, HapticBundle(snapshot, "kitchen", objects, loops), {"propagation": "no_propagation"})


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


def test_explanation_says_which_contact_a_lifted_pan_lacks() -> None:
    session = kitchen("hob", "stove")
    session.update({"pan": Pose((0.0, 1.5, 0.0))}, [Touch("left", "pan", (0.0, 1.5, 0.0))])
    assert session.explain("left").reasons == (
        "Connected, but without contact with 'stove', switched on: 'pan'; move it there.",
    )
