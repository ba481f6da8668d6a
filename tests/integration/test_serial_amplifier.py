"""The serial amplifier sink over real pseudo-terminals, with the reference device at the other end."""

import errno
import itertools
import os
import signal
import subprocess
import sys
import threading
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
import soundfile
from numpy.typing import NDArray

from host import terminal_problem
from scene2hap import HapticSession, Touch
from scene2hap.devices import SINKS
from scene2hap.devices.protocol import ActuatorSink, SinkEvent, SinkFormat
from scene2hap.devices.reference_device import PseudoTerminal, ReferenceDevice
from scene2hap.devices.serial_amp import SerialAmplifierSink
from scene2hap.devices.serial_port import SerialPort
from scenes import RATE, table_with_two_phones
from serial_bench import Plug, eventually
from wire_damage import damaged

pytestmark = pytest.mark.skipif(bool(terminal_problem()), reason=terminal_problem())

FORMAT = SinkFormat(4000, ("left", "right"))
UNHURRIED_FRAMES = 4000
SECONDS = 30 if os.environ.get("CI") else 6


class Counting:
    """A mix that counts frames in its 16-bit samples (left low digits, right high digits), so that each is known."""

    def __init__(self) -> None:
        self.position = 0

    def __call__(self, n_frames: int) -> NDArray[np.float32]:
        place = np.arange(self.position, self.position + n_frames)
        self.position += n_frames
        return (np.stack([place % 30000, place // 30000], axis=1) / 32767).astype(np.float32)

    @staticmethod
    def positions(samples: NDArray[np.int16]) -> NDArray[np.int64]:
        return samples[:, 0].astype(np.int64) + 30000 * samples[:, 1].astype(np.int64)


class Kept:
    """A factory of reference devices that store the samples that they accept."""

    def __init__(self, **settings: int) -> None:
        self.blocks: list[NDArray[np.int16]] = []
        self._settings = settings

    def __call__(self) -> ReferenceDevice:
        return ReferenceDevice(on_samples=self.blocks.append, **self._settings)

    @property
    def samples(self) -> NDArray[np.int16]:
        return np.concatenate(self.blocks)


class Deaf(ReferenceDevice):
    """A device that receives one byte in a hundred wrongly."""

    rng = np.random.default_rng(4)

    def receive(self, data: bytes, now_s: float) -> None:
        ((worse, _),) = damaged([data], 0.01, self.rng)
        super().receive(worse, now_s)


@pytest.fixture
def events() -> list[SinkEvent]:
    return []


@pytest.fixture
def unhurried(monkeypatch: pytest.MonkeyPatch) -> dict[str, float]:
    """Settings of a sink whose stream has no second fade-in unless this machine stops for a second.

    The device needs a queue of `UNHURRIED_FRAMES`.
    """
    monkeypatch.setattr("scene2hap.devices.serial_amp.WATCHDOG_S", 1.0)
    return {"buffer_s": 1.0}


@pytest.fixture(autouse=True)
def _nothing_is_left_behind() -> Iterator[None]:
    before = set(threading.enumerate())
    yield
    assert set(threading.enumerate()) <= before


def kinds(events: list[SinkEvent]) -> list[str]:
    return [event.kind for event in events]


def test_every_sample_arrives_bit_exact(tmp_path: Path, events: list[SinkEvent], unhurried: dict[str, float]) -> None:
    kept = Kept(queue_frames=UNHURRIED_FRAMES)
    with Plug(tmp_path, kept) as plug:
        sink = SerialAmplifierSink(str(plug.path), on_event=events.append, **unhurried)
        sink.open(FORMAT)
        sink.start(Counting())
        assert eventually(lambda: sink.stats.frames >= SECONDS * 4000, within_s=60.0 + 6 * SECONDS)
        sink.close()
        stats = sink.stats
        device = plug.device
    assert kinds(events) == ["connected"], events
    assert (device.damaged, device.lost, device.refused) == (0, 0, 0)
    played = Counting.positions(kept.samples)[200:]  # after the fade
    first = stats.dropped_frames + 200  # dropped before the device's hello
    np.testing.assert_array_equal(played, np.arange(first, first + len(played)))
    assert len(played) >= SECONDS * 4000 - 400


def test_many_channels_are_sent_in_blocks_that_a_frame_holds(
    tmp_path: Path, events: list[SinkEvent], unhurried: dict[str, float]
) -> None:
    """16 channels of 64 frames are 2048 bytes; a PCM frame holds 1024 (docs/serial-protocol.md)."""
    kept = Kept(channels=16, queue_frames=UNHURRIED_FRAMES)
    with Plug(tmp_path, kept) as plug:
        options = {"baud_rate": 2_000_000, "block_frames": 64, **unhurried}
        sink = SerialAmplifierSink(str(plug.path), on_event=events.append, **options)
        sink.open(SinkFormat(4000, tuple(f"hand {number}" for number in range(16))))
        sink.start(lambda n_frames: np.full((n_frames, 16), np.arange(16) / 32767, dtype=np.float32))
        assert eventually(lambda: sink.stats.frames >= 2000)
        sink.close()
    assert kinds(events) == ["connected"], events
    assert (kept.samples[200:] == np.arange(16)).all()


def test_a_session_of_48_khz_is_converted(tmp_path: Path, unhurried: dict[str, float]) -> None:
    kept = Kept(queue_frames=UNHURRIED_FRAMES)
    clock = itertools.count()

    def sine(n_frames: int) -> NDArray[np.float32]:
        place = np.fromiter(itertools.islice(clock, n_frames), dtype=np.float64)
        wave = np.sin(2 * np.pi * 200 * place / 48000)
        return np.stack([wave, 0.5 * wave], axis=1).astype(np.float32)

    with Plug(tmp_path, kept) as plug, SerialAmplifierSink(str(plug.path), **unhurried) as sink:
        sink.open(SinkFormat(48000, ("left", "right")))
        sink.start(sine)
        assert eventually(lambda: plug.device.accepted_frames > 2400)
        assert eventually(lambda: sink.stats.latency_s is not None)
    left = kept.samples[400:2400, 0] / 32767
    spectrum = np.abs(np.fft.rfft(left)) / 1000
    assert spectrum[100] == pytest.approx(1, abs=1e-3)  # 200 Hz, with 2 Hz per bin
    assert np.delete(spectrum, 100).max() < 1e-3
    np.testing.assert_allclose(kept.samples[400:2400, 1] / 32767, 0.5 * left, atol=1e-4)


def test_noisy_wire_loses_only_frames(tmp_path: Path, events: list[SinkEvent], unhurried: dict[str, float]) -> None:
    blocks: list[NDArray[np.int16]] = []
    device = Deaf(on_samples=blocks.append, queue_frames=UNHURRIED_FRAMES)
    mix = Counting()
    with Plug(tmp_path, lambda: device) as plug:
        sink = SerialAmplifierSink(str(plug.path), block_frames=8, on_event=events.append, **unhurried)
        with sink:
            sink.open(FORMAT)
            sink.start(mix)
            assert eventually(lambda: device.accepted_frames > 4000)
    assert kinds(events) == ["connected"], events
    assert device.damaged > 100
    at = [Counting.positions(block) for block in blocks[40:]]
    assert all((np.diff(positions) == 1).all() for positions in at)
    starts = np.array([positions[0] for positions in at])
    assert (np.diff(starts) > 0).all()
    assert starts[-1] < mix.position


def test_device_without_credit_resumes(tmp_path: Path, events: list[SinkEvent]) -> None:
    mix = Counting()
    with Plug(tmp_path) as plug, SerialAmplifierSink(str(plug.path), on_event=events.append) as sink:
        sink.open(FORMAT)
        sink.start(mix)
        assert eventually(lambda: plug.device.accepted_frames > 400)
        plug.device.grants_credit = False
        assert eventually(lambda: "stalled" in kinds(events))
        assert eventually(lambda: plug.device.muted)  # by its watchdog
        position = mix.position
        assert eventually(lambda: mix.position > position + 400)  # the session continues
        plug.device.grants_credit = True
        assert eventually(lambda: not plug.device.muted)
    assert kinds(events)[:2] == ["connected", "stalled"]
    assert kinds(events)[2] in ("resumed", "lost")


def test_restarted_device_gets_a_new_hello(tmp_path: Path, events: list[SinkEvent]) -> None:
    with Plug(tmp_path) as plug, SerialAmplifierSink(str(plug.path), on_event=events.append) as sink:
        sink.open(FORMAT)
        sink.start(Counting())
        assert eventually(lambda: plug.device.accepted_frames > 400)
        plug.device._greeted = False  # as after a brown-out
        assert eventually(lambda: kinds(events) == ["connected", "lost", "connected"])
    assert "restarted" in events[1].message


def test_unplugged_device_is_reconnected(tmp_path: Path, events: list[SinkEvent]) -> None:
    plug = Plug(tmp_path)
    sink = SerialAmplifierSink(str(plug.path), on_event=events.append)
    mix = Counting()
    sink.open(FORMAT)
    sink.start(mix)
    assert eventually(lambda: kinds(events) == ["unavailable"])
    assert "no serial port" in events[0].message
    try:
        for _ in range(3):
            plug.put_in()
            assert eventually(lambda: plug.device.accepted_frames > 200)
            position = mix.position
            plug.pull_out()
            assert eventually(lambda position=position: mix.position > position + 400)
            assert not sink.stats.connected
    finally:
        plug.pull_out()
        sink.close()
    assert sink.stats.reconnects == 2, events
    assert kinds(events).count("connected") == kinds(events).count("lost") == 3


def test_frozen_device_is_dropped_and_reconnected(
    tmp_path: Path, events: list[SinkEvent], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("scene2hap.devices.serial_amp.ANSWER_S", 0.2)
    mix = Counting()
    with Plug(tmp_path) as plug, SerialAmplifierSink(str(plug.path), on_event=events.append) as sink:
        sink.open(FORMAT)
        sink.start(mix)
        assert eventually(lambda: plug.device.accepted_frames > 400)
        plug.freeze()
        assert eventually(lambda: kinds(events) == ["connected", "stalled", "lost", "unavailable"])
        position = mix.position
        assert eventually(lambda: mix.position > position + 400)
        plug.wake_up()
        assert eventually(lambda: kinds(events)[-1] == "connected" and plug.device.accepted_frames > 0)


def test_a_session_goes_on_without_its_amplifier(tmp_path: Path, events: list[SinkEvent]) -> None:
    plug = Plug(tmp_path)
    sink = {"kind": "serial", "port": str(plug.path), "on_event": events.append}
    session = HapticSession(*table_with_two_phones(), {"sample_rate_hz": RATE}, sink=sink)
    on_the_phone = Touch("left", "phone", (0.1, 0.73, 0.4))
    with session:
        assert eventually(lambda: bool(events))
        position = session.position
        assert eventually(lambda: session.position > position + RATE / 10)
        with plug:
            assert eventually(lambda: plug.device.accepted_frames > 200)
            assert session.update(touches=[on_the_phone]).gain("left", "phone") == 1.0
            assert eventually(lambda: bool(plug.device._last.any()))
        assert eventually(lambda: kinds(events)[-1] in ("lost", "unavailable"))
        position = session.position
        assert session.update(touches=[on_the_phone]).gain("left", "phone") == 1.0
        assert eventually(lambda: session.position > position + RATE / 10)
    assert kinds(events)[:3] == ["unavailable", "connected", "lost"]


def test_devices_at_the_port_are_identified(
    tmp_path: Path, events: list[SinkEvent], monkeypatch: pytest.MonkeyPatch
) -> None:
    def told(words: str, make: Kept | None = None, **settings: object) -> None:
        events.clear()
        with Plug(tmp_path, make or Kept()) as plug:
            sink = SerialAmplifierSink(str(plug.path), on_event=events.append, **settings)
            with sink:
                sink.open(FORMAT)
                sink.start(Counting())
                assert eventually(lambda: bool(events))
        assert events[0].kind == "unavailable"
        assert words in events[0].message

    told("plays at 4000 Hz and cannot do 8000 Hz", sample_rate_hz=8000)
    told("has 1 channel; the session has 2 hands", Kept(channels=1))
    told("offers 400 Hz; it must be 500 to 48000 Hz", Kept(sample_rate_hz=400))
    told("queues 1 frame; it must be at least 2", Kept(queue_frames=1))
    told("Raise baud_rate", baud_rate=115200)
    import serial

    def refused(*args: object, **kwargs: object) -> None:
        raise serial.SerialException(errno.EACCES, "could not open port: [Errno 13] Permission denied")

    with monkeypatch.context() as patch:
        patch.setattr(serial, "Serial", refused)
        told("permission denied")


def test_port_in_use_is_reported(tmp_path: Path, events: list[SinkEvent]) -> None:
    with Plug(tmp_path) as plug:
        # As another program would; `open` refuses a second sink of this program, see tests/unit/devices/test_claims.
        other = SerialPort(str(plug.path), 921600)
        with SerialAmplifierSink(str(plug.path), on_event=events.append) as sink:
            sink.open(FORMAT)
            sink.start(Counting())
            assert eventually(lambda: bool(events))
        other.close()
    assert "in use" in events[0].message


def test_reads_do_not_set_the_port_up_again(monkeypatch: pytest.MonkeyPatch) -> None:
    """pyserial sends all settings of a port at each new timeout; on Windows, USB chips get them, also the baud rate."""
    import serial

    set_ups: list[serial.Serial] = []
    terminal = PseudoTerminal()
    port = SerialPort(terminal.name, 921600)
    monkeypatch.setattr(serial.Serial, "_reconfigure_port", lambda port: set_ups.append(port))
    for _ in range(5):
        port.read(0.001)
    port.close()
    terminal.close()
    assert len(set_ups) == 1


def test_unresponsive_port_is_reported(events: list[SinkEvent], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("scene2hap.devices.serial_amp.ANSWER_S", 0.2)
    terminal = PseudoTerminal()
    with SerialAmplifierSink(terminal.name, on_event=events.append) as sink:
        sink.open(FORMAT)
        sink.start(Counting())
        assert eventually(lambda: bool(events))
    terminal.close()
    assert "does not answer" in events[0].message


def test_reference_device_runs_as_a_program(tmp_path: Path) -> None:
    wav = tmp_path / "heard.wav"
    command = [sys.executable, "-m", "scene2hap.devices.reference_device", "--wav", str(wav)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as program:
        assert program.stdout is not None
        port = program.stdout.readline().strip()
        sink = SINKS.build({"kind": "serial", "port": port, "buffer_s": 0.04})
        assert isinstance(sink, ActuatorSink)
        sink.open(FORMAT)
        sink.start(lambda n: np.full((n, 2), 0.5, dtype=np.float32))
        assert eventually(lambda: sink.stats.frames > 2000)
        sink.stop()
        sink.close()
        program.send_signal(signal.SIGINT)
        report = program.stdout.read()
        assert program.wait(60) == 0
    assert " 0 damaged runs" in report
    heard, rate = soundfile.read(wav)
    assert rate == 4000
    assert np.abs(heard).max() == pytest.approx(0.5, abs=1e-4)
