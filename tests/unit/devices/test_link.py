"""The thread of a device sink, with a scripted line that fails on command."""

import math
import threading
import time
from collections.abc import Callable, Iterator

import numpy as np
import pytest
from numpy.typing import NDArray

from scene2hap.devices.link import LiveSink
from scene2hap.devices.protocol import ActuatorSink, SinkEvent, SinkFormat
from scene2hap.errors import DeviceError, DeviceLost, DeviceNotFound
from scene2hap.haptics import ActuatorProfile
from scene2hap.render.safety import SafetyLayer
from serial_bench import eventually

FORMAT = SinkFormat(1000, ("left", "right"))


class ScriptedLine:
    """A scripted device: tests set whether it is present, requests samples and accepts them."""

    def __init__(self) -> None:
        self.there = True
        self.wants = True
        self.n_frames = 4  # in one request
        self.rate_hz = 0  # the session's
        self.error: Exception | None = None
        self.underruns = 0
        self.latency_s: float | None = 0.01
        self.silent_after_s = math.inf
        self.taken: list[NDArray[np.float32]] = []
        self.connects = self.disconnects = 0

    def connect(self, format: SinkFormat, carry_on: Callable[[], bool]) -> int:
        carry_on()
        if not self.there:
            raise DeviceNotFound("no device.")
        self.connects += 1
        return self.rate_hz or format.sample_rate_hz

    def wanted(self, timeout_s: float) -> int:
        time.sleep(min(timeout_s, 0.001))
        if self.error is not None:
            error, self.error = self.error, None
            raise error
        return self.n_frames if self.wants else 0

    def send(self, block: NDArray[np.float32]) -> None:
        self.taken.append(block)

    def disconnect(self) -> None:
        self.disconnects += 1

    @property
    def samples(self) -> NDArray[np.float32]:
        return np.concatenate(self.taken)


class Bench:
    """A sink on a scripted line, with a mix of constant 1 and a list of events."""

    def __init__(self) -> None:
        self.line = ScriptedLine()
        self.events: list[SinkEvent] = []
        self.sink = LiveSink(self.line, "test device", on_event=self.events.append)
        self.asked = 0

    def fill(self, n_frames: int) -> NDArray[np.float32]:
        self.asked += n_frames
        return np.ones((n_frames, 2), dtype=np.float32)

    @property
    def kinds(self) -> list[str]:
        return [event.kind for event in self.events]

    def start(self) -> None:
        self.sink.open(FORMAT)
        self.sink.start(self.fill)


@pytest.fixture
def bench() -> Iterator[Bench]:
    made = Bench()
    yield made
    made.sink.close()
    made.sink.close()
    assert not [thread for thread in threading.enumerate() if thread.name == "test device"]


def test_serial_sink_is_an_actuator_sink(bench: Bench) -> None:
    assert isinstance(bench.sink, ActuatorSink)
    with pytest.raises(DeviceError, match="not open"):
        bench.sink.start(bench.fill)


def test_the_mix_arrives_faded_in(bench: Bench) -> None:
    bench.start()
    assert bench.sink.wait_connected(10)
    assert eventually(lambda: len(bench.line.taken) > 20)
    bench.sink.stop()
    x = bench.line.samples[:, 0]
    # A raised cosine over 50 ms, from its definition.
    n = np.arange(1, 51)
    np.testing.assert_allclose(x[:50], 0.5 - 0.5 * np.cos(np.pi * n / 50), atol=1e-6)
    assert (x[50:] == 1).all()
    stats = bench.sink.stats
    assert (stats.frames, stats.dropped_frames, stats.reconnects) == (len(x), 0, 0)
    assert not stats.connected
    assert bench.kinds == ["connected"]
    assert bench.line.disconnects == 1


def test_missing_device_is_reported_once_and_connected_later(bench: Bench) -> None:
    bench.line.there = False
    bench.start()
    assert eventually(lambda: bench.asked > 300)  # the session's clock continues meanwhile
    assert bench.kinds == ["unavailable"]
    assert bench.events[0].message == "no device. Trying again."
    assert bench.sink.stats.dropped_frames > 280
    assert not bench.sink.stats.connected
    bench.line.there = True
    assert bench.sink.wait_connected(10)
    assert eventually(lambda: bool(bench.line.taken))
    assert bench.kinds == ["unavailable", "connected"]


