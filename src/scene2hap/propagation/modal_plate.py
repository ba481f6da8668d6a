"""The plate with edges: its modes, each a resonance, and the near field that they leave out.

    w(x) / F(x0) = sum over the Ritz spectrum of phi(x) phi(x0) / (D_c (k_n^4 - k_c^4))  +  residual(x, x0)
    D_c = D (1 + j eta)                  k_c^4 = k^4 / (1 + j eta)

The spectrum of `modes` is summed to its end: modes up to 1.5 times the top frequency are true, and the rest, too stiff
to resonate, make up their static share. What polynomials cannot follow at all is a dimple around the driven point,
narrower than the distance 1/K between their zeros; it is taken from the infinite plate, cut off below K (derived here):

    residual = 1 / (2 pi D_c) integral from K to infinity of J0(kappa r) kappa / (kappa^4 - k_c^4) d kappa
             ~ g(K r) artanh(k_c^2 / K^2) / (4 pi D_c k_c^2)      g(a) = 2 integral from 1 to infinity of J0(a t) / t^3

together with its mirror images in the edges. Contacts are coupled by receptances at the driven point itself, where it
matters most: without it the p95 error there is 0.5 to 2 dB, with it 0.05 to 0.3 dB. Nearer to a clamped edge than 4 %
of the plate, or to a clamped corner than a tenth, where hardly anything moves, errors of several dB remain.

Letters: phi [1/m] shape normalised over the area, D [N m], k [rad/m], K [rad/m] cut-off of the basis, eta [-] loss
factor, r [m], c complex. Time runs as e^{+j omega t}.
Source: Cremer, Heckl, Petersson, Structure-Borne Sound, for the modal sum and complex stiffness.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from scene2hap import checks
from scene2hap.errors import ConfigError, ModelDomainError
from scene2hap.propagation.domain import as_frequencies, warn_if_thick
from scene2hap.propagation.modes import PlateModes, n_rigid_motions, plate_modes, points_on
from scene2hap.propagation.plate import Plate

MARGIN = 1.5
"""Modes are solved up to this many times the top frequency. Tuned: 2 halves the remaining error at twice the time."""

IMAGE = {"F": 8 / 3.5 - 1, "S": -1.0, "C": -1.0}
"""Weight of a near field mirrored in an edge: one that holds takes all of it away; at a free one the edge of a half
plate moves 8/3.5 times as much as the inside. Exact for S, an approximation otherwise."""


@dataclass(frozen=True)
class ModalPlate:
    """The finite plate as a sum over its modes.

    Parameters: loss_floor : 0..2 [-], smallest loss factor of a plate. Tables give the loss of the bare material, 1e-4
    for a metal, while joints and supports bring assembled objects to 0.005-0.02; the default 0.01 lies between.
    Raises: ConfigError: it is outside its bounds.
    """

    loss_floor: float = 0.01
    kind: Literal["modal_plate"] = "modal_plate"

    def __post_init__(self) -> None:
        checks.number("loss_floor", self.loss_floor, "-", at_least=0.0, at_most=2.0, error=ConfigError)

    def plate_transfer(
        self, plate: Plate, drive_m: ArrayLike, points_m: ArrayLike, frequencies_hz: ArrayLike
    ) -> NDArray[np.complex128]:
        """Amplitude at points of one plate over the amplitude at the driven point; above 1 where the plate resonates.

        Parameters: drive_m : (2,) [m]; points_m : (n_points, 2) [m], from the plate's corner along length and width;
        frequencies_hz : (n_frequencies,) [Hz], >= 0; 0 is answered as a limit.
        Returns: (n_points, n_frequencies) complex128 [-].
        Raises: ModelDomainError: a point outside the plate; a driven point on an edge that holds it still; too many
        modes (`plate_modes`); no loss at all, since a resonance is then infinite.
        Warns: ThinPlateWarning: the wavelength falls below six thicknesses.
        """
        f = as_frequencies(frequencies_hz)
        warn_if_thick(plate, f)
        drive = points_on(plate, drive_m)
        if _held(plate, drive):
            raise ModelDomainError(
                f"the driven point ({drive[0, 0]:g}, {drive[0, 1]:g}) m lies on an edge that does not move (boundary "
                f"{plate.boundary!r}), so nothing can be related to its amplitude. Drive a point off the edge."
            )
        driven = self._receptance(plate, drive, drive, f)
        ratio: NDArray[np.complex128] = self._receptance(plate, drive, points_on(plate, points_m), f) / driven
        return ratio

    def plate_receptance(
        self, plate: Plate, drive_m: ArrayLike, points_m: ArrayLike, frequencies_hz: ArrayLike
    ) -> NDArray[np.complex128]:
        """Deflection at points over the force at the driven point.

        Parameters, errors and warnings as `plate_transfer`, but that a held point answers 0, and that 0 Hz is refused
        for a plate that nothing holds in place.
        Returns: (n_points, n_frequencies) complex128 [m/N].
        """
        loose = "nothing holds this plate in place" if n_rigid_motions(plate) else ""
        f = as_frequencies(frequencies_hz, positive_because=loose)
        warn_if_thick(plate, f)
        return self._receptance(plate, points_on(plate, drive_m), points_on(plate, points_m), f)

    def _receptance(
        self, plate: Plate, drive_m: NDArray[np.float64], points_m: NDArray[np.float64], f: NDArray[np.float64]
    ) -> NDArray[np.complex128]:
        eta = max(plate.material.loss_factor, self.loss_floor)
        if eta == 0:
            raise ModelDomainError(
                f"material {plate.material.name!r} has a loss factor of 0 and so has loss_floor; a resonance would be "
                "infinite. Give one of them a value above 0; 0.01 suits assembled objects."
            )
        top = float(f.max(initial=0.0))
        modes = plate_modes(plate, max_frequency_hz=MARGIN * top)
        # 1e-9 of the top frequency stands for 0 Hz, where a loose plate has a limit but no value.
        k2 = plate.wavenumber_rad_m(np.maximum(f, max(1e-9 * top, 1e-9))) ** 2 / np.sqrt(1 + 1j * eta)
        total = residual(modes, drive_m, points_m, k2)
        for block in modes.blocks:
            weights = block.deflections(points_m) * block.deflections(drive_m)
            total += weights @ (1 / (block.k4[:, None] - k2**2))
        return total / (plate.bending_stiffness_nm * (1 + 1j * eta))


def residual(
    modes: PlateModes, drive_m: NDArray[np.float64], points_m: NDArray[np.float64], k2: NDArray[np.complex128]
) -> NDArray[np.complex128]:
    """Deflection, for D_c = 1, that lies beyond the basis of `modes`: see the top of this module.

    Parameters: drive_m : (1, 2) [m]; points_m : (n_points, 2) [m]; k2 : (n_frequencies,) k_c^2 [m^-2], |k2| < K^2.
    Returns: (n_points, n_frequencies) complex128 [m^2], symmetric in its two points.
    """
    cut2 = np.sqrt(cutoff_squared(modes, points_m) * cutoff_squared(modes, drive_m))
    near: NDArray[np.complex128] = np.arctanh(k2 / cut2[:, None]) / (4 * np.pi * k2)
    share = np.zeros(len(points_m))
    (x, y), edges = drive_m[0], modes.plate.edges
    for x_image, x_weight in _images(x, modes.plate.length_m, edges[:2]):
        for y_image, y_weight in _images(y, modes.plate.width_m, edges[2:]):
            r = np.hypot(points_m[:, 0] - x_image, points_m[:, 1] - y_image)
            share += x_weight * y_weight * _beyond_cutoff(np.sqrt(cut2) * r)
    return near * share[:, None]


def _images(at_m: float, length_m: float, edges: str) -> tuple[tuple[float, float], ...]:
    """A coordinate and its mirror images in both edges, each with its weight."""
    return (at_m, 1.0), (-at_m, IMAGE[edges[0]]), (2 * length_m - at_m, IMAGE[edges[1]])


def cutoff_squared(modes: PlateModes, points_m: NDArray[np.float64]) -> NDArray[np.float64]:
    """K^2 at points: the wavenumber beyond which the basis is blind there, as the radius of an equivalent circle.

    Polynomials of degree below n on a length L follow waves up to n / sqrt(1 - xi^2) * 2 / L on each axis, a rectangle
    of wavenumbers. What lies beyond it weighs as the integral of 1 / kappa^4, which the circle of radius K shares.
    Least energy fits curvature, whose degree is that of the deflection, factors p and q included, less two.

    Parameters: points_m : (n_points, 2) [m]. Returns: (n_points,) float64 [m^-2], very large at the edges.
    """
    plate = modes.plate
    size = np.array([plate.length_m, plate.width_m])
    held = np.array([sum("FSC".index(edge) for edge in pair) for pair in (plate.edges[:2], plate.edges[2:])])
    xi = np.clip(2 * points_m / size - 1, -1.0, 1.0)
    kx, ky = ((np.array(modes.terms) + held - 2) * 2 / size / np.sqrt(np.maximum(1 - xi**2, 1e-30))).T
    corner = np.arctan2(ky, kx)
    beyond = (corner + np.sin(2 * corner) / 2) / kx**2 + (np.pi / 2 - corner + np.sin(2 * corner) / 2) / ky**2
    squared: NDArray[np.float64] = np.pi / beyond
    return squared


def _beyond_cutoff(a: NDArray[np.float64]) -> NDArray[np.float64]:
    """g(a) = 2 integral from 1 to infinity of J0(a t) / t^3 dt = J0(a) - (a J1(a) + a^2 C(a)) / 2, with C(a) the
    integral of J0(u) / u from a; set to 0 beyond a = 20, where it is below 0.02 and edges far away would join in."""
    from scipy.special import it2j0y0, j0, j1

    far = a > 20.0
    a = np.clip(a, 1e-9, 20.0)
    c = it2j0y0(a)[0] - np.log(a / 2) - np.euler_gamma
    g: NDArray[np.float64] = np.where(far, 0.0, j0(a) - (a * j1(a) + a**2 * c) / 2)
    return g


def _held(plate: Plate, drive_m: NDArray[np.float64]) -> bool:
    (x, y), tolerance = drive_m[0], 1e-6
    distances = (x / plate.length_m, 1 - x / plate.length_m, y / plate.width_m, 1 - y / plate.width_m)
    return any(edge != "F" and d <= tolerance for edge, d in zip(plate.edges, distances, strict=True))
