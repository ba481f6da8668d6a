"""The mixer against a slow reference that works sample by sample, and its guarantees to threads."""

import gc
import threading
import tracemalloc
from collections.abc import Iterator

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from numpy.typing import NDArray
from scipy.signal import butter, sosfiltfilt

from garbage import only_new_garbage
from loop_reading import read_loop
from mixed_rows import set_gains
from scene2hap import AudioClip, Bands
from scene2hap.errors import ConfigError, SessionError
from scene2hap.render.loop_bank import LoopBank
from scene2hap.render.mixer import Mixer
from slow_mixer import Changes, slow_mix

TACTILE = 8000
RAMP_S = 0.01
RAMP = 80
RATES = [8000, 48000, 44100, 12000]
TONES = [(100, 800), (250, 320), (40, 1000), (125, 64), (800, 10)]


@pytest.fixture(autouse=True)
def _only_new_garbage() -> Iterator[None]:
    with only_new_garbage():
        yield


def tone(frequency_hz: float, n: int, amplitude: float = 0.3) -> AudioClip:
    samples = amplitude * np.sin(2 * np.pi * frequency_hz * np.arange(n) / TACTILE)
    return AudioClip(samples.astype(np.float32), TACTILE)


def bank() -> LoopBank:
    return LoopBank([tone(*item) for item in TONES], Bands.dominant(), TACTILE)


def new_mixer(rate: int = 48000, n_hands: int = 2, **settings: bool) -> Mixer:
    return Mixer(bank(), n_hands, sample_rate_hz=rate, ramp_s=RAMP_S, **settings)


def play(mixer: Mixer, blocks: list[int], n_frames: int) -> NDArray[np.float32]:
    parts: list[NDArray[np.float32]] = []
    done = 0
    while done < n_frames:
        parts.append(mixer.render(min(blocks[len(parts) % len(blocks)], n_frames - done)))
        done += len(parts[-1])
    return np.concatenate(parts)


def stamped(changes: list[tuple[int, list[float]]]) -> Changes:
    return [(start, np.array(gains, dtype=np.float32).reshape(2, -1)) for start, gains in sorted(changes)]


# Gains of 0 are frequent, so that loops often start and stop.
GAIN = st.one_of(st.just(0.0), st.floats(0.0, 4.0, width=32))
CHANGES = st.lists(
    st.tuples(st.integers(0, 5000), st.lists(GAIN, min_size=2 * len(TONES), max_size=2 * len(TONES))), max_size=6
)
BLOCKS = st.lists(st.integers(1, 4096), min_size=1, max_size=8)


@settings(max_examples=12)
@given(CHANGES, BLOCKS, st.sampled_from(RATES))
def test_equals_the_slow_mixer_for_any_blocks(
    changes: list[tuple[int, list[float]]], blocks: list[int], rate: int
) -> None:
    n_frames = 6000
    mixer = new_mixer(rate)
    for start, gains in stamped(changes):
        set_gains(mixer, gains, start)
    out = play(mixer, blocks, n_frames)
    loops = [clip.samples.astype(np.float64) for clip in (tone(*item) for item in TONES)]
    expected = slow_mix(loops, stamped(changes), n_frames, 2, ramp=RAMP, rate_in_hz=TACTILE, rate_out_hz=rate)
    assert out.dtype == np.float32
    np.testing.assert_allclose(out, expected, atol=1e-6)


@settings(max_examples=30)
@given(CHANGES, BLOCKS, st.sampled_from([*RATES, 11025, 16001]))
def test_mixer_output_is_bit_identical_for_any_block_size(
    changes: list[tuple[int, list[float]]], blocks: list[int], rate: int
) -> None:
    whole, cut = new_mixer(rate), new_mixer(rate)
    for mixer in (whole, cut):
        for start, gains in stamped(changes):
            set_gains(mixer, gains, start)
    np.testing.assert_array_equal(play(cut, blocks, 6000), whole.render(6000))


@pytest.mark.parametrize("block", [1, 7, 128, 4096])
def test_gains_that_arrive_just_in_time_give_the_same_bits(block: int) -> None:
    rng = np.random.default_rng(block)
    changes = [(int(at), rng.uniform(0, 1, (2, len(TONES))).astype(np.float32)) for at in range(5, 9000, 731)]
    early, late = new_mixer(), new_mixer()
    for at, gains in changes:
        set_gains(early, gains, at)
    parts = []
    while late.position < 9000:
        for at, gains in changes:
            if late.position <= at < late.position + block:
                set_gains(late, gains, at)
        parts.append(late.render(block))
    np.testing.assert_array_equal(np.concatenate(parts)[:9000], early.render(9000))


