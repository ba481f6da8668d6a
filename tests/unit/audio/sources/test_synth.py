from __future__ import annotations

import hashlib
import math
import subprocess
import sys
from functools import cache, partial
from inspect import signature
from itertools import pairwise
from typing import Any

import numpy as np
import pytest

from scene2hap.audio.analysis import dynamic_range_db
from scene2hap.audio.clip import AudioClip
from scene2hap.audio.loops.seam_search import find_seam
from scene2hap.audio.protocol import AudioSource
from scene2hap.audio.select import select_clip
from scene2hap.audio.sources import SOURCES
from scene2hap.audio.sources.synth import Synthesizer
from scene2hap.audio.sources.synth.patch import Patch
from scene2hap.audio.sources.synth.signals import SAMPLE_RATE_HZ, Take
from scene2hap.audio.sources.synth.synthesizer import patch_for
from scene2hap.audio.sources.synth.table import MOTOR, TABLE
from scene2hap.common.arrays import Floats
from scene2hap.errors import AudioError, ConfigError
from scene2hap.haptics import VibrationDescription

EVERYDAY = {
    # category and keywords -> bounds of the strongest frequency [Hz], from real machines
    ("refrigerator", "refrigerator humming"): (48, 50),
    ("microwave oven", "microwave oven heating"): (99.5, 100.5),
    ("transformer", "transformer humming"): (99.5, 100.5),
    ("washing machine", "washing machine spinning"): (190, 260),
    ("electric toothbrush", "electric toothbrush vibrating"): (250, 270),
    ("smartphone", "smartphone vibrating"): (175, 190),
    ("range hood", "range hood venting"): (25, 50),
    ("handheld fan", "handheld fan blowing"): (50, 110),
    ("frying pan", "frying pan boiling"): (80, 420),
    ("truck", "truck idling"): (50, 110),
    ("speaker", "speaker playing"): (40, 140),
    ("thingamajig", "thingamajig running"): (35, 65),
}


def describe(category: str, keywords: str, **changes: object) -> VibrationDescription:
    fields = {"intensity": 0.5, "size_m": (0.0, 0.0, 0.0), "seed": 7} | changes
    return VibrationDescription(category, "on", f"{category} at work", keywords, **fields)


def make(category: str, keywords: str, **changes: object) -> AudioClip:
    (clip,) = Synthesizer().find(describe(category, keywords, **changes))
    return clip


def strongest_hz(y: Floats, above_hz: float = 10.0) -> float:
    """The frequency of the largest bin of a Hann-windowed spectrum, to the nearest 0.2 Hz."""
    magnitude = np.abs(np.fft.rfft(y * np.hanning(len(y))))
    frequencies = np.fft.rfftfreq(len(y), 1 / SAMPLE_RATE_HZ)
    return float(frequencies[np.argmax(np.where(frequencies > above_hz, magnitude, 0))])


def mean_hz(clip: AudioClip) -> float:
    """The mean frequency of a sound, weighted by power."""
    power = np.abs(np.fft.rfft(clip.samples)) ** 2
    return float(np.fft.rfftfreq(len(clip.samples), 1 / clip.sample_rate_hz) @ power / power.sum())


@cache
def played(patch: Patch) -> Floats:
    return patch.voice(Take(np.random.default_rng(11), 0.5))


def name_of(patch: Patch) -> str:
    voice = patch.voice.func if isinstance(patch.voice, partial) else patch.voice
    numbers = [f"{value:g}" for value in settings_of(patch).values() if isinstance(value, float)]
    return "-".join([voice.__name__, *numbers])


def settings_of(patch: Patch) -> dict[str, Any]:
    """The settings of a voice, with its own defaults for those that a patch leaves out."""
    return {key: one.default for key, one in signature(patch.voice).parameters.items() if one.default is not one.empty}


