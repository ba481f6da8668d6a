"""Bodies with forces along their plane, such as an upright board, a cabinet or a refrigerator on a floor.

A plate bends only under forces along its normal. Under forces along its plane it moves, turns and strains (see
`in_plane`), and it pitches if contacts are in front of or behind its mid-plane. A compact body moves and turns as a
whole. A port is a point of a body and the direction of a joint's force there. The receptance between two ports is

    Y = n n' Y_b(x, x') + sum over the motions of +-s_i s_i' / (omega_i^2 (1 + j eta) - omega^2)

where n is the direction's component along the normal, and s_i the port's displacement in a motion of modal mass 1. The
sign is negative for what Y_b and another motion both contain (`PlateMotions`).

Letters: Y_b [m/N] receptance of the plate in bending, omega_i [rad/s] 0 for the motions of a rigid box, eta [-].
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from scene2hap.common.arrays import Complex, Floats
from scene2hap.common.caches import ByteBoundedLru
from scene2hap.propagation.bands.octaves import OctaveSums
from scene2hap.propagation.bodies.legged_body import LeggedBody
from scene2hap.propagation.bodies.rigid import RigidMotion
from scene2hap.propagation.elastic_body import (
    AnyFloat,
    ElasticBody,
    HasResponseBasis,
    ResponseBasis,
    Separable,
    SeparatedReceptance,
    SpatialBody,
    real_times,
)
from scene2hap.propagation.modal.in_plane import InPlaneModes, in_plane_modes
from scene2hap.propagation.plate import Plate

_Part = tuple[NDArray[np.intp], NDArray[np.intp], Callable[[int, int], Complex]]
"""A part of a receptance: its rows, its columns, and a function from a number of these rows and one of these columns to
the values (n, n_f) in the row from this column on."""
_ASIDE = 1e-6  # Component along the normal up to which a direction does not bend the plate.


class BoxMotions:
    """The motions of a rigid body: translations along its principal axes and rotations about them."""

    def __init__(self, body: RigidMotion) -> None:
        assert body.mass_distribution is not None
        self._mass_distribution = body.mass_distribution
        x, y, z = body.mass_distribution.squares_m2
        self._roots = np.sqrt(body.mass_kg * np.array([1.0, 1.0, 1.0, y + z, x + z, x + y]))
        self.squares: NDArray[np.float64] = np.zeros(6)
        self.signs: NDArray[np.float64] = np.ones(6)

    def shapes(self, ports: Floats) -> Floats:
        """Displacement of each port in each motion (n, 6) [kg^-1/2]."""
        off = np.column_stack([self._mass_distribution.off(ports[:, :2]), ports[:, 2]])
        along = np.column_stack([ports[:, 3:5] @ self._mass_distribution.axes, ports[:, 5]])
        shapes: Floats = np.concatenate([along, np.cross(off, along)], axis=1) / self._roots
        return shapes


class PlateMotions:
    """The in-plane motions of a plate, and its tilting about the plane's two axes as a rigid box.

    A tilt moves a point beside the mid-plane in the plane's direction, by s, and a point beside the middle along the
    normal, by t. The plate's bending contains t t' already, so (s + t) (s' + t') - t t' is added.

    Parameters: modes : in-plane modes; tilting_kg : mass of a box of `size_m` with the inertia of the tilt.
    """

    def __init__(self, modes: InPlaneModes, tilting_kg: float, size_m: tuple[float, float, float]) -> None:
        x, y, z = np.square(size_m)
        self._modes, self._roots = modes, np.sqrt(tilting_kg * np.array([y + z, x + z]) / 12)
        self._middle_m = np.array(size_m[:2]) / 2
        self.squares: NDArray[np.float64] = np.concatenate([modes.squares, np.zeros(4)])
        self.signs: NDArray[np.float64] = np.concatenate([np.ones(len(modes.squares) + 2), -np.ones(2)])

    def shapes(self, ports: Floats) -> Floats:
        """Displacement of each port in each motion (n, n_motions) [kg^-1/2]."""
        height, along, normal = ports[:, 2:3], ports[:, 3:5], ports[:, 5:6]
        own = np.einsum("kpm,pk->pm", self._modes.shapes(np.ascontiguousarray(ports[:, :2])), along)
        aside = height * along[:, ::-1] * (-1.0, 1.0) / self._roots
        bent = normal * (ports[:, :2] - self._middle_m)[:, ::-1] * (1.0, -1.0) / self._roots
        return np.concatenate([own, aside + bent, bent], axis=1)


class NoMotions:
    """The motions of a plate that an edge holds: none."""

    squares: NDArray[np.float64] = np.empty(0)
    signs: NDArray[np.float64] = np.empty(0)

    def shapes(self, ports: Floats) -> Floats:
        """An empty array (n, 0)."""
        return np.empty((len(ports), 0))


@dataclass(frozen=True, eq=False)
class InclinedBody(SpatialBody):
    """An `ElasticBody` that is also driven along its plane.

    Parameters: bending : the plate's motion along its normal, None for a compact body; motions : all other motions;
    strain_loss : loss factor of motions that strain the plate.
    """

    bending: ElasticBody | None
    motions: BoxMotions | PlateMotions | NoMotions
    strain_loss: float = 0.0

    @property
    def loss_factor(self) -> float:
        """See `ElasticBody`."""
        return math.inf if self.bending is None else self.bending.loss_factor

    def receptance(self, points_m: Floats, forces_m: Floats, frequencies_hz: Floats) -> Complex:
        """See `ElasticBody`; points and forces are ports."""
        is_among = points_m is forces_m
        pushed = self.motions.shapes(forces_m)
        moved = pushed if is_among else self.motions.shapes(points_m)
        # Motions without strain differ only in their shapes: one number for each pair of ports.
        loose = self.motions.squares == 0
        static = (moved[:, loose] * self.motions.signs[loose]) @ pushed[:, loose].T
        free = (-1 / (2 * np.pi * frequencies_hz) ** 2).astype(np.complex128)
        parts = [self._strained(moved[:, ~loose], pushed[:, ~loose], frequencies_hz, is_among=is_among)]
        if self.bending is not None:
            parts.append(_bent(self.bending, points_m, forces_m, frequencies_hz))
        answer = np.empty((len(moved), len(pushed), len(frequencies_hz)), dtype=np.complex128)
        for i, row in enumerate(answer):  # a row at a time, which stays in the cache
            first = i if is_among else 0  # the lower triangle is a copy of the upper one
            np.multiply(static[i, first:, None], free, out=row[first:])
            for rows, columns, own in parts:
                at = int(np.searchsorted(rows, i))
                if at < len(rows) and rows[at] == i:
                    begin = at if is_among else 0
                    row[columns[begin:]] += own(at, begin)
            if is_among:
                answer[i + 1 :, i] = row[i + 1 :]
        return answer.transpose(2, 0, 1)

    def separated(self, points_m: Floats, frequencies_hz: Floats) -> SeparatedReceptance | None:
        """See `Separable`."""
        rows, places, normal = _bending(points_m)
        if not rows.size or not isinstance(self.bending, Separable):
            return None
        bent = self.bending.separated(places, frequencies_hz)
        if bent is None:
            return None
        n, (_, n_modes), n_smooth = len(points_m), bent.shapes.shape, bent.smooth.shape[2]
        shapes, smooth = np.zeros((n, n_modes)), np.zeros((n, n, n_smooth))
        shapes[rows] = normal[:, None] * bent.shapes
        smooth[rows[:, None], rows] = np.multiply.outer(normal, normal)[..., None] * bent.smooth
        moving = np.concatenate([shapes, self.motions.shapes(points_m)], axis=1)
        resonance = np.concatenate([bent.resonance, self.modal_receptances(frequencies_hz).T])
        return SeparatedReceptance(moving, resonance, smooth, bent.between)

    def _strained(self, moved: Floats, pushed: Floats, frequencies_hz: Floats, *, is_among: bool) -> _Part:
        """The part of the motions that strain the plate. Ports along the normal have none."""
        rows, columns = np.flatnonzero(moved.any(axis=1)), np.flatnonzero(pushed.any(axis=1))
        moved, pushed = moved[rows], pushed[columns]
        if not rows.size or not columns.size:
            return rows[:0], columns, lambda at, begin: np.empty(0, dtype=np.complex128)
        if not is_among:
            terms = (moved[:, None] * pushed).reshape(-1, pushed.shape[1])
            sums = self._sums(frequencies_hz)(terms).reshape(len(rows), len(columns), -1)
            return rows, columns, lambda at, begin: sums[at, begin:]
        i, j = np.triu_indices(len(rows))
        upper = self._sums(frequencies_hz)(moved[i] * pushed[j])
        firsts = np.searchsorted(i, np.arange(len(rows) + 1))
        return rows, columns, lambda at, begin: upper[firsts[at] : firsts[at + 1]]

    @cached_property
    def _sums(self) -> ByteBoundedLru[OctaveSums]:
        return ByteBoundedLru(self._sums_at, room=4)

    def _sums_at(self, frequencies_hz: Floats) -> OctaveSums:
        """Sums over the motions that strain the plate; see `modal_receptances`."""
        loss = complex(1.0, self.strain_loss)
        q: Complex = ((2 * np.pi * frequencies_hz) ** 2 / loss).astype(np.complex128)
        none = np.empty((0, len(frequencies_hz)), dtype=np.complex128)
        return OctaveSums(self.motions.squares[self.motions.squares != 0], none, q, 1 / loss)

    def modal_receptances(self, frequencies_hz: Floats) -> Complex:
        """Modal receptance of each motion (n_frequencies, n_motions) [s^2]."""
        stiff = self.motions.squares * complex(1.0, self.strain_loss)
        found = self.motions.signs / (stiff - (2 * np.pi * frequencies_hz[:, None]) ** 2)
        return found.astype(np.complex128, copy=False)


class InclinedShapes(InclinedBody):
    """An `InclinedBody` with a `ResponseBasis`: its bending is None or has one too."""

    def response_basis(self, forces_m: Floats) -> InclinedBasis:
        """See `HasResponseBasis`."""
        columns, pushes, along = _bending(forces_m)
        assert self.bending is None or isinstance(self.bending, HasResponseBasis)
        bent = None if self.bending is None or not columns.size else self.bending.response_basis(pushes)
        return InclinedBasis(self, self.motions.shapes(forces_m).T, bent, columns, along)


@dataclass(frozen=True, eq=False)
class InclinedBasis:
    """A `ResponseBasis` at ports: first the body's motions, then the shapes in which it bends.

    pushed : (n_motions, n_forces) displacement of each force's port in each motion; bent : None if no force bends the
    body; columns, along : (n_bending,) the forces that bend it, and their components along the normal.
    """

    body: InclinedBody
    pushed: Floats
    bent: ResponseBasis | None
    columns: NDArray[np.intp]
    along: Floats

    @property
    def sizes(self) -> Floats:
        """See `ResponseBasis`."""
        own = np.abs(self.pushed).max(axis=1, initial=1e-12)
        return own if self.bent is None else np.concatenate([own, self.bent.sizes])

    def weights(self, frequencies_hz: Floats, forces: Complex) -> Complex:
        """See `ResponseBasis`."""
        own = real_times(self.pushed, forces) * self.body.modal_receptances(frequencies_hz).T[:, None, :]
        if self.bent is None:
            return own
        bending = np.ascontiguousarray(forces[self.columns] * self.along[:, None, None])
        return np.concatenate([own, self.bent.weights(frequencies_hz, bending)])

    def mixed(self, weights: NDArray[AnyFloat]) -> Callable[[Floats], NDArray[AnyFloat]]:
        """See `ResponseBasis`; points are ports."""
        n_motions = len(self.pushed)
        bent = None if self.bent is None else self.bent.mixed(np.ascontiguousarray(weights[n_motions:]))

        def sums(ports: Floats) -> NDArray[AnyFloat]:
            found = (self.body.motions.shapes(ports) @ weights[:n_motions]).astype(weights.dtype)
            if bent is not None:
                rows, places, normal = _bending(ports)
                found[rows] += normal[:, None].astype(weights.dtype) * bent(places)
            return found

        return sums


def inclined(plate: Plate, bending: ElasticBody) -> InclinedBody:
    """Make the body of a plate that bends as `bending`."""
    if plate.edges == "FFFF":
        size_m = plate.length_m, plate.width_m, plate.thickness_m
        # With less inertia than the bending has, the tilt would yield a negative mass. A mass at a corner counts three
        # times as much as one that is spread.
        tilting_kg = max(plate.moving_mass_kg, plate.mass_kg)
        if isinstance(bending, LeggedBody):
            tilting_kg = plate.mass_kg + 3 * float(bending.masses_kg.sum())
        motions: PlateMotions | NoMotions = PlateMotions(
            in_plane_modes(plate, plate.moving_mass_kg), tilting_kg, size_m
        )
    else:
        motions = NoMotions()
    kind = InclinedShapes if isinstance(bending, HasResponseBasis) else InclinedBody
    # A plate without edges has no resonances and an infinite loss factor: strain takes that of the material.
    loss = bending.loss_factor if math.isfinite(bending.loss_factor) else plate.material.loss_factor
    return kind(bending, motions, loss)


def inclined_box(rigid: RigidMotion) -> InclinedBody:
    """Make the body of a compact object of known size."""
    return InclinedShapes(None, BoxMotions(rigid))


def _bending(ports: Floats) -> tuple[NDArray[np.intp], Floats, Floats]:
    """Indices of the ports with a component along the normal, their positions (n, 2) [m], and this component."""
    rows = np.flatnonzero(np.abs(ports[:, 5]) > _ASIDE)
    return rows, np.ascontiguousarray(ports[rows, :2]), ports[rows, 5]


def _bent(bending: ElasticBody, points_m: Floats, forces_m: Floats, frequencies_hz: Floats) -> _Part:
    """The part of a receptance in which a body bends."""
    rows, places, normal = _bending(points_m)
    columns, pushes, along = (rows, places, normal) if points_m is forces_m else _bending(forces_m)
    if not rows.size or not columns.size:
        return rows[:0], columns, lambda at, begin: np.empty(0, dtype=np.complex128)
    bent = bending.receptance(places, pushes, frequencies_hz).transpose(1, 2, 0)
    return rows, columns, lambda at, begin: (normal[at] * along[begin:])[:, None] * bent[at, begin:]
