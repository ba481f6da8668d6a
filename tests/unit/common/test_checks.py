"""Checks of numbers against bounds, and their error messages."""

import math
from fractions import Fraction

import numpy as np
import pytest

from scene2hap.common import checks
from scene2hap.errors import MaterialError, SceneError


@pytest.mark.parametrize("value", [1, 1.0, np.float32(1), np.int64(1), Fraction(1)])
def test_any_real_number_becomes_a_float(value: object) -> None:
    result = checks.number("x", value, "m", error=MaterialError)
    assert type(result) is float
    assert result == 1.0


@pytest.mark.parametrize(
    ("value", "bounds", "sentence"),
    [
        (-1.0, {"above": 0.0}, "density is -1 kg/m3; it must be above 0.0 [kg/m3]."),
        (0.0, {"above": 0.0}, "density is 0 kg/m3; it must be above 0.0 [kg/m3]."),
        (0.5, {"below": 0.5}, "density is 0.5 kg/m3; it must be below 0.5 [kg/m3]."),
        (3.0, {"at_most": 2.0}, "density is 3 kg/m3; it must be at most 2.0 [kg/m3]."),
        (-1.0, {"at_least": 0.0}, "density is -1 kg/m3; it must be at least 0.0 [kg/m3]."),
        (math.nan, {}, "density is nan kg/m3; it must be finite [kg/m3]."),
        (math.inf, {"above": 0.0}, "density is inf kg/m3; it must be finite [kg/m3]."),
        ("7", {}, "density is '7'; it must be a number [kg/m3]."),
        (True, {}, "density is True; it must be a number [kg/m3]."),
        (None, {}, "density is None; it must be a number [kg/m3]."),
    ],
)
def test_error_out_of_bounds_states_value_unit_and_bound(
    value: object, bounds: dict[str, float], sentence: str
) -> None:
    with pytest.raises(MaterialError) as caught:
        checks.number("density", value, "kg/m3", error=MaterialError, **bounds)
    assert str(caught.value) == sentence


def test_hint_ends_the_sentence() -> None:
    with pytest.raises(MaterialError, match=r"above 0\.0 \[m\]\. Measure again\.$"):
        checks.number("x", -1, "m", above=0.0, error=MaterialError, hint="Measure again.")


@pytest.mark.parametrize("value", [(1, 2), (1, 2, 3, 4), 5, "abc", None])
def test_vector_of_the_wrong_size(value: object) -> None:
    with pytest.raises(MaterialError, match="it must be 3 numbers"):
        checks.vector("point", value, "m", size=3, error=MaterialError)


def test_vector_names_the_component() -> None:
    with pytest.raises(MaterialError, match=r"point\[1\] is nan m"):
        checks.vector("point", (0, math.nan, 0), "m", size=3, error=MaterialError)


@pytest.mark.parametrize("given", [None, 3, "cup", {"cup": 1}, "cups", ["cup"], [1, "cup"], b"cup", object()])
def test_items_of_one_type(given: object) -> None:
    with pytest.raises(SceneError, match=r"^sizes (is|has) .*; it must be a list of float\.$"):
        checks.instances("sizes", given, float, "a list of float", error=SceneError)


def test_items_are_at_most_a_number() -> None:
    assert checks.items("sizes", (1, 2, 3), at_most=3, error=SceneError) == (1, 2, 3)
    for given in ((1, 2, 3, 4), iter([1, 2, 3, 4])):
        with pytest.raises(SceneError, match="sizes.* 3"):
            checks.items("sizes", given, at_most=3, error=SceneError)


def test_one_item_without_its_list_is_an_error() -> None:
    with pytest.raises(SceneError, match=r"sizes is 1\.5; it must be a list of float"):
        checks.instances("sizes", 1.5, float, "a list of float", error=SceneError)
    assert checks.instances("sizes", iter([1.5, 2.5]), float, "a list of float", error=SceneError) == (1.5, 2.5)
    assert checks.instances("sizes", (), float, "a list of float", error=SceneError) == ()


def test_an_empty_text_is_no_path() -> None:
    with pytest.raises(SceneError, match="folder is ''; it must be the path of a file or folder. Name one."):
        checks.path("folder", "", error=SceneError, hint="Name one.")