PITCHES = {
    # voice -> the frequency that a machine with these settings shakes with most, and the largest deviation from it
    "motor": lambda shaft_hz: (shaft_hz, 0.05),
    "mains_hum": lambda: (100.0, 0.002),
    "microwave": lambda: (100.0, 0.002),
    "washing": lambda **_: (100.0, 0.002),  # the hum of its motor
    "compressor": lambda slip: (50.0 * (1 - slip), 0.01),
    "spinner": lambda drum_hz, belt_ratio: (drum_hz * belt_ratio, 0.04),
    "fan": lambda shaft_hz, blades, rotor, blade, flow: (shaft_hz * (blades if blade > rotor else 1), 0.04),
    "pump": lambda shaft_hz, vanes: (shaft_hz * vanes, 0.04),
    "combustion": lambda firing_hz, loud_order, revs, **_: (firing_hz * loud_order, 0.05 + revs),
    "reciprocating": lambda stroke_hz, speed, **_: (stroke_hz, 0.004 if speed is Take.magnet_hz else 0.04),
    "vibration_motor": lambda motor_hz: (motor_hz, 0.05),
    "ringing_motor": lambda motor_hz, **_: (motor_hz, 0.05),
    "geared": lambda motor_hz, **_: (motor_hz, 0.043),
    "power_tool": lambda motor_hz, spindle_hz, spindle, **_: (spindle_hz if spindle > 1 else motor_hz, 0.04),
    # The strongest line of a fast pulse train is the multiple of its rate nearest to the body's pitch.
    "blows": lambda per_second, body_hz, **_: (body_hz, max(0.06, 0.6 * per_second / body_hz)),
    "buzzer": lambda pitch_hz, on_mains, **_: (pitch_hz, 0.002 if on_mains else 0.025),
    "telephone_bell": lambda ringing_hz, case_hz, **_: (case_hz, 2 * ringing_hz / case_hz),
    "rotor_slap": lambda body_hz, **_: (body_hz, 0.3),
}
RANGES_HZ = {
    # voice -> the range of random events, whose strongest frequency differs in each take
    "bubbles": lambda largest_hz, smallest_hz, per_second: (0.85 * largest_hz, 1.1 * smallest_hz),
    "jet": lambda low_hz, tilt_db, pump: (0.9 * low_hz, 6.0 * low_hz) if pump == 0.0 else (49.5, 50.5),
    "music": lambda beats_per_minute: (60.0, 135.0),
    "stepper": lambda slowest_hz, fastest_hz, move_s: (0.95 * slowest_hz, 1.05 * fastest_hz),
    "rolling": lambda passing_hz: (0.8 * passing_hz, 1.2 * passing_hz),
}


def expected_hz(patch: Patch) -> tuple[float, float]:
    """Bounds of the strongest frequency of a patch, from the settings of its machine."""
    voice = patch.voice.func if isinstance(patch.voice, partial) else patch.voice
    if voice.__name__ in RANGES_HZ:
        return RANGES_HZ[voice.__name__](**settings_of(patch))
    pitch_hz, share = PITCHES[voice.__name__](**settings_of(patch))
    return pitch_hz * (1 - share), pitch_hz * (1 + share)


def is_steady(patch: Patch) -> bool:
    """Whether a patch can be looped as it is: without pauses, revs, and strokes that are felt one by one."""
    voice = patch.voice.func if isinstance(patch.voice, partial) else patch.voice
    given = settings_of(patch)
    has_pauses = voice.__name__ == "music" or given.get("off_s", 0.0) > 0.0
    is_sparse = given.get("per_second", math.inf) <= {"blows": 10.0, "bubbles": 100.0}.get(voice.__name__, 0.0)
    return not (has_pauses or is_sparse or given.get("revs", 0.0) >= 0.1)


every_patch = pytest.mark.parametrize("patch", [*dict.fromkeys(patch for _, _, patch in TABLE), MOTOR], ids=name_of)


# every voice


@every_patch
def test_strongest_frequency_of_a_patch_is_that_of_its_machine(patch: Patch) -> None:
    low, high = expected_hz(patch)
    assert low <= strongest_hz(played(patch)) <= high


