from __future__ import annotations

import ast
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from scene2hap import audio
from scene2hap.audio.bands import band_weights, split_bands
from scene2hap.errors import AudioError
from scene2hap.haptics import Bands

RATE = 8000


def tone(frequency_hz: float, n: int = 2 * RATE) -> np.ndarray:
    """The nearest tone with a whole number of cycles in the loop."""
    cycles = round(frequency_hz * n / RATE)
    return np.sin(2 * np.pi * cycles * np.arange(n) / n + 0.3)


def level_db(x: np.ndarray) -> np.ndarray:
    return 10 * np.log10(np.maximum(np.mean(np.asarray(x, dtype=float) ** 2, axis=-1), 1e-30))


@pytest.mark.parametrize("n", [1, 2, 999, 16_000, 16_001])
@pytest.mark.parametrize("bands", [Bands.third_octaves(), Bands((50.0, 60.0, 400.0)), Bands((100.0, 200.0))])
def test_bands_add_up_to_the_loop(n: int, bands: Bands) -> None:
    x = np.random.default_rng(n).uniform(-1, 1, n).astype(np.float32)
    parts = split_bands(x, RATE, bands)
    assert parts.shape == (bands.n_bands, n)
    assert parts.dtype == np.float32
    assert level_db(parts.sum(axis=0, dtype=float) - x) < level_db(x) - 100


def test_a_tone_at_a_band_centre_is_in_that_band_alone() -> None:
    bands = Bands.third_octaves()
    for j, (low, high) in enumerate(bands.widths_hz()):
        levels = level_db(split_bands(tone(np.sqrt(low * high), 4 * RATE), RATE, bands))
        assert levels[j] == pytest.approx(level_db(tone(100)), abs=0.05)
        beyond = np.abs(np.arange(bands.n_bands) - j) >= 2
        assert (levels[beyond] < levels[j] - 24).all()


def test_a_tone_on_an_edge_is_shared_equally_by_its_neighbours() -> None:
    bands = Bands((50.0, 100.0, 200.0, 400.0))
    parts = split_bands(tone(200.0), RATE, bands)
    np.testing.assert_allclose(parts[1], 0.5 * tone(200.0), atol=1e-6)
    np.testing.assert_allclose(parts[2], 0.5 * tone(200.0), atol=1e-6)
    np.testing.assert_allclose(parts[0], 0.0, atol=1e-6)


def test_outer_bands_contain_all_frequencies_beyond_the_edges() -> None:
    bands = Bands.third_octaves(20, 500)
    for frequency_hz, home in ((0.0, 0), (4.0, 0), (1500.0, -1), (3999.0, -1)):
        x = tone(frequency_hz) + (1.0 if frequency_hz == 0.0 else 0.0)
        np.testing.assert_allclose(split_bands(x, RATE, bands)[home], x, atol=1e-6)


def test_bands_above_half_the_rate_are_silent() -> None:
    x = np.random.default_rng(5).uniform(-1, 1, 3000)
    parts = split_bands(x, 200, Bands((20.0, 50.0, 300.0, 500.0)))
    assert level_db(parts[2]) < -100


def test_band_split_has_no_delay_and_keeps_the_loop_seamless() -> None:
    """A circular shift of the loop shifts every band equally."""
    x = np.random.default_rng(6).uniform(-1, 1, 5000)
    bands = Bands.third_octaves()
    shifted = split_bands(np.roll(x, 1234), RATE, bands)
    np.testing.assert_allclose(shifted, np.roll(split_bands(x, RATE, bands), 1234, axis=1), atol=1e-6)


@pytest.mark.parametrize("n", [8000, 12_345])
def test_weighted_bands_equal_one_circular_filter(n: int) -> None:
    """Reference: the filter's impulse response, circularly convolved in the time domain."""
    rng = np.random.default_rng(n)
    bands = Bands.third_octaves()
    gains = 10 ** (rng.uniform(-20, 20, bands.n_bands) / 20)
    x = rng.standard_normal(n)
    mixed = gains @ split_bands(x, RATE, bands).astype(float)
    impulse = np.zeros(n)
    impulse[0] = 1.0
    response = gains @ split_bands(impulse, RATE, bands).astype(float)
    for i in (0, 1, n - 1, *rng.integers(0, n, 20)):
        at_once = response @ x[(i - np.arange(n)) % n]
        # Below -80 dB at every sample, also beside the wrap.
        assert abs(mixed[i] - at_once) < 1e-4 * np.sqrt(np.mean(mixed**2))


def test_weights_are_shares_and_the_filter_has_no_phase() -> None:
    f = np.geomspace(1.0, 4000.0, 999)
    weights = band_weights(f, Bands.third_octaves())
    np.testing.assert_allclose(weights.sum(axis=0), 1.0, rtol=1e-12)
    assert weights.min() >= 0.0
    assert (weights[0, f < 10] == 1.0).all()
    assert (weights[-1, f > 1000] == 1.0).all()
    assert band_weights(f, Bands.dominant()).shape == (1, 999)


def test_the_dominant_band_is_the_loop_itself() -> None:
    x = np.random.default_rng(7).uniform(-1, 1, 1000).astype(np.float32)
    parts = split_bands(x, RATE, Bands.dominant())
    np.testing.assert_array_equal(parts, x[None, :])
    assert not np.shares_memory(parts, x)


@pytest.mark.parametrize("bad", [np.zeros(0), np.zeros((2, 3)), np.array([0.0, np.nan])])
def test_band_split_refuses_samples_that_are_not_a_loop(bad: np.ndarray) -> None:
    with pytest.raises(AudioError, match="one channel of finite samples"):
        split_bands(bad, RATE, Bands.dominant())


def test_playing_side_of_audio_imports_no_design_time_module() -> None:
    code = (
        "import sys, scene2hap.audio.bands, scene2hap.audio.clip, scene2hap.audio.files, scene2hap.audio.haptic_loop;"
        "print([m for m in sys.modules if m.split('.')[0] in ('scipy', 'httpx') or 'audio.sources' in m])"
    )
    shown = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert shown.stdout.strip() == "[]"


def test_audio_modules_do_not_import_sound_sources() -> None:
    room = Path(audio.__file__).parent
    modules = [path for path in room.rglob("*.py") if "sources" not in path.relative_to(room).parts]
    assert len(modules) > 8
    for path in modules:
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.ImportFrom):
                assert "audio.sources" not in f"{node.module}.{node.names[0].name}", path
