"""Typed scenes: content, invalid input, and messages."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import FrozenInstanceError, replace

import numpy as np
import pytest

from scene2hap.errors import SceneError, UnknownObject
from scene2hap.scene.objects import Contact, SceneObject
from scene2hap.scene.pose import Pose
from scene2hap.scene.shapes import Box, DominantSurface, TriMesh
from scene2hap.scene.snapshot import SceneSnapshot
from scenes import box, scene

TRIANGLE = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]


def test_a_box_has_twelve_triangles_that_enclose_its_volume() -> None:
    mesh = Box((2.0, 3.0, 4.0)).mesh
    a, b, c = (mesh.vertices_m[mesh.faces[:, k]] for k in range(3))
    assert len(mesh.faces) == 12
    # By the divergence theorem, outward faces give a positive volume.
    assert np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6 == pytest.approx(24.0)
    np.testing.assert_array_equal(mesh.bounds_m, [[-1.0, -1.5, -2.0], [1.0, 1.5, 2.0]])


def test_bounds_exclude_unused_vertices() -> None:
    mesh = TriMesh([*TRIANGLE, [9.0, 9.0, 9.0]], [[0, 1, 2]])
    np.testing.assert_array_equal(mesh.bounds_m, [[0.0, 0.0, 0.0], [1.0, 1.0, 0.0]])


def test_a_normal_of_a_contact_is_a_unit_vector_or_unknown() -> None:
    assert Contact("a", "b", (0, 0, 0), (0.0, 3.0, 4.0)).normal == pytest.approx((0.0, 0.6, 0.8))
    assert Contact("a", "b", (0, 0, 0), (0.0, 0.0, 0.0)).normal is None
    assert Contact("a", "b", (0, 0, 0), (1.7e308, 1.7e308, 1.7e308)).normal is None  # no float has its length
    given = (0.0, 0.6, 0.8 + 1e-12)
    assert Contact("a", "b", (0, 0, 0), given).normal == given


def test_meshes_are_equal_by_content() -> None:
    assert TriMesh(TRIANGLE, [[0, 1, 2]]) == TriMesh(np.array(TRIANGLE, dtype=np.float32), [[0.0, 1.0, 2.0]])
    assert TriMesh(TRIANGLE, [[0, 1, 2]]) != TriMesh(TRIANGLE, [[0, 2, 1]])
    assert len({TriMesh(TRIANGLE, [[0, 1, 2]]), TriMesh(TRIANGLE, [[0, 1, 2]])}) == 1


def test_mesh_copies_its_arrays_and_is_read_only() -> None:
    vertices = np.array(TRIANGLE)
    mesh = TriMesh(vertices, [[0, 1, 2]])
    vertices[0] = 5.0
    assert mesh.vertices_m[0, 0] == 0.0
    with pytest.raises(ValueError, match="read-only"):
        mesh.vertices_m[0] = 1.0
    with pytest.raises(FrozenInstanceError):
        mesh.faces = mesh.faces


@pytest.mark.parametrize(
    ("make", "sentence"),
    [
        (lambda: TriMesh(TRIANGLE, []), "faces is empty"),
        (lambda: TriMesh([*TRIANGLE[:2], [0.0, np.inf, 0.0]], [[0, 1, 2]]), r"vertices_m\[2\] is \[0.0, inf, 0.0\]"),
        (lambda: TriMesh(TRIANGLE, [[0, 1, 3]]), "vertex 3; the mesh has 3"),
        (lambda: TriMesh(TRIANGLE, [[-1, 1, 2]]), "vertex -1; the mesh has 3"),
        (lambda: TriMesh([[0.0, 1.0]], [[0, 0, 0]]), r"vertices_m has shape \(1, 2\)"),
        (lambda: TriMesh("mesh", [[0, 1, 2]]), "vertices_m is not a table"),
        (lambda: TriMesh(TRIANGLE, [[0, 1, 2.0**31]]), "not vertex numbers"),
        (lambda: Box((1.0, 0.0, 1.0)), r"size_m\[1\] is 0 m; it must be above 0.0 \[m\]"),
        (lambda: DominantSurface(Pose(), 1.0, -1.0, 0.0), "width_m is -1 m; it must be at least 0.0"),
        (lambda: Contact("a", "a", (0.0, 0.0, 0.0)), "contact of 'a' with itself"),
        (lambda: Contact("a", "b", (0.0, 0.0, 0.0), weight=1.5), "weight is 1.5; it must be at most 1.0"),
        (lambda: Contact("a", "b", (0.0, 0.0, 0.0), area_m2=-1.0), "area_m2 is -1 m2"),
        (lambda: Contact("a", "b", (0.0, np.nan, 0.0)), r"point_m\[1\] is nan m"),
        (lambda: replace(box("a", (1, 1, 1), (0, 0, 0)), id=""), "'a' has an empty id"),
        (lambda: box("caf\udce9", (1, 1, 1), (0, 0, 0)), r"'caf\\udce9', with half of a character.*'caf\ufffd'"),
        (lambda: SceneSnapshot("void", "y", ()), "'void' has no object"),
        (lambda: SceneSnapshot("s", "x", (box("a", (1, 1, 1), (0, 0, 0)),)), "up_axis is 'x'"),
        (
            lambda: scene(box("a", (1, 1, 1), (0, 0, 0)), box("a", (1, 1, 1), (5, 0, 0))),
            "id 'a' is used more than once",
        ),
    ],
)
def test_invalid_snapshots_are_refused(make: Callable[[], object], sentence: str) -> None:
    with pytest.raises(SceneError, match=sentence):
        make()


def test_a_contact_must_join_objects_of_the_scene() -> None:
    objects = (box("lamp", (1, 1, 1), (0, 0, 0)), box("table", (1, 1, 1), (5, 0, 0)))
    with pytest.raises(UnknownObject, match=r"no object 'tabel'. Did you mean 'table'\?"):
        SceneSnapshot("s", "y", objects, (Contact("lamp", "tabel", (0.0, 0.0, 0.0)),))


def test_object_lookup_by_id_names_the_nearest_id_on_failure() -> None:
    snapshot = scene(box("kettle", (1, 1, 1), (0, 0, 0)))
    assert snapshot.object("kettle").name == "kettle"
    with pytest.raises(UnknownObject, match="'kettle'"):
        snapshot.object("ketle")
    with pytest.raises(LookupError, match="There are 'kettle'\\."):
        snapshot.object("zzz")


def test_heights_are_above_the_lowest_point() -> None:
    snapshot = scene(box("floor", (4, 0.2, 4), (0, -0.1, 0)), box("cup", (0.1, 0.1, 0.1), (0, 0.8, 0)))
    assert [item.relative_height_m for item in snapshot.objects] == pytest.approx([0.0, 0.95])


def test_heights_follow_the_up_axis() -> None:
    item = box("a", (1, 1, 1), (0, 0, 0.5))
    above = replace(item, id="b", pose=Pose((0.0, 0.0, 2.5)))
    upright = SceneSnapshot("s", "z", (item, above)).with_poses({})
    assert [thing.relative_height_m for thing in upright.objects] == pytest.approx([0.0, 2.0])


def test_with_poses_moves_only_named_objects_and_drops_given_contacts() -> None:
    before = SceneSnapshot(
        "s",
        "y",
        (box("a", (1, 1, 1), (0, 0.5, 0)), box("b", (1, 1, 1), (3, 0.5, 0))),
        (Contact("a", "b", (1.0, 0.0, 0.0)),),
    )
    after = before.with_poses({"b": Pose((3.0, 2.5, 0.0))})
    assert after.object("a").pose == before.object("a").pose
    assert after.object("b").relative_height_m == pytest.approx(2.0)
    assert after.contacts is None
    assert before.contacts is not None
    with pytest.raises(UnknownObject):
        before.with_poses({"c": Pose()})


def test_world_bounds_turn_with_the_object() -> None:
    quarter_about_y = (0.0, 0.5**0.5, 0.0, 0.5**0.5)
    item = replace(box("a", (2.0, 1.0, 4.0), (0, 0, 0)), pose=Pose((10.0, 0.0, 0.0), quarter_about_y))
    np.testing.assert_allclose(item.bounds_m, [[8.0, -0.5, -1.0], [12.0, 0.5, 1.0]], atol=1e-12)


def test_size_is_that_of_the_surface() -> None:
    assert box("table", (1.6, 0.02, 0.8), (0, 0, 0)).size_m == (1.6, 0.8, 0.02)


def test_objects_are_plain_data() -> None:
    first, second = (box("a", (1, 1, 1), (0, 0, 0)) for _ in range(2))
    assert isinstance(first, SceneObject)
    assert first == second


def test_objects_that_stay_keep_what_they_have_derived() -> None:
    items = [box(x, (0.1, 0.1, 0.1), (0.0, height, 0.0)) for x, height in (("ground", 0.0), ("a", 1.0), ("b", 2.0))]
    before = SceneSnapshot("s", "y", tuple(items)).with_poses({})
    after = before.with_poses({"a": Pose((0.0, 1.0, 0.0)), "b": Pose((0.0, 2.5, 0.0))})
    assert after.object("ground") is before.object("ground")
    assert after.object("a") is before.object("a")
    assert after.object("b").relative_height_m == before.object("b").relative_height_m + 0.5
