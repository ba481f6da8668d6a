import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from scene2hap.contact.geometry import boxes as module
from scene2hap.contact.geometry.boxes import Boxes, box_pairs


def random_boxes(rng: np.random.Generator, n: int) -> Boxes:
    # Integers, so that many boxes touch exactly.
    low = rng.integers(0, 12, size=(3, n)).astype(float)
    return Boxes(low, low + rng.integers(0, 4, size=(3, n)))


def all_with_all(a: Boxes, b: Boxes) -> set[tuple[int, int]]:
    return {
        (i, j)
        for i in range(a.low.shape[1])
        for j in range(b.low.shape[1])
        if (a.low[:, i] <= b.high[:, j]).all() and (b.low[:, j] <= a.high[:, i]).all()
    }


@given(
    rows=st.integers(1, 30),
    seed=st.integers(0, 10**6),
    n=st.integers(0, 25),
    m=st.integers(0, 25),
    chunk=st.integers(1, 40),
)
@settings(max_examples=120)
def test_pairs_are_those_of_comparing_all_with_all_each_once(rows: int, seed: int, n: int, m: int, chunk: int) -> None:
    rng = np.random.default_rng(seed)
    a, b = random_boxes(rng, n), random_boxes(rng, m)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(module, "_ROWS", rows)
        patch.setattr(module, "_CHUNK", chunk)
        found = [(int(x), int(y)) for i, j in box_pairs(a, b) for x, y in zip(i, j, strict=True)]
    assert len(found) == len(set(found))
    assert set(found) == all_with_all(a, b)


def test_chunks_are_bounded() -> None:
    rng = np.random.default_rng(3)
    a = random_boxes(rng, 300)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(module, "_CHUNK", 1000)
        sizes = [len(i) for i, _ in box_pairs(a, a)]
    assert sum(sizes) > 2000
    assert max(sizes) <= 1000


def test_meeting_finds_the_boxes_that_overlap_one() -> None:
    rng = np.random.default_rng(5)
    boxes, one = random_boxes(rng, 200), random_boxes(rng, 1)
    expected = [i for i, _ in sorted(all_with_all(boxes, one))]
    assert len(expected) > 3
    assert boxes.meeting(one).tolist() == expected
