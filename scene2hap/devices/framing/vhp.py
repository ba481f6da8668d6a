"""Frames for the open boards of google/audio-to-tactile (VHP): twelve channels at 2 kHz, eight samples at a time.

A sample is a byte, 0 to 255 for -1 to 1 with 128 in the middle; boards double it to a pulse width of 0 to 510 in 512.
Samples are interleaved: data[12 n + c] is sample n of channel c. See docs/serial-protocol.md for each layout.

Source: google/audio-to-tactile (Apache-2.0), src/cpp/message.h, pwm.cpp and the streaming_slim sketch with its script.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum

import numpy as np

from scene2hap.devices.protocol import Block
from scene2hap.errors import DeviceError

SAMPLE_RATE_HZ = 2000
CHANNELS = 12
FRAMES = 8
MIDDLE = 128
_HALF_SCALE = 127.0

SLIM_HEADER = bytes([0xC8, 0xC9, 0x11, 0x80])
"""Header of a slim frame. The board counts bytes and ignores these. The last should be 96, but all known programs send
128."""

SLIM_CREDIT = b"buffer_copied"
"""The line with which the slim board requests a frame."""

SLIM_QUEUE_FRAMES = 8
"""Slim frames that the board collects before it swaps buffers. Its byte counter must reach exactly their 800 bytes."""

_START = 200
_PACKET_SIZE = 132
_HEADER_SIZE = 4
MORE = 23
"""The byte with which the sleeve requests the next packet."""


class Recipient(IntEnum):
    """Recipient of a packet on the sleeve's wire."""

    ALL = 1
    SLEEVE = 3


class MessageType(IntEnum):
    """The messages that streaming needs."""

    DISABLE_AMPLIFIERS = 14
    ENABLE_AMPLIFIERS = 15
    ALL_TACTORS_SAMPLES = 17


@dataclass(frozen=True)
class Message:
    """A message of type and payload (at most 128 bytes) to a recipient."""

    type: int
    payload: bytes = b""
    recipient: int = Recipient.SLEEVE

    def __post_init__(self) -> None:
        if len(self.payload) > _PACKET_SIZE - _HEADER_SIZE:
            raise DeviceError(f"a VHP message holds at most 128 bytes, got {len(self.payload)}.")


def to_bytes(block: Block) -> bytes:
    """Return eight frames (8, up to 12) as 96 bytes; missing channels are at mid-scale.

    Raises: DeviceError: another shape.
    """
    if block.ndim != 2 or len(block) != FRAMES or block.shape[1] > CHANNELS:
        raise DeviceError(f"VHP boards take blocks of ({FRAMES}, 1 to {CHANNELS}) samples, got {block.shape}.")
    data = np.full((FRAMES, CHANNELS), MIDDLE, dtype=np.uint8)
    within = np.clip(np.nan_to_num(block, nan=0.0), -1.0, 1.0)
    data[:, : block.shape[1]] = np.rint(within * _HALF_SCALE) + MIDDLE
    return data.tobytes()


def slim_frame(block: Block) -> bytes:
    """Return the 100 bytes of a frame for the slim board over USB."""
    return SLIM_HEADER + to_bytes(block)


def packet(message: Message) -> bytes:
    """Return the sleeve's wired form: 132 bytes, padded by zeros."""
    head = bytes([_START, message.recipient, message.type, len(message.payload)])
    return (head + message.payload).ljust(_PACKET_SIZE, b"\0")


def sleeve_packet(block: Block) -> bytes:
    """Return the packet with samples for all channels."""
    return packet(Message(MessageType.ALL_TACTORS_SAMPLES, to_bytes(block)))
