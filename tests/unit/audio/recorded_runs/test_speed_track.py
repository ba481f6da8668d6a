"""Speed track: the speed of a machine over time, from the lines of its spectrum."""

from __future__ import annotations

import numpy as np
import pytest

from scene2hap.audio.recorded_runs.speed_track import track_speed
from starting_machines import RATE_HZ, machine


@pytest.mark.parametrize("rise", ["motor", "linear", "half a cosine", "coast"])
@pytest.mark.parametrize("frequency_hz", [50.0, 120.0, 400.0])
def test_speed_track_follows_a_machine_within_five_per_cent(rise: str, frequency_hz: float) -> None:
    take = machine(start_s=3.0, rise=rise, frequency_hz=frequency_hz)
    track = track_speed(take.samples, RATE_HZ, (1.0, 4.0), (4.0, 9.0))
    assert track is not None
    assert not track.is_constant
    true = np.interp(track.at_s, np.arange(len(take.speed)) / RATE_HZ, take.speed)
    is_known = true > 0.4
    assert np.count_nonzero(is_known & (track.at_s < 4.0)) > 40
    assert np.abs(track.speed[is_known] / true[is_known] - 1).max() < 0.05


def test_speed_track_marks_a_constant_pitch() -> None:
    take = machine(start_s=2.0, spins=False)
    track = track_speed(take.samples, RATE_HZ, (1.0, 3.0), (3.0, 8.0))
    assert track is not None
    assert track.is_constant


@pytest.mark.parametrize("seed", range(5))
def test_speed_track_of_noise_is_none(seed: int) -> None:
    x = np.random.default_rng(seed).standard_normal(8 * RATE_HZ)
    assert track_speed(x, RATE_HZ, (1.0, 3.0), (3.0, 8.0)) is None


@pytest.mark.parametrize("seed", range(5))
def test_tones_that_come_from_noise_at_once_have_no_speed(seed: int) -> None:
    take = machine(start_s=0.05, seed=seed)
    assert track_speed(take.samples, RATE_HZ, (0.0, 1.0), (1.1, 6.0)) is None
