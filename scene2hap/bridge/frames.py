"""Binary messages: frames of a game, and gains in reply; docs/bridge-protocol.md has every offset."""

from __future__ import annotations

import math
import struct
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from scene2hap.common.arrays import Floats32
from scene2hap.errors import BridgeError

MAGIC = b"S2HB"
VERSION = 1
FRAME, GAINS, PICTURE = 1, 2, 3
PAUSED, IS_PREPARING = 1, 2
"""Flags of gains."""

_HEADER = struct.Struct("<4sBBH8sIId")
_FRAME_COUNTS = struct.Struct("<II")
_GAINS_COUNTS = struct.Struct("<HHHH")
_PICTURE = struct.Struct("<4sBBH")
_BEGIN = _HEADER.size + _FRAME_COUNTS.size
_POSE_BYTES, _TOUCH_BYTES = 28, 20
_TOUCH = np.dtype([("hand", "<u4"), ("object", "<u4"), ("point_m", "<f4", 3)])
NO_KEY = bytes(8)
MAX_TOUCHES = 1024
"""Most touches of a frame. Frames are processed on the event loop: a message of a million held up all other clients for
75 s."""


class Frame(NamedTuple):
    """A frame of a game.

    Parameters: poses : (n_moving or 0, 7) float32, position [m] and quaternion (x, y, z, w); touches : structured
    array with hand, object and point_m [m].
    """

    layout: int
    key: bytes
    sequence: int
    time_s: float
    poses: Floats32
    touches: NDArray[np.void]

    def after(self, skipped: Frame) -> Frame:
        """Return this frame, with the poses of an earlier, skipped one if this one has none."""
        moved = not len(self.poses) and skipped.layout == self.layout
        return self._replace(poses=skipped.poses) if moved else self


class Gains(NamedTuple):
    """Gains in reply to a frame.

    Parameters: intensities : (n_hands,) float32; gains : (n_hands, n_sources, n_bands) float32.
    """

    layout: int
    sequence: int
    skipped: int
    time_s: float
    flags: int
    intensities: Floats32
    gains: Floats32


def kind_of(message: bytes) -> int:
    """Return the kind of a binary message. Raises: BridgeError: not a message of this version."""
    if message[:4] != MAGIC:
        begin = message[:8].hex(" ") or "empty"
        raise BridgeError(f"a binary message begins with {begin}; it must begin with {MAGIC.hex(' ')} (S2HB).")
    if len(message) < _PICTURE.size:
        raise BridgeError(f"a binary message has {len(message)} bytes; it must have at least {_PICTURE.size}.")
    if message[5] != VERSION:
        raise BridgeError(f"a binary message is of version {message[5]}; this bridge reads version {VERSION}.")
    return message[4]


def decode_frame(message: bytes) -> Frame:
    """Decode a frame of a client. Raises: BridgeError: its length contradicts its counts, or a number is not finite."""
    if kind_of(message) != FRAME:
        raise BridgeError(f"a binary message is of kind {message[4]}; clients send kind {FRAME} (frame).")
    if len(message) < _BEGIN:
        raise BridgeError(f"a frame has {len(message)} bytes; it must have at least {_BEGIN}.")
    _, _, _, layout, key, sequence, _, time_s = _HEADER.unpack_from(message)
    n_poses, n_touches = _FRAME_COUNTS.unpack_from(message, _HEADER.size)
    if n_touches > MAX_TOUCHES:
        raise BridgeError(f"a frame has {n_touches} touches; it must have at most {MAX_TOUCHES}. Send fewer points.")
    expected = _BEGIN + _POSE_BYTES * n_poses + _TOUCH_BYTES * n_touches
    if len(message) != expected:
        raise BridgeError(
            f"a frame of {n_poses} poses and {n_touches} touches has {len(message)} bytes; it must have {expected}."
        )
    poses = np.frombuffer(message, "<f4", 7 * n_poses, _BEGIN).reshape(n_poses, 7)
    touches = np.frombuffer(message, _TOUCH, n_touches, _BEGIN + _POSE_BYTES * n_poses)
    if not math.isfinite(time_s):
        raise BridgeError("the time of a frame is not finite; send finite seconds.")
    for name, rows in (("pose", poses), ("touch", touches["point_m"])):
        are_finite = np.isfinite(rows)
        if not are_finite.all():
            raise BridgeError(
                f"{name} {are_finite.all(axis=1).argmin()} of a frame has a number that is not finite; send finite "
                f"positions, rotations and points. The first {name} is number 0."
            )
    return Frame(layout, key, sequence, time_s, poses, touches)


def encode_gains(found: Gains) -> bytes:
    """Encode gains."""
    n_hands, n_sources, n_bands = found.gains.shape
    header = _HEADER.pack(MAGIC, GAINS, VERSION, found.layout, NO_KEY, found.sequence, found.skipped, found.time_s)
    counts = _GAINS_COUNTS.pack(n_hands, n_sources, n_bands, found.flags)
    return b"".join((header, counts, found.intensities.astype("<f4").tobytes(), found.gains.astype("<f4").tobytes()))


def decode_picture(message: bytes) -> tuple[bytes, bytes]:
    """Decode a picture into JSON text and file content. Raises: BridgeError: the message is too short for its text."""
    _, _, _, n_text = _PICTURE.unpack_from(message)
    begin = _PICTURE.size + n_text
    if begin > len(message):
        raise BridgeError(f"a picture has {len(message)} bytes; its text alone needs {begin}.")
    return message[_PICTURE.size : begin], message[begin:]
