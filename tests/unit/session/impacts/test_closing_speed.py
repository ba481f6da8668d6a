"""The closing speed of a fall, against closed forms."""

from __future__ import annotations

import math

import numpy as np
import pytest

from scene2hap.session.impacts.closing_speed import fall_speed


def travelled(speed: float, acceleration: float, times: list[float]) -> list[float]:
    return [speed * t + acceleration * t * t / 2 for t in times]


@pytest.mark.parametrize("times", [[0.0, 0.02], [0.0, 0.011, 0.03], [0.0, 0.01, 0.02, 0.05, 0.06]])
@pytest.mark.parametrize("pull", [9.81, 0.0, -9.81])
def test_a_fall_has_the_speed_of_its_energy_where_it_meets(times: list[float], pull: float) -> None:
    came = travelled(2.0, pull, times)
    meets_m = came[-1] + 0.01
    speed, likely = fall_speed(times, came, meets_m, times[-1] + 0.02, pull)
    assert speed == pytest.approx(math.sqrt(2.0**2 + 2 * pull * meets_m))
    assert likely == pytest.approx(1.0)


def test_it_meets_something_until_a_time() -> None:
    """Where it is told to meet, it would be after 0.1 s."""
    times = [0.0, 0.01, 0.02]
    speed, _ = fall_speed(times, travelled(1.0, 9.81, times), 0.2, 0.03, 9.81)
    assert speed == pytest.approx(1.0 + 9.81 * 0.03)


@pytest.mark.parametrize(("acceleration", "least", "most"), [(9.81, 0.9, 1.0), (0.0, 0.0, 0.1), (-5.0, 0.0, 0.05)])
def test_a_motion_that_gravity_does_not_explain_is_no_fall(acceleration: float, least: float, most: float) -> None:
    times = np.arange(8) / 90
    _, likely = fall_speed(times.tolist(), travelled(1.0, acceleration, times.tolist()), 0.2, 0.1, 9.81)
    assert least <= likely <= most


def test_noise_leaves_it_open_whether_it_falls() -> None:
    """At 0.5 mm, three positions at 90 Hz give an acceleration to 10 m/s2."""
    times = [0.0, 1 / 90, 2 / 90]
    _, likely = fall_speed(times, travelled(1.0, 0.0, times), 0.1, 0.1, 9.81)
    assert 0.7 < likely < 0.9


def test_positions_at_two_times_of_a_coarse_clock_suffice() -> None:
    speed, likely = fall_speed([0.0, 0.0, 0.01], [0.0, 0.0, 0.01], 0.01, 0.02, 0.0)
    assert (speed, likely) == (pytest.approx(1.0), 1.0)
