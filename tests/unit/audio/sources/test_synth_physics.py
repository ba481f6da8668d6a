"""Physics of the synthesized voices, measured from their samples by spectrum and envelope.

Expected values come from mechanics (orders of shaft speed, blade passing, mains, time constants), independently of how
a voice is made.
"""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from itertools import pairwise

import numpy as np
import pytest
from scipy.signal import butter, hilbert, sosfilt

from scene2hap.audio.actuators import actuator_profile
from scene2hap.audio.clip import AudioClip
from scene2hap.audio.felt_component import felt_component_of
from scene2hap.audio.levels import sensation_level_db
from scene2hap.audio.sources.synth import Synthesizer
from scene2hap.audio.sources.synth.events import blows, bubbles, music
from scene2hap.audio.sources.synth.oscillating import combustion, ringing_motor, vibration_motor
from scene2hap.audio.sources.synth.rotating import compressor, fan, power_tool, pump, spinner, washing
from scene2hap.audio.sources.synth.signals import SAMPLE_RATE_HZ, Take
from scene2hap.audio.sources.synth.working import geared, rolling, rotor_slap, stepper
from scene2hap.common.arrays import Floats
from scene2hap.errors import ConfigError
from scene2hap.haptics import VibrationDescription
from scene2hap.llm.lexicon.descriptions import describe
from scene2hap.llm.lexicon.table import table

STATES = [(row.noun, state.name, state.intensity) for row in table() for state in row.states]


def take(drive: float = 0.5, size_factor: float = 1.0, mains_hz: float = 50.0, seed: int = 3) -> Take:
    return Take(np.random.default_rng(seed), drive, size_factor, mains_hz)


def spectrum(y: Floats) -> tuple[Floats, Floats]:
    """Frequencies and magnitudes with a Hann window, in bins of 0.1 Hz."""
    n = 2 * len(y)
    return np.fft.rfftfreq(n, 1 / SAMPLE_RATE_HZ), np.abs(np.fft.rfft((y - y.mean()) * np.hanning(len(y)), n))


def line_hz(y: Floats, low_hz: float, high_hz: float) -> float:
    """Frequency of the strongest line between two frequencies."""
    f, magnitude = spectrum(y)
    return float(f[np.argmax(np.where((f >= low_hz) & (f <= high_hz), magnitude, 0.0))])


def prominence_db(y: Floats, at_hz: float, half_width_hz: float = 1.0) -> float:
    """How far the line at a frequency stands above the median of its neighbourhood, +-10 Hz."""
    f, magnitude = spectrum(y)
    near = magnitude[np.abs(f - at_hz) <= half_width_hz].max()
    around = np.median(magnitude[(np.abs(f - at_hz) <= 10.0) & (np.abs(f - at_hz) > 2.0)])
    return float(20 * np.log10(near / around))


# rotating machines


@pytest.mark.parametrize(("shaft_hz", "blades"), [(22.0, 5), (26.0, 7), (80.0, 3), (42.0, 7)])
def test_blades_pass_at_blades_times_shaft_speed(shaft_hz: float, blades: int) -> None:
    y = fan(take(), shaft_hz=shaft_hz, blades=blades)
    turns = line_hz(y, 0.95 * shaft_hz, 1.05 * shaft_hz)
    passing = line_hz(y, 0.95 * blades * shaft_hz, 1.05 * blades * shaft_hz)
    assert passing / turns == pytest.approx(blades, rel=4e-3)
    assert prominence_db(y, turns) > 15.0
    assert prominence_db(y, passing) > 15.0


def test_induction_compressor_runs_below_mains_frequency() -> None:
    for mains_hz in (50.0, 60.0):
        y = compressor(take(mains_hz=mains_hz))
        shaft = line_hz(y, 0.9 * mains_hz, 1.1 * mains_hz)
        assert 0.95 * mains_hz < shaft < 0.995 * mains_hz, "slip of half to five per cent"
        # The second order of the shaft and the magnetic force are two lines, twice the slip apart.
        assert line_hz(y, 1.99 * mains_hz, 2.01 * mains_hz) == pytest.approx(2 * mains_hz, abs=0.15)
        assert prominence_db(y, 2 * shaft, 0.3) > 15.0


