"""Coupling of any number of bodies at points, by frequency-based substructuring.

Each body alone gives its receptance: deflection at points per force at points. Joints are springs with loss between two
bodies. With the forces g of all joints,

    (B Y B^T + Z) g = B u_free                      Z = 1 / (k (1 + j eta) + j omega c)
    u(x) = u_free - sum over the body's joints of +-Y(x, x_j) g_j

where Y is block-diagonal by body, and each row of B takes the deflection of a minus that of b. A source is a body that
would move by u_free = 1 at all of its joints, in phase, if nothing touched it: forward along each of its own axes. The
cost depends on the number of joints, not on the model of each body. Loops and several joints per pair need no special
treatment.

Letters: Y [m/N] receptance, Z [m/N] compliance of a joint, g [N/m] force per free deflection, u [-], k [N/m], c
[N s/m], eta [-] loss factor. Time runs as e^{+j omega t}.
Source: de Klerk, Rixen, Voormeeren, General framework for dynamic substructuring, AIAA J. 46 (2008) 1169, eq. 33.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from scene2hap.common import checks
from scene2hap.common.arrays import Complex, Floats
from scene2hap.common.counted import counted
from scene2hap.errors import ModelDomainError
from scene2hap.propagation.coupled import large_body
from scene2hap.propagation.coupled.elimination import Element, inverse, is_nearly_full, pattern_among, solve
from scene2hap.propagation.elastic_body import ElasticBody, Separable

AT_ONCE_BYTES = 256_000_000
"""Memory of the receptances of all bodies that are in memory at once. A furnished room needs less for all frequencies;
200 objects on one floor would need gigabytes."""
MOST_BYTES = 500_000_000
"""Largest memory of one part of a solution. Preparing a field or touching an object takes up to five times as much."""
FEWEST_AT_ONCE = 4
"""Least number of frequencies in memory at once: `elimination` solves four in the time of one."""


class ForceDirection(NamedTuple):
    """Direction (x, y, z) of a joint's force on a body, in the body's own coordinates, and the height of the joint over
    the mid-plane [m]."""

    x: float
    y: float
    z: float
    height_m: float


NORMAL = ForceDirection(0.0, 0.0, 1.0, 0.0)
REVERSED = ForceDirection(0.0, 0.0, -1.0, 0.0)
"""As `NORMAL`, for a body whose normal is opposed to the joint's direction."""


@dataclass(frozen=True)
class Joint:
    """A spring with loss between a point of one body and a point of another.

    Parameters: a, b : two bodies; point_a_m, point_b_m : (x, y) [m], each in its body's own coordinates;
    stiffness_n_m : >= 0 [N/m], infinite for a rigid joint; loss_factor : >= 0 [-]; damping_n_s_m : >= 0 [N s/m];
    along_a, along_b : direction of the joint in the coordinates of each body.
    """

    a: str
    b: str
    point_a_m: tuple[float, float]
    point_b_m: tuple[float, float]
    stiffness_n_m: float = math.inf
    loss_factor: float = 0.0
    damping_n_s_m: float = 0.0
    along_a: ForceDirection = NORMAL
    along_b: ForceDirection = NORMAL

    def __post_init__(self) -> None:
        given = (self.stiffness_n_m, self.loss_factor, self.damping_n_s_m)
        if {*map(type, given)} == {float} and min(given) >= 0 and math.isfinite(given[1] + given[2]):
            return  # fast path: a scene has hundreds of joints, nearly all of them valid
        if math.isnan(self.stiffness_n_m) or self.stiffness_n_m < 0:
            raise ModelDomainError(f"stiffness_n_m is {self.stiffness_n_m}; it must be at least 0, or infinite [N/m].")
        checks.number("loss_factor", self.loss_factor, "-", at_least=0.0, error=ModelDomainError)
        checks.number("damping_n_s_m", self.damping_n_s_m, "N s/m", at_least=0.0, error=ModelDomainError)


