"""Synthetic voices compared with recordings of the same kind of machine: the numbers of docs/figures/audio.md."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from scipy.ndimage import median_filter
from scipy.signal import resample_poly

from scene2hap.audio.clip import AudioClip
from scene2hap.audio.sources.synth import Synthesizer
from scene2hap.haptics import VibrationDescription

RATE_HZ = 4000


def measured(clip: AudioClip) -> tuple[float, float, float]:
    """Measure strongest frequency [Hz], centroid [Hz] and share of power in lines, from 20 to 1000 Hz.

    A line is a bin 10 dB above the median of the 20 Hz around it.
    """
    y = resample_poly(clip.samples.astype(float), RATE_HZ, clip.sample_rate_hz)
    f = np.fft.rfftfreq(len(y), 1 / RATE_HZ)
    power = np.abs(np.fft.rfft(y * np.hanning(len(y)))) ** 2
    inside = (f >= 20) & (f <= 1000)
    f, power = f[inside], power[inside]
    around = median_filter(power, round(20 / (f[1] - f[0])) | 1)
    return (
        float(f[np.argmax(power)]),
        float((f * power).sum() / power.sum()),
        float(power[power > 10 * around].sum() / power.sum()),
    )


def voice(thing: str, verb: str, intensity: float, size_m: float, mains_hz: float) -> AudioClip:
    words = f"{thing} {verb}"
    (clip,) = Synthesizer(mains_hz=mains_hz).find(
        VibrationDescription(thing, "on", words, words, intensity, (size_m, size_m, size_m))
    )
    return clip


@pytest.mark.parametrize(
    ("name", "voiced", "strongest_rel", "centroid_rel", "lines_abs"),
    [
        ("fridge_hum_kitchen.wav", ("refrigerator", "humming", 0.1, 0.7, 60.0), 0.02, 0.15, 0.1),
        ("oven_hum.wav", ("oven", "humming", 0.12, 0.6, 50.0), 0.005, 0.05, 0.1),
        # The voices of fan and saw are steadier and darker on purpose; only their order of brightness is the same.
        ("computer_fan_hum.wav", ("computer fan", "humming", 0.1, 0.12, 50.0), 4.0, 0.5, 0.4),
        ("chainsaw_1-116765-A.ogg", ("chainsaw", "sawing", 0.75, 0.8, 50.0), 0.05, 0.55, 0.6),
    ],
    ids=lambda value: value if isinstance(value, str) else "",
)
def test_voice_has_the_pitch_and_spectrum_of_its_recording(
    sound: Callable[[str], AudioClip],
    name: str,
    voiced: tuple[str, str, float, float, float],
    strongest_rel: float,
    centroid_rel: float,
    lines_abs: float,
) -> None:
    real, made = measured(sound(name)), measured(voice(*voiced))
    assert made[0] == pytest.approx(real[0], rel=strongest_rel)
    assert made[1] == pytest.approx(real[1], rel=centroid_rel)
    assert made[2] == pytest.approx(real[2], abs=lines_abs)


def test_voices_have_the_same_brightness_order_as_recordings(sound: Callable[[str], AudioClip]) -> None:
    """From fridge to saw the centroid rises, and the fan is noisier than the hums."""
    things = {
        "fridge_hum_kitchen.wav": ("refrigerator", "humming", 0.1, 0.7, 60.0),
        "oven_hum.wav": ("oven", "humming", 0.12, 0.6, 50.0),
        "computer_fan_hum.wav": ("computer fan", "humming", 0.1, 0.12, 50.0),
        "chainsaw_1-116765-A.ogg": ("chainsaw", "sawing", 0.75, 0.8, 50.0),
    }
    for sounds in ([sound(name) for name in things], [voice(*thing) for thing in things.values()]):
        numbers = [measured(sound) for sound in sounds]
        centroids = [centroid for _, centroid, _ in numbers]
        assert centroids == sorted(centroids)
        assert numbers[2][2] < min(numbers[0][2], numbers[1][2])
