"""How many couples fall at once, against one couple at a time by boxes and triangles."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from contact_scenes import box, boxes
from scene2hap.contact import falls_together
from scene2hap.contact.body import Body, shape_of
from scene2hap.contact.fall import falls, first_fall_m
from scene2hap.contact.falls_together import are_few, falls_of
from scene2hap.contact.narrow import Meeting
from scene2hap.contact.support import TOUCH_M
from scene2hap.scene.pose import Pose

SHAPES = [
    box("crate", (0.3, 0.2, 0.25), (0, 0, 0)),
    box("plate", (0.4, 0.01, 0.3), (0, 0, 0)),
    boxes(
        "stool", ((0.4, 0.04, 0.4), (0, 0.2, 0)), ((0.05, 0.4, 0.05), (-0.15, 0, 0)), ((0.05, 0.4, 0.05), (0.15, 0, 0))
    ),
]


def heap(seed: int, up_axis: int) -> list[Body]:
    """Things on, in and over each other, leaning every way."""
    rng = np.random.default_rng(seed)
    found = []
    for k in range(7):
        place, turn = rng.uniform(-0.25, 0.25, 3), rng.normal(size=4)
        if k % 3 == 0:
            turn[:3] *= 0.02
        pose = Pose(tuple(place.tolist()), tuple(turn.tolist()))
        found.append(Body(f"x{k}", shape_of(SHAPES[k % 3].geometry.mesh), pose, up_axis))
    return found


def couples_of(bodies: list[Body]) -> list[tuple[Body, Body]]:
    return [(x, y) for x in bodies for y in bodies if x is not y]


@pytest.mark.parametrize("up_axis", [1, 2])
@given(seed=st.integers(0, 10**6))
@settings(derandomize=True, deadline=None, max_examples=25)
def test_each_couple_falls_as_it_does_by_itself(up_axis: int, seed: int) -> None:
    couples, n_counted = couples_of(heap(seed, up_axis)), []
    assert all(are_few(*couple) for couple in couples)
    for (faller, other), together in zip(couples, falls_of(couples), strict=True):
        alone = falls(Meeting(faller, other), faller, other)
        assert (together is None) == (alone is None)
        if together is None or alone is None:
            continue
        first_m = float(together.min())
        assert first_fall_m(Meeting(faller, other), faller, other) == pytest.approx(first_m, abs=1e-9)
        # What falls farther does not count, and may be told as inf.
        counts = np.minimum(together, alone) < first_m + TOUCH_M - 1e-9
        np.testing.assert_allclose(together[counts], alone[counts], atol=1e-9)
        n_counted.append(int(counts.sum()))
    assert sum(n_counted) > 5


@given(seed=st.integers(0, 10**6), at_once=st.sampled_from([1, 500, 10**6]))
@settings(derandomize=True, deadline=None, max_examples=25)
def test_an_answer_does_not_depend_on_the_others(seed: int, at_once: int) -> None:
    couples = couples_of(heap(seed, 1))
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(falls_together, "_AT_ONCE", at_once)
        together = falls_of(couples)
    for couple, told in zip(couples, together, strict=True):
        (alone,) = falls_of([couple])
        assert (told is None) == (alone is None)
        if told is not None and alone is not None:
            assert told.tolist() == alone.tolist()


def test_what_has_many_triangles_is_left_to_boxes() -> None:
    crate = Body.of(SHAPES[0], 1)
    many = Body.of(boxes("rail", *(((0.01, 0.01, 0.01), (0.02 * k, 0, 0)) for k in range(40))), 1)
    assert are_few(crate, crate)
    assert not are_few(crate, many)
    assert falls_of([]) == []
