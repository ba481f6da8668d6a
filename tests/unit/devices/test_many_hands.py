"""Sinks whose frames have no room for all hands of a session cannot be opened."""

from __future__ import annotations

import socket
from collections.abc import Callable, Sequence

import numpy as np
import pytest

from scene2hap import HapticSession
from scene2hap.devices.datagrams import Datagrams
from scene2hap.devices.framing.frames import MOST_CHANNELS, SampleFormat
from scene2hap.devices.framing.vhp import CHANNELS
from scene2hap.devices.link import Line, LiveSink
from scene2hap.devices.protocol import SinkEvent, SinkFormat
from scene2hap.devices.serial_amp import SerialLine
from scene2hap.devices.udp import PcmLine
from scene2hap.devices.vhp_amp import VhpLine
from scene2hap.errors import DeviceError
from scenes import table_with_two_phones


def pcm_line(port: int = 9) -> PcmLine:
    return PcmLine(Datagrams("127.0.0.1", port), 8000, 80, SampleFormat.FLOAT32)


LINES: list[tuple[Callable[[], Line], Sequence[str], str]] = [
    (pcm_line, [chr(0x100 + i) for i in range(MOST_CHANNELS + 1)], "at most 255 hands, and 1020 bytes .* 256 hands"),
    (pcm_line, [f"finger {i:09}" for i in range(64)], "at most 255 hands, and 1020 bytes .* 64 hands"),
    (
        lambda: SerialLine("no port", 921_600, None, 0.02, 16),
        [str(i) for i in range(MOST_CHANNELS + 1)],
        "no port takes at most 255 channels; the session has 256 hands",
    ),
    (
        lambda: VhpLine("no port", slim=True),
        [str(i) for i in range(CHANNELS + 1)],
        f"no port has {CHANNELS} channels; the session has {CHANNELS + 1} hands",
    ),
]


@pytest.mark.parametrize(("line", "hands", "message"), LINES)
def test_a_session_with_more_hands_or_longer_names_than_a_frame_holds_does_not_start(
    line: Callable[[], Line], hands: Sequence[str], message: str
) -> None:
    events: list[SinkEvent] = []
    sink = LiveSink(line(), "it", on_event=events.append)
    session = HapticSession(*table_with_two_phones(), hands=hands, sink=sink)
    with pytest.raises(DeviceError, match=message):
        session.start()
    assert not events


def test_as_many_hands_as_a_datagram_holds_are_sent() -> None:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as receiver:
        receiver.bind(("127.0.0.1", 0))
        sink = LiveSink(pcm_line(receiver.getsockname()[1]), "it")
        sink.open(SinkFormat(48_000, tuple(chr(0x100 + i) for i in range(MOST_CHANNELS))))
        sink.start(lambda n_frames: np.zeros((n_frames, MOST_CHANNELS), dtype=np.float32))
        assert sink.wait_connected(10.0)
        sink.close()
