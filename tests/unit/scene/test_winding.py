"""Meshes of faces drawn twice and of mixed winding have the surface of the well-wound mesh."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
import trimesh
from numpy.typing import NDArray

from scene2hap.scene.shapes import Box, DominantSurface, TriMesh
from scene2hap.scene.surface.dominant_surface import dominant_surface
from scene2hap.scene.surface.winding import well_wound

Faces = NDArray[np.int64]
Size = tuple[float, float, float]


def boxes(*parts: tuple[Size, Size]) -> trimesh.Trimesh:
    """One mesh of cuboids, each (size, centre)."""
    return trimesh.util.concatenate([trimesh.creation.box(size).apply_translation(at) for size, at in parts])


def tri_mesh(mesh: trimesh.Trimesh) -> TriMesh:
    return TriMesh(mesh.vertices, mesh.faces)


# Legs that reach into the top, so that the winding of one part against another matters.
LEGS = tuple(((0.2, 0.2, 0.73), (x, y, 0.365)) for x in (-0.7, 0.7) for y in (-0.3, 0.3))
TABLE = tri_mesh(boxes(((1.6, 0.8, 0.04), (0.0, 0.0, 0.72)), *LEGS))
TUB = tri_mesh(trimesh.creation.annulus(0.3, 0.32, 0.5))
OPEN_BELOW = TriMesh(
    Box((3.0, 0.6, 0.04)).mesh.vertices_m,
    [face for face in Box((3.0, 0.6, 0.04)).mesh.faces if (Box((3.0, 0.6, 0.04)).mesh.vertices_m[face, 2] > 0).any()],
)
SHELF = tri_mesh(
    boxes(((1.0, 0.4, 0.02), (0, 0, 1.5)), ((1.0, 0.4, 0.03), (0, 0, 0.5)), ((1.0, 0.02, 1.2), (0, 0.21, 1)))
)
MESHES = {"table": TABLE, "tub": TUB, "open below": OPEN_BELOW, "shelf": SHELF}


def with_backs(mesh: TriMesh) -> TriMesh:
    return TriMesh(mesh.vertices_m, np.concatenate((mesh.faces, mesh.faces[:, ::-1])))


def shuffled_with_backs(mesh: TriMesh) -> TriMesh:
    return TriMesh(mesh.vertices_m, np.random.default_rng(0).permutation(with_backs(mesh).faces))


def partly_twice(mesh: TriMesh) -> TriMesh:
    return TriMesh(mesh.vertices_m, np.concatenate((mesh.faces, mesh.faces[::3, [1, 2, 0]])))


def partly_turned(mesh: TriMesh) -> TriMesh:
    is_turned = np.random.default_rng(1).random((len(mesh.faces), 1)) < 0.3
    return TriMesh(mesh.vertices_m, np.where(is_turned, mesh.faces[:, ::-1], mesh.faces))


def in_triangles(mesh: TriMesh) -> TriMesh:
    """Each triangle with corners of its own, rounded to float32 at 50 m, and partly turned."""
    corners = (mesh.vertices_m[mesh.faces].reshape(-1, 3) + 50.0).astype(np.float32)
    return partly_turned(TriMesh(corners, np.arange(len(corners)).reshape(-1, 3)))


def edges(surface: DominantSurface) -> list[float]:
    return [surface.length_m, surface.width_m, surface.thickness_m]


@pytest.mark.parametrize("name", MESHES)
@pytest.mark.parametrize("again", [with_backs, shuffled_with_backs, partly_twice, partly_turned, in_triangles])
def test_messy_meshes_have_the_surface_of_tidy_ones(again: Callable[[TriMesh], TriMesh], name: str) -> None:
    up = (0.0, 0.0, 1.0)
    expected, found = dominant_surface(MESHES[name], up=up), dominant_surface(again(MESHES[name]), up=up)
    assert edges(found) == pytest.approx(edges(expected), abs=2e-5)
    assert found.flags == expected.flags


def wound(mesh: TriMesh) -> Faces:
    return well_wound(mesh.vertices_m.T.copy(), mesh.faces.T.astype(np.int64)).T


def volume_m3(mesh: TriMesh, faces: Faces) -> float:
    a, b, c = np.moveaxis(mesh.vertices_m[faces], 1, 0)
    return float((a * np.cross(b, c)).sum()) / 6


def test_well_wound_meshes_are_left_alone() -> None:
    for mesh in (TABLE, TUB, OPEN_BELOW, TriMesh(TABLE.vertices_m, TABLE.faces[:, ::-1])):
        np.testing.assert_array_equal(wound(mesh), mesh.faces)


def test_mixed_patches_of_solids_face_outwards_and_triangles_are_kept_once() -> None:
    for again in (with_backs, shuffled_with_backs, partly_twice, partly_turned):
        for mesh in (TABLE, TUB):
            faces = wound(again(mesh))
            assert len(faces) == len(mesh.faces)
            assert volume_m3(mesh, faces) == pytest.approx(volume_m3(mesh, mesh.faces.astype(np.int64)))


def test_a_cavity_that_faces_inwards_keeps_its_winding_beside_mixed_parts() -> None:
    outer, inner = trimesh.creation.box((0.6, 0.5, 1.8)), trimesh.creation.box((0.56, 0.46, 1.76))
    inner.invert()
    outer.faces[::3] = outer.faces[::3, ::-1]
    surface = dominant_surface(tri_mesh(trimesh.util.concatenate([outer, inner])), up=(0.0, 0.0, 1.0))
    assert edges(surface) == pytest.approx([1.8, 0.6, 0.02])


@pytest.mark.parametrize("again", [shuffled_with_backs, partly_turned])
def test_a_cavity_of_mixed_winding_stays_a_cavity(again: Callable[[TriMesh], TriMesh]) -> None:
    outer, inner = trimesh.creation.box((0.6, 0.5, 1.8)), trimesh.creation.box((0.56, 0.46, 1.76))
    inner.invert()
    surface = dominant_surface(again(tri_mesh(trimesh.util.concatenate([outer, inner]))), up=(0.0, 0.0, 1.0))
    assert edges(surface) == pytest.approx([1.8, 0.6, 0.02])


def test_a_sheet_with_two_sides_beside_a_solid_keeps_both() -> None:
    block = Box((1.0, 0.6, 0.05)).mesh
    sheet = np.array([[-0.5, -0.3, 0.1], [0.5, -0.3, 0.1], [0.5, 0.3, 0.1], [-0.5, 0.3, 0.1]])
    both = np.array([[0, 1, 2], [0, 2, 3], [2, 1, 0], [3, 2, 0]]) + 8
    faces = partly_turned(block).faces
    mesh = TriMesh(np.concatenate((block.vertices_m, sheet)), np.concatenate((faces, both)))
    assert len(wound(mesh)) == 12 + 4
    assert edges(dominant_surface(mesh, up=(0.0, 0.0, 1.0))) == pytest.approx([1.0, 0.6, 0.05])


def test_the_wall_between_two_solids_keeps_both_sides() -> None:
    """Two blocks on each other, welded: four triangles share each edge of the face between them."""
    mesh = tri_mesh(boxes(((1.0, 0.6, 0.05), (0.0, 0.0, 0.0)), ((1.0, 0.6, 0.05), (0.0, 0.0, 0.05))))
    assert len(wound(mesh)) == len(mesh.faces)
    assert edges(dominant_surface(mesh, up=(0.0, 0.0, 1.0))) == pytest.approx([1.0, 0.6, 0.1])


def test_solids_that_share_a_face_of_one_winding_keep_it_twice() -> None:
    body, lid = Box((1.0, 0.6, 0.3)), Box((1.0, 0.6, 0.04))
    flush = lid.mesh.vertices_m + np.array((0.0, 0.0, (0.3 - 0.04) / 2))
    both = TriMesh(np.concatenate((body.mesh.vertices_m, flush)), np.concatenate((body.mesh.faces, lid.mesh.faces + 8)))
    found = dominant_surface(both, up=(0.0, 0.0, 1.0))
    assert edges(found) == pytest.approx([1.0, 0.6, 0.3], abs=2e-5)
    assert found.flags == ()


def test_meshes_without_area_are_left_alone() -> None:
    needle = TriMesh([[0, 0, 0], [1, 0, 0], [2, 0, 0]], [[0, 0, 1], [0, 0, 1], [2, 2, 2]])
    np.testing.assert_array_equal(wound(needle), needle.faces)
    point = TriMesh([[1, 1, 1]] * 3, [[0, 1, 2]])
    np.testing.assert_array_equal(wound(point), point.faces)


def test_a_moebius_strip_has_no_winding_and_is_measured() -> None:
    turn = np.linspace(0.0, 2 * np.pi, 24, endpoint=False)
    rim = [
        [(1 + s * np.cos(t / 2)) * np.cos(t), (1 + s * np.cos(t / 2)) * np.sin(t), s * np.sin(t / 2)]
        for t in turn
        for s in (-0.2, 0.2)
    ]
    n = len(rim)
    quads = [(2 * k, 2 * k + 1, 2 * k + 3, 2 * k + 2) for k in range(23)] + [(n - 2, n - 1, 0, 1)]
    mesh = TriMesh(rim, [face for a, b, c, d in quads for face in ((a, b, c), (a, c, d))])
    assert len(wound(mesh)) == len(mesh.faces)
    assert dominant_surface(mesh).length_m == pytest.approx(2.0, rel=0.05)
