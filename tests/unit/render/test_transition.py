"""Transitions (starts and stops of a loop): position, speed and level are as stated, without a click."""

from __future__ import annotations

import tracemalloc

import numpy as np
import pytest
from scipy.signal import firwin

from scene2hap import AudioClip, Bands
from scene2hap.audio.run_curve import RunCurve
from scene2hap.render.loop_bank import CELL, LoopBank, Slot, read
from scene2hap.render.transition import LEAD_S, STEADY, STILL, Running, Transition, TransitionCurve

RATE = 8000
AFTER = 5 * RATE
"""Longer than any transition here, so that one that repeats is seen."""


def bank(frequency_hz: float = 100.0, bands: Bands | None = None) -> LoopBank:
    t = np.arange(RATE) / RATE
    return LoopBank(
        [AudioClip(np.sin(2 * np.pi * frequency_hz * t).astype(np.float32), RATE)], bands or Bands.dominant(), RATE
    )


def played(one: Slot, begin: int, n: int, n_bands: int = 1) -> np.ndarray:
    out, cells = np.zeros((n_bands, CELL), np.float32), []
    for at in range(begin, begin + n, CELL):
        read([one.only(at)], at, out)
        cells.append(out.T.copy())
    return np.concatenate(cells)[:n]


def transition(
    *, goes_up: bool = True, spins: bool = True, curve: RunCurve | None = None, since: Running | None = None
) -> Transition:
    """A transition of one second. By default it begins at rest, or in steady running for a stop."""
    course = TransitionCurve(goes_up, spins, curve)
    return Transition(bank(), 12_345, 1.0, course, since or (STILL if goes_up else STEADY))


@pytest.mark.parametrize("begin", [0, 7, 8000, 123_456_789])
def test_bank_taken_equals_the_played_samples(begin: int) -> None:
    one = bank(100.0, Bands((50.0, 150.0, 400.0)))
    np.testing.assert_allclose(one.taken(0, begin, 2400), played(one, begin, 2400, one.n_bands), atol=1e-6)


@pytest.mark.parametrize("spins", [True, False])
def test_start_ends_as_the_loop(spins: bool) -> None:
    up = transition(spins=spins)
    assert up.end == 12_345 + RATE
    np.testing.assert_allclose(played(up, up.end, AFTER), played(bank(), up.end, AFTER), atol=5e-3)
    assert np.abs(played(up, 12_345, 160)).max() < 0.02


@pytest.mark.parametrize("spins", [True, False])
@pytest.mark.parametrize("lasts_s", [0.002, 0.015, 1.0])
def test_stop_begins_as_the_loop_and_ends_in_silence(spins: bool, lasts_s: float) -> None:
    down = Transition(bank(), 12_345, lasts_s, TransitionCurve(False, spins), STEADY)
    lead = round(LEAD_S * RATE)
    np.testing.assert_allclose(played(down, 12_345, lead), played(bank(), 12_345, lead), atol=5e-3)
    assert np.abs(played(down, down.end, AFTER)).max() < 1e-6


@pytest.mark.parametrize("goes_up", [True, False])
def test_motor_is_at_the_integral_of_its_speed(goes_up: bool) -> None:
    one, lead = transition(goes_up=goes_up), 0 if goes_up else round(LEAD_S * RATE)
    x = np.arange(-lead, RATE) / RATE
    u = np.maximum(x, 0)
    turns = u**2 - u**3 / 3 + 1 / 3 if goes_up else (1 - (1 - u) ** 3) / 3 + np.minimum(x, 0) + lead / RATE
    amplitude = (u * (2 - u)) ** 2 if goes_up else (1 - u) ** 4
    expected = amplitude * np.sin(2 * np.pi * 100.0 * (turns + 12_345 / RATE))
    # A stop sets in over 10 ms, so it is 0.03 ms ahead of this course: 0.02 rad.
    np.testing.assert_allclose(played(one, 12_345, len(x))[:, 0], expected, atol=5e-4 if goes_up else 0.02)


def test_cells_are_the_same_in_any_order() -> None:
    """Mixers of different hands read one transition, each at cells of its own."""
    whole, one = played(transition(), 12_345, RATE), transition()
    for first in (4807, 13, 7000, 0, 480, 479):
        cell = played(one, 12_345 + first, CELL)
        np.testing.assert_allclose(cell, whole[first : first + CELL], atol=1e-6)


