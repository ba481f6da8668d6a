"""Contacts at a stated tolerance: any two surfaces within it touch, without a rule of support or hanging."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence

from scene2hap.contact.body import Body, apart_by
from scene2hap.contact.broad_phase import BroadPhase
from scene2hap.contact.holders import NO_WAY, direction
from scene2hap.contact.junction import Junction, Pair, pair_of
from scene2hap.contact.mesh_distance import ROUNDING_M, MeshPair
from scene2hap.contact.rule import slack_m, weight
from scene2hap.scene.objects import SceneObject
from scene2hap.scene.pose import Pose


class TouchFinder:
    """Find contacts within one tolerance.

    Parameters: up_axis : 1 or 2, the world axis that points up; tolerance_m : gap at which any two surfaces cease to
    touch [m].
    """

    def __init__(self, up_axis: int, tolerance_m: float) -> None:
        self._up_axis, self._tolerance_m = up_axis, tolerance_m
        self._within_m = max(tolerance_m, ROUNDING_M)
        self._broad_phase = BroadPhase(up_axis, lambda _: (self._within_m, 0.0))
        self._bodies: dict[str, Body] = {}

    def replace(
        self, moved: Mapping[str, Pose], added: Sequence[SceneObject] = (), gone: Collection[str] = ()
    ) -> dict[Pair, Junction | None]:
        """Remove, add and move objects.

        Returns the junctions of all pairs that may have changed, None for pairs that do not touch.
        """
        bodies, broad_phase = self._bodies, self._broad_phase
        found: dict[Pair, Junction | None] = {}
        for x in gone:
            del bodies[x]
            found |= dict.fromkeys(pair_of(x, y) for y in broad_phase.remove(x))
        placed = [bodies[x].at(pose) for x, pose in moved.items()]
        placed += [Body.of(item, self._up_axis) for item in added]
        bodies.update((body.id, body) for body in placed)
        for x, lost in broad_phase.update(placed).items():
            found |= dict.fromkeys(pair_of(x, y) for y in lost)
        for body in placed:
            for y in broad_phase.neighbours[body.id]:
                pair = pair_of(body.id, y)
                if pair not in found:
                    found[pair] = self._junction(*pair)
        return found

    def _junction(self, a: str, b: str) -> Junction | None:
        """Return the contact points of two bodies, None if they do not touch."""
        one, other, tolerance_m = self._bodies[a], self._bodies[b], self._tolerance_m
        if apart_by(one, other, self._within_m):
            return None
        mesh_pair = MeshPair(one, other)
        gap = mesh_pair.gap(tolerance_m)
        share = 0.0 if gap is None else weight(gap.distance_m, tolerance_m)
        if gap is None or share <= 0:
            return None
        ends = mesh_pair.patch(NO_WAY, gap.distance_m + slack_m(min(one.size_m, other.size_m), tolerance_m))
        normal, n = direction(gap), len(ends)
        return Junction(tuple([x.middle_m for x in ends]), (share,) * n, (normal,) * n) if ends else None
