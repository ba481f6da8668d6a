"""Time steppers, against the matrix exponential, their theory, and conservation of energy."""

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from numpy.typing import NDArray

from scene2hap import Material, Plate
from scene2hap.errors import ModelDomainError
from scene2hap.propagation.lattice.bending_lattice import bending_lattice
from scene2hap.propagation.lattice.stepping import (
    ExactStepper,
    NewmarkStepper,
    State,
    Stepper,
)

OMEGA = 2 * np.pi * np.array([0.01, 1.0, 8.0, 50.0, 250.0, 1000.0, 1e5])


def modal_energy(state: State, omega: NDArray[np.float64]) -> NDArray[np.float64]:
    return (state.velocity**2 + (omega * state.displacement) ** 2) / 2


def plucked(omega: NDArray[np.float64]) -> State:
    return State(1 / omega, 0.3 * np.ones_like(omega))


@pytest.mark.parametrize("zeta", [0.0, 0.005, 0.3, 0.999999, 1.0])
@pytest.mark.parametrize("turn", [1e-9, 1e-3, 0.3, 0.999, 1.001, 2.0, 10.0, 300.0])
def test_one_step_is_the_exponential(turn: float, zeta: float) -> None:
    """Reference: the exponential of one 4 x 4 matrix of the state, the force and its slope."""
    from scipy.linalg import expm

    omega = 2 * np.pi * 50.0
    dt = turn / omega
    A = np.zeros((4, 4))
    A[0, 1], A[1], A[2, 3] = 1.0, [-(omega**2), -2 * zeta * omega, 1.0, 0.0], 1.0
    force, after = 0.3 * omega**2, -0.8 * omega**2
    expected = expm(A * dt) @ [1.0, 0.7 * omega, force, (after - force) / dt]
    found = ExactStepper(omega, zeta, dt).step(
        State(np.array([1.0]), np.array([0.7 * omega])), np.array([force]), np.array([after])
    )
    assert found.displacement[0] == pytest.approx(expected[0], abs=1e-11)
    assert found.velocity[0] / omega == pytest.approx(expected[1] / omega, abs=1e-11)


@pytest.mark.parametrize("eta", [0.0, 0.01, 0.3])
def test_exact_stepping_is_expm_over_200_periods(eta: float) -> None:
    """A clamped lattice over 200 periods of its first mode, against the exponential of its whole state."""
    from scipy.linalg import eigh, expm

    lattice = bending_lattice(Plate(0.5, 0.4, 0.004, Material("t", 2500.0, 70e9, 0.22), "CFFF"), 4)
    D_m = lattice.plate.bending_stiffness_nm / (2500.0 * 0.004)
    omega2, shapes = eigh(D_m * lattice.stiffness.toarray(), lattice.masses.toarray())
    omega = np.sqrt(omega2)[:12]
    period = 2 * np.pi / omega[0]
    steps = 200 * 64
    stepper, state = ExactStepper(omega, eta / 2, period / 64), plucked(omega)
    for _ in range(steps):
        state = stepper.step(state)

    n = len(omega)
    A = np.block([[np.zeros((n, n)), np.diag(omega)], [-np.diag(omega), -eta * np.diag(omega)]])  # of (omega q, v)
    one = expm(A * period)
    expected = np.linalg.matrix_power(one, 200) @ np.concatenate([np.ones(n), 0.3 * np.ones(n)])
    found = np.concatenate([omega * state.displacement, state.velocity])
    np.testing.assert_allclose(found, expected, atol=1e-9)
    assert shapes.shape[0] == lattice.n_nodes


@pytest.mark.parametrize("turn", [1e-3, 0.01, 0.1, 0.5, 2.0, 30.0])
def test_newmark_phase_error_follows_theory(turn: float) -> None:
    """The frequency over 2000 steps is (2/dt) atan(omega dt / 2), within 1e-6."""
    omega, steps = 2 * np.pi * 40.0, 2000
    dt = turn / omega
    stepper = NewmarkStepper(np.ones(1), np.zeros(1), np.array([omega**2]), dt)
    state = State(np.array([1.0]), np.zeros(1))
    angle, before = 0.0, 1.0 + 0j
    for _ in range(steps):
        state = stepper.step(state)
        now = complex(omega * state.displacement[0], -state.velocity[0])
        angle += float(np.angle(now / before))
        before = now
    assert angle / (steps * dt) == pytest.approx(2 / dt * np.arctan(omega * dt / 2), rel=1e-6)