def test_true_bands_at_a_kilohertz_of_updates() -> None:
    rng = np.random.default_rng(3)
    clips = [AudioClip(rng.uniform(-0.1, 0.1, n).astype(np.float32), TACTILE) for n in (4000, 3001)]
    bands = Bands.third_octaves()
    stored = LoopBank(clips, bands, TACTILE)
    rows = [row for loop in range(2) for row in read_loop(stored, loop, 0, len(clips[loop].samples))]
    changes = [(frame, rng.uniform(0, 1, (2, 40)).astype(np.float32)) for frame in range(0, 4800, 48)]
    mixer = Mixer(stored, 2, sample_rate_hz=48000, ramp_s=RAMP_S)
    for frame, gains in changes:
        set_gains(mixer, gains, frame, bands.n_bands)
    expected = slow_mix(
        [row.astype(np.float64) for row in rows], changes, 4800, 2, ramp=RAMP, rate_in_hz=TACTILE, rate_out_hz=48000
    )
    np.testing.assert_allclose(mixer.render(4800), expected, atol=1e-6)
    assert mixer.stats.changes_merged == 0


def test_skipped_silent_loops_are_counted_and_change_nothing_felt() -> None:
    def run(skip_silent: bool) -> Mixer:
        mixer = new_mixer(skip_silent=skip_silent)
        for frame, loop in ((0, 0), (3000, 1), (3100, 0), (9000, 4)):
            gains = np.zeros((2, len(TONES)), dtype=np.float32)
            gains[0, loop] = 0.5
            set_gains(mixer, gains, frame)
        return mixer

    skipping, full = run(True), run(False)
    # The sum has other rows, so that a BLAS may add in another order.
    np.testing.assert_allclose(skipping.render(20000), full.render(20000), atol=1e-7)
    assert full.stats.rows_skipped == 0
    assert skipping.stats.rows_mixed + skipping.stats.rows_skipped == full.stats.rows_mixed
    # One of five loops plays at a time, two during a cross-fade.
    assert skipping.stats.rows_skipped > 0.7 * full.stats.rows_mixed


def test_silence_before_the_first_gain_and_after_the_last() -> None:
    mixer = new_mixer()
    assert not mixer.render(5000).any()
    assert mixer.stats.rows_mixed == 0
    set_gains(mixer, np.ones((2, len(TONES)), dtype=np.float32), 0)
    assert mixer.render(5000).any()
    set_gains(mixer, np.zeros((2, len(TONES)), dtype=np.float32), 0)
    mixer.render(1000)
    assert not mixer.render(5000).any()


