"""Rhythms that distinguish machines of similar pitch, and an engine with a moving throttle."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

from scene2hap.audio.analysis import dominant_frequency_hz, rhythm_hz
from scene2hap.audio.clip import AudioClip
from scene2hap.audio.scene_loops import SourceClip, felt_loop, plan_scene
from scene2hap.audio.sources.synth import Synthesizer
from scene2hap.audio.tactile import CONVERTERS
from scene2hap.haptics import ActuatorProfile, VibrationDescription


def made(kind: str, verb: str, seed: int, intensity: float = 0.5) -> AudioClip:
    words = f"{kind} {verb}"
    return Synthesizer().find(VibrationDescription(kind, "on", words, words, intensity, (0.3, 0.3, 0.3), seed=seed))[0]


@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize(
    ("kind", "verb", "rate_hz"),
    [
        ("kettle", "boiling", 4.3),
        ("hair dryer", "blowing", 10.7),
        ("printer", "printing", 2.7),
        ("electric toothbrush", "brushing", 4.5),
        ("microwave", "humming", 1.6),
        ("computer", "humming", 1.45),
    ],
)
def test_tactile_loop_keeps_the_rhythm_of_its_machine(kind: str, verb: str, rate_hz: float, seed: int) -> None:
    """In an earlier version these loops had no rhythm, or the converter's band did not keep it."""
    clip, converter = made(kind, verb, seed, 0.2), CONVERTERS.build("auto")
    (plan,) = plan_scene([SourceClip(clip, 0.2)], converter, ActuatorProfile())
    loop = felt_loop(clip, converter, plan).tactile
    assert rhythm_hz(loop.samples, loop.sample_rate_hz, 0.2) == pytest.approx(rate_hz, rel=0.15)


def levels_db(clip: AudioClip) -> np.ndarray:
    stretches = clip.samples[: len(clip.samples) // 4800 * 4800].reshape(-1, 4800).astype(float)
    return 10 * np.log10((stretches**2).mean(axis=1))


def pitches_hz(clip: AudioClip) -> np.ndarray:
    """The strongest frequency within 80 to 220 Hz in each quarter of a second."""
    found = []
    for part in clip.samples[: len(clip.samples) // 12_000 * 12_000].reshape(-1, 12_000).astype(float):
        power = np.abs(np.fft.rfft(part * np.hanning(12_000), 48_000)) ** 2
        found.append(80 + np.argmax(power[80:220]))
    return np.array(found)


@pytest.mark.parametrize("seed", range(2))
def test_chainsaw_changes_speed_and_loudness_together(seed: int) -> None:
    """The saw is louder while it is faster. Its speed varies a little in sawing and much more in revving."""
    for verb, at_least in (("sawing", 1.04), ("revving", 1.4)):
        clip = made("chainsaw", verb, seed)
        assert np.isfinite(clip.samples).all()
        low, high = np.percentile(pitches_hz(clip), (10, 90))
        assert high / low > at_least, verb
    pitch, level = pitches_hz(clip), levels_db(clip)[: 2 * (len(levels_db(clip)) // 2)]
    assert np.subtract(*np.percentile(level, (95, 5))) > 6.0
    loud = np.interp(np.arange(len(pitch)) * 0.25 + 0.125, (np.arange(len(level)) + 0.5) * 0.1, level)
    assert np.corrcoef(pitch, loud)[0, 1] > 0.5


def test_a_telephone_rings_a_bell_for_one_second_in_three() -> None:
    """In an earlier version it had the motor of a smartphone, at 182 Hz without a rate."""
    clip = made("telephone", "ringing", 0)
    loud = levels_db(clip) > levels_db(clip).max() - 20.0
    assert loud.mean() == pytest.approx(0.4, abs=0.05)  # the rings at 0 and 3 s, of 5 s
    ring = clip.samples[: int(0.9 * clip.sample_rate_hz)].astype(float)
    assert rhythm_hz(ring, clip.sample_rate_hz) == pytest.approx(25.0, abs=1.2)
    assert not np.array_equal(clip.samples, made("smartphone", "ringing", 0).samples)


def test_machines_of_a_rack_are_told_apart_from_a_computer() -> None:
    strongest = {
        kind: dominant_frequency_hz(made(kind, "humming", 0).samples, 48_000)
        for kind in ("computer", "server", "set-top box", "VCR")
    }
    hz = sorted(strongest.values())
    assert min(high / low for low, high in pairwise(hz)) > 1.1, strongest
