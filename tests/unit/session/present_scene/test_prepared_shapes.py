"""Meshes are prepared in the background or in a loading screen, once, and contacts do not depend on it."""

from __future__ import annotations

import gc
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from threading import Event, Thread
from typing import Any
from weakref import ref

import numpy as np
import pytest
import trimesh

from garbage import only_new_garbage
from scene2hap import Box, HapticSession, Pose, SceneObject, SceneSnapshot, TriMesh, bake, bake_object
from scene2hap.common import worker_threads
from scene2hap.common.deadline import Deadline
from scene2hap.common.worker_threads import start_worker
from scene2hap.contact.geometry.triangle_tree import TriangleTree
from scene2hap.contact.graph import ContactGraph
from scene2hap.contact.shape import Shape, shape_of
from scene2hap.scene import objects
from scene2hap.scene.objects import Contact
from scene2hap.session.present_scene.prepared_shapes import PreparedShapes


@pytest.fixture(autouse=True)
def _only_new_garbage() -> Iterator[None]:
    with only_new_garbage():
        yield


def ball(seed: int, subdivisions: int = 3) -> TriMesh:
    """A bumpy ball of 20 * 4^subdivisions triangles."""
    mesh = trimesh.creation.icosphere(subdivisions=subdivisions, radius=0.1)
    return TriMesh(mesh.vertices * np.random.default_rng(seed).uniform(1.0, 1.05, (len(mesh.vertices), 1)), mesh.faces)


def scene(meshes: Sequence[TriMesh], **given: Any) -> SceneSnapshot:
    """Balls in a row, apart from each other, above a floor."""
    floor = SceneObject("wooden floor", geometry=Box((4.0, 0.04, 1.0)), pose=Pose((0.0, -0.02, 0.0)))
    balls = [SceneObject(f"ball{k}", geometry=mesh, pose=Pose((0.4 * k, 0.5, 0.0))) for k, mesh in enumerate(meshes)]
    return SceneSnapshot.build([floor, *balls], **given)


def test_a_session_prepares_its_meshes() -> None:
    meshes = [ball(0), ball(1, subdivisions=1)]
    with HapticSession(made := scene(meshes), bake(made)) as session:
        assert session.wait_prepared(30)
        assert all(shape_of(mesh).is_prepared for mesh in meshes)


def test_workers_prepare_without_a_loading_screen() -> None:
    meshes = [ball(17), ball(18, subdivisions=1)]
    kept, shapes = [shape_of(mesh) for mesh in meshes], PreparedShapes(is_wanted=True, in_background=True)
    shapes.order(meshes)
    assert shapes._last is not None
    shapes._last.result(30)
    assert all(shape.is_prepared for shape in kept)


def test_blocking_sessions_prepare_in_the_loading_screen() -> None:
    mesh = ball(4)
    with HapticSession(made := scene([mesh]), bake(made), {"prepare": "blocking"}) as session:
        assert not shape_of(mesh).is_prepared
        assert session.wait_prepared(30)
        assert shape_of(mesh).is_prepared


def test_added_objects_are_prepared() -> None:
    made, later = scene([ball(2)]), ball(3)
    with HapticSession(made, bake(made)) as session:
        session.add(SceneObject("later", geometry=later, pose=Pose((1.5, 0.5, 0.0))))
        assert session.wait_prepared(30)
        assert shape_of(later).is_prepared


def test_nothing_is_prepared_where_contacts_are_given() -> None:
    mesh = ball(10)
    made = replace(scene([mesh]), contacts=(Contact("ball0", "wooden floor", (0.0, 0.0, 0.0)),))
    with HapticSession(made, bake(made)) as session:
        assert session.wait_prepared(30)
        assert not shape_of(mesh).is_prepared


def test_a_wave_of_spawned_objects_starts_one_worker(monkeypatch: pytest.MonkeyPatch) -> None:
    go_on, started = Event(), []

    def start(*given: Any) -> Thread:
        started.append(given)
        return start_worker(*given)

    monkeypatch.setattr(Shape, "prepare", lambda shape: go_on.wait(30))
    monkeypatch.setattr(worker_threads, "start_worker", start)
    shapes = PreparedShapes(is_wanted=True, in_background=True)
    meshes = [ball(11), ball(19), ball(20)]
    for mesh in meshes * 7:
        shapes.order([mesh])
    assert len(started) == 1
    go_on.set()
    assert shapes.wait(Deadline(30))


def test_a_shape_is_kept_for_later_copies_as_long_as_its_mesh_lives() -> None:
    prefab = bake_object(SceneObject("rock", geometry=ball(12)))
    with HapticSession(made := scene([ball(13)]), bake(made)) as session:
        session.spawn(prefab, "rock 1", Pose((1.5, 0.5, 0.0)))
        assert session.wait_prepared(30)
        session.remove("rock 1")
        gc.collect()
        (item,) = prefab.snapshot.objects
        shape = ref(shape_of(item.geometry.mesh))
        assert shape_of(item.geometry.mesh).is_prepared
        del prefab, item
        objects._measured.cache_clear()  # which keeps the newest meshes
        gc.collect()
        assert shape() is None


def test_shapes_are_freed_with_their_session() -> None:
    made = scene([mesh := ball(14)])
    with HapticSession(made, bake(made)) as session:
        assert session.wait_prepared(30)
        shape = ref(shape_of(mesh))
    del session
    gc.collect()
    assert shape() is None


def test_no_mesh_waits_for_another(monkeypatch: pytest.MonkeyPatch) -> None:
    begun, go_on, over = Event(), Event(), TriangleTree.over

    def slow(*given: Any) -> TriangleTree:
        if not begun.is_set():
            begun.set()
            go_on.wait(30)
        return over(*given)

    monkeypatch.setattr(TriangleTree, "over", slow)
    detailed, other = ball(15), ball(16)
    shapes = PreparedShapes(is_wanted=True, in_background=True)
    shapes.order([detailed])
    assert begun.wait(30)
    with ThreadPoolExecutor(1) as game:
        found = game.submit(lambda: shape_of(other).tree)
        try:
            found.result(10)
        finally:
            go_on.set()
    assert shapes.wait(Deadline(30))


def test_copies_are_prepared_once(monkeypatch: pytest.MonkeyPatch) -> None:
    prepared: list[Shape] = []
    monkeypatch.setattr(Shape, "prepare", lambda shape: prepared.append(shape))
    meshes = [ball(5), ball(6), ball(5)]
    kept = [shape_of(mesh) for mesh in meshes]
    shapes = PreparedShapes(is_wanted=True, in_background=True)
    shapes.order(meshes)
    assert shapes.wait(Deadline(30))
    # By a worker, and asked again by `wait`, which finds nothing left to do.
    assert len(prepared) == 4
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
    go_on = Event()
    monkeypatch.setattr(Shape, "prepare", lambda shape: go_on.wait(30))
    kept, shapes = shape_of(mesh := ball(9)), PreparedShapes(is_wanted=True, in_background=True)
    shapes.order([mesh])
    assert not shapes.wait(Deadline(0.01))
    go_on.set()
    assert shapes.wait(Deadline(30))
    assert not kept.is_prepared
