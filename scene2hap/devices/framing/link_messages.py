"""Messages of a serial link other than samples; specified in docs/serial-protocol.md."""

from __future__ import annotations

import struct
from dataclasses import dataclass

from scene2hap.devices.framing.frames import Frame, FrameType, message

_HELLO = struct.Struct("<IB")
_FORMAT = struct.Struct("<IBHH")
_CREDIT = struct.Struct("<HBHHIII")

GREETED = 1
"""CREDIT flag: the device has received a HELLO since its start. Without it the host must send HELLO again."""

HEARD = 2
"""CREDIT flag: `last_sequence` is that of a PCM frame."""

MUTED = 4
"""CREDIT flag: the output is silent because of the watchdog or a MUTE."""


@dataclass(frozen=True)
class Hello:
    """The host's greeting: requested rate [Hz] and number of channels; 0 Hz for the device's own rate."""

    sample_rate_hz: int
    channels: int

    def to_frame(self) -> Frame:
        """Return the message as a frame."""
        return message(FrameType.HELLO, _HELLO.pack(self.sample_rate_hz, self.channels))

    @classmethod
    def from_frame(cls, frame: Frame) -> Hello | None:
        """Return the message of a frame, None if the frame is another message."""
        return cls(*_HELLO.unpack(frame.payload)) if _is(frame, FrameType.HELLO, _HELLO) else None


@dataclass(frozen=True)
class DeviceFormat:
    """The device's answer: its format, the length of its queue, and the most sample frames in one PCM frame."""

    sample_rate_hz: int
    channels: int
    queue_frames: int
    block_frames: int

    def to_frame(self) -> Frame:
        """Return the message as a frame."""
        packed = _FORMAT.pack(self.sample_rate_hz, self.channels, self.queue_frames, self.block_frames)
        return message(FrameType.FORMAT, packed)

    @classmethod
    def from_frame(cls, frame: Frame) -> DeviceFormat | None:
        """Return the message of a frame, None if the frame is another message."""
        return cls(*_FORMAT.unpack(frame.payload)) if _is(frame, FrameType.FORMAT, _FORMAT) else None


@dataclass(frozen=True)
class Credit:
    """The device's whole state. Each message repeats it, so a lost CREDIT has no effect.

    last_sequence : of the newest PCM frame it accepted; free_frames, queued_frames : of its queue; accepted_frames,
    damaged, underruns : totals since HELLO, modulo 2^32. The frame's `time_us` repeats that of the PCM frame.
    """

    last_sequence: int
    flags: int
    free_frames: int
    queued_frames: int
    accepted_frames: int
    damaged: int
    underruns: int

    def to_frame(self, time_us: int = 0) -> Frame:
        """Return the message as a frame."""
        packed = _CREDIT.pack(
            self.last_sequence,
            self.flags,
            self.free_frames,
            self.queued_frames,
            self.accepted_frames % 2**32,
            self.damaged % 2**32,
            self.underruns % 2**32,
        )
        return message(FrameType.CREDIT, packed, time_us=time_us)

    @classmethod
    def from_frame(cls, frame: Frame) -> Credit | None:
        """Return the message of a frame, None if the frame is another message."""
        return cls(*_CREDIT.unpack(frame.payload)) if _is(frame, FrameType.CREDIT, _CREDIT) else None


def is_newer(sequence: int, than: int) -> bool:
    """Return True if a 16-bit sequence number is newer than another one, modulo 2^16."""
    return 0 < (sequence - than) % 2**16 < 2**15


def _is(frame: Frame, type: FrameType, layout: struct.Struct) -> bool:
    return frame.type is type and len(frame.payload) == layout.size
