"""Rigid bodies: which objects are rigid, and their response to forces.

    Y(x, x') = -1 / omega^2 * (1/m + (x - x_c) (x' - x_c) / I_y + (y - y_c) (y' - y_c) / I_x)

Letters: Y [m/N] receptance, m [kg], I_x, I_y [kg m2] moments of inertia of a box about its middle (x_c, y_c).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from scene2hap.propagation.coupled.response_basis import AnyFloat, real_times
from scene2hap.propagation.modes import beam_hz, first_bending_hz
from scene2hap.propagation.plate import Plate, RigidBody

Floats = NDArray[np.float64]
Complex = NDArray[np.complex128]

_THICK = 1 / 5
"""Largest thickness over a side for which a plate can bend along the side; thin-plate theory is not valid beyond."""
COMPACT_HZ, HOLLOW_HZ = 10_000.0, 2000.0
"""Frequencies of the first mode above which a free body counts as rigid for all that a hand feels, up to 1 kHz. A small
plate with a first mode below 10 kHz yields about as much as its contacts, which shifts resonances: with a first mode at
2-5 kHz, the error would be 1-12 dB at the 95th percentile (docs/figures/accuracy.md). For hollow bodies, mass matters
more than bending."""


def is_hollow(plate: Plate) -> bool:
    """Whether a plate would weigh more than its object, as with a bowl or a refrigerator."""
    return plate.moving_mass_kg < plate.mass_kg


def is_too_thick(plate: Plate) -> bool:
    """Whether a plate is too thick to bend: a solid plate along its longer side, a hollow one along either side."""
    side = min(plate.extent_m) if is_hollow(plate) else max(plate.extent_m)
    return plate.thickness_m > _THICK * side


def is_stiff(plate: Plate, above_hz: float) -> bool:
    """Whether the first mode of a free plate is above a frequency [Hz]."""
    return beam_hz(plate) >= above_hz and first_bending_hz(plate) > above_hz


@lru_cache(maxsize=4096)
def is_compact(plate: Plate) -> bool:
    """Whether a plate is so stiff that it moves as a rigid body. False for a plate that is held at an edge: as a rigid
    body it would not move at all."""
    least_hz = HOLLOW_HZ if is_hollow(plate) else COMPACT_HZ
    return plate.edges == "FFFF" and (is_too_thick(plate) or is_stiff(plate, least_hz))


@dataclass(frozen=True, eq=False)
class RigidMotion:
    """A rigid body as an `ElasticBody`: it moves up and down and, if its size is known, it rocks.

    `size_m` as in `RigidBody`; points are measured from the body's corner.
    """

    mass_kg: float
    size_m: tuple[float, float, float] | None = None
    loss_factor: float = math.inf

    @classmethod
    def of(cls, body: Plate | RigidBody | None, mass_kg: float, *, rocks: bool) -> RigidMotion:
        """Return a rigid body of this mass, with the size of `body` if it rocks."""
        if isinstance(body, Plate):
            size: tuple[float, float, float] | None = (body.length_m, body.width_m, body.thickness_m)
        else:
            size = body.size_m if body is not None else None
        return cls(mass_kg, size if rocks else None)

    def response_basis(self, forces_m: Floats) -> RigidBasis:
        """See `HasResponseBasis`."""
        return RigidBasis(self, self._moved_by(forces_m))

    def receptance(self, points_m: Floats, forces_m: Floats, frequencies_hz: Floats) -> Complex:
        """See `ElasticBody`."""
        yielding = self.motions(points_m) @ self._moved_by(forces_m)
        answer: Complex = (-yielding / (2 * np.pi * frequencies_hz[:, None, None]) ** 2).astype(np.complex128)
        return answer

    def motions(self, points_m: Floats) -> Floats:
        """Displacement of points (n_points, 2) [m] in each motion (n_points, n_motions).

        It is 1 in the vertical motion. If the body rocks, it is the distance from the middle along length and width [m]
        in the two rotations.
        """
        up = np.ones((len(points_m), 1))
        return up if self.size_m is None else np.concatenate([up, points_m - self._middle_m], axis=1)

    def _moved_by(self, forces_m: Floats) -> Floats:
        """Acceleration of each motion per force at points (n_forces, 2) [m]: (n_motions, n_forces)."""
        inertias = np.array([self.mass_kg])
        if self.size_m is not None:
            turning = self.mass_kg / 12 * (np.square(self.size_m[:2]) + self.size_m[2] ** 2)
            inertias = np.append(inertias, turning)
        moved: Floats = (self.motions(forces_m) / inertias).T
        return moved

    @property
    def _middle_m(self) -> Floats:
        length, width, _ = self.size_m or (0.0, 0.0, 0.0)
        return np.array([length / 2, width / 2])


@dataclass(frozen=True, eq=False)
class RigidBasis:
    """The `ResponseBasis` of a rigid body: its motions. moved_by : (n_motions, n_forces)."""

    body: RigidMotion
    moved_by: Floats

    @property
    def sizes(self) -> Floats:
        """See `ResponseBasis`."""
        return np.array([1.0, *(side / 2 for side in (self.body.size_m or ())[:2])])

    def weights(self, frequencies_hz: Floats, forces: Complex) -> Complex:
        """See `ResponseBasis`."""
        weights = real_times(self.moved_by, forces)
        weights /= -((2 * np.pi * frequencies_hz) ** 2)
        return weights

    def mixed(self, weights: NDArray[AnyFloat]) -> Callable[[Floats], NDArray[AnyFloat]]:
        """See `ResponseBasis`."""
        return lambda points_m: (self.body.motions(points_m) @ weights).astype(weights.dtype)
