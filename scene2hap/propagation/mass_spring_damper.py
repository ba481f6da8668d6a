"""A plate as a lattice of masses, springs and dampers: its response to harmonic forces, and its motion in time.

    w(x) / F(x0) = P(x) (K D (1 + j eta) - omega^2 m A)^-1 P(x0)^T

K and A are the stiffness and mass matrices of `lattice`, P its interpolation. The lattice assumes nothing about shapes,
so it follows outlines that are not rectangles: round tops, an L, a cut-out for a sink. On rectangles it checks
`ModalPlate` by an independent method, at a higher cost. Its error falls as the fourth power of the cell size.

Letters: w [m], F [N], D [N m] bending stiffness, m [kg/m2] mass per area, eta [-] loss factor, k_c [rad/m] damped
wavenumber, k_c^4 = m omega^2 / (D (1 + j eta)). Time runs as e^{+j omega t}.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import lru_cache
from itertools import count
from typing import TYPE_CHECKING, ClassVar, Literal

import numpy as np
from numpy.polynomial.polynomial import polyval
from numpy.typing import ArrayLike, NDArray

from scene2hap.common import checks
from scene2hap.common.arrays import floats
from scene2hap.common.calls import clear_construction
from scene2hap.common.warning import warn_of
from scene2hap.errors import ConfigError, ModelDomainError
from scene2hap.propagation.bodies.infinite_body import InfiniteBody, SplitBody
from scene2hap.propagation.bodies.lattice_body import lattice_body
from scene2hap.propagation.coupled.contact_stiffness import ContactLaw, GivenLaw
from scene2hap.propagation.coupled.hand import GivenHand, Hand
from scene2hap.propagation.domain import OutsideDomain, as_frequencies, floored_loss, off_zero, warn_if_thick
from scene2hap.propagation.elastic_body import ElasticBody
from scene2hap.propagation.lattice.bending_lattice import LONGEST, MOST_NODES, n_nodes_of, narrow_side_m
from scene2hap.propagation.lattice.lattice_modes import (
    LatticeModes,
    is_too_much,
    lattice_modes,
    lowest_frequencies_hz,
    n_modes_up_to,
)
from scene2hap.propagation.lattice.stepping import ExactStepper, NewmarkStepper, State, Stepper
from scene2hap.propagation.physical_model import PhysicalModel
from scene2hap.propagation.plate import Plate
from scene2hap.propagation.points import points_on

CELLS_PER_WAVE = 4.0
"""Fewest cells in a bending wavelength; with four, the lattice turns it 0.7 % too fast."""
FINEST = 256
"""Most cells along the narrow side: a square plate then has two thirds of `MOST_NODES`."""
LEAST_LIMIT_HZ = 1.0
"""Vibration below this frequency is not felt, so a lattice with a lower limit is of no use: the plate has no edges."""


class CoarsenedWarning(UserWarning):
    """A plate's lattice is too large to be solved in seconds; it is used up to some frequency only."""