@pytest.mark.parametrize("rate", RATES)
def test_a_change_begins_with_the_next_tactile_sample(rate: int) -> None:
    constant = LoopBank([AudioClip(np.full(100, 0.5, dtype=np.float32), TACTILE)], Bands.dominant(), TACTILE)
    for frame in (96, 97, 100, 101):
        mixer = Mixer(constant, 1, sample_rate_hz=rate, ramp_s=1 / TACTILE)
        set_gains(mixer, np.ones((1, 1), dtype=np.float32), frame)
        first = int(np.flatnonzero(mixer.render(400)[:, 0])[0])
        tick = -(-frame * TACTILE // rate)
        assert frame <= first < frame + 2 * rate / TACTILE
        assert first == -(-tick * rate // TACTILE)


@pytest.mark.parametrize("rate", RATES)
def test_measured_delay_equals_the_stated_delay(rate: int) -> None:
    mixer = new_mixer(rate, 1)
    gains = np.zeros((1, len(TONES)), dtype=np.float32)
    gains[0, 0] = 1.0
    set_gains(mixer, gains, 0)
    out = mixer.render(rate)[rate // 2 :, 0]
    t = np.arange(rate // 2, rate) / rate
    phase = np.angle(np.sum(out * np.exp(-2j * np.pi * 100 * t)) * 1j)
    assert -phase / (2 * np.pi * 100) == pytest.approx(mixer.delay_s, abs=1e-6)
    assert mixer.delay_s < 0.001


def test_a_late_change_starts_with_the_next_frame() -> None:
    mixer = new_mixer(8000, 1)
    mixer.render(500)
    set_gains(mixer, np.full((1, len(TONES)), 0.5, dtype=np.float32), 100)
    out = mixer.render(200)[:, 0]
    assert np.abs(np.diff(out)).max() < 0.3
    assert np.abs(out[:3]).max() < 0.01
    assert np.abs(out[100:]).max() > 0.2


def test_changes_that_come_too_fast_are_merged_and_the_last_one_counts() -> None:
    mixer, direct = new_mixer(8000), new_mixer(8000)
    last = np.full((2, len(TONES)), 0.2, dtype=np.float32)
    for at in range(400):
        set_gains(mixer, np.full((2, len(TONES)), 0.4 * (at % 2), dtype=np.float32), at)
    set_gains(mixer, last, 400)
    set_gains(direct, last, 400)
    mixer.render(1000)
    direct.render(1000)
    assert mixer.stats.changes_merged > 200
    np.testing.assert_allclose(mixer.render(1000), direct.render(1000), atol=1e-6)


def test_loud_mixes_stay_within_full_scale_at_every_rate() -> None:
    for rate in RATES:
        mixer = new_mixer(rate)
        set_gains(mixer, np.full((2, len(TONES)), 1e6, dtype=np.float32), 0)
        out = mixer.render(10000)
        assert np.isfinite(out).all()
        assert np.abs(out).max() <= 1.0
        tone = np.zeros((2, len(TONES)), dtype=np.float32)
        tone[:, 0] = 7.0
        set_gains(mixer, tone, 10000)
        mixer.render(5 * rate)
        assert np.abs(mixer.render(rate)).max() == pytest.approx(10 ** (-3 / 20), rel=0.02)


def test_loud_tones_keep_their_shape() -> None:
    """Three tones that add up to twice the limit keep their shape: odd multiples have at most 1 % of their amplitude.

    A limiter curve without memory gave 14 %.
    """
    mixer = new_mixer(48000, 1)
    loud = np.zeros((1, len(TONES)), dtype=np.float32)
    loud[0, [0, 1, 3]] = 1.7  # 100, 250 and 125 Hz of 0.3 each
    set_gains(mixer, loud, 0)
    mixer.render(48000)
    spectrum = np.abs(np.fft.rfft(mixer.render(4 * 48000)[:, 0]))
    own = [4 * f for f in (100, 250, 125)]
    odd = [4 * k * f for f in (100, 250, 125) for k in (3, 5, 7) if k * f not in (100, 250, 125)]
    assert np.sqrt(np.square(spectrum[odd]).sum() / np.square(spectrum[own]).sum()) < 0.01
    # All three are reduced by the same factor: none is masked by the others.
    assert spectrum[own] == pytest.approx([spectrum[own[0]]] * 3, rel=0.01)


def test_a_mix_that_becomes_loud_makes_no_click() -> None:
    """A tone of 100 Hz that rises to full scale stays below -60 dB above 1.4 kHz, and -40 if the gain fell at once."""
    mixer = new_mixer(48000, 1)
    loud = np.zeros((1, len(TONES)), dtype=np.float32)
    loud[0, 0] = 1.0 / 0.3
    set_gains(mixer, loud, 0)
    y = mixer.render(24000)[:, 0] * np.minimum(1.0, np.arange(24000)[::-1] / 2400)
    assert np.abs(y).max() > 10 ** (-3 / 20)
    above = sosfiltfilt(butter(6, 1400.0, "high", fs=48000, output="sos"), y)
    assert 20 * np.log10(np.abs(above).max()) < -60.0


def test_a_quiet_mix_after_a_loud_one_comes_back_slowly() -> None:
    mixer, quiet = new_mixer(8000, 1), new_mixer(8000, 1)
    gains = np.zeros((2, 1, len(TONES)), dtype=np.float32)
    gains[:, 0, 0] = 7.0, 1.0
    set_gains(quiet, gains[1], 0)
    quiet.render(8000)
    set_gains(mixer, gains[0], 0)
    mixer.render(8000)
    set_gains(mixer, gains[1], 8000)
    seconds = [np.abs(mixer.render(8000)).max() for _ in range(5)]
    assert np.diff(seconds[1:]).min() > 0  # the first second includes the ramp down
    assert seconds[4] == pytest.approx(np.abs(quiet.render(8000)).max(), rel=0.02)


def test_mixer_without_loops_renders_silence() -> None:
    bands = Bands.third_octaves()
    empty = Mixer(LoopBank([], bands, TACTILE), 2, sample_rate_hz=48000, ramp_s=RAMP_S)
    empty.set_gains(np.zeros((2, 0, bands.n_bands), dtype=np.float32), [], 0)
    assert empty.render(1000).shape == (1000, 2)
    assert not empty.render(0).size


def test_position_counts_frames() -> None:
    mixer = new_mixer()
    for n in (1, 128, 4096):
        mixer.render(n)
    assert mixer.position == 4225


def test_render_into_a_buffer_of_the_caller() -> None:
    mixer, other = new_mixer(), new_mixer()
    gains = np.ones((2, len(TONES)), dtype=np.float32)
    for each in (mixer, other):
        set_gains(each, gains, 0)
    wide = np.zeros((300, 4), dtype=np.float32)
    mixer.render_into(wide[:, 1:3])
    np.testing.assert_array_equal(wide[:, 1:3], other.render(300))
    assert not wide[:, [0, 3]].any()


def test_gains_are_copied_when_they_are_set() -> None:
    mixer = new_mixer()
    gains = np.ones((2, len(TONES), 1), dtype=np.float32)
    mixer.set_gains(gains, range(len(TONES)), 0)
    gains[:] = np.nan
    assert np.isfinite(mixer.render(1000)).all()


def test_repeated_gains_for_one_frame_replace_each_other() -> None:
    mixer, direct = new_mixer(), new_mixer()
    gains = [np.full((2, len(TONES)), 0.01 * (i % 50), dtype=np.float32) for i in range(1000)]
    for some in gains:
        set_gains(mixer, some, 100)
    set_gains(direct, gains[-1], 100)
    np.testing.assert_array_equal(mixer.render(2000), direct.render(2000))
    assert mixer.stats.changes_merged == 0


def test_some_loops_are_set_and_all_others_fall_silent() -> None:
    mixer, direct = new_mixer(), new_mixer()
    for some in ([3, 0], [2], [], [1, 4, 2]):
        gains = np.random.default_rng(len(some)).uniform(0.1, 0.5, (2, len(some), 1)).astype(np.float32)
        whole = np.zeros((2, len(TONES)), dtype=np.float32)
        whole[:, some] = gains[:, :, 0]
        mixer.set_gains(gains, some, mixer.position)
        set_gains(direct, whole, direct.position)
        np.testing.assert_allclose(mixer.render(300), direct.render(300), atol=1e-6)
    with pytest.raises(SessionError, match=r"shape \(2, 2, 1\); it must be finite numbers of shape \(2, 1, 1\)"):
        mixer.set_gains(np.zeros((2, 2, 1), dtype=np.float32), [1], mixer.position)


def test_gains_whose_square_overflows_are_played() -> None:
    mixer = new_mixer()
    set_gains(mixer, np.full((2, len(TONES)), 1e30, dtype=np.float32), 0)
    assert np.isfinite(mixer.render(1000)).all()


@pytest.mark.parametrize("bad", [np.zeros((1, len(TONES), 1)), np.full((2, len(TONES), 1), np.nan)])
def test_gains_that_cannot_be_played_are_refused_where_they_are_set(bad: NDArray[np.float64]) -> None:
    with pytest.raises(SessionError, match=r"must be finite numbers of shape \(2, 5, 1\)"):
        new_mixer().set_gains(bad.astype(np.float32), range(len(TONES)), 0)


def test_invalid_rates_are_refused() -> None:
    with pytest.raises(ConfigError, match="sample_rate_hz is 4000 Hz; it must be at least 8000"):
        new_mixer(4000)
    with pytest.raises(ConfigError, match="ramp_s is 0 s"):
        Mixer(bank(), 1, sample_rate_hz=8000, ramp_s=0.0)


def test_rendering_allocates_little_and_keeps_nothing() -> None:
    mixer = new_mixer()
    rng = np.random.default_rng(0)
    gains = [rng.uniform(0, 1, (2, len(TONES))).astype(np.float32) for _ in range(8)]
    out = np.zeros((128, 2), dtype=np.float32)

    def run(n_blocks: int) -> int:
        worst = 0
        for block in range(n_blocks):
            set_gains(mixer, gains[block % 8], mixer.position)
            tracemalloc.reset_peak()
            before = tracemalloc.get_traced_memory()[0]
            mixer.render_into(out)
            worst = max(worst, tracemalloc.get_traced_memory()[1] - before)
        return worst

    # A full collection empties Python's free lists, so that reused small objects would count as allocated.
    gc.collect()
    gc.disable()
    tracemalloc.start()
    try:
        run(200)
        held = tracemalloc.get_traced_memory()[0]
        # Enough for small objects of plain Python, but not for another buffer of one cell and all slots.
        assert run(200) <= 5120
        assert tracemalloc.get_traced_memory()[0] - held < 2048
    finally:
        tracemalloc.stop()
        gc.enable()


def test_setting_gains_while_rendering() -> None:
    mixer = new_mixer(48000, 1)
    done = threading.Event()
    n_set = 0

    def game() -> None:
        nonlocal n_set
        while not done.is_set():
            set_gains(mixer, np.full((1, len(TONES)), 0.1 * (n_set % 10), dtype=np.float32), mixer.position)
            n_set += 1
            done.wait(0.0002)

    thread = threading.Thread(target=game)
    thread.start()
    blocks = [mixer.render(128) for _ in range(2000)]
    while n_set <= 10:  # a block may end before Python runs the other thread
        blocks.append(mixer.render(128))
    done.set()
    thread.join()
    out = np.concatenate(blocks)
    assert np.isfinite(out).all()
    # Twice the steepest slope of the loops at the largest gain: no step, whatever the timing of the threads.
    steepest = 0.9 * 0.3 * 2 * np.pi * sum(frequency for frequency, _ in TONES) / 48000
    assert np.abs(np.diff(out[:, 0])).max() < 2 * steepest