def compliances_m_n(joints: Sequence[Joint], frequencies_hz: Floats) -> Complex:
    """Compliances Z of joints (n_joints, n_frequencies) [m/N]; 0 if rigid, very large without stiffness and damping."""
    k, eta, c = np.array([(one.stiffness_n_m, one.loss_factor, one.damping_n_s_m) for one in joints]).T[:, :, None]
    is_rigid = np.isinf(k)
    dynamic = np.where(is_rigid, 1.0, k) * (1 + 1j * eta)
    if c.any():
        dynamic = dynamic + 2j * np.pi * c * frequencies_hz
    compliances: Complex = np.where(is_rigid, 0.0, 1 / np.where(dynamic == 0, 1e-200, dynamic))
    return np.broadcast_to(compliances, (len(joints), len(frequencies_hz)))


@dataclass(frozen=True, eq=False)
class JointEnds:
    """The ends of all joints on one body.

    points_m : (n, 2) [m], on the body, or ports (n, 6) of a `SpatialBody` if any joint is not along its normal;
    rows : (n,) indices among all joints; signs : (n,) +1 where the body is the joint's a, -1 where it is b, and the
    opposite for `REVERSED`.
    """

    points_m: Floats
    rows: NDArray[np.intp]
    signs: Floats


@dataclass(frozen=True, eq=False)
class JointForces:
    """The forces g in all joints, for each source.

    bodies, joints, source_ids : as given; frequencies_hz : (n_f,) [Hz]; forces : (n_f, n_joints, n_sources) [N/m], from
    a on b, per unit of the source's free deflection; ends : see `ends_of`; system : of all frequencies, None if they
    were solved in parts.
    """

    bodies: Mapping[str, ElasticBody]
    joints: tuple[Joint, ...]
    source_ids: tuple[str, ...]
    frequencies_hz: Floats
    forces: Complex
    ends: Mapping[str, JointEnds]
    system: JointSystem | None = None

    def deflection(self, body_id: str, points_m: Floats) -> Complex:
        """Deflection of a body per free deflection of each source; that of a source includes its own free motion.

        Parameters: points_m : (n_points, 2) [m], in the body's own coordinates.
        Returns: (n_frequencies, n_points, n_sources) complex128 [-].
        """
        shape = (len(self.frequencies_hz), len(points_m), len(self.source_ids))
        moved = np.zeros(shape, dtype=np.complex128)
        ends = self.ends.get(body_id)
        if ends is not None:
            receptance = self.bodies[body_id].receptance(points_m, ends.points_m, self.frequencies_hz)
            moved -= receptance @ (ends.signs[:, None] * self.forces[:, ends.rows])
        if body_id in self.source_ids:
            moved[:, :, self.source_ids.index(body_id)] += 1.0
        return moved

    def holding(self, body_id: str) -> Complex:
        """Forces H of all other bodies on a body at its joints, per free deflection at each of these joints.

            Y_coupled(x, x') = Y(x, x') - Y(x, x_j) H Y(x_j, x')

        All joints are solved again. Returns: (n_frequencies, n_own, n_own) complex128 [N/m], in the order of `ends`.
        """
        none = np.empty(0, dtype=np.intp)
        if self.system is not None:
            return self.system.answers(none, [body_id])[1][body_id]
        n_own = len(self.ends[body_id].rows)
        held = np.empty((len(self.frequencies_hz), n_own, n_own), dtype=np.complex128)
        for part, system in systems(self.bodies, self.ends, self.joints, self.frequencies_hz):
            held[part] = system.answers(none, [body_id])[1][body_id]
        return held


@dataclass(frozen=True, eq=False)
class JointSystem:
    """The linear system of all joints at some frequencies.

    ends : see `ends_of`; receptances : of each body among its joints (n_f, n_ends, n_ends) [m/N]; compliances :
    (n_joints, n_f) [m/N].
    """

    ends: Mapping[str, JointEnds]
    receptances: Mapping[str, Complex]
    compliances: Complex

    def forces(self, free: Floats) -> Complex:
        """Forces (n_joints, n, n_f) [N/m] for free deflections across the joints (n_joints, n)."""
        return solve(self._elements(), self.compliances, free)

    def answers(self, rows: NDArray[np.intp], body_ids: Collection[str]) -> tuple[Complex, dict[str, Complex]]:
        """Forces in all joints per free deflection across each joint of `rows` (n_f, n_joints, n_rows) [N/m], and
        `JointForces.holding` of each body of `body_ids`."""
        number = {body_id: k for k, body_id in enumerate(self.ends)}
        columns, parts = inverse(self._elements(), self.compliances, rows, [number[x] for x in body_ids])
        held = {x: np.multiply.outer(self.ends[x].signs, self.ends[x].signs) * parts[number[x]] for x in body_ids}
        return columns.transpose(2, 0, 1), held

    def _elements(self) -> list[Element]:
        return [Element(own.rows, own.signs, self.receptances[body_id]) for body_id, own in self.ends.items()]


