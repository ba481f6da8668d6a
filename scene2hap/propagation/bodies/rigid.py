"""Rigid bodies: which objects are rigid, and their response to forces.

    Y(x, x') = -1 / omega^2 * (1/m + (x - x_c) (x' - x_c) / I_y + (y - y_c) (y' - y_c) / I_x)

Letters: Y [m/N] receptance, m [kg], x, y [m] along the principal axes, I_x, I_y [kg m2] moments of inertia about the
middle (x_c, y_c): those of a box, or of an outline of the box's thickness.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from scene2hap.common.arrays import Complex, Floats
from scene2hap.propagation.elastic_body import AnyFloat, real_times
from scene2hap.propagation.modal.modes import beam_hz, first_bending_hz
from scene2hap.propagation.plate import Plate, RigidBody
from scene2hap.scene.surface.outline import Outline

_THICK = 1 / 5
"""Largest thickness over a side for which thin-plate theory is valid along the side."""
COMPACT_HZ, HOLLOW_HZ = 10_000.0, 2000.0
"""Frequencies of the first mode above which a free body counts as rigid for all that a hand feels, up to 1 kHz. A small
plate with a first mode below 10 kHz yields about as much as its contacts, which shifts resonances: with a first mode at
2-5 kHz, the error would be 1-12 dB at the 95th percentile (docs/figures/accuracy.md). For hollow bodies, mass matters
more than bending."""
BOX_HZ = 100.0
"""First mode of a solid beam above which a thick hollow body is a rigid box. Assumed: it is above that of cushions of
foam, at 3-80 Hz, and below that of cases, cabinets and bathtubs, at 140 Hz or more."""


def is_hollow(plate: Plate) -> bool:
    """Whether a plate would weigh more than its object, as with a bowl or a refrigerator."""
    return plate.moving_mass_kg < plate.mass_kg


def is_too_thick(plate: Plate) -> bool:
    """Whether thin-plate theory is not valid along the longer side of a solid plate, or either side of a hollow one."""
    side = min(plate.extent_m) if is_hollow(plate) else max(plate.extent_m)
    return plate.thickness_m > _THICK * side


def is_stiff(plate: Plate, above_hz: float) -> bool:
    """Whether the first mode of a free plate is above a frequency [Hz]."""
    return beam_hz(plate) >= above_hz and first_bending_hz(plate) > above_hz


@lru_cache(maxsize=4096)
def is_compact(plate: Plate) -> bool:
    """Whether a plate is so stiff that it moves as a rigid body. False for a plate that is held at an edge: as a rigid
    body it would not move at all.

    A thick solid plate bends by its first mode, as a thin one: beyond the range of thin-plate theory, but a block of
    foam is nearer to that than to a rigid body. A thick hollow one is a box, stiffer than a plate of its mass.
    """
    if plate.edges != "FFFF":
        return False
    if not is_hollow(plate):
        return is_stiff(plate, COMPACT_HZ)
    is_box = is_too_thick(plate) and beam_hz(plate) >= BOX_HZ
    return is_box or is_stiff(plate, HOLLOW_HZ)


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
