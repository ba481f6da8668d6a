"""The bending lattice, against tables, the Ritz plate, closed forms and a direct solve."""

import math
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from numpy.typing import NDArray

from scene2hap import Material, ModalPlate, Plate, materials, plate_modes
from scene2hap.errors import ConfigError, ModelDomainError
from scene2hap.propagation.lattice.bending_lattice import bending_lattice
from scene2hap.propagation.mass_spring_damper import MassSpringDamper

MATERIAL = Material("test", 2500.0, 70e9, 0.3, loss_factor=0.02)

# omega a^2 sqrt(m / D) of a square, nu = 0.3: closed form and an independent 18 x 18 Ritz, six digits.
TABLE = {
    "SSSS": [19.7392, 49.3480, 49.3480, 78.9568, 98.6960, 98.6960],
    "CCCC": [35.9852, 73.3939, 73.3939, 108.2165, 131.5808, 132.2048],
    "FFFF": [13.4682, 19.5961, 24.2702, 34.8009, 34.8009, 61.0932],
    "CFFF": [3.4710, 8.5064, 21.284, 27.199, 30.955, 54.185],
    "SSFF": [9.6314, 16.1348, 36.7256, 38.9450, 46.7381, 70.7401],
    "SSSC": [23.6463, 51.6743, 58.6464, 86.1345, 100.2698, 113.228],
}


def elastic(plate: Plate, resolution: int, n: int = 6) -> NDArray[np.float64]:
    rigid = {"FFFF": 3, "FFFS": 1}.get("".join(sorted(plate.edges)), 0)
    return MassSpringDamper(resolution).natural_frequencies_hz(plate, n + rigid)[rigid:]


def check_convergence(plate: Plate, exact_hz: NDArray[np.float64], least_order: float) -> None:
    """Check the order of convergence; errors below the precision of the exact values are left out."""
    errors = [np.abs(elastic(plate, resolution) / exact_hz - 1) for resolution in (5, 10, 20)]
    assert errors[1].max() < 0.004
    for coarse, fine in pairwise(errors):
        told = coarse > 2e-4
        assert np.log2(coarse[told] / np.maximum(fine[told], 1e-6)).min(initial=9.0) >= least_order


@pytest.mark.parametrize("boundary", TABLE)
def test_squares_converge_to_the_table(boundary: str) -> None:
    plate = Plate(1.0, 1.0, 0.01, MATERIAL, boundary)
    m, D = 2500.0 * 0.01, 70e9 * 0.01**3 / (12 * (1 - 0.3**2))
    # At a corner between a clamped and a free edge the curvature is unbounded, and the order is lower.
    least_order = 1.5 if boundary in ("CFFF",) else 3.0
    check_convergence(plate, np.array(TABLE[boundary]) * math.sqrt(D / m) / (2 * math.pi), least_order)


@pytest.mark.parametrize(("boundary", "nu"), [("SFSF", 0.3), ("CCFF", 0.3), ("CFSF", 0.45)])
def test_rectangles_converge_to_the_ritz_plate(boundary: str, nu: float) -> None:
    """Free edges that are adjacent, opposite, or beside clamps; the Ritz basis is far larger than the modes need."""
    plate = Plate(1.0, 0.8, 0.01, replace(MATERIAL, poisson_ratio=nu), boundary)
    exact = plate_modes(plate, max_frequency_hz=3000.0).frequencies_hz
    check_convergence(plate, exact[exact > 0][:6], 1.3 if "C" in boundary else 3.0)


def test_auxetic_corners_converge_more_slowly() -> None:
    """At a clamped-free corner, nu = -0.5 makes the moment singular: the order is about 1.3, errors within 0.4 %."""
    plate = Plate(1.0, 0.8, 0.01, replace(MATERIAL, poisson_ratio=-0.5), "CFFF")
    check_convergence(plate, plate_modes(plate, max_frequency_hz=4000.0).frequencies_hz[:6], 1.2)


@pytest.mark.parametrize(
    ("boundary", "beta"), [("FFFF", [4.7300407, 7.8532046, 10.9956078]), ("CFFF", [1.8751041, 4.6940911, 7.8547574])]
)
def test_a_strip_of_1000_to_1_is_a_beam(boundary: str, beta: list[float]) -> None:
    """The stiffest springs of such a strip are 1e16 times as stiff as its first mode."""
    strip = Plate(1.0, 0.001, 0.001, replace(MATERIAL, poisson_ratio=0.0), boundary)
    expected = np.array(beta) ** 2 / strip.wavenumber_per_root_omega**2 / (2 * math.pi)
    np.testing.assert_allclose(elastic(strip, 8, 3), expected, rtol=3e-3)


