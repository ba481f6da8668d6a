"""Response, delay and images of the upsampler, measured with tones and impulses."""

import numpy as np
import pytest
from numpy.typing import NDArray

from scene2hap.render.loop_bank import CELL
from scene2hap.render.upsampler import Upsampler

RATES = [(8000, 48000), (8000, 44100), (8000, 96000), (8000, 11025), (8000, 9001), (4000, 48000), (2500, 48000)]


def convert(x: NDArray[np.float32], rate_in: int, rate_out: int) -> NDArray[np.float64]:
    upsampler = Upsampler(rate_in, rate_out, 1)
    parts = []
    for begin in range(0, len(x) - CELL + 1, CELL):
        upsampler.next_cell()
        upsampler.cell[0] = x[begin : begin + CELL]
        n = upsampler.first_output_of(begin + CELL) - upsampler.first_output_of(begin)
        parts.append(upsampler.outputs(begin)[0, :n].astype(np.float64))
    return np.concatenate(parts)


@pytest.mark.parametrize(("rate_in", "rate_out"), RATES)
def test_upsampled_tones_keep_level_have_the_stated_delay_and_no_image(rate_in: int, rate_out: int) -> None:
    delay_s = Upsampler(rate_in, rate_out, 1).delay_s
    for frequency_hz in (30.0, 250.0, 700.0, 1000.0):
        x = np.sin(2 * np.pi * frequency_hz * np.arange(rate_in) / rate_in).astype(np.float32)
        y = convert(x, rate_in, rate_out)
        n = len(y) // 2
        y, t = y[-n:], (len(y) - n + np.arange(n)) / rate_out
        window = np.kaiser(n, 20.0)
        basis = np.exp(-2j * np.pi * frequency_hz * (t - delay_s))
        answer = 2j * np.sum(y * window * basis) / window.sum()
        assert abs(20 * np.log10(abs(answer))) < 0.1
        assert abs(np.angle(answer)) / (2 * np.pi * frequency_hz) < 2e-7
        spectrum = np.abs(np.fft.rfft(y * window)) * 2 / window.sum()
        above = np.fft.rfftfreq(n, 1 / rate_out) > rate_in / 2
        assert 20 * np.log10(spectrum[above].max(initial=1e-12)) < -80


def test_images_of_frequencies_above_1_khz_are_stopped() -> None:
    for frequency_hz in (2000.0, 3000.0, 3900.0):
        x = np.sin(2 * np.pi * frequency_hz * np.arange(8000) / 8000).astype(np.float32)
        y = convert(x, 8000, 48000)[4000:]
        spectrum = np.abs(np.fft.rfft(y * np.kaiser(len(y), 20.0))) * 2 / np.kaiser(len(y), 20.0).sum()
        assert 20 * np.log10(spectrum[np.fft.rfftfreq(len(y), 1 / 48000) > 4050].max()) < -80


def test_equal_rates_pass_untouched() -> None:
    x = np.random.default_rng(0).uniform(-1, 1, 240).astype(np.float32)
    np.testing.assert_array_equal(convert(x, 8000, 8000), x)
    assert Upsampler(8000, 8000, 1).delay_s == 0.0


@pytest.mark.parametrize(("rate_in", "rate_out"), RATES)
def test_upsampler_is_causal(rate_in: int, rate_out: int) -> None:
    upsampler = Upsampler(rate_in, rate_out, 1)
    for frame in (*range(50), 10**9 + 7):
        sample = upsampler.input_of(frame)
        assert sample * rate_out <= frame * rate_in < (sample + 1) * rate_out
        assert upsampler.first_output_of(sample) <= frame < upsampler.first_output_of(sample + 1)


def test_delay_is_below_a_millisecond_at_usual_rates() -> None:
    assert Upsampler(8000, 48000, 2).delay_s < 0.001
    assert Upsampler(8000, 44100, 2).delay_s < 0.001
