"""TeeSink: one mix is sent to several sinks."""

import threading
import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import soundfile
from numpy.typing import NDArray

from scene2hap.devices import SINKS
from scene2hap.devices.memory import MemorySink
from scene2hap.devices.protocol import ActuatorSink, Fill, SinkEvent, SinkFormat, SinkStats
from scene2hap.devices.tee import TeeSink
from scene2hap.devices.wav import WavSink
from scene2hap.errors import ConfigError, DeviceError

FORMAT = SinkFormat(1000, ("left", "right"))


class Counting:
    """A mix whose sample values are their positions."""

    def __init__(self) -> None:
        self.position = 0

    def __call__(self, n_frames: int) -> NDArray[np.float32]:
        place = np.arange(self.position, self.position + n_frames, dtype=np.float32)
        self.position += n_frames
        return np.stack([place, -place], axis=1)


class Device:
    """A device whose clock the test drives."""

    def __init__(self) -> None:
        self.on_event = None
        self.shown: list[object] = []
        self.fill: Fill | None = None
        self.frames = 0

    def open(self, format: SinkFormat) -> None: ...

    def start(self, fill: Fill) -> None:
        self.fill = fill

    def stop(self) -> None:
        self.fill = None

    def close(self) -> None:
        self.stop()

    def show(self, frame: object) -> None:
        self.shown.append(frame)

    def take(self, n_frames: int) -> NDArray[np.float32]:
        assert self.fill is not None
        self.frames += n_frames
        return self.fill(n_frames)[:, 0]

    @property
    def stats(self) -> SinkStats:
        return SinkStats(frames=self.frames, connected=False, latency_s=0.01 * self.frames)


def test_sinks_read_the_same_samples_at_their_own_pace() -> None:
    a, b, memory = Device(), Device(), MemorySink()
    tee = TeeSink([a, b, memory])
    tee.open(FORMAT)
    tee.start(Counting())
    got_a = np.concatenate([a.take(n) for n in (5, 20, 7)])
    got_b = np.concatenate([b.take(n) for n in (30, 1, 3)])
    np.testing.assert_array_equal(got_a, np.arange(32))
    np.testing.assert_array_equal(got_b, np.arange(34))
    np.testing.assert_array_equal(memory.samples[:, 0], np.arange(34))
    assert tee.stats == SinkStats(frames=100, latency_s=pytest.approx(0.34), connected=True)
    tee.close()
    tee.close()


