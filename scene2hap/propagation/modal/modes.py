"""Natural frequencies and shapes of a rectangular plate with free, simply supported and clamped edges.

    K c = k^4 c          omega = k^2 sqrt(D / m)          integral of m phi_i phi_j = 1 kg if i = j, else 0

K is the Ritz stiffness matrix of `ritz`. If the edges at both ends of an axis are equal, modes are even or odd along
it. The eigenproblem then splits into up to four smaller ones (`mode_block`).

Letters: k [rad/m] wavenumber, D [N m], m [kg/m2] mass per area, omega [rad/s], phi [kg^-1/2] shape, s [m^-4] shift.
Source: see `ritz`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache

import numpy as np
from numpy.typing import ArrayLike, NDArray

from scene2hap.common import checks
from scene2hap.common.caches import cached_while_used
from scene2hap.common.calls import clear_attributes
from scene2hap.common.counted import counted
from scene2hap.errors import ModelDomainError
from scene2hap.propagation.domain import warn_if_slow
from scene2hap.propagation.modal.estimates import SHIFT, n_rigid_motions, wavenumber_of_mode
from scene2hap.propagation.modal.mode_block import ModeBlock, modes_below
from scene2hap.propagation.modal.ritz import AxisBasis, axis_bases, products
from scene2hap.propagation.plate import MAX_FREQUENCY_HZ, Plate, require_plate
from scene2hap.propagation.points import points_on
from scene2hap.scene.geometry import frozen

LARGEST_BLOCK = 3000
"""Most functions in one eigenproblem; more are an error. This many take some 20 s, and give hundreds of modes."""
QUICK_BLOCK = 1000
"""Functions in one eigenproblem that take less than about a second."""
MARGIN = 1.5
"""Receptances take modes up to this many times their top frequency. Tuned: 2 halves the remaining error at twice the
time."""
_HELD_WAVE = 5.0
"""Along held edges a deflection falls off within the plate's width b: functions resolve waves up to this k b at least.
Tuned: the static deflection of a long strip is within 0.2 dB of Timoshenko's; with 7, within 0.1 dB at thrice the cost.
"""


@dataclass(frozen=True)
class Fineness:
    """Number of functions on an axis of length L, for waves up to k: per_k_length * k L + more, at least `least`.

    A wavelength needs pi polynomials, which is k L / 2 for the axis. The response of the stiffer spectrum uses `wider`
    times as many functions: the truncation of a basis makes responses ripple along both axes through the force, by 1 %
    of their rms, which is 1 dB where the plate hardly moves. More functions cost much less in a factorisation than in
    an eigenproblem. The wider basis has at least `least_wider` functions, since truncating a small basis affects
    contacts close together. Blocks above `QUICK_BLOCK` are not widened.
    """

    per_k_length: float = 1.75 / math.pi
    more: int = 4
    least: int = 16
    wider: float = 1.2
    least_wider: int = 24


FINE = Fineness()
"""Fineness of `plate_modes`; `least` is tuned for the small plates of `modal_plate`."""


@clear_attributes
@dataclass(frozen=True, eq=False)
class PlateModes:
    """Modes of a plate, from the lowest: their frequencies and shapes.

    x, y : basis functions of each axis; blocks : modes by symmetry, one block for each pair of symmetries along both
    axes; block, column : (n_modes,) place of each mode in the blocks; of_modes : numbers of basis functions along
    length and width that modes consist of, the first of each axis.
    """

    plate: Plate
    x: tuple[AxisBasis, ...]
    y: tuple[AxisBasis, ...]
    blocks: tuple[ModeBlock, ...]
    block: NDArray[np.intp]
    column: NDArray[np.intp]
    of_modes: tuple[int, int]

    def __repr__(self) -> str:
        low, high = self.frequencies_hz[[0, -1]] if len(self.block) else (0.0, 0.0)
        return f"PlateModes({counted(len(self.block), 'mode')}, {low:.4g} to {high:.4g} Hz)"

    @cached_property
    def terms(self) -> tuple[int, int]:
        """Numbers of basis functions along length and width."""
        return sum(basis.n_functions for basis in self.x), sum(basis.n_functions for basis in self.y)

    @property
    def nbytes(self) -> int:
        """Memory [byte], with the factors that are computed when they are first needed."""
        return sum(block.vectors.nbytes + 8 * len(block.vectors) ** 2 for block in self.blocks)

    @cached_property
    def frequencies_hz(self) -> NDArray[np.float64]:
        """Natural frequencies (n_modes,) float64 [Hz], rising; 0 for rigid motions, of which a free plate has three.

        Read-only, since later calls of `plate_modes` share them.
        """
        k4 = np.array([self.blocks[block].k4[column] for block, column in zip(self.block, self.column, strict=True)])
        return frozen(np.sqrt(k4) / self.plate.wavenumber_per_root_omega**2 / (2 * math.pi))

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
    """Compute the lowest `n_modes` modes of a plate, or all up to `max_frequency_hz`, rigid motions included.

    Frequencies are within 1e-3 of converged ones, from above. Shear and rotary inertia are left out, see
    `domain.THIN_WAVELENGTHS`. Results are cached.

    Parameters: exactly one of n_modes >= 1 and max_frequency_hz >= 0 [Hz].
    Raises: ModelDomainError: neither or both, or so many modes that the eigenproblem grows past `LARGEST_BLOCK`.
    """
    require_plate(plate)
    if (n_modes is None) == (max_frequency_hz is None):
        raise ModelDomainError(
            f"n_modes is {n_modes} and max_frequency_hz is {max_frequency_hz}; give exactly one of them, a count of at "
            "least 1 or a frequency [Hz]."
        )
    if n_modes is None:
        f = checks.number(
            "max_frequency_hz", max_frequency_hz, "Hz", at_least=0, at_most=MAX_FREQUENCY_HZ, error=ModelDomainError
        )
        return modes_up_to(plate, f, FINE)
    return _lowest(
        plate, checks.whole("n_modes", n_modes, "-", at_least=1, at_most=LARGEST_BLOCK**2, error=ModelDomainError)
    )


def largest_block(plate: Plate, max_frequency_hz: float, fineness: Fineness = FINE) -> int:
    """Number of functions in the largest eigenproblem of `plate_modes`; its time grows with the cube of this number."""
    terms = _terms(plate, _wavenumber(plate, max_frequency_hz), fineness)
    edges = (plate.edges[:2], plate.edges[2:])
    return math.prod(math.ceil(n / 2) if pair[0] == pair[1] else n for n, pair in zip(terms, edges, strict=True))


@lru_cache(maxsize=32)
def _lowest(plate: Plate, count: int) -> PlateModes:
    k = wavenumber_of_mode(plate, count)  # held edges need a higher one
    while True:
        modes = modes_up_to(plate, plate.frequency_hz(k), FINE)
        if len(modes.block) >= count:
            return replace(modes, block=modes.block[:count], column=modes.column[:count])
        k *= 1.3


def _wavenumber(plate: Plate, frequency_hz: float) -> float:
    """`Plate.wavenumber_rad_m` without its limit: searches for modes go beyond `MAX_FREQUENCY_HZ`."""
    return plate.wavenumber_per_root_omega * math.sqrt(2 * math.pi * frequency_hz)


@cached_while_used
def modes_up_to(plate: Plate, max_frequency_hz: float, fineness: Fineness) -> PlateModes:
    """Compute modes as `plate_modes` does, with a basis of any fineness."""
    k = _wavenumber(plate, max_frequency_hz)
    terms, largest = _terms(plate, k, fineness), largest_block(plate, max_frequency_hz, fineness)
    if largest > LARGEST_BLOCK:
        if largest_block(plate, 0.0, fineness) > LARGEST_BLOCK:
            remedy = f"It is too narrow for edges that hold it ({plate.edges}); widen it, or free its long edges."
        else:
            remedy = "Ask for a lower frequency, or use InfinitePlate, which a plate with so many modes resembles."
        raise ModelDomainError(
            f"modes up to {max_frequency_hz:g} Hz of a plate of {plate.length_m:g} × {plate.width_m:g} m need "
            f"{largest} functions in one eigenproblem; at most {LARGEST_BLOCK} are allowed. {remedy}"
        )
    warn_if_slow(plate, largest, QUICK_BLOCK, "functions in one eigenproblem")
    shift = SHIFT * max(k, math.pi / max(plate.length_m, plate.width_m)) ** 4
    # Rigid motions lie below a thousandth of the shift, and all bending modes above five times the shift.
    limit = max(k**4 * (1 + 1e-9), 1e-3 * shift)
    # No block is widened beyond the size that takes a second.
    room = max(math.sqrt(QUICK_BLOCK / largest), 1.0)
    along, across = (math.ceil(n * min(room, max(fineness.wider, fineness.least_wider / n))) for n in terms)
    wider = _paired(plate, along, across)
    nu, few, many = plate.material.poisson_ratio, _pairs(plate, terms), _pairs(plate, wider)
    blocks = []
    for own, pair in zip(few, many, strict=True):
        k4, vectors = modes_below(*own, nu, shift, limit)
        blocks.append(ModeBlock(*pair, k4, _padded(vectors, own, pair), nu, shift, max(limit, 5 * shift)))
    k4 = np.concatenate([block.k4 for block in blocks])
    block = np.concatenate([np.full(len(block.k4), i) for i, block in enumerate(blocks)])
    column = np.concatenate([np.arange(len(block.k4)) for block in blocks])
    order = np.argsort(k4, kind="stable")
    for rigid in order[: n_rigid_motions(plate)]:
        blocks[block[rigid]].k4[column[rigid]] = k4[rigid] = 0.0  # exactly, without rounding errors
    bases_x, bases_y = (tuple(dict.fromkeys(axis)) for axis in zip(*many, strict=True))
    return PlateModes(plate, bases_x, bases_y, tuple(blocks), block[order], column[order], terms)


def _terms(plate: Plate, k: float, fineness: Fineness) -> tuple[int, int]:
    """Numbers of functions along length and width, with as many even as odd ones, so that all blocks are alike."""
    k_along = max(k, _HELD_WAVE / plate.width_m) if plate.edges[2:] != "FF" else k
    k_across = max(k, _HELD_WAVE / plate.length_m) if plate.edges[:2] != "FF" else k
    return _paired(plate, _n_terms(k_along * plate.length_m, fineness), _n_terms(k_across * plate.width_m, fineness))


def _paired(plate: Plate, along: int, across: int) -> tuple[int, int]:
    is_even = (plate.edges[0] == plate.edges[1], plate.edges[2] == plate.edges[3])
    return along + (is_even[0] and along % 2), across + (is_even[1] and across % 2)


def _pairs(plate: Plate, terms: tuple[int, int]) -> list[tuple[AxisBasis, AxisBasis]]:
    """The bases of each block."""
    along = axis_bases(plate.edges[:2], plate.length_m, terms[0])
    across = axis_bases(plate.edges[2:], plate.width_m, terms[1])
    return [(x, y) for x in along for y in across]


def _padded(
    vectors: NDArray[np.float64], few: tuple[AxisBasis, AxisBasis], many: tuple[AxisBasis, AxisBasis]
) -> NDArray[np.float64]:
    """Extend vectors over products of few functions to products of many, whose first functions are the few."""
    (n_x, n_y), (more_x, more_y) = ((x.n_functions, y.n_functions) for x, y in (few, many))
    padded = np.zeros((more_x, more_y, vectors.shape[1]))
    padded[:n_x, :n_y] = vectors.reshape(n_x, n_y, -1)
    return padded.reshape(more_x * more_y, -1)


def _n_terms(k_length: float, fineness: Fineness) -> int:
    return max(fineness.least, math.ceil(fineness.per_k_length * k_length) + fineness.more)
