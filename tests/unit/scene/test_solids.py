"""Primitives as triangle meshes: closed, facing outwards, and of the right size."""

from __future__ import annotations

import numpy as np
import pytest

from scene2hap.scene import solids

SHAPES = {
    "box": (solids.box((0.1, 0.2, 0.3)), 8 * 0.1 * 0.2 * 0.3, (0.1, 0.2, 0.3)),
    "sphere": (solids.ellipsoid((0.5, 0.5, 0.5)), 4 / 3 * np.pi * 0.5**3, (0.5, 0.5, 0.5)),
    "ellipsoid": (solids.ellipsoid((0.1, 0.2, 0.4)), 4 / 3 * np.pi * 0.1 * 0.2 * 0.4, (0.1, 0.2, 0.4)),
    "cylinder": (solids.cylinder(0.2, 0.7), np.pi * 0.2**2 * 1.4, (0.2, 0.2, 0.7)),
    "capsule": (solids.capsule(0.2, 0.7), np.pi * 0.2**2 * 1.4 + 4 / 3 * np.pi * 0.2**3, (0.2, 0.2, 0.9)),
    "pill": (solids.capsule(0.2, 0.0), 4 / 3 * np.pi * 0.2**3, (0.2, 0.2, 0.2)),
}


@pytest.mark.parametrize("name", SHAPES)
def test_solids_are_closed_and_face_outwards(name: str) -> None:
    (vertices, faces), volume, half = SHAPES[name]
    edges = [(int(a), int(b)) for face in faces for a, b in zip(face, np.roll(face, -1), strict=True)]
    # Every edge occurs once in each direction: there is no hole and no inverted face.
    assert len(set(edges)) == len(edges)
    assert {(b, a) for a, b in edges} == set(edges)
    a, b, c = np.moveaxis(vertices[faces], 1, 0)
    found = np.einsum("ij,ij->", a, np.cross(b, c)) / 6
    # A 32-gon covers sin(2 pi / 32) / (2 pi / 32) = 0.9936 of its circle; a sphere loses about twice as much.
    assert 0.98 * volume < found <= volume * (1 + 1e-9)
    np.testing.assert_allclose(np.abs(vertices).max(axis=0), half, rtol=1e-12)
    np.testing.assert_allclose(vertices.min(axis=0), -np.array(half), rtol=1e-12)


def test_a_sheet_faces_up() -> None:
    vertices, faces = solids.rectangle(2.0, 3.0)
    a, b, c = np.moveaxis(vertices[faces], 1, 0)
    np.testing.assert_array_equal(np.cross(b - a, c - a), [[0, 0, 24.0]] * 2)
    assert np.ptp(vertices, axis=0).tolist() == [4.0, 6.0, 0.0]


def test_terrain_has_rows_along_y() -> None:
    heights = np.array([[0.0, 1.0, 2.0], [3.0, 4.0, 5.0]])
    vertices, faces = solids.terrain(heights, half_x_m=1.0, half_y_m=2.0)
    at = {(x, y): z for x, y, z in vertices.tolist()}
    assert at == {(-1, -2): 0, (0, -2): 1, (1, -2): 2, (-1, 2): 3, (0, 2): 4, (1, 2): 5}
    assert len(faces) == 4
    a, b, c = np.moveaxis(vertices[faces], 1, 0)
    assert (np.cross(b - a, c - a)[:, 2] > 0).all()
