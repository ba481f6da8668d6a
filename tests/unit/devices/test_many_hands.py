"""Sinks whose frames have no room for all hands of a session say so."""

from __future__ import annotations

import socket

import pytest

from scene2hap.devices.datagrams import Datagrams
from scene2hap.devices.framing.frames import MOST_CHANNELS, SampleFormat
from scene2hap.devices.protocol import SinkFormat
from scene2hap.devices.serial_amp import SerialLine
from scene2hap.devices.udp import PcmLine
from scene2hap.errors import DeviceError


def pcm_line(port: int = 9) -> PcmLine:
    return PcmLine(Datagrams("127.0.0.1", port), 8000, 80, SampleFormat.FLOAT32)


def connect(line: PcmLine | SerialLine, *hands: str) -> int:
    try:
        return line.connect(SinkFormat(48_000, hands), lambda: False)
    finally:
        line.disconnect()


@pytest.mark.parametrize(
    "hands", [[chr(0x100 + i) for i in range(MOST_CHANNELS + 1)], [f"finger {i:09}" for i in range(64)]]
)
def test_more_hands_or_longer_names_than_a_datagram_holds_are_refused(hands: list[str]) -> None:
    with pytest.raises(DeviceError, match=rf"at most {MOST_CHANNELS} hands, and 1020 bytes .* {len(hands)} hands"):
        connect(pcm_line(), *hands)


def test_as_many_hands_as_a_datagram_holds_are_sent() -> None:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as receiver:
        receiver.bind(("127.0.0.1", 0))
        assert connect(pcm_line(receiver.getsockname()[1]), *(chr(0x100 + i) for i in range(MOST_CHANNELS))) == 8000


def test_more_hands_than_a_serial_amplifier_can_be_told_are_refused() -> None:
    line = SerialLine("no port", 921_600, None, 0.02, 16)
    with pytest.raises(DeviceError, match="no port takes at most 255 channels; the session has 256 hands"):
        connect(line, *map(str, range(256)))
