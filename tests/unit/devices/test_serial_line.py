"""The line to a serial amplifier, played by the reference device on a manual clock."""

from __future__ import annotations

import time

import numpy as np
import pytest
from numpy.typing import NDArray

from scene2hap.devices import serial_amp
from scene2hap.devices.protocol import SinkFormat
from scene2hap.devices.reference_device import ReferenceDevice
from scene2hap.devices.serial_amp import SerialLine

RATE, QUEUE, BAUD_RATE = 4000, 400, 1_000_000


class Cable:
    """A port with the reference device at its end. Bytes take their time on the wire, and arrive with the next read."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self.now_s = 100.0
        self.most_queued = 0
        self._on_wire = b""
        self.accepted: list[NDArray[np.int16]] = []
        self.device = ReferenceDevice(RATE, 2, QUEUE, on_samples=self.accepted.append)
        monkeypatch.setattr(time, "monotonic", lambda: self.now_s)
        monkeypatch.setattr(serial_amp, "SerialPort", lambda name, baud_rate: self)

    def read(self, timeout_s: float) -> bytes:
        self.now_s += timeout_s
        self.device.advance(self.now_s)
        answer = self.device.to_send()
        self.device.receive(self._on_wire, self.now_s)
        self._on_wire = b""
        self.most_queued = max(self.most_queued, self.device._queued)
        return answer

    def write(self, data: bytes) -> None:
        self.now_s += 10 * len(data) / BAUD_RATE
        self._on_wire += data


@pytest.mark.parametrize("buffer_s", [0.02, 0.03, 0.04])
def test_no_more_is_on_its_way_than_the_buffer_and_nothing_is_lost(
    buffer_s: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    """More in the device's queue, which holds 0.1 s, would be felt later; less would be gaps."""
    cable = Cable(monkeypatch)
    line = SerialLine("cable", BAUD_RATE, None, buffer_s, 16)
    assert line.connect(SinkFormat(RATE, ("left", "right")), lambda: True) == RATE
    sent: list[NDArray[np.float32]] = []

    def play(until_s: float) -> None:
        while cable.now_s < until_s:
            if n := line.wanted(0.001):
                sent.append(np.random.default_rng(len(sent)).uniform(-1, 1, (n, 2)).astype(np.float32))
                line.send(sent[-1])

    play(101.0)
    assert buffer_s * RATE - 16 < cable.most_queued <= buffer_s * RATE
    assert line.latency_s is not None
    assert line.latency_s <= buffer_s + 0.002
    assert line.underruns == cable.device.refused == cable.device.lost == 0
    arrived = np.concatenate(cable.accepted) / 32767
    np.testing.assert_allclose(arrived, np.concatenate(sent)[: len(arrived)], atol=2**-15)
    assert len(arrived) == pytest.approx(RATE * 1.0, abs=2 * buffer_s * RATE)
    cable.now_s += buffer_s + 0.005  # a pause of the host, too short for the device's watchdog
    play(101.1)
    assert cable.device.underruns >= line.underruns >= 1


def test_underruns_of_an_amplifier_that_restarted_are_added(monkeypatch: pytest.MonkeyPatch) -> None:
    """The amplifier counts from HELLO on."""
    cable = Cable(monkeypatch)
    line = SerialLine("cable", BAUD_RATE, None, 0.02, 16)
    counts = []
    for _ in range(2):
        line.connect(SinkFormat(RATE, ("left", "right")), lambda: True)
        for until_s in (cable.now_s + 0.2, cable.now_s + 0.4):
            while cable.now_s < until_s:
                if n := line.wanted(0.001):
                    line.send(np.ones((n, 2), dtype=np.float32))
            cable.now_s += 0.025  # a pause of the host, too short for the device's watchdog
        counts.append(cable.device.underruns)
    assert min(counts) >= 1
    assert line.underruns == sum(counts)
