"""Solution of a whole scene for the physical models: one body per object, coupled at their contacts.

Attenuation is the deflection at the touched point over the deflection of the source if nothing touched it. The source
is a rigid body with one free vibration at all of its contacts, in phase. For one contact, with mobilities Y of source,
receiver and contact,

    v = v_free Y_transfer / (Y_source + Y_receiver + Y_contact)

Compact bodies and all sources move as rigid bodies. Objects that no source can reach are never solved.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from scene2hap.common.blas_threads import one_blas_thread
from scene2hap.common.counted import counted
from scene2hap.haptics import Bands
from scene2hap.propagation.bands.sampling import Sampling
from scene2hap.propagation.bodies.idealisation import is_compact, no_heavier_than_object
from scene2hap.propagation.bodies.inclined_body import inclined, inclined_box
from scene2hap.propagation.bodies.legged_body import legged
from scene2hap.propagation.bodies.rigid import RigidMotion
from scene2hap.propagation.coupled.contact_stiffness import ContactLaw
from scene2hap.propagation.coupled.coupling import Joint, couple, inclined_in, require_memory
from scene2hap.propagation.coupled.hand import Hand
from scene2hap.propagation.coupled.hand_load import HandLoad
from scene2hap.propagation.coupled.impact_scene import DENSITY, IMPACT_BANDS, ImpactScene
from scene2hap.propagation.coupled.impact_solution import solve_struck
from scene2hap.propagation.coupled.joints import joints_of, legs_of, source_groups
from scene2hap.propagation.coupled.solved_object import ObjectResponse, SolvedObject
from scene2hap.propagation.domain import OutsideDomain, check_thin
from scene2hap.propagation.elastic_body import ElasticBody
from scene2hap.propagation.plate import Plate, RigidBody
from scene2hap.propagation.points import object_points
from scene2hap.propagation.protocol import Carrier, ContactNetwork, CoupledModel, Excitation, require_input
from scene2hap.scene.objects import Contact
from scene2hap.scene.pose import Pose

_PROBE, _PROBE_KG = "\0probe", 1e-9


@dataclass(frozen=True, eq=False)
class Assembly:
    """A scene whose plates are not solved yet.

    groups : connected groups of bodies, by their sources and joints; rigid : rigid bodies, sources included; plates :
    bodies that bend and that a source can reach; top_hz : highest frequency of interest.
    """

    network: ContactNetwork
    excitations: tuple[Excitation, ...]
    bands: Bands
    groups: Sequence[tuple[Sequence[str], Sequence[Joint]]]
    rigid: Mapping[str, RigidMotion]
    plates: Mapping[str, Plate]
    top_hz: float

    @cached_property
    def beside(self) -> dict[str, dict[str, list[Joint]]]:
        """Joints of each object, by the object on their other side."""
        found: dict[str, dict[str, list[Joint]]] = {}
        for _, joints in self.groups:
            for joint in joints:
                for one, other in ((joint.a, joint.b), (joint.b, joint.a)):
                    found.setdefault(one, {}).setdefault(other, []).append(joint)
        return found

    def solve(self, elastic: Mapping[str, ElasticBody], density: float = 1.0, hand: Hand | None = None) -> CoupledField:
        """Solve the field.

        Parameters: elastic : a body for each of the plates; density : frequencies per band relative to the needed ones;
        hand : load at touched points.
        """
        source_ids = tuple(item.source_id for item in self.excitations)
        bodies = self._bodies(elastic)
        sampling = self._sampling(bodies, density)
        reach: dict[str, SolvedObject] = {}
        for sources, joints in self.groups:
            if joints:
                reach |= _solved(bodies, joints, sources, source_ids, sampling, hand)
        return CoupledField(source_ids, self.bands, self.network, sampling, reach)

    def struck(
        self, touched_ids: Collection[str], elastic: Mapping[str, ElasticBody], hand: Hand | None = None
    ) -> ImpactScene:
        """Solve all objects that are connected with touched ones, for impacts. Each touched object must carry a source.

        Parameters: elastic : a body for each of the plates; hand : load at the struck and at touched points.
        """
        bodies = self._bodies(elastic)
        groups, frequencies_hz = [joints for _, joints in self.groups], self._sampling(bodies, DENSITY).frequencies_hz
        return solve_struck(bodies, groups, self.network.bodies.keys(), touched_ids, frequencies_hz, hand)

    def _bodies(self, elastic: Mapping[str, ElasticBody]) -> dict[str, ElasticBody]:
        """All bodies, with their legs; a `SpatialBody` where a joint is not along the normal."""
        bodies: dict[str, ElasticBody] = {**self.rigid, **{key: self._legged(key, elastic[key]) for key in elastic}}
        for object_id in inclined_in([joint for _, joints in self.groups for joint in joints]):
            rigid, bending = self.rigid.get(object_id), bodies[object_id]
            bodies[object_id] = inclined(self.plates[object_id], bending) if rigid is None else inclined_box(rigid)
        return bodies

    def _sampling(self, bodies: Mapping[str, ElasticBody], density: float) -> Sampling:
        losses = [body.loss_factor for body in bodies.values()]
        losses += [joint.loss_factor for _, joints in self.groups for joint in joints]
        return Sampling.of(self.bands, self.excitations, min(losses, default=1.0), density)

    def _legged(self, object_id: str, plate: ElasticBody) -> ElasticBody:
        """A plate with the mass of the rest of its object at its feet."""
        own = self.plates[object_id]
        rest_kg = own.moving_mass_kg - own.mass_kg
        legs = legs_of(self.network, object_id, own) if rest_kg > 0 and own.edges == "FFFF" else []
        return legged(plate, np.array(legs), np.full(len(legs), rest_kg / len(legs))) if legs else plate


def assemble(
    network: ContactNetwork,
    excitations: Sequence[Excitation],
    bands: Bands,
    law: ContactLaw,
    outside_domain: OutsideDomain = "warn",
) -> Assembly:
    """Find connected groups, rigid bodies and plates. For parameters, errors and warnings see `prepare_coupled`."""
    require_input(network, excitations, bands)
    mass_kg = {item.source_id: item.mass_kg for item in excitations}
    joints = joints_of(network, network.bodies.keys() | mass_kg.keys(), law, mass_kg)
    groups = source_groups(joints, mass_kg)
    own_hz = [bands.around_hz(item.frequency_tactile_hz)[1] for item in excitations if not bands.edges_hz]
    top_hz = max((*bands.edges_hz, *own_hz), default=0.0)
    rigid: dict[str, RigidMotion] = {}
    plates: dict[str, Plate] = {}
    for object_id in sorted({x for _, several in groups for joint in several for x in (joint.a, joint.b)}):
        body = network.bodies.get(object_id)
        if object_id in mass_kg:
            rigid[object_id] = RigidMotion.of(body, mass_kg[object_id], rocks=object_id in network.poses)
        elif isinstance(body, RigidBody) or (isinstance(body, Plate) and is_compact(body)):
            rigid[object_id] = RigidMotion.of(body, body.moving_mass_kg, rocks=object_id in network.poses)
        elif body is not None:
            plates[object_id] = no_heavier_than_object(body)
            check_thin(plates[object_id], top_hz, outside_domain, object_id)
    return Assembly(network, tuple(excitations), bands, groups, rigid, plates, top_hz)


@one_blas_thread
def prepare_coupled(
    model: CoupledModel,
    network: ContactNetwork,
    excitations: Sequence[Excitation],
    bands: Bands,
    outside_domain: OutsideDomain = "warn",
    density: float = 1.0,
) -> CoupledField:
    """Prepare the field of a scene.

    Parameters: model : makes the bodies of plates that are not compact; density : frequencies per band relative to the
    needed ones, for checks.
    Raises: ModelDomainError: so many contacts, or sources, that the solution exceeds `coupling.MOST_BYTES`.
    Raises, warns: ModelDomainError or ThinPlateWarning, as `outside_domain` says, for an object whose bending waves are
    shorter than six of its thicknesses.
    """
    scene = assemble(network, excitations, bands, model.contact, outside_domain)
    top_hz = scene.top_hz if bands.edges_hz else _next_step_hz(scene.top_hz)
    elastic = {key: model.elastic_body(plate, top_hz) for key, plate in scene.plates.items()}
    return scene.solve(elastic, density, model.hand)


@one_blas_thread
def prepare_struck(model: CoupledModel, network: ContactNetwork, touched_ids: Collection[str]) -> ImpactScene:
    """Prepare a scene for impacts on any point of the objects that are connected with touched ones.

    The only sources are probes on the touched objects, too light to change anything.
    Raises: ModelDomainError: see the model's `prepare`.
    """
    probes = {f"{_PROBE}{i}": object_id for i, object_id in enumerate(touched_ids)}
    places = {probe: network.poses.get(object_id, Pose()).position_m for probe, object_id in probes.items()}
    contacts = [Contact(probe, object_id, places[probe]) for probe, object_id in probes.items()]
    with_probes = replace(network, contacts=(*network.contacts, *contacts))
    sources = [Excitation(probe, 100.0, 100.0, _PROBE_KG) for probe in probes]
    # Preparing the field in use already warns of thick plates.
    scene = assemble(with_probes, sources, IMPACT_BANDS, model.contact, "ignore")
    elastic = {key: model.elastic_body(plate, scene.top_hz) for key, plate in scene.plates.items()}
    return scene.struck(touched_ids, elastic, model.hand)


def _next_step_hz(frequency_hz: float) -> float:
    """Round up to one of twenty steps per decade, so that bodies are reused when sources come and go."""
    return 10 ** (math.ceil(20 * math.log10(frequency_hz)) / 20) if frequency_hz > 0 else 0.0


def _solved(
    bodies: Mapping[str, ElasticBody],
    joints: Sequence[Joint],
    sources: Sequence[str],
    source_ids: tuple[str, ...],
    sampling: Sampling,
    hand: Hand | None,
) -> dict[str, SolvedObject]:
    _require_memory(joints, sources, sampling, hand)
    columns = np.array([source_ids.index(x) for x in sources])
    solved = couple(bodies, joints, sources, sampling.frequencies_hz, sampling.wanted(columns))
    forces = np.ascontiguousarray(solved.forces.transpose(1, 2, 0))
    if sampling.is_single:
        forces = np.take_along_axis(forces, columns[None, :, None], axis=2)[:, :, 0]
    loads = {x: None if hand is None else HandLoad(hand, x, solved) for x in solved.ends}
    return {x: SolvedObject(bodies[x], own, forces, columns, joints, loads[x]) for x, own in solved.ends.items()}


def _require_memory(joints: Sequence[Joint], sources: Sequence[str], sampling: Sampling, hand: Hand | None) -> None:
    """Check the memory that a group's solution takes as long as the field is in use."""
    n_f, n_sources = len(sampling.frequencies_hz), len(sources)
    forces = f"the forces of {counted(n_sources, 'source')} in {counted(len(joints), 'contact')}"
    require_memory(16 * n_f * len(joints) * n_sources, f"{forces} at {n_f:,} frequencies", "Leave sources out")
    if hand is not None:
        object_id, n = Counter(end for joint in joints for end in (joint.a, joint.b)).most_common(1)[0]
        load = f"the load of a hand on object {object_id!r} with {counted(n, 'contact')} at {n_f:,} frequencies"
        require_memory(16 * n_f * n**2, load, "Set hand to None")


