"""The response of rigid bodies to forces.

    Y(x, x') = -1 / omega^2 * (1/m + (x - x_c) (x' - x_c) / I_y + (y - y_c) (y' - y_c) / I_x)

Letters: Y [m/N] receptance, m [kg], x, y [m] along the principal axes, I_x, I_y [kg m2] moments of inertia about the
middle (x_c, y_c): those of a box, or of an outline of the box's thickness.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from scene2hap.common.arrays import Complex, Floats
from scene2hap.propagation.elastic_body import AnyFloat, real_times
from scene2hap.propagation.plate import Plate, RigidBody
from scene2hap.scene.surface.outline import Outline


class MassDistribution(NamedTuple):
    """The mass distribution of a rigid body.

    middle_m : (2,) centre of mass [m]; axes : (2, 2) principal axes in the plane, as columns; squares_m2 : (3,) mean
    squares of the distances from the middle along these axes and along the normal [m2].
    """

    middle_m: Floats
    axes: Floats
    squares_m2: Floats

    @classmethod
    def of_box(cls, size_m: tuple[float, float, float]) -> MassDistribution:
        """The mass distribution of a box from its corner."""
        return cls(np.array(size_m[:2]) / 2, np.eye(2), np.square(size_m) / 12)

    @classmethod
    def of_outline(cls, outline: Outline, thickness_m: float) -> MassDistribution:
        """The mass distribution of a plate within an outline."""
        middle_m, products_m2 = outline.moments
        squares_m2, axes = np.linalg.eigh(products_m2)
        return cls(middle_m, axes, np.append(squares_m2, thickness_m**2 / 12))

    def off(self, points_m: Floats) -> Floats:
        """Distances of points (n, 2) from the middle along the principal axes (n, 2) [m]."""
        distances: Floats = (points_m - self.middle_m) @ self.axes
        return distances


@dataclass(frozen=True, eq=False)
class RigidMotion:
    """A rigid body as an `ElasticBody`: it moves up and down and, if its size is known, it rocks.

    `size_m` as in `RigidBody`; points are measured from the body's corner. outline : None for a box.
    """

    mass_kg: float
    size_m: tuple[float, float, float] | None = None
    loss_factor: float = math.inf
    outline: Outline | None = None

    @classmethod
    def of(cls, body: Plate | RigidBody | None, mass_kg: float, *, rocks: bool) -> RigidMotion:
        """Return a rigid body of this mass, with the size of `body` if it rocks."""
        if not rocks or body is None:
            return cls(mass_kg)
        if isinstance(body, Plate):
            return cls(mass_kg, (body.length_m, body.width_m, body.thickness_m), outline=body.outline)
        return cls(mass_kg, body.size_m)

    @classmethod
    def of_thin(cls, plate: Plate) -> RigidMotion:
        """Return the motion of a thin plate without bending: that of its mid-plane, and of the plate's mass alone."""
        return cls(plate.mass_kg, (plate.length_m, plate.width_m, 0.0), outline=plate.outline)

    @cached_property
    def mass_distribution(self) -> MassDistribution | None:
        """The distribution of the body's mass; None if it does not rock."""
        if self.size_m is None or self.outline is None:
            return self.size_m and MassDistribution.of_box(self.size_m)
        return MassDistribution.of_outline(self.outline, self.size_m[2])

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

        It is 1 in the vertical motion. If the body rocks, it is the distance from the middle along its principal axes
        [m] in the two rotations.
        """
        up = np.ones((len(points_m), 1))
        return (
            up if self.mass_distribution is None else np.concatenate([up, self.mass_distribution.off(points_m)], axis=1)
        )

    def _moved_by(self, forces_m: Floats) -> Floats:
        """Acceleration of each motion per force at points (n_forces, 2) [m]: (n_motions, n_forces)."""
        inertias = np.array([self.mass_kg])
        if self.mass_distribution is not None:
            x, y, z = self.mass_distribution.squares_m2
            inertias = self.mass_kg * np.array([1.0, x + z, y + z])
        moved: Floats = (self.motions(forces_m) / inertias).T
        return moved


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
