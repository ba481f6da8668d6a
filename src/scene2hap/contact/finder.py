"""Contacts from geometry, pair by pair, looked at anew only where something moved.

All that is kept about a pair depends on the poses of its two objects alone, and what holds an object on its pairs
alone, so that moving step by step ends exactly where building from nothing does.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Mapping, Sequence

from scene2hap.contact.body import Body
from scene2hap.contact.bond import NO_BOND, NO_WAY, Bond, Plan, direction, strength, triple
from scene2hap.contact.clearing import is_clear
from scene2hap.contact.crowd import Crowd, Room
from scene2hap.contact.cuboid_meeting import gaps_of, points_of
from scene2hap.contact.falls_together import falls_of
from scene2hap.contact.glide import Drift, Glide
from scene2hap.contact.junction import Junction, Pair, pair_of
from scene2hap.contact.support import (
    PATCH_SHARE,
    TOUCH_M,
    Support,
    fall_reach_m,
    hang_reach_m,
    hangs,
    level_supports,
    margins_m,
    supports,
    weight,
)
from scene2hap.contact.tie import UNCLEAR, WITHIN_M, Tie, apart_by, slide
from scene2hap.contact.vectors import Floats, Triple
from scene2hap.scene.pose import Pose
from scene2hap.scene.snapshot import SceneObject

_SLACK_M = PATCH_SHARE * TOUCH_M
_ONES = (1.0,) * 4
_VAIN = 15  # A glide that was refused so often is drawn anew.


class ContactFinder:
    """The contacts between things, with tolerances that follow them as `contact.support` does.

    Parameters: up_axis : 1 or 2, the world axis that points up.
    """

    def __init__(self, up_axis: int) -> None:
        self._up_axis = up_axis
        self._bodies: dict[str, Body] = {}
        self._crowd = Crowd(up_axis, margins_m)
        self._ties: dict[str, dict[str, Tie]] = {}
        self._held: dict[str, dict[str, Bond]] = {}
        # Those that nothing wholly supports, so that larger things near them may bear on how they hang.
        self._loose: set[str] = set()
        self._glides: dict[str, Glide | Drift] = {}
        # By host, whose glides end when it moves.
        self._guests: dict[str, set[str]] = {}

    def replace(
        self, moved: Mapping[str, Pose], added: Sequence[SceneObject] = (), gone: Collection[str] = ()
    ) -> dict[Pair, Junction | None]:
        """Take things out, in, and elsewhere.

        Returns where the pairs touch that may have changed, None for those that do not touch.
        """
        bodies, glides = self._bodies, self._glides
        found: dict[Pair, Junction | None] = {}
        placed = []
        if self._guests:
            self._stop_in(moved.keys() & self._guests.keys())
        for x, pose in moved.items():
            glide = glides.get(x)
            if glide is not None and glide.on not in moved:
                if glide.step(pose, found):
                    continue
                glide.refused += 1
            placed.append(bodies[x].at(pose))
        if placed or added or gone:
            placed += [Body.of(item, self._up_axis) for item in added]
            self._take_in(placed, gone, found)
        return found

    def _take_in(self, placed: Sequence[Body], gone: Collection[str], found: dict[Pair, Junction | None]) -> None:
        """The long way."""
        bodies = self._bodies
        dirty: set[Pair] = set()
        unsure: set[str] = set()
        self._stop_in(self._guests.keys() & gone)
        for x in gone:
            del bodies[x]
            for y in self._crowd.take_out(x):
                self._part(x, y, dirty, unsure)
            self._ties.pop(x, None)
            self._held.pop(x, None)
            self._glides.pop(x, None)
            self._loose.discard(x)
        for body in placed:
            bodies[body.id] = body
        left = self._crowd.put(placed)
        for x in left:
            self._stop_around(x)
        seen: set[str] = set()
        for body in placed:
            x = body.id
            if x not in left and self._slide(body, found):
                continue
            for y in left.get(x, ()):
                self._part(x, y, dirty, unsure)
            self._look_around(body, seen, dirty, unsure)
            seen.add(x)
        self._tell_cuboids_apart(seen)
        unsure.update(seen)
        self._tell_falls(unsure)
        for x in unsure:
            if x in bodies:
                self._hold_anew(x, dirty)
        found.update(self._junctions(dirty))
        for x in seen:
            if not self._ties[x]:
                self._keep(Drift.of(bodies[x], self._crowd.room(x), self._around(x)))

    def _part(self, x: str, y: str, dirty: set[Pair], unsure: set[str]) -> None:
        """Note that two are neighbours no more."""
        mine = self._ties.get(x)
        tie = mine.pop(y, None) if mine else None
        if tie is not None:
            self._ties[y].pop(x, None)
            self._stop(x, y)
            dirty.add(pair_of(x, y))
            if tie.rest(y) is not None or y in self._loose:
                unsure.add(y)

    def _stop(self, x: str, y: str) -> None:
        """What was sure of how two slide is so no longer."""
        self._glides.pop(x, None)
        self._glides.pop(y, None)

    def _stop_around(self, x: str) -> None:
        self._glides.pop(x, None)
        for y in self._crowd.near[x]:
            self._glides.pop(y, None)

    def _slide(self, body: Body, found: dict[Pair, Junction | None]) -> bool:
        """The short way for what stays on its only support with nothing else near enough to matter.

        It ends where the long way does. False, and nothing done, where that is not sure.
        """
        x, bodies = body.id, self._bodies
        ties = self._ties.get(x)
        if ties is None or len(ties) != 1 or x in self._loose:
            return False
        ((y, tie),) = ties.items()
        support, is_a = bodies[y], x == tie.a.id
        if (tie.b if is_a else tie.a) is not support or not self._stands_alone(body, y):
            return False
        bond = self._held[x].get(y)
        if bond is None or not bond.lies or bond.weight != 1.0:
            return False
        slid = slide(body, support)
        if slid is None:
            return False
        tie.slide(body, slid.rest, is_a)
        n = len(slid.points)
        found[(x, y) if is_a else (y, x)] = Junction(slid.points, _ONES[:n], bond.normals[:n])
        glide = self._glides.get(x)
        if isinstance(glide, Glide) and glide.refused <= _VAIN and glide.tray == slid.tray:
            glide.resume(body)
        else:
            self._keep(Glide.of(body, tie, slid, bond.normal, self._crowd.room(x), self._around(x)))
        return True

    def _keep(self, glide: Glide | Drift) -> None:
        self._glides[glide.body.id] = glide
        for host in glide.hosts:
            self._guests.setdefault(host, set()).add(glide.body.id)

    def _stop_in(self, hosts: Iterable[str]) -> None:
        for host in hosts:
            for x in self._guests.pop(host):
                self._glides.pop(x, None)

    def _around(self, x: str) -> list[tuple[Body, Room]]:
        """The neighbours of a body, and where each may move."""
        room, bodies = self._crowd.room, self._bodies
        return [(bodies[z], room(z)) for z in self._crowd.near[x]]

    def _stands_alone(self, body: Body, support: str) -> bool:
        """Whether all neighbours but its support are beside a body, and none may hang from it."""
        bodies, loose, margin_m, size_m = self._bodies, self._loose, TOUCH_M, body.size_m
        (x0, x1, x2), (x3, x4, x5) = body.low, body.high
        flat = 3 - self._up_axis
        if flat == 1:
            x2, x5 = x1, x4
        x0, x2, x3, x5 = x0 - margin_m, x2 - margin_m, x3 + margin_m, x5 + margin_m
        for z in self._crowd.near[body.id]:
            other = bodies[z]
            low, high = other.low, other.high
            if x0 > high[0] or low[0] > x3 or x2 > high[flat] or low[flat] > x5:
                is_in_the_way = False
            else:
                is_in_the_way = z != support and (size_m >= other.size_m or not is_clear(body, other))
            if is_in_the_way or (z in loose and size_m > other.size_m):
                return False
        return True

    def _look_around(self, body: Body, seen: set[str], dirty: set[Pair], unsure: set[str]) -> None:
        """Tie a body that moved to what is now near enough to matter."""
        x, bodies, loose, within_m = body.id, self._bodies, self._loose, TOUCH_M
        self._glides.pop(x, None)
        ties = self._ties.get(x)
        if ties is None:
            ties = self._ties[x] = {}
        (x0, x1, x2), (x3, x4, x5) = body.low, body.high
        flat, upright = (2, 1) if self._up_axis == 1 else (1, 2)
        if upright == 2:
            x1, x2, x4, x5 = x2, x1, x5, x4
        for y in self._crowd.near[x]:
            other = bodies[y]
            low, high = other.low, other.high
            old = ties.get(y)
            if old is None and (
                x0 - high[0] > within_m
                or low[0] - x3 > within_m
                or x2 - high[flat] > within_m
                or low[flat] - x5 > within_m
            ):
                # Beside each other: neither can fall onto the other, and hanging is asked for by what is loose.
                if y in loose and body.size_m > other.size_m:
                    unsure.add(y)
                continue
            if y in seen:
                continue
            tie = Tie.between(body, other) if x < y else Tie.between(other, body)
            if tie.rest_a is None and tie.rest_b is None and (apart_by(body, other, within_m) or tie.is_clear):
                if old is not None:
                    del ties[y], self._ties[y][x]
                    self._stop(x, y)
                    dirty.add(pair_of(x, y))
            else:
                ties[y] = tie
                self._ties.setdefault(y, {})[x] = tie
                self._stop(x, y)
                dirty.add(pair_of(x, y))
            may_hang = y in loose and body.size_m > other.size_m
            if may_hang or tie.rest(y) is not None or (old is not None and old.rest(y) is not None):
                unsure.add(y)

    def _tell_cuboids_apart(self, moved: Iterable[str]) -> None:
        """Find out all at once how far leaning cuboids are from what moved."""
        ties = {id(tie): tie for x in moved for tie in self._ties[x].values() if tie.asks_apart}
        for tie, gap in zip(ties.values(), gaps_of([(t.a, t.b) for t in ties.values()], WITHIN_M), strict=True):
            tie.tell_apart(gap)

    def _tell_falls(self, unsure: Iterable[str]) -> None:
        """Find out all at once how far what has few triangles is to fall."""
        asked = [(tie, x) for x in unsure for tie in self._ties.get(x, {}).values() if tie.asks_falls(x)]
        for (tie, x), falls_m in zip(asked, falls_of([tie.falling(x) for tie, x in asked]), strict=True):
            tie.tell_falls(x, falls_m)

    def _hold_anew(self, x: str, dirty: set[Pair]) -> None:
        """Find out what holds a body; the pairs in which another than before does are dirty."""
        was_loose = x in self._loose
        before, now = self._held.get(x), self._holders(x)
        self._glides.pop(x, None)
        if was_loose != (x in self._loose):
            self._stop_around(x)
        if now:
            self._held[x] = now
        elif before:
            del self._held[x]
        for y in (before or {}).keys() | now.keys():
            dirty.add(pair_of(x, y))

    def _holders(self, x: str) -> dict[str, Bond]:
        """What holds a body, by support and, as far as that is wanting, by hanging."""
        body = self._bodies[x]
        below, lies_on = self._below(body) if self._ties[x] else ({}, ())
        bonds = {}
        for y, support in below.items():
            sign = 1.0 if x < y else -1.0
            normal = (0.0, -sign, 0.0) if self._up_axis == 1 else (0.0, 0.0, -sign)
            way = (normal[0] * support.fall_m, normal[1] * support.fall_m, normal[2] * support.fall_m)
            bonds[y] = Bond(support.weight, way, normal, y in lies_on, x)
        supported = max((bond.weight for bond in bonds.values()), default=0.0)
        if supported < 1:
            self._loose.add(x)
            for y, bond in self._hanging(body, supported).items():
                bonds[y] = max(bonds.get(y, NO_BOND), bond, key=strength)
        else:
            self._loose.discard(x)
        return bonds

    def _below(self, body: Body) -> tuple[Mapping[str, Support], Collection[str]]:
        """What supports a body, and on which of that it lies level."""
        ties, reach_m = self._ties[body.id], fall_reach_m(body.size_m)
        rests = {y: rest for y, tie in ties.items() if (rest := tie.rest(body.id)) is not None}
        unclear = [y for y, rest in rests.items() if rest is UNCLEAR]
        if len(unclear) == len(rests) == 1:
            # What is met first holds it, and nothing else is to be seen by other parts of the bottom.
            fall_m = ties[unclear[0]].first_fall_m(body.id)
            share = weight(fall_m, reach_m)
            return ({unclear[0]: Support(share, fall_m)} if share > 0 else {}), ()
        rests = {y: rest for y, rest in rests.items() if rest is not UNCLEAR}
        falls_m = self._falls(body, unclear, min((rest.fall_m for rest in rests.values()), default=math.inf))
        if rests and not falls_m and (below := level_supports(rests, reach_m)) is not None:
            return below, rests
        falls_m |= self._falls(body, rests)
        return supports(dict(sorted(falls_m.items())), reach_m), ()

    def _falls(self, body: Body, onto: Iterable[str], least_m: float = math.inf) -> dict[str, Floats]:
        """How far the triangles of a body are to fall to things below; not to what lies deeper than another, be it
        `least_m` deep, by more than what still counts."""
        bodies, ties = self._bodies, self._ties[body.id]
        found: dict[str, Floats] = {}
        for y in sorted(onto, key=lambda y: (-bodies[y].highest_m, y)):
            if body.lowest_m - bodies[y].highest_m > least_m + TOUCH_M:
                break
            falls_m = ties[y].falls(body.id)
            if falls_m is not None and (first_m := float(falls_m.min())) <= least_m + TOUCH_M:
                found[y], least_m = falls_m, min(least_m, first_m)
        return found

    def _hanging(self, body: Body, supported: float) -> dict[str, Bond]:
        """What holds a body sideways, as far as nothing supports it."""
        x, reach_m = body.id, hang_reach_m(body.size_m)
        ways: dict[str, tuple[float, Triple]] = {}
        bodies, size_m = self._bodies, body.size_m
        larger = [
            y
            for y in self._crowd.near[x]
            if (other := bodies[y]).size_m > size_m and not apart_by(body, other, reach_m) and not is_clear(body, other)
        ]
        if not larger:
            return {}
        for y in sorted(larger):
            way = self._apart(self._tie(x, y), reach_m)
            if way is not None:
                ways[y] = way
        shares = hangs({y: distance for y, (distance, _) in ways.items()}, reach_m)
        return {
            y: Bond((1 - supported) * share, ways[y][1], direction(*ways[y]), False, x) for y, share in shares.items()
        }

    def _apart(self, tie: Tie, within_m: float) -> tuple[float, Triple] | None:
        """How far two are apart and which way, if it is at most `within_m`."""
        side = tie.aside(within_m, _SLACK_M)
        if side is not None:
            return (side.distance_m, side.way_m) if side.points else None
        gap = tie.gap(within_m)
        return None if gap is None else (gap.distance_m, triple(gap.way_m))

    def _tie(self, x: str, y: str) -> Tie:
        tie = self._ties[x].get(y)
        if tie is None:
            a, b = pair_of(x, y)
            self._stop(x, y)
            tie = self._ties[x][y] = self._ties.setdefault(y, {})[x] = Tie.between(self._bodies[a], self._bodies[b])
        return tie

    def _junctions(self, pairs: Iterable[Pair]) -> dict[Pair, Junction | None]:
        """Where these pairs touch; points of cuboids are found all at once."""
        plans = {pair: self._plan(pair) for pair in pairs}
        ask = [plan for plan in plans.values() if plan is not None and plan.rest is None and plan.tie.are_cuboids]
        ask = [plan for plan in ask if plan.side is None]
        couples = [(plan.tie.a, plan.tie.b) for plan in ask]
        points = points_of(couples, [plan.bond.way_m for plan in ask], [plan.within_m for plan in ask])
        for plan, several in zip(ask, points, strict=True):
            plan.tie.tell_points(plan.bond.way_m, plan.within_m, several)
        return {pair: None if plan is None else plan.junction() for pair, plan in plans.items()}

    def _plan(self, pair: Pair) -> Plan | None:
        """How a pair touches by its strongest bond: a by b, b by a, mere touch, or one is built into the other."""
        a, b = pair
        tie = self._ties.get(a, {}).get(b)
        if tie is None:
            return None
        slack_m = _SLACK_M
        bond, is_touch = NO_BOND, False
        for x, y in ((a, b), (b, a)):
            held = self._held.get(x)
            one = held.get(y) if held else None
            if one is not None and strength(one) > strength(bond):
                bond = one
        if bond.weight < 1 and not apart_by(tie.a, tie.b, TOUCH_M):
            apart = self._apart(tie, TOUCH_M)
            if apart is not None:
                share = weight(apart[0], TOUCH_M)
                if share > bond.weight:
                    bond, is_touch = Bond(share, NO_WAY, direction(*apart), False, a), True
                    slack_m += apart[0]
        if bond.weight < 1:
            share, play_m = tie.enclosed()
            if share > bond.weight:
                bond, is_touch, slack_m = Bond(share, NO_WAY, None, False, a), False, _SLACK_M + play_m
        if bond.weight <= 0:
            return None
        side = tie.aside(TOUCH_M, _SLACK_M) if is_touch else None
        return Plan(tie, bond, slack_m, tie.rest(bond.faller) if bond.lies else None, side)
