"""The plate without edges: a point force, the wave that spreads from it, and its decay by internal loss.

    w(r) / F = -j Pi(k_c r) / (8 D_c k_c^2)        Pi(x) = H0^(2)(x) - (2j / pi) K0(x)
    D_c = D (1 + j eta)                            k_c = k (1 + j eta)^(-1/4)

H0^(2) is the wave that travels, falling as 1/sqrt(r) and exp(-eta k r / 4); K0 the near field, gone within a
wavelength. It is the level that a large plate has on average over frequency, and what remains of any plate when its
loss is so high that nothing comes back from the edges.

Letters: w [m] deflection, F [N], r [m], k [rad/m], D [N m] bending stiffness, m [kg/m2] mass per area, eta [-] loss
factor, c complex. Time runs as e^{+j omega t}.
Source: Cremer, Heckl, Petersson, Structure-Borne Sound, point-driven plate.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from scene2hap.propagation.domain import as_frequencies, warn_if_thick
from scene2hap.propagation.plate import Plate
from scene2hap.propagation.points import as_points

NEAREST_KR = 1e-4
"""Below this kr both terms of Pi grow without bound and their difference is 1 to 1e-8: it is then set to 1."""
FARTHEST_KR = 1e8
"""The library routine for H0 gives up near 1e9; farther points answer as from here, where |Pi| is below 1e-4."""


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


@dataclass(frozen=True)
class InfinitePlate:
    """The damped Green's function of the infinite plate; length, width and edges of a plate do not matter to it."""

    kind: Literal["infinite_plate"] = "infinite_plate"

    def plate_transfer(
        self, plate: Plate, drive_m: ArrayLike, points_m: ArrayLike, frequencies_hz: ArrayLike
    ) -> NDArray[np.complex128]:
        """Amplitude at points of one plate over the amplitude at the driven point: Pi(k_c r).

        Parameters: drive_m : (2,) [m]; points_m : (n_points, 2) [m], from the plate's corner along length and width;
        frequencies_hz : (n_frequencies,) [Hz], >= 0.
        Returns: (n_points, n_frequencies) complex128 [-], at most 1 in magnitude.
        Raises: ModelDomainError: points or frequencies of another shape, or not finite.
        Warns: ThinPlateWarning: the wavelength falls below six thicknesses.
        """
        f = as_frequencies(frequencies_hz)
        warn_if_thick(plate, f)
        return _spread(plate, drive_m, points_m, f)

    def plate_receptance(
        self, plate: Plate, drive_m: ArrayLike, points_m: ArrayLike, frequencies_hz: ArrayLike
    ) -> NDArray[np.complex128]:
        """Deflection at points over the force at the driven point: -j Pi(k_c r) / (8 D_c k_c^2).

        Parameters, errors and warnings as `plate_transfer`, with frequencies above 0.
        Returns: (n_points, n_frequencies) complex128 [m/N].
        """
        f = as_frequencies(frequencies_hz, positive_because="nothing holds the infinite plate in place")
        warn_if_thick(plate, f)
        stiffness = plate.bending_stiffness_nm * (1 + 1j * plate.material.loss_factor)
        driven: NDArray[np.complex128] = -1j / (8 * stiffness * _damped_wavenumber(plate, f) ** 2)
        return _spread(plate, drive_m, points_m, f) * driven


def _damped_wavenumber(plate: Plate, frequencies_hz: NDArray[np.float64]) -> NDArray[np.complex128]:
    loss = complex(1, plate.material.loss_factor) ** -0.25
    k: NDArray[np.complex128] = (plate.wavenumber_rad_m(frequencies_hz) * loss).astype(np.complex128)
    return k


def _spread(
    plate: Plate, drive_m: ArrayLike, points_m: ArrayLike, frequencies_hz: NDArray[np.float64]
) -> NDArray[np.complex128]:
    offsets = as_points(points_m, 2) - as_points(drive_m, 2)
    r = np.hypot(offsets[:, 0], offsets[:, 1])
    return spreading(np.outer(r, _damped_wavenumber(plate, frequencies_hz)))