@every_patch
def test_most_power_of_a_patch_lies_between_40_and_400_hz(patch: Patch) -> None:
    power = np.abs(np.fft.rfft(played(patch))) ** 2
    frequencies = np.fft.rfftfreq(len(played(patch)), 1 / SAMPLE_RATE_HZ)
    felt = (frequencies >= 40) & (frequencies <= 400)
    assert power[felt].sum() > 0.5 * power.sum()


@every_patch
def test_a_patch_is_steady_if_its_machine_is(patch: Patch) -> None:
    assert (dynamic_range_db(played(patch), SAMPLE_RATE_HZ) <= 5.0) == is_steady(patch)


@every_patch
def test_every_patch_is_long_enough_to_be_chosen(patch: Patch) -> None:
    """In an earlier version a telephone rang once in a clip, and no scene with a telephone could be baked."""
    clip = AudioClip(played(patch).astype(np.float32), SAMPLE_RATE_HZ)
    assert select_clip([clip]).duration_s > 2.5


# the source


@pytest.mark.parametrize(("words", "bounds_hz"), EVERYDAY.items(), ids=lambda value: str(value[0]))
def test_machines_have_the_pitch_of_real_machines(words: tuple[str, str], bounds_hz: tuple[float, float]) -> None:
    clip = make(*words)
    assert clip.sample_rate_hz == 48_000
    assert clip.samples.shape == (240_000,)
    assert 0.5 < np.abs(clip.samples).max() < 1.0
    assert bounds_hz[0] <= strongest_hz(clip.samples.astype(float)) <= bounds_hz[1]


def test_two_fresh_processes_give_identical_bytes() -> None:
    code = (
        "import sys; from scene2hap.audio.sources.synth import Synthesizer;"
        "from scene2hap.haptics import VibrationDescription as V;"
        "described = V('fan', 'on', 'A fan blows.', 'fan blowing', 0.4, (0.3, 0.3, 0.1), seed=3);"
        "clips = Synthesizer(takes=2).find(described);"
        "sys.stdout.buffer.write(b''.join(clip.samples.tobytes() for clip in clips))"
    )
    runs = [
        subprocess.run(
            [sys.executable, "-c", code], capture_output=True, check=True, env={"PYTHONHASHSEED": seed}
        ).stdout
        for seed in ("1", "2")
    ]
    assert len(runs[0]) == 2 * 240_000 * 4
    assert hashlib.sha256(runs[0]).digest() == hashlib.sha256(runs[1]).digest()


def test_words_seed_and_take_each_change_the_sound() -> None:
    reference = make("fan", "fan blowing")
    np.testing.assert_array_equal(make("fan", "fan blowing").samples, reference.samples)
    for other in (
        make("fan", "fan blowing", seed=8),
        make("fan", "fan humming"),
        make("fan", "fan blowing", intensity=1),
    ):
        assert not np.array_equal(other.samples, reference.samples)
    takes = Synthesizer(takes=3).find(describe("fan", "fan blowing"))
    np.testing.assert_array_equal(takes[0].samples, reference.samples)
    assert len({take.samples.tobytes() for take in takes}) == 3


def test_larger_machines_are_slower_within_bounds() -> None:
    sizes_m = (0.01, 0.3, 0.4, 0.6, 50.0)
    pitches = [strongest_hz(make("fan", "fan", size_m=(size, 0.1, 0.1)).samples) for size in sizes_m]
    assert all(small > large for small, large in pairwise(pitches))
    # Speeds of equal machines go with the square root of the inverse size, within 3/4 and 4/3.
    expected = [4 / 3, (0.4 / 0.3) ** 0.5, 1, (0.4 / 0.6) ** 0.5, 3 / 4]
    np.testing.assert_allclose(np.array(pitches) / pitches[2], expected, rtol=0.01)


