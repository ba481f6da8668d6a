"""Objects of pieces: a rigid pose from any transform, and one mesh for all copies."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from scipy.linalg import polar
from scipy.spatial.transform import Rotation

from gltf_builder import CUBE, CUBE_FACES
from scene2hap.errors import SceneError
from scene2hap.scene.grouping.groups import Group
from scene2hap.scene.grouping.object_maker import ObjectMaker
from scene2hap.scene.looks.appearance import Appearance, FaceMaterial
from scene2hap.scene.tree import Matrix, Piece, rigid_part

PIECE = Piece("cube", CUBE, CUBE_FACES.astype(np.int32), "oak")
seeds = st.integers(0, 2**32 - 1)


def affine(linear: Matrix, at: tuple[float, float, float] = (0.0, 0.0, 0.0)) -> Matrix:
    matrix = np.eye(4)
    matrix[:3, :3], matrix[:3, 3] = linear, at
    return matrix


def group(matrix: Matrix, *pieces: Piece, name: str = "thing") -> Group:
    return Group(name, matrix, tuple((matrix, piece) for piece in pieces or (PIECE,)))


@given(seeds)
@settings(max_examples=60)
def test_the_rigid_part_is_the_polar_rotation(seed: int) -> None:
    linear = np.random.default_rng(seed).normal(size=(3, 3))
    rotation = rigid_part(affine(linear))[:3, :3]
    orthogonal, _ = polar(linear)
    if np.linalg.det(orthogonal) < 0:
        # A mirror becomes a mirrored x axis; the y and z axes are those of the transform.
        orthogonal = orthogonal * [-1.0, 1.0, 1.0]
    np.testing.assert_allclose(rotation, orthogonal, atol=1e-8)
    assert np.linalg.det(rotation) == pytest.approx(1.0)


@given(seeds)
@settings(max_examples=60)
def test_pose_and_mesh_reproduce_the_transform(seed: int) -> None:
    rng = np.random.default_rng(seed)
    matrix = affine(rng.normal(size=(3, 3)), tuple(rng.normal(size=3)))
    placed = ObjectMaker("y", 1.0).make("thing", group(matrix))
    expected = CUBE @ matrix[:3, :3].T + matrix[:3, 3]
    np.testing.assert_allclose(placed.pose.to_world(placed.geometry.vertices_m), expected, atol=1e-9)
    turned = placed.geometry.faces[:, ::-1] if np.linalg.det(matrix[:3, :3]) < 0 else placed.geometry.faces
    np.testing.assert_array_equal(turned, CUBE_FACES)


def test_flattened_node_has_a_rigid_pose() -> None:
    placed = ObjectMaker("y", 1.0).make("thing", group(affine(np.diag([2.0, 0.0, 3.0]))))
    np.testing.assert_allclose(np.ptp(placed.geometry.bounds_m, axis=0), [2.0, 0.0, 3.0], atol=1e-12)


def test_copies_rounded_to_single_precision_share_a_mesh() -> None:
    maker = ObjectMaker("y", 1.0)
    turns = Rotation.from_quat(np.random.default_rng(5).normal(size=(40, 4))).as_matrix()
    exact = [affine(0.37 * turn, (i, 0.0, 0.0)) for i, turn in enumerate(turns)]
    placed = [maker.make("thing", group(matrix.astype(np.float32).astype(np.float64))) for matrix in exact]
    assert len({id(item.geometry) for item in placed}) == 1
    for matrix, item in zip(exact, placed, strict=True):
        points = item.pose.to_world(item.geometry.vertices_m)
        np.testing.assert_allclose(points, CUBE @ matrix[:3, :3].T + matrix[:3, 3], atol=5e-6)


def test_copies_that_differ_by_a_thousandth_have_separate_meshes() -> None:
    maker = ObjectMaker("y", 1.0)
    meshes = [maker.make("thing", group(affine(scale * np.eye(3)))).geometry for scale in (1.0, 1.001, 1.0)]
    assert meshes[0] is meshes[2]
    assert meshes[0] is not meshes[1]


def test_mirrored_copy_has_a_separate_mesh() -> None:
    maker = ObjectMaker("y", 1.0)
    plain, mirrored = (maker.make("thing", group(affine(np.diag([sign, 1.0, 1.0])))) for sign in (1.0, -1.0))
    assert plain.instance_key != mirrored.instance_key


def test_instance_key_depends_on_material_but_not_on_place() -> None:
    maker = ObjectMaker("y", 1.0)
    steel = Piece("other", CUBE, PIECE.faces, "steel")
    oak = [maker.make("thing", group(affine(np.eye(3), (x, 0.0, 0.0)))).instance_key for x in (0.0, 9.0)]
    assert oak[0] == oak[1] != maker.make("thing", group(np.eye(4), steel)).instance_key


def test_pieces_are_joined_in_order() -> None:
    lifted = affine(np.eye(3), (0.0, 5.0, 0.0))
    placed = ObjectMaker("y", 1.0).make("thing", Group("thing", np.eye(4), ((np.eye(4), PIECE), (lifted, PIECE))))
    np.testing.assert_array_equal(placed.geometry.vertices_m, np.vstack((CUBE, CUBE + np.array([0.0, 5.0, 0.0]))))
    np.testing.assert_array_equal(placed.geometry.faces, np.vstack((CUBE_FACES, CUBE_FACES + 8)))


def test_the_unit_scales_place_and_mesh() -> None:
    placed = ObjectMaker("y", 0.01).make("thing", group(affine(np.eye(3), (100.0, 0.0, 0.0))))
    assert placed.pose.position_m == pytest.approx((1.0, 0.0, 0.0))
    np.testing.assert_allclose(np.ptp(placed.geometry.bounds_m, axis=0), 0.01)


@pytest.mark.parametrize("scale", [0.0, 1e-12])
def test_object_without_extent_is_refused_by_name(scale: float) -> None:
    with pytest.raises(SceneError, match="object 'thing' has no size"):
        ObjectMaker("y", 1.0).make("thing", group(affine(scale * np.eye(3))))


def test_copy_is_found_among_many_sizes() -> None:
    maker = ObjectMaker("y", 1.0)
    scales = np.random.default_rng(3).permutation(np.linspace(0.5, 2.0, 300))
    first = [maker.make("thing", group(affine(scale * np.eye(3)))).geometry for scale in scales]
    again = [maker.make("thing", group(affine(scale * np.eye(3)))).geometry for scale in scales]
    assert len({id(mesh) for mesh in first}) == 300
    assert all(a is b for a, b in zip(first, again, strict=True))


def test_copies_stored_separately_at_any_rotation_share_a_mesh() -> None:
    """A rotation and its inverse leave errors of about 1e-14 m, which must not change the key."""
    maker = ObjectMaker("y", 1.0)
    points = np.random.default_rng(7).normal(size=(4000, 3))
    faces = np.arange(3999).reshape(-1, 3).astype(np.int32)
    turns = Rotation.from_euler("y", np.linspace(0.0, 6.0, 20)[:, None]).as_matrix()
    placed = [
        maker.make("thing", group(affine(turn, (i, 0.0, 0.0)), Piece(i, points[:3999], faces, "oak")))
        for i, turn in enumerate(turns)
    ]
    assert len({item.instance_key for item in placed}) == 1
    assert len({id(item.geometry) for item in placed}) == 1
    np.testing.assert_allclose(placed[0].geometry.vertices_m, points[:3999], atol=0.6e-9)


def test_meshes_that_differ_by_a_micrometre_are_separate() -> None:
    maker = ObjectMaker("y", 1.0)
    keys = [
        maker.make(
            "thing", group(np.eye(4), Piece(i, CUBE * [1.0, 1.0, 1.0 + 1e-6 * i], PIECE.faces, "oak"))
        ).instance_key
        for i in range(2)
    ]
    assert keys[0] != keys[1]


def painted(color: float, key: str = "cube") -> Piece:
    uv = np.random.default_rng(1).random((12, 3, 2)).astype(np.float32)
    material = FaceMaterial((color, 0.0, 0.0, 1.0), np.full((1, 1, 3), 7, np.uint8))
    return replace(PIECE, key=key, appearance=Appearance.plain(material, 12, uv))


def test_mesh_in_two_colours_is_shared_with_two_keys() -> None:
    """The same piece with two materials, as in COLLADA and engines."""
    maker = ObjectMaker("y", 1.0)
    red, dark, again = (maker.make("thing", group(np.eye(4), painted(color))) for color in (1.0, 0.5, 1.0))
    assert red.geometry is dark.geometry
    assert red.instance_key == again.instance_key != dark.instance_key
    assert red.appearance is again.appearance is not dark.appearance
    assert red.appearance is not None
    assert red.appearance.materials[0].color_rgba == (1.0, 0.0, 0.0, 1.0)


def test_mirrored_parts_reorder_texture_coordinates_with_corners() -> None:
    piece = painted(1.0)
    mirror = affine(np.diag([1.0, -1.0, 1.0]), (5.0, 0.0, 0.0))
    placed = ObjectMaker("y", 1.0).make(
        "thing", Group("thing", np.eye(4), ((np.eye(4), piece), (mirror, piece), (np.eye(4), PIECE)))
    )
    assert placed.appearance is not None
    assert placed.appearance.uv is not None
    assert piece.appearance is not None
    assert piece.appearance.uv is not None
    plain, mirrored, bare = placed.geometry.faces[:12], placed.geometry.faces[12:24] - 8, placed.appearance.uv[24:]
    np.testing.assert_array_equal(plain, mirrored[:, ::-1])
    np.testing.assert_array_equal(placed.appearance.uv[:12], piece.appearance.uv)
    np.testing.assert_array_equal(placed.appearance.uv[12:24], piece.appearance.uv[:, ::-1])
    assert not bare.any()
    assert placed.appearance.face_material.tolist() == [0] * 24 + [1] * 12
