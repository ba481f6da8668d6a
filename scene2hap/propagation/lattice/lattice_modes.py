"""Harmonic response of a lattice: its modes up to a frequency, and a series for all higher modes.

    u(z) = Phi (Lambda - z)^-1 Phi^T p + sum over j of (z + s)^j R_j            z = k_c^4
    R_j = (G A)^j G p',  G = (K + s A)^-1,  p' = p - A Phi Phi^T p

for (K - z A) u = p, where A holds the masses of the nodes. The series is the response of the modes left out, which lie
above z; each term leaves less than half of the error before. One factorisation of K + s A gives both the modes, by
Lanczos' method, and the series.

The stiffest springs of a lattice are up to 1e16 times as stiff as its longest wave. Where one solve alone would lose
that wave in rounding, the solution is refined by its residual, which is computed from the springs
(`Lattice.restoring`).

Letters: k [rad/m] wavenumber, Lambda [m^-4] eigenvalues k^4, Phi [1/m] shapes normalised over the area, p [-] force for
D = 1, s [m^-4] shift, c complex.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache, partial

import numpy as np

from scene2hap.common.arrays import Floats
from scene2hap.errors import ModelDomainError
from scene2hap.propagation.domain import warn_if_slow
from scene2hap.propagation.lattice.bending_lattice import MOST_NODES, bending_lattice, n_nodes_of, of_size_one
from scene2hap.propagation.lattice.block_lanczos import largest
from scene2hap.propagation.lattice.factors import Factors, positive_factors
from scene2hap.propagation.lattice.lattice import Lattice
from scene2hap.propagation.modal.estimates import n_modes_to, n_rigid_motions, wavenumber_of_mode
from scene2hap.propagation.plate import Plate

MARGIN = 1.5
"""Modes are solved up to this many times the top frequency; the series takes over from there."""
TERMS = 4
"""Terms of the series. Measured on furniture: with them the response is within 0.02 dB of a direct solve at p95."""
_ABOVE_ROUNDING = 1e4
"""Least ratio of the shift to the rounding of K: a solution loses at most a ten thousandth."""
QUICK_NODES = 6_000
"""Nodes of a lattice whose lowest modes take less than about a second."""
MOST_WORK = 1e8
"""Most nodes times modes squared for which modes are solved: the cost of Lanczos' method. A plate then takes some
seconds at most."""
QUICK_WORK = 5e7
"""Nodes times modes squared that take less than about a second."""
_EXACT = 1e-7
"""Largest relative error of an accepted solution; the error of a frequency is its square."""
DENSE_SHARE = 0.25
"""Share of wanted modes from which all modes of a lattice are solved at once: this is then faster than Lanczos' method.
Tuned."""
_BURIED = 1e-8
"""Most that rounding may add to each eigenvalue if all are solved at once, relative to the largest wanted one: their
error is that of the stiffest springs."""


@dataclass(frozen=True, eq=False)
class LatticeModes:
    """The lowest modes of a lattice, and the factors for the response of the others.

    k4 : (n_modes,) [m^-4], rising, 0 for rigid motions; shapes : (n_nodes, n_modes) [1/m]; shift_k4 : s.
    """

    lattice: Lattice
    k4: Floats
    shapes: Floats
    shift_k4: float
    factors: Factors

    @property
    def frequencies_hz(self) -> Floats:
        """Natural frequencies (n_modes,) [Hz]."""
        found: Floats = np.sqrt(self.k4) / self.lattice.plate.wavenumber_per_root_omega**2 / (2 * math.pi)
        return found

    def resized(self, plate: Plate, size_m: float) -> LatticeModes:
        """Return the modes of a plate of the same shape, `size_m` times as large. The factors stay, as K + s A does."""
        lattice = self.lattice.resized(plate, size_m)
        return LatticeModes(
            lattice, self.k4 / size_m**4, self.shapes / size_m**2, self.shift_k4 / size_m**4, self.factors
        )

    def stiffer(self, forces: Floats) -> Floats:
        """Terms R_j of the series (TERMS, n_nodes, n_forces) for forces (n_nodes, n_forces)."""
        masses = self.lattice.masses
        terms = np.empty((TERMS, *forces.shape))
        force = forces
        for j in range(TERMS):
            force = force - masses @ (self.shapes @ (self.shapes.T @ force))
            terms[j] = solve_shifted(self.lattice, self.factors, self.shift_k4, force)
            terms[j] -= self.shapes @ (self.shapes.T @ (masses @ terms[j]))
            force = masses @ terms[j]
        return terms


def lattice_modes(plate: Plate, resolution: int, top_frequency_hz: float) -> LatticeModes:
    """Modes for the response up to a frequency [Hz].

    They are cached by shape, resolution and frequency in thirds of an octave. Plates that differ in size, thickness or
    material share them if Poisson's ratio is the same.
    Raises: ModelDomainError: too many nodes, see `bending_lattice`; too many modes, see `MOST_WORK`.
    """
    lowest_hz = plate.frequency_hz(math.pi / max(plate.extent_m))
    thirds = math.ceil(3 * math.log2(max(top_frequency_hz / lowest_hz, 1.0)) - 1e-9)
    check_work(plate, resolution, n_modes_up_to(plate, MARGIN * lowest_hz * 2 ** (thirds / 3)))
    alike, size_m = of_size_one(plate)
    warn_if_slow(plate, bending_lattice(alike, resolution).n_nodes, QUICK_NODES, "nodes of a lattice")
    return _modes_up_to(alike, resolution, thirds).resized(plate, size_m)


def lowest_frequencies_hz(plate: Plate, resolution: int, n_modes: int) -> Floats:
    """The lowest natural frequencies (n_modes,) [Hz], rigid motions included.

    Raises: ModelDomainError: the lattice has fewer nodes; too many nodes, see `bending_lattice`; too many modes, see
    `MOST_WORK`.
    """
    check_work(plate, resolution, n_modes)
    n_nodes = bending_lattice(plate, resolution).n_nodes
    warn_if_slow(plate, n_nodes, QUICK_NODES, "nodes of a lattice")
    if n_modes > n_nodes:
        raise ModelDomainError(
            f"n_modes is {n_modes}; a lattice of resolution {resolution} has {n_nodes} modes. Raise the resolution."
        )
    wanted = wavenumber_of_mode(plate, 1.2 * n_modes + 2) ** 4
    lattice, factors, shift = _factorised(plate, resolution, wanted)
    while True:
        k4, _ = _all_below(lattice, factors, shift, wanted)
        if len(k4) >= n_modes:
            break
        wanted *= 2
    frequencies: Floats = np.sqrt(k4[:n_modes]) / plate.wavenumber_per_root_omega**2 / (2 * math.pi)
    return frequencies


def n_modes_up_to(plate: Plate, frequency_hz: float) -> float:
    """Approximate number of modes of a plate with free edges up to a frequency [Hz] (Weyl)."""
    return n_modes_to(plate, float(plate.wavenumber_rad_m(frequency_hz)))


def is_too_much(plate: Plate, resolution: int, top_frequency_hz: float) -> bool:
    """Whether `lattice_modes` would refuse a plate for its nodes or modes."""
    n_nodes = n_nodes_of(plate, resolution)
    n_modes = n_modes_up_to(plate, MARGIN * 2 ** (1 / 3) * top_frequency_hz)
    return n_nodes > MOST_NODES or _work(n_nodes, n_modes) > MOST_WORK


def _work(n_nodes: int, n_modes: float) -> float:
    """Nodes times modes squared; a lattice has no more modes than nodes."""
    return n_nodes * min(n_modes, n_nodes) ** 2


def check_work(plate: Plate, resolution: int, n_modes: float) -> None:
    """Check the work of solving modes.

    Raises: ModelDomainError: it is above `MOST_WORK`. Warns: SlowPlateWarning: it takes seconds.
    """
    n_nodes = n_nodes_of(plate, resolution)
    needed = _work(n_nodes, n_modes)
    if needed > MOST_WORK:
        raise ModelDomainError(
            f"a plate of {plate.length_m:g} × {plate.width_m:g} m of {1e3 * plate.thickness_m:g} mm "
            f"{plate.material.name} takes some {n_modes:.0f} modes of a lattice of resolution {resolution}, "
            f"{needed / MOST_WORK:.0f} times what is solved in seconds. Lower the frequency or the resolution, or use "
            "ModalPlate or InfinitePlate."
        )
    warn_if_slow(plate, round(min(n_modes, n_nodes)), round(math.sqrt(QUICK_WORK / n_nodes)), "modes of a lattice")


@lru_cache(maxsize=8)  # bodies keep their modes
def _modes_up_to(plate: Plate, resolution: int, thirds: int) -> LatticeModes:
    """Modes up to `MARGIN` times a frequency, in thirds of an octave above that of a half wave along the plate."""
    wanted = MARGIN**2 * (math.pi / max(plate.extent_m)) ** 4 * 4 ** (thirds / 3)
    lattice, factors, shift = _factorised(plate, resolution, wanted)
    k4, shapes = _all_below(lattice, factors, shift, wanted)
    kept = max(np.count_nonzero(k4 <= wanted), n_rigid_motions(plate))
    return LatticeModes(lattice, k4[:kept], shapes[:, :kept], shift, factors)


def _factorised(plate: Plate, resolution: int, top_k4: float) -> tuple[Lattice, Factors, float]:
    """The lattice, the factors of K + s A, and s, for modes up to k^4."""
    lattice = bending_lattice(plate, resolution)
    # Large compared with the rounding of K, for refinement to converge; small compared with the modes of interest.
    shift = max(1e-2 * top_k4, _ABOVE_ROUNDING * lattice.rounding_k4)
    return lattice, positive_factors(lattice.stiffness + shift * lattice.masses), shift


def solve_shifted(lattice: Lattice, factors: Factors, shift_k4: float, forces: Floats) -> Floats:
    """Solve (K + s A) u = p for deflections u, (n_nodes, ...) each, refined where rounding would show."""
    found: Floats = factors.solve(forces)
    if lattice.is_clear:
        return found
    # Each pass divides the error by the ratio of the shift to the rounding of K.
    for _ in range(math.ceil(math.log(_EXACT) / math.log(lattice.rounding_k4 / shift_k4)) - 1):
        found += factors.solve(forces - lattice.restoring(found) - shift_k4 * (lattice.masses @ found))
    return found


def _all_below(lattice: Lattice, factors: Factors, shift_k4: float, wanted_k4: float) -> tuple[Floats, Floats]:
    """k^4 (n_modes,) [m^-4], rising, and shapes (n_nodes, n_modes) [1/m] of all modes below a value, and some more."""
    n, masses = lattice.n_nodes, lattice.masses
    expected = n_modes_to(lattice.plate, wanted_k4**0.25)
    if expected > DENSE_SHARE * n and np.finfo(float).eps * lattice.stiffest_k4 < _BURIED * wanted_k4:
        k4, shapes = all_modes(lattice.stiffness.toarray(), masses.toarray())
        # Some more than wanted, since `_ritz` removes the rounding error of an eigenvalue.
        shapes = shapes[:, k4 <= (1 + _BURIED) * wanted_k4]
    else:
        compliance = partial(solve_shifted, lattice, factors, shift_k4)
        shapes = largest(compliance, masses, 1 / (wanted_k4 + shift_k4), expected)
    return _ritz(lattice, shapes)


def _ritz(lattice: Lattice, shapes: Floats) -> tuple[Floats, Floats]:
    """Modes within the span of shapes (Ritz); their error is the square of the error of the shapes."""
    if not shapes.shape[1]:
        return np.empty(0), shapes
    stiffness = shapes.T @ lattice.restoring(shapes)
    k4, turned = all_modes((stiffness + stiffness.T) / 2, shapes.T @ (lattice.masses @ shapes))
    k4[: n_rigid_motions(lattice.plate)] = 0.0
    return k4, shapes @ turned


def all_modes(stiffness: Floats, masses: Floats) -> tuple[Floats, Floats]:
    """Solve K v = k^4 A v for dense K and A (n, n). Returns k^4 (n,), rising, and v (n, n) with v^T A v = 1.

    numpy releases the interpreter's lock while it computes. `scipy.linalg.eigh` keeps it, for 0.4 s with a thousand
    nodes, in which neither the game nor its audio thread would run.
    """
    to_unit_masses = np.linalg.inv(np.linalg.cholesky(masses))
    k4, vectors = np.linalg.eigh(to_unit_masses @ stiffness @ to_unit_masses.T)
    return k4, to_unit_masses.T @ vectors