def test_pitch_of_mains_driven_machines_does_not_depend_on_size() -> None:
    for size in (0.1, 5.0):
        assert strongest_hz(make("transformer", "hum", size_m=(size, size, size)).samples) == pytest.approx(
            100, abs=0.3
        )


@pytest.mark.parametrize("mains_hz", [50.0, 60.0])
@pytest.mark.parametrize("thing", ["tumble dryer", "bread maker", "conveyor belt"])
def test_induction_motor_runs_below_mains_frequency_at_any_size(thing: str, mains_hz: float) -> None:
    for size in (0.3, 1.0):
        asked = describe(thing, f"{thing} running", size_m=(size, size, size))
        (clip,) = Synthesizer(mains_hz=mains_hz).find(asked)
        assert 0.92 * mains_hz < strongest_hz(clip.samples) < mains_hz


def test_higher_intensity_is_brighter() -> None:
    def centroid_hz(clip: AudioClip) -> float:
        power = np.abs(np.fft.rfft(clip.samples)) ** 2
        return float((np.fft.rfftfreq(len(clip.samples), 1 / SAMPLE_RATE_HZ) * power).sum() / power.sum())

    for words in (("transformer", "hum"), ("fan", "blow"), ("drill", "drill"), ("refrigerator", "hum")):
        assert centroid_hz(make(*words, intensity=0.1)) < centroid_hz(make(*words, intensity=0.9))


def test_credits_name_the_synthesizer_under_cc0() -> None:
    first, second = Synthesizer(takes=2).find(describe("electric toothbrush", "electric toothbrush vibrating"))
    assert first.credit.title == "electric toothbrush (reciprocating), take 1"
    assert second.credit.title == "electric toothbrush (reciprocating), take 2"
    assert (first.credit.author, first.credit.licence) == ("scene2hap synthesizer", "CC0-1.0")
    assert first.credit.query == "electric toothbrush vibrating"


def test_synthesized_clips_can_be_selected_and_looped() -> None:
    clip = select_clip(Synthesizer(takes=2).find(describe("refrigerator", "refrigerator humming")))
    assert find_seam(clip.samples, clip.sample_rate_hz).length > 2.0 * clip.sample_rate_hz


def test_impossible_requests_are_refused() -> None:
    for takes in (0, 6, 1.5):
        with pytest.raises(ConfigError, match="takes is"):
            Synthesizer(takes)
    with pytest.raises(AudioError, match="intensity is 1.5"):
        make("fan", "fan", intensity=1.5)
    with pytest.raises(AudioError, match=r"size_m\[0\] is -1 m"):
        make("fan", "fan", size_m=(-1.0, 0.0, 0.0))


def test_synthesizer_is_registered_by_its_kind() -> None:
    assert SOURCES.load("synth") is Synthesizer
    assert isinstance(Synthesizer(), AudioSource)


# which voice


def voice_of(category: str, *phrases: str) -> str:
    return name_of(patch_for(category, *phrases)).split("-")[0]


@pytest.mark.parametrize(
    ("category", "keywords", "voice"),
    [
        ("Refrigerator", "refrigerator humming", "compressor"),
        ("fridge", "fridge whirring", "compressor"),
        ("desk fans", "desk fan rotating", "fan"),
        ("microwave on refrigerator", "microwave heating", "microwave"),
        ("alarm clock", "alarm clock ringing", "buzzer"),
        ("alarm clock", "alarm clock ticking", "blows"),
        ("wall clock", "wall clock ticking", "blows"),
        ("clock", "clock ringing", "buzzer"),
        ("frying pan", "pan boiling", "bubbles"),
        ("washing machine drum", "drum spinning", "spinner"),
        ("phone charger", "phone charger humming", "mains_hum"),
        ("delivery truck", "truck idling", "combustion"),
        ("hammer drill", "hammer drill drilling", "blows"),
        ("gizmo", "gizmo vibrating", "vibration_motor"),
        ("gizmo", "gizmo humming", "mains_hum"),
        ("gizmo", "gizmo existing", "motor"),
        ("radiator", "radiator ticking", "blows"),
        ("tap", "tap dripping", "blows"),
        ("tap", "tap flowing", "jet"),
        ("bed", "bed shaking", "vibration_motor"),
        ("", "", "motor"),
    ],
)
def test_category_and_verb_choose_the_voice(category: str, keywords: str, voice: str) -> None:
    assert voice_of(category, keywords) == voice


