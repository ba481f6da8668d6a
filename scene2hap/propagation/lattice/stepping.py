"""Time stepping of vibrating systems by two unconditionally stable integrators.

    M u'' + C u' + K u = f(t),   f linear between the steps

`ExactStepper` takes modes, q'' + 2 zeta omega q' + omega^2 q = f, and has no error but rounding. With the impulse
response g, the step response p = integral of g and the ramp response r = integral of p,

    q1 = (1 - omega^2 p) q0 + g v0 + p f0 + r (f1 - f0) / dt
    v1 = -omega^2 g q0 + (1 - omega^2 p - 2 zeta omega g) v0 + g f0 + p (f1 - f0) / dt

`NewmarkStepper` takes any matrices: average acceleration, beta = 1/4 and gamma = 1/2, written for the mean velocity w
of the step, so that steps far longer than the fastest period lose no digits:

    (M + dt/2 C + dt^2/4 K) w = M v0 + dt/2 ((f0 + f1)/2 - s0),   u1 = u0 + dt w,   v1 = 2 w - v0,   s1 = s0 + dt K w

Undamped modes then oscillate at (2/dt) atan(omega dt/2) instead of omega, and keep their energy. The force of the
springs s = K u is part of the state. A body that nothing holds moves ever farther, and rounding of K u, which grows
with u, would push it as no spring does; K w stays as small as the motion.

The loss of a plate, D (1 + j eta), has no causal counterpart in time. Stepping uses viscous modal damping of ratio
zeta = eta/2. Elsewhere than at the resonance, r = omega / omega_n = 1, a mode is |1 - r^2 + j eta| /
|1 - r^2 + j eta r| times as large as with the complex stiffness.

Letters: u, q [m], v [m/s], f [N], omega [rad/s], zeta [-], dt [s].
Source: Newmark, J. Eng. Mech. Div. ASCE 85 (1959); Craig and Kurdila, Fundamentals of Structural Dynamics, for the
piecewise exact method.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from scene2hap.common import checks
from scene2hap.errors import ModelDomainError
from scene2hap.propagation.lattice.factors import diagonal_factors

if TYPE_CHECKING:
    from collections.abc import Callable

SHORTEST_STEP_S = 1e-12
LONGEST_STEP_S = 1e3
"""Bounds of a step: beyond them dt^2 leaves no digits beside 1 in any system that touch could feel."""

MOST_ROUNDING = 1e-12
"""Largest error of a step from rounding of dt^2 K / 4, relative to the mass."""


class State(NamedTuple):
    """Deflections [m] and velocities [m/s], (n,) float64 each."""

    displacement: NDArray[np.float64]
    velocity: NDArray[np.float64]


class _Carried(State):
    """A state that a step returned, with the force K u of its springs (n,) [N]."""

    elastic: NDArray[np.float64] | None = None


class Stepper(Protocol):
    """Advances a state by one step."""

    def step(self, state: State, force: ArrayLike = 0.0, next_force: ArrayLike | None = None) -> State:
        """Return the state one step later. The force (n,) [N] changes linearly to `next_force`, or stays if that is
        None."""
        ...

    def energy(self, state: State) -> float:
        """Kinetic and elastic energy [J]."""
        ...


class ExactStepper:
    """Modes of 1 kg, each stepped by its exact solution.

    Parameters: omega_rad_s : (n,) >= 0; damping_ratio : one or (n,), 0..1; dt_s : step [s].
    Raises: ModelDomainError: a value is outside its bound.
    """

    def __init__(self, omega_rad_s: ArrayLike, damping_ratio: ArrayLike, dt_s: float) -> None:
        omega = _per_mode("omega_rad_s", omega_rad_s, np.inf, "[rad/s]")
        zeta = np.broadcast_to(_per_mode("damping_ratio", damping_ratio, 1.0, "[-]"), omega.shape)
        dt = _step(dt_s)
        if (omega > 1e15 / dt).any():
            raise ModelDomainError(
                f"omega_rad_s reaches {omega.max():g} rad/s; over a step of {dt:g} s its phase has no digits left. "
                "Keep the product below 1e15 by a shorter step, or leave such modes to their static share."
            )
        g, p, r = _responses(omega, zeta, dt)
        self._omega2 = omega**2
        self._kept = 1 - self._omega2 * p, g, -self._omega2 * g, 1 - self._omega2 * p - 2 * zeta * omega * g
        if (omega * dt >= 1).any():  # the same, without cancellation at long steps
            decay, phase = np.exp(-zeta * omega * dt), omega * np.sqrt((1 - zeta) * (1 + zeta)) * dt
            long = omega * dt >= 1
            cosine = decay * np.cos(phase)
            self._kept[0][long] = (cosine + zeta * omega * g)[long]
            self._kept[3][long] = (cosine - zeta * omega * g)[long]
        self._pushed = p, g
        self._ramped = r / dt, p / dt

    def step(self, state: State, force: ArrayLike = 0.0, next_force: ArrayLike | None = None) -> State:
        """Return the state one step later, see `Stepper`."""
        q, v = state
        qq, qv, vq, vv = self._kept
        displacement, velocity = qq * q + qv * v, vq * q + vv * v
        if next_force is not None or np.any(force):
            f = np.asarray(force, dtype=np.float64)
            rise = 0.0 if next_force is None else np.asarray(next_force, dtype=np.float64) - f
            displacement = displacement + self._pushed[0] * f + self._ramped[0] * rise
            velocity = velocity + self._pushed[1] * f + self._ramped[1] * rise
        return State(displacement, velocity)

    def energy(self, state: State) -> float:
        """Kinetic and elastic energy [J]."""
        return float(np.sum(state.velocity**2 + self._omega2 * state.displacement**2) / 2)


class NewmarkStepper:
    """Any linear system, stepped by average acceleration.

    Parameters: mass, damping, stiffness : (n,) diagonals, or (n, n) matrices, dense or sparse, symmetric and positive
    semidefinite, mass positive; [kg], [N s/m], [N/m]; dt_s : step [s].
    Raises: ModelDomainError: shapes that do not fit, a value that is not finite, a mass that is not positive; matrices
    so stiff for the step that the slowest motion would be lost in rounding of the fastest. Modes have no such bound.
    Rounding adds up where nothing holds a body: the energy of a hinged plate changed by 1.2e-11 of itself over 10^4
    steps of 1 ms, by 1.5e-9 over 2 x 10^5 and by 2.2e-8 over 10^6. For longer runs, step its modes.
    """

    def __init__(self, mass: Any, damping: Any, stiffness: Any, dt_s: float) -> None:
        from scipy.sparse import csr_array, diags_array

        dt = _step(dt_s)
        matrices = [_matrix(*given) for given in (("mass", mass), ("damping", damping), ("stiffness", stiffness))]
        diagonal = all(matrix.ndim == 1 for matrix in matrices)
        if not diagonal:
            matrices = [csr_array(diags_array(matrix) if matrix.ndim == 1 else matrix) for matrix in matrices]
        shapes = [matrix.shape for matrix in matrices]
        if len(set(shapes)) != 1 or len(set(shapes[0])) != 1:
            raise ModelDomainError(
                f"mass, damping and stiffness have shapes {shapes}; they must be alike, (n,) or (n, n)."
            )
        if ((matrices[0] if diagonal else matrices[0].diagonal()) <= 0).any():
            raise ModelDomainError(
                "mass holds a value that is not above 0 [kg]; give every degree of freedom a mass, or leave it out."
            )
        if not diagonal:
            _check_rounding(matrices[0], matrices[2], dt)
        self._dt, self._is_diagonal = dt, diagonal
        self._mass, self._damping, self._stiffness = matrices
        self._times: Callable[[Any, NDArray[np.float64]], Any] = np.multiply if diagonal else lambda a, x: a @ x
        effective = self._mass + dt / 2 * self._damping + dt**2 / 4 * self._stiffness
        self._solve = (lambda x: x / effective) if diagonal else diagonal_factors(effective).solve

    def step(self, state: State, force: ArrayLike = 0.0, next_force: ArrayLike | None = None) -> State:
        """Return the state one step later, see `Stepper`."""
        u, v = state
        elastic = self._elastic(state)
        pull = np.asarray(force, dtype=np.float64) - elastic
        if next_force is not None:
            pull = pull + (np.asarray(next_force, dtype=np.float64) - np.asarray(force, dtype=np.float64)) / 2
        mean = self._solve(self._times(self._mass, v) + self._dt / 2 * pull)
        moved = _Carried(u + self._dt * mean, 2 * mean - v)
        if not self._is_diagonal:  # in a diagonal system, K u rounds no worse than u
            moved.elastic = elastic + self._dt * self._times(self._stiffness, mean)
        return moved

    def energy(self, state: State) -> float:
        """Kinetic and elastic energy [J]."""
        u, v = state
        return float(v @ self._times(self._mass, v) + u @ self._elastic(state)) / 2

    def _elastic(self, state: State) -> NDArray[np.float64]:
        if isinstance(state, _Carried) and state.elastic is not None:
            return state.elastic
        force: NDArray[np.float64] = self._times(self._stiffness, state.displacement)
        return force


def _responses(omega: NDArray[np.float64], zeta: NDArray[np.float64], dt: float) -> tuple[NDArray[np.float64], ...]:
    """Impulse, step and ramp response g, p, r of each mode after dt; a power series where omega dt < 1."""
    x = omega * dt
    short = x < 1
    s = np.where(short, x, 0.0)
    g, p, r = np.zeros_like(x), np.zeros_like(x), np.zeros_like(x)
    before, now = np.zeros_like(x), np.ones_like(x)  # coefficients n - 1 and n of g / dt in t / dt
    for n in range(1, 30):
        g, p, r = g + now, p + now / (n + 1), r + now / ((n + 1) * (n + 2))
        before, now = now, -(2 * zeta * s * n * now + s**2 * before) / ((n + 1) * n)
    decay, turn = np.exp(-zeta * x), np.sqrt((1 - zeta) * (1 + zeta)) * x
    w = np.where(short, 1.0, omega)
    g_long = decay * np.sinc(turn / np.pi) * dt
    p_long = (1 - decay * np.cos(turn) - zeta * w * g_long) / w**2
    r_long = (dt - g_long - 2 * zeta * w * p_long) / w**2
    return np.where(short, g * dt, g_long), np.where(short, p * dt**2, p_long), np.where(short, r * dt**3, r_long)


def _matrix(name: str, given: Any) -> Any:
    from scipy.sparse import issparse

    sparse = bool(issparse(given))
    array: Any = given if sparse else np.asarray(given, dtype=np.float64)
    if not np.isfinite(array.tocsr().data if sparse else array).all():
        raise ModelDomainError(f"{name} holds a value that is not finite; every one must be a number.")
    return array


def _check_rounding(mass: Any, stiffness: Any, dt: float) -> None:
    fastest2 = float((abs(stiffness).sum(axis=1) / mass.diagonal()).max())  # Gershgorin's bound on omega^2
    longest = math.sqrt(4 * MOST_ROUNDING / np.finfo(float).eps / max(fastest2, 1e-300))
    if dt > longest:
        raise ModelDomainError(
            f"dt_s is {dt:g} s; these matrices move as fast as {math.sqrt(fastest2):.3g} rad/s, whose rounding would "
            f"drown slow motions in steps above {longest:.3g} s. Take shorter steps, or step the system's modes."
        )


def _step(dt_s: float) -> float:
    return checks.number("dt_s", dt_s, "s", at_least=SHORTEST_STEP_S, at_most=LONGEST_STEP_S, error=ModelDomainError)


def _per_mode(name: str, values: ArrayLike, at_most: float, unit: str) -> NDArray[np.float64]:
    array = np.atleast_1d(np.asarray(values, dtype=np.float64))
    if array.ndim != 1 or not np.isfinite(array).all() or (array < 0).any() or (array > at_most).any():
        bound = "at least 0" if np.isinf(at_most) else f"0..{at_most:g}"
        given = checks.represented(values)
        raise ModelDomainError(f"{name} is {given}; it must be (n,) finite numbers of {bound} {unit}.")
    return array
