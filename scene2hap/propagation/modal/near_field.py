"""The part of a force's near field on a plate that a polynomial basis cannot represent.

Around a driven point lies a dimple narrower than the distance 1/K between the zeros of a polynomial basis. It is taken
from the infinite plate, without wavenumbers below K (derived here):

    residual = 1 / (2 pi D_c) integral from K to infinity of J0(kappa r) kappa / (kappa^4 - k_c^4) d kappa
             ~ g(K r) artanh(k_c^2 / K^2) / (4 pi D_c k_c^2)      g(a) = 2 integral from 1 to infinity of J0(a t) / t^3

together with its mirror images in the edges. Contacts are coupled by receptances at the driven point itself, where the
residual matters most: the p95 error there is 0.5 to 2 dB without the residual and 0.05 to 0.3 dB with it. Errors of
several dB remain where the plate hardly moves: within 4 % of the plate from a clamped edge, or a tenth from a clamped
corner.

An axis of length L has four images including the force, so that they cancel in pairs at a held edge. Their distances
from a point at x are symmetric in x and the force's x0:

    r = |x - x0|, x + x0, 2 L - x - x0, 2 L - |x - x0|        weights 1, w_0, w_L, w_0 w_L

The last image is left out between two free edges, where nothing has to cancel. K between two points is the larger K of
both: the basis resolves higher wavenumbers at neither point. The near field is then passive: a wave of wavenumber kappa
contributes J0(kappa r) between points with K below kappa, and 0 elsewhere. This matrix has no negative eigenvalues
(Bochner's theorem), and its weight is kappa / (kappa^4 - k_c^4). Images farther than 2 L, and weights above 1 at free
edges, are exceptions.

Letters: D [N m], k [rad/m], K [rad/m] cut-off of the basis, r [m], c complex.
"""

from __future__ import annotations

import math
from functools import lru_cache
from typing import Any, TypeVar, cast

import numpy as np
from numpy.typing import NDArray

from scene2hap.common.arrays import Floats
from scene2hap.compiled import compiled
from scene2hap.propagation.modal.modes import PlateModes
from scene2hap.propagation.plate import Plate

_Extent = tuple[float, float, float, float]

Number = TypeVar("Number", np.float64, np.complex128)

_HELD_IMAGE = -1.0
"""Weight of the near field's mirror image in a held edge, which cancels the near field: exact if it is supported, an
approximation if it is clamped."""
_FREE_SHARE = 0.8
"""Weight of the image in a free edge, over its weight for a force on the edge itself. Tuned: for a force and a
point 1 / kappa inside the edge, the exact weight is already 1.1. Receptances near free edges then have two thirds of
the error that they have with a weight of 1.29 (oak: 0.023 instead of 0.034 dB at the 95th percentile)."""


FAR = 20.0
"""Argument a beyond which g(a) is left out: it is below 0.02 there, and distant edges would otherwise contribute."""
_N_PIECES = 4096
"""Intervals of the `table` of g: their number gives its error, 1e-6."""


class NearField:
    """The residual of forces at given points: the deflection, for D_c = 1, beyond the basis of `modes`.

    Parameters: drive_m : (n_drives, 2) [m].
    """

    def __init__(self, modes: PlateModes, drive_m: Floats) -> None:
        plate = modes.plate
        nu = plate.material.poisson_ratio
        weights = _weights(plate.edges[:2], nu), _weights(plate.edges[2:], nu)
        extent = _extent(plate, modes.terms)
        self.dimples: Dimples = Dimples(drive_m, *weights, _cutoffs_squared(drive_m, extent), extent, table())

    def __call__(self, points_m: Floats, k2: NDArray[Number]) -> NDArray[Number]:
        """Residual at points (n_points, 2) [m] for k2 = k_c^2 (n_frequencies,) [m^-2], complex or real, 0 < |k2| < K^2.

        Returns: (n_points, n_drives, n_frequencies) [m^2], complex or real as k2, symmetric in point and force.
        """
        if np.isrealobj(k2):
            near: NDArray[Number] = cast("Any", self.dimples.near(points_m, k2.real))
            return near
        return _beyond(k2, *self.dimples.at(points_m))


