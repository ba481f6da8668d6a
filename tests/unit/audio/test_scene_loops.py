"""Whole conversion of the demo kitchen's seven sources, which the synthesizer makes from fixed words."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache
from itertools import combinations

import numpy as np
import pytest
from scipy.signal import hilbert

from scene2hap.audio.actuators import ACTUATORS
from scene2hap.audio.clip import AudioClip
from scene2hap.audio.haptic_loop import HapticLoop
from scene2hap.audio.levels import threshold_db
from scene2hap.audio.protocol import ConversionContext
from scene2hap.audio.scene_loops import Plan, SourceClip, felt_loop, plan_scene
from scene2hap.audio.select import select_clip
from scene2hap.audio.sources.synth import Synthesizer
from scene2hap.audio.tactile.adaptive import Adaptive
from scene2hap.audio.tactile.auto import Auto
from scene2hap.audio.tactile.lowpass import Lowpass
from scene2hap.audio.tactile.svf_bandpass import SvfBandpass
from scene2hap.haptics import ActuatorProfile, VibrationDescription

FLAT = ActuatorProfile()
KITCHEN = {
    "washing machine": ("spinning", 1.0, (0.85, 0.6, 0.6)),
    "smartphone": ("vibrating", 0.5, (0.15, 0.07, 0.008)),
    "electric toothbrush": ("brushing", 0.5, (0.25, 0.03, 0.03)),
    "handheld fan": ("blowing", 0.35, (0.2, 0.1, 0.05)),
    "cooker hood": ("ventilating", 0.25, (0.6, 0.5, 0.4)),
    "microwave": ("humming", 0.2, (0.5, 0.4, 0.3)),
    "refrigerator": ("humming", 0.1, (1.8, 0.6, 0.65)),
}


@cache
def kitchen() -> dict[str, SourceClip]:
    sources = {}
    for name, (verb, intensity, size_m) in KITCHEN.items():
        wanted = VibrationDescription(name, "on", f"{name} {verb}", f"{name} {verb}", intensity, size_m)
        sources[name] = SourceClip(select_clip(Synthesizer().find(wanted)), intensity, name)
    return sources


@pytest.fixture(scope="module")
def baked() -> dict[str, tuple[Plan, HapticLoop]]:
    sources = kitchen()
    plans = plan_scene(list(sources.values()), Adaptive(), FLAT)
    return {
        name: (plan, felt_loop(source.clip, Adaptive(), plan))
        for (name, source), plan in zip(sources.items(), plans, strict=True)
    }


@cache
def spectrum(loop: HapticLoop) -> tuple[np.ndarray, np.ndarray]:
    x = loop.tactile.samples.astype(float)
    return np.fft.rfftfreq(len(x), 1 / loop.tactile.sample_rate_hz), 2 * np.abs(np.fft.rfft(x)) / len(x)


def peak_hz(loop: HapticLoop) -> float:
    f, a = spectrum(loop)
    return float(f[np.argmax(a)])


def level_db(loop: HapticLoop) -> float:
    f, a = spectrum(loop)
    inside = (f >= 10) & (f <= 1000)
    return float(10 * np.log10(np.sum((a[inside] / 10 ** (threshold_db(f[inside]) / 20)) ** 2)))


# The smallest published Weber fraction, and the one that `threshold` uses.
@pytest.mark.parametrize("weber", [0.18, 0.22])
def test_every_pair_of_the_kitchen_is_distinct(baked: dict[str, tuple[Plan, HapticLoop]], weber: float) -> None:
    for one, other in combinations(baked, 2):
        (_, a), (_, b) = baked[one], baked[other]
        jnds = abs(math.log(peak_hz(a) / peak_hz(b))) / math.log1p(weber)
        levels = abs(level_db(a) - level_db(b)) / 2.5
        assert jnds >= 2.0 or (jnds >= 1.0 and levels >= 2.0), (one, other, jnds, levels)
        assert jnds >= 1.0, (one, other)


def test_the_order_of_intensities_is_kept(baked: dict[str, tuple[Plan, HapticLoop]]) -> None:
    for one, other in combinations(KITCHEN, 2):
        if KITCHEN[one][1] > KITCHEN[other][1]:
            assert level_db(baked[one][1]) > level_db(baked[other][1]), (one, other)


def test_nothing_is_moved_further_than_a_third_of_an_octave_or_3_db(
    baked: dict[str, tuple[Plan, HapticLoop]],
) -> None:
    sources = kitchen()
    for name, (plan, loop) in baked.items():
        assert plan.context.own_hz is not None
        assert abs(math.log2(peak_hz(loop) / plan.context.own_hz)) <= 1 / 3, name
        # The original frequency is in the source's spectrum, not far below its strongest component.
        x = sources[name].clip.samples.astype(float)
        magnitude = np.abs(np.fft.rfft(x * np.hanning(len(x))))
        f = np.fft.rfftfreq(len(x), 1 / sources[name].clip.sample_rate_hz)
        near = np.abs(f - plan.context.own_hz) < 1.0
        assert magnitude[near].max() > magnitude[(f > 20) & (f < 1000)].max() * 10 ** (-24 / 20), name
        intended = 31.0 + 17.0 * math.log10(KITCHEN[name][1])
        assert abs(level_db(loop) - intended) <= 3.0, name


def test_loops_are_still_felt_12_db_further_away(baked: dict[str, tuple[Plan, HapticLoop]]) -> None:
    for name, (_, loop) in baked.items():
        assert level_db(loop) > 12.0, name


def test_strongest_frequency_of_a_loop_is_also_felt_most(baked: dict[str, tuple[Plan, HapticLoop]]) -> None:
    for name, (_, loop) in baked.items():
        f, a = spectrum(loop)
        inside = (f >= 10) & (f <= 1000)
        felt = np.where(inside, a / 10 ** (threshold_db(np.maximum(f, 1.0)) / 20), 0.0)
        assert float(f[np.argmax(felt)]) == pytest.approx(peak_hz(loop), rel=0.01), name
        assert loop.frequency_tactile_hz == pytest.approx(peak_hz(loop), rel=0.01), name


def test_frequency_of_a_loop_is_the_one_that_is_felt_most() -> None:
    """In an earlier version it was the strongest: a refrigerator felt at 84 Hz was listed, and attenuated, at 35 Hz."""
    t = np.arange(3 * 48_000) / 48_000
    hum = 0.1 * np.sin(2 * np.pi * 35.0 * t) + 0.06 * np.sin(2 * np.pi * 84.0 * t)
    plan = Plan(ConversionContext(FLAT, 0.1), 10.0)
    loop = felt_loop(AudioClip(hum.astype(np.float32), 48_000), Lowpass(), plan)
    assert peak_hz(loop) == pytest.approx(35.0, abs=0.5)
    assert loop.frequency_tactile_hz == pytest.approx(84.0, abs=0.1)


def test_no_peak_exceeds_the_head_room(baked: dict[str, tuple[Plan, HapticLoop]]) -> None:
    for name, (_, loop) in baked.items():
        assert np.abs(loop.tactile.samples).max() <= 0.502, name


def test_plan_sets_no_target_for_a_converter_without_targets() -> None:
    sources = kitchen()
    for plan in plan_scene(list(sources.values()), SvfBandpass(), FLAT):
        assert plan.context.target_hz == plan.context.own_hz
        assert len(plan.context.neighbours_hz) == 6


def test_a_loop_claims_no_frequency_that_its_converter_ignores() -> None:
    """A low-pass removed a pump at 290 Hz, of which `inspect` said: "at 290 Hz, rough at 49 Hz"."""
    t = np.arange(144_000) / 48_000
    x = 0.5 * np.sin(2 * np.pi * 49 * t) + 0.4 * np.sin(2 * np.pi * 290 * t)
    source = SourceClip(AudioClip(x.astype(np.float32), 48_000), 0.4)
    shown = {}
    for converter in (Lowpass(), Adaptive(), Auto()):
        (plan,) = plan_scene([source], converter, FLAT)
        assert plan.context.rough_hz is not None
        shown[type(converter).__name__] = felt_loop(source.clip, converter, plan).felt
    assert (shown["Lowpass"].own_hz, shown["Lowpass"].rough_hz) == (None, None)
    assert shown["Adaptive"].target_hz == pytest.approx(290, abs=1)
    assert shown["Adaptive"].rough_hz is None, "its band holds the pump alone"
    assert shown["Auto"].rough_hz == pytest.approx(49, abs=0.5)


def test_a_source_that_is_moved_keeps_its_rhythm() -> None:
    """A drum of 15.3 Hz lost a sixth of its depth: the band came later than the sound whose level it follows."""
    source = kitchen()["washing machine"]
    (plan,) = plan_scene([source], Auto(), FLAT)
    assert plan.context.own_hz is not None
    depths = []
    for ratio in (1.0, 0.93, 1.2):
        moved = replace(plan, context=replace(plan.context, target_hz=ratio * plan.context.own_hz))
        x = felt_loop(source.clip, Auto(), moved).tactile.samples.astype(float)
        envelope = np.abs(hilbert(x))
        rates_hz = np.fft.rfftfreq(len(x), 1 / source.clip.sample_rate_hz)
        depth = 2 * np.abs(np.fft.rfft(envelope)) / envelope.sum()
        depths.append(depth[np.abs(rates_hz - 15.3) < 0.4].max())
    assert depths[0] > 0.2
    assert min(depths[1:]) > 0.95 * depths[0]


def test_new_sources_are_placed_apart_from_fixed_loops(baked: dict[str, tuple[Plan, HapticLoop]]) -> None:
    sources = kitchen()
    standing = [(baked["smartphone"][1], "smartphone")]
    (plan,) = plan_scene([sources["washing machine"]], Adaptive(), FLAT, standing=standing)
    assert plan.context.target_hz is not None
    assert abs(math.log(plan.context.target_hz / peak_hz(baked["smartphone"][1]))) >= math.log(1.22)


def test_levels_hold_on_a_resonant_actuator() -> None:
    t = np.arange(4 * 8000) / 8000
    clip = AudioClip((0.5 * np.sin(2 * np.pi * 190 * t)).astype(np.float32), 8000)
    lra = ACTUATORS["lra"]
    (plan,) = plan_scene([SourceClip(clip, 0.2, "a")], Adaptive(), lra)
    f, a = spectrum(felt_loop(clip, Adaptive(), plan))
    r = f[1:] / 175.0
    answer = a[1:] / np.sqrt(1 + (12.0 * (r - 1 / r)) ** 2)
    felt = np.sum((answer / 10 ** (threshold_db(f[1:]) / 20))[f[1:] <= 1000] ** 2)
    assert 10 * math.log10(felt) == pytest.approx(31.0 + 17.0 * math.log10(0.2), abs=0.1)


def test_sources_that_share_a_sound_are_analysed_once(monkeypatch: pytest.MonkeyPatch) -> None:
    measured = []

    def noted(samples: np.ndarray, sample_rate_hz: float) -> None:
        measured.append(len(samples))

    monkeypatch.setattr("scene2hap.audio.scene_loops.rhythm_hz", noted)
    plan_scene([*kitchen().values()] * 5, Adaptive(), FLAT)
    assert 0 < len(measured) <= len(kitchen())
