"""Contacts from geometry: certificates, broad phase, narrow phase, and the rule of support and hanging.

Stored data of a pair depend on the poses of its two bodies alone, and the holders of a body on its pairs alone. So
incremental updates give bit-identical results to rebuilding from nothing. Nothing else is stored for a certified body:
when its certificate ends, it gets a new one or its contacts are searched from nothing.
"""

from __future__ import annotations

from collections.abc import Collection, Container, Mapping, Sequence

from scene2hap.contact.body import Body, apart_by
from scene2hap.contact.broad_phase import BroadPhase
from scene2hap.contact.certificate import Certificate
from scene2hap.contact.certificate_issuer import CertificateIssuer
from scene2hap.contact.hinge import are_hinged
from scene2hap.contact.holders import Holders
from scene2hap.contact.junction import Junction, Pair, pair_of
from scene2hap.contact.pair import BodyPair, BodyPairs
from scene2hap.contact.rule import TOUCH_M, margins_m
from scene2hap.scene.objects import SceneObject
from scene2hap.scene.pose import Pose


class ContactFinder:
    """Find contacts with the tolerances of `contact.rule`, which depend on the objects' sizes.

    Parameters: up_axis : 1 or 2, the world axis that points up.
    """

    def __init__(self, up_axis: int) -> None:
        self._up_axis = up_axis
        self._broad_phase = BroadPhase(up_axis, margins_m)
        certified: dict[str, Certificate] = {}
        self._pairs = BodyPairs()
        self._bodies = self._pairs.bodies
        self._holders = Holders(self._pairs, self._broad_phase.neighbours, certified)
        self._unsupported = self._holders.unsupported
        self._issuer = CertificateIssuer(self._pairs, self._unsupported, self._broad_phase, certified)

    def replace(
        self, moved: Mapping[str, Pose], added: Sequence[SceneObject] = (), gone: Collection[str] = ()
    ) -> dict[Pair, Junction | None]:
        """Remove, add and move objects.

        Returns the junctions of all pairs that may have changed, None for pairs that do not touch.
        """
        bodies, issuer = self._bodies, self._issuer
        found: dict[Pair, Junction | None] = {}
        ended = issuer.end_pinned((*moved, *gone))
        placed = [bodies[x] for x in ended if x not in moved and x not in gone]
        certified = issuer.of
        for x, pose in moved.items():
            certificate = certified.get(x)
            if certificate is None or not certificate.step(pose, found):
                issuer.end(x)
                placed.append(bodies[x].at(pose))
        if placed or added or gone:
            self._search(placed, [Body.of(item, self._up_axis) for item in added], gone, found)
        return found

    def _search(
        self, placed: list[Body], added: Sequence[Body], gone: Collection[str], found: dict[Pair, Junction | None]
    ) -> None:
        """Find the contacts of `placed` and `added` bodies, and of all bodies that these affect."""
        bodies, issuer, hinged = self._bodies, self._issuer, self._pairs.hinged
        dirty: set[Pair] = set()
        recheck: set[str] = set()
        for x in gone:
            self._remove(x, found, recheck)
        for body in (*placed, *added):
            bodies[body.id] = body
        for body in added:
            hinged.add(body)
        moving = {body.id for body in placed}
        changed = {*moving, *gone, *(body.id for body in added)}
        placed += [bodies[x] for x in hinged.update(changed) if x not in changed]
        for x, others in self._broad_phase.update([*placed, *added]).items():
            for y in others:
                self._drop_pair(x, y, found, recheck)
        proven = {}
        pending = [*added]
        for body in placed:
            is_free = body.id not in hinged.on and issuer.may_be_issued(body.id)
            junction = self._certify(body, moving, dirty, recheck) if is_free else None
            if junction is None:
                pending.append(body)
            else:
                proven[body.id] = junction
        while pending or recheck:
            for body in pending:
                issuer.end(body.id)
                pending += issuer.separate_from_neighbours(body)
            seen: set[str] = set()
            for body in pending:
                self._pair_with_neighbours(body, seen, dirty, recheck)
                seen.add(body.id)
            pending = []
            recheck.update(seen)
            for x in recheck:
                if x in bodies and x not in issuer.of and self._update_holders(x, dirty):
                    pending += issuer.separate_from_neighbours(bodies[x])
            recheck = set()
        found.update((pair, self._holders.junction(pair)) for pair in dirty)
        for x, junctions in proven.items():
            if x in issuer.of:
                found.update(junctions)

    def _remove(self, x: str, found: dict[Pair, Junction | None], recheck: set[str]) -> None:
        """Remove a body with all its pairs."""
        self._pairs.hinged.remove(self._bodies.pop(x))
        self._issuer.forget(x)
        for y in self._broad_phase.remove(x):
            self._drop_pair(x, y, found, recheck)
        self._pairs.of.pop(x, None)
        found |= dict.fromkeys(pair_of(x, y) for y in self._holders.forget(x))

    def _certify(
        self, body: Body, moving: Container[str], dirty: set[Pair], recheck: set[str]
    ) -> dict[Pair, Junction | None] | None:
        """Issue a certificate to a body if possible. Returns its junctions, None without a certificate.

        Its stored pairs are dropped. Pairs and bodies that this may change go into `dirty` and `recheck`.
        """
        x, holders = body.id, self._holders
        resting = self._issuer.resting(body, holders.held.get(x, ()))
        junctions = self._issuer.issue(body, resting, moving)
        if junctions is None:
            return None
        for y in list(self._pairs.of.setdefault(x, {})):
            body_pair = self._pairs.drop(x, y)
            if _may_rest(y, body_pair) or (y in self._unsupported and body.size_m > self._bodies[y].size_m):
                recheck.add(y)
            dirty.add(pair_of(x, y))
        on, fall_m = (None, 0.0) if resting is None else (resting.support.id, resting.rest.fall_m)
        dirty.update(pair_of(x, y) for y in holders.rest_alone(body, on, fall_m))
        return junctions

    def _drop_pair(self, x: str, y: str, found: dict[Pair, Junction | None], recheck: set[str]) -> None:
        """Drop the pair of two bodies that are no longer neighbours."""
        body_pair = self._pairs.drop(x, y)
        if body_pair is not None:
            found[body_pair.a.id, body_pair.b.id] = None
            if _may_rest(y, body_pair) or y in self._unsupported:
                recheck.add(y)

    def _pair_with_neighbours(self, body: Body, seen: set[str], dirty: set[Pair], recheck: set[str]) -> None:
        """Pair a body that moved with the bodies now near enough to touch it."""
        x, bodies, certificates, unsupported = body.id, self._bodies, self._issuer.of, self._unsupported
        are_chained = self._pairs.hinged.are_chained
        body_pairs = self._pairs.of.setdefault(x, {})
        for y in self._broad_phase.neighbours[x]:
            if y in certificates:
                continue
            other, old = bodies[y], body_pairs.get(y)
            if are_chained(x, y) and not are_hinged(body, other):
                if self._pairs.drop(x, y) is not None:
                    dirty.add(pair_of(x, y))
                    recheck.add(y)
                continue
            if y in seen:
                continue
            body_pair = self._pairs.made(body, other)
            if (
                body_pair.faller is None
                and body_pair.pivot_m is None
                and (apart_by(body, other, TOUCH_M) or body_pair.space.empty_region is not None)
            ):
                if self._pairs.drop(x, y) is not None:
                    dirty.add(pair_of(x, y))
            else:
                self._pairs.add(body_pair)
                dirty.add(pair_of(x, y))
            may_hang = y in unsupported and body.size_m > other.size_m
            if may_hang or _may_rest(y, body_pair) or _may_rest(y, old):
                recheck.add(y)

    def _update_holders(self, x: str, dirty: set[Pair]) -> bool:
        """Update the holders of a body. Pairs whose attachment may have changed become dirty.

        Returns True if the body has lost its full support.
        """
        was_unsupported = x in self._unsupported
        dirty.update(pair_of(x, y) for y in self._holders.update(x))
        return x in self._unsupported and not was_unsupported


def _may_rest(y: str, body_pair: BodyPair | None) -> bool:
    """Return True if y, one body of a pair, may rest on the other."""
    return body_pair is not None and body_pair.faller == y
