"""Contacts from geometry: certificates, broad phase, narrow phase, and what holds what.

All that is kept about a pair depends on the poses of its two objects alone, and what holds an object on its pairs
alone, so that moving step by step ends exactly where building from nothing does. Of a body that goes by its certificate
nothing else is kept: once that ends, the body is proven again, or looked at from nothing.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence

from scene2hap.contact.body import Body
from scene2hap.contact.bond import Bond
from scene2hap.contact.broad_phase import BroadPhase
from scene2hap.contact.certificate import (
    Certificate,
    Extent,
    Resting,
    junction_of,
    resting_on,
    separated,
    standing_planes,
)
from scene2hap.contact.free_space import free_planes, has_nothing_near
from scene2hap.contact.holding import Holding
from scene2hap.contact.junction import Junction, Pair, pair_of
from scene2hap.contact.pair import BodyPair, apart_by
from scene2hap.contact.planes import Plane
from scene2hap.contact.relative import roles
from scene2hap.contact.support import TOUCH_M, Support, fall_reach_m, hang_reach_m, margins_m
from scene2hap.scene.pose import Pose
from scene2hap.scene.snapshot import SceneObject

_LONGEST_WAIT = 7
"""So many moves a body waits at most for its next certificate, once several were refused or did not hold for a step."""


class ContactFinder:
    """The contacts between things, with tolerances that follow them as `contact.support` does.

    Parameters: up_axis : 1 or 2, the world axis that points up.
    """

    def __init__(self, up_axis: int) -> None:
        self._up_axis = up_axis
        self._broad_phase = BroadPhase(up_axis, margins_m)
        self._certificates: dict[str, Certificate] = {}
        # By the ids of those that must stay where they are: whose certificates end when they move.
        self._pinned: dict[str, set[str]] = {}
        # Moves that a body is still to wait for its next attempt at a certificate, and had to wait for this one.
        self._waits: dict[str, tuple[int, int]] = {}
        holding = self._holding = Holding(up_axis, self._broad_phase.neighbours, self._certificates)
        self._bodies, self._body_pairs, self._held, self._unsupported = (
            holding.bodies,
            holding.body_pairs,
            holding.held,
            holding.unsupported,
        )

    def replace(
        self, moved: Mapping[str, Pose], added: Sequence[SceneObject] = (), gone: Collection[str] = ()
    ) -> dict[Pair, Junction | None]:
        """Take things out, in, and elsewhere.

        Returns where the pairs touch that may have changed, None for those that do not touch.
        """
        bodies, certificates = self._bodies, self._certificates
        found: dict[Pair, Junction | None] = {}
        placed: list[Body] = []
        if self._pinned:
            for x in (*moved, *gone):
                revoked = [y for y in self._pinned.pop(x, ()) if self._revoke(y, x)]
                placed += [bodies[y] for y in revoked if y not in moved and y not in gone]
        for x, pose in moved.items():
            certificate = certificates.get(x)
            if certificate is None or not certificate.step(pose, found):
                self._end(x)
                placed.append(bodies[x].at(pose))
        if placed or added or gone:
            self._look_anew(placed, [Body.of(item, self._up_axis) for item in added], gone, found)
        return found

    def _revoke(self, x: str, pin: str) -> bool:
        """End a certificate that relies on where another is. Returns whether there was one."""
        certificate = self._certificates.get(x)
        return certificate is not None and pin in certificate.pins and self._end(x)

    def _end(self, x: str) -> bool:
        """End a certificate. Returns whether there was one."""
        certificate = self._certificates.pop(x, None)
        if certificate is not None and not certificate.has_held:
            self._wait(x)
        return certificate is not None

    def _wait(self, x: str) -> None:
        """Have a body wait longer for its next certificate than for its last."""
        _, length = self._waits.get(x, (0, 0))
        length = min(2 * length + 1, _LONGEST_WAIT)
        self._waits[x] = (length, length)

    def _look_anew(
        self, placed: list[Body], added: Sequence[Body], gone: Collection[str], found: dict[Pair, Junction | None]
    ) -> None:
        """Find the contacts of bodies without a certificate, and of all to whom these matter."""
        bodies, certificates = self._bodies, self._certificates
        dirty: set[Pair] = set()
        unsure: set[str] = set()
        for x in gone:
            self._remove(x, found, unsure)
        for body in (*placed, *added):
            bodies[body.id] = body
        for x, others in self._broad_phase.update([*placed, *added]).items():
            for y in others:
                self._part(x, y, found, unsure)
        proven = {}
        uncertain = [*added]
        for body in placed:
            junction = self._certify(body, dirty, unsure) if self._may_be_certified(body.id) else None
            if junction is None:
                uncertain.append(body)
            else:
                proven[body.id] = junction
        while uncertain or unsure:
            for body in uncertain:
                uncertain += self._crowded_out(body)
            seen: set[str] = set()
            for body in uncertain:
                self._look_around(body, seen, dirty, unsure)
                seen.add(body.id)
            uncertain = []
            unsure.update(seen)
            for x in unsure:
                if x in bodies and x not in certificates and self._hold_anew(x, dirty):
                    uncertain += self._crowded_out(bodies[x])
            unsure = set()
        found.update(self._holding.junctions(dirty))
        for x, junctions in proven.items():
            if x in certificates:
                found.update(junctions)

    def _remove(self, x: str, found: dict[Pair, Junction | None], unsure: set[str]) -> None:
        del self._bodies[x]
        self._certificates.pop(x, None)
        for y in self._broad_phase.remove(x):
            self._part(x, y, found, unsure)
        self._body_pairs.pop(x, None)
        held = self._held.pop(x, None)
        for y in held or ():
            found[pair_of(x, y)] = None
        self._unsupported.discard(x)
        self._waits.pop(x, None)

    def _may_be_certified(self, x: str) -> bool:
        left, length = self._waits.get(x, (0, 0))
        if left:
            self._waits[x] = (left - 1, length)
        return not left

    def _certify(self, body: Body, dirty: set[Pair], unsure: set[str]) -> dict[Pair, Junction | None] | None:
        """Prove that a body stands wholly on one other and touches nothing else, or touches nothing.

        Returns where it touches, None if there is no proof.
        """
        x = body.id
        resting = self._resting(body)
        bond = None
        if resting is not None:
            bond = self._holding.support(x, resting.support.id, Support(1.0, resting.rest.fall_m), lies=True)
        certificate = self._proof(body, resting, bond)
        if certificate is None:
            self._wait(x)
            return None
        _, length = self._waits.pop(x, (0, 0))
        if length:
            self._waits[x] = (0, length // 2)
        self._certificates[x] = certificate
        for z in certificate.pins:
            self._pinned.setdefault(z, set()).add(x)
        body_pairs = self._body_pairs.get(x, {})
        for y, body_pair in body_pairs.items():
            del self._body_pairs[y][x]
            if body_pair.rest(y) is not None or (y in self._unsupported and body.size_m > self._bodies[y].size_m):
                unsure.add(y)
            dirty.add(pair_of(x, y))
        self._body_pairs[x] = {}
        dirty.update(pair_of(x, y) for y in self._held.pop(x, ()))
        if resting is None or bond is None:
            self._unsupported.add(x)
            return {}
        self._unsupported.discard(x)
        self._held[x] = {resting.support.id: bond}
        return {pair_of(x, resting.support.id): junction_of(body, resting, bond.normal)}

    def _resting(self, body: Body) -> Resting | None:
        """How a body stands on one of its neighbours, on what held it before if it still does."""
        bodies, up, flat = self._bodies, body.up_axis, body.v_axis
        low, high, held = body.low, body.high, self._held.get(body.id, ())
        u0, v0, u1, v1, lowest = low[0], low[flat], high[0], high[flat], low[up] - fall_reach_m(body.size_m)
        below = []
        for y in self._broad_phase.neighbours[body.id]:
            other = bodies[y]
            low, high = other.low, other.high
            if low[0] < u1 and high[0] > u0 and low[flat] < v1 and high[flat] > v0 and high[up] > lowest:
                below.append(other)
        below.sort(key=lambda other: (other.id not in held, other.size_m))
        for other in below:
            resting = resting_on(body, other)
            if resting is not None:
                return resting
        return None

    def _proof(self, body: Body, resting: Resting | None, bond: Bond | None) -> Certificate | None:
        """A certificate for a body that stands so, if planes divide it from all others, whose then have them too."""
        x, bodies, certificates, unsupported = body.id, self._bodies, self._certificates, self._unsupported
        certificate = Certificate(body, self._broad_phase.room(x), resting, None if bond is None else bond.normal)
        planes: dict[str, tuple[Plane, ...]] = {}
        if resting is not None:
            support = resting.support
            known = standing_planes(body, resting)
            # What bears has no certificate, and what is in the air may hang from what it bears.
            if known is None or support.id in certificates:
                return None
            if support.id in unsupported and support.size_m < body.size_m:
                return None
            planes[support.id] = known
        own, theirs = certificate.extent, []
        for z in self._broad_phase.neighbours[x]:
            if z == certificate.on:
                continue
            its_own, other = certificates.get(z), bodies[z]
            extent = Extent.fixed(other) if its_own is None else its_own.extent
            apart = separated(own, extent, self._reach_m(body, other, resting is None))
            if apart is not None:
                planes[z] = apart.one
                if its_own is not None:
                    theirs.append((its_own, apart.other))
            elif its_own is None and roles(body, other)[0] is body and has_nothing_near(body, other):
                free = free_planes(body, other, stands=False)
                if free is None:
                    return None
                planes[z] = free
                certificate.pins.add(z)
            else:
                return None
        certificate.keep_behind(planes)
        if not certificate.holds:
            return None
        for its_own, its_planes in theirs:
            its_own.keep_behind({x: its_planes})
        return certificate

    def _reach_m(self, x: Body, y: Body, is_in_air: bool) -> float:
        """How near two may come: the smaller hangs from the larger if nothing supports it."""
        small, hangs = (x, is_in_air) if x.size_m < y.size_m else (y, y.id in self._unsupported)
        return max(TOUCH_M, hang_reach_m(small.size_m)) if hangs else TOUCH_M

    def _crowded_out(self, body: Body) -> list[Body]:
        """Divide a body that is elsewhere, or hangs now, from those around it that have certificates.

        Returns the bodies that lose theirs.
        """
        x, certificates, out = body.id, self._certificates, []
        self._end(x)
        extent, hangs = Extent.fixed(body), x in self._unsupported
        for z in self._broad_phase.neighbours[x]:
            certificate = certificates.get(z)
            if certificate is None:
                continue
            other = certificate.body
            if x in certificate.pins:
                if not (hangs and body.size_m < other.size_m):
                    continue
                apart = None
            else:
                apart = separated(certificate.extent, extent, self._reach_m(other, body, z in self._unsupported))
            if apart is None:
                self._end(z)
                out.append(other)
            else:
                certificate.keep_behind({x: apart.one})
        return out

    def _part(self, x: str, y: str, found: dict[Pair, Junction | None], unsure: set[str]) -> None:
        """Note that two are neighbours no more."""
        mine = self._body_pairs.get(x)
        body_pair = mine.pop(y, None) if mine else None
        if body_pair is not None:
            self._body_pairs[y].pop(x, None)
            found[body_pair.a.id, body_pair.b.id] = None
            if body_pair.rest(y) is not None or y in self._unsupported:
                unsure.add(y)

    def _look_around(self, body: Body, seen: set[str], dirty: set[Pair], unsure: set[str]) -> None:
        """Pair a body that moved to what is now near enough to matter."""
        x, bodies, unsupported, certificates, within_m = (
            body.id,
            self._bodies,
            self._unsupported,
            self._certificates,
            TOUCH_M,
        )
        body_pairs = self._body_pairs.setdefault(x, {})
        (x0, x1, x2), (x3, x4, x5) = body.low, body.high
        flat, upright = (2, 1) if self._up_axis == 1 else (1, 2)
        if upright == 2:
            x1, x2, x4, x5 = x2, x1, x5, x4
        for y in self._broad_phase.neighbours[x]:
            if y in certificates:
                continue
            other = bodies[y]
            low, high = other.low, other.high
            old = body_pairs.get(y)
            if old is None and (
                x0 - high[0] > within_m
                or low[0] - x3 > within_m
                or x2 - high[flat] > within_m
                or low[flat] - x5 > within_m
            ):
                # Beside each other: neither can fall onto the other, and hanging is asked for by what is unsupported.
                if y in unsupported and body.size_m > other.size_m:
                    unsure.add(y)
                continue
            if y in seen:
                continue
            body_pair = BodyPair.of(body, other)
            if (
                body_pair.rest_a is None
                and body_pair.rest_b is None
                and (apart_by(body, other, within_m) or body_pair.has_nothing_near)
            ):
                if old is not None:
                    del body_pairs[y], self._body_pairs[y][x]
                    dirty.add(pair_of(x, y))
            else:
                body_pairs[y] = body_pair
                self._body_pairs.setdefault(y, {})[x] = body_pair
                dirty.add(pair_of(x, y))
            may_hang = y in unsupported and body.size_m > other.size_m
            if may_hang or body_pair.rest(y) is not None or (old is not None and old.rest(y) is not None):
                unsure.add(y)

    def _hold_anew(self, x: str, dirty: set[Pair]) -> bool:
        """Find out what holds a body; the pairs in which another than before does are dirty. Returns whether nothing
        wholly supports it any more."""
        was_unsupported = x in self._unsupported
        before, now = self._held.get(x), self._holding.holders(x)
        if now:
            self._held[x] = now
        elif before:
            del self._held[x]
        for y in (before or {}).keys() | now.keys():
            dirty.add(pair_of(x, y))
        return x in self._unsupported and not was_unsupported
