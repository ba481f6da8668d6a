"""Rules for two objects to be copies."""

from dataclasses import replace

import numpy as np
import pytest

from scene2hap.scene.copies import copy_key, material_names
from scene2hap.scene.looks.appearance import Appearance, FaceMaterial
from scene2hap.scene.names import name_words
from scene2hap.scene.objects import SceneObject
from scene2hap.scene.pose import Pose
from scene2hap.scene.shapes import Box, TriMesh
from scenes import box

CUBE = replace(box("chair_1", (0.4, 0.4, 0.4), (0, 0, 0)), instance_key="cube")


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("chair", ("chair",)),
        ("wooden_table_1", ("wooden", "table")),
        ("woodenTable.012", ("wooden", "table")),
        ("Wooden Table (3)", ("wooden", "table")),
        ("TVStand2", ("tv", "stand")),
        ("Mug_3a2f91bc", ("mug",)),
        ("facade_7", ("facade",)),
        ("chair_left", ("chair",)),
        ("冷蔵庫_2", ("冷蔵庫",)),
        ("KüchenTisch_2", ("küchen", "tisch")),
        ("ÉTAGÈRE", ("étagère",)),
        ("БелыйСтол", ("белый", "стол")),
        ("017", ()),
        ("", ()),
    ],
)
def test_name_words_drop_the_running_number(name: str, words: tuple[str, ...]) -> None:
    assert name_words(name) == words


def test_long_names_that_differ_at_the_end_are_distinct() -> None:
    assert name_words("a" * 200_000 + "b") != name_words("a" * 200_000 + "c")


def painted(name: str) -> Appearance:
    return Appearance((FaceMaterial(name=name),), np.zeros(len(CUBE.geometry.mesh.faces), np.int32))


def test_copies_may_differ_in_running_number_and_place() -> None:
    other = replace(CUBE, id="2", name="Chair.002", pose=Pose((3.0, 0.0, 1.0)))
    assert copy_key(other) == copy_key(CUBE)


@pytest.mark.parametrize(
    "change",
    [
        {"name": "floor"},
        {"instance_key": "other look"},
        {"surface": replace(CUBE.surface, length_m=0.401)},
        {"appearance": painted("steel")},
    ],
    ids=["name", "mesh or look", "size", "material's name"],
)
def test_copy_key_changes_with_each_deciding_property(change: dict[str, object]) -> None:
    first = replace(CUBE, appearance=painted("oak"))
    assert copy_key(replace(first, **change)) != copy_key(first)


def test_object_without_instance_key_has_no_copies() -> None:
    assert copy_key(replace(CUBE, instance_key="")) != copy_key(replace(CUBE, instance_key="", id="2"))


def test_whole_size_is_invariant_under_yaw() -> None:
    one = box("cupboard", (0.6, 1.8, 1.2), (0, 0, 0))
    assert one.whole_size_m("y") == pytest.approx((1.2, 0.6, 1.8))
    turned = replace(one, pose=Pose((0, 0, 0), (0.0, 0.38, 0.0, 0.92)))
    assert turned.whole_size_m("y") == pytest.approx((1.2, 0.6, 1.8))
    fallen = replace(one, pose=Pose((0, 0, 0), (2**-0.5, 0.0, 0.0, 2**-0.5)))
    assert fallen.whole_size_m("y") == pytest.approx((1.8, 0.6, 1.2))


def test_whole_size_is_that_of_the_surface_wherever_the_vertices_are() -> None:
    """Many files store vertices in world coordinates: turned, and with those of other objects in one buffer."""
    cupboard = Box((0.6, 1.8, 1.2)).mesh
    turn = Pose((3.0, 0.9, -2.0), (0.0, 0.38, 0.0, 0.92))
    vertices = np.concatenate([turn.to_world(cupboard.vertices_m), [[-5.0, -3.0, 9.0]]])
    item = SceneObject("cupboard", geometry=TriMesh(vertices, cupboard.faces))
    assert item.whole_size_m("y") == pytest.approx((1.2, 0.6, 1.8))
    assert item.bounds_m[0, 1] == pytest.approx(0.0)


def test_material_of_the_largest_area_comes_first() -> None:
    board = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], dtype=float)
    handle = np.array([[0.01 * np.cos(a), 0.01 * np.sin(a), 0.1] for a in np.arange(12)])
    faces = [[0, 1, 2], [0, 2, 3], *([4, 4 + i, 5 + i] for i in range(1, 11))]
    looks = Appearance(
        (FaceMaterial(name="steel"), FaceMaterial(name="lacquer"), FaceMaterial(name="unused")),
        np.array([1, 1, *[0] * 10], np.int32),
    )
    mesh = TriMesh(np.concatenate([board, handle]), np.array(faces))
    item = SceneObject("wall_cabinet", geometry=mesh, appearance=looks)
    assert material_names(item) == ("lacquer", "steel")
    assert material_names(replace(item, appearance=None)) == ()
