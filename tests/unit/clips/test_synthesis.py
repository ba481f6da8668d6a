"""Synthesis of signals from clips, against the reference renderer's output and against its rules."""

from __future__ import annotations

import numpy as np
import pytest
import soundfile

from others import SHARED, needed
from scene2hap.clips.haptic_clip import Curve, HapticClip, Transient
from scene2hap.clips.haptic_format import read_haptic
from scene2hap.clips.synthesis import synthesize
from scene2hap.errors import ClipError

RENDERED = SHARED / "formats" / "haptic" / "rendered"


@pytest.mark.parametrize("name", ["16_points", "valid_required_v1", "valid_v1", "validation_v1_optionals"])
def test_signals_equal_those_of_the_reference_renderer(name: str) -> None:
    expected, rate = soundfile.read(needed(RENDERED / f"{name}.wav"))
    found = synthesize(read_haptic(RENDERED.parent / f"{name}.haptic"), rate)
    assert len(found) == len(expected)
    # The reference accumulates phases in 32 bits, which drift by a thousandth of a cycle over 15 s.
    np.testing.assert_allclose(found, expected, atol=0.02)
    assert np.sqrt(np.mean((found - expected) ** 2)) < 0.02 * np.sqrt(np.mean(expected**2))


def flat(value: float, end_s: float = 1.0) -> Curve:
    return Curve(np.array([0.0, end_s]), np.array([value, value]))


def test_a_steady_clip_is_a_sine_wave() -> None:
    t = np.arange(8000) / 8000
    found = synthesize(HapticClip(flat(0.5), flat(0.2), range_hz=(50.0, 150.0)))
    np.testing.assert_allclose(found, 0.5 * np.sin(2 * np.pi * 70.0 * t), atol=1e-9)
    middle = synthesize(HapticClip(flat(0.5), None, range_hz=(50.0, 150.0)))
    np.testing.assert_allclose(middle, 0.5 * np.sin(2 * np.pi * 100.0 * t), atol=1e-9)


def test_the_frequency_before_its_curve_is_the_middle() -> None:
    late = Curve(np.array([0.5, 1.0]), np.array([0.2, 0.2]))
    clip = HapticClip(flat(0.5), late, range_hz=(50.0, 150.0))
    np.testing.assert_allclose(clip.frequency_hz([0.0, 0.4, 0.5, 0.9]), [100.0, 100.0, 70.0, 70.0])
    t = np.arange(3999) / 8000
    np.testing.assert_allclose(synthesize(clip)[:3999], 0.5 * np.sin(2 * np.pi * 100.0 * t), atol=1e-9)


@pytest.mark.parametrize(("pitch", "duration_s", "hertz"), [(0.0, 0.0364, 55.0), (1.0, 0.0121, 165.0)])
def test_a_transient_is_a_pulse_that_halves_the_rest(pitch: float, duration_s: float, hertz: float) -> None:
    found = synthesize(HapticClip(flat(0.4), None, (Transient(0.5, 0.9, pitch),)))
    without = synthesize(HapticClip(flat(0.4), None))
    n = int(duration_s * 8000)
    pulse = found - without
    pulse[4000 : 4000 + n] += 0.5 * without[4000 : 4000 + n]
    inside = np.arange(n) / 8000
    wave = np.sin(2 * np.pi * hertz * inside)
    expected = 0.9 * (wave if pitch == 0.0 else np.where(inside * hertz % 1.0 < 0.5, 1.0, -1.0))
    np.testing.assert_allclose(pulse[4000 : 4000 + n], expected, atol=1e-9)
    assert not pulse[:4000].any()
    np.testing.assert_allclose(pulse[4000 + n :], 0.0, atol=1e-12)


def test_each_transient_plays_until_the_next() -> None:
    first, second = Transient(0.2, 0.9, 0.0), Transient(0.21, 0.5, 1.0)  # alone the first lasts 36 ms
    both, *alone = (synthesize(HapticClip(flat(0.4), None, some)) for some in ((first, second), (first,), (second,)))
    np.testing.assert_array_equal(both[:1680], alone[0][:1680])
    np.testing.assert_array_equal(both[1680:], alone[1][1680:])


def test_curves_jump_hold_and_follow_roots() -> None:
    jump = Curve(np.array([0.1, 0.5, 0.5, 1.0]), np.array([0.2, 0.4, 0.8, 0.8]))
    np.testing.assert_allclose(jump.at([0.0, 0.1, 0.3, 0.5, 0.7, 9.0]), [0.2, 0.2, 0.3, 0.8, 0.8, 0.8])
    root = Curve(np.array([0.0, 1.0]), np.array([0.0, 1.0]), power=2.0)
    np.testing.assert_allclose(root.at([0.5]), [0.25])


def test_wrong_curves_are_refused() -> None:
    with pytest.raises(ClipError, match=r"values\[1\] of a curve is 2; it must be 0 to 1"):
        flat_and = np.array([0.0, 2.0])
        Curve(np.array([0.0, 1.0]), flat_and)
    with pytest.raises(ClipError, match=r"times_s\[1\] of a curve is 0.5; it must be no earlier"):
        Curve(np.array([1.0, 0.5]), np.array([0.0, 0.0]))
    with pytest.raises(ClipError, match="give one value for each time"):
        Curve(np.array([]), np.array([]))
    with pytest.raises(ClipError, match="values of a curve is not a table of numbers: it has True"):
        Curve([0.0, 1.0], [0.5, True])
    with pytest.raises(ClipError, match="a clip must be longer than 0 s"):
        HapticClip(Curve(np.array([0.0]), np.array([1.0])))
    with pytest.raises(ClipError, match="in order of time"):
        HapticClip(flat(1.0), None, (Transient(0.5, 1.0, 0.0), Transient(0.2, 1.0, 0.0)))
