from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
import pytest

from others import RECORDINGS, there
from own_sounds import OWN_SOUNDS
from scene2hap.audio.actuators import actuator_profile
from scene2hap.audio.clip import AudioClip, Credit, Samples
from scene2hap.audio.haptic_loop import HapticLoop
from scene2hap.audio.levels import TACTILE_HEADROOM_DB
from scene2hap.audio.loops import loop_pair, middle_of
from scene2hap.audio.loops.seam_search import MAX_LOOP_S, find_seam
from scene2hap.audio.protocol import ConversionContext
from scene2hap.audio.scene_loops import SourceClip, felt_loop, plan_scene
from scene2hap.audio.seam import Seam, apply_seam
from scene2hap.audio.tactile import CONVERTERS
from scene2hap.audio.tactile.lowpass import Lowpass
from scene2hap.audio.tactile.svf_bandpass import SvfBandpass
from scene2hap.errors import AudioError

RATE = 48_000
CREDIT = Credit("hum", "someone", "CC0-1.0")
RECORDED = [
    "fridge_hum_kitchen.wav",
    "oven_hum.wav",
    "computer_fan_hum.wav",
    "washing_machine_rinse.wav",
    "chainsaw_1-116765-A.ogg",
    "clock_tick_1-62849-A.ogg",
]


def tone(frequency_hz: float, duration_s: float = 4.0, rate: int = RATE) -> np.ndarray:
    return np.sin(2 * np.pi * frequency_hz * np.arange(round(duration_s * rate)) / rate + 0.7)


def noise(duration_s: float = 4.0, seed: int = 0) -> np.ndarray:
    return 0.1 * np.random.default_rng(seed).standard_normal(round(duration_s * RATE))


def clip(x: np.ndarray, rate: int = RATE) -> AudioClip:
    return AudioClip(x, rate, CREDIT)


# the seam ------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("rate", [44_100, 16_000])
@pytest.mark.parametrize("frequency_hz", [20.0, 23.7, 58.72, 100.0, 187.3, 250.0, 333.3, 499.7])
def test_a_tone_wraps_within_a_degree(frequency_hz: float, rate: int) -> None:
    seam = find_seam(tone(frequency_hz, rate=rate), rate)
    cycles = frequency_hz * seam.length / rate
    assert abs(cycles - round(cycles)) * 360 < 1.0
    assert seam.law == "linear"
    assert seam.length / rate > 1.5


def test_inharmonic_partials_all_wrap_within_tolerance() -> None:
    frequencies = (61.3, 97.9, 143.1)
    seam = find_seam(sum(tone(f) for f in frequencies), RATE)
    for f in frequencies:
        cycles = f * seam.length / RATE
        assert abs(cycles - round(cycles)) * 360 < 20.0


def test_an_offset_does_not_hide_the_cycles() -> None:
    plain = find_seam(0.1 * tone(123.4), RATE)
    offset = find_seam(0.1 * tone(123.4) + 0.8, RATE)
    assert (offset.start, offset.length, offset.law) == (plain.start, plain.length, plain.law)


def test_seam_search_compares_levels_as_well_as_waveforms() -> None:
    """A tone that swells and fades once a second: the loop must last a whole number of seconds."""
    t = np.arange(5 * RATE) / RATE
    seam = find_seam((1.2 + np.cos(2 * np.pi * t)) * np.sin(2 * np.pi * 100 * t), RATE)
    assert seam.length / RATE == pytest.approx(round(seam.length / RATE), abs=0.011)


def jump_db(loop: np.ndarray, rate: int = RATE) -> float:
    """Level of the 200 ms after the wrap, relative to the 200 ms before it [dB]."""
    n = round(0.2 * rate)
    return float(10 * np.log10(np.mean(loop[:n].astype(float) ** 2) / np.mean(loop[-n:].astype(float) ** 2)))