@pytest.mark.parametrize("n_block", [1, 2, 20])
def test_sink_that_lags_too_far_skips_ahead_with_a_crossfade(n_block: int) -> None:
    """It lasts 5 ms, here 5 frames, however short the blocks are."""
    a, b = Device(), Device()
    tee = TeeSink([a, b])
    tee.open(FORMAT)
    tee.start(Counting())
    b.take(20)
    for _ in range(8):
        a.take(20)  # b is 140 behind, more than 100 and a block of 20
    got = np.concatenate([b.take(n_block) for _ in range(20 // n_block)])
    rising = np.minimum(np.arange(1, 21) / 5, 1)
    np.testing.assert_allclose(got, (1 - rising) * np.arange(20, 40) + rising * np.arange(160, 180), atol=1e-3)
    np.testing.assert_array_equal(b.take(5), np.arange(180, 185))
    for _ in range(100):
        a.take(20)  # too far behind for samples to fade from
    np.testing.assert_allclose(b.take(20), rising * np.arange(2160, 2180), atol=1e-3)
    tee.stop()


@pytest.mark.parametrize("n_long", [150, 1024])
def test_a_device_of_long_blocks_does_not_hurry_the_others(n_long: int) -> None:
    """Both devices play at the same rate, one in blocks that are longer than the lag of 0.1 s."""
    long, short = Device(), Device()
    tee = TeeSink([long, short])
    tee.open(FORMAT)
    tee.start(Counting())
    got_long, got_short = [], []
    for n in range(0, 3 * n_long, 10):
        if n % n_long == 0:
            got_long.append(long.take(n_long))
        got_short.append(short.take(10))
    for got in (np.concatenate(got_long), np.concatenate(got_short)):
        np.testing.assert_array_equal(got, np.arange(len(got)))
    tee.stop()


def test_tee_of_files_can_be_pulled(tmp_path: Path) -> None:
    wav, memory = WavSink(tmp_path / "a.wav"), MemorySink()
    tee = TeeSink([wav, memory])
    tee.open(SinkFormat(1000, ("left",)))
    with pytest.raises(DeviceError, match="not started"):
        tee.pull(3)
    tee.start(lambda n: np.full((n, 1), 0.5, dtype=np.float32))
    tee.pull(30)
    tee.close()
    np.testing.assert_array_equal(soundfile.read(wav.path)[0], np.full(30, 0.5))
    assert memory.stats.frames == 30


@pytest.mark.parametrize("n_pulled", [0, 4])
def test_a_part_of_a_tee_is_not_pulled_itself(n_pulled: int) -> None:
    part = MemorySink()
    tee = TeeSink([part, MemorySink()])
    tee.open(FORMAT)
    tee.start(Counting())
    tee.pull(n_pulled)
    with pytest.raises(DeviceError, match="pull the TeeSink"):
        part.pull(4)  # would store the last block once more, or nothing
    tee.pull(4)
    np.testing.assert_array_equal(part.samples[:, 0], np.arange(n_pulled + 4))


def test_abort_leaves_no_file(tmp_path: Path) -> None:
    tee = TeeSink([WavSink(tmp_path / "a.wav"), Device()])
    tee.open(FORMAT)
    tee.start(Counting())
    tee.abort()
    assert list(tmp_path.iterdir()) == []


def test_failure_to_open_one_sink_closes_the_others(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("in the way")
    device = Device()
    tee = TeeSink([WavSink(tmp_path / "a.wav"), device, WavSink(tmp_path / "file" / "b.wav")])
    with pytest.raises(DeviceError, match="cannot be written"):
        tee.open(FORMAT)
    assert device.on_event is None
    assert [path.name for path in tmp_path.iterdir()] == ["file"]


def test_events_and_gains_are_passed_on() -> None:
    device = Device()
    told: list[SinkEvent] = []
    tee = TeeSink([device, MemorySink()], on_event=told.append)
    event = SinkEvent("lost", "it has gone.", 1.0)
    tee.open(FORMAT)
    assert device.on_event is not None
    device.on_event(event)
    assert told == [event]
    tee.show("frame")
    assert device.shown == ["frame"]
    tee.close()
    assert device.on_event is None


class FullDisk(MemorySink):
    """A recorder that fails from its 100th frame on."""

    def pull(self, n_frames: int) -> NDArray[np.float32]:
        if len(self.samples) >= 100:
            raise DeviceError("the disk is full.")
        return super().pull(n_frames)


@pytest.mark.parametrize("on_event", [lambda events: events.append, lambda events: lambda event: 1 / 0])
def test_a_recorder_that_fails_does_not_silence_the_devices(on_event: Any) -> None:
    events: list[SinkEvent] = []
    device, full, memory = Device(), FullDisk(), MemorySink()
    tee = TeeSink([full, device, memory], on_event=on_event(events))
    tee.open(FORMAT)
    tee.start(Counting())
    got = np.concatenate([device.take(50) for _ in range(6)])
    np.testing.assert_array_equal(got, np.arange(300))
    np.testing.assert_array_equal(memory.samples[:, 0], np.arange(300))
    np.testing.assert_array_equal(full.samples[:, 0], np.arange(100))
    assert tee.stats.faults == (1 if events else 2)
    if events:
        assert [event.kind for event in events] == ["fault"]
        assert events[0].message == "FullDisk gets no more of the mix, the other sinks play on: the disk is full."
    tee.close()


def test_a_failing_recorder_without_a_device_raises() -> None:
    tee = TeeSink([FullDisk(), MemorySink()])
    tee.open(FORMAT)
    tee.start(Counting())
    tee.pull(100)
    with pytest.raises(DeviceError, match="the disk is full"):
        tee.pull(1)
    tee.close()


def test_tee_is_built_from_settings(tmp_path: Path) -> None:
    tee = SINKS.build({"kind": "tee", "sinks": ["memory", {"kind": "wav", "path": str(tmp_path / "a.wav")}]})
    assert isinstance(tee, TeeSink)
    assert isinstance(tee, ActuatorSink)
    assert [type(sink) for sink in tee.sinks] == [MemorySink, WavSink]
    with pytest.raises(ConfigError, match="at least one sink"):
        TeeSink([])
    with pytest.raises(ConfigError, match="3 is given; it must be a kind"):
        TeeSink([3])


class Slow(Device):
    """A device that takes 10 frames every 10 ms, on a thread of its own."""

    def start(self, fill: Fill) -> None:
        super().start(fill)
        self.got: list[NDArray[np.float32]] = []
        self._runs = True
        self._thread = threading.Thread(target=self._run)
        self._thread.start()

    def _run(self) -> None:
        while self._runs:
            self.got.append(self.take(10))
            time.sleep(0.01)

    def stop(self) -> None:
        self._runs = False
        self._thread.join()
        super().stop()


def test_a_slow_device_reads_the_fade_out_before_it_is_stopped() -> None:
    fast, slow = Device(), Slow()
    tee = TeeSink([slow, fast])
    tee.open(FORMAT)
    tee.start(Counting())
    fast.take(80)  # the mix ends here
    tee.stop()
    assert np.concatenate(slow.got)[:80].tolist() == [*range(80)]


class Stuck(Device):
    """A device whose driver raises when it is stopped and when it is closed."""

    def stop(self) -> None:
        raise DeviceError("it was unplugged")


@pytest.mark.parametrize("call", ["stop", "close", "abort"])
def test_all_devices_stop_if_one_raises(call: str) -> None:
    stuck, sound = Stuck(), Device()
    tee = TeeSink([stuck, sound])
    tee.open(FORMAT)
    tee.start(Counting())
    with pytest.raises(DeviceError, match="unplugged"):
        getattr(tee, call)()
    assert sound.fill is None


def test_a_sink_that_changes_its_blocks_does_not_change_those_of_the_others() -> None:
    """As a sink that scales to its amplifier: the others would play samples beyond the limits of the safety layer."""
    scaling, device, memory = Device(), Device(), MemorySink()

    class ScalingRecorder(MemorySink):
        def pull(self, n_frames: int) -> NDArray[np.float32]:
            block = super().pull(n_frames)
            block *= 3.0
            return block

    tee = TeeSink([ScalingRecorder(), memory, scaling, device])
    tee.open(FORMAT)
    tee.start(Counting())
    assert scaling.fill is not None
    for _ in range(3):
        block = scaling.fill(4)
        block *= 3.0
    np.testing.assert_array_equal(device.take(12), np.arange(12))
    np.testing.assert_array_equal(memory.samples[:, 0], np.arange(12))