def _beyond(k2: NDArray[Number], shares: Floats, cut2: Floats) -> NDArray[Number]:
    """Near field (n_points, n_drives, n_frequencies) from `shares` and K^2, both (n_points, n_drives)."""
    near: NDArray[Number] = np.arctanh(k2 / cut2[:, :, None])
    near *= shares[:, :, None]
    near /= 4 * np.pi * k2
    return near


@compiled
class Dimples:
    """Near fields of forces and of their mirror images, evaluated at points.

    Parameters: drive_m : (n_drives, 2) [m]; x_weights, y_weights : (4,) weights of the images along each axis; cut2 :
    (n_drives,) K^2 at the forces; extent : see `_extent`; pieces : see `table`.
    """

    def __init__(
        self,
        drive_m: Floats,
        x_weights: Floats,
        y_weights: Floats,
        cut2: Floats,
        extent: _Extent,
        pieces: Floats,
    ) -> None:
        self._drive_m, self._cut2, self._extent, self._pieces = drive_m, cut2, extent, pieces
        self._weights = np.outer(x_weights, y_weights).ravel()

    def at(self, points_m: Floats) -> tuple[Floats, Floats]:
        """Sum of g(K r) over images, and K^2 [m^-2], both (n_points, n_drives), at points (n_points, 2) [m]."""
        cut2 = np.maximum(_cutoffs_squared(points_m, self._extent)[:, None], self._cut2)
        per_length, per_width = self._extent[:2]
        x = _separations(points_m[:, :1], self._drive_m[:, 0], 2 / per_length)
        y = _separations(points_m[:, 1:], self._drive_m[:, 1], 2 / per_width)
        driven = (x[:, :, 0] == 0.0) & (y[:, :, 0] == 0.0)
        a2 = (x**2)[:, :, :, None] + (y**2)[:, :, None, :]
        a2 *= cut2[:, :, None, None]
        shares = beyond_cutoff_of_square(a2.reshape(*cut2.shape, 16), self._pieces) @ self._weights
        # Beside a held edge, images cancel a little too much; but a driven point never moves against its force.
        shares[driven] = np.maximum(shares[driven], 0.0)
        return shares, cut2

    def near(self, points_m: Floats, k2: Floats) -> Floats:
        """See `NearField`, for real k2."""
        return _beyond(k2, *self.at(points_m))


def _separations(x_m: Floats, drive_m: Floats, length_m: float) -> Floats:
    """Distances (..., 4) [m] from a force and its three images to points along one axis; see the module docstring."""
    apart, sum_m = np.abs(x_m - drive_m), x_m + drive_m
    return np.stack([apart, sum_m, 2 * length_m - sum_m, 2 * length_m - apart], axis=-1)


def _weights(edges: str, poisson_ratio: float) -> Floats:
    """Weights (4,) of these images, for the two edges of an axis."""
    free = _FREE_SHARE * (free_edge_gain(poisson_ratio) - 1)
    first, last = (free if edge == "F" else _HELD_IMAGE for edge in edges)
    return np.array([1.0, first, last, 0.0 if edges == "FF" else first * last])


def free_edge_gain(poisson_ratio: float) -> float:
    """Near field of a force on the free edge of a half plate, over that of a force inside [-].

        8 / ((1 - nu) (3 + nu))                   3.5 for nu = 0.3

    Derived here, for a deflection (a + b y) exp(-kappa y) cos(kappa x) at a distance y from the edge. Far below
    kappa the plate is static. Without bending moment on the edge, b = (1 - nu) kappa a / 2. The shear force, with that
    of the twisting moment, is D kappa^3 a (1 - nu) (3 + nu) / 2, and that of a line inside is 4 D kappa^3 a.
    """
    return 8 / ((1 - poisson_ratio) * (3 + poisson_ratio))


