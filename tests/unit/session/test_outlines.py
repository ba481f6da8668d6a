"""Surfaces with an outline other than a rectangle in a session: which models use it, and where it lies."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from scene2hap import HapticBundle, HapticSession, Outline, SceneSnapshot, Touch
from scene2hap.scene.objects import SceneObject
from scene2hap.session.present_scene.network import PlatePoses, body_of
from scenes import table_with_two_phones


def round_table() -> tuple[SceneSnapshot, HapticBundle]:
    """The table with two phones; its top is an ellipse that extends a little beyond its rectangle."""
    scene, bundle = table_with_two_phones()
    table = scene.object("table")
    length, width = table.surface.length_m, table.surface.width_m
    turn = np.arange(64) * 2 * math.pi / 64
    x, y = length * (0.5 + 0.55 * np.cos(turn)), width * (0.5 + 0.55 * np.sin(turn))
    outline = Outline((np.column_stack([x, y]).tolist(),))
    with_outline = replace(table, surface=replace(table.surface, outline=outline))
    objects: tuple[SceneObject, ...] = tuple(with_outline if item.id == "table" else item for item in scene.objects)
    scene = replace(scene, objects=objects)
    return scene, replace(bundle, snapshot=scene)


@pytest.mark.parametrize(
    ("propagation", "follows"),
    [("mass_spring_damper", True), ("auto", True), ("modal_plate", False), ("exponential_plate", False)],
)
def test_models_that_follow_outlines_get_them(propagation: str, follows: bool) -> None:
    scene, bundle = round_table()
    session = HapticSession(scene, bundle, {"propagation": propagation, "prepare": "blocking"})
    middle = np.mean(scene.object("table").bounds_m, axis=0)
    frame = session.update(
        touches=[Touch("left", "table", (middle[0], scene.object("table").bounds_m[1][1], middle[2]))]
    )
    assert (frame.gains[0] > 0).any()
    body = body_of(bundle.objects["table"], scene.object("table").surface)
    assert body is not None
    assert body.outline is not None
    as_session = body if follows else body_of(bundle.objects["table"])
    assert session._state.bodies["table"] == as_session


def test_outline_has_the_place_at_which_it_was_measured() -> None:
    """The centre of the outline is the centre of the surface, even if a person corrected the size."""
    scene, bundle = round_table()
    table = scene.object("table")
    middle = table.pose.compose(table.surface.pose).to_world(
        np.array([[table.surface.length_m / 2, table.surface.width_m / 2, 0.0]])
    )[0]
    for scale in (1.0, 2.0):
        haptics = bundle.objects["table"]
        length, width, thickness = haptics.estimated_size_m
        haptics = replace(haptics, estimated_size_m=(scale * length, width, thickness))
        body = body_of(haptics, table.surface)
        assert body is not None
        assert body.extent_m == pytest.approx((1.1 * scale * length, 1.1 * width), rel=0.01)
        corner = PlatePoses({"table": table}, {"table": body}, {"table": table.pose})["table"]
        found = corner.to_world(np.array([[body.length_m / 2, body.width_m / 2, 0.0]]))[0]
        assert found == pytest.approx(middle, abs=1e-3)


def test_outline_round_trips_through_a_bundle() -> None:
    scene, _ = round_table()
    assert SceneSnapshot.from_json(scene.to_json()).object("table").surface == scene.object("table").surface
