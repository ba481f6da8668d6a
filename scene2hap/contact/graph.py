"""The contact graph: which objects touch, and where, updated as they move.

Contacts come from the scene if it has them (from an engine), with those at hinges, else from geometry. Two surfaces
touch within a tolerance, which depends on the objects (`contact.rule`) unless one is stated.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import islice
from types import MappingProxyType
from typing import TYPE_CHECKING, cast

from scene2hap.common import checks
from scene2hap.common.calls import clear_construction
from scene2hap.common.counted import counted
from scene2hap.contact.finder import ContactFinder
from scene2hap.contact.hinge import contacts_at
from scene2hap.contact.junction import ContactArrays, Junction, Pair, junctions_of, pair_of
from scene2hap.contact.touch_finder import TouchFinder
from scene2hap.errors import SceneError, UnknownObject
from scene2hap.scene.arguments import given_scene
from scene2hap.scene.objects import Contact, SceneObject, unknown_object
from scene2hap.scene.pose import Pose
from scene2hap.scene.snapshot import SceneSnapshot

if TYPE_CHECKING:
    import networkx
    import numpy as np
    from numpy.typing import NDArray


@clear_construction
@dataclass(frozen=True)
class ContactChange:
    """The pairs (a, b) of ids, a < b, that an update changed.

    `shifted` pairs are still in contact, with other points, another normal or another weight.
    """

    appeared: frozenset[Pair] = frozenset()
    vanished: frozenset[Pair] = frozenset()
    shifted: frozenset[Pair] = frozenset()

    def __bool__(self) -> bool:
        return bool(self.appeared or self.vanished or self.shifted)


NO_CHANGE = ContactChange()

_LONGEST_LOG = 16  # Versions for which `changed_since` knows the changes.


@clear_construction
class ContactGraph:
    """The contacts of a scene, kept up to date as its objects move.

    Parameters: scene : a snapshot, or the path of a scene file; tolerance_m >= 0 : gap at which any two surfaces cease
    to touch [m]. None: tolerances depend on the objects, since real scenes leave gaps of 0-60 mm under objects at rest.
    The tolerance has no effect if the scene gives its contacts.
    Raises: SceneError: the tolerance is negative or not finite.

    The poses alone decide the result: incremental updates give bit-identical results to rebuilding from the same
    poses. Contacts move along with a motion of the whole scene; without a stated tolerance, only if it stays upright.
    Up to four points represent a pair's contact patch, each with the pair's weight: 1 up to two thirds of the
    tolerance, then falling smoothly to 0. The normal points from a to b. It is None for an enclosed object, and for
    surfaces beside each other that intersect or nearly touch. An object wholly inside a closed other, away from its
    surface, does not touch it.

    In loops, read `junctions` and `beside`: `update` changes them in place, and access makes no copy. `contacts`,
    `arrays` and `graph` are made from them on first access.
    """

    def __init__(self, scene: SceneSnapshot, *, tolerance_m: float | None = None) -> None:
        if tolerance_m is not None:
            hint = "Leave it out to follow the objects."
            tolerance_m = checks.number("tolerance_m", tolerance_m, "m", at_least=0.0, error=SceneError, hint=hint)
        scene = given_scene(scene)
        self._poses = {item.id: item.pose for item in scene.objects}
        self._poses_shared = False
        self._junctions: dict[Pair, Junction] = {}
        self._beside: dict[str, dict[str, Junction]] = {}
        self._version = self._topology = 0
        self._change_log: deque[list[Pair]] = deque(maxlen=_LONGEST_LOG)
        self._views: dict[str, object] = {}
        self._hinges = {item.id: item.hinge for item in scene.objects if item.hinge is not None}
        self._finder: ContactFinder | TouchFinder | None = None
        if scene.contacts is None:
            up_axis = {"y": 1, "z": 2}[scene.up_axis]
            self._finder = ContactFinder(up_axis) if tolerance_m is None else TouchFinder(up_axis, tolerance_m)
            self._replace({}, scene.objects)
        else:
            self._store(junctions_of([*scene.contacts, *contacts_at(self._hinges, self._poses)]))

    def __repr__(self) -> str:
        counts = f"{counted(len(self._poses), 'object')}, {counted(len(self._junctions), 'pair')}"
        return f"ContactGraph({counts} in contact)"

    @property
    def contacts(self) -> tuple[Contact, ...]:
        """All contacts, a < b, sorted by pair; points in world coordinates [m]."""
        found = self._views.get("contacts")
        if found is None:
            junctions = self._junctions
            found = tuple(one for pair in sorted(junctions) for one in junctions[pair].contacts(pair))
            self._views["contacts"] = found
        return cast("tuple[Contact, ...]", found)

    @property
    def arrays(self) -> ContactArrays:
        """All contacts as arrays, sorted by pair."""
        found = self._views.get("arrays")
        if found is None:
            found = self._views["arrays"] = ContactArrays.of(self._poses, self._junctions)
        return cast("ContactArrays", found)

    @property
    def graph(self) -> networkx.Graph[str]:
        """A networkx graph: object ids as nodes, edges with a list `contacts`. Built again after a change."""
        import networkx

        found = self._views.get("graph")
        if found is None:
            drawn: networkx.Graph[str] = networkx.Graph()
            drawn.add_nodes_from(sorted(self._poses))
            junctions = self._junctions
            drawn.add_edges_from((*x, {"contacts": list(junctions[x].contacts(x))}) for x in sorted(junctions))
            found = self._views["graph"] = drawn
        return cast("networkx.Graph[str]", found)

    @property
    def junctions(self) -> Mapping[Pair, Junction]:
        """The junctions by pair; read-only, and changed by later updates. A junction itself never changes."""
        return self._junctions

    @property
    def beside(self) -> Mapping[str, Mapping[str, Junction]]:
        """For each object with contacts, its junctions by the id of the other; read-only, changed by later updates."""
        return self._beside

    @property
    def version(self) -> int:
        """A number that changes with every update that changes a contact."""
        return self._version

    @property
    def topology(self) -> int:
        """A number that changes with every update by which a pair starts or stops touching."""
        return self._topology

    def changed_since(self, version: int) -> list[Pair] | None:
        """Return the pairs that appeared, vanished or shifted since a `version`, None if the log is too short."""
        log, n = self._change_log, self._version - version
        if not 0 <= n <= len(log):
            return None
        return log[-1] if n == 1 else [pair for entry in islice(reversed(log), n) for pair in entry]

    @property
    def poses(self) -> Mapping[str, Pose]:
        """The pose of every object; read-only, and not changed by later updates."""
        poses = self._poses
        self._poses_shared = True
        return MappingProxyType(poses)

    def __contains__(self, object_id: object) -> bool:
        return object_id in self._poses

    def pose(self, object_id: str) -> Pose:
        """Return the pose of an object. Raises: UnknownObject."""
        poses = self._poses
        try:
            return poses[object_id]
        except (KeyError, TypeError):
            _require_known(object_id, poses)
            raise

    def patch(self, a: str, b: str) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Return the contact points of a pair in a's and in b's frame, both (n, 3) [m]; n = 0 if they do not touch.

        Raises: UnknownObject: an id is not in the scene.
        """
        import numpy as np

        pose_a, pose_b = self.pose(a), self.pose(b)
        junction = self._beside.get(a, {}).get(b)
        points = np.array(junction.points_m if junction else ()).reshape(-1, 3)
        return pose_a.to_own(points), pose_b.to_own(points)

    def neighbours(self, object_id: str) -> tuple[str, ...]:
        """Return the ids of all objects that touch an object, sorted.

        Raises: UnknownObject: the id is not in the scene.
        """
        _require_known(object_id, self._poses)
        return tuple(sorted(self._beside.get(object_id, ())))

    def update(
        self,
        moved: Mapping[str, Pose],
        *,
        added: Sequence[SceneObject] = (),
        removed: Sequence[str] = (),
        contacts: Sequence[Contact] | None = None,
    ) -> ContactChange:
        """Remove, add and move objects, in this order. Only pairs that this may change are computed.

        `contacts`, from an engine, replaces all contacts; from then on contacts are given, never found, but for those
        at hinges. Given contacts of an object that moves or is removed are dropped, unless the call gives new ones.

        Raises: UnknownObject: an id that is not in the scene. SceneError: an added id that is already in the scene, or
        a pose that is no Pose. The graph is then unchanged.
        """
        if type(moved) is not dict and not isinstance(moved, Mapping):
            given = checks.described(moved)
            raise SceneError(f"moved is {given}; it must be a mapping of ids to poses, as {{'mug': Pose(...)}}.")
        if added or removed or contacts is not None:
            if isinstance(added, SceneObject) or isinstance(removed, str):
                raise SceneError("added and removed must be lists, as added=[SceneObject(...)] and removed=['mug'].")
            added = checks.instances("added", added, SceneObject, "a list of SceneObject", error=SceneError)
            removed = checks.items("removed", removed, at_most=len(self._poses), error=SceneError)
            if contacts is not None:
                wanted = "a list, as [Contact('mug', 'table', point_m)]"
                contacts = checks.instances("contacts", contacts, Contact, wanted, error=SceneError)
            return self._rebuild(moved, added, removed, contacts)
        stale = {}
        poses = self._poses
        for x, pose in moved.items():
            if x not in poses:
                _require_known(x, poses)
            if not isinstance(pose, Pose):
                _require_pose(x, pose)
            here = poses[x]
            if here is not pose and (here.position_m != pose.position_m or here.rotation_xyzw != pose.rotation_xyzw):
                stale[x] = pose
        if not stale:
            return NO_CHANGE
        if self._poses_shared:
            self._poses, self._poses_shared = dict(poses), False
        self._poses.update(stale)
        return self._replace(stale)

    def _rebuild(
        self,
        moved: Mapping[str, Pose],
        added: Sequence[SceneObject],
        removed: Sequence[str],
        contacts: Sequence[Contact] | None,
    ) -> ContactChange:
        """Update objects or given contacts, besides poses."""
        poses = dict(self._poses)
        for x in removed:
            _require_known(x, poses)
            del poses[x]
        for item in added:
            if item.id in poses:
                raise SceneError(f"object id {item.id!r} is already in the scene; remove it first or use another id.")
            poses[item.id] = item.pose
        for x, pose in moved.items():
            _require_known(x, poses)
            _require_pose(x, pose)
            poses[x] = pose
        for contact in contacts or ():
            _require_known(contact.a, poses)
            _require_known(contact.b, poses)

        before, self._poses, self._poses_shared = self._poses, poses, False
        for x in removed:
            self._hinges.pop(x, None)
        self._hinges.update((item.id, item.hinge) for item in added if item.hinge is not None)
        if contacts is not None:
            self._finder = None
            given = junctions_of([*contacts, *contacts_at(self._hinges, poses)])
            return self._store({**dict.fromkeys(self._junctions), **given})
        stale = {x for x in moved if x in before and poses[x] != before[x]} | {*removed, *(item.id for item in added)}
        new = {item.id for item in added}
        elsewhere = {x: poses[x] for x in stale & poses.keys() if x not in new}
        items = [replace(item, pose=moved[item.id]) if item.id in moved else item for item in added]
        return self._replace(elsewhere, items, stale & before.keys() & {*removed})

    def _replace(
        self, moved: Mapping[str, Pose], added: Sequence[SceneObject] = (), gone: Collection[str] = ()
    ) -> ContactChange:
        """Let the finder update the contacts of these objects, or drop those that were given. Returns the change."""
        if self._finder is not None:
            return self._store(self._finder.replace(moved, added, gone))
        stale = {*moved, *gone}
        dropped = {pair_of(x, y): None for x in stale for y in self._beside.get(x, ())}
        at_hinges = contacts_at(self._hinges, self._poses, stale | {item.id for item in added})
        return self._store({**dropped, **junctions_of(at_hinges)})

    def _store(self, found: Mapping[Pair, Junction | None]) -> ContactChange:
        """Store the junctions of these pairs, None for no contact, and log the change. Returns the change."""
        appeared: list[Pair] = []
        vanished: list[Pair] = []
        shifted: list[Pair] = []
        junctions, beside = self._junctions, self._beside
        for pair, junction in found.items():
            before = junctions.get(pair)
            if junction == before:
                continue
            a, b = pair
            if junction is None:
                vanished.append(pair)
                del junctions[pair]
                for x, y in ((a, b), (b, a)):
                    del beside[x][y]
                    if not beside[x]:
                        del beside[x]
                continue
            (appeared if before is None else shifted).append(pair)
            junctions[pair] = junction
            if before is None:
                beside.setdefault(a, {})[b] = beside.setdefault(b, {})[a] = junction
            else:
                beside[a][b] = beside[b][a] = junction
        if self._views:
            self._views.clear()
        if not (appeared or vanished or shifted):
            return NO_CHANGE
        self._version += 1
        self._change_log.append(appeared + vanished + shifted)
        if appeared or vanished:
            self._topology += 1
        return ContactChange(frozenset(appeared), frozenset(vanished), frozenset(shifted))


def _require_known(object_id: str, known: Mapping[str, object]) -> None:
    if not isinstance(object_id, str) or object_id not in known:
        raise UnknownObject(unknown_object(object_id, known))


def _require_pose(object_id: str, pose: object) -> None:
    if not isinstance(pose, Pose):
        raise SceneError(f"the pose of {object_id!r} is {checks.represented(pose)}; it must be a Pose.")
