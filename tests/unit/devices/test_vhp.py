"""Frames for VHP boards, against bytes computed by hand from docs/serial-protocol.md."""

import numpy as np
import pytest
from hypothesis import given, strategies as st

from scene2hap.devices.framing import vhp
from scene2hap.devices.vhp_amp import VhpLine
from scene2hap.errors import DeviceError


def test_slim_frame_equals_one_worked_by_hand() -> None:
    block = np.zeros((8, 2), dtype=np.float32)
    block[0] = 1.0, -1.0
    block[1, 1] = 0.5
    rest = [0x80] * 10
    by_hand = [0xC8, 0xC9, 0x11, 0x80, 0xFF, 0x01, *rest, 0x80, 0xC0, *rest] + [0x80] * 72
    assert vhp.slim_frame(block) == bytes(by_hand)
    assert len(vhp.slim_frame(block)) == 100


def test_sleeve_packets_equal_those_worked_by_hand() -> None:
    packet = vhp.sleeve_packet(np.zeros((8, 12), dtype=np.float32))
    assert packet == bytes([200, 3, 17, 96, *[128] * 96, *[0] * 32])
    amplifiers = vhp.packet(vhp.Message(vhp.MessageType.ENABLE_AMPLIFIERS, recipient=vhp.Recipient.ALL))
    assert amplifiers == bytes([200, 1, 15, 0, *[0] * 128])


@given(st.lists(st.integers(-127, 127), min_size=96, max_size=96))
def test_a_sample_is_its_level_about_the_middle(levels: list[int]) -> None:
    block = (np.array(levels).reshape(8, 12) / 127).astype(np.float32)
    assert vhp.to_bytes(block) == bytes(128 + level for level in levels)


def test_blocks_and_messages_of_wrong_size_are_refused() -> None:
    for shape in ((7, 2), (8, 13), (8,)):
        with pytest.raises(DeviceError, match="blocks of"):
            vhp.to_bytes(np.zeros(shape, dtype=np.float32))
    with pytest.raises(DeviceError, match="at most 128"):
        vhp.Message(1, b"x" * 129)


def test_a_board_that_was_never_reached_is_left_without_an_error() -> None:
    line = VhpLine("/dev/none", slim=True)
    line.disconnect()
    line.disconnect()
