"""Natural frequencies and shapes of a rectangular plate with free, simply supported and clamped edges.

    K c = k^4 c          omega = k^2 sqrt(D / m)          integral of m phi_i phi_j = 1 kg if i = j, else 0

K is the Ritz stiffness of `ritz`. A plate with alike edges on both ends of an axis has modes that are even or odd
along it, so the eigenproblem falls into up to four smaller ones. Each is solved for the inverse (K + s)^-1, whose
largest eigenvalues are the lowest modes: those of K grow as the eighth power of the basis size, and would bury rigid
motions and the lowest modes of large or slender plates in rounding.

Letters: k [rad/m] wavenumber, D [N m], m [kg/m2] mass per area, omega [rad/s], phi [kg^-1/2] shape, s [m^-4] shift.
Source: as `ritz`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache

import numpy as np
from numpy.typing import ArrayLike, NDArray

from scene2hap import checks
from scene2hap.errors import ModelDomainError
from scene2hap.propagation.plate import Plate
from scene2hap.propagation.points import as_points
from scene2hap.propagation.ritz import AxisBasis, axis_bases, products, stiffness

LARGEST_BLOCK = 3000
"""Functions in one eigenproblem beyond which a plate is refused; it takes some 20 s, and hundreds of modes."""
MARGIN = 1.5
"""Receptances take modes up to this many times their top frequency. Tuned: 2 halves the remaining error at twice the
time."""
SHIFT = 1e-2
"""s over k^4 of the highest mode wanted. Tuned: anywhere between 1e-4 and 1 the frequencies agree to 1e-9."""


@dataclass(frozen=True, eq=False)
class ModeBlock:
    """The whole Ritz spectrum of one symmetry: first its modes, then what is left of the basis.

    x, y : the basis of each axis, n = n_x n_y products; k4 : (n,) k^4 [m^-4], rising, 0 for rigid motions, true for
    modes and too high for the rest; vectors : (n, n) orthonormal columns.
    """

    x: AxisBasis
    y: AxisBasis
    k4: NDArray[np.float64]
    vectors: NDArray[np.float64]

    def deflections(self, points_m: NDArray[np.float64]) -> NDArray[np.float64]:
        """Every vector at points (n_points, 2) [m], normalised over the area -> (n_points, n) [1/m]."""
        return products(self.x, self.y, points_m) @ self.vectors


@dataclass(frozen=True, eq=False)
class PlateModes:
    """Modes of a plate, from the lowest.

    x, y : the bases of each axis; blocks : the spectrum by symmetry, one for each of their pairs; block, column :
    (n_modes,) where in them each mode is.
    """

    plate: Plate
    x: tuple[AxisBasis, ...]
    y: tuple[AxisBasis, ...]
    blocks: tuple[ModeBlock, ...]
    block: NDArray[np.intp]
    column: NDArray[np.intp]

    @cached_property
    def terms(self) -> tuple[int, int]:
        """Basis functions along length and width."""
        return sum(basis.n_functions for basis in self.x), sum(basis.n_functions for basis in self.y)

    @cached_property
    def frequencies_hz(self) -> NDArray[np.float64]:
        """Natural frequencies (n_modes,) float64 [Hz], rising; 0 for rigid motions, of which a free plate has three."""
        k4 = np.array([self.blocks[block].k4[column] for block, column in zip(self.block, self.column, strict=True)])
        frequencies: NDArray[np.float64] = np.sqrt(k4) / self.plate.wavenumber_per_root_omega**2 / (2 * math.pi)
        return frequencies

    def shapes(self, points_m: ArrayLike) -> NDArray[np.float64]:
        """Deflection of each mode at points, for a modal mass of 1 kg; its sign is arbitrary.

        A receptance is the sum over modes of phi(x) phi(x0) / (omega_n^2 (1 + j eta) - omega^2).

        Parameters: points_m : (n_points, 2) [m], from the plate's corner along length and width.
        Returns: (n_points, n_modes) float64 [kg^-1/2].
        Raises: ModelDomainError: a point outside the plate.
        """
        points = points_on(self.plate, points_m)
        m = self.plate.material.density_kg_m3 * self.plate.thickness_m
        shapes = np.empty((len(points), len(self.block)))
        for i, block in enumerate(self.blocks):
            mine = self.block == i
            shapes[:, mine] = products(block.x, block.y, points) @ block.vectors[:, self.column[mine]]
        return shapes / math.sqrt(m)


def plate_modes(plate: Plate, n_modes: int | None = None, *, max_frequency_hz: float | None = None) -> PlateModes:
    """The lowest `n_modes` modes, or all up to `max_frequency_hz`, rigid motions included.

    Frequencies are within 1e-3 of converged ones, from above. Shear and rotary inertia are left out, see
    `domain.THIN_WAVELENGTHS`. Answers are remembered by plate.

    Parameters: exactly one of n_modes >= 1 and max_frequency_hz >= 0 [Hz].
    Raises: ModelDomainError: neither or both, or so many modes that the eigenproblem grows past `LARGEST_BLOCK`.
    """
    if (n_modes is None) == (max_frequency_hz is None):
        raise ModelDomainError(
            f"n_modes is {n_modes} and max_frequency_hz is {max_frequency_hz}; give exactly one of them, a count of at "
            "least 1 or a frequency [Hz]."
        )
    if n_modes is None:
        f = checks.number("max_frequency_hz", max_frequency_hz, "Hz", at_least=0.0, error=ModelDomainError)
        return _modes_up_to(plate, f)
    return _lowest(plate, int(checks.number("n_modes", n_modes, "-", at_least=1, error=ModelDomainError)))


def n_rigid_motions(plate: Plate) -> int:
    """Motions without bending that the edges allow: three if all are free, one about a single hinge, else none."""
    return {"FFFF": 3, "FFFS": 1}.get("".join(sorted(plate.edges)), 0)


@lru_cache(maxsize=4096)
def first_bending_hz(plate: Plate) -> float:
    """The lowest natural frequency above 0 [Hz], from above and within 1e-3, at a thousandth of what all modes cost."""
    x, y = plate.edges[:2], plate.edges[2:]
    bases = [(u, v) for u in axis_bases(x, plate.length_m, 8) for v in axis_bases(y, plate.width_m, 8)]
    nu, longest = plate.material.poisson_ratio, max(plate.length_m, plate.width_m)
    k4 = np.sort(np.concatenate([np.linalg.eigvalsh(stiffness(u, v, nu)) for u, v in bases]))
    return float(math.sqrt(k4[k4 > 1e-6 / longest**4][0]) / plate.wavenumber_per_root_omega**2 / (2 * math.pi))


def largest_block(plate: Plate, max_frequency_hz: float) -> int:
    """Functions in the largest eigenproblem of `plate_modes` up to that frequency; its time grows with the cube."""
    terms = _terms(plate, float(plate.wavenumber_rad_m(max_frequency_hz)))
    edges = (plate.edges[:2], plate.edges[2:])
    return math.prod(math.ceil(n / 2) if pair[0] == pair[1] else n for n, pair in zip(terms, edges, strict=True))


def points_on(plate: Plate, points_m: ArrayLike) -> NDArray[np.float64]:
    """Points as (n_points, 2) float64 [m].

    Raises: ModelDomainError: a point outside the plate by more than a millionth of its size; polynomials run away.
    """
    points = as_points(points_m, 2)
    size = np.array([plate.length_m, plate.width_m])
    outside = ((points < -1e-6 * size) | (points > (1 + 1e-6) * size)).any(axis=1)
    if outside.any():
        x, y = points[outside][0]
        raise ModelDomainError(
            f"point ({x:g}, {y:g}) m lies outside the plate of {plate.length_m:g} × {plate.width_m:g} m; points are "
            "measured from its corner along length and width. Move it to the nearest point of the plate."
        )
    return points


@lru_cache(maxsize=32)
def _lowest(plate: Plate, count: int) -> PlateModes:
    # Weyl's count of modes below k for free edges, (S k^2 + U k) / 4 pi, gives the start; edges that hold need more.
    area, edge = plate.length_m * plate.width_m, 2 * (plate.length_m + plate.width_m)
    k = edge / (2 * area) * (math.sqrt(1 + 16 * math.pi * area * count / edge**2) - 1)
    while True:
        modes = _modes_up_to(plate, (k / plate.wavenumber_per_root_omega) ** 2 / (2 * math.pi))
        if len(modes.block) >= count:
            return replace(modes, block=modes.block[:count], column=modes.column[:count])
        k *= 1.3


@lru_cache(maxsize=128)  # a room full of plates; a sheet of a hundred modes holds some 8 MB
def _modes_up_to(plate: Plate, max_frequency_hz: float) -> PlateModes:
    k = float(plate.wavenumber_rad_m(max_frequency_hz))
    terms, largest = _terms(plate, k), largest_block(plate, max_frequency_hz)
    if largest > LARGEST_BLOCK:
        raise ModelDomainError(
            f"modes up to {max_frequency_hz:g} Hz of a plate of {plate.length_m:g} × {plate.width_m:g} m need "
            f"{largest} functions in one eigenproblem; at most {LARGEST_BLOCK} are allowed. Ask for a lower frequency, "
            "or use InfinitePlate, which a plate with so many modes resembles."
        )
    bases_x = axis_bases(plate.edges[:2], plate.length_m, terms[0])
    bases_y = axis_bases(plate.edges[2:], plate.width_m, terms[1])
    shift = SHIFT * max(k, math.pi / max(plate.length_m, plate.width_m)) ** 4
    blocks = tuple(_solve(x, y, plate.material.poisson_ratio, shift) for x in bases_x for y in bases_y)
    k4 = np.concatenate([block.k4 for block in blocks])
    block = np.concatenate([np.full(len(block.k4), i) for i, block in enumerate(blocks)])
    column = np.concatenate([np.arange(len(block.k4)) for block in blocks])
    order = np.argsort(k4, kind="stable")
    for rigid in order[: n_rigid_motions(plate)]:
        blocks[block[rigid]].k4[column[rigid]] = k4[rigid] = 0.0  # rather than what rounding left of it
    modes = order[k4[order] <= k**4 * (1 + 1e-9)]
    return PlateModes(plate, bases_x, bases_y, blocks, block[modes], column[modes])


def _terms(plate: Plate, k: float) -> tuple[int, int]:
    return _n_terms(k * plate.length_m), _n_terms(k * plate.width_m)


def _n_terms(k_length: float) -> int:
    """Functions per axis for all waves up to k: a polynomial needs pi per wavelength; 2 k L / pi is a quarter more.

    The least, 16, is tuned for what `modal_plate` asks of small plates.
    """
    return max(16, math.ceil(2 / math.pi * k_length) + 4)


def _solve(x: AxisBasis, y: AxisBasis, poisson_ratio: float, shift: float) -> ModeBlock:
    from scipy.linalg import cho_factor, cho_solve, eigh

    identity = np.eye(x.n_functions * y.n_functions)
    inverse = cho_solve(cho_factor(stiffness(x, y, poisson_ratio) + shift * identity), identity)
    compliance, vectors = eigh((inverse + inverse.T) / 2, driver="evd")
    # The stiffest functions lie below rounding; they take no part in any answer.
    k4 = 1 / np.maximum(compliance[::-1], 1e-18 / shift) - shift
    return ModeBlock(x, y, k4, vectors[:, ::-1])
