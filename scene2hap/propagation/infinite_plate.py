"""The plate without edges: a point force, the wave that spreads from it, and its decay by internal loss.

    w(r) / F = -j Pi(k_c r) / (8 D_c k_c^2)        Pi(x) = H0^(2)(x) - (2j / pi) K0(x)
    D_c = D (1 + j eta)                            k_c = k (1 + j eta)^(-1/4)

H0^(2) is the travelling wave, which falls as 1/sqrt(r) and exp(-eta k r / 4). K0 is the near field, which vanishes
within a wavelength. The result is the frequency average of a large plate's level, and the response of any plate whose
loss is so high that no wave returns from the edges.

Letters: w [m] deflection, F [N], r [m], k [rad/m], D [N m] bending stiffness, m [kg/m2] mass per area, eta [-] loss
factor, c complex. Time runs as e^{+j omega t}.
Source: Cremer, Heckl, Petersson, Structure-Borne Sound, point-driven plate.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from functools import lru_cache
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from scene2hap.common.blas_threads import one_blas_thread
from scene2hap.common.calls import clear_construction
from scene2hap.propagation.coupled.contact_stiffness import ContactLaw
from scene2hap.propagation.coupled.hand import Hand
from scene2hap.propagation.coupled.rigid import RigidMotion, is_stiff
from scene2hap.propagation.domain import OutsideDomain, as_frequencies, warn_if_thick
from scene2hap.propagation.physical_model import PhysicalModel
from scene2hap.propagation.plate import Plate
from scene2hap.propagation.points import as_points

NEAREST_KR = 1e-4
"""Below this kr both terms of Pi grow without bound and their difference is 1 to 1e-8: Pi is then set to 1."""
FARTHEST_KR = 1e8
"""The library routine for H0 fails near 1e9; farther points get the value at this kr, where |Pi| is below 1e-4."""

WAVELESS_HZ = 2000.0
"""First mode above which a free plate has no waves up to 1 kHz: a rigid body is then the better model."""

_FARTHEST_M = 1e9


def point_mobility_s_kg(plate: Plate) -> float:
    """Velocity over force at the driven point of the plate without edges or loss, real and the same at all frequencies.

    Y0 = 1 / (8 sqrt(D m)) [m/s/N = s/kg].

    Source: Cremer, Heckl, Petersson, Structure-Borne Sound, point-driven plate.
    """
    m = plate.material.density_kg_m3 * plate.thickness_m
    return 1 / (8 * math.sqrt(plate.bending_stiffness_nm * m))


def spreading(kr: NDArray[np.complex128]) -> NDArray[np.complex128]:
    """Deflection at distance r over that at the driven point, Pi(kr) = H0^(2)(kr) - (2j/pi) K0(kr), with Pi(0) = 1.

    Parameters: kr : (...) complex128 [-], real part >= 0, imaginary part <= 0.
    Returns: (...) complex128 [-], finite.
    """
    from scipy.special import hankel2, kv

    size = np.abs(kr)
    near = size < NEAREST_KR
    x = np.where(near, 1.0, kr)
    x = x * np.minimum(1.0, FARTHEST_KR / np.abs(x))
    pi_of_x = hankel2(0, x) - (2j / np.pi) * kv(0, x)
    result: NDArray[np.complex128] = np.where(near, 1.0, pi_of_x)
    return result


@clear_construction
@dataclass(frozen=True)
class InfinitePlate(PhysicalModel):
    """Physical model of a plate without edges: the damped Green's function of an infinite plate.

    It ignores the length and the width of a plate, and has no resonances. In a scene, small stiff plates are rigid
    (`WAVELESS_HZ`).

    Parameters: contact : stiffness of contacts, or its settings; outside_domain : reaction to an object of a scene that
    is thicker than thin-plate theory allows (`domain.THIN_WAVELENGTHS`): "warn" once per object, "raise" or "ignore";
    hand : see `ModalPlate`.
    Raises: ConfigError: a setting out of bounds.
    """

    contact: ContactLaw = field(default_factory=ContactLaw)
    outside_domain: OutsideDomain = "warn"
    hand: Hand | None = None
    kind: Literal["infinite_plate"] = "infinite_plate"

    def elastic_body(self, plate: Plate, max_frequency_hz: float) -> InfiniteBody | RigidMotion:
        """Return a plate as a body for coupling at any frequency; a plate without waves (`WAVELESS_HZ`) is rigid."""
        if plate.edges == "FFFF" and is_stiff(plate, WAVELESS_HZ):
            return RigidMotion.of_thin(plate)
        return InfiniteBody(plate, plate.material.loss_factor)

    @one_blas_thread
    def plate_transfer(
        self, plate: Plate, drive_m: ArrayLike, points_m: ArrayLike, frequencies_hz: ArrayLike
    ) -> NDArray[np.complex128]:
        """Return the amplitude at points of one plate over that at the driven point: Pi(k_c r).

        Parameters: drive_m : (2,) [m]; points_m : (n_points, 2) [m], from the plate's corner along length and width;
        frequencies_hz : (n_frequencies,) [Hz], >= 0.
        Returns: (n_points, n_frequencies) complex128 [-], at most 1 in magnitude.
        Raises: ModelDomainError: points or frequencies of another shape, or not finite.
        Warns: ThinPlateWarning: the wavelength falls below six thicknesses.
        """
        f = as_frequencies(frequencies_hz)
        warn_if_thick(plate, f)
        return _spread(plate, drive_m, points_m, f)

    @one_blas_thread
    def plate_receptance(
        self, plate: Plate, drive_m: ArrayLike, points_m: ArrayLike, frequencies_hz: ArrayLike
    ) -> NDArray[np.complex128]:
        """Return the deflection at points over the force at the driven point: -j Pi(k_c r) / (8 D_c k_c^2).

        Parameters, errors and warnings: see `plate_transfer`; frequencies must be above 0.
        Returns: (n_points, n_frequencies) complex128 [m/N].
        """
        f = as_frequencies(frequencies_hz, positive_because="nothing holds the infinite plate in place")
        warn_if_thick(plate, f)
        return _spread(plate, drive_m, points_m, f) * _driven(plate, plate.material.loss_factor, f)


@dataclass(frozen=True, eq=False)
class InfiniteBody:
    """A plate without edges as an `ElasticBody`; without reflections, it has no resonances."""

    plate: Plate
    plate_loss: float
    loss_factor: float = math.inf

    def receptance(
        self, points_m: NDArray[np.float64], forces_m: NDArray[np.float64], frequencies_hz: NDArray[np.float64]
    ) -> NDArray[np.complex128]:
        """See `ElasticBody`."""
        r = np.linalg.norm(points_m[:, None] - forces_m, axis=2)
        k, driven = self.plate.wavenumber_rad_m(frequencies_hz), _driven(self.plate, self.plate_loss, frequencies_hz)
        answer = np.empty((len(k), *r.shape), dtype=np.complex128)
        # A few frequencies at a time: the steps between take several times the memory of the answer.
        step = max(1, AT_ONCE // max(1, r.size))
        for begin in range(0, len(k), step):
            part = slice(begin, begin + step)
            np.multiply(
                _looked_up(k[part, None, None] * r, self.plate_loss), driven[part, None, None], out=answer[part]
            )
        return answer


AT_ONCE = 65_536
"""Values that are looked up at once, 1 MB."""
TABLE_X = 100.0
"""k r up to which `_looked_up` has a table."""


def _looked_up(x: NDArray[np.float64], eta: float) -> NDArray[np.complex128]:
    """Interpolate Pi(k_c r) at x = k r from a table, to 1e-4: a scene needs millions of values, and a Hankel function
    takes a microsecond."""
    ray = complex(1, eta) ** -0.25
    # Without its phase and decay, Pi is smooth.
    spread: NDArray[np.complex128] = np.interp(x, *_table(eta)) * np.exp(-1j * ray * x)
    far = x > TABLE_X
    spread[far] = spreading((ray * x[far]).astype(np.complex128))
    return spread


@lru_cache(maxsize=64)
def _table(eta: float) -> tuple[NDArray[np.float64], NDArray[np.complex128]]:
    # Pi has the highest curvature near 0, and less and less where it falls as 1 / sqrt(x).
    ray, x = complex(1, eta) ** -0.25, np.concatenate([np.linspace(0.0, 1.0, 200), np.geomspace(1.0, TABLE_X, 800)[1:]])
    return x, spreading((ray * x).astype(np.complex128)) * np.exp(1j * ray * x)


def _driven(plate: Plate, eta: float, frequencies_hz: NDArray[np.float64]) -> NDArray[np.complex128]:
    stiffness = plate.bending_stiffness_nm * complex(1, eta)
    driven: NDArray[np.complex128] = -1j / (8 * stiffness * _damped_wavenumber(plate, eta, frequencies_hz) ** 2)
    return driven


def _damped_wavenumber(plate: Plate, eta: float, frequencies_hz: NDArray[np.float64]) -> NDArray[np.complex128]:
    loss = complex(1, eta) ** -0.25
    k: NDArray[np.complex128] = (plate.wavenumber_rad_m(frequencies_hz) * loss).astype(np.complex128)
    return k


def _spread(
    plate: Plate, drive_m: ArrayLike, points_m: ArrayLike, frequencies_hz: NDArray[np.float64]
) -> NDArray[np.complex128]:
    # Beyond this distance the wave has vanished; the limit keeps squares of distances finite.
    offsets = np.clip(as_points(points_m, 2) - as_points(drive_m, 2), -_FARTHEST_M, _FARTHEST_M)
    r = np.hypot(offsets[:, 0], offsets[:, 1])
    return spreading(np.outer(r, _damped_wavenumber(plate, plate.material.loss_factor, frequencies_hz)))
