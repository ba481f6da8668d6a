"""Start-up, wind-down and duty cycles of sources in a session."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from scene2hap import HapticBundle, HapticSession, SourceState, Touch
from scene2hap.errors import ConfigError
from scenes import table_with_two_phones, tone_loop

RATE = 48_000
TOUCH = [Touch("left", "phone", (0.1, 0.73, 0.4))]


def session(first: dict[str, Any] | None = None, **settings: Any) -> HapticSession:
    """The room of two phones, one of which has the switching times in `first`."""
    scene, bundle = table_with_two_phones()
    phone = bundle.objects["phone"]
    states = tuple(replace(state, **(first or {})) for state in phone.states)
    objects = {**bundle.objects, "phone": replace(phone, states=states)}
    return HapticSession(scene, replace(bundle, objects=objects), {"prepare": "blocking", **settings})


def envelope(made: HapticSession, seconds: float, step_s: float = 0.05) -> np.ndarray:
    """RMS of the left hand by steps of `step_s`, with an update every 20 ms."""
    blocks = []
    for _ in range(round(seconds * 50)):
        made.update(touches=TOUCH)
        blocks.append(made.render(RATE // 50))
    x = np.concatenate(blocks)[:, 0]
    return np.sqrt((x.reshape(-1, round(step_s * RATE)) ** 2).mean(axis=1))


def test_source_without_times_switches_immediately() -> None:
    made = session()
    steady = envelope(made, 0.5)[-1]
    made.set_source("phone", on=False)
    assert envelope(made, 0.2)[-1] == 0.0
    made.set_source("phone", on=True)
    assert envelope(made, 0.2)[-1] == pytest.approx(steady, rel=0.02)


@pytest.mark.parametrize("spins", [True, False])
@pytest.mark.parametrize("bands", ["dominant", "third-octaves"])
def test_source_starts_and_stops_over_its_times(spins: bool, bands: str) -> None:
    made = session({"start_up_s": 1.0, "wind_down_s": 2.0, "spins": spins}, bands=bands)
    steady = envelope(made, 1.0)[-1]
    made.set_source("phone", on=False)
    down = envelope(made, 2.5)
    assert (np.diff(down[1:]) < 0.05 * steady).all()
    assert down[5] > 0.3 * steady
    assert down[20] < 0.6 * steady
    assert down[-1] == 0.0
    made.set_source("phone", on=True)
    up = envelope(made, 1.5)
    assert up[0] < 0.05 * steady
    assert (np.diff(up) > -0.05 * steady).all()
    assert up[-1] == pytest.approx(steady, rel=0.02)


@pytest.mark.parametrize(
    ("lasts_s", "off_s", "on_s"), [(0.5, 1.0, 1.0), (1.0, 0.3, 1.5)], ids=["after a stop", "during a stop"]
)
def test_loop_is_at_its_position_after_a_start(lasts_s: float, off_s: float, on_s: float) -> None:
    made, plain = session({"start_up_s": lasts_s, "wind_down_s": lasts_s, "spins": True}), session()
    for one in (made, plain):
        one.set_source("alarm", on=False)
        envelope(one, 0.5)
        one.set_source("phone", on=False)
        envelope(one, off_s)
        one.set_source("phone", on=True)
        envelope(one, on_s)
        one.update(touches=TOUCH)
    np.testing.assert_allclose(made.render(4800), plain.render(4800), atol=1e-4)


def test_without_updates_a_stop_stays_silent_and_a_start_steady() -> None:
    made, plain = session({"start_up_s": 0.5, "wind_down_s": 0.5, "spins": True}), session()
    for one in (made, plain):
        one.set_source("alarm", on=False)
        envelope(one, 0.5)
    made.set_source("phone", on=False)
    made.update(touches=TOUCH)
    made.render_s(1.0)
    assert np.abs(made.render_s(10.0)).max() < 1e-4
    plain.render_s(11.0)
    made.set_source("phone", on=True)
    for one in (made, plain):
        one.update(touches=TOUCH)
        one.render_s(1.0)
    np.testing.assert_allclose(made.render_s(10.0), plain.render_s(10.0), atol=1e-4)


def test_interrupted_start_continues_from_its_level() -> None:
    made = session({"start_up_s": 2.0, "wind_down_s": 2.0, "spins": True})
    steady = envelope(made, 0.5)[-1]
    made.set_source("phone", on=False)
    before = envelope(made, 0.5)[-1]
    made.set_source("phone", on=True)
    after = envelope(made, 2.0)
    assert 0.1 * steady < before < 0.9 * steady
    assert after[0] == pytest.approx(before, rel=0.4)
    assert after.min() > 0.5 * before
    assert after[-1] == pytest.approx(steady, rel=0.05)


@pytest.mark.parametrize("after_s", [0.1, 0.2, 0.3, 0.4])
@pytest.mark.parametrize("goes_up", [True, False])
def test_interrupted_start_or_stop_has_no_gap(goes_up: bool, after_s: float) -> None:
    """Two places of a loop that are out of phase cancel each other while one fades into the other, over 20 ms."""
    made = session({"start_up_s": 2.0, "wind_down_s": 2.0, "spins": True})
    made.set_source("alarm", on=False)
    made.set_source("phone", on=goes_up)
    envelope(made, 2.5)
    made.set_source("phone", on=not goes_up)
    first = round(50 * (after_s if goes_up else 2.0 - after_s))
    blocks = []
    for k in range(first + 10):
        if k == first:
            made.set_source("phone", on=goes_up)
        made.update(touches=TOUCH)
        blocks.append(made.render(RATE // 50))
    level = np.sqrt(np.convolve(np.concatenate(blocks)[:, 0] ** 2, np.ones(720) / 720, "valid"))
    before = level[first * RATE // 50 - 2000 :][:1000].mean()
    assert level[first * RATE // 50 - 720 :][:3500].min() > 0.84 * before


def test_switching_causes_no_click() -> None:
    made = session({"start_up_s": 0.3, "wind_down_s": 0.6, "spins": True})
    blocks = []
    for step in range(300):
        if step % 40 == 20:
            made.set_source("phone", on=(step // 40) % 2 == 1)
        made.update(touches=TOUCH)
        blocks.append(made.render(RATE // 100))
    x = np.concatenate(blocks)[:, 0]
    power = np.abs(np.fft.rfft(x * np.hanning(len(x)))) ** 2
    assert 10 * np.log10(power[np.fft.rfftfreq(len(x), 1 / RATE) > 1000].sum() / power.sum()) < -60.0


def test_source_switches_by_its_duty_cycle() -> None:
    made = session({"on_s": 1.0, "off_s": 0.5})
    e = envelope(made, 8.0)
    running = e > 0.5 * e.max()
    assert running[0]
    changes = np.flatnonzero(running[1:] != running[:-1]) + 1
    spans = np.diff(changes) * 0.05
    assert len(spans) >= 7
    assert set(np.round(spans, 1)) <= {0.5, 1.0, 0.4, 0.6, 0.9, 1.1}
    made.set_source("phone", on=False)
    assert envelope(made, 2.0)[2:].max() == 0.0
    made.set_source("phone", on=True)
    assert (envelope(made, 0.8)[2:] > 0.5 * e.max()).all()


def test_duty_cycle_keeps_its_time_over_many_turns_and_stalls() -> None:
    """Parts of a frame by which each turn is late must not add up to minutes within a day."""
    on_s, off_s, frame_s = 0.7123, 0.5281, 1 / 50
    made = session({"on_s": on_s, "off_s": off_s}, sample_rate_hz=8000)
    made.update()
    made.set_source("phone", on=True)  # begins a new on-time
    for number in range(10_000):
        made.update()
        into_turn_s = (made.position + 0.5) / 8000 % (on_s + off_s)  # it switches at the nearest frame
        assert made.source("phone").is_running == (into_turn_s < on_s), number
        made.render_s(frame_s if number % 1000 else 1.7 * on_s + 3 * off_s)


def test_duty_cycle_switches_with_the_update_at_the_end_of_its_turn() -> None:
    """In floating point 1.1 s are a little more than 52,800 frames."""
    made = session({"on_s": 1.1, "off_s": 2.2}, sample_rate_hz=48_000)
    made.update()
    made.set_source("phone", on=True)
    for number in range(100):
        made.update()
        assert made.source("phone").is_running == (number % 33 < 11), number
        made.render(4800)


@pytest.mark.parametrize("after_s", [0.1, 1.2])
@pytest.mark.parametrize("turn", [(None, None), (2.0, 1.0)])
def test_another_state_has_its_own_turns(after_s: float, turn: tuple[float | None, float | None]) -> None:
    """In the on-time and in the rest of the state before: on for the new state's own on-time, None for ever."""
    made = session()
    phone = made._sources["phone"]
    first, other = phone.rows
    cyclic = replace(phone.inferred[first], on_s=1.0, off_s=100.0)
    phone.inferred = {first: cyclic, other: replace(phone.inferred[other], on_s=turn[0], off_s=turn[1])}
    made.set_source("phone", on=True)
    full = envelope(made, after_s).max()
    made.set_source("phone", state=other)
    is_running = envelope(made, 6.0)[2:] > 0.3 * full
    assert is_running[:36].all()
    if turn[0] is None:
        assert is_running.all()
    else:
        changes = np.flatnonzero(is_running[1:] != is_running[:-1]) + 3
        np.testing.assert_allclose(changes * 0.05, [2.0, 3.0, 5.0], atol=0.1)


