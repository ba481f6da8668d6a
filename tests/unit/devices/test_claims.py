"""Claims: within a program, one session at a time uses a sink, a file or a port."""

import gc
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
import soundfile

from garbage import only_new_garbage
from scene2hap import HapticSession, MemorySink, Touch, WavSink
from scene2hap.devices.protocol import SinkFormat
from scene2hap.devices.serial_amp import SerialAmplifierSink
from scene2hap.devices.tee import TeeSink
from scene2hap.devices.udp import UdpSink
from scene2hap.devices.vhp_amp import VhpSink
from scene2hap.errors import ConfigError, DeviceError
from scenes import RATE, table_with_two_phones
from systems import needs_links, needs_removal_of_open_files

FORMAT = SinkFormat(RATE, ("left", "right"))
ON_PHONE = Touch("left", "phone", (0.1, 0.73, 0.4))


@pytest.fixture(autouse=True)
def _only_new_garbage() -> Iterator[None]:
    with only_new_garbage():
        yield


def session(sink: object) -> HapticSession:
    return HapticSession(*table_with_two_phones(), {"sample_rate_hz": RATE}, sink=sink)


def test_two_sessions_cannot_play_on_one_sink() -> None:
    sink = MemorySink()
    with session(sink) as first:
        first.update(touches=[ON_PHONE])
        sink.pull(400)
        second = session(sink)
        with pytest.raises(DeviceError, match="another session plays on this MemorySink already"):
            second.start()
        second.stop()  # was never started, and does not stop the other session
        sink.pull(400)
        kept = sink.samples
    assert kept.shape == (800, 2)
    assert kept.any()
    with second:
        sink.pull(10)


def test_two_sessions_cannot_share_a_sink_inside_a_tee() -> None:
    inner = MemorySink()
    with session(inner) as first:
        with pytest.raises(DeviceError, match="another session"):
            session(TeeSink([MemorySink(), inner])).start()
        first.update(touches=[ON_PHONE])
        inner.pull(400)
    shared = MemorySink()
    with session(TeeSink([shared, MemorySink()])), pytest.raises(DeviceError, match="another session"):
        session(shared).start()


def test_refused_tee_claims_none_of_its_sinks() -> None:
    taken, free = MemorySink(), MemorySink()
    with session(taken):
        with pytest.raises(DeviceError):
            session(TeeSink([free, taken])).start()
        with session(free):
            pass


@pytest.mark.parametrize(
    "same",
    [
        "{}/out.wav",
        "{}/deep/../out.wav",
        pytest.param("{}/link/out.wav", marks=needs_links),
    ],
)
def test_two_sinks_cannot_write_one_file(same: str, tmp_path: Path) -> None:
    (tmp_path / "deep").mkdir()
    if "link" in same:
        (tmp_path / "link").symlink_to(tmp_path)
    first, second = WavSink(tmp_path / "out.wav"), WavSink(same.format(tmp_path))
    with session(first) as one:
        one.update(touches=[ON_PHONE])
        first.pull(800)
        with pytest.raises(DeviceError, match=r"another WavSink writes .* already"):
            session(second).start()
        first.pull(800)
    samples, _ = soundfile.read(first.path)
    assert len(samples) >= 1600
    assert np.abs(samples).max() > 0.1
    with session(second):
        second.pull(100)
    assert len(soundfile.read(first.path)[0]) < 1600


def test_file_claim_is_released_by_abort_and_by_deletion_of_the_sink(tmp_path: Path) -> None:
    sink = WavSink(tmp_path / "a.wav")
    sink.open(FORMAT)
    sink.abort()
    forgotten = WavSink(tmp_path / "a.wav")
    forgotten.open(FORMAT)
    del forgotten
    gc.collect()
    sink.open(FORMAT)
    sink.close()


@needs_removal_of_open_files
def test_close_raises_when_the_draft_file_was_deleted(tmp_path: Path) -> None:
    sink = WavSink(tmp_path / "a.wav")
    sink.open(FORMAT)
    (draft,) = tmp_path.glob(".a.wav.*.part.wav")
    draft.unlink()
    with pytest.raises(DeviceError, match="cannot be completed"):
        sink.close()


@needs_links
def test_second_sink_on_a_serial_port_is_refused(tmp_path: Path) -> None:
    port = tmp_path / "ttyUSB0"
    port.touch()
    (tmp_path / "by-id").symlink_to(port)
    first = SerialAmplifierSink(str(port))
    first.open(FORMAT)
    for other in (SerialAmplifierSink(str(port)), VhpSink(str(port)), SerialAmplifierSink(str(tmp_path / "by-id"))):
        with pytest.raises(DeviceError, match="another sink plays on the"):
            other.open(FORMAT)
    first.open(FORMAT)
    first.close()
    other.open(FORMAT)
    other.close()


def test_udp_receiver_takes_one_stream_and_many_message_senders() -> None:
    first = UdpSink("127.0.0.1", 9123)
    first.open(FORMAT)
    with pytest.raises(DeviceError, match="another sink plays on the UDP receiver"):
        UdpSink("127.0.0.1", 9123).open(FORMAT)
    UdpSink("127.0.0.1", 9124).open(FORMAT)
    first.close()


def test_tee_refuses_duplicate_sinks() -> None:
    sink = MemorySink()
    for wrong in ("memory", {"kind": "memory"}, sink):
        with pytest.raises(ConfigError, match="must be a list of sinks"):
            TeeSink(wrong)
    for wrong in ([sink, sink], [sink, TeeSink([sink])]):
        with pytest.raises(ConfigError, match="one sink twice"):
            TeeSink(wrong)
