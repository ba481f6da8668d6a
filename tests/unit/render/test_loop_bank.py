"""Loop bank: loops at the tactile rate keep their sound and period; bands of a loop are rows."""

import math
from collections.abc import Callable
from fractions import Fraction

import numpy as np
import pytest
from numpy.typing import NDArray

from loop_reading import read_loop
from scene2hap import AudioClip, Bands
from scene2hap.render.loop_bank import CELL, LoopBank, position_s

TACTILE = 8000


def tone(cycles: int, n: int, rate: int) -> AudioClip:
    samples = 0.3 * np.sin(2 * np.pi * cycles * np.arange(n) / n)
    return AudioClip(samples.astype(np.float32), rate)


def phase_of(x: NDArray[np.float32], begin: int, frequency_hz: float) -> complex:
    t = (begin + np.arange(len(x))) / TACTILE
    return complex(np.sum(x * np.hanning(len(x)) * np.exp(-2j * np.pi * frequency_hz * t)))


def test_loops_wrap_by_themselves_even_when_shorter_than_a_cell() -> None:
    clips = [AudioClip(np.linspace(-0.5, 0.5, n).astype(np.float32), TACTILE) for n in (1, 7, 80, 100)]
    bank = LoopBank(clips, Bands.dominant(), TACTILE)
    for loop, clip in enumerate(clips):
        n = len(clip.samples)
        np.testing.assert_array_equal(read_loop(bank, loop, 70, 200)[0], clip.samples[(70 + np.arange(200)) % n])


@pytest.mark.parametrize("rate", [4000, 11025, 22050, 44100, 48000, 96000])
def test_a_loop_of_another_rate_keeps_its_sound(rate: int) -> None:
    bank = LoopBank([tone(32, rate * 2 // 5, rate)], Bands.dominant(), TACTILE)
    expected = 0.3 * np.sin(2 * np.pi * 80 * np.arange(4000) / TACTILE)
    np.testing.assert_allclose(read_loop(bank, 0, 0, 4000)[0], expected, atol=1e-6)


# Lengths at which no number of samples at 8 kHz fits: about 5, 1.3, 0.2 and 0.003 s.
ODD = [(220_501, 44_100), (62_423, 48_000), (8_821, 44_100), (133, 44_100), (55_127, 11_025)]


@pytest.mark.parametrize(("n", "rate"), ODD)
@pytest.mark.parametrize("minutes", [0, 1, 10, 600])
def test_tactile_position_stays_within_a_sample_of_the_audible_loop(n: int, rate: int, minutes: int) -> None:
    cycles = max(1, round(100 * n / rate))
    frequency_hz = cycles * rate / n
    bank = LoopBank([tone(cycles, n, rate)], Bands.dominant(), TACTILE)
    begin = minutes * 60 * TACTILE + 7
    turn = phase_of(read_loop(bank, 0, begin, 2400)[0], begin, frequency_hz) * 1j
    lag_samples = -np.angle(turn) / (2 * np.pi * frequency_hz) * TACTILE
    assert abs(lag_samples) <= 1.0


def played(bank: LoopBank) -> NDArray[np.float32]:
    return read_loop(bank, 0, 0, 120_000)[0]


def taken(bank: LoopBank) -> NDArray[np.float32]:
    """As a start or a stop of a source takes it."""
    return bank.taken(0, 0, 120_000)[:, 0]


@pytest.mark.parametrize("reading", [played, taken])
@pytest.mark.parametrize(("n", "rate"), ODD)
def test_position_correction_causes_no_click(
    n: int, rate: int, reading: Callable[[LoopBank], NDArray[np.float32]]
) -> None:
    """Energy above 1 kHz, where the tone has none, over 15 seconds with all position corrections."""
    from scipy.signal import butter, sosfiltfilt

    cycles = max(1, round(400 * n / rate))
    bank = LoopBank([tone(cycles, n, rate)], Bands.dominant(), TACTILE)
    x = reading(bank).astype(np.float64)
    high = sosfiltfilt(butter(8, 1000, "highpass", fs=TACTILE, output="sos"), x)[800:-800]
    loudest = max(np.mean(high[at : at + 2000] ** 2) for at in range(0, len(high) - 2000, 500))
    assert 10 * math.log10(loudest / np.mean(x**2)) < -60


@pytest.mark.parametrize(("n", "rate"), [*ODD, (99, 44_100), (1_003, 44_100), (7_001, 48_000)])
def test_no_number_of_turns_within_a_second_fits_better(n: int, rate: int) -> None:
    """A loop at n / rate [s] is stored as whole tactile samples: the smaller the misfit, the rarer the corrections."""
    turn = Fraction(n * TACTILE, rate)
    misfits = [abs(max(1, round(k * turn)) / (k * turn) - 1) for k in range(1, max(1, rate // n) + 1)]
    (stored,) = LoopBank([tone(1, n, rate)], Bands.dominant(), TACTILE)._stored
    assert abs(Fraction(stored.numerator, stored.denominator) - 1) == min(misfits)


def test_position_is_that_of_the_audible_loop_however_long_it_runs() -> None:
    n, rate = 220_501, 44_100
    for frame in (0, 1, 239_999, 48_000 * 86_400 * 7 + 5):
        exact = Fraction(frame, 48_000) % Fraction(n, rate)
        assert position_s(n, rate, frame, 48_000) == pytest.approx(float(exact), abs=1e-12)


def test_bands_of_a_loop_are_rows_that_add_up() -> None:
    clip = AudioClip(np.random.default_rng(1).uniform(-0.5, 0.5, 4000).astype(np.float32), TACTILE)
    bank = LoopBank([clip, clip], Bands.third_octaves(), TACTILE)
    assert (len(bank), bank.n_bands, bank.n_rows) == (2, 20, 40)
    np.testing.assert_allclose(read_loop(bank, 0, 0, 4000).sum(axis=0), clip.samples, atol=1e-5)


def test_loop_bank_stores_one_second_per_row() -> None:
    clip = AudioClip(np.zeros(44_100, dtype=np.float32), 44_100)
    bank = LoopBank([clip, clip], Bands.third_octaves(), TACTILE)
    assert bank.nbytes == 2 * 20 * (8000 + CELL) * 4