@pytest.mark.parametrize("error", [DeviceLost("it has gone."), ZeroDivisionError("a driver's bug")])
def test_lost_device_is_reconnected_with_a_fade(bench: Bench, error: Exception) -> None:
    bench.start()
    assert eventually(lambda: len(bench.line.taken) > 20)
    bench.line.error = error
    assert eventually(lambda: bench.sink.stats.reconnects == 1 and bench.line.taken[-1][0, 0] == 1)
    assert bench.kinds == ["connected", "lost", "connected"]
    x = bench.line.samples[:, 0]
    back = int(np.argmin(x[1:])) + 1
    assert x[back] < 0.01
    assert np.abs(np.diff(x[back:])).max() < 0.04  # pi / 2 / 50 at its steepest
    assert bench.sink.stats.faults == isinstance(error, ZeroDivisionError)


@pytest.mark.parametrize("rate_hz", [2000, 4000, 8000])
def test_a_device_of_another_rate_gets_the_whole_fade_out(bench: Bench, rate_hz: int) -> None:
    """A tone of 100 Hz fades out over 8 ms. Every frame of it arrives, so no step is larger than those of the tone."""
    bench.line.rate_hz = rate_hz
    safety = SafetyLayer(ActuatorProfile(), 48000, 1)
    n_asked = 0

    def tone(n_frames: int) -> NDArray[np.float32]:
        nonlocal n_asked
        t = np.arange(n_asked, n_asked + n_frames) / 48000
        n_asked += n_frames
        return (0.5 * np.sin(2 * np.pi * 100 * t)).astype(np.float32)[:, None]

    bench.sink.open(SinkFormat(48000, ("left",)))
    bench.sink.start(safety.guard(tone))
    assert eventually(lambda: n_asked > 12_000)
    safety.release()
    assert safety.silent.wait(60)
    bench.sink.stop()
    x = bench.line.samples[:, 0]
    assert bench.sink.stats.frames == len(x)
    assert np.abs(x[-4:]).max() < 1e-3
    # The tone changes by 0.5 * 2 pi 100 / s, the raised cosine by 0.5 * pi / 2 / 8 ms at most.
    steepest = 0.5 * 2 * np.pi * 100 + 0.5 * np.pi / 2 / 0.008
    assert np.abs(np.diff(x, append=0.0)).max() < 1.05 * steepest / rate_hz


def test_blocks_stay_within_full_scale_at_any_rate(bench: Bench) -> None:
    bench.line.rate_hz, bench.line.n_frames = 8000, 100
    n_asked = 0

    def square(n_frames: int) -> NDArray[np.float32]:
        nonlocal n_asked
        n_asked += n_frames
        return np.tile(np.sign(np.sin(np.arange(n_asked - n_frames, n_asked) / 50 + 0.1))[:, None], 2).astype("f4")

    bench.sink.open(SinkFormat(48000, ("left", "right")))
    bench.sink.start(square)
    assert eventually(lambda: n_asked > 48_000)
    bench.sink.stop()
    assert np.abs(bench.line.samples).max() == 1.0


def test_stop_returns_if_a_device_of_another_rate_takes_no_more_samples(bench: Bench) -> None:
    bench.line.rate_hz = 4000
    bench.start()
    assert eventually(lambda: len(bench.line.taken) > 20)
    bench.line.wants = False
    bench.sink.stop()
    assert not bench.sink.stats.connected
    assert bench.line.disconnects == 1


def test_a_stalled_device_resumes_with_a_fade(bench: Bench) -> None:
    bench.start()
    assert eventually(lambda: len(bench.line.taken) > 20)
    bench.line.wants = False
    assert eventually(lambda: "stalled" in bench.kinds)
    asked = bench.asked
    assert eventually(lambda: bench.asked > asked + 50)
    n = len(bench.line.samples)
    bench.line.wants = True
    assert eventually(lambda: len(bench.line.samples) > n)
    assert bench.line.samples[n, 0] < 0.01
    assert bench.kinds[:3] == ["connected", "stalled", "resumed"]


