"""Two fields as one: the newest, which knows some objects, and the last that knows all."""

from collections.abc import Sequence

import numpy as np

from scene2hap.propagation.live import TouchedPoint
from scene2hap.session.noted_field import NotedField

HERE = (0.0, 0.0, 0.0)
SOURCES = ("a", "b")


class Constant:
    """Says the same of every hand that touches anything."""

    source_ids, most = SOURCES, 1.0

    def __init__(self, gain: float) -> None:
        self.gain = gain

    def strongest(self, hands: Sequence[Sequence[TouchedPoint]]) -> np.ndarray:
        return np.array([np.full((len(SOURCES), 1), self.gain if hand else 0.0) for hand in hands])


def gains(covers: set[str] | None, *hands: Sequence[str]) -> list[float]:
    field = NotedField(Constant(0.5), covers, Constant(0.25), lambda touched: None)
    return field.strongest([[(name, HERE) for name in hand] for hand in hands])[:, 0, 0].tolist()


def test_what_the_newest_does_not_cover_is_asked_of_the_whole() -> None:
    assert gains({"table"}, ["table"], ["shelf"], [], ["shelf", "table"]) == [0.5, 0.25, 0.0, 0.5]


def test_the_newest_alone_is_asked_where_it_covers_everything() -> None:
    assert gains(None, ["table"], ["shelf"]) == [0.5, 0.5]
    assert gains({"table", "shelf"}, ["table"], ["shelf"]) == [0.5, 0.5]


def test_what_is_touched_is_noted() -> None:
    noted: list[Sequence[TouchedPoint]] = []
    NotedField(Constant(0.5), None, Constant(0.25), noted.append).strongest([[("table", HERE)], [("shelf", HERE)]])
    assert noted == [[("table", HERE), ("shelf", HERE)]]
