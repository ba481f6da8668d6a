"""The receptance of a plate without edges, or without edges above a frequency.

A wave spreads from a point force, and decays by loss:

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
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from scene2hap.common.arrays import Complex, Floats
from scene2hap.propagation.elastic_body import DeflectionFunction, ElasticBody, contracted
from scene2hap.propagation.plate import Plate

NEAREST_KR = 1e-4
"""Below this kr both terms of Pi grow without bound and their difference is 1 to 1e-8: Pi is then set to 1."""
FARTHEST_KR = 1e8
"""The library routine for H0 fails near 1e9; farther points get the value at this kr, where |Pi| is below 1e-4."""

AT_ONCE = 65_536
"""Values that are looked up at once, 1 MB."""
TABLE_X = 100.0
"""k r up to which `_looked_up` has a table."""


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
        k = self.plate.wavenumber_rad_m(frequencies_hz)
        driven = point_receptance_m_n(self.plate, self.plate_loss, frequencies_hz)
        answer = np.empty((len(k), *r.shape), dtype=np.complex128)
        # A few frequencies at a time: the steps between take several times the memory of the answer.
        step = max(1, AT_ONCE // max(1, r.size))
        for begin in range(0, len(k), step):
            part = slice(begin, begin + step)
            np.multiply(
                _looked_up(k[part, None, None] * r, self.plate_loss), driven[part, None, None], out=answer[part]
            )
        return answer


@dataclass(frozen=True, eq=False)
class SplitBody:
    """An `ElasticBody` that has edges up to `limit_hz` and is infinite above it."""

    below: ElasticBody
    above: InfiniteBody
    limit_hz: float

    @property
    def nbytes(self) -> int:
        """Memory of the body below the limit [byte], 0 if it has no known size."""
        return int(getattr(self.below, "nbytes", 0))

    @property
    def loss_factor(self) -> float:
        """See `ElasticBody`."""
        return self.below.loss_factor

    def receptance(self, points_m: Floats, forces_m: Floats, frequencies_hz: Floats) -> Complex:
        """See `ElasticBody`."""
        is_low = frequencies_hz <= self.limit_hz
        answer = np.empty((len(is_low), len(points_m), len(forces_m)), dtype=np.complex128)
        answer[is_low] = self.below.receptance(points_m, forces_m, frequencies_hz[is_low])
        answer[~is_low] = self.above.receptance(points_m, forces_m, frequencies_hz[~is_low])
        return answer

    def under(self, forces_m: Floats, frequencies_hz: Floats, forces: Complex) -> DeflectionFunction:
        """See `Contractible`."""
        is_low = frequencies_hz <= self.limit_hz
        low = contracted(self.below, forces_m, frequencies_hz[is_low], forces[:, is_low])
        high = contracted(self.above, forces_m, frequencies_hz[~is_low], forces[:, ~is_low])

        def both(points_m: Floats) -> Floats:
            answer = np.empty((len(points_m), len(is_low)), dtype=np.complex128)
            answer[:, is_low], answer[:, ~is_low] = (one(points_m).view(np.complex128) for one in (low, high))
            return answer.view(np.float64)

        return both


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


def point_receptance_m_n(plate: Plate, eta: float, frequencies_hz: NDArray[np.float64]) -> NDArray[np.complex128]:
    """Receptance at the driven point, -j / (8 D_c k_c^2) (n_frequencies,) [m/N]."""
    stiffness = plate.bending_stiffness_nm * complex(1, eta)
    driven: NDArray[np.complex128] = -1j / (8 * stiffness * damped_wavenumber_rad_m(plate, eta, frequencies_hz) ** 2)
    return driven


def damped_wavenumber_rad_m(plate: Plate, eta: float, frequencies_hz: NDArray[np.float64]) -> NDArray[np.complex128]:
    """k_c (n_frequencies,) [rad/m]."""
    loss = complex(1, eta) ** -0.25
    k: NDArray[np.complex128] = (plate.wavenumber_rad_m(frequencies_hz) * loss).astype(np.complex128)
    return k


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