def test_device_that_stalls_for_long_is_reopened(bench: Bench) -> None:
    bench.start()
    assert bench.sink.wait_connected(10)
    bench.line.wants = False
    assert eventually(lambda: bench.line.connects > 1)
    assert bench.kinds[:4] == ["connected", "stalled", "lost", "connected"]


def test_failing_mix_is_played_as_silence(bench: Bench) -> None:
    def broken(n_frames: int) -> NDArray[np.float32]:
        raise ValueError("no gains")

    bench.sink.open(FORMAT)
    bench.sink.start(broken)
    assert eventually(lambda: len(bench.line.taken) > 5)
    bench.sink.start(lambda n_frames: np.ones((n_frames, 3), dtype=np.float32))
    assert eventually(lambda: any("shape" in event.message for event in bench.events))
    assert not bench.line.samples.any()
    assert bench.sink.stats.faults > 0
    assert "fault" in bench.kinds


def test_failing_event_callback_does_not_stop_playback(bench: Bench) -> None:
    def broken(event: SinkEvent) -> None:
        raise RuntimeError("game over")

    bench.sink.on_event = broken
    bench.start()
    assert eventually(lambda: len(bench.line.taken) > 5)
    assert bench.sink.stats.faults == 1


def test_sink_can_be_started_several_times(bench: Bench) -> None:
    for _ in range(3):
        bench.start()
        assert bench.sink.wait_connected(10)
        bench.sink.stop()
        bench.sink.stop()
    assert bench.line.connects == bench.line.disconnects == 3
    bench.sink.close()
    with pytest.raises(DeviceError, match="not open"):
        bench.sink.start(bench.fill)


def played_around_a_pause(bench: Bench, pause: Callable[[], object], resume: Callable[[], None]) -> tuple[float, float]:
    """The last sample before a pause and the first one after it, of a mix of 1."""
    bench.start()
    assert eventually(lambda: len(bench.line.taken) * 4 > 200)  # after the fade-in of 50 frames
    pause()
    n_before = len(bench.line.taken)
    resume()
    assert eventually(lambda: len(bench.line.taken) > n_before + 2)
    bench.sink.close()
    return float(bench.line.taken[n_before - 1][-1, 0]), float(bench.line.taken[n_before][0, 0])


def test_samples_fade_in_after_a_pause_in_which_the_device_has_run_dry(bench: Bench) -> None:
    """As when the program is stopped and continued: the pause may come while the sink renders."""
    bench.line.silent_after_s = 0.1
    halt, halted, goes_on = threading.Event(), threading.Event(), threading.Event()
    plain_fill = bench.fill

    def fill(n_frames: int) -> NDArray[np.float32]:
        if halt.is_set():
            halt.clear()
            halted.set()
            assert goes_on.wait(60)
            time.sleep(0.2)
        return plain_fill(n_frames)

    bench.fill = fill  # type: ignore[method-assign]
    before, after = played_around_a_pause(bench, lambda: (halt.set(), halted.wait()), goes_on.set)
    assert before == 1.0
    assert after < 0.01


def test_a_line_that_fades_by_itself_gets_the_mix_as_it_is(bench: Bench) -> None:
    def pause() -> None:
        bench.line.wants = False
        time.sleep(0.2)

    def resume() -> None:
        bench.line.wants = True

    assert played_around_a_pause(bench, pause, resume) == (1.0, 1.0)


def test_underruns_are_counted_from_open(bench: Bench) -> None:
    """A line lives as long as its sink: a trial must not report the gaps of the trials before it."""
    bench.line.underruns = 3
    bench.start()
    bench.line.underruns += 2
    assert bench.sink.stats.underruns == 2


def test_events_name_their_sink(bench: Bench) -> None:
    """A TeeSink passes on the events of all its sinks."""
    bench.start()
    assert eventually(lambda: bench.events)
    assert bench.events[0].sink == "test device"
