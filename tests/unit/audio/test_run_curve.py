"""Curves of starts and stops: interpolation between points, and invalid curves."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from scene2hap.audio.run_curve import RunCurve
from scene2hap.errors import AudioError

CURVE = RunCurve(2.0, (0.0, 0.2, 1.0), (0.0, 0.5, 1.0), inferred_s=4.0)


def test_run_curve_interpolates_linearly() -> None:
    np.testing.assert_allclose(CURVE.amplitude_at([0.0, 0.25, 0.5, 0.75, 1.0]), [0.0, 0.1, 0.2, 0.6, 1.0])
    np.testing.assert_allclose(CURVE.speed_at([0.25, 1.0]), [0.25, 1.0])
    assert RunCurve(1.0, (0.0, 1.0)).speed_at([0.5]) is None


def test_run_curve_states_whether_the_pitch_is_constant() -> None:
    assert RunCurve(1.0, (0.0, 1.0), (1.0, 1.0)).keeps_pitch
    assert not CURVE.keeps_pitch
    assert not RunCurve(1.0, (0.0, 1.0)).keeps_pitch


def test_run_curve_keeps_the_inferred_value_that_it_replaces() -> None:
    measured = RunCurve(2.0, CURVE.amplitude, CURVE.speed)
    assert measured.instead_of(4.0, None) == CURVE
    assert measured.instead_of(7.0, CURVE) is CURVE  # the same recording: an edited time is not an inferred one
    other = RunCurve(3.0, (0.0, 1.0))
    assert other.instead_of(2.0, CURVE).inferred_s == 4.0
    assert other.instead_of(5.0, CURVE).inferred_s == 5.0


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"lasts_s": 0.0}, "lasts_s"),
        ({"lasts_s": 31.0}, "at most 30"),
        ({"lasts_s": float("nan")}, "lasts_s"),
        ({"amplitude": (0.0, 1.5)}, r"amplitude\[1\]"),
        ({"amplitude": (1.0,)}, "at least two"),
        ({"amplitude": ()}, "at least two"),
        ({"amplitude": "loud"}, "amplitude"),
        ({"speed": (0.0, 1.0, 1.0)}, "as many"),
        ({"speed": (0.0, -1.0)}, r"speed\[1\]"),
        ({"inferred_s": -1.0}, "inferred_s"),
        ({"amplitude": (0.0,) * 1001}, "amplitude"),
    ],
)
def test_run_curve_refuses_invalid_values(given: dict[str, Any], said: str) -> None:
    with pytest.raises(AudioError, match=said):
        RunCurve(**{"lasts_s": 1.0, "amplitude": (0.0, 1.0), **given})