@pytest.mark.parametrize("boundary", ["FFFF", "CFSF"])
def test_modes_and_series_are_the_direct_solution(boundary: str) -> None:
    from scipy.sparse.linalg import splu

    plate = Plate(0.9, 0.6, 0.006, MATERIAL, boundary)
    drive, points = np.array([[0.31, 0.22]]), np.array([[0.31, 0.22], [0.33, 0.25], [0.8, 0.1], [0.45, 0.59]])
    f = np.array([3.0, 47.0, 160.0, 420.0, 600.0])
    lattice = bending_lattice(plate, 24)
    D, m = plate.bending_stiffness_nm * (1 + 0.02j), 2500.0 * 0.006
    push, look = lattice.interpolation(drive).toarray()[0], lattice.interpolation(points)
    expected = np.stack(
        [
            look @ splu((D * lattice.stiffness - m * w**2 * lattice.masses).tocsc()).solve(push + 0j)
            for w in 2 * np.pi * f
        ],
        axis=1,
    )
    found = MassSpringDamper(24).plate_receptance(plate, drive[0], points, f)
    np.testing.assert_allclose(found, expected, rtol=0.02, atol=3e-3 * np.abs(expected[0]).max())
    np.testing.assert_allclose(found[:, :3], expected[:, :3], rtol=2e-4)


def test_model_converges_to_the_modal_plate() -> None:
    """Error in dB below the fifth mode, where a small frequency error does not yet cross a resonance."""
    plate = Plate(1.2, 0.7, 0.025, replace(materials.lookup("oak"), loss_factor=0.05))
    f = np.geomspace(10.0, 300.0, 60)
    points = np.random.default_rng(5).uniform(0.05, 0.95, (10, 2)) * [1.2, 0.7]
    expected = ModalPlate().plate_receptance(plate, points[0], points, f)
    errors = [
        np.quantile(
            np.abs(20 * np.log10(np.abs(MassSpringDamper(n).plate_receptance(plate, points[0], points, f) / expected))),
            0.95,
        )
        for n in (5, 10, 20)
    ]
    assert errors[0] < 0.5
    assert errors[1] < errors[0] / 3
    assert errors[2] < 0.05


def test_static_deflection_of_a_clamped_square() -> None:
    """Timoshenko and Woinowsky-Krieger, table 37: centre force, w = 0.00560 F a^2 / D; 0.005612 by longer series."""
    pane = Plate(0.5, 0.5, 0.004, MATERIAL, "CCCC")
    errors = []
    for resolution in (16, 32, 64):
        found = MassSpringDamper(resolution).plate_receptance(pane, [0.25, 0.25], [0.25, 0.25], [0.0])[0, 0]
        # The complex stiffness makes the deflection smaller by |1 + 0.02 j|.
        errors.append(abs(found) * abs(1 + 0.02j) * pane.bending_stiffness_nm / 0.25 / 0.005612 - 1)
    assert errors[2] < 0.006
    assert errors[0] / errors[1] > 3  # the load stands on one node: h^2 log h
    assert errors[1] / errors[2] > 3


def test_a_slow_force_moves_a_free_plate_as_a_body() -> None:
    plate = Plate(1.2, 0.7, 0.025, materials.lookup("oak"))
    mass = plate.material.density_kg_m3 * 1.2 * 0.7 * 0.025
    found = MassSpringDamper(12).plate_receptance(plate, [0.6, 0.35], [0.6, 0.35], [0.1])[0, 0]
    assert -found * (2 * np.pi * 0.1) ** 2 == pytest.approx(1 / mass, rel=1e-4)
    # A force at a corner gives 7/M there and -5/M at the opposite corner; lumped inertia is 1 + 2/n^2 of the true one.
    far = MassSpringDamper(32).plate_transfer(plate, [0.0, 0.0], [[1.2, 0.7]], [0.0, 1e-3])
    np.testing.assert_allclose(far, -5 / 7, rtol=3e-3)


def test_lattices_that_are_too_large_are_refused() -> None:
    plate = Plate(1.2, 0.7, 0.025, materials.lookup("oak"))
    with pytest.raises(ModelDomainError, match="resolution .*; at most 256 is solved. .* InfinitePlate"):
        MassSpringDamper(8).plate_receptance(replace(plate, thickness_m=1e-6), [0.1, 0.1], [0.2, 0.2], [1000.0])
    with pytest.raises(ModelDomainError, match="100000 are allowed"):
        MassSpringDamper(200).plate_receptance(replace(plate, length_m=3.0), [0.1, 0.1], [0.2, 0.2], [100.0])
    for wrong in ({"resolution": 3}, {"resolution": 8.5}, {"resolution": 10**9}, {"loss_floor": -1.0}):
        with pytest.raises(ConfigError, match=next(iter(wrong))):
            MassSpringDamper(**wrong)
    with pytest.raises(ModelDomainError, match="n_modes is 2.7; it must be a whole number"):
        MassSpringDamper().natural_frequencies_hz(plate, 2.7)


