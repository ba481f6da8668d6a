"""Contacts from geometry, pair by pair, looked at anew only where something moved.

All that is kept about a pair depends on the poses of its two objects alone, and what holds an object on its pairs
alone, so that moving step by step ends exactly where building from nothing does.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import NamedTuple

import numpy as np

from scene2hap.contact.body import Body
from scene2hap.contact.broad import Floats
from scene2hap.contact.crowd import Crowd
from scene2hap.contact.junction import Junction, Pair, pair_of
from scene2hap.contact.level import Aside, rest_points
from scene2hap.contact.narrow import ROUNDING_M
from scene2hap.contact.profile import Triple
from scene2hap.contact.support import (
    TOUCH_M,
    Support,
    fall_reach_m,
    hang_reach_m,
    hangs,
    level_supports,
    supports,
    weight,
)
from scene2hap.contact.tie import UNCLEAR, Tie, apart_by, slide

# A patch holds what is this much farther apart than the nearest points, as a share of the tolerance (assumed): the feet
# of a chair are never quite level.
_PATCH_SHARE = 0.25
_CLEAR_M = 1e-4  # The way between surfaces nearer than this has no direction to speak of (assumed).
_NO_WAY = (0.0, 0.0, 0.0)
_ONES = (1.0,) * 4


class ContactFinder:
    """The contacts between bodies.

    Parameters: up_axis : 1 or 2, the world axis that points up; tolerance_m : gap at which any two cease to touch [m],
    or None to follow the objects as `contact.support` does.
    """

    def __init__(self, up_axis: int, tolerance_m: float | None) -> None:
        self._up_axis = up_axis
        self._infers = tolerance_m is None
        self._tolerance_m = TOUCH_M if tolerance_m is None else tolerance_m
        self._within_m = max(self._tolerance_m, ROUNDING_M)
        self._bodies: dict[str, Body] = {}
        self._crowd = Crowd(up_axis, self._margins_m)
        self._ties: dict[str, dict[str, Tie]] = {}
        self._held: dict[str, dict[str, _Bond]] = {}
        # Those that nothing wholly supports, so that larger things near them may bear on how they hang.
        self._loose: set[str] = set()

    def body(self, object_id: str) -> Body:
        """The body of that id, where it is now."""
        return self._bodies[object_id]

    def replace(self, placed: Sequence[Body], gone: Iterable[str] = ()) -> dict[Pair, Junction | None]:
        """Take in bodies that are new or elsewhere and forget others.

        Returns where the pairs touch that may have changed, None for those that do not touch.
        """
        dirty: set[Pair] = set()
        unsure: set[str] = set()
        for x in gone:
            del self._bodies[x]
            for y in self._crowd.take_out(x):
                self._part(x, y, dirty, unsure)
            self._ties.pop(x, None)
            self._held.pop(x, None)
            self._loose.discard(x)
        for body in placed:
            self._bodies[body.id] = body
        left = self._crowd.put(placed)
        seen: set[str] = set()
        found: dict[Pair, Junction | None] = {}
        for body in placed:
            x = body.id
            if x not in left and self._slide(body, found):
                continue
            for y in left.get(x, ()):
                self._part(x, y, dirty, unsure)
            self._look_around(body, seen, dirty, unsure)
            seen.add(x)
        if self._infers:
            unsure.update(seen)
            for x in unsure:
                if x in self._bodies:
                    self._hold_anew(x, dirty)
        for pair in dirty:
            found[pair] = self._junction(pair)
        return found

    def _margins_m(self, body: Body) -> tuple[float, float]:
        """How far a body may touch or hang from others, and how much farther it may fall."""
        if not self._infers:
            return self._within_m, 0.0
        return max(self._tolerance_m, hang_reach_m(body.size_m)), fall_reach_m(body.size_m)

    def _part(self, x: str, y: str, dirty: set[Pair], unsure: set[str]) -> None:
        """Note that two are neighbours no more."""
        mine = self._ties.get(x)
        tie = mine.pop(y, None) if mine else None
        if tie is not None:
            self._ties[y].pop(x, None)
            dirty.add(pair_of(x, y))
            unsure.add(y)

    def _slide(self, body: Body, found: dict[Pair, Junction | None]) -> bool:
        """The short way for what stays on its only support with nothing else near enough to matter.

        It ends where the long way does. False, and nothing done, where that is not sure.
        """
        x, bodies = body.id, self._bodies
        ties = self._ties.get(x)
        if ties is None or len(ties) != 1 or x in self._loose or not self._infers:
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
        rest, points = slid
        tie.slide(body, rest, is_a)
        n = len(points)
        found[(x, y) if is_a else (y, x)] = Junction(points, _ONES[:n], bond.normals[:n])
        return True

    def _stands_alone(self, body: Body, support: str) -> bool:
        """Whether all neighbours but its support are beside a body, and none may hang from it."""
        bodies, loose, margin_m, size_m = self._bodies, self._loose, self._within_m, body.size_m
        (x0, x1, x2), (x3, x4, x5) = body.low, body.high
        flat = 3 - self._up_axis
        if flat == 1:
            x2, x5 = x1, x4
        x0, x2, x3, x5 = x0 - margin_m, x2 - margin_m, x3 + margin_m, x5 + margin_m
        for z in self._crowd.near[body.id]:
            other = bodies[z]
            low, high = other.low, other.high
            if x0 > high[0] or low[0] > x3 or x2 > high[flat] or low[flat] > x5:
                if z in loose and size_m > other.size_m:
                    return False
            elif z != support or (z in loose and size_m > other.size_m):
                return False
        return True

    def _look_around(self, body: Body, seen: set[str], dirty: set[Pair], unsure: set[str]) -> None:
        """Tie a body that moved to what is now near enough to matter."""
        x, bodies, loose, infers, within_m = body.id, self._bodies, self._loose, self._infers, self._within_m
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
            tie = Tie.between(body, other, infers) if x < y else Tie.between(other, body, infers)
            if tie.rest_a is None and tie.rest_b is None and apart_by(body, other, within_m):
                if old is not None:
                    del ties[y], self._ties[y][x]
                    dirty.add(pair_of(x, y))
            else:
                ties[y] = tie
                self._ties.setdefault(y, {})[x] = tie
                dirty.add(pair_of(x, y))
            if tie.rest(y) is not None or (old is not None and old.rest(y) is not None) or y in loose:
                unsure.add(y)

    def _hold_anew(self, x: str, dirty: set[Pair]) -> None:
        """Find out what holds a body; the pairs in which another than before does are dirty."""
        before, now = self._held.get(x), self._holders(x)
        if now:
            self._held[x] = now
        elif before:
            del self._held[x]
        for y in (before or {}).keys() | now.keys():
            dirty.add(pair_of(x, y))

    def _holders(self, x: str) -> dict[str, _Bond]:
        """What holds a body, by support and, as far as that is wanting, by hanging."""
        body = self._bodies[x]
        below: dict[str, Support] | None = {}
        rests = {y: rest for y, tie in self._ties[x].items() if (rest := tie.rest(x)) is not None}
        if rests:
            reach_m = fall_reach_m(body.size_m)
            below = None if UNCLEAR in rests.values() else level_supports(rests, reach_m)
            if below is None:
                near = sorted(rests)
                falls_m = {y: found for y in near if (found := self._ties[x][y].falls(x)) is not None}
                below, rests = supports(falls_m, reach_m), {}
        bonds = {}
        for y, support in (below or {}).items():
            sign = 1.0 if x < y else -1.0
            normal = (0.0, -sign, 0.0) if self._up_axis == 1 else (0.0, 0.0, -sign)
            way = (normal[0] * support.fall_m, normal[1] * support.fall_m, normal[2] * support.fall_m)
            bonds[y] = _Bond(support.weight, way, normal, y in rests, x)
        supported = max((bond.weight for bond in bonds.values()), default=0.0)
        if supported < 1:
            self._loose.add(x)
            for y, bond in self._hanging(body, supported).items():
                bonds[y] = max(bonds.get(y, _NO_BOND), bond, key=_strength)
        else:
            self._loose.discard(x)
        return bonds

    def _hanging(self, body: Body, supported: float) -> dict[str, _Bond]:
        """What holds a body sideways, as far as nothing supports it."""
        x, reach_m = body.id, hang_reach_m(body.size_m)
        ways: dict[str, tuple[float, Triple]] = {}
        bodies, size_m = self._bodies, body.size_m
        larger = [
            y
            for y in self._crowd.near[x]
            if (other := bodies[y]).size_m > size_m and not apart_by(body, other, reach_m)
        ]
        if not larger:
            return {}
        for y in sorted(larger):
            way = self._apart(self._tie(x, y), reach_m)
            if way is not None:
                ways[y] = way
        shares = hangs({y: distance for y, (distance, _) in ways.items()}, reach_m)
        return {
            y: _Bond((1 - supported) * share, ways[y][1], _direction(*ways[y]), False, x) for y, share in shares.items()
        }

    def _apart(self, tie: Tie, within_m: float) -> tuple[float, Triple] | None:
        """How far two are apart and which way, if it is at most `within_m`."""
        side = self._aside(tie, within_m)
        if side is not None:
            return (side.distance_m, side.way_m) if side.points else None
        gap = tie.gap(within_m)
        return None if gap is None else (gap.distance_m, _triple(gap.way_m))

    def _aside(self, tie: Tie, within_m: float) -> Aside | None:
        # A stated tolerance knows no up, and its contacts go along with any motion.
        return tie.aside(within_m, _PATCH_SHARE * self._tolerance_m) if self._infers else None

    def _tie(self, x: str, y: str) -> Tie:
        tie = self._ties[x].get(y)
        if tie is None:
            a, b = pair_of(x, y)
            tie = self._ties[x][y] = self._ties.setdefault(y, {})[x] = Tie.between(
                self._bodies[a], self._bodies[b], True
            )
        return tie

    def _junction(self, pair: Pair) -> Junction | None:
        """The contacts of a pair by its strongest bond: a held by b, b held by a, or mere touch."""
        a, b = pair
        tie = self._ties.get(a, {}).get(b)
        if tie is None:
            return None
        slack_m = _PATCH_SHARE * self._tolerance_m
        bond, is_touch = _NO_BOND, False
        for x, y in ((a, b), (b, a)):
            held = self._held.get(x)
            one = held.get(y) if held else None
            if one is not None and _strength(one) > _strength(bond):
                bond = one
        if bond.weight < 1 and not apart_by(tie.a, tie.b, self._within_m):
            apart = self._apart(tie, self._tolerance_m)
            if apart is not None:
                share = weight(apart[0], self._tolerance_m)
                if share > bond.weight:
                    bond, is_touch = _Bond(share, _NO_WAY, _direction(*apart), False, a), True
                    slack_m += apart[0]
        if bond.weight <= 0:
            return None
        points = self._points(tie, bond, slack_m, is_touch)
        return Junction(points, (bond.weight,) * len(points), (bond.normal,) * len(points)) if points else None

    def _points(self, tie: Tie, bond: _Bond, slack_m: float, is_touch: bool) -> tuple[Triple, ...]:
        if bond.lies:
            x, y = (tie.a, tie.b) if bond.faller == tie.a.id else (tie.b, tie.a)
            rest = tie.rest(bond.faller)
            assert rest is not None
            return rest_points(x, y, rest)
        if is_touch and (side := self._aside(tie, self._tolerance_m)) is not None:
            return side.points
        patch = tie.patch(np.array(bond.way_m), slack_m)
        points = (tie.a.pose.to_world(patch.on_a_m) + tie.b.pose.to_world(patch.on_b_m)) / 2
        return tuple((x, y, z) for x, y, z in points.tolist())


class _Bond(NamedTuple):
    """How much two objects are in contact, the way [m] that takes the pair's `a` to its `b`, and the normal; whether
    the faller `lies` on the other with a level sole."""

    weight: float
    way_m: Triple
    normal: Triple | None
    lies: bool
    faller: str

    @property
    def normals(self) -> tuple[Triple | None, ...]:
        return (self.normal,) * 4


_NO_BOND = _Bond(0.0, _NO_WAY, None, False, "")


def _strength(bond: _Bond) -> tuple[float, bool]:
    return (bond.weight, bond.normal is not None)


def _direction(distance_m: float, way_m: Triple) -> Triple | None:
    if distance_m < _CLEAR_M:
        return None
    x, y, z = (np.array(way_m) / np.linalg.norm(way_m)).tolist()
    return (x, y, z)


def _triple(way: Floats) -> Triple:
    x, y, z = way.tolist()
    return (x, y, z)
