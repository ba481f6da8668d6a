"""The safety layer between a session and its sink."""

import math
import time

import numpy as np
import pytest
from numpy.typing import NDArray

from scene2hap import ActuatorProfile, HapticSession, MemorySink, SessionConfig, Touch
from scene2hap.devices.protocol import Fill, SinkFormat, SinkStats
from scene2hap.errors import ConfigError
from scene2hap.render.safety import FADE_OUT_S, SafetyLayer, SafetyStats
from scene2hap.session.frame import HapticFrame
from scene2hap.session.mix.output import Output
from scenes import RATE, table_with_two_phones

CONFIG = {"sample_rate_hz": RATE}
TOUCHES = [Touch("left", "phone", (0.12, 0.73, 0.4)), Touch("right", "table", (1.45, 0.72, 0.4))]
TAIL = round(FADE_OUT_S * RATE)


class ClockedSink:
    """A sink with a clock that the test drives."""

    def __init__(self) -> None:
        self.fill: Fill | None = None
        self.stats = SinkStats()

    def open(self, format: SinkFormat) -> None:
        pass

    def start(self, fill: Fill) -> None:
        self.fill = fill

    def stop(self) -> None:
        self.fill = None

    def close(self) -> None:
        pass

    def take(self, n_frames: int) -> NDArray[np.float32]:
        assert self.fill is not None
        return self.fill(n_frames)


def mix(n_frames: int) -> NDArray[np.float32]:
    session = HapticSession(*table_with_two_phones(), CONFIG)
    session.update(touches=TOUCHES)
    return session.render(n_frames)


def test_a_sink_gets_the_mix_through_the_layer_and_a_fade_at_the_end() -> None:
    sink = MemorySink()
    with HapticSession(*table_with_two_phones(), CONFIG, sink=sink) as session:
        session.update(touches=TOUCHES)
        for n in (1, 999, 7000):
            sink.pull(n)
        assert set(vars(session.safety_stats).values()) == {0}
    assert len(sink.samples) == 8000 + TAIL
    layer = SafetyLayer(ActuatorProfile(), RATE, 2)
    np.testing.assert_allclose(sink.samples[:8000], layer.process(mix(8000)), atol=1e-6)
    assert np.abs(sink.samples[:8]).max() < 1e-3
    assert np.abs(sink.samples[4000:8000, 0]).max() > 0.29
    assert not sink.samples[-1].any()
    steepest = 2 * math.pi * 1000 / RATE
    assert np.abs(np.diff(sink.samples, axis=0)).max() <= steepest


def test_actuator_profile_sets_the_safety_limits() -> None:
    sink = MemorySink()
    config = {**CONFIG, "actuator": {"max_frequency_hz": 20.5, "min_frequency_hz": 10.0}}
    with HapticSession(*table_with_two_phones(), config, sink=sink) as session:
        session.update(touches=TOUCHES)
        sink.pull(8000)
    # Fourth order: 100 Hz is 1.8 octaves above the corner at 29 Hz, -43 dB.
    assert np.abs(sink.samples[4000:8000, 0]).max() == pytest.approx(0.3 * (2**0.5 * 20.5 / 100) ** 4, rel=0.05)


def test_a_sink_with_a_clock_falls_silent_without_updates(monkeypatch: pytest.MonkeyPatch) -> None:
    now = 100.0
    assert SafetyLayer.__init__.__kwdefaults__ is not None
    monkeypatch.setitem(SafetyLayer.__init__.__kwdefaults__, "clock", lambda: now)
    sink = ClockedSink()
    session = HapticSession(*table_with_two_phones(), {**CONFIG, "watchdog_s": 0.05}, sink=sink)
    session.start()
    assert not sink.take(1000).any()
    session.update(touches=TOUCHES)
    now += 0.049
    assert np.abs(sink.take(1600)).max() > 0.25
    now += 0.002
    assert sink.take(TAIL).any()
    assert not sink.take(800).any()
    assert session.safety_stats.watchdog_trips == 1
    session.update(touches=TOUCHES)
    assert np.abs(sink.take(1600)).max() > 0.25
    # No block is taken during the fade: stop does not wait for ever.
    session.stop()
    assert sink.fill is None


def test_explain_says_that_the_watchdog_has_expired(monkeypatch: pytest.MonkeyPatch) -> None:
    """As in a program that updates once and then waits for an answer: it vibrates for a moment."""
    now = 100.0
    assert SafetyLayer.__init__.__kwdefaults__ is not None
    monkeypatch.setitem(SafetyLayer.__init__.__kwdefaults__, "clock", lambda: now)
    session = HapticSession(*table_with_two_phones(), {**CONFIG, "watchdog_s": 0.05}, sink=ClockedSink())
    session.start()
    session.update(touches=TOUCHES)
    now += 0.049
    assert session.explain("left").reasons == ()
    now += 0.002
    assert "no update came for 0.05 s" in session.explain("left").text
    session.update(touches=TOUCHES)
    assert session.explain("left").reasons == ()
    session.stop()


def test_a_sink_without_a_clock_needs_no_updates() -> None:
    sink = MemorySink()
    with HapticSession(*table_with_two_phones(), {**CONFIG, "watchdog_s": 0.02}, sink=sink) as session:
        session.update(touches=TOUCHES)
        sink.pull(800)
        time.sleep(0.05)
        assert np.abs(sink.pull(800)).max() > 0.25


def test_sink_can_be_closed_before_the_session() -> None:
    sink = MemorySink()
    with HapticSession(*table_with_two_phones(), CONFIG, sink=sink):
        sink.pull(10)
        sink.close()
    assert len(sink.samples) == 10


@pytest.mark.parametrize("watchdog_s", [0.0, 0.019, 1.1, math.nan])
def test_invalid_watchdogs_are_refused(watchdog_s: float) -> None:
    with pytest.raises(ConfigError, match="watchdog_s"):
        SessionConfig.parse({"watchdog_s": watchdog_s})


def test_invalid_actuators_are_refused() -> None:
    with pytest.raises(ConfigError, match="actuator"):
        SessionConfig.parse({"actuator": "no such actuator"})
    assert SessionConfig.parse({"actuator": "lra"}).actuator.max_frequency_hz == 230.0


def test_counters_of_the_safety_layer_stay_after_stop() -> None:
    """A trial reads them at its end; zeros would mean that no guard had to act."""
    sink = MemorySink()
    config = {**CONFIG, "actuator": {"max_amplitude": 0.1, "max_rms": 0.1}}
    with HapticSession(*table_with_two_phones(), config, sink=sink) as session:
        assert session.safety_stats == SafetyStats()
        session.update(touches=TOUCHES)
        sink.pull(8000)
        playing = session.safety_stats
    assert session.safety_stats.peak_limited >= playing.peak_limited > 0
    session.start()
    assert session.safety_stats == SafetyStats()


def test_another_thread_may_stop_a_session_within_an_update(monkeypatch: pytest.MonkeyPatch) -> None:
    """As a pedal that stops everything, or the handler of a signal."""
    output = Output(ClockedSink(), SessionConfig(**CONFIG))
    output.start(lambda n_frames: np.zeros((n_frames, 1), dtype=np.float32), ("left",))
    before_stop = [output._safety]
    with monkeypatch.context() as patch:  # it is there when read once, and gone when read again
        gone = property(lambda self: before_stop.pop() if before_stop else None)
        patch.setattr(Output, "_safety", gone, raising=False)
        output.feed(HapticFrame(np.zeros((1, 0, 1), dtype=np.float32), ("left",), ()))
    output.stop()