def couple(
    bodies: Mapping[str, ElasticBody],
    joints: Sequence[Joint],
    source_ids: Sequence[str],
    frequencies_hz: Floats,
    wanted: NDArray[np.bool_] | None = None,
) -> JointForces:
    """Solve all joints together.

    Parameters: source_ids : bodies, each in turn with a free deflection of 1 at all of its joints; frequencies_hz :
    (n_frequencies,) > 0 [Hz]; wanted : (n_sources, n_frequencies), None for all: forces elsewhere may be 0.
    Raises: ModelDomainError: a joint ends at an unknown body, or has both ends at one body.
    """
    for joint in joints:
        unknown = [end for end in (joint.a, joint.b) if end not in bodies]
        if unknown or joint.a == joint.b:
            raise ModelDomainError(
                f"a joint runs from {joint.a!r} to {joint.b!r}; it must join two of the bodies "
                f"{', '.join(map(repr, sorted(bodies)))}."
            )
    ends, n_f = ends_of(joints), len(frequencies_hz)
    free = _free_deflections(ends, len(joints), source_ids)
    forces = np.zeros((*free.shape, n_f), dtype=np.complex128)
    whole, left = None, np.arange(n_f)
    if free.size:
        _require_few(ends)
        solved = _with_large_body(bodies, ends, joints, free, frequencies_hz, wanted)
        if solved is not None:
            forces, is_solved = solved
            left = np.flatnonzero(~is_solved)
        for part, system in systems(bodies, ends, joints, frequencies_hz[left]):
            forces[:, :, left[part]] = system.forces(free)
            whole = system if part == slice(0, n_f) else None
    by_frequency = forces.transpose(2, 0, 1)
    return JointForces(bodies, tuple(joints), tuple(source_ids), frequencies_hz, by_frequency, ends, whole)


