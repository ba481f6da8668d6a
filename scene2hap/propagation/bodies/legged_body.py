"""A plate with point masses where its object stands, for the rest of the object: legs, walls and a frame.

A mass m at a point l of a plate exerts a force of omega^2 m u(l). With the plate's receptance Y and these masses,

    Y'(x, x') = Y(x, x') - Y(x, l) (Y(l, l) + Z)^-1 Y(l, x')        Z = -1 / (omega^2 m), diagonal

Letters: Y [m/N], m [kg], u [m].
Source: de Klerk, Rixen, Voormeeren, General framework for dynamic substructuring, AIAA J. 46 (2008) 1169, for coupling
by receptances, of which this is the case of point masses.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from scene2hap.common.arrays import Complex, Floats
from scene2hap.common.caches import ByteBoundedLru
from scene2hap.propagation.elastic_body import AnyFloat, ElasticBody, HasResponseBasis, ResponseBasis


class LeggedBody:
    """A plate with point masses, an `ElasticBody`.

    Parameters: plate : the plate alone; legs_m : (n_legs, 2) [m], positions of the masses; masses_kg : (n_legs,).
    """

    def __init__(self, plate: ElasticBody, legs_m: Floats, masses_kg: Floats) -> None:
        self.plate = plate
        self.legs_m = legs_m
        self.masses_kg = masses_kg
        self.leg_forces: ByteBoundedLru[Complex] = ByteBoundedLru(self._leg_forces, room=4)

    @property
    def loss_factor(self) -> float:
        """See `ElasticBody`."""
        return self.plate.loss_factor

    def receptance(self, points_m: Floats, forces_m: Floats, frequencies_hz: Floats) -> Complex:
        """See `ElasticBody`."""
        plain = self.plate.receptance(points_m, forces_m, frequencies_hz)
        towards = self.plate.receptance(points_m, self.legs_m, frequencies_hz)
        pulled = self.leg_forces(forces_m, frequencies_hz)
        answer = plain + towards @ pulled
        # Symmetric to the last bit, which rounding alone would not give.
        return (answer + answer.transpose(0, 2, 1)) / 2 if points_m is forces_m else answer

    def _leg_forces(self, forces_m: Floats, frequencies_hz: Floats) -> Complex:
        """Force of each leg in response to a force of 1 N (n_frequencies, n_legs, n_forces) [-]."""
        among = self.plate.receptance(self.legs_m, self.legs_m, frequencies_hz).copy()
        n = np.arange(len(self.masses_kg))
        among[:, n, n] -= 1 / (self.masses_kg * (2 * np.pi * frequencies_hz[:, None]) ** 2)
        moved = self.plate.receptance(self.legs_m, forces_m, frequencies_hz)
        answered: Complex = -np.linalg.solve(among, moved).astype(np.complex128, copy=False)
        return answered


class LeggedShapes(LeggedBody):
    """A `LeggedBody` with a `ResponseBasis`, for a plate that has one."""

    def response_basis(self, forces_m: Floats) -> LeggedBasis:
        """See `HasResponseBasis`."""
        assert isinstance(self.plate, HasResponseBasis)
        return LeggedBasis(self, forces_m, self.plate.response_basis(np.concatenate([forces_m, self.legs_m])))


@dataclass(frozen=True, eq=False)
class LeggedBasis:
    """The `ResponseBasis` of the plate, with the forces of the legs added."""

    body: LeggedBody
    forces_m: Floats
    plate: ResponseBasis

    @property
    def sizes(self) -> Floats:
        """See `ResponseBasis`."""
        return self.plate.sizes

    def weights(self, frequencies_hz: Floats, forces: Complex) -> Complex:
        """See `ResponseBasis`."""
        answered = np.einsum("flc,cnf->lnf", self.body.leg_forces(self.forces_m, frequencies_hz), forces)
        return self.plate.weights(frequencies_hz, np.concatenate([forces, answered]))

    def mixed(self, weights: NDArray[AnyFloat]) -> Callable[[Floats], NDArray[AnyFloat]]:
        """See `ResponseBasis`."""
        return self.plate.mixed(weights)


def legged(plate: ElasticBody, legs_m: Floats, masses_kg: Floats) -> LeggedBody:
    """Return a plate with point masses; it has a `ResponseBasis` if the plate has one."""
    kind = LeggedShapes if isinstance(plate, HasResponseBasis) else LeggedBody
    return kind(plate, legs_m, masses_kg)