def test_restored_source_begins_within_its_on_time() -> None:
    """A saved game switches every refrigerator on; they must not turn together from then on."""
    first_off = []
    for on in (None, True):
        made = session({"on_s": 1.0, "off_s": 1.5})
        made.set_source("phone", on=on)
        e = envelope(made, 1.5)
        first_off.append(int(np.flatnonzero(e[2:] < 0.5 * e.max())[0]) + 2)
    assert first_off[1] == first_off[0] < 19


def test_pause_stops_the_duty_cycle() -> None:
    made = session({"on_s": 1.0, "off_s": 100.0})
    envelope(made, 0.1)
    made.pause()
    for _ in range(200):
        made.update(touches=TOUCH)
        made.render(RATE // 50)
    made.resume()
    made.update(touches=TOUCH)
    assert made._sources["phone"].is_running


def test_sources_can_be_removed_during_wind_down() -> None:
    made = session({"wind_down_s": 2.0})
    envelope(made, 0.2)
    made.set_source("phone", on=False)
    envelope(made, 0.2)
    made.remove("phone")
    made.update(touches=[Touch("left", "table", (0.3, 0.72, 0.4))])
    made.render(RATE)
    made.update()
    assert not made.render(RATE // 2).any()


def test_state_change_ends_a_wind_down() -> None:
    made = session({"wind_down_s": 5.0})
    envelope(made, 0.2)
    made.set_source("phone", on=False)
    envelope(made, 0.2)
    made.set_source("phone", state="alarm")
    assert envelope(made, 0.3)[-1] == 0.0


def test_repeated_switching_leaks_no_memory() -> None:
    made = session({"start_up_s": 0.05, "wind_down_s": 0.05})
    for step in range(200):
        made.set_source("phone", on=step % 2 == 1)
        envelope(made, 0.2, 0.1)
    places = made._mixers._places
    assert len(places) == 3
    assert sum(one is not None for one in made._mixers._banks[0].slots) <= 5
    assert len(made._mixers._banks) == 1


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"start_up_s": -1.0}, "start_up_s"),
        ({"wind_down_s": 31.0}, "at most 30"),
        ({"on_s": 1.0}, "give both"),
        ({"on_s": 0.0, "off_s": 1.0}, "on_s"),
        ({"spins": 2}, "spins"),
    ],
)
def test_invalid_times_are_refused(given: dict[str, Any], said: str) -> None:
    with pytest.raises(ConfigError, match=said):
        SourceState("on", 0.5, "fan whirring", "fan whirring", **given)