def beyond_cutoff_of_square(a2: Floats, pieces: Floats) -> Floats:
    """Interpolate g(a) at a^2 from a `table` of it, to 1e-6. Overwrites `a2`.

    numpy's interp is not used, since it releases the interpreter's lock: a game's thread that queries beside a worker
    would wait 5 ms for the lock.
    """
    t = np.sqrt(a2, out=a2)
    np.sqrt(t, out=t)
    t *= _N_PIECES / math.sqrt(FAR)
    piece = np.minimum(t, _N_PIECES).astype(np.intp)
    t -= piece
    t *= pieces[:, 1].take(piece)
    t += pieces[:, 0].take(piece)
    return t


@lru_cache(maxsize=1)
def table() -> Floats:
    """Values of g, evenly spaced in the root of a, in which g is smooth, and steps to the next value (n_pieces + 1, 2).
    The last of both is 0."""
    values = beyond_cutoff(FAR * (np.arange(_N_PIECES + 1) / _N_PIECES) ** 2)
    steps = np.append(np.diff(values), 0.0)
    values[-1] = 0.0
    return np.stack([values, steps], axis=1)


def _cutoffs_squared(points_m: Floats, extent: _Extent) -> Floats:
    """K^2 at points: K is the wavenumber above which the basis resolves nothing, as the radius of an equivalent circle.

    Polynomials of degree below n on a length L resolve waves up to n / sqrt(1 - xi^2) * 2 / L on each axis, which makes
    a rectangle of wavenumbers. The circle of radius K has the same integral of 1 / kappa^4 over wavenumbers outside it.
    Minimum energy fits the curvature, whose degree is that of the deflection, factors p and q included, less two.

    Parameters: points_m : (n_points, 2) [m]. Returns: (n_points,) float64 [m^-2], very large at the edges.
    """
    return np.array([_cutoff_squared(x, y, *extent) for x, y in points_m.tolist()])


def _cutoff_squared(x_m: float, y_m: float, per_length: float, per_width: float, kx: float, ky: float) -> float:
    # Scalars instead of arrays: a hand touches one point, for which an array costs as much as for ten points.
    xi, eta = x_m * per_length - 1, y_m * per_width - 1
    kx /= math.sqrt(max(1 - xi * xi, 1e-30))
    ky /= math.sqrt(max(1 - eta * eta, 1e-30))
    corner, half = math.atan2(ky, kx), kx * ky / (kx * kx + ky * ky)
    return math.pi / ((corner + half) / (kx * kx) + (math.pi / 2 - corner + half) / (ky * ky))


@lru_cache(maxsize=1024)
def _extent(plate: Plate, terms: tuple[int, int]) -> _Extent:
    """2 over length and width [1/m], and the highest wavenumbers that `terms` resolve in the middle of each [rad/m]."""
    along, across = (sum("FSC".index(edge) for edge in pair) for pair in (plate.edges[:2], plate.edges[2:]))
    per_length, per_width = 2 / plate.length_m, 2 / plate.width_m
    kx, ky = (terms[0] + along - 2) * per_length, (terms[1] + across - 2) * per_width
    return per_length, per_width, kx, ky


def beyond_cutoff(a: Floats) -> Floats:
    """g(a) = 2 integral from 1 to infinity of J0(a t) / t^3 dt = J0(a) - (a J1(a) + a^2 C(a)) / 2, with C(a) the
    integral of J0(u) / u from a; faded to 0 over the last unit before `FAR`, so that rounding there has no effect."""
    from scipy.special import it2j0y0, j0, j1

    near = np.clip(FAR - a, 0.0, 1.0)
    a = np.clip(a, 1e-9, FAR)
    c = it2j0y0(a)[0] - np.log(a / 2) - np.euler_gamma
    g: Floats = near * (j0(a) - (a * j1(a) + a**2 * c) / 2)
    return g