@pytest.mark.parametrize("mains_hz", [50.0, 60.0])
@pytest.mark.parametrize("thing", ["transformer", "microwave"])
def test_magnetic_hum_has_twice_the_mains_frequency_and_its_multiples(thing: str, mains_hz: float) -> None:
    (clip,) = Synthesizer(mains_hz=mains_hz).find(asked(thing, "hum", 0.5))
    y = clip.samples.astype(float)
    assert line_hz(y, 20.0, 1000.0) == pytest.approx(2 * mains_hz, abs=0.1)
    for order in (2, 3):
        assert prominence_db(y, 2 * mains_hz * order) > 12.0


def test_a_drum_loads_its_motor_once_per_turn() -> None:
    """Load modulation shows as sidebands of the motor's line, one drum speed away."""
    y = spinner(take(), drum_hz=18.0, belt_ratio=11.5)
    motor = line_hz(y, 190.0, 225.0)
    drum = line_hz(y, 16.0, 20.0)
    assert motor / drum == pytest.approx(11.5, rel=4e-3)
    for sideband in (motor - drum, motor + drum):
        assert prominence_db(y, sideband) > 12.0


def test_a_gear_loads_its_motor_once_per_turn_of_the_output() -> None:
    y = geared(take(), motor_hz=48.0, output_hz=6.0, load=0.3, rumble=0.0)
    motor = line_hz(y, 45.0, 51.0)
    output = motor - line_hz(y, motor - 8.0, motor - 4.0)
    assert motor / output == pytest.approx(8.0, rel=0.02)
    envelope = np.abs(hilbert(y))[SAMPLE_RATE_HZ // 2 : -SAMPLE_RATE_HZ // 2]
    assert line_hz(envelope, 3.0, 12.0) == pytest.approx(output, abs=0.25)


def test_a_geared_output_strikes_once_per_turn_at_any_size() -> None:
    """Strikes had the output's nominal rate, while its load had the rate of a machine of this size."""
    y = geared(take(size_factor=1.25), motor_hz=117.0, output_hz=14.0, load=0.0, rumble=0.0, thump_hz=1500.0)
    motor = line_hz(y, 130.0, 160.0)
    strikes = sosfilt(butter(4, 1000.0, "highpass", fs=SAMPLE_RATE_HZ, output="sos"), y)
    assert line_hz(np.abs(strikes), 10.0, 24.0) == pytest.approx(motor * 14.0 / 117.0, rel=0.02)


def test_a_power_tool_whines_at_teeth_times_motor_speed() -> None:
    y = power_tool(take(drive=1.0), motor_hz=250.0, spindle_hz=18.0, teeth=7)
    motor = line_hz(y, 0.9 * 287.5, 1.1 * 287.5)  # 15 % above nominal at full drive
    assert line_hz(y, 6.9 * motor, 7.1 * motor) / motor == pytest.approx(7.0, rel=5e-3)
    assert line_hz(y, 15.0, 25.0) / motor == pytest.approx(18.0 / 250.0, rel=5e-3)


def test_vanes_pass_at_vanes_times_shaft_speed() -> None:
    y = pump(take(), shaft_hz=48.0, vanes=6)
    assert line_hz(y, 270.0, 305.0) / line_hz(y, 45.0, 51.0) == pytest.approx(6.0, rel=4e-3)


def test_a_helicopter_slaps_at_blades_times_rotor_speed() -> None:
    y = rotor_slap(take(), rotor_hz=6.4, blades=4)
    envelope = np.abs(hilbert(y))
    passing = line_hz(envelope, 15.0, 40.0)
    assert passing == pytest.approx(25.6, rel=0.04)
    # One blade out of track gives a line at the rotor speed.
    assert line_hz(envelope, 4.0, 10.0) == pytest.approx(passing / 4, rel=0.02)


def test_loud_order_of_an_engine_is_the_strongest_multiple_of_its_firing_rate() -> None:
    y = combustion(take(), firing_hz=28.0, loud_order=2)
    loud = line_hz(y, 20.0, 400.0)
    assert loud == pytest.approx(56.0, rel=0.04)
    assert prominence_db(y, loud / 2) > 10.0


def test_wheels_pass_sleepers_at_speed_over_spacing() -> None:
    assert line_hz(rolling(take(), passing_hz=30.0 / 0.6), 40.0, 60.0) == pytest.approx(50.0, rel=0.05)


# sounds with starts, strokes and beats


@pytest.mark.parametrize(("spin_up_s", "spin_down_s"), [(0.05, 0.08), (0.12, 0.2)])
def test_phone_motor_force_grows_with_the_square_of_its_speed(spin_up_s: float, spin_down_s: float) -> None:
    y = ringing_motor(take(), spin_up_s=spin_up_s, spin_down_s=spin_down_s)[: round(1.5 * SAMPLE_RATE_HZ)]
    # Two cycles at the speed of half force: with any other width the envelope would fluctuate there.
    width = round(2 * SAMPLE_RATE_HZ / (182.0 / 2**0.5))
    envelope = np.sqrt(np.convolve(y**2, np.ones(width) / width, mode="same"))
    t = np.arange(len(y)) / SAMPLE_RATE_HZ
    full = np.median(envelope[(t > 0.7) & (t < 0.9)])
    rise = t[np.argmax(envelope > full / 2)]
    # w = 1 - exp(-t / tau) and force ~ w^2: half of it where w = 1 / sqrt(2).
    assert rise == pytest.approx(-spin_up_s * np.log(1 - 2**-0.5), abs=0.006)
    fall = t[(t > 1.0) & (envelope < full / 2)][0] - 1.0
    assert fall == pytest.approx(spin_down_s * np.log(2.0) / 2, abs=0.006)


def test_a_phone_s_motor_rises_in_pitch() -> None:
    y = ringing_motor(take())
    t = np.arange(len(y)) / SAMPLE_RATE_HZ
    crossings = t[1:][(y[:-1] < 0) & (y[1:] >= 0)]
    pitch = 1 / np.diff(crossings)
    early = pitch[(crossings[1:] > 0.03) & (crossings[1:] < 0.07)].mean()
    late = np.median(pitch[(crossings[1:] > 0.5) & (crossings[1:] < 0.9)])
    # Between 1 - exp(-0.6) and 1 - exp(-1.4) of full speed, near 1 - 1/e.
    assert early / late == pytest.approx(1 - np.exp(-1), abs=0.06)
    assert late == pytest.approx(182.0, rel=0.04)


def test_bubbles_ring_where_their_radii_say() -> None:
    """Minnaert: f R = 3.26 m/s in water, so that 8.15 mm to 36 mm are 400 to 90 Hz."""
    y = bubbles(take(), largest_hz=3.26 / 0.0362, smallest_hz=3.26 / 0.00815)
    f, magnitude = spectrum(y)
    power = magnitude**2
    assert power[(f > 80.0) & (f < 440.0)].sum() > 0.9 * power.sum()


def test_kettle_has_the_same_pitch_for_any_seed() -> None:
    """With equal numbers of bubbles of all sizes, the strongest third octave varied by two octaves."""
    strongest = []
    for seed in range(8):
        f, magnitude = spectrum(bubbles(take(seed=seed), largest_hz=90.0, smallest_hz=380.0))
        edges = 90.0 * 2.0 ** (np.arange(8) / 3.0)
        power = [(magnitude[(f >= a) & (f < b)] ** 2).sum() for a, b in pairwise(edges)]
        strongest.append(int(np.argmax(power)))
    near = np.abs(np.array(strongest) - np.median(strongest)) <= 1
    assert near.sum() >= 7


def test_impacts_repeat_at_the_stated_rate() -> None:
    envelope = np.abs(hilbert(blows(take(), per_second=25.0, body_hz=125.0, decay_s=0.01)))
    assert line_hz(envelope, 10.0, 40.0) == pytest.approx(25.0, abs=0.1)


@pytest.mark.parametrize("drum_hz", [0.85, 2.0])
def test_laundry_falls_once_per_turn_of_the_drum(drum_hz: float) -> None:
    envelope = np.abs(hilbert(washing(take(), drum_hz=drum_hz, slosh=0.0)))
    assert line_hz(envelope, 0.3, 8.0) == pytest.approx(drum_hz, abs=0.1)


def test_music_has_the_stated_beat() -> None:
    envelope = np.abs(hilbert(music(take(), beats_per_minute=120.0)))
    assert line_hz(envelope, 0.5, 3.0) in (pytest.approx(2.0, abs=0.1), pytest.approx(1.0, abs=0.1))


def test_a_stepper_s_pitch_stays_within_its_speeds() -> None:
    y = stepper(take(), slowest_hz=90.0, fastest_hz=260.0)
    segments = y[: 24 * 10_000].reshape(24, 10_000)
    pitches = [line_hz(segment, 40.0, 300.0) for segment in segments]
    assert 85.0 < min(pitches) < 0.8 * max(pitches) < max(pitches) < 265.0


# parameters of the voices


@pytest.mark.parametrize(
    "voice",
    [
        partial(fan, shaft_hz=80.0, blades=3),
        partial(power_tool, motor_hz=250.0, spindle_hz=18.0),
        partial(combustion, firing_hz=75.0, loud_order=1),
        partial(vibration_motor, motor_hz=150.0),
    ],
    ids=lambda voice: voice.func.__name__,
)
def test_speed_of_unregulated_motors_grows_with_drive_and_falls_with_size(voice: partial[Floats]) -> None:
    slow, middle, fast = (line_hz(voice(take(drive)), 40.0, 400.0) for drive in (0.0, 0.5, 1.0))
    assert (slow / middle, fast / middle) == (pytest.approx(0.85, rel=0.01), pytest.approx(1.15, rel=0.01))
    large = line_hz(voice(take(size_factor=0.75)), 30.0, 400.0)
    assert large / middle == pytest.approx(0.75, rel=0.01)


@pytest.mark.parametrize("voice", [compressor, pump])
def test_speed_of_mains_driven_motors_does_not_depend_on_drive(voice: object) -> None:
    idle, driven, american = (
        line_hz(voice(take(drive, mains_hz=mains)), 30.0, 400.0)
        for drive, mains in ((0.0, 50.0), (1.0, 50.0), (0.5, 60.0))
    )
    assert idle == pytest.approx(driven, rel=1e-3)
    assert american / idle == pytest.approx(1.2, rel=3e-3)


def test_synthesizer_refuses_unusual_mains_frequencies() -> None:
    for mains_hz in (16.7, 400.0, float("nan")):
        with pytest.raises(ConfigError, match="mains_hz is"):
            Synthesizer(mains_hz=mains_hz)


# every state of the lexicon


def asked(category: str, verb: str, intensity: float, seed: int = 0) -> VibrationDescription:
    return VibrationDescription(
        category, "on", f"{category} {verb}", f"{category} {verb}", intensity, (0.3, 0.3, 0.1), seed=seed
    )


def made(noun: str, state: str, intensity: float) -> AudioClip:
    answer = describe(noun, state)
    (clip,) = Synthesizer().find(
        VibrationDescription(noun, state, answer.sentence, answer.keywords, intensity, (0.3, 0.3, 0.1))
    )
    return clip


def test_every_state_has_a_voice_of_its_own() -> None:
    from scene2hap.audio.sources.synth.synthesizer import patch_for
    from scene2hap.audio.sources.synth.table import MOTOR

    some_motor = [
        (noun, state) for noun, state, _ in STATES if patch_for(noun, describe(noun, state).keywords, state) is MOTOR
    ]
    assert [pair for pair in some_motor if pair[0].split()[-1] != "motor"] == []


@pytest.mark.parametrize("noun", ["fan", "kettle"])
def test_takes_of_a_machine_are_felt_at_one_frequency(noun: str) -> None:
    """In an earlier version some takes of a fan were felt at twice the blade frequency, of a kettle an octave up."""
    name, intensity = next((name, intensity) for one, name, intensity in STATES if one == noun)
    level_db, actuator = sensation_level_db(intensity), actuator_profile("flat")
    keywords = describe(noun, name).keywords
    felt_hz = []
    for seed in range(6):
        machine = VibrationDescription(noun, name, "", keywords, intensity, (0.3, 0.4, 0.3), seed=seed)
        clip = Synthesizer().find(machine)[0]
        component = felt_component_of(clip.samples, clip.sample_rate_hz, level_db, actuator)
        assert component is not None
        felt_hz.append(component.felt_hz)
    assert max(felt_hz) / min(felt_hz) < 2**0.5


@pytest.mark.parametrize("number", range(0, len(STATES), 24))
def test_states_give_finite_unclipped_and_repeatable_clips(number: int) -> None:
    """Tests every twenty-fourth state; test_synth tests each voice."""
    clip = made(*STATES[number])
    y = clip.samples.astype(float)
    assert np.isfinite(y).all()
    assert 0.85 < np.abs(y).max() <= 0.901
    is_top = np.abs(y) > (1 - 1e-7) * np.abs(y).max()
    assert not (is_top[2:] & is_top[1:-1] & is_top[:-2]).any(), "clipped"
    assert abs(y.mean()) < 1e-6
    np.testing.assert_array_equal(made(*STATES[number]).samples, clip.samples)


@pytest.mark.parametrize("mains_hz", [50.0, 60.0])
@pytest.mark.parametrize(
    ("thing", "verb", "per_cycle"),
    [("espresso machine", "pumping", 1), ("hair clipper", "buzzing", 2), ("intercom", "buzzing", 2)],
)
def test_parts_that_a_magnet_moves_follow_the_mains(thing: str, verb: str, per_cycle: int, mains_hz: float) -> None:
    """In an earlier version they ran at 50, 110 and 100 Hz, give or take 3 %, on any mains."""
    for seed in range(3):
        words = f"{thing} {verb}"
        machine = VibrationDescription(thing, "on", words, words, 0.5, (0.3, 0.3, 0.3), seed=seed)
        y = Synthesizer(mains_hz=mains_hz).find(machine)[0].samples.astype(float)
        assert line_hz(y, 20.0, 1000.0) == pytest.approx(per_cycle * mains_hz, rel=4e-3)


@pytest.mark.parametrize("mains_hz", [50.0, 60.0])
def test_every_other_pull_of_a_microwave_is_stronger(mains_hz: float) -> None:
    """Its rate was 50 Hz, give or take 3 %, on any mains: an inharmonic line beside each multiple of the hum."""
    y = Synthesizer(mains_hz=mains_hz).find(asked("microwave", "humming", 0.5))[0].samples.astype(float)
    assert line_hz(y, 2.6 * mains_hz, 3.4 * mains_hz) == pytest.approx(3 * mains_hz, abs=0.2)


def test_compressor_on_the_mains_turns_below_its_frequency() -> None:
    for mains_hz in (50.0, 60.0):
        y = Synthesizer(mains_hz=mains_hz).find(asked("compressor", "rattling", 0.8))[0].samples.astype(float)
        assert 0.91 * mains_hz < line_hz(y, 20.0, 1000.0) < 0.985 * mains_hz


@pytest.mark.parametrize(
    ("thing", "verb", "low_hz", "high_hz"),
    [
        ("nail dryer", "buzzing", 60.0, 110.0),  # was a tumble dryer
        ("vortex mixer", "spinning", 35.0, 60.0),  # was a dough mixer, at 165 Hz
        ("amalgamator", "buzzing", 60.0, 80.0),  # was a door bell's buzzer
        ("massage pillow", "buzzing", 40.0, 90.0),
        ("plate compactor", "pounding", 65.0, 100.0),  # was a jackhammer, as were all presses and hammers
        ("bee hive", "buzzing", 200.0, 260.0),
        ("drilling rig", "grinding", 50.0, 110.0),  # was a hand drill, at 250 Hz
        ("submarine", "rumbling", 80.0, 130.0),  # was a train over sleepers
        ("power tool", "whirring", 200.0, 300.0),  # was an air fan
        ("rain", "falling", 60.0, 350.0),  # was an induction motor
        # Blades of circular saws turn 4500 to 6000 times a minute; they had the 11,000 of an angle grinder.
        ("circular saw", "sawing", 75.0, 100.0),
        ("table saw", "sawing", 75.0, 100.0),
        # Induction motors of two poles, below 3000 turns a minute, drive both; these, too, were angle grinders.
        ("bench grinder", "grinding", 45.0, 50.0),
        ("band saw", "sawing", 45.0, 50.0),
        ("drill press", "whirring", 45.0, 50.0),  # was a hand drill, at 250 Hz
        ("dental drill", "whirring", 280.0, 400.0),  # 17,000 to 24,000 turns a minute; was a hand drill
        ("hedge trimmer", "clattering", 45.0, 67.0),  # 2700 to 4000 strokes a minute; was a shaver, at 110 Hz
        ("bowl feeder", "buzzing", 99.0, 101.0),  # twice the mains
        ("turbine", "whirring", 99.0, 101.0),  # its generator; was a desk fan
    ],
)
def test_things_have_the_pitch_of_their_mechanism(thing: str, verb: str, low_hz: float, high_hz: float) -> None:
    of_usual_size = replace(asked(thing, verb, 0.5), size_m=(0.0, 0.0, 0.0))
    y = Synthesizer().find(of_usual_size)[0].samples.astype(float)
    assert low_hz <= line_hz(y, 20.0, 1000.0) <= high_hz


@pytest.mark.parametrize(
    ("thing", "verb", "rate_hz"),
    [
        ("rammer", "pounding", 11.0),
        ("forging hammer", "pounding", 0.8),
        ("hammer drill", "hammering", 70.0),  # 4000 to 4500 blows a minute
        ("jackhammer", "hammering", 25.0),
        ("sewing machine", "clattering", 14.0),  # 750 to 900 stitches a minute, were 1800
        ("embroidery machine", "clattering", 14.0),
        ("power loom", "clattering", 3.3),
        ("screening machine", "shaking", 16.0),  # 900 to 1000 turns a minute
        ("metronome", "ticking", 2.0),  # was a clock
        ("pocket watch", "ticking", 5.0),  # 18,000 beats an hour
        ("clock", "ticking", 1.0),
        ("breast pump", "pumping", 1.0),  # 40 to 120 cycles a minute; had vanes at 290 Hz
        ("turbine", "whirring", 0.75),  # 15 turns a minute, three blades
    ],
)
def test_strokes_have_the_rate_of_their_kind(thing: str, verb: str, rate_hz: float) -> None:
    """Hammers struck 25 times a second, as a jackhammer does."""
    y = Synthesizer().find(asked(thing, verb, 0.7))[0].samples.astype(float)
    f, magnitude = spectrum(np.abs(y))
    slow = (f > 0.5) & (f < 90.0)
    assert float(f[slow][np.argmax(magnitude[slow])]) == pytest.approx(rate_hz, rel=0.1)


def test_the_motor_of_a_sewing_machine_is_heard_between_its_stitches() -> None:
    """It was 20 dB of silence; a motor that is loaded by 30 % varies by 5 dB."""
    y = Synthesizer().find(asked("sewing machine", "clattering", 0.6))[0].samples.astype(float)
    levels_db = 10.0 * np.log10((y.reshape(-1, SAMPLE_RATE_HZ // 50) ** 2).mean(axis=1))
    assert np.percentile(levels_db, 95) - np.percentile(levels_db, 5) < 8.0


def test_blades_on_the_shaft_of_a_motor_are_felt_at_its_speed_in_every_take() -> None:
    """Two imbalances on one shaft cancelled each other in some takes, which were felt an octave higher."""
    wanted = replace(asked("coffee grinder", "grinding", 0.6), size_m=(0.3, 0.4, 0.3))
    for seed in range(12):
        (clip,) = Synthesizer().find(replace(wanted, seed=seed))
        component = felt_component_of(
            clip.samples, clip.sample_rate_hz, sensation_level_db(0.6), actuator_profile("flat")
        )
        assert component is not None
        assert 190.0 < component.felt_hz < 235.0


def test_rain_is_no_machine() -> None:
    y = Synthesizer().find(asked("roof", "raining", 0.3))[0].samples.astype(float)
    f, magnitude = spectrum(y)
    assert prominence_db(y, float(f[np.argmax(magnitude)])) < 25.0