@dataclass(frozen=True, eq=False)
class CoupledField:
    """A prepared scene: the forces in all contacts of the objects that a source reaches.

    The response of an object is prepared at the first query, or by `expect`.
    """

    source_ids: tuple[str, ...]
    bands: Bands
    network: ContactNetwork
    sampling: Sampling
    reach: Mapping[str, SolvedObject]
    _responses: dict[str, ObjectResponse] = field(init=False, repr=False, default_factory=dict)
    _expected: set[str] = field(init=False, repr=False, default_factory=set)

    @one_blas_thread
    def attenuation(self, object_id: str, points_m: ArrayLike) -> NDArray[np.float64]:
        """Deflection over the free deflection of each source; above 1 at resonances. See `PropagationField`."""
        points = object_points(object_id, points_m)
        found = self._responses.get(object_id)
        if found is None:
            # Another thread may have called `expect` by now.
            found = self._responses.setdefault(object_id, self._response(object_id))
        return found(points)

    @one_blas_thread
    def expect(self, object_id: str) -> None:
        """Prepare an object for many queries, see `ExpectantField`."""
        # If each source has one frequency, an existing response cannot become faster.
        ready = self._responses if self.sampling.is_single else self._expected
        if object_id not in ready:
            self._responses[object_id] = self._response(object_id, is_expected=True)
            self._expected.add(object_id)

    @one_blas_thread
    def carriers(self, object_id: str, source_id: str, band: int) -> tuple[Carrier, ...]:
        """The contacts through which power comes into an object, see `CarryingField`."""
        solved = self.reach.get(object_id)
        if solved is None or object_id == source_id or source_id not in self.source_ids:
            return ()
        shares = solved.shares_of_power(source_id, self.source_ids.index(source_id), band, self.sampling)
        pose = self.network.poses.get(object_id, Pose())
        at_m = solved.ends.points_m[:, :2]
        points = pose.to_world(np.column_stack([at_m, np.zeros(len(at_m))]))
        found: dict[tuple[str, tuple[float, float, float]], float] = {}
        for by, (x, y, z), share in zip(solved.others, points.tolist(), shares.tolist(), strict=True):
            if share > 0:  # joints of one contact in two directions are one carrier
                found[by, (x, y, z)] = found.get((by, (x, y, z)), 0.0) + share
        carriers = [Carrier(by, point_m, share) for (by, point_m), share in found.items()]
        return tuple(sorted(carriers, key=lambda one: (-one.share, one.by, one.point_m)))

    def _response(self, object_id: str, *, is_expected: bool = False) -> ObjectResponse:
        shape, ids = (len(self.source_ids), self.bands.n_bands), self.source_ids
        own = ids.index(object_id) if object_id in ids else -1
        solved, place = self.reach.get(object_id), self.network.placing(object_id)
        if solved is None:
            return ObjectResponse(place, _nothing_arrives, np.empty(0, dtype=np.intp), shape, own)
        return ObjectResponse(place, solved.gains(self.sampling, is_expected=is_expected), solved.columns, shape, own)


def _nothing_arrives(points_m: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.zeros((len(points_m), 0, 1))
