"""Response of a plate to an impact, against closed forms computed here."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from scene2hap.materials import Material
from scene2hap.propagation.impact import FINGER_KG, HIGHEST_MODE_HZ, LONGEST_S, RESTITUTION, SHORTEST_S, burst_of
from scene2hap.propagation.plate import Plate, RigidBody

OAK = Material("oak", 700.0, 11e9, 0.3, 0.03)
RUBBER = Material("rubber", 1100.0, 5e6, 0.49, 0.2)
TABLE = Plate(1.2, 0.8, 0.018, OAK)
CUP = RigidBody(0.3, (0.08, 0.08, 0.1), Material("porcelain", 2400.0, 70e9, 0.22, 0.002))


def test_modes_are_those_of_a_supported_plate_and_die_with_their_loss() -> None:
    burst = burst_of(TABLE, None, CUP, speed_m_s=0.3)
    d, per_area = 11e9 * 0.018**3 / (12 * (1 - 0.3**2)), 700.0 * 0.018
    expected = [
        math.pi / 2 * math.sqrt(d / per_area) * ((m / 1.2) ** 2 + (n / 0.8) ** 2)
        for m in (1, 3, 5)
        for n in (1, 3, 5)  # even modes have a node in the middle
    ]
    modes = burst.frequencies_hz[1:]
    assert len(modes) == 2  # 77 and 265 Hz; modes above 400 Hz are left out
    assert all(min(abs(f / x - 1) for x in expected) < 1e-9 for f in modes.tolist())
    np.testing.assert_allclose(burst.decays_s[1:], np.clip(1 / (math.pi * modes * 0.03), SHORTEST_S, LONGEST_S))
    assert modes.max() <= HIGHEST_MODE_HZ


def test_the_lowest_mode_moves_by_the_momentum_over_its_mass() -> None:
    burst = burst_of(TABLE, None, impulse_n_s=0.1)
    lowest = int(np.argmin(np.where(burst.frequencies_hz > 70, burst.frequencies_hz, np.inf)))
    f, table_kg = burst.frequencies_hz[lowest], 1.2 * 0.8 * 0.018 * 700.0
    # The half sine is much shorter than a period, so that nearly all of its impulse acts.
    assert burst.accelerations_m_s2[lowest] == pytest.approx(2 * math.pi * f * 0.1 * 4 / table_kg, rel=0.05)


PLASTIC = Material("plastic", 1050.0, 2.4e9, 0.35, 0.0)


@pytest.mark.parametrize("speed_m_s", [0.02, 0.1, 0.5, 2.0])
@pytest.mark.parametrize(("striker_kg", "struck_kg"), [(2.0, 1e6), (3.0, 4.0)])
def test_a_contact_lasts_as_long_as_two_spheres_that_bounce(
    speed_m_s: float, striker_kg: float, struck_kg: float
) -> None:
    """Their motion is integrated with Hertz's force, F = 4/3 E* sqrt(R) x^1.5."""
    striker, struck = RigidBody(striker_kg, material=PLASTIC), RigidBody(struck_kg, material=PLASTIC)
    burst = burst_of(struck, None, striker, speed_m_s=speed_m_s)
    modulus_pa, reduced_kg = 2.4e9 / (2 * (1 - 0.35**2)), 1 / (1 / striker_kg + 1 / struck_kg)
    spring = 4 / 3 * modulus_pa * math.sqrt(0.005)

    def motion(_: float, state: np.ndarray) -> list[float]:
        return [state[1], -spring / reduced_kg * max(state[0], 0.0) ** 1.5]

    def left(_: float, state: np.ndarray) -> float:
        return float(state[0])

    left.terminal, left.direction = True, -1  # type: ignore[attr-defined]
    solved = solve_ivp(motion, (0.0, 0.1), [1e-12, speed_m_s], events=left, rtol=1e-8, atol=1e-12, max_step=1e-4)
    (lasts_s,) = solved.t_events[0]
    expected_hz = min(max(1 / (2 * lasts_s), 30.0), 250.0)
    assert burst.frequencies_hz[0] == pytest.approx(expected_hz, rel=0.016)  # half a step, and 2.87 itself


def test_a_hard_slam_is_brighter_than_a_soft_one() -> None:
    rubber = RigidBody(0.5, material=RUBBER)
    soft, hard = (burst_of(TABLE, (0.3, 0.3), rubber, speed_m_s=v) for v in (0.2, 4.0))
    assert hard.frequencies_hz[0] / soft.frequencies_hz[0] == pytest.approx(20**0.2, rel=0.03)
    ratio = hard.accelerations_m_s2 / soft.accelerations_m_s2 / 20
    assert (ratio > 1.1).all()
    highest = int(np.argmax(hard.frequencies_hz))
    assert ratio[highest] == ratio.max()


