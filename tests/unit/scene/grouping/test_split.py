"""Whether the boxes of a group's items form one set or several."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from scene2hap.scene.geometry import distances, joined
from scene2hap.scene.grouping import split
from scene2hap.scene.grouping.split import Member, stand_apart
from scene2hap.scene.tree import Piece


def member(low: Any, high: Any) -> Member:
    corners = np.array([low, high, low], dtype=np.float64)
    return Member("", np.eye(4), (Piece(0, corners, np.array([[0, 1, 2]], dtype=np.int32)),))


def are_several_sets(members: list[Member], gap: float) -> bool:
    boxes = np.array([one.box for one in members])
    near = distances(boxes[:, None], boxes) <= gap * np.linalg.norm(np.ptp(joined(boxes), axis=0))
    linked = np.linalg.matrix_power(near.astype(float), 32) > 0
    return not bool(linked[0].all())


@pytest.mark.parametrize("gap", [0.1, 0.15, 0.2])
@pytest.mark.parametrize("seed", range(20))
def test_sets_are_those_of_all_pairs(seed: int, gap: float) -> None:
    random = np.random.default_rng(seed)
    low = random.uniform(-1, 1, (20, 3)) * (1.0, 0.1, 0.4)
    high = low + random.choice([0.02, 0.2, 1.0], (20, 1), p=[0.5, 0.45, 0.05]) * random.uniform(0, 1, (20, 3))
    members = [member(*corners) for corners in zip(low, high, strict=True)]
    assert stand_apart(members, members, gap=gap) == are_several_sets(members, gap)


@pytest.mark.parametrize("is_broken", [False, True])
def test_a_long_row_is_not_compared_box_by_box(is_broken: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    n_compared = 0

    def counted(boxes: Any, one: Any) -> Any:
        nonlocal n_compared
        n_compared += len(boxes)
        return distances(boxes, one)

    monkeypatch.setattr(split, "distances", counted)
    places = np.random.default_rng(0).permutation(2000)
    row = [member((x, 0.0, 0.0), (x + 1.0, 1.0, 1.0)) for x in places + 500 * is_broken * (places > 999)]
    assert stand_apart(row, row) == is_broken
    assert n_compared < 10 * len(row)  # all pairs are 2 million
