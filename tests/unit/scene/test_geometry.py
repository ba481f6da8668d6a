"""Bounds of points, joined bounds and distances of boxes, against values found by hand."""

import numpy as np
import pytest

from scene2hap.scene.geometry import bounds_of, distances, joined, welded

UNIT = np.array([[0.0, 0.0, 0.0], [1.0, 1.0, 1.0]])


def test_bounds_are_the_lowest_and_highest_corner() -> None:
    assert bounds_of([[0, 5], [2, 3], [1, 4]]).tolist() == [[0, 3], [2, 5]]
    assert joined([[[0, 3], [2, 5]], [[-1, 4], [1, 9]]]).tolist() == [[-1, 3], [2, 9]]


@pytest.mark.parametrize(
    ("offset", "distance"),
    [((0.5, 0, 0), 0), ((1, 0, 0), 0), ((-3, 0, 0), 2), ((4, 5, 0.5), 5), ((0, 4, -5), 5), ((3, 3, 2), 3)],
)
def test_the_distance_is_that_of_the_nearest_points(offset: tuple[float, ...], distance: float) -> None:
    assert distances(UNIT, UNIT + offset) == pytest.approx(distance)
    assert distances(UNIT + offset, UNIT) == pytest.approx(distance)


def test_distances_of_many_boxes_are_broadcast() -> None:
    boxes = np.stack([UNIT, UNIT + 2.0, UNIT + np.array([0, 0, 5])])
    assert distances(boxes[:, None], boxes).shape == (3, 3)
    assert distances(boxes, boxes[0]).tolist() == pytest.approx([0, 3**0.5, 4])


def test_points_of_one_cell_are_one_place_however_far_the_cells_extend() -> None:
    corners = np.array([[x, y, z] for x in (-1.0, 1.0) for y in (-1.0, 1.0) for z in (-1.0, 1.0)])
    numbers = welded(np.concatenate([corners, corners[::-1] + 1e-7]), 1e-6)
    assert numbers.tolist() == [*range(8), *reversed(range(8))]
    assert welded(corners[:, :2], 1e-6).tolist() == [0, 0, 1, 1, 2, 2, 3, 3]


def test_points_without_an_extent_are_one_place() -> None:
    assert welded(np.full((3, 3), 7.0), 0.0).tolist() == [0, 0, 0]