@pytest.mark.parametrize("is_interrupting", [True, False])
def test_long_passage_is_not_computed_as_a_whole(is_interrupting: bool) -> None:
    """It would delay a frame of the game: 30 s in 20 bands took 170 ms, and 19 MB."""
    steady, before = bank(163.0, Bands.third_octaves()), None
    since = Running(0.5, 0.25) if is_interrupting else STILL
    if is_interrupting:
        before = Transition(steady, 0, 30.0, TransitionCurve(False, True), STEADY)
    tracemalloc.start()
    try:
        one = Transition(steady, 100_000, 30.0, TransitionCurve(True, True), since, before)
        played(one, 100_000, CELL, steady.n_bands)
        assert tracemalloc.get_traced_memory()[1] < 1_000_000
    finally:
        tracemalloc.stop()


def crossings_hz(samples: np.ndarray) -> float:
    signs = np.signbit(samples[:, 0])
    return float(np.count_nonzero(signs[1:] != signs[:-1]) / 2 / (len(samples) / RATE))


def test_spinning_source_rises_in_pitch_and_force() -> None:
    up = played(transition(), 12_345, RATE)
    for x in (0.3, 0.5, 0.8):
        around = up[round((x - 0.05) * RATE) : round((x + 0.05) * RATE)]
        speed = x * (2 - x)
        assert crossings_hz(around) == pytest.approx(100 * speed, abs=10)
        assert np.abs(around).max() == pytest.approx(((x + 0.05) * (1.95 - x)) ** 2, rel=0.1)


def test_non_spinning_source_keeps_its_pitch() -> None:
    up = played(transition(spins=False), 12_345, RATE)
    assert crossings_hz(up[2000:6000]) == pytest.approx(100, abs=2)
    assert np.abs(up[3900:4100]).max() == pytest.approx(0.5, rel=0.05)


@pytest.mark.parametrize("goes_up", [True, False])
@pytest.mark.parametrize("speed", [0.1, 0.5, 0.9])
def test_passage_can_start_at_an_intermediate_level(goes_up: bool, speed: float) -> None:
    one, whole = transition(goes_up=goes_up, since=Running(speed, speed**2)), transition(goes_up=goes_up)
    assert one.running(12_345) == pytest.approx((speed, speed**2), abs=1e-3)
    assert one.running(one.end) == pytest.approx((float(goes_up), float(goes_up)))
    assert one.end < whole.end
    assert np.abs(played(one, 12_345, 240)).max() == pytest.approx(speed**2, rel=0.25, abs=0.02)


@pytest.mark.parametrize("goes_up", [True, False])
@pytest.mark.parametrize("spins", [True, False])
@pytest.mark.parametrize("amplitude", [0.05, 0.5, 0.95])
def test_interrupted_passage_continues_from_the_felt_level(goes_up: bool, spins: bool, amplitude: float) -> None:
    speed = 0.6 if spins else 1.0
    one = transition(goes_up=goes_up, spins=spins, since=Running(speed, amplitude))
    assert one.running(12_345) == pytest.approx((speed, amplitude), abs=1e-3)
    assert one.running(one.end).amplitude == pytest.approx(float(goes_up), abs=1e-6)


@pytest.mark.parametrize("after_samples", [1234, 3001, 5777])
@pytest.mark.parametrize("spins", [True, False])
@pytest.mark.parametrize("goes_up", [True, False])
def test_interrupting_passage_continues_the_waveform(goes_up: bool, spins: bool, after_samples: int) -> None:
    """A place elsewhere in the loop would be a jump of its phase: a click."""
    steady, at = bank(163.0), 12_345 + after_samples
    interrupted = Transition(steady, 12_345, 1.0, TransitionCurve(not goes_up, spins), STEADY if goes_up else STILL)
    since = interrupted.running(at)
    following = Transition(steady, at, 1.0, TransitionCurve(goes_up, spins), since, interrupted)
    expected, found = played(interrupted, at, CELL), played(following, at, CELL)
    assert np.abs(found - expected).max() < 0.05 * since.amplitude + 0.01
    # Of the places that sound alike, one per period, a start takes the nearest: a longer shift bends the pitch more.
    assert abs(following._shift) <= RATE / 163.0 / 2 + 2


def backwards(curve: RunCurve) -> RunCurve:
    return RunCurve(curve.lasts_s, curve.amplitude[::-1], curve.speed[::-1])


STEPPED = RunCurve(1.0, (0.0, 0.02, 0.3, 0.32, 0.9, 1.0), (0.0, 0.4, 0.5, 0.8, 0.95, 1.0))