@clear_construction
@dataclass(frozen=True)
class MassSpringDamper(PhysicalModel):
    """Physical model of a plate as a lattice in bending, within any outline; it can be stepped in time.

    Parameters: resolution : fewest cells along the shorter side, 4..256; a plate whose waves are shorter than
    `CELLS_PER_WAVE` cells gets as many as the waves need; loss_floor, contact, outside_domain, hand : see `ModalPlate`.
    Raises: ConfigError: a setting out of bounds.
    """

    resolution: int = 8
    loss_floor: float = 0.01
    contact: ContactLaw = field(default_factory=ContactLaw)
    outside_domain: OutsideDomain = "warn"
    hand: Hand | None = None
    kind: Literal["mass_spring_damper"] = "mass_spring_damper"
    follows_outlines: ClassVar[bool] = True

    if TYPE_CHECKING:

        def __init__(
            self,
            resolution: int = 8,
            loss_floor: float = 0.01,
            contact: GivenLaw = ...,
            outside_domain: OutsideDomain = "warn",
            hand: GivenHand = None,
            kind: Literal["mass_spring_damper"] = "mass_spring_damper",
        ) -> None: ...

    def __post_init__(self) -> None:
        cells = checks.whole("resolution", self.resolution, "cells", at_least=4, at_most=FINEST, error=ConfigError)
        object.__setattr__(self, "resolution", cells)
        super().__post_init__()

    def elastic_body(self, plate: Plate, max_frequency_hz: float) -> ElasticBody:
        """Return a plate as a body for coupling up to `max_frequency_hz` [Hz]; see `lattice_body`.

        A lattice may need more cells, nodes or modes than can be solved in seconds, such as a rug's. The body is then a
        `SplitBody`: a lattice up to the highest possible frequency, and a plate without edges above it. A plate with
        too many modes at `LEAST_LIMIT_HZ`, such as a carpet, has no edges at any frequency.
        Raises: ModelDomainError: the lattice takes too many nodes at any frequency, or `outside_domain` is "raise" and
        the plate is coarsened. Warns: CoarsenedWarning, otherwise.
        """
        eta, limit_hz = floored_loss(plate, self.loss_floor), max_frequency_hz
        while self._is_too_much(plate, limit_hz) and limit_hz > LEAST_LIMIT_HZ:
            limit_hz *= 0.9
        is_coarsened = limit_hz < max_frequency_hz
        if is_coarsened and self.outside_domain == "raise":
            raise ModelDomainError(_coarsened(plate, max_frequency_hz, limit_hz))
        resolution = max(self.resolution, min(_needed_resolution(plate, limit_hz), FINEST))
        if not is_coarsened:
            return lattice_body(plate, resolution, limit_hz, eta)
        has_edges = limit_hz > LEAST_LIMIT_HZ or n_nodes_of(plate, self.resolution) > MOST_NODES
        edgeless = InfiniteBody(plate, eta)
        body = SplitBody(lattice_body(plate, resolution, limit_hz, eta), edgeless, limit_hz) if has_edges else edgeless
        if self.outside_domain == "warn":
            _warn_coarsened(plate, max_frequency_hz, limit_hz if has_edges else 0.0)
        return body

    def _is_too_much(self, plate: Plate, frequency_hz: float) -> bool:
        needed = _needed_resolution(plate, frequency_hz)
        return needed > FINEST or is_too_much(plate, max(self.resolution, needed), frequency_hz)

    def natural_frequencies_hz(self, plate: Plate, n_modes: int) -> NDArray[np.float64]:
        """Return the lattice's lowest natural frequencies (n_modes,) float64 [Hz], rising, 0 for rigid motions.

        Their error falls as the fourth power of the cell size; at a resolution of 8 the first six are within 0.4 %.
        """
        count = checks.whole("n_modes", n_modes, "-", at_least=1, at_most=MOST_NODES, error=ModelDomainError)
        return lowest_frequencies_hz(plate, self.resolution, count)

    def plate_motion(
        self,
        plate: Plate,
        drive_m: ArrayLike,
        points_m: ArrayLike,
        force_n: ArrayLike,
        sample_rate_hz: float,
        *,
        max_frequency_hz: float = 1000.0,
        stepper: Literal["exact", "newmark"] = "exact",
    ) -> NDArray[np.float64]:
        """Compute the deflection in time under a force at the driven point, from rest.

        Modes up to `max_frequency_hz` are stepped with viscous damping of ratio eta/2 (`stepping`), which may be 0.
        Higher modes follow the force without delay.

        Parameters: force_n : (n_samples,) [N], linear between samples; see `plate_transfer` for the others.
        Returns: (n_points, n_samples) float64 [m]; the first sample has the static response of the higher modes only.
        """
        force = floats("force_n", force_n, "N", error=ModelDomainError)
        if force.ndim != 1:
            raise ModelDomainError(f"force_n has shape {force.shape}; it must be (n_samples,) [N].")
        if not np.isfinite(force).all():
            first = np.flatnonzero(~np.isfinite(force))[0]
            raise ModelDomainError(f"force_n[{first}] is {force[first]:g} N; it must be finite [N].")
        rate = checks.number("sample_rate_hz", sample_rate_hz, "Hz", above=0.0, error=ModelDomainError)
        drive, points = points_on(plate, drive_m), points_on(plate, points_m)
        top = as_frequencies(max_frequency_hz)
        if len(top) != 1:
            raise ModelDomainError(f"max_frequency_hz has {len(top)} values; it must be one number [Hz].")
        warn_if_thick(plate, top)
        modes = lattice_modes(plate, self._fine_enough(plate, top), float(top[0]))
        lattice, m = modes.lattice, plate.material.density_kg_m3 * plate.thickness_m
        pushed = lattice.interpolation(drive).T.toarray()
        look = lattice.interpolation(points)
        shapes = modes.shapes / math.sqrt(m)
        push, seen = (shapes.T @ pushed)[:, 0], look @ shapes
        stiffer = np.asarray(polyval(modes.shift_k4, modes.stiffer(pushed)[:, :, 0]))
        static = (look @ stiffer) / plate.bending_stiffness_nm

        walk = self._stepper(plate, modes, 1 / rate, stepper)
        state = State(np.zeros(len(push)), np.zeros(len(push)))
        motion = np.outer(static, force)
        for i in range(1, len(force)):
            state = walk.step(state, push * force[i - 1], push * force[i])
            motion[:, i] += seen @ state.displacement
        return motion

    def _stepper(self, plate: Plate, modes: LatticeModes, dt_s: float, kind: str) -> Stepper:
        omega, zeta = 2 * math.pi * modes.frequencies_hz, max(plate.material.loss_factor, self.loss_floor) / 2
        if kind == "exact":
            return ExactStepper(omega, zeta, dt_s)
        if kind == "newmark":
            return NewmarkStepper(np.ones_like(omega), 2 * zeta * omega, omega**2, dt_s)
        raise ConfigError(f"stepper is {kind!r}; it must be 'exact' or 'newmark'.")

    def _receptance(
        self, plate: Plate, drive_m: NDArray[np.float64], points_m: NDArray[np.float64], f: NDArray[np.float64]
    ) -> NDArray[np.complex128]:
        f = off_zero(plate, f)
        eta = floored_loss(plate, self.loss_floor)
        body = lattice_body(plate, self._fine_enough(plate, f), float(f.max(initial=0.0)), eta)
        found: NDArray[np.complex128] = body.receptance(points_m, drive_m, f)[:, :, 0].T
        return found

    def _fine_enough(self, plate: Plate, f: NDArray[np.float64]) -> int:
        """Resolution for these frequencies; raises an error above `FINEST`."""
        top = float(f.max(initial=0.0))
        needed = _needed_resolution(plate, top)
        if needed > FINEST:
            raise ModelDomainError(_too_fine(plate, top, needed))
        return max(self.resolution, needed)