@pytest.mark.parametrize("falls_db", [-14.0, -6.0, 6.0, 14.0])
def test_rising_or_falling_sound_is_levelled_at_the_wrap(falls_db: float) -> None:
    """In an earlier version the level stepped by 3 to 10 dB at every wrap."""
    rng, t = np.random.default_rng(8), np.arange(4 * RATE) / RATE
    engine = sum(np.sin(2 * np.pi * k * (80 + 3 * np.sin(t)) * t) / k for k in range(1, 8))
    x = 10 ** (-falls_db * t / 4.0 / 20) * (engine + 0.5 * rng.standard_normal(len(t)))
    seam = find_seam(x, RATE)
    assert abs(seam.tilt_db) > 1.0
    loop = apply_seam(x, seam)
    assert abs(jump_db(loop)) < 1.5
    assert abs(float(loop[0]) - float(loop[-1])) <= np.abs(np.diff(loop)).max()


@pytest.mark.parametrize("frequency_hz", [20.0, 58.72, 187.3, 499.7])
def test_tones_ticks_and_steady_noise_are_not_tilted(frequency_hz: float) -> None:
    t = np.arange(5 * RATE) / RATE
    ticks = np.sin(2 * np.pi * 300 * t) * np.exp(-(t % 1.7) / 0.01) + 0.05 * noise(5.0)
    for x in (tone(frequency_hz), tone(frequency_hz) + 0.1 * noise(), ticks, noise()):
        assert find_seam(x, RATE).tilt_db == 0.0


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("seconds", [3.5, 6.0])
def test_a_loop_is_as_long_as_its_clip_allows(seconds: float, seed: int) -> None:
    """In an earlier version noises and hums of 3.5 s gave loops of 1.5 s, with the best of many similar seams."""
    x = noise(seconds, seed) + 0.05 * tone(61.3, seconds)
    assert find_seam(x, RATE).length / RATE > 0.6 * seconds


@pytest.mark.parametrize("frequency_hz", [50.0, 100.0, 250.0])
def test_loop_of_a_tone_is_the_longest_of_many_equal_ones(frequency_hz: float) -> None:
    """Any whole number of periods is as good; a long loop repeats less often. A fade and both edges are cut off."""
    assert find_seam(tone(frequency_hz, 2.0), RATE).length / RATE > 0.9 * (2.0 - 0.2 - 2 * 0.02)


def test_loop_of_a_rhythm_has_a_whole_number_of_beats() -> None:
    t = np.arange(5 * RATE) / RATE
    ticks = np.sin(2 * np.pi * 300 * t) * np.exp(-(t % 0.5) / 0.01) + 0.02 * noise(5.0)
    beats = find_seam(ticks, RATE).length / RATE / 0.5
    assert beats == pytest.approx(round(beats), abs=0.001)


