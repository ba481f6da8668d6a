"""Validation of points given by callers, and the cost of reaching them."""

import tracemalloc

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from scene2hap.errors import ModelDomainError
from scene2hap.propagation.paths.prepared_paths import Arrivals, arrivals_at
from scene2hap.propagation.points import InRectangle, as_points
from scene2hap.scene.pose import Pose

INF, NAN = float("inf"), float("nan")


@pytest.mark.parametrize("bad", [[INF, -INF, 0.0], [NAN, 0.0, 0.0], [[0.0, 1.0, 2.0], [0.0, 0.0, INF]]])
def test_non_finite_points_are_refused_without_a_numpy_warning(bad: object) -> None:
    with pytest.raises(ModelDomainError, match="not finite"):
        as_points(bad, 3)


def test_coordinates_whose_squares_overflow_are_accepted() -> None:
    np.testing.assert_array_equal(as_points([1e200, -1e200, 0.0], 3), [[1e200, -1e200, 0.0]])


@pytest.mark.parametrize("bad", [[1.0, 2.0], [[[1.0, 2.0, 3.0]]], 4.0])
def test_points_of_wrong_shape_are_refused(bad: object) -> None:
    with pytest.raises(ModelDomainError, match="must be"):
        as_points(bad, 3)


@pytest.mark.parametrize("n", [0, 1, 7])
def test_points_beside_a_rectangle_go_to_its_nearest_edge(n: int) -> None:
    rng = np.random.default_rng(n)
    corner_m, turn = rng.normal(size=3), Rotation.random(rng=rng)
    points = rng.normal(size=(n, 3))
    own = turn.inv().apply(points - corner_m) if n else points
    nearest = np.stack([np.clip(own[:, 0], 0.0, 0.8), np.clip(own[:, 1], 0.0, 0.5)], axis=1)
    rectangle = InRectangle(Pose(tuple(corner_m.tolist()), tuple(turn.as_quat().tolist())), 0.8, 0.5)
    np.testing.assert_allclose(rectangle(points), nearest, atol=1e-14)


def test_a_map_of_many_points_needs_little_memory_and_gives_the_costs_of_single_points() -> None:
    """An array over all points, sources and contacts would have 40 MB here."""
    rng = np.random.default_rng(1)
    sources = tuple(f"s{i}" for i in range(50))
    arrived = Arrivals(rng.uniform(0, 9, (200, 3)), rng.uniform(0, 9, (50, 200)))
    points_m = rng.uniform(0, 9, (500, 3))
    tracemalloc.start()
    try:
        costs = arrivals_at({"floor": arrived}, {"floor": 0.5}, sources, "floor", points_m)
        _, peak = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert peak < 20e6
    for k in (0, 104, 499):
        apart_m = np.linalg.norm(arrived.points_m - points_m[k], axis=1)
        np.testing.assert_allclose(costs[k], (arrived.costs + 0.5 * apart_m).min(axis=1), rtol=1e-12)