def test_source_that_is_off_from_the_start_is_silent_at_once() -> None:
    """A game that begins with a machine off, or loads a saved game, is not to play its stop."""
    made = session({"start_up_s": 2.0, "wind_down_s": 2.0, "spins": True})
    made.set_source("phone", on=False)
    made.set_source("alarm", on=False)
    assert envelope(made, 0.5).max() == 0.0
    made.set_source("phone", on=True)
    up = envelope(made, 2.5)
    assert up[5] < 0.3 * up[-1]


def test_added_source_that_is_off_before_the_next_update_is_silent_at_once() -> None:
    made = session({"start_up_s": 2.0, "wind_down_s": 2.0, "spins": True})
    made.set_source("alarm", on=False)
    phone = made.snapshot.object("phone")
    envelope(made, 0.2)
    made.remove("phone")
    made.update()
    made.render_s(0.5)
    made.add(phone)
    made.set_source("phone", on=False)
    assert envelope(made, 0.5).max() == 0.0


@pytest.mark.parametrize(("on", "running"), [(False, "stopping"), (True, "starting")])
def test_explain_reports_starts_and_stops(on: bool, running: str) -> None:
    made = session({"start_up_s": 2.0, "wind_down_s": 2.0, "spins": True})
    made.set_source("alarm", on=False)
    envelope(made, 0.2)
    made.set_source("phone", on=False)
    if on:
        envelope(made, 2.5)
        made.set_source("phone", on=True)
    steady = session()
    steady.set_source("alarm", on=False)
    ratio_db = 20 * np.log10(envelope(made, 0.5)[-1] / envelope(steady, 0.5)[-1])
    (felt,) = made.explain("left").felt
    assert felt.running == running
    assert felt.running_db == pytest.approx(ratio_db, abs=3.0)
    assert f"phone (ringing, {running}: {felt.running_db:+.1f} dB)" in made.explain("left").text
    envelope(made, 2.5)
    assert "phone (ringing)" in made.explain("left").text if on else not made.explain("left").felt


