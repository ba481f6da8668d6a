"""The load of a hand on the vibration of the object that it touches.

    u = (1 + j omega Z Y_t)^-1 u_free              Y_t = Y(x, x) - Y(x, x_j) H Y(x_j, x)

Y_t is the receptance of the object at the touched point, coupled to all other objects of its group. Each point is
treated as if touched alone: a hand at several points loads each of them with all of its impedance. Where an object
moves in three directions, Y_t is a 3 x 3 matrix, and Z is the same in each direction.

Letters: u [-] deflection over the free deflection of the source, Z [N s/m] impedance of the hand (`hand`), Y [m/N]
receptance of the object alone, x the touched point, x_j the object's joints, H [N/m] see
`coupling.JointForces.holding`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from scene2hap.common.arrays import Complex, Floats
from scene2hap.propagation.bands.sampling import Sampling
from scene2hap.propagation.coupled.coupling import JointForces
from scene2hap.propagation.coupled.hand import Hand
from scene2hap.propagation.elastic_body import ElasticBody, felt_ports


@dataclass(frozen=True, eq=False)
class HandLoad:
    """A hand that may touch an object of a solved group of bodies."""

    hand: Hand
    object_id: str
    group: JointForces


def loaded(stiffness: Complex, yielding: Complex, moved: Complex) -> Complex:
    """Deflection under a hand (n_frequencies, n, n_sources), from the deflection without it.

    Parameters: stiffness : j omega Z (n_frequencies,) [N/m]; yielding : Y_t (n_frequencies, n, n) [m/N] for the n
    directions of one point.
    """
    pulled = np.eye(yielding.shape[1]) + stiffness[:, None, None] * yielding
    return np.linalg.solve(pulled, moved).astype(np.complex128, copy=False)


def stiffness_of(hand: Hand, frequencies_hz: Floats) -> Complex:
    """Dynamic stiffness of a hand, j omega Z (n_frequencies,) [N/m]."""
    return 2j * math.pi * frequencies_hz * hand.impedance_n_s_m(frequencies_hz)


class LoadedGains:
    """Gains at points of an object under a hand, see `Gains`.

    Parameters: body, points_m, columns, load : see `SolvedObject`; forces : its `own_forces`. Construction takes as
    long as solving the group.
    """

    def __init__(
        self,
        body: ElasticBody,
        points_m: Floats,
        forces: Complex,
        columns: NDArray[np.intp],
        load: HandLoad,
        sampling: Sampling,
    ) -> None:
        self._body, self._points_m, self._columns, self._sampling = body, points_m, columns, sampling
        self._frequencies_hz = sampling.frequencies_hz[columns] if sampling.is_single else sampling.frequencies_hz
        # (n_frequencies, n_joints, n): n is 1 if each source has one frequency.
        self._forces = forces.T[:, :, None] if sampling.is_single else forces
        held = load.group.holding(load.object_id)
        self._held = held[columns] if sampling.is_single else held
        self._stiffness = stiffness_of(load.hand, self._frequencies_hz)

    def __call__(self, points_m: Floats) -> Floats:
        """Gains (n_points, n_sources, n_bands) [-] at points (n_points, 2) [m]."""
        n_bands = len(self._sampling.bands) if self._sampling.is_shared else 1
        found = np.empty((len(points_m), len(self._columns), n_bands))
        for i in range(len(points_m)):
            found[i] = self._at(points_m[i : i + 1])
        return found

    def _at(self, point_m: Floats) -> Floats:
        ports = felt_ports(self._body, point_m)
        # A copy, since bodies cache their receptance if points and forces are the same array.
        yielding = self._body.receptance(ports, ports.copy(), self._frequencies_hz)
        towards = self._body.receptance(ports, self._points_m, self._frequencies_hz)
        yielding = yielding - towards @ self._held @ towards.transpose(0, 2, 1)
        moved = loaded(self._stiffness, yielding, towards @ self._forces)
        if self._sampling.is_single:
            gains: Floats = np.abs(moved[:, :, 0]).T[:, :, None]
        else:
            gains = self._sampling.gains(moved, self._columns)
        lengths: Floats = np.sqrt(np.square(gains).sum(axis=0))
        return lengths
