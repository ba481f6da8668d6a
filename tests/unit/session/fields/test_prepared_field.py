"""A field in two parts: the newest, which covers some objects, and the last that covers all."""

from collections.abc import Collection, Sequence

import numpy as np
import pytest
from numpy.typing import ArrayLike

from scene2hap.haptics import Bands
from scene2hap.propagation.live import TouchedPoint
from scene2hap.session.fields.prepared import FieldInUse
from scene2hap.session.fields.worker import FieldRequest, PreparedField
from scene2hap.session.present_scene.scene_state import ModelInput

HERE = (0.0, 0.0, 0.0)
SOURCES = ("a", "b")


class Constant:
    """A field with the same gain for every hand that touches anything."""

    source_ids, bands, most = SOURCES, Bands.dominant(), 1.0

    def __init__(self, gain: float) -> None:
        self.gain = gain

    def attenuation(self, object_id: str, points_m: ArrayLike) -> np.ndarray:
        return np.full((len(np.asarray(points_m)), len(SOURCES), 1), self.gain)

    def strongest(self, hands: Sequence[Sequence[TouchedPoint]]) -> np.ndarray:
        return np.array([np.full((len(SOURCES), 1), self.gain if hand else 0.0) for hand in hands])


def prepared(gain: float, covers: Collection[str] | None = None) -> PreparedField:
    def told(near: Collection[str]) -> ModelInput:
        pytest.fail("is prepared already")

    return PreparedField(Constant(gain), FieldRequest(0, told, (), {}, 0.0), covers)


def as_now(one: PreparedField) -> Constant:
    assert isinstance(one.field, Constant)
    return one.field


def gains(field: FieldInUse, *hands: Sequence[str]) -> list[float]:
    return field.strongest([[(name, HERE) for name in hand] for hand in hands])[:, 0, 0].tolist()


def test_objects_outside_the_newest_field_use_the_whole_field() -> None:
    field = FieldInUse(SOURCES, as_now, lambda touched: None)
    field.use(prepared(0.5, {"table"}), prepared(0.25))
    assert gains(field, ["table"], ["shelf"], [], ["shelf", "table"]) == [0.5, 0.25, 0.0, 0.5]


@pytest.mark.parametrize("covers", [None, {"table", "shelf"}])
def test_newest_field_is_used_alone_when_it_covers_all_objects(covers: set[str] | None) -> None:
    field = FieldInUse(SOURCES, as_now, lambda touched: None)
    field.use(prepared(0.5, covers), prepared(0.25))
    assert gains(field, ["table"], ["shelf"]) == [0.5, 0.5]


def test_fields_can_be_replaced() -> None:
    field, whole, newest = FieldInUse(SOURCES, as_now, lambda touched: None), prepared(0.25), prepared(0.75)
    field.use(prepared(0.5, {"table"}), whole)
    field.use(prepared(0.6, {"shelf"}), whole)
    assert gains(field, ["table"], ["shelf"]) == [0.25, 0.6]
    field.use(newest, newest)
    assert gains(field, ["table"], ["shelf"]) == [0.75, 0.75]
    field.use(prepared(0.5, {"table"}), newest)
    assert gains(field, ["table"], ["shelf"]) == [0.5, 0.75]


def test_touched_points_are_recorded() -> None:
    noted: list[Sequence[TouchedPoint]] = []
    field, whole = FieldInUse(SOURCES, as_now, noted.append), prepared(0.25)
    field.use(whole, whole)
    field.strongest([[("table", HERE)], [("shelf", HERE)]])
    assert noted == [[("table", HERE), ("shelf", HERE)]]