@pytest.mark.parametrize("has_cycles", [True, False])
def test_use_bundle_leaves_a_source_in_its_off_time(has_cycles: bool) -> None:
    """Unless the new bundle says that it runs all the time."""
    made = session({"on_s": 0.3, "off_s": 100.0})
    made.set_source("alarm", on=False)
    full = envelope(made, 0.5).max()
    bundle = made._bundle
    phone = bundle.objects["phone"]
    states = phone.states if has_cycles else tuple(replace(one, on_s=None, off_s=None) for one in phone.states)
    loops = {**bundle.loops, "phone": {"ringing": tone_loop(120), "alarm": tone_loop(240)}}
    made.use_bundle(replace(bundle, loops=loops, objects={**bundle.objects, "phone": replace(phone, states=states)}))
    level = envelope(made, 0.5)
    assert level.max() == 0.0 if has_cycles else level[-1] > 0.9 * full


def with_other_loop(made: HapticSession) -> HapticBundle:
    """The session's bundle with another loop for the phone."""
    bundle = made._bundle
    loops = {**bundle.loops["phone"], "ringing": tone_loop(120)}
    return replace(bundle, loops={**bundle.loops, "phone": loops})


@pytest.mark.parametrize("is_resting", [False, True])
def test_use_bundle_leaves_a_cycle_where_it_is(is_resting: bool) -> None:
    made = session({"on_s": 40.0, "off_s": 100.0})
    envelope(made, 0.2)
    made.set_source("phone", progress=[None, None, is_resting, 30.0])
    made.use_bundle(with_other_loop(made))
    made.update(touches=TOUCH)
    assert made.source("phone").progress == (None, None, is_resting, 30.0)


@pytest.mark.parametrize("on", [False, True])
def test_use_bundle_lets_a_start_or_stop_go_on(on: bool) -> None:
    """It ends with the earlier loop, and the next one is of the new bundle."""
    made = session({"start_up_s": 2.0, "wind_down_s": 2.0, "spins": True})
    made.set_source("alarm", on=False)
    steady = float(envelope(made, 0.2)[-1])
    made.set_source("phone", on=False)
    if on:
        envelope(made, 2.5)
        made.set_source("phone", on=True)
    before = envelope(made, 0.5)[-1]
    made.use_bundle(with_other_loop(made))
    after = envelope(made, 2.5)
    assert after[0] == pytest.approx(before, abs=0.15 * steady)
    assert np.abs(np.diff(after)).max() < 0.15 * steady
    assert after[-1] == pytest.approx(steady, rel=0.05) if on else after[-1] == 0.0
    assert made.source("phone").frequency_hz == pytest.approx(120.0)