def step_map(stepper: Stepper) -> NDArray[np.float64]:
    """The matrix by which a step of one mode maps (q, v); a mode is linear."""
    columns = [stepper.step(State(np.array([q]), np.array([v]))) for q, v in ((1.0, 0.0), (0.0, 1.0))]
    return np.array(columns)[:, :, 0].T


@pytest.mark.parametrize("zeta", [0.0, 0.005])
def test_newmark_follows_the_exact_answer_where_steps_are_short(zeta: float) -> None:
    """With omega dt = 0.01 the frequency error is 8e-6. Errors stay within 1 % of the amplitude: undamped over 150
    periods, and in RMS over 200; with a loss factor of 0.01 always. Every 7th step is compared."""
    omega = np.array([2 * np.pi * 100.0])
    dt = 0.01 / omega[0]
    exact = step_map(ExactStepper(omega, zeta, dt))
    newmark = step_map(NewmarkStepper(np.ones(1), 2 * zeta * omega, omega**2, dt))
    seven, other_seven = np.linalg.matrix_power(exact, 7), np.linalg.matrix_power(newmark, 7)
    one = other = np.array([1.0, 0.0])
    apart = np.empty(int(200 * 2 * np.pi / 0.07))
    for i in range(len(apart)):
        one, other = seven @ one, other_seven @ other
        apart[i] = abs(one[0] - other[0])
    assert apart[: len(apart) if zeta else len(apart) * 3 // 4].max() <= 0.01
    assert np.sqrt(np.mean(apart**2)) <= 0.01
    assert abs(2 / dt * np.arctan(omega * dt / 2) / omega - 1).max() < 1e-5


@pytest.mark.parametrize("dt", [1e-9, 1e-4, 10.0])
@pytest.mark.parametrize("kind", ["exact", "newmark"])
def test_energy_over_many_steps(kind: str, dt: float) -> None:
    """Undamped modes keep their energy over 6000 steps, damped ones never gain; `stress/propagation.py` takes 10^6."""
    omega, zeta = np.tile(OMEGA, 3), np.repeat([0.0, 0.005, 1.0], len(OMEGA))
    damped = zeta > 0
    stepper = (
        ExactStepper(omega, zeta, dt)
        if kind == "exact"
        else NewmarkStepper(np.ones_like(omega), 2 * zeta * omega, omega**2, dt)
    )
    state = plucked(omega)
    first = before = modal_energy(state, omega)
    for _ in range(6_000):
        state = stepper.step(state)
        now = modal_energy(state, omega)
        assert (now <= before + 1e-15 * first)[damped].all()
        before = now
    assert np.abs(before / first - 1)[~damped].max() < 1e-11
    assert stepper.energy(state) == pytest.approx(before.sum(), rel=1e-12)


def test_a_lattice_keeps_its_energy() -> None:
    """Steps of all nodes at once by sparse factors, with steps far longer than the fastest period."""
    from scipy.sparse import csr_array

    lattice = bending_lattice(Plate(0.5, 0.4, 0.004, Material("t", 2500.0, 70e9, 0.22), "SFFF"), 5)
    mass, stiffness = lattice.masses.sum(axis=1) * 10.0, lattice.stiffness * lattice.plate.bending_stiffness_nm
    start = State(np.zeros(lattice.n_nodes), np.random.default_rng(1).standard_normal(lattice.n_nodes))
    for dt in (1e-6, 1e-3):
        kept = NewmarkStepper(mass, csr_array(stiffness.shape), stiffness, dt)
        lost = NewmarkStepper(mass, 1e-5 * stiffness, stiffness, dt)
        one = other = start
        before = first = lost.energy(start)
        for _ in range(500):
            one, other = kept.step(one), lost.step(other)
            now = lost.energy(other)
            assert now <= before * (1 + 1e-12)
            before = now
        assert kept.energy(one) == pytest.approx(first, rel=1e-9)
        assert before < 0.99 * first


def test_hinged_lattice_keeps_its_energy_over_many_steps() -> None:
    """The energy is computed from the stretch of every spring, independently of the force that the stepper keeps."""
    from scipy.sparse import csr_array

    lattice = bending_lattice(Plate(0.5, 0.4, 0.004, Material("t", 2500.0, 70e9, 0.22), "SFFF"), 6)
    mass, D = lattice.masses.sum(axis=1) * 10.0, lattice.plate.bending_stiffness_nm
    stepper = NewmarkStepper(mass, csr_array((lattice.n_nodes, lattice.n_nodes)), D * lattice.stiffness, 1e-3)
    state = start = State(np.zeros(lattice.n_nodes), np.random.default_rng(1).standard_normal(lattice.n_nodes))
    for _ in range(4000):
        state = stepper.step(state)
    stretch = lattice.springs @ state.displacement
    energy = (state.velocity @ (mass * state.velocity) + D * stretch @ (lattice.weights @ stretch)) / 2
    first = start.velocity @ (mass * start.velocity) / 2
    turned = np.abs(state.displacement).max()
    assert turned > 0.4  # most of the deflection is rigid rotation
    assert energy == pytest.approx(first, rel=1e-9)
    assert stepper.energy(state) == pytest.approx(first, rel=3e-11)


@settings(max_examples=60)
@given(
    st.floats(0.0, 1e6),
    st.floats(0.0, 1.0),
    st.floats(1e-9, 10.0),
    st.sampled_from(["exact", "newmark"]),
    st.floats(0, 1),
)
def test_no_step_is_too_long(omega_hz: float, zeta: float, dt: float, kind: str, share: float) -> None:
    omega = np.array([2 * np.pi * omega_hz])
    stepper = (
        ExactStepper(omega, zeta, dt) if kind == "exact" else NewmarkStepper(np.ones(1), 2 * zeta * omega, omega**2, dt)
    )
    state = State(np.array([share / max(omega[0], 1.0)]), np.array([1.0]))
    before = stepper.energy(state)
    for _ in range(20):
        state = stepper.step(state)
        assert np.isfinite(state).all()
        assert stepper.energy(state) <= before * (1 + 1e-9)


@pytest.mark.parametrize("kind", ["exact", "newmark"])
def test_a_constant_force_ends_at_its_static_deflection(kind: str) -> None:
    omega = np.array([2 * np.pi * 10.0, 2 * np.pi * 300.0])
    dt = 1e-3
    stepper = ExactStepper(omega, 0.2, dt) if kind == "exact" else NewmarkStepper([1, 1], 0.4 * omega, omega**2, dt)
    state = State(np.zeros(2), np.zeros(2))
    for _ in range(2000):
        state = stepper.step(state, np.ones(2))
    np.testing.assert_allclose(state.displacement, 1 / omega**2, rtol=1e-6)
    np.testing.assert_allclose(state.velocity * omega, 0.0, atol=1e-6)


def test_a_free_mass_falls_exactly() -> None:
    stepper = ExactStepper([0.0], 0.0, 0.5)
    state = State(np.zeros(1), np.array([2.0]))
    for i in range(4):
        state = stepper.step(state, np.array([float(i)]), np.array([i + 1.0]))
    # u'' = 2 t: t^3 / 3 + 2 t at t = 2.
    assert state.displacement[0] == pytest.approx(8 / 3 + 4, rel=1e-12)
    assert state.velocity[0] == pytest.approx(6.0, rel=1e-12)


def test_invalid_settings_are_refused() -> None:
    with pytest.raises(ModelDomainError, match="dt_s is 0 s"):
        ExactStepper([1.0], 0.0, 0.0)
    with pytest.raises(ModelDomainError, match="damping_ratio"):
        ExactStepper([1.0], 1.5, 0.1)
    with pytest.raises(ModelDomainError, match="omega_rad_s"):
        ExactStepper([np.nan], 0.0, 0.1)
    with pytest.raises(ModelDomainError, match="no digits left"):
        ExactStepper([1e16], 0.0, 1.0)
    with pytest.raises(ModelDomainError, match="mass holds a value that is not above 0"):
        NewmarkStepper([0.0], [0.0], [1.0], 0.1)
    with pytest.raises(ModelDomainError, match="shapes"):
        NewmarkStepper([1.0, 1.0], [0.0], [1.0], 0.1)
    with pytest.raises(ModelDomainError, match="stiffness holds a value that is not finite"):
        NewmarkStepper([1.0], [0.0], [np.inf], 0.1)
    chain = np.array([[1e12, -1e12], [-1e12, 1e12]])
    with pytest.raises(ModelDomainError, match="step the system's modes"):
        NewmarkStepper([1.0, 1.0], np.zeros((2, 2)), chain, 1.0)