@pytest.mark.parametrize("speed_m_s", [1e-6, 0.1, 1.0, 30.0])
@pytest.mark.parametrize(("striker_kg", "struck_kg"), [(0.1, 0.1), (0.3, 1e4), (5.0, 0.1)])
def test_a_free_body_gets_the_velocity_that_momentum_says(
    speed_m_s: float, striker_kg: float, struck_kg: float
) -> None:
    struck, striker = RigidBody(struck_kg, material=OAK), RigidBody(striker_kg, material=OAK)
    burst = burst_of(struck, None, striker, speed_m_s=speed_m_s)
    expected_m_s = (1 + RESTITUTION) * speed_m_s * striker_kg / (striker_kg + struck_kg)
    (acceleration,), (f,) = burst.accelerations_m_s2, burst.frequencies_hz
    assert acceleration / (2 * math.pi * f) == pytest.approx(expected_m_s, rel=1e-12)


def test_impact_with_an_impulse_is_that_with_its_speed() -> None:
    for striker in (CUP, RigidBody(0.5, material=RUBBER)):
        by_speed = burst_of(TABLE, (0.3, 0.3), striker, speed_m_s=0.7)
        per_kg = 1 / striker.moving_mass_kg + 1 / TABLE.moving_mass_kg
        by_impulse = burst_of(TABLE, (0.3, 0.3), striker, impulse_n_s=(1 + RESTITUTION) * 0.7 / per_kg)
        np.testing.assert_allclose(by_impulse.frequencies_hz, by_speed.frequencies_hz)
        np.testing.assert_allclose(by_impulse.accelerations_m_s2, by_speed.accelerations_m_s2)


@pytest.mark.parametrize("factor", [0.1, 3.0])
def test_a_finger_is_as_soft_at_any_speed(factor: float) -> None:
    once, more = (burst_of(TABLE, (0.3, 0.3), speed_m_s=v, is_finger=True) for v in (0.3, 0.3 * factor))
    np.testing.assert_allclose(more.accelerations_m_s2, factor * once.accelerations_m_s2)
    np.testing.assert_array_equal(more.frequencies_hz, once.frequencies_hz)


def test_light_stiff_plates_ring_higher_and_stronger_than_heavy_ones() -> None:
    steel = Plate(1.2, 0.8, 0.002, Material("steel", 7850.0, 2e11, 0.3, 0.01))
    floor = Plate(4.0, 6.0, 0.15, Material("concrete", 2400.0, 30e9, 0.2, 0.02))
    at = (0.3, 0.3)
    totals = [burst_of(plate, at, CUP, speed_m_s=0.3).accelerations_m_s2.sum() for plate in (steel, TABLE, floor)]
    assert totals[0] > totals[1] > 20 * totals[2]


def test_soft_objects_excite_low_frequencies() -> None:
    ball = RigidBody(0.3, (0.08, 0.08, 0.08), RUBBER)
    hard, soft = (burst_of(TABLE, (0.3, 0.3), striker, speed_m_s=0.5) for striker in (CUP, ball))
    assert soft.frequencies_hz[0] < hard.frequencies_hz[0]
    finger = burst_of(TABLE, (0.3, 0.3), speed_m_s=0.5, is_finger=True)
    assert finger.frequencies_hz[0] == pytest.approx(
        math.sqrt(2e4 * (1 / FINGER_KG + 1 / TABLE.mass_kg)) / (2 * math.pi)
    )
    high = [(one.accelerations_m_s2 * (one.frequencies_hz > 200))[1:].sum() for one in (hard, soft, finger)]
    low = [(one.accelerations_m_s2 * (one.frequencies_hz < 100))[1:].sum() for one in (hard, soft, finger)]
    assert high[0] / low[0] > high[2] / low[2]


@pytest.mark.parametrize("struck", [None, CUP, Plate(0.2, 0.2, 0.15, OAK)])
def test_rigid_objects_have_only_the_contact_response(struck: RigidBody | Plate | None) -> None:
    burst = burst_of(struck, None, None, speed_m_s=0.5)
    assert len(burst.frequencies_hz) == 1
    assert 30.0 <= burst.frequencies_hz[0] <= 250.0
    assert burst.accelerations_m_s2[0] > 0


def test_a_large_floor_takes_no_longer_than_a_table() -> None:
    hall = Plate(60.0, 40.0, 0.02, OAK)
    burst = burst_of(hall, (30.1, 20.2), CUP, speed_m_s=1.0)
    assert np.isfinite(burst.accelerations_m_s2).all()
    assert (burst.frequencies_hz > 0).all()
