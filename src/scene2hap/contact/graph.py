"""Who touches whom, and where, as things move.

Contacts come from the scene's source where it tells them (an engine), else from geometry: surfaces within a tolerance,
which follows the objects unless one is stated (`contact.support`).
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from types import MappingProxyType
from typing import TYPE_CHECKING

from scene2hap import checks
from scene2hap.contact.body import Body
from scene2hap.contact.finder import ContactFinder, Pair
from scene2hap.errors import SceneError, UnknownObject
from scene2hap.scene.pose import Pose
from scene2hap.scene.snapshot import Contact, SceneObject, SceneSnapshot, unknown_object

if TYPE_CHECKING:
    import networkx


@dataclass(frozen=True)
class ContactChange:
    """What an update did, as pairs (a, b) of ids with a < b.

    `shifted` pairs are still in contact, with other points, another normal or another weight.
    """

    appeared: frozenset[Pair] = frozenset()
    vanished: frozenset[Pair] = frozenset()
    shifted: frozenset[Pair] = frozenset()

    def __bool__(self) -> bool:
        return bool(self.appeared or self.vanished or self.shifted)


class ContactGraph:
    """The contacts of a scene, kept up to date as its objects move.

    Parameters: tolerance_m >= 0 : gap at which any two surfaces cease to touch [m]; None follows the objects, since
    real scenes leave gaps of 0-45 mm under things that rest. Where the scene gives its contacts, these are taken as
    they are and the tolerance has no say.
    Raises: SceneError: the tolerance is negative or not finite.

    Poses alone decide what is found: moving there step by step ends in the same graph as building there. Found contacts
    go along with a motion of the whole scene (without a stated tolerance: with those that keep it upright). Up to four
    points stand for a pair's patch, and each bears the pair's weight: 1 up to two thirds of its tolerance, falling
    smoothly to 0. The normal points from a to b; it is None where surfaces touch sideways or cut each other. A thing
    wholly inside a closed other, away from its surface, does not touch it.
    """

    def __init__(self, scene: SceneSnapshot, *, tolerance_m: float | None = None) -> None:
        if tolerance_m is not None:
            hint = "Leave it out to follow the objects."
            tolerance_m = checks.number("tolerance_m", tolerance_m, "m", at_least=0.0, error=SceneError, hint=hint)
        self._up_axis = {"y": 1, "z": 2}[scene.up_axis]
        self._poses = {item.id: item.pose for item in scene.objects}
        self._pairs: dict[Pair, tuple[Contact, ...]] = {}
        self._finder: ContactFinder | None = None
        if scene.contacts is None:
            self._finder = ContactFinder(self._up_axis, tolerance_m)
            self._settle(self._finder.replace(Body.of(item, self._up_axis) for item in scene.objects))
        else:
            self._settle(_by_pair(scene.contacts))

    @property
    def contacts(self) -> tuple[Contact, ...]:
        """All contacts, a < b, sorted by pair; points in world coordinates [m]."""
        return self._reading.contacts

    @property
    def graph(self) -> networkx.Graph[str]:
        """Object ids as nodes; edges carry their `contacts` as a list. Drawn anew after a change."""
        return self._reading.graph

    @property
    def poses(self) -> Mapping[str, Pose]:
        """Where every object is; read-only, and left as it is by later updates."""
        return MappingProxyType(self._poses)

    def neighbours(self, object_id: str) -> tuple[str, ...]:
        """The ids of all that touch an object, sorted.

        Raises: UnknownObject: the id is not in the scene.
        """
        _demand(object_id, self._poses)
        return self._reading.neighbours.get(object_id, ())

    def update(
        self,
        moved: Mapping[str, Pose],
        *,
        added: Sequence[SceneObject] = (),
        removed: Sequence[str] = (),
        contacts: Sequence[Contact] | None = None,
    ) -> ContactChange:
        """Take objects out, in, and elsewhere, in this order; only pairs that this may change are looked at.

        `contacts`, from an engine, replaces all there are, and from then on contacts are only given, never found. Where
        contacts are given, those of an object that moves or goes are dropped unless the call brings new ones.

        Raises: UnknownObject: an id that is not in the scene. SceneError: an added id that already is, or a pose that
        is no Pose. The graph is then as it was.
        """
        poses = dict(self._poses)
        for x in removed:
            _demand(x, poses)
            del poses[x]
        for item in added:
            if item.id in poses:
                raise SceneError(f"object id {item.id!r} is already in the scene; remove it first or use another id.")
            poses[item.id] = item.pose
        for x, pose in moved.items():
            _demand(x, poses)
            if not isinstance(pose, Pose):
                raise SceneError(f"the pose of {x!r} is {pose!r}; it must be a Pose.")
            poses[x] = pose
        for contact in contacts or ():
            _demand(contact.a, poses)
            _demand(contact.b, poses)

        before, self._poses = self._poses, poses
        if contacts is not None:
            self._finder = None
            return self._settle(dict.fromkeys(self._pairs, ()) | _by_pair(contacts))
        stale = {x for x in before if poses.get(x) != before[x]} | {*removed, *(item.id for item in added)}
        if self._finder is None:
            return self._settle({pair: () for pair in self._pairs if not stale.isdisjoint(pair)})
        new = {item.id: Body.of(item, self._up_axis) for item in added}
        placed = {x: new[x] if x in new else self._finder.body(x) for x in stale & poses.keys()}
        bodies = [replace(body, pose=poses[x]) for x, body in sorted(placed.items())]
        return self._settle(self._finder.replace(bodies, stale - poses.keys()))

    def _settle(self, found: Mapping[Pair, tuple[Contact, ...]]) -> ContactChange:
        """Take over the contacts of these pairs, none for an empty tuple, and tell what that changes."""
        before = {pair: self._pairs.get(pair, ()) for pair in found}
        kept = {pair: contacts for pair, contacts in self._pairs.items() if pair not in found}
        self._pairs = kept | {pair: contacts for pair, contacts in found.items() if contacts}
        self._reading = _Reading(self._pairs, self._poses)
        stayed = (pair for pair in found if found[pair] and before[pair])
        return ContactChange(
            appeared=frozenset(pair for pair in found if found[pair] and not before[pair]),
            vanished=frozenset(pair for pair in found if before[pair] and not found[pair]),
            shifted=frozenset(pair for pair in stayed if found[pair] != before[pair]),
        )


class _Reading:
    """The views of one state of the graph, each made when first asked for."""

    def __init__(self, pairs: Mapping[Pair, tuple[Contact, ...]], ids: Iterable[str]) -> None:
        self._pairs, self._ids = pairs, tuple(ids)

    @cached_property
    def contacts(self) -> tuple[Contact, ...]:
        return tuple(contact for pair in sorted(self._pairs) for contact in self._pairs[pair])

    @cached_property
    def graph(self) -> networkx.Graph[str]:
        import networkx

        graph: networkx.Graph[str] = networkx.Graph()
        graph.add_nodes_from(sorted(self._ids))
        graph.add_edges_from((*pair, {"contacts": list(self._pairs[pair])}) for pair in sorted(self._pairs))
        return graph

    @cached_property
    def neighbours(self) -> dict[str, tuple[str, ...]]:
        beside: dict[str, list[str]] = {}
        for a, b in self._pairs:
            beside.setdefault(a, []).append(b)
            beside.setdefault(b, []).append(a)
        return {x: tuple(sorted(others)) for x, others in beside.items()}


def _by_pair(contacts: Iterable[Contact]) -> dict[Pair, tuple[Contact, ...]]:
    """Given contacts with a < b, in an order that does not depend on the giver's."""
    pairs: dict[Pair, list[Contact]] = {}
    for contact in contacts:
        if contact.a > contact.b:
            x = contact.normal
            turned = None if x is None else (-x[0], -x[1], -x[2])
            contact = replace(contact, a=contact.b, b=contact.a, normal=turned)
        pairs.setdefault((contact.a, contact.b), []).append(contact)
    return {pair: tuple(sorted(several, key=lambda one: one.point_m)) for pair, several in pairs.items()}


def _demand(object_id: str, known: Mapping[str, object]) -> None:
    if object_id not in known:
        raise UnknownObject(unknown_object(object_id, known))