def _needed_resolution(plate: Plate, frequency_hz: float) -> int:
    """Cells along the shorter side that give `CELLS_PER_WAVE` cells per wavelength, at most a thousand million."""
    widest = max(narrow_side_m(plate), max(plate.extent_m) / LONGEST)
    waves = float(plate.wavenumber_rad_m(frequency_hz)) / (2 * math.pi) * widest
    return math.ceil(min(CELLS_PER_WAVE * waves, 1e9))


def _too_fine(plate: Plate, frequency_hz: float, needed: int) -> str:
    length, width = plate.extent_m
    return (
        f"{frequency_hz:g} Hz makes waves of {2e3 * math.pi / float(plate.wavenumber_rad_m(frequency_hz)):.3g} mm on a "
        f"plate of {length:g} × {width:g} m, which take a lattice of resolution {needed}; at most {FINEST} is solved. "
        "Lower the frequency, or use ModalPlate or InfinitePlate."
    )


def _coarsened(plate: Plate, max_frequency_hz: float, limit_hz: float) -> str:
    return (
        f"a plate of {plate.length_m:g} × {plate.width_m:g} m of {1e3 * plate.thickness_m:g} mm {plate.material.name} "
        f"has some {n_modes_up_to(plate, max_frequency_hz):,.0f} modes up to {max_frequency_hz:.0f} Hz, too many for "
        f"masses and springs: above {limit_hz:.3g} Hz it bends as if it had no edges. ModalPlate and AutoFidelity are "
        "made for it."
    )


@lru_cache(maxsize=4096)
def _times_coarsened(plate: Plate) -> Iterator[int]:
    """A counter for each plate."""
    return count()


def _warn_coarsened(plate: Plate, max_frequency_hz: float, limit_hz: float) -> None:
    """Warn of a plate once, whatever the highest frequency."""
    if next(_times_coarsened(plate)) == 0:
        warn_of(_coarsened(plate, max_frequency_hz, limit_hz), CoarsenedWarning)
