"""Detailed meshes are prepared in the background, once, and contacts do not depend on it."""

from __future__ import annotations

import gc
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
import trimesh

from scene2hap import Box, HapticSession, Pose, SceneObject, SceneSnapshot, TriMesh, bake
from scene2hap.contact.graph import ContactGraph
from scene2hap.contact.shape import Shape, shape_of
from scene2hap.scene.objects import Contact
from scene2hap.session.deadline import Deadline
from scene2hap.session.prepared_shapes import FEW_TRIANGLES, PreparedShapes


def ball(seed: int, subdivisions: int = 3) -> TriMesh:
    """A bumpy ball of 20 * 4^subdivisions triangles."""
    mesh = trimesh.creation.icosphere(subdivisions=subdivisions, radius=0.1)
    return TriMesh(mesh.vertices * np.random.default_rng(seed).uniform(1.0, 1.05, (len(mesh.vertices), 1)), mesh.faces)


def scene(meshes: Sequence[TriMesh], **given: Any) -> SceneSnapshot:
    """Balls in a row, apart from each other, above a floor."""
    floor = SceneObject("wooden floor", geometry=Box((4.0, 0.04, 1.0)), pose=Pose((0.0, -0.02, 0.0)))
    balls = [SceneObject(f"ball{k}", geometry=mesh, pose=Pose((0.4 * k, 0.5, 0.0))) for k, mesh in enumerate(meshes)]
    return SceneSnapshot.build([floor, *balls], **given)


def test_a_session_prepares_its_detailed_meshes() -> None:
    detailed, few = ball(0), ball(1, subdivisions=1)
    assert len(few.faces) < FEW_TRIANGLES <= len(detailed.faces)
    with HapticSession(made := scene([detailed, few]), bake(made)) as session:
        assert session.wait_prepared(30)
        assert shape_of(detailed).is_prepared
        assert not shape_of(few).is_prepared


def test_added_objects_are_prepared() -> None:
    made, later = scene([ball(2)]), ball(3)
    with HapticSession(made, bake(made)) as session:
        session.add(SceneObject("later", geometry=later, pose=Pose((1.5, 0.5, 0.0))))
        assert session.wait_prepared(30)
        assert shape_of(later).is_prepared


@pytest.mark.parametrize("why", ["blocking", "given contacts"])
def test_nothing_is_prepared_where_it_is_not_wanted(why: str) -> None:
    mesh = ball(4)
    made = scene([mesh])
    if why == "given contacts":
        made = replace(made, contacts=(Contact("ball0", "wooden floor", (0.0, 0.0, 0.0)),))
    config = {"prepare": "blocking"} if why == "blocking" else {}
    with HapticSession(made, bake(made), config) as session:
        assert session.wait_prepared(30)
        assert not shape_of(mesh).is_prepared


def test_copies_are_prepared_once(monkeypatch: pytest.MonkeyPatch) -> None:
    prepared: list[Shape] = []
    monkeypatch.setattr(Shape, "prepare", lambda shape: prepared.append(shape))
    meshes = [ball(5), ball(6), ball(5)]
    kept = [shape_of(mesh) for mesh in meshes]
    shapes = PreparedShapes(is_wanted=True)
    shapes.order(meshes)
    assert shapes.wait(Deadline(30))
    assert len(prepared) == 2
    assert set(prepared) == set(kept)


def test_contacts_are_the_same_before_and_after() -> None:
    path = [{"ball0": Pose((0.4 * k / 10, 0.3 - 0.02 * k, 0.01 * k))} for k in range(11)]
    found = []
    for is_prepared in (False, True):
        gc.collect()  # shapes live as long as a graph uses them
        mesh = ball(7)
        graph = ContactGraph(scene([mesh, ball(8)]))
        if is_prepared:
            shape_of(mesh).prepare()
        found.append([graph.update(moved) and graph.contacts for moved in path])
    assert found[0] == found[1]
    assert any(found[0])


def test_a_timeout_is_reported(monkeypatch: pytest.MonkeyPatch) -> None:
    from threading import Event

    go_on = Event()
    monkeypatch.setattr(Shape, "prepare", lambda shape: go_on.wait(30))
    kept, shapes = shape_of(mesh := ball(9)), PreparedShapes(is_wanted=True)
    shapes.order([mesh])
    assert not shapes.wait(Deadline(0.01))
    go_on.set()
    assert shapes.wait(Deadline(30))
    assert not kept.is_prepared