def test_a_sizzling_pan_is_brighter_than_a_boiling_one() -> None:
    boiling, sizzling = (mean_hz(make("frying pan", f"frying pan {verb}")) for verb in ("boiling", "sizzling"))
    assert sizzling > 1.3 * boiling


def test_the_state_may_hold_the_verb() -> None:
    assert voice_of("clock", "clock", "ringing") == "buzzer"


def test_unknown_category_gets_the_motor_voice() -> None:
    assert patch_for("frobnicator", "frobnicator frobbing") is MOTOR


# differences within a family of machines


def onsets_per_s(y: Floats) -> float:
    """Onsets per second: rises of the level of 5 ms by a factor of four, at least 50 ms apart."""
    n = round(0.005 * SAMPLE_RATE_HZ)
    level = np.sqrt(np.mean(np.square(y[: len(y) // n * n].reshape(-1, n)), axis=1))
    rises = np.flatnonzero((level[1:] > 0.2 * level.max()) & (level[1:] > 4 * level[:-1]))
    return (1 + np.count_nonzero(np.diff(rises) > 10)) / (len(y) / SAMPLE_RATE_HZ)


def test_a_cat_purrs_at_the_rate_of_cats() -> None:
    """26.3 Hz, give or take 2 (Frazer Sissom, Rice and Peters 1991)."""
    power = make("cat", "cat purring").samples.astype(float) ** 2
    rate_hz = strongest_hz(power, above_hz=5.0)
    assert 24.0 < rate_hz < 28.5


def test_a_kitchen_timer_ticks_four_or_five_times_a_second_and_a_clock_once() -> None:
    assert 4.0 <= onsets_per_s(make("kitchen timer", "kitchen timer ticking").samples.astype(float)) <= 5.0
    assert onsets_per_s(make("wall clock", "clock ticking").samples.astype(float)) == pytest.approx(1.0)


def test_states_of_a_washing_machine_have_different_pitches() -> None:
    """Strongest lines: spinning the motor, rinsing and washing a hum at twice the mains, draining the pump's vanes."""
    heard = {
        verb: strongest_hz(make("washing machine", f"washing machine {verb}").samples.astype(float))
        for verb in ("washing", "rinsing", "spinning", "draining")
    }
    assert heard["rinsing"] == pytest.approx(100.0, abs=0.5)
    assert heard["washing"] == pytest.approx(100.0, abs=0.5)
    assert 204 <= heard["spinning"] <= 221
    assert 138 <= heard["draining"] <= 150


def test_blender_and_dough_mixer_have_different_pitches() -> None:
    blender, mixer = (
        strongest_hz(make(thing, f"{thing} mixing").samples.astype(float)) for thing in ("blender", "dough mixer")
    )
    assert abs(np.log(blender / mixer)) > 2 * np.log(1.18)


def test_compressor_level_fluctuates_with_its_load() -> None:
    """The level fluctuates by some 5-20 % between 0.5 and 5 Hz; in an earlier version by a tenth of that."""
    y = make("refrigerator", "refrigerator humming", intensity=0.1).samples.astype(float)
    n = SAMPLE_RATE_HZ // 20
    level = np.sqrt(np.mean(np.square(y[: len(y) // n * n].reshape(-1, n)), axis=1))
    spectrum = np.abs(np.fft.rfft(level / level.mean() - 1)) / len(level)
    f = np.fft.rfftfreq(len(level), 0.05)
    wavers = 2**0.5 * np.sqrt(np.square(spectrum[(f >= 0.4) & (f <= 5)]).sum())
    assert 0.04 < wavers < 0.25
