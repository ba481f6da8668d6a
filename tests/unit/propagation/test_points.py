"""Validation of points given by callers."""

import numpy as np
import pytest

from scene2hap.errors import ModelDomainError
from scene2hap.propagation.points import as_points

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