def test_resolution_is_refined_for_short_waves() -> None:
    """Short waves get the cells that they need, even above the requested resolution."""
    plate = Plate(0.8, 0.5, 0.002, materials.lookup("steel"))
    ask = (plate, [0.1, 0.1], [[0.5, 0.3], [0.7, 0.1]], np.geomspace(100.0, 900.0, 20))
    exact = ModalPlate().plate_receptance(*ask)
    found = MassSpringDamper(4).plate_receptance(*ask)
    assert np.quantile(np.abs(20 * np.log10(np.abs(found / exact))), 0.95) < 3.0


def viscous_receptance(plate: Plate, drive_m: list[float], point_m: list[float], f: float) -> complex:
    """Sum over the modes of the Ritz plate, with viscous damping of ratio eta / 2."""
    modes = plate_modes(plate, max_frequency_hz=2500.0)
    phi = modes.shapes([drive_m, point_m])
    w, w_n = 2 * np.pi * f, 2 * np.pi * modes.frequencies_hz
    return complex(np.sum(phi[0] * phi[1] / (w_n**2 - w**2 + 1j * plate.material.loss_factor * w_n * w)))


@pytest.mark.parametrize("stepper", ["exact", "newmark"])
def test_motion_settles_to_the_viscous_harmonic_answer(stepper: str) -> None:
    plate = Plate(0.8, 0.5, 0.006, replace(MATERIAL, loss_factor=0.1), "CFFF")
    drive, point, f, rate = [0.6, 0.17], [0.7, 0.4], 60.0, 6000.0
    t = np.arange(int(1.8 * rate)) / rate
    motion = MassSpringDamper(32).plate_motion(
        plate, drive, point, np.cos(2 * np.pi * f * t), rate, max_frequency_hz=300.0, stepper=stepper
    )[0]
    last = slice(-int(rate / f * 6), None)
    found = 2 * np.mean(motion[last] * np.exp(-2j * np.pi * f * t[last]))
    assert abs(found / viscous_receptance(plate, drive, point, f) - 1) < 0.04


def test_motion_without_loss_never_settles_nor_grows() -> None:
    plate = Plate(0.8, 0.5, 0.006, replace(MATERIAL, loss_factor=0.0), "CFFF")
    force = np.zeros(8000)
    force[1:9] = 1.0
    motion = MassSpringDamper(10, loss_floor=0.0).plate_motion(
        plate, [0.7, 0.2], [0.8, 0.5], force, 4000.0, max_frequency_hz=300.0
    )[0]
    assert np.ptp(motion[4000:]) == pytest.approx(np.ptp(motion[10:4000]), rel=0.1)


def test_a_later_force_gives_a_later_motion() -> None:
    plate, early, late = Plate(0.8, 0.5, 0.006, MATERIAL, "CFFF"), np.zeros(40), np.zeros(40)
    early[1] = late[2] = 1.0
    first, second = (
        MassSpringDamper(10).plate_motion(plate, [0.7, 0.2], [0.8, 0.5], force, 4000.0, max_frequency_hz=300.0)[0]
        for force in (early, late)
    )
    np.testing.assert_allclose(second[1:], first[:-1], rtol=1e-9, atol=1e-12 * np.abs(first).max())


def test_refused_motions() -> None:
    plate = Plate(0.8, 0.5, 0.006, MATERIAL)
    ask = (plate, [0.1, 0.1], [0.2, 0.2])
    with pytest.raises(ModelDomainError, match=r"force_n has shape \(2, 2\)"):
        MassSpringDamper(16).plate_motion(*ask, np.zeros((2, 2)), 8000.0)
    with pytest.raises(ModelDomainError, match=r"force_n\[1\] is nan N; it must be finite"):
        MassSpringDamper(16).plate_motion(*ask, [0.0, np.nan], 8000.0)
    with pytest.raises(ModelDomainError, match="sample_rate_hz is -1 Hz"):
        MassSpringDamper(16).plate_motion(*ask, np.zeros(2), -1.0)
    with pytest.raises(ConfigError, match="stepper is 'euler'"):
        MassSpringDamper(16).plate_motion(*ask, np.zeros(2), 8000.0, max_frequency_hz=100.0, stepper="euler")
