"""Frame layouts: the numbers of objects in frames while objects are added and removed."""

import pytest

from scene2hap.bridge.frame_layout import N_KEPT, Layouts
from scene2hap.errors import BridgeError, UnknownObject


def test_moving_objects_come_first_in_the_client_s_order() -> None:
    layout = Layouts().change(["c", "a"], ["a", "b", "c", "d"], ("left",), ("a",))
    assert (layout.number, layout.objects, layout.moving) == (1, ("c", "a", "b", "d"), ("c", "a"))


def test_frames_of_recent_layouts_are_accepted() -> None:
    layouts = Layouts()
    for k in range(N_KEPT + 2):
        layouts.change(["a"], ["a", *map(str, range(k))], ("left",), ())
    assert layouts.now.number == N_KEPT + 2
    assert [layouts.of(k) is not None for k in range(N_KEPT + 4)] == [False] * 3 + [True] * N_KEPT + [False]
    old = layouts.of(3)
    assert old is not None
    assert old.objects == ("a", "0", "1")


def test_layout_numbers_wrap_at_sixteen_bits() -> None:
    layouts = Layouts()
    for _ in range(0x10000):
        layouts.change([], ["a"], ("left",), ())
    assert layouts.now.number == 1
    assert layouts.of(0xFFFF) is not None
    assert layouts.of(0) is None


def test_unknown_and_duplicate_moving_objects_are_refused() -> None:
    with pytest.raises(UnknownObject, match="did you mean 'phone'|Did you mean 'phone'"):
        Layouts().change(["fone"], ["phone"], ("left",), ())
    with pytest.raises(BridgeError, match="twice"):
        Layouts().change(["a", "a"], ["a"], ("left",), ())
