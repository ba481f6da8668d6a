"""The present scene: objects, their materials, poses and contacts."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from typing import NamedTuple, TypeVar

import numpy as np

from scene2hap.bundle import HapticBundle
from scene2hap.contact.graph import ContactChange, ContactGraph
from scene2hap.contact.junction import Junction, Pair
from scene2hap.errors import UnknownObject
from scene2hap.haptics import ObjectHaptics
from scene2hap.propagation.protocol import Body, ContactNetwork, placing_of
from scene2hap.scene.geometry import Vector
from scene2hap.scene.objects import VERTICAL, Contact, SceneObject, unknown_object, with_known_up
from scene2hap.scene.pose import Pose
from scene2hap.scene.snapshot import SceneSnapshot
from scene2hap.session.present_scene.network import (
    BoxCentres,
    Corners,
    PlatePoses,
    body_of,
    own_half_m,
    own_middle_m,
    rigid_body_of,
)
from scene2hap.session.present_scene.reach import Reach, reach_over
from scene2hap.session.unknown_names import RemovedIds

Thing = TypeVar("Thing")


class ModelInput(NamedTuple):
    """The input of a model; `covers` are the objects that its field covers, None for all."""

    network: ContactNetwork
    covers: Collection[str] | None = None


class SceneState:
    """The objects of a session. Mappings are replaced, never changed, so that another thread can read them."""

    def __init__(self, scene: SceneSnapshot, bundle: HapticBundle, *, follows_outlines: bool = False) -> None:
        self._scene, self._follows_outlines = scene, follows_outlines
        self.objects: Mapping[str, SceneObject] = {item.id: item for item in scene.objects}
        self.haptics: Mapping[str, ObjectHaptics] = bundle.objects
        bodies = ((item.id, self._body(item, bundle.objects.get(item.id))) for item in scene.objects)
        self.bodies: Mapping[str, Body] = {object_id: body for object_id, body in bodies if body is not None}
        self.graph: ContactGraph = ContactGraph(scene)
        self._contact_lists = _ContactLists()
        self._corners: Corners = {}
        self.ids: frozenset[str] = frozenset(self.objects)
        self._removed = RemovedIds()

    @property
    def snapshot(self) -> SceneSnapshot:
        """The present scene."""
        scene = SceneSnapshot(self._scene.name, self._scene.up_axis, tuple(self.objects.values()))
        return scene.with_poses(self.graph.poses)

    @property
    def up_axis(self) -> int:
        """Number of the vertical axis."""
        return VERTICAL[self._scene.up_axis]

    @property
    def bodiless(self) -> tuple[str, ...]:
        """Objects whose material is unknown."""
        return tuple(object_id for object_id in self.objects if object_id not in self.bodies)

    @property
    def poses(self) -> Mapping[str, Pose]:
        """Pose of every object. The mapping never changes; a move makes a new one."""
        return self.graph.poses

    @property
    def contacts(self) -> tuple[Contact, ...]:
        """All contacts, sorted by pair. Those of unchanged pairs are not made again."""
        return self._contact_lists.of(self.graph.junctions)

    def require(self, object_id: object, hint: str = "") -> None:
        """Raise an UnknownObject, with a hint at the end of its message, if an object is not in the scene."""
        if isinstance(object_id, str) and object_id in self.objects:
            return
        hint = self._removed.hint(object_id) + hint
        raise UnknownObject(unknown_object(object_id, self.objects) + hint)

    def category(self, object_id: str) -> str:
        """Category of an object, empty if unknown."""
        haptics = self.haptics.get(object_id)
        return haptics.object_category if haptics is not None else ""

    def add(self, item: SceneObject, haptics: ObjectHaptics | None) -> ContactChange:
        """Add an object. Raises: SceneError: its id is taken."""
        item = with_known_up(item, self._scene.up_axis)
        body = self._body(item, haptics)
        change = self.graph.update({}, added=[item])
        self._put(item.id, item, haptics, body)
        return change

    def _body(self, item: SceneObject, haptics: ObjectHaptics | None) -> Body | None:
        return body_of(haptics, item.surface if self._follows_outlines else None)

    def remove(self, object_id: str) -> ContactChange:
        """Remove an object. Raises: UnknownObject."""
        change = self.graph.update({}, removed=[object_id])
        self._put(object_id, None, None, None)
        self._removed.add(object_id)
        # A copy, since another thread may still write to the former mapping.
        self._corners = _with(self._corners, object_id, None)
        return change

    def _put(self, object_id: str, item: SceneObject | None, haptics: ObjectHaptics | None, body: Body | None) -> None:
        self.objects = _with(self.objects, object_id, item)
        self.ids = frozenset(self.objects)
        self.haptics = _with(self.haptics, object_id, haptics)
        self.bodies = _with(self.bodies, object_id, body)

    def middle_m(self, object_id: str) -> Vector:
        """Middle of the box around an object, in its own frame [m]."""
        return own_middle_m(self.objects[object_id])

    def half_m(self, object_id: str) -> Vector:
        """Half the sides of this box [m]."""
        return own_half_m(self.objects[object_id])

    def on_plate(self, object_id: str, point_m: tuple[float, float, float]) -> tuple[float, float] | None:
        """Coordinates of a world point [m] along length and width of an object's plate; None without a plate."""
        body = self.bodies.get(object_id)
        if body is None:
            return None
        # Not `poses`: the next move would then have to copy the mapping.
        corners = PlatePoses(self.objects, self.bodies, {object_id: self.graph.pose(object_id)}, self._corners)
        ((x, y),) = placing_of(body, corners.get(object_id))(np.array([point_m])).tolist()
        return x, y

    def meeting(self, object_id: str) -> Body:
        """The body of an object in an impact, striking or struck, also if its material is unknown."""
        body = self.bodies.get(object_id)
        return rigid_body_of(self.objects[object_id], self.haptics.get(object_id)) if body is None else body

    def reach(self, source_ids: Sequence[str]) -> Reach:
        """The present groups of connected objects, and the sources in each."""
        return Reach(self.graph.beside, {*self.bodies, *source_ids}, source_ids)

    def touches_a_body(self, object_id: str) -> bool:
        """Return True if an object touches another one whose material is known."""
        return any(x in self.bodies for x in self.graph.beside.get(object_id, ()))

    def network(self, source_ids: Sequence[str] | None) -> Callable[[Collection[str]], ModelInput]:
        """Return a function that makes the model's input for the present state: all objects, or those a source reaches.

        Given some objects, the function includes only the objects connected to them, if a source is among these. It may
        be called later and in another thread, since listing contacts takes longer than an update may.
        """
        objects, bodies, poses, junctions = self.objects, self.bodies, self.poses, dict(self.graph.junctions)
        lists, corners, up_axis = self._contact_lists, self._corners, self._scene.up_axis
        middles_m = BoxCentres(objects, poses)

        def put_together(near: Collection[str]) -> ModelInput:
            if source_ids is None:
                everywhere = PlatePoses(objects, bodies, poses, corners)
                return ModelInput(ContactNetwork(bodies, lists.of(junctions), everywhere, up_axis, middles_m))
            reach = reach_over(junctions, {*bodies, *source_ids}, source_ids)
            everything = reach.objects
            reached = reach.objects_near(near) or everything
            among = {object_id: body for object_id, body in bodies.items() if object_id in reached}
            within = {pair: one for pair, one in junctions.items() if pair[0] in reached}
            corners_of = PlatePoses(objects, among, poses, corners)
            network = ContactNetwork(among, lists.of(within), corners_of, up_axis, middles_m)
            return ModelInput(network, None if len(reached) == len(everything) else reached)

        return put_together


class _ContactLists:
    """Converts junctions to contacts, and caches the contacts of unchanged junctions."""

    def __init__(self) -> None:
        self._known: dict[Pair, tuple[Junction, tuple[Contact, ...]]] = {}

    def of(self, junctions: Mapping[Pair, Junction]) -> tuple[Contact, ...]:
        """All contacts, sorted by pair."""
        before, known = self._known, {}
        for pair in sorted(junctions):
            junction, last = junctions[pair], before.get(pair)
            known[pair] = last if last is not None and last[0] is junction else (junction, junction.contacts(pair))
        self._known = known
        return tuple(contact for _, contacts in known.values() for contact in contacts)


def _with(mapping: Mapping[str, Thing], key: str, value: Thing | None) -> dict[str, Thing]:
    """A copy with another value of a key, or without the key if the value is None."""
    changed = dict(mapping)
    changed.pop(key, None)
    if value is not None:
        changed[key] = value
    return changed