@pytest.mark.parametrize(("on_s", "off_s"), [(1.0, 0.5), (0.25, 0.25), (0.4, 0.8)])
@pytest.mark.parametrize("frequency_hz", [97.0, 187.3])
def test_loop_of_a_ringing_phone_keeps_the_length_of_rings_and_pauses(
    on_s: float, off_s: float, frequency_hz: float
) -> None:
    """A seam within a ring matches at any cycle of the tone, but would make this ring longer or shorter."""
    t = np.arange(5 * RATE) / RATE
    since_s = t % (on_s + off_s)
    speed = (since_s < on_s) * (1 - np.exp(-since_s / 0.05))
    x = speed**2 * np.sin(2 * np.pi * np.cumsum(frequency_hz * speed) / RATE) + 1e-4 * noise(5.0)
    loop = apply_seam(x, find_seam(x, RATE))
    step = round(0.02 * RATE)
    level = np.sqrt((np.tile(loop, 3)[: 3 * len(loop) // step * step].reshape(-1, step) ** 2).mean(axis=1))
    lasts_s = 0.02 * np.diff(np.flatnonzero(np.diff((level > 0.35).astype(int))))
    assert np.minimum(np.abs(lasts_s - on_s), np.abs(lasts_s - off_s)).max() < 0.1 * (on_s + off_s)


@pytest.mark.parametrize("felt_hz", [140.6, 144.2, 147.7, 162.0, 175.8])
def test_loop_of_a_ringing_phone_keeps_its_beat_beside_a_shifted_vibration(felt_hz: float) -> None:
    """A seam within a ring matches two tones better than any whole number of periods."""
    t = np.arange(5 * RATE) / RATE
    since_s = t % 1.5
    speed = np.where(since_s < 1.0, 1 - np.exp(-since_s / 0.05), np.exp(-(since_s - 1.0) / 0.08))
    turns = np.cumsum(182.6 * speed) / RATE
    sound, felt = (speed**2 * np.cos(2 * np.pi * (turns + shift * t)) for shift in (0.0, felt_hz - 182.6))
    periods = find_seam(sound, RATE, felt).length / RATE / 1.5
    assert periods == pytest.approx(round(periods), abs=0.025)


@pytest.mark.parametrize("at_s", [0.22, 0.25, 2.0, 3.5])
def test_loop_of_a_single_stroke_holds_the_stroke(at_s: float) -> None:
    """Two positions in the quiet part after a stroke match better than any around the stroke."""
    t = np.arange(4 * RATE) / RATE - at_s
    x = np.where(t > 0, np.sin(2 * np.pi * 200 * t) * np.exp(-np.maximum(t, 0.0) / 0.05), 0.0) + 1e-4 * noise(4.0)
    assert np.abs(apply_seam(x, find_seam(x, RATE))).max() > 0.5 * np.abs(x).max()


@pytest.mark.parametrize("felt_hz", [61.3, 97.9, 163.1])
@pytest.mark.parametrize("frequency_hz", [40.0, 187.3])
def test_loop_of_a_tone_does_not_begin_in_the_burst_of_a_converter(frequency_hz: float, felt_hz: float) -> None:
    """A band-pass responds to the onset of a tone outside its band with a burst, here 40 dB above the felt tone."""
    t = np.arange(4 * RATE) / RATE
    felt = 0.01 * tone(felt_hz) + np.sin(2 * np.pi * 70 * t) * np.exp(-t / 0.02)
    seam = find_seam(tone(frequency_hz), RATE, felt)
    assert seam.start > 0.1 * RATE
    assert seam.fitted(felt).correlation == pytest.approx(1.0, abs=0.01)
    assert seam.fitted(felt).tilt_db == 0.0


@pytest.mark.parametrize("at_s", [0.25, 2.0, 3.7])
def test_loop_holds_a_stroke_that_is_felt_alone(at_s: float) -> None:
    since_s = np.arange(4 * RATE) / RATE - at_s
    stroke = np.sin(2 * np.pi * 80 * since_s) * np.exp(-np.maximum(since_s, 0.0) / 0.05) * (since_s > 0)
    felt = stroke + 1e-4 * noise()
    seam = find_seam(tone(2000.0), RATE, felt)
    assert np.abs(apply_seam(felt, seam.fitted(felt))).max() > 0.5 * np.abs(felt).max()


def test_pauses_of_unequal_noise_do_not_tilt_the_rings_between_them() -> None:
    t = np.arange(5 * RATE) / RATE
    x = np.sin(2 * np.pi * 200 * t) * (t % 1.5 > 0.5) + np.where(t < 1.0, 1e-3, 1e-4) * noise(5.0)
    seam = Seam(RATE // 10, 3 * RATE, RATE // 5, "linear").fitted(x)
    assert seam.tilt_db == 0.0
    loop = apply_seam(x, seam)
    assert np.abs(loop[: int(1.5 * RATE)]).max() == pytest.approx(np.abs(loop[int(1.5 * RATE) :]).max(), rel=0.01)


def test_equal_power_fade_keeps_the_level_of_noise() -> None:
    levels = []
    for seed in range(6):
        x = noise(seed=seed)
        seam = find_seam(x, RATE)
        assert seam.law == "equal-power"
        loop = apply_seam(x, seam).astype(float)
        middle = slice(seam.crossfade // 4, 3 * seam.crossfade // 4)
        levels.append(10 * np.log10(np.mean(loop[middle] ** 2) / np.mean(loop[seam.crossfade :] ** 2)))
    # A linear fade would dip by up to 3 dB, and by 2.4 dB over this stretch.
    assert np.mean(levels) == pytest.approx(0.0, abs=0.4)


@pytest.mark.parametrize("name", [*OWN_SOUNDS, *there(RECORDED, RECORDINGS.joinpath)])
def test_sounds_of_machines_have_no_step_at_the_wrap(sound: Callable[[str], AudioClip], name: str) -> None:
    original = sound(name)
    loop = loop_pair(original, SvfBandpass(), ConversionContext())
    for samples in (loop.audible.samples, loop.tactile.samples):
        around = np.concatenate([samples[-480:], samples[:480]])
        assert np.abs(np.diff(around)).max() <= 1.1 * np.abs(np.diff(samples)).max()
        at_the_wrap = abs(float(samples[0]) - float(samples[-1]))
        assert at_the_wrap <= np.abs(np.diff(samples)).max()
    # No dip or bump either: the level of the fade is within the levels of the other stretches of the same length, or
    # 20 dB below the mean, in a pause.
    fade = round(0.2 * original.sample_rate_hz)
    for samples in (loop.audible.samples, loop.tactile.samples):
        stretches = samples[: len(samples) // fade * fade].reshape(-1, fade).astype(float)
        levels = 10 * np.log10(np.mean(stretches**2, axis=1))
        quiet = 10 * np.log10(np.mean(samples.astype(float) ** 2)) - 20
        assert levels[1:].min() - 1.5 < levels[0] < levels[1:].max() + 1.5 or levels[0] < quiet


def test_fade_has_the_computed_samples() -> None:
    x = np.arange(20.0)
    linear = apply_seam(x, Seam(2, 8, 4, "linear"))
    assert linear.dtype == np.float32
    # The first sample follows the last: x[10] after x[9]; then 0.75 x[11] + 0.25 x[3], ...
    assert linear.tolist() == [10, 0.75 * 11 + 0.25 * 3, 0.5 * 12 + 0.5 * 4, 0.25 * 13 + 0.75 * 5, 6, 7, 8, 9]
    equal_power = apply_seam(np.ones(20), Seam(2, 8, 4, "equal-power"))
    np.testing.assert_allclose(equal_power[[0, 2, 4]], [1, np.sqrt(2), 1], rtol=1e-6)


@pytest.mark.parametrize("r", [1.0, 0.8, 0.6, 0.41, 0.3, 0.0, -0.3])
def test_crossfade_keeps_its_power_for_any_correlation(r: float) -> None:
    """Two noises of unit power and correlation r: the power of their sum stays 1 along the whole fade."""
    n, rng = 1000, np.random.default_rng(9)
    common, ahead, behind = rng.standard_normal((3, 400, n))
    sign = np.sign(r) or 1.0
    share = np.sqrt(abs(r))
    a = share * common + np.sqrt(1 - abs(r)) * ahead
    b = sign * share * common + np.sqrt(1 - abs(r)) * behind
    powers = np.zeros(n)
    for one, other in zip(a, b, strict=True):
        law = "linear" if r > 0.5 else "equal-power"
        powers += apply_seam(np.concatenate([one, other]), Seam(0, n, n, law, correlation=r)).astype(float) ** 2 / 400
    for part in powers.reshape(10, -1).mean(axis=1):
        assert 10 * np.log10(part) == pytest.approx(0.0, abs=0.25)


def test_loop_length_follows_a_hum_under_hiss() -> None:
    """The hiss is 5 dB above the hum. A similarity that weighs all frequencies equally follows the random hiss, with
    errors up to 3.6 degrees here."""
    worst = 0.0
    for seed, f in enumerate((47.3, 97.9, 143.1, 211.7)):
        rng = np.random.default_rng(seed)
        x = tone(f) + 10 ** (5 / 20) * np.sqrt(0.5) * rng.standard_normal(4 * RATE)
        cycles = f * find_seam(x, RATE).length / RATE
        worst = max(worst, abs(cycles - round(cycles)) * 360)
    assert worst < 2.5


def test_each_signal_uses_its_own_fade_law() -> None:
    rng = np.random.default_rng(3)
    hum, hiss = tone(100.0), 3.0 * rng.standard_normal(4 * RATE)
    seam = find_seam(hum + hiss, RATE, hum)
    assert seam.law == "equal-power"
    assert seam.fitted(hum).law == "linear"
    assert seam.fitted(hum).length == seam.length
    loop = apply_seam(hum, seam.fitted(hum)).astype(float)
    cycles = loop[: len(loop) // 480 * 480].reshape(-1, 480)
    np.testing.assert_allclose(np.sqrt(2) * cycles.std(axis=1), 1.0, atol=0.01)


def test_a_long_sound_gives_a_loop_from_its_middle() -> None:
    x = np.concatenate([noise(8.0), tone(100, 12.0), noise(8.0)])
    seam = find_seam(x, RATE)
    assert seam.start / RATE > 8.0
    assert seam.n_samples_needed / RATE < 20.0
    assert seam.length / RATE <= MAX_LOOP_S


def test_seam_search_works_with_silent_stretches() -> None:
    x = tone(100)
    x[RATE : 3 * RATE] = 0.0
    seam = find_seam(x, RATE)
    assert np.isfinite(apply_seam(x, seam)).all()
    assert find_seam(np.zeros(RATE), RATE).n_samples_needed <= RATE


def test_loop_contains_a_single_knock() -> None:
    x = np.zeros(2 * RATE)
    x[5000:5500] = np.hanning(500)
    assert apply_seam(x, find_seam(x, RATE)).max() > 0.1


def test_find_seam_refuses_sounds_that_are_too_short() -> None:
    with pytest.raises(AudioError, match=r"duration is 0\.05 s; it must be at least 0\.1"):
        find_seam(tone(100, 0.05), RATE)
    with pytest.raises(AudioError, match="duration is 1.5 s"):
        find_seam(np.zeros(15), 10)
    assert find_seam(np.arange(16), 10).n_samples_needed <= 16
    with pytest.raises(AudioError, match="equally long"):
        find_seam(tone(100), RATE, tone(100, 3.0))
    with pytest.raises(AudioError, match="needs one channel of 14 samples"):
        apply_seam(np.zeros(13), Seam(2, 8, 4, "linear"))
    with pytest.raises(AudioError, match=r"shape \(2, 3\)"):
        find_seam(np.zeros((2, 3)), RATE)
    for start, length, crossfade in ((-1, 8, 4), (0, 0, 0), (0, 4, 5)):
        with pytest.raises(AudioError, match="impossible"):
            Seam(start, length, crossfade, "linear")


def test_loop_of_a_tone_keeps_its_level() -> None:
    x = 0.3 * tone(80)
    assert np.abs(apply_seam(x, find_seam(x, RATE))).max() == pytest.approx(0.3, rel=1e-3)


# the pair ------------------------------------------------------------------------------------------------------------


def test_both_loops_share_length_rate_and_seam() -> None:
    x = tone(97.3) + 0.4 * tone(2500.1) + 0.2 * noise()
    loop = loop_pair(clip(x), SvfBandpass(), ConversionContext())
    assert len(loop.audible.samples) == len(loop.tactile.samples)
    assert loop.audible.sample_rate_hz == loop.tactile.sample_rate_hz == RATE
    assert loop.audible.credit == loop.tactile.credit == CREDIT
    # At 250 Hz the band-pass has no phase shift, so a 250 Hz tone is equal in both, sample by sample.
    same = loop_pair(clip(tone(250.0)), SvfBandpass(), ConversionContext())
    np.testing.assert_allclose(
        same.tactile.samples / np.abs(same.tactile.samples).max(),
        same.audible.samples / np.abs(same.audible.samples).max(),
        atol=2e-4,
    )


def test_seam_is_not_felt_for_a_hum_below_a_loud_whine() -> None:
    """A seam chosen by the audible sound alone would suit the whine, and break the phase of the felt hum."""
    hum_hz = 71.3
    x = 0.05 * tone(hum_hz) + tone(3000.7) + 0.02 * noise()
    loop = loop_pair(clip(x), SvfBandpass(), ConversionContext())
    cycles = hum_hz * len(loop.tactile.samples) / RATE
    assert abs(cycles - round(cycles)) * 360 < 30.0


def test_loop_peaks_are_head_room_and_intensity() -> None:
    assert TACTILE_HEADROOM_DB == 6.0
    for intensity in (1.0, 0.3):
        loop = loop_pair(clip(0.01 * tone(60)), SvfBandpass(), ConversionContext(intensity=intensity))
        assert np.abs(loop.audible.samples).max() == pytest.approx(10 ** (-1 / 20), rel=1e-6)
        assert np.abs(loop.tactile.samples).max() == pytest.approx(intensity * 0.501187, rel=1e-6)


def test_loop_pair_states_frequencies_before_and_after_conversion() -> None:
    # |H(40 Hz)| = (1 + Q^2 (40/250 - 250/40)^2)^(-1/2) = 0.226: 3 times the amplitude becomes 0.68 times.
    x = 3.0 * tone(40.0) + tone(250.0)
    loop = loop_pair(clip(x), SvfBandpass(), ConversionContext())
    assert loop.frequency_raw_hz == pytest.approx(40.0, abs=0.05)
    assert loop.frequency_tactile_hz == pytest.approx(250.0, abs=0.05)


def test_the_filter_is_settled_when_the_loop_begins() -> None:
    """A narrow filter needs 0.13 s to settle; without a lead-in the loop would begin too weak."""
    loop = loop_pair(clip(tone(250.0)), SvfBandpass(q=100.0), ConversionContext())
    cycles = loop.tactile.samples[: len(loop.tactile.samples) // 192 * 192].reshape(-1, 192)
    peaks = np.abs(cycles).max(axis=1)
    assert peaks.min() > 0.99 * peaks.max()


@dataclass(frozen=True)
class Delay:
    """A converter that delays samples and returns them at the end, except `loses` samples."""

    held: int
    loses: int = 0
    gain: float = 1.0

    def stream(self, sample_rate_hz: int, context: ConversionContext) -> Delay:
        object.__setattr__(self, "_kept", np.zeros(0, np.float32))
        return self

    def process(self, block: Samples) -> Samples:
        everything = self.gain * np.concatenate([self._kept, block])
        object.__setattr__(self, "_kept", everything[len(everything) - self.held :])
        return everything[: len(everything) - self.held]

    def finish(self) -> Samples:
        return self._kept[self.loses :]


def test_loop_pair_includes_samples_that_a_converter_delays() -> None:
    x = tone(100) + 0.3 * noise()
    loop = loop_pair(clip(x), Delay(held=1000), ConversionContext())
    ratio = np.abs(loop.tactile.samples).max() / np.abs(loop.audible.samples).max()
    np.testing.assert_allclose(loop.tactile.samples, ratio * loop.audible.samples, atol=1e-5)


def test_converters_that_lose_samples_or_everything_are_refused() -> None:
    with pytest.raises(AudioError, match="Delay made .* samples"):
        loop_pair(clip(tone(100)), Delay(held=1000, loses=1), ConversionContext())
    with pytest.raises(AudioError, match="'hum': the tactile signal is silent"):
        loop_pair(clip(tone(100)), Delay(held=0, gain=0.0), ConversionContext())
    with pytest.raises(AudioError, match="'hum': the sound is silent"):
        loop_pair(clip(np.zeros(RATE)), SvfBandpass(), ConversionContext())
    with pytest.raises(AudioError, match="intensity is 0"):
        loop_pair(clip(tone(100)), SvfBandpass(), ConversionContext(intensity=0.0))


def test_haptic_loop_refuses_different_lengths_or_rates() -> None:
    a = clip(tone(100))
    for other in (clip(tone(100)[1:]), replace(a, sample_rate_hz=44_100)):
        with pytest.raises(AudioError, match="both must be equal"):
            HapticLoop(a, other, 100.0, 100.0)
    with pytest.raises(AudioError, match="frequency_tactile_hz is 0 Hz"):
        HapticLoop(a, a, 100.0, 0.0)


@pytest.mark.parametrize(("peak_db", "is_noise"), [(-80.0, True), (-61.0, True), (-59.0, False), (-20.0, False)])
@pytest.mark.parametrize("offset", [0.0, 0.1])
def test_noise_floor_of_a_recording_is_refused_as_a_loop(peak_db: float, is_noise: bool, offset: float) -> None:
    x = np.random.default_rng(0).standard_normal(3 * 8000)
    clip = AudioClip((offset + x / np.abs(x).max() * 10 ** (peak_db / 20)).astype(np.float32), 8000)
    if is_noise:
        with pytest.raises(AudioError, match=f"{peak_db:.0f} dB re full scale"):
            loop_pair(clip, SvfBandpass(), ConversionContext())
    else:
        assert loop_pair(clip, SvfBandpass(), ConversionContext()).tactile.samples.any()


@pytest.mark.parametrize("offset", [0.0, 0.1])
@pytest.mark.parametrize("kind", ["auto", "lowpass"])
def test_a_sound_between_silences_is_looped_whole(kind: str, offset: float) -> None:
    """In an earlier version the fade of the seam took 13 dB from a knock at the beginning of its recording."""
    t = np.arange(2 * RATE) / RATE
    x = np.zeros(2 * RATE)
    x[1:] = 0.5 * (np.exp(-t / 0.03) * np.sin(2 * np.pi * 200.0 * t))[:-1] * (t[:-1] < 0.3)
    sound, converter = clip(x + offset), CONVERTERS.build(kind)
    (plan,) = plan_scene([SourceClip(sound, 0.3)], converter, actuator_profile("flat"))
    loop = felt_loop(sound, converter, plan)
    np.testing.assert_allclose(loop.audible.samples, x * loop.audible.samples.max() / x.max(), atol=1e-6)
    felt = loop.tactile.samples.astype(float)
    assert np.abs(felt[: RATE // 5]).max() == np.abs(felt).max()
    assert abs(felt[0] - felt[-1]) < 1e-3 * np.abs(felt).max()
    assert np.abs(felt[-RATE:]).max() < 1e-2 * np.abs(felt).max()


def test_the_offset_of_a_recording_is_in_neither_loop() -> None:
    """A game that starts a loop with an offset clicks, and the offset takes head-room."""
    x = 0.3 * tone(150.0) + 0.01 * noise()
    loop, plain = (loop_pair(clip(x + offset), SvfBandpass(), ConversionContext()) for offset in (0.2, 0.0))
    for one, other in ((loop.audible, plain.audible), (loop.tactile, plain.tactile)):
        assert abs(one.samples.mean(dtype=float)) < 1e-3
        np.testing.assert_allclose(one.samples, other.samples, atol=1e-4)


@pytest.mark.parametrize("kind", ["auto", "adaptive", "lowpass"])
def test_a_sound_between_silences_that_has_an_offset_begins_at_rest(kind: str) -> None:
    """In an earlier version the mean was subtracted from the silence before the sound, too: a step at each wrap."""
    t = np.arange(3 * RATE) / RATE
    offset = np.clip((np.minimum(t, 2.5 - t) - 0.7) / 0.3, 0.0, 1.0)
    x = 0.25 * offset + 0.4 * np.exp(-np.maximum(t - 1.2, 0.0) / 0.05) * np.sin(2 * np.pi * 200.0 * t) * (t >= 1.2)
    x[t > 2.0] = 0.0
    sound, converter = clip(x), CONVERTERS.build(kind)
    (plan,) = plan_scene([SourceClip(sound, 0.3)], converter, actuator_profile("flat"))
    loop = felt_loop(sound, converter, plan)
    assert len(loop.tactile.samples) == len(x)
    felt = np.abs(loop.tactile.samples.astype(float))
    assert felt[: RATE // 2].max() < 1e-3 * felt.max()


@pytest.mark.parametrize("offset", [0.0, 0.8])
def test_a_beat_between_silences_keeps_whole_periods(offset: float) -> None:
    t = np.arange(round(6.4 * RATE)) / RATE
    rings = np.sin(2 * np.pi * 400.0 * t) * (t % 1.5 < 0.8) * (t < 5.6)
    rings[0] = 0.0
    loop = loop_pair(clip(0.1 * rings + offset), Lowpass(), ConversionContext())
    periods = len(loop.audible.samples) / RATE / 1.5
    assert periods == pytest.approx(round(periods), abs=0.03)


def test_loop_of_a_long_sound_is_not_cut_from_a_pause_in_its_middle() -> None:
    """In an earlier version such a sound was refused as silent, or the noise of the room became its loop."""
    rng, t = np.random.default_rng(0), np.arange(60 * 8000) / 8000
    x = 0.3 * np.sin(2 * np.pi * 180.0 * t) * ((t < 23.0) | (t > 39.0)) + 1e-4 * rng.standard_normal(len(t))
    middle = middle_of(AudioClip(x.astype(np.float32), 8000))
    assert middle.duration_s == pytest.approx(14.2)
    assert np.square(middle.samples[16_000:-16_000]).mean() > 0.25 * np.square(x).mean()
    steady = AudioClip(x[: 22 * 8000].astype(np.float32), 8000)
    first = (len(steady.samples) - len(middle.samples)) // 2
    np.testing.assert_array_equal(middle_of(steady).samples, steady.samples[first : first + len(middle.samples)])


def test_component_that_was_chosen_is_felt_however_weak_it_is() -> None:
    """In an earlier version it counted as noise, and the loop stayed at the threshold of touch."""
    t = np.arange(3 * 32_000) / 32_000
    x = 0.02 * (np.sin(2 * np.pi * 4000.0 * t) + 0.012 * np.sin(2 * np.pi * 200.0 * t))
    clip, auto = AudioClip(x.astype(np.float32), 32_000), CONVERTERS.build("auto")
    (plan,) = plan_scene([SourceClip(clip, 0.3)], auto, actuator_profile("flat"))
    assert plan.context.own_hz == pytest.approx(200.0, abs=0.1)
    loop = felt_loop(clip, auto, plan)
    assert loop.felt is not None
    assert loop.felt.level_db == pytest.approx(loop.felt.asked_level_db, abs=1.0)


def test_remainder_of_a_filtered_whine_is_not_amplified() -> None:
    x = 0.5 * tone(9000.0) + 1e-4 * noise()
    loop = loop_pair(clip(x), Lowpass(), ConversionContext())
    assert np.abs(loop.audible.samples).max() > 0.8
    assert 0.0 < np.abs(loop.tactile.samples).max() < 1e-3
