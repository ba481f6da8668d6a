"""An object of a solved scene: deflection under the forces at its contacts, evaluated at touched points.

    u(x, f) = sum over contacts c of Y(x, x_c, f) g_c(f)

If each source has one frequency, everything that does not depend on x is summed over the contacts on the first touch
(`contracted`), so a touch costs the same for any number of contacts. In bands, a touch takes a product of small
matrices for every frequency. If the object is expected to be touched often, the sum over contacts and frequencies is
computed in advance (`band_shapes`), which takes as long as some dozen touches. Under a hand (`hand_load`) neither is
possible, since the hand's factor depends on point and frequency.

Letters: see `coupling`.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from scene2hap.common.arrays import Complex, Floats
from scene2hap.compiled import compiled
from scene2hap.propagation.bands.band_shapes import band_gains
from scene2hap.propagation.bands.sampling import Gains, Sampling
from scene2hap.propagation.coupled.coupling import Joint, JointEnds
from scene2hap.propagation.coupled.hand_load import HandLoad, LoadedGains
from scene2hap.propagation.elastic_body import ElasticBody, HasResponseBasis, SpatialBody, contracted, pieces

POINTS_AT_ONCE = 32
"""Points whose responses at many frequencies are in memory at once."""

LOSSLESS = 1e-9
"""Net power into a body over the power exchanged at its joints, below which the net power is only rounding."""


@dataclass(frozen=True, eq=False)
class SolvedObject:
    """An object that some sources reach.

    ends : its joints; forces : in all joints of its group (n_all_joints, n_sources, n_frequencies), or without the last
    axis if each source has one frequency [N/m]; columns : (n_sources,) indices of these sources among all; joints : all
    of its group; load : a hand that may touch it, if any.
    """

    body: ElasticBody
    ends: JointEnds
    forces: Complex
    columns: NDArray[np.intp]
    joints: Sequence[Joint]
    load: HandLoad | None

    @cached_property
    def own_forces(self) -> Complex:
        """Forces that act on this object at its joints ([n_frequencies,] n_joints, n_sources); extracted from those of
        the group at first use."""
        taken = self.forces[self.ends.rows]
        taken *= -self.ends.signs.reshape(-1, *[1] * (taken.ndim - 1))
        return np.ascontiguousarray(np.moveaxis(taken, 2, 0)) if taken.ndim == 3 else taken

    @property
    def others(self) -> list[str]:
        """The object on the other side of each of its joints."""
        pairs = zip(self.ends.rows.tolist(), self.ends.signs.tolist(), strict=True)
        return [self.joints[row].b if sign > 0 else self.joints[row].a for row, sign in pairs]

    def shares_of_power(self, source_id: str, column: int, band: int, sampling: Sampling) -> Floats:
        """Share of each joint in the power of a source that enters this object in a band (n_joints,).

        The power through a joint is Re(g* j omega u) / 2, with u the deflection there. Power that another object brings
        through one joint and takes away through another does not count; an object that takes away more than it brings
        has no share. A body without loss that passes nothing on gets no power through any joint. Shares are then those
        of |g u| at the joints.
        """
        mine = np.flatnonzero(self.columns == column)
        if not mine.size:
            return np.zeros(len(self.ends.rows))
        at, weights = sampling.of_source(column, band)
        forces = self.own_forces[None, :, mine[0]] if sampling.is_single else self.own_forces[at, :, mine[0]]
        frequencies, points_m = sampling.frequencies_hz[at], self.ends.points_m
        deflection = contracted(self.body, points_m, frequencies, forces.T.copy())
        weights = frequencies * weights

        def powers(which: NDArray[np.bool_]) -> Complex:
            moved = deflection(points_m[which]).view(np.complex128).T
            passed: Complex = weights @ (forces[:, which].conj() * moved)
            return passed

        # Only the source, and objects that touch another one, can bring power. The deflection at all joints takes a
        # fifth of a second on a plate with a thousand of them.
        everyone = np.array(self.others)
        brings_any = np.isin(everyone, [source_id, *self._others_beyond()])
        passed = powers(brings_any)
        others, number = np.unique(everyone[brings_any], return_inverse=True)
        brings, held = np.maximum(-passed.imag, 0.0), np.abs(passed)
        gross = np.bincount(number, brings, len(others))
        net = np.maximum(np.bincount(number, -passed.imag, len(others)), 0.0)
        comes_in = brings * (net / np.where(gross > 0, gross, 1.0))[number]
        if comes_in.sum() > LOSSLESS * held.sum():
            parts = np.zeros(len(everyone))
            parts[brings_any] = comes_in
        else:
            parts = np.abs(powers(np.ones(len(everyone), dtype=bool)))
        total = parts.sum()
        shares: Floats = parts / total if total > 0 else parts
        return shares

    def _others_beyond(self) -> set[str]:
        """Objects of the group with a joint that is not one of this object."""
        own = set(self.ends.rows.tolist())
        return {x for row, joint in enumerate(self.joints) if row not in own for x in (joint.a, joint.b)}

    def gains(self, sampling: Sampling, *, is_expected: bool) -> Gains:
        """Gains of its sources at points on the object; fast if `is_expected` or if each source has one frequency."""
        if self.load is not None:
            return LoadedGains(self.body, self.ends.points_m, self.own_forces, self.columns, self.load, sampling)
        if isinstance(self.body, SpatialBody):
            return FeltInSpace(self._gains(sampling, is_expected=is_expected), self.body)
        return self._gains(sampling, is_expected=is_expected)

    def _gains(self, sampling: Sampling, *, is_expected: bool) -> Gains:
        if sampling.is_single:
            own_hz = sampling.frequencies_hz[self.columns]
            return Magnitudes(contracted(self.body, self.ends.points_m, own_hz, self.own_forces))
        if is_expected and isinstance(self.body, HasResponseBasis):
            return band_gains(self.body.response_basis(self.ends.points_m), self.own_forces, sampling, self.columns)
        return lambda points_m: self._summed(points_m, sampling)

    def _summed(self, points_m: Floats, sampling: Sampling) -> Floats:
        n_bands = len(sampling.bands) if sampling.is_shared else 1
        found = np.empty((len(points_m), len(self.columns), n_bands))
        for begin in range(0, len(points_m), POINTS_AT_ONCE):
            few = points_m[begin : begin + POINTS_AT_ONCE]
            moved = np.empty((len(sampling.frequencies_hz), len(few), len(self.columns)), dtype=np.complex128)
            for part, receptance in pieces(self.body, few, self.ends.points_m, sampling.frequencies_hz):
                moved[part] = receptance @ self.own_forces[part]
            found[begin : begin + POINTS_AT_ONCE] = sampling.gains(moved, self.columns)
        return found


class FeltInSpace:
    """Gains of a body that moves in three directions: the length of the motion, from its three components."""

    def __init__(self, gains: Gains, body: SpatialBody) -> None:
        self._gains, self._body = gains, body

    def __call__(self, points_m: Floats) -> Floats:
        """See `Gains`."""
        each = np.square(self._gains(self._body.felt(points_m)))
        lengths: Floats = np.sqrt(each.reshape(3, len(points_m), *each.shape[1:]).sum(axis=0))
        return lengths


@compiled
class ObjectResponse:
    """Gains at points of one object after the scene is solved.

    Parameters: place : maps world points (n_points, 3) to points on the body (n_points, 2) [m]; gains : of the sources
    that reach the object; columns : (n_own,) indices of these among all sources; shape : (n_sources, n_bands) of all;
    own : column of the object itself as a source, -1 if it is none.
    """

    def __init__(
        self,
        place: Callable[[Floats], Floats],
        gains: Gains,
        columns: NDArray[np.intp],
        shape: tuple[int, int],
        own: int,
    ) -> None:
        self._place, self._gains, self._columns, self._shape, self._own = place, gains, columns, shape, own

    def __call__(self, points_m: Floats) -> Floats:
        """Gains (n_points, n_sources, n_bands) [-] at points of the world (n_points, 3) [m]: 1 for a source on
        itself, 0 for sources that do not reach the object."""
        found = np.zeros((len(points_m), *self._shape))
        found[:, self._columns] = self._gains(self._place(points_m))
        if self._own >= 0:
            found[:, self._own] = 1.0
        return found


@compiled
class Magnitudes:
    """Magnitudes (n_points, n, 1) at points (n_points, 2) of complex numbers, from alternating real and imaginary
    parts."""

    def __init__(self, pairs: Callable[[Floats], Floats]) -> None:
        self._pairs = pairs

    def __call__(self, points_m: Floats) -> Floats:
        """See `Gains`."""
        sizes: Floats = np.abs(self._pairs(points_m).view(np.complex128))[:, :, None]
        return sizes