def _with_large_body(
    bodies: Mapping[str, ElasticBody],
    ends: Mapping[str, JointEnds],
    joints: Sequence[Joint],
    free: Floats,
    frequencies_hz: Floats,
    wanted: NDArray[np.bool_] | None,
) -> tuple[Complex, NDArray[np.bool_]] | None:
    """See `large_body.solve`; None where that is not faster."""
    large_id = max(ends, key=lambda key: len(ends[key].rows))
    body, own = bodies[large_id], ends[large_id]
    pattern = pattern_among([one.rows for one in ends.values()])
    if not isinstance(body, Separable) or not is_nearly_full(pattern, free.shape[1], inverts=False):
        return None
    others = {key: one for key, one in ends.items() if key != large_id}
    rows = [one.rows for one in others.values()]
    large = body.separated(own.points_m, frequencies_hz)
    if large is None or not large_body.is_faster(large, rows):
        return None
    n_f, compliances = len(frequencies_hz), compliances_m_n(joints, frequencies_hz)
    if wanted is None:
        wanted = np.ones((free.shape[1], n_f), dtype=bool)
    forces, is_solved = np.empty((*free.shape, n_f), dtype=np.complex128), np.empty(n_f, dtype=bool)
    n_bytes = 16 * n_f * sum(len(block) ** 2 for block in large_body.blocks_of(rows))
    n_parts = min(n_f, 1 + n_bytes // AT_ONCE_BYTES)
    for begin, end in pairwise(np.linspace(0, n_f, n_parts + 1).astype(int).tolist()):
        part, few_hz = slice(begin, end), frequencies_hz[begin:end]
        few = large._replace(resonance=large.resonance[:, part], between=large.between[:, part])
        elements = [
            Element(one.rows, one.signs, bodies[key].receptance(one.points_m, one.points_m, few_hz))
            for key, one in others.items()
        ]
        forces[:, :, part], is_solved[part] = large_body.solve(
            few, own.rows, own.signs, elements, compliances[:, part], free, wanted[:, part]
        )
    return forces, is_solved


def systems(
    bodies: Mapping[str, ElasticBody],
    ends: Mapping[str, JointEnds],
    joints: Sequence[Joint],
    frequencies_hz: Floats,
    at_once: int | None = None,
) -> Iterator[tuple[slice, JointSystem]]:
    """Yield the system of all joints for a part of the frequencies at a time. Each is valid until the next.

    Parameters: ends : see `ends_of`; at_once : largest number of frequencies in a part, by default as many as fit into
    `AT_ONCE_BYTES`.
    Raises: ModelDomainError: a body has so many joints that `FEWEST_AT_ONCE` frequencies exceed `MOST_BYTES`.
    """
    _require_few(ends)
    if at_once is None:
        at_once = AT_ONCE_BYTES // max(1, 16 * sum(len(own.rows) ** 2 for own in ends.values()))
    n_f, compliances = len(frequencies_hz), compliances_m_n(joints, frequencies_hz)
    n_parts = -(-n_f // max(at_once, FEWEST_AT_ONCE))
    for begin, end in pairwise(np.linspace(0, n_f, n_parts + 1).astype(int).tolist()):
        few_hz = frequencies_hz[begin:end]
        receptances = {key: bodies[key].receptance(own.points_m, own.points_m, few_hz) for key, own in ends.items()}
        yield slice(begin, end), JointSystem(ends, receptances, compliances[:, begin:end])
        if end < n_f:
            receptances.clear()  # else those of two parts would be in memory


def _require_few(ends: Mapping[str, JointEnds]) -> None:
    for object_id, own in ends.items():
        among = f"the receptance among the {counted(len(own.rows), 'contact')} of object {object_id!r}"
        require_memory(16 * FEWEST_AT_ONCE * len(own.rows) ** 2, among, "Leave objects out of the scene")


def require_memory(n_bytes: int, what: str, instead: str) -> None:
    """Raise a ModelDomainError if a part of a solution exceeds `MOST_BYTES`; `instead` says how to avoid it."""
    if n_bytes > MOST_BYTES:
        raise ModelDomainError(
            f"{what} would take {n_bytes / 1e6:,.0f} MB; at most {MOST_BYTES / 1e6:,.0f} MB are used. {instead}, or "
            "use ExponentialPlate."
        )


def ends_of(joints: Sequence[Joint]) -> dict[str, JointEnds]:
    """Return the joints of every body that has any."""
    found: dict[str, list[tuple[tuple[float, ...], int, float]]] = {}
    inclined = inclined_in(joints)
    for row, joint in enumerate(joints):
        for key, point_m, along, sign in (
            (joint.a, joint.point_a_m, joint.along_a, 1.0),
            (joint.b, joint.point_b_m, joint.along_b, -1.0),
        ):
            port = (*point_m, along.height_m, along.x, along.y, along.z) if key in inclined else point_m
            is_reversed = along is REVERSED and key not in inclined
            found.setdefault(key, []).append((port, row, -sign if is_reversed else sign))
    return {body_id: JointEnds(*map(np.array, zip(*several, strict=True))) for body_id, several in found.items()}


def inclined_in(joints: Sequence[Joint]) -> set[str]:
    """Return the bodies with a joint that is not along their normal."""
    first = {one.a for one in joints if one.along_a is not NORMAL and one.along_a is not REVERSED}
    return first | {one.b for one in joints if one.along_b is not NORMAL and one.along_b is not REVERSED}


def _free_deflections(ends: Mapping[str, JointEnds], n_joints: int, source_ids: Sequence[str]) -> Floats:
    """Free deflection across each joint for each source (n_joints, n_sources)."""
    free = np.zeros((n_joints, len(source_ids)))
    for column, source_id in enumerate(source_ids):
        if source_id in ends:
            free[ends[source_id].rows, column] = ends[source_id].signs * _free_motion(ends[source_id].points_m)
    return free


def _free_motion(points_m: Floats) -> Floats:
    """Free deflection of a source along each of its joints, +1 or -1: it moves in phase along its own three axes."""
    if points_m.shape[1] == 2:
        return np.ones(len(points_m))
    along = points_m[:, 3:]
    largest: Floats = np.take_along_axis(along, np.abs(along).argmax(axis=1)[:, None], axis=1)[:, 0]
    return np.copysign(1.0, largest)
