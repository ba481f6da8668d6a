"""Frames of our own protocol: a header, a payload and a CRC-32; COBS between zeros on a wire, bare in a datagram.

    version u8 | type u8 | sequence u16 | channels u8 | format u8 | count u16 | time_us u32 | payload | CRC-32 u32

All little-endian. `count` is sample frames in PCM and payload bytes elsewhere; `time_us` is the sender's clock modulo
2^32. See docs/serial-protocol.md and docs/udp.md.
"""

from __future__ import annotations

import struct
import zlib
from collections.abc import Iterator
from dataclasses import dataclass
from enum import IntEnum

import numpy as np
from numpy.typing import NDArray

from scene2hap.devices.framing import cobs
from scene2hap.devices.protocol import Block
from scene2hap.errors import DeviceError

VERSION = 1
MAX_PAYLOAD = 1024
"""Most bytes of a payload, so that a frame fits into one Ethernet datagram and into a small board's memory."""

MOST_CHANNELS = 255
"""Most channels of a frame, whose header has a byte for their number."""

_HEADER = struct.Struct("<BBHBBHI")
_CRC_SIZE = 4
_LONGEST_ENCODED = cobs.LONGEST_RUN + MAX_PAYLOAD + _HEADER.size + _CRC_SIZE
_FULL_SCALE = 32767.0


class FrameType(IntEnum):
    """The purpose of a frame."""

    HELLO = 1
    FORMAT = 2
    PCM = 3
    CREDIT = 4
    MUTE = 5
    STREAM = 6


class SampleFormat(IntEnum):
    """Encoding of the samples; NONE for frames without samples."""

    NONE = 0
    INT16 = 1
    FLOAT32 = 2

    @property
    def dtype(self) -> np.dtype[np.int16] | np.dtype[np.float32]:
        """Little-endian data type of this format."""
        return np.dtype("<i2") if self is SampleFormat.INT16 else np.dtype("<f4")


@dataclass(frozen=True)
class Frame:
    """One frame; `sequence` counts modulo 2^16 and `time_us` modulo 2^32."""

    type: FrameType
    sequence: int = 0
    channels: int = 0
    format: SampleFormat = SampleFormat.NONE
    count: int = 0
    time_us: int = 0
    payload: bytes = b""

    def __post_init__(self) -> None:
        n_bytes = len(self.payload)
        if n_bytes > MAX_PAYLOAD:
            raise DeviceError(
                f"a {self.type.name} frame has {n_bytes} bytes of payload; it must be at most {MAX_PAYLOAD}."
            )
        if n_bytes != self.payload_size:
            raise DeviceError(
                f"a {self.type.name} frame has {n_bytes} bytes; by its header it must be {self.payload_size}."
            )

    @property
    def payload_size(self) -> int:
        """Number of payload bytes by the header."""
        if self.type is not FrameType.PCM:
            return self.count
        return self.count * self.channels * (self.format.dtype.itemsize if self.format else 0)


def message(type: FrameType, payload: bytes = b"", *, sequence: int = 0, time_us: int = 0) -> Frame:
    """Return a frame without samples."""
    return Frame(type, sequence, count=len(payload), time_us=time_us, payload=payload)


def pcm(block: Block, *, sequence: int, time_us: int = 0, format: SampleFormat = SampleFormat.INT16) -> Frame:
    """Return a frame of samples (n_frames, n_channels)."""
    payload = to_int16(block) if format is SampleFormat.INT16 else block.astype("<f4").tobytes()
    return Frame(FrameType.PCM, sequence, block.shape[1], format, len(block), time_us, payload)


def clock_us(time_s: float) -> int:
    """Return a time [s] as the `time_us` of a frame."""
    return int(time_s * 1e6) % 2**32


def to_int16(block: Block) -> bytes:
    """Convert samples to 16-bit integers: 1.0 becomes 32767, rounded to nearest and clipped; NaN becomes silence."""
    within = np.clip(np.nan_to_num(block, nan=0.0), -1.0, 1.0)
    whole: NDArray[np.int16] = np.rint(within * np.float32(_FULL_SCALE)).astype("<i2")
    return whole.tobytes()


def samples(frame: Frame) -> Block:
    """Return the samples of a PCM frame (n_frames, n_channels) float32."""
    raw = np.frombuffer(frame.payload, dtype=frame.format.dtype).astype(np.float32)
    scale = np.float32(_FULL_SCALE) if frame.format is SampleFormat.INT16 else np.float32(1.0)
    return (raw / scale).reshape(frame.count, frame.channels)


def with_crc32(data: bytes) -> bytes:
    """Append the CRC-32 of bytes, little-endian (reflected 0x04C11DB7, as in Ethernet and zip)."""
    return data + zlib.crc32(data).to_bytes(_CRC_SIZE, "little")


def without_crc32(data: bytes) -> bytes | None:
    """Return the bytes without their checksum, or None if the checksum is wrong."""
    body = data[:-_CRC_SIZE]
    return body if data == with_crc32(body) else None


def to_datagram(frame: Frame) -> bytes:
    """Return header, payload and CRC-32, without framing."""
    header = _HEADER.pack(VERSION, frame.type, frame.sequence, frame.channels, frame.format, frame.count, frame.time_us)
    return with_crc32(header + frame.payload)


def from_datagram(data: bytes) -> Frame | None:
    """Return the frame, or None if any byte is wrong; never raises."""
    body = without_crc32(data)
    if body is None or len(body) < _HEADER.size:
        return None
    version, kind, sequence, channels, format, count, time_us = _HEADER.unpack_from(body)
    payload = body[_HEADER.size :]
    if version != VERSION:
        return None
    try:
        return Frame(FrameType(kind), sequence, channels, SampleFormat(format), count, time_us, payload)
    except (ValueError, DeviceError):
        return None


def to_wire(frame: Frame) -> bytes:
    """Return the frame in COBS between two zeros, so that a damaged frame does not affect the next."""
    return b"\0" + cobs.encode(to_datagram(frame)) + b"\0"


class FrameParser:
    """Parser of frames in a stream of bytes; `damaged` counts runs of bytes that were no frame."""

    def __init__(self) -> None:
        self._rest = bytearray()
        self._overlong = False
        self.damaged: int = 0

    def feed(self, data: bytes) -> Iterator[Frame]:
        """Yield the frames that these bytes complete. Never raises; stores at most one frame's bytes."""
        self._rest += data
        *ended, rest = self._rest.split(b"\0")
        self._rest = rest
        for run in ended:
            whole = not self._overlong
            self._overlong = False
            if not run and whole:
                continue
            frame = self._frame(run) if whole else None
            if frame is None:
                self.damaged += 1
            else:
                yield frame
        if len(self._rest) > _LONGEST_ENCODED:
            self._rest.clear()
            self._overlong = True

    @staticmethod
    def _frame(run: bytearray) -> Frame | None:
        decoded = cobs.decode(bytes(run)) if len(run) <= _LONGEST_ENCODED else None
        return None if decoded is None else from_datagram(decoded)