@pytest.mark.parametrize("goes_up", [True, False])
@pytest.mark.parametrize("curve", [STEPPED, RunCurve(1.0, STEPPED.amplitude)])
def test_a_recorded_curve_is_followed(goes_up: bool, curve: RunCurve) -> None:
    one = transition(goes_up=goes_up, curve=curve if goes_up else backwards(curve))
    lead = 0 if goes_up else round(LEAD_S * RATE)
    for x in (0.2, 0.5, 0.7):
        at = round((x if goes_up else 1 - x) * RATE) + lead
        around = played(one, 12_345, one.end - 12_345)[at - 400 : at + 400]
        amplitude = np.interp(x, np.linspace(0, 1, 6), STEPPED.amplitude)
        speed = np.interp(x, np.linspace(0, 1, 6), STEPPED.speed) if curve.speed else np.sqrt(amplitude)
        assert crossings_hz(around) == pytest.approx(100 * speed, abs=10)
        rms = np.interp(x + np.linspace(-0.05, 0.05, 101), np.linspace(0, 1, 6), STEPPED.amplitude)
        assert np.sqrt(2 * (around**2).mean()) == pytest.approx(np.sqrt((rms**2).mean()), rel=0.15)


def test_non_spinning_source_keeps_its_pitch_along_a_recorded_curve() -> None:
    up = played(transition(spins=False, curve=RunCurve(1.0, STEPPED.amplitude)), 12_345, RATE)
    assert crossings_hz(up[2000:6000]) == pytest.approx(100, abs=2)


def test_recorded_passage_ends_at_the_loop_position() -> None:
    up = transition(curve=STEPPED)
    np.testing.assert_allclose(played(up, up.end, AFTER), played(bank(), up.end, AFTER), atol=5e-3)


@pytest.mark.parametrize("goes_up", [True, False])
@pytest.mark.parametrize("spins", [True, False])
@pytest.mark.parametrize("curve", [None, STEPPED])
def test_passage_causes_no_click(goes_up: bool, spins: bool, curve: RunCurve | None) -> None:
    one = transition(goes_up=goes_up, spins=spins, curve=curve if goes_up or curve is None else backwards(curve))
    before = np.zeros((2000, 1)) if goes_up else played(bank(), 10_345, 2000)
    samples = np.concatenate([before, played(one, 12_345, one.end - 12_345 + 2000)])[:, 0]
    power = np.abs(np.fft.rfft(samples * np.hanning(len(samples)))) ** 2
    f = np.fft.rfftfreq(len(samples), 1 / RATE)
    assert 10 * np.log10(power[f > 1000].sum() / power.sum()) < -60.0


@pytest.mark.parametrize("goes_up", [True, False])
@pytest.mark.parametrize("frequency_hz", [100.0, 250.0, 380.0])
def test_short_passage_of_a_motor_clicks_less_than_a_step_of_60_db_below_full_scale(
    goes_up: bool, frequency_hz: float
) -> None:
    """A motor at -6 dB that stops within 0.1 s slows down at once; 1 / (2 pi f)^2 is the energy of a step."""
    one = Transition(bank(frequency_hz), 12_345, 0.1, TransitionCurve(goes_up, True), STILL if goes_up else STEADY)
    samples = 0.5 * played(one, 12_345, 1600)[:, 0].astype(np.float64)
    high = firwin(401, (1150, 3500), pass_zero=False, window=("kaiser", 10.06), fs=RATE)
    before = np.zeros(800) if goes_up else 0.5 * played(bank(frequency_hz), 11_545, 800)[:, 0]
    after = 0.5 * played(bank(frequency_hz), 13_945, 800)[:, 0] if goes_up else np.zeros(800)
    heard = np.convolve(np.concatenate([before, samples, after]), high, mode="valid")
    step = 1e-6 * RATE / (2 * np.pi**2) * (1 / 1150 - 1 / 3500)
    assert (heard**2).sum() < step


@pytest.mark.parametrize("goes_up", [True, False])
def test_passage_of_a_high_tone_has_no_images(goes_up: bool) -> None:
    """A blender's 380 Hz gets slower or faster; nothing arises above 1 kHz."""
    one = Transition(bank(380.0), 12_345, 1.0, TransitionCurve(goes_up, True), STILL if goes_up else STEADY)
    x = played(one, 12_345, RATE)[:, 0].astype(np.float64)
    power = np.abs(np.fft.rfft(x * np.hanning(len(x)))) ** 2
    above = np.fft.rfftfreq(len(x), 1 / RATE) > 1000
    assert 10 * np.log10(power[above].sum() / power.sum()) < -70


def test_passage_plays_all_bands() -> None:
    one = Transition(bank(100.0, Bands((50.0, 150.0, 400.0))), 0, 0.5, TransitionCurve(True, True), STILL)
    assert np.abs(played(one, one.end, 800, n_bands=2)).max(axis=0) == pytest.approx([1.0, 0.0], abs=0.1)
