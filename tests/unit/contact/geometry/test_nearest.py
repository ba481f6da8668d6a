"""The nearest points of triangles: compared with trimesh, and the side of a point with the winding number."""

import numpy as np
import pytest
import trimesh

from scene2hap.contact.geometry.triangles import nearest_points

SOLIDS = {
    "box": trimesh.creation.box((0.4, 0.2, 0.03)),
    "sphere": trimesh.creation.icosphere(1, 0.2),
    "torus": trimesh.creation.torus(0.2, 0.05, major_sections=12, minor_sections=8),
    "cone": trimesh.creation.cone(0.1, 0.4, sections=7),
}


def winding_number(triangles: np.ndarray, point: np.ndarray) -> float:
    """Number of times a closed surface winds around a point, 1 inside (van Oosterom and Strackee 1983)."""
    a, b, c = np.moveaxis(triangles - point, 1, 0)
    la, lb, lc = (np.linalg.norm(x, axis=1) for x in (a, b, c))
    over = (a * np.cross(b, c)).sum(axis=1)
    under = la * lb * lc + (a * b).sum(axis=1) * lc + (b * c).sum(axis=1) * la + (c * a).sum(axis=1) * lb
    return float(np.arctan2(over, under).sum() / (2 * np.pi))


@pytest.mark.parametrize("name", SOLIDS)
def test_nearest_points_equal_those_of_trimesh(name: str) -> None:
    corners = SOLIDS[name].triangles
    points = np.random.default_rng(1).uniform(-0.35, 0.35, (60, 3))
    for point in points:
        at_each = np.repeat(point[None], len(corners), axis=0)
        found = nearest_points(at_each.T, corners.transpose(2, 1, 0))
        expected = trimesh.triangles.closest_point(corners, at_each)
        np.testing.assert_allclose(found.points.T, expected, atol=1e-12)
        np.testing.assert_allclose(found.distances, np.linalg.norm(expected - point, axis=1), atol=1e-12)


@pytest.mark.parametrize("name", SOLIDS)
def test_the_steepest_of_the_nearest_faces_tells_the_side(name: str) -> None:
    corners = SOLIDS[name].triangles
    sides = []
    for point in np.random.default_rng(2).uniform(-0.25, 0.25, (300, 3)):
        found = nearest_points(np.repeat(point[:, None], len(corners), axis=1), corners.transpose(2, 1, 0))
        equal = found.distances <= found.distances.min() * (1 + 1e-9)
        height = max(found.heights[equal].tolist(), key=abs)
        sides.append(height < 0)
        assert (height < 0) == (winding_number(corners, point) > 0.5)
    assert 0 < sum(sides) < len(sides)


def test_triangle_without_area_is_a_line() -> None:
    line = np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 0.0, 0.0]]).T[..., None]
    found = nearest_points(np.array([[0.5], [0.2], [0.0]]), line)
    assert found.distances.tolist() == [0.2]
    assert found.heights.tolist() == [0.0]
    assert found.points.T.tolist() == [[0.5, 0.0, 0.0]]
