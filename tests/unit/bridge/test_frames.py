"""Binary messages: the examples of docs/bridge-protocol.md byte by byte, and arbitrary bytes."""

import contextlib
import re
import struct
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, strategies as st

from bridge_frames import decode_gains, encode_frame, encode_picture
from scene2hap.bridge.frames import (
    Gains,
    decode_frame,
    decode_picture,
    encode_gains,
)
from scene2hap.errors import BridgeError

PAGE = (Path(__file__).parents[3] / "docs" / "bridge-protocol.md").read_text(encoding="utf-8")
KEY = bytes.fromhex("00112233445566ff")
FRAME, GAINS = (bytes.fromhex(text) for text in re.findall(r"```\n(5332[0-9a-f\s]+)```", PAGE))


def test_the_page_s_frame_is_written_and_read() -> None:
    poses = np.array([[0.25, 0.724, 0, 0, 0, 0, 1]], np.float32)
    assert encode_frame(1, KEY, 7, 0.5, poses, [(0, 1, (0.5, 0.72, 0.0))]) == FRAME
    frame = decode_frame(FRAME)
    assert (frame.layout, frame.key, frame.sequence, frame.time_s) == (1, KEY, 7, 0.5)
    np.testing.assert_array_equal(frame.poses, poses)
    assert frame.touches.tolist() == [(0, 1, pytest.approx([0.5, 0.72, 0.0]))]


def test_the_page_s_gains_are_written_and_read() -> None:
    gains = Gains(1, 7, 0, 0.5, 0, np.array([0.125, 0], np.float32), np.array([[[0.5]], [[0]]], np.float32))
    assert encode_gains(gains) == GAINS
    found = decode_gains(GAINS)
    assert found[:5] == gains[:5]
    assert found.intensities.tolist() == [0.125, 0.0]
    assert found.gains.tolist() == [[[0.5]], [[0.0]]]


def test_offsets_are_those_of_the_page() -> None:
    # Read independently of the code: field by field from the table of the page.
    assert (FRAME[:4], FRAME[4], FRAME[5]) == (b"S2HB", 1, 1)
    assert struct.unpack_from("<H", FRAME, 6) == (1,)
    assert struct.unpack_from("<I", FRAME, 16) == (7,)
    assert struct.unpack_from("<d", FRAME, 24) == (0.5,)
    assert struct.unpack_from("<II", FRAME, 32) == (1, 1)
    assert struct.unpack_from("<f", FRAME, 40) == (0.25,)
    assert struct.unpack_from("<II", FRAME, 68) == (0, 1)
    assert len(FRAME) == 40 + 28 + 20


def test_a_frame_without_poses_takes_those_of_a_skipped_frame_of_its_layout() -> None:
    later = decode_frame(encode_frame(1, KEY, 8, 0.6, np.empty((0, 7), np.float32), []))
    skipped = decode_frame(FRAME)
    assert later.after(skipped).poses is skipped.poses
    assert len(later._replace(layout=2).after(skipped).poses) == 0  # they would move other objects


def test_a_frame_without_poses_or_touches() -> None:
    frame = decode_frame(encode_frame(2, KEY, 1, 0.0, np.empty((0, 7), np.float32), []))
    assert (len(frame.poses), len(frame.touches)) == (0, 0)


@pytest.mark.parametrize(
    ("message", "says"),
    [
        (b"", "empty"),
        (FRAME[:30], "30 bytes"),
        (FRAME[:-1], "must have 88"),
        (FRAME + b"\0", "must have 88"),
        (b"\0" + FRAME, "S2HB"),
        (FRAME[:5] + b"\2" + FRAME[6:], "version 2"),
        (GAINS, "kind 2"),
        (FRAME[:32] + b"\xff" * 4 + FRAME[36:], "4294967295 poses"),
        (FRAME[:36] + struct.pack("<I", 1025) + FRAME[40:68] + 1025 * FRAME[68:], "1025 touches; it must have at most"),
        (FRAME[:24] + struct.pack("<d", float("nan")) + FRAME[32:], "^the time of a frame is not finite"),
        (
            FRAME[:40] + struct.pack("<f", float("inf")) + FRAME[44:],
            "^pose 0 of a frame has a number that is not",
        ),
        (FRAME[:76] + struct.pack("<f", float("nan")) + FRAME[80:], "^touch 0 of a frame has a number that is not"),
    ],
)
def test_invalid_frame_is_refused(message: bytes, says: str) -> None:
    with pytest.raises(BridgeError, match=says):
        decode_frame(message)


def test_the_pose_that_is_not_finite_is_named() -> None:
    """One of many objects may leave the world when an engine's physics fails."""
    poses = np.zeros((5, 7))
    poses[3, 6] = np.inf
    with pytest.raises(BridgeError, match="^pose 3 of a frame"):
        decode_frame(encode_frame(1, bytes(8), 1, 0.0, poses, []))


@given(st.binary(max_size=200) | st.binary(max_size=100).map(lambda tail: FRAME[:40] + tail))
def test_arbitrary_bytes_are_decoded_or_refused(message: bytes) -> None:
    with contextlib.suppress(BridgeError):
        decode_frame(message)


def test_picture_message_round_trips() -> None:
    assert decode_picture(encode_picture(b'{"object": "a"}', b"\x89PNG...")) == (b'{"object": "a"}', b"\x89PNG...")
    with pytest.raises(BridgeError, match="its text alone needs"):
        decode_picture(encode_picture(b"{}", b"")[:-1])
