"""Binary messages of the bridge as a client writes and reads them, from the tables of docs/bridge-protocol.md."""

from __future__ import annotations

import struct
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from scene2hap.bridge.frames import Gains

FRAME_HEADER = struct.Struct("<4sBBH8sIIdII")
GAINS_HEADER = struct.Struct("<4sBBH8sIIdHHHH")


def encode_frame(
    layout: int,
    key: bytes,
    sequence: int,
    time_s: float,
    poses: NDArray[np.float32],
    touches: Sequence[tuple[int, int, tuple[float, float, float]]],
) -> bytes:
    """Encode a frame: poses (n, 7), and touches of hand, object and point [m]."""
    header = FRAME_HEADER.pack(b"S2HB", 1, 1, layout, key, sequence, 0, time_s, len(poses), len(touches))
    rows = [struct.pack("<II3f", hand, thing, *point_m) for hand, thing, point_m in touches]
    return b"".join((header, poses.astype("<f4").tobytes(), *rows))


def decode_gains(message: bytes) -> Gains:
    """Decode gains."""
    magic, kind, version, layout, _, sequence, skipped, time_s, n_hands, n_sources, n_bands, flags = (
        GAINS_HEADER.unpack_from(message)
    )
    assert (magic, kind, version) == (b"S2HB", 2, 1)
    numbers = np.frombuffer(message, "<f4", offset=GAINS_HEADER.size)
    gains = numbers[n_hands:].reshape(n_hands, n_sources, n_bands)
    return Gains(layout, sequence, skipped, time_s, flags, numbers[:n_hands], gains)


def encode_picture(text: bytes, file: bytes) -> bytes:
    """Encode a picture, with the JSON text about it."""
    return struct.pack("<4sBBH", b"S2HB", 3, 1, len(text)) + text + file
