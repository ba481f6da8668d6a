"""Arrays that users and files give."""

from contextvars import copy_context
from fractions import Fraction
from typing import NamedTuple

import numpy as np
import pytest

from scene2hap.common import checks
from scene2hap.common.arrays import floats
from scene2hap.errors import SceneError


class Point(NamedTuple):
    x: float | None
    y: float
    z: float


class Pair(NamedTuple):
    x: float
    y: float


@pytest.mark.parametrize(
    ("value", "reason"),
    [
        ([[0.0, 1.0, True]], "it has True"),
        ([[0.0, np.True_, 1.0]], "it has a bool"),
        ([[0.0, None, 1.0]], "it has None"),
        ([["1", 0, 0]], "it has '1'"),
        ([[0, 0, 0], [1, 1]], "its rows are not equally long"),
        ([0.0, [1.0]], "its rows are not equally long"),
        ([{"x": 0}], "it has a dict"),
        (None, "it has None"),
        (np.array([True]), "bool is no type of real numbers"),
        (np.array([[0.0, None]], dtype=object), "it has None"),
        (np.array([True, 1.0], dtype=object), "it has True"),
        (np.array(["1"], dtype=object), "it has '1'"),
        ([np.array([0.0, None]), [1.0, 2.0]], "it has None"),
        ([Point(None, 0.0, 0.0), Point(1.0, 0.0, 0.0)], "it has None"),
        ([Point(True, 0.0, 0.0)], "it has True"),
        ([Point(0.0, 0.0, 0.0), [1.0, 2.0]], "its rows are not equally long"),
    ],
)
def test_what_is_no_number_is_refused(value: object, reason: str) -> None:
    with pytest.raises(SceneError, match=f"points is not a table of numbers \\[m\\]: {reason}"):
        floats("points", value, "m", error=SceneError)


def test_a_list_that_holds_itself_is_refused() -> None:
    endless: list[object] = []
    endless.append(endless)
    with pytest.raises(SceneError, match="its lists are nested too deeply"):
        floats("points", endless, "m", error=SceneError)


@pytest.mark.parametrize(
    "value",
    [
        [[1, 2.0], (3, np.float32(4))],
        np.array([[1, Fraction(2)], [3, 4.0]], dtype=object),
        [Pair(1, 2), [3, 4]],
        [[1, 2], np.array([3, 4])],
        [np.array([1, 2]), [3, 4]],
        [[], []],
    ],
)
def test_lists_of_numbers_and_arrays_are_taken(value: list[object]) -> None:
    found = floats("points", value, "m", error=SceneError)
    np.testing.assert_array_equal(found, np.array([[1, 2], [3, 4]])[:, : found.shape[1]])


def test_values_are_written_as_json_for_those_who_sent_json() -> None:
    def of_a_client() -> list[str]:
        checks.speak_json()
        return [checks.shown(x) for x in (None, True, [1.5, None], {"a": None}, float("nan"))] + [checks.described({})]

    said = copy_context().run(of_a_client)
    assert said == ["null", "true", "[1.5, null]", "{'a': null}", "NaN", "an object"]
    assert checks.shown(None) == "None"  # elsewhere nothing changes
