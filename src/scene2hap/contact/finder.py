"""Contacts from geometry, pair by pair, looked at anew only where something moved.

All that is kept about a pair depends on the poses of its two objects alone, and what holds an object on its pairs
alone, so that moving step by step ends exactly where building from nothing does.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

import numpy as np

from scene2hap.contact.body import Body
from scene2hap.contact.broad import Boxes, Floats, box_pairs
from scene2hap.contact.narrow import ROUNDING_M, Gap, Meeting, Patch
from scene2hap.contact.support import TOUCH_M, Support, fall_reach_m, falls, hang_reach_m, hangs, supports, weight
from scene2hap.scene.snapshot import Contact

Pair = tuple[str, str]

# A patch holds what is this much farther apart than the nearest points, as a share of the tolerance (assumed): the feet
# of a chair are never quite level.
_PATCH_SHARE = 0.25
_CLEAR_M = 1e-4  # The way between surfaces nearer than this has no direction to speak of (assumed).


def pair_of(x: str, y: str) -> Pair:
    """The pair of two ids, lower one first."""
    return (x, y) if x < y else (y, x)


class ContactFinder:
    """The contacts between bodies.

    Parameters: up_axis : 1 or 2, the world axis that points up; tolerance_m : gap at which any two cease to touch [m],
    or None to follow the objects as `contact.support` does.
    """

    def __init__(self, up_axis: int, tolerance_m: float | None) -> None:
        self._up_axis = up_axis
        self._infers = tolerance_m is None
        self._tolerance_m = TOUCH_M if tolerance_m is None else tolerance_m
        self._bodies: dict[str, Body] = {}
        self._zones: dict[str, Boxes] = {}
        self._near: dict[str, set[str]] = {}
        self._pairs: dict[Pair, _PairFacts] = {}
        self._held: dict[str, dict[str, _Bond]] = {}

    def body(self, object_id: str) -> Body:
        """The body of that id, where it is now."""
        return self._bodies[object_id]

    def replace(self, placed: Iterable[Body], gone: Iterable[str] = ()) -> dict[Pair, tuple[Contact, ...]]:
        """Take in bodies that are new or elsewhere and forget others.

        Returns the contacts of every pair that may have changed, empty for pairs that do not touch.
        """
        bodies, gone = {body.id: body for body in placed}, set(gone)
        dirty = self._take_out(gone | bodies.keys())
        self._bodies |= bodies
        dirty |= self._put_in(bodies)
        if self._infers:
            dirty |= self._hold_anew({x for pair in dirty for x in pair} | bodies.keys() | gone)
        return {pair: self._contacts(pair) for pair in sorted(dirty)}

    def _take_out(self, stale: set[str]) -> set[Pair]:
        """Forget bodies and their neighbourhoods; the pairs that they were in."""
        dirty = set()
        for x in stale & self._bodies.keys():
            del self._bodies[x], self._zones[x]
            for y in self._near.pop(x):
                self._near[y].remove(x)
                self._pairs.pop(pair_of(x, y), None)
                dirty.add(pair_of(x, y))
        return dirty

    def _put_in(self, bodies: dict[str, Body]) -> set[Pair]:
        """Find out what is near the bodies; the pairs that they are in."""
        self._near |= {x: set() for x in bodies}
        self._zones |= {x: self._zone(body) for x, body in bodies.items()}
        boxes = {x: body.box for x, body in self._bodies.items()}
        dirty = set()
        for seekers, sought in ((bodies, boxes), (boxes, bodies)):
            ids_a, ids_b = list(seekers), list(sought)
            for i, j in box_pairs(_stack(self._zones[x] for x in ids_a), _stack(boxes[x] for x in ids_b)):
                for x, y in ((ids_a[row], ids_b[column]) for row, column in zip(i.tolist(), j.tolist(), strict=True)):
                    if x != y:
                        self._near[x].add(y)
                        self._near[y].add(x)
                        dirty.add(pair_of(x, y))
        return dirty

    def _zone(self, body: Body) -> Boxes:
        """All that a body may touch, fall onto or hang from."""
        if not self._infers:
            return body.box.grown(max(self._tolerance_m, ROUNDING_M))
        down = np.zeros(3)
        down[self._up_axis] = -fall_reach_m(body.size_m)
        return body.box.grown(max(self._tolerance_m, hang_reach_m(body.size_m))).swept(down)

    def _hold_anew(self, affected: set[str]) -> set[Pair]:
        """Find out what holds these bodies; the pairs in which one holds or held the other."""
        dirty = set()
        for x in affected:
            before = self._held.pop(x, {})
            if x in self._bodies:
                self._held[x] = self._holders(x)
            dirty |= {pair_of(x, y) for y in before.keys() | self._held.get(x, {}).keys()}
        return dirty

    def _holders(self, x: str) -> dict[str, _Bond]:
        """What holds a body, by support and, as far as that is wanting, by hanging."""
        size_m, near = self._bodies[x].size_m, sorted(self._near[x])
        falls_m = {y: found for y in near if (found := self._facts(x, y).falls(x)) is not None}
        below = supports(falls_m, fall_reach_m(size_m))
        bonds = {y: self._lying(support, 1 if x < y else -1) for y, support in below.items()}
        supported = max((bond.weight for bond in bonds.values()), default=0.0)
        if supported < 1:
            reach_m = hang_reach_m(size_m)
            larger = (y for y in near if self._bodies[y].size_m > size_m)
            gaps = {y: gap for y in larger if (gap := self._facts(x, y).gap(reach_m)) is not None}
            for y, share in hangs({y: gap.distance_m for y, gap in gaps.items()}, reach_m).items():
                bond = _Bond((1 - supported) * share, gaps[y].way_m, _direction(gaps[y]))
                bonds[y] = max(bonds.get(y, _NO_BOND), bond, key=_strength)
        return bonds

    def _lying(self, support: Support, sign: int) -> _Bond:
        """The bond of a thing with what supports it; sign 1 if the thing is the pair's `a`, -1 if its `b`."""
        down = [0.0, 0.0, 0.0]
        down[self._up_axis] = -float(sign)
        return _Bond(support.weight, support.fall_m * np.array(down), (down[0], down[1], down[2]))

    def _contacts(self, pair: Pair) -> tuple[Contact, ...]:
        """The contacts of a pair by its strongest bond: a held by b, b held by a, or mere touch."""
        a, b = pair
        if b not in self._near.get(a, ()):
            return ()
        facts, slack_m = self._facts(a, b), _PATCH_SHARE * self._tolerance_m
        held = (self._held.get(x, {}).get(y) for x, y in (pair, (b, a)))
        bond = max((one for one in held if one), key=_strength, default=_NO_BOND)
        if bond.weight < 1 and (gap := facts.gap(self._tolerance_m)) is not None:
            touch = _Bond(weight(gap.distance_m, self._tolerance_m), np.zeros(3), _direction(gap))
            if touch.weight > bond.weight:
                bond, slack_m = touch, gap.distance_m + slack_m
        if bond.weight <= 0:
            return ()
        patch = facts.patch(bond.way_m, slack_m)
        points = (self._bodies[a].pose.to_world(patch.on_a_m) + self._bodies[b].pose.to_world(patch.on_b_m)) / 2
        return tuple(Contact(a, b, (x, y, z), bond.normal, weight=bond.weight) for x, y, z in points.tolist())

    def _facts(self, x: str, y: str) -> _PairFacts:
        pair = pair_of(x, y)
        if pair not in self._pairs:
            self._pairs[pair] = _PairFacts(self._bodies[pair[0]], self._bodies[pair[1]])
        return self._pairs[pair]


class _Bond(NamedTuple):
    """How much two objects are in contact, the way (3,) [m] that takes the pair's `a` to its `b`, and the normal."""

    weight: float
    way_m: Floats
    normal: tuple[float, float, float] | None


_NO_BOND = _Bond(0.0, np.zeros(3), None)


def _strength(bond: _Bond) -> tuple[float, bool]:
    return (bond.weight, bond.normal is not None)


class _PairFacts:
    """What is known of two bodies where they are now, each fact found when first asked for."""

    def __init__(self, a: Body, b: Body) -> None:
        self._meeting = Meeting(a, b)
        self._falls: dict[str, Floats | None] = {}
        self._gaps: dict[float, Gap | None] = {}
        self._patches: dict[tuple[float, ...], Patch] = {}

    def falls(self, x: str) -> Floats | None:
        if x not in self._falls:
            meeting = self._meeting
            self._falls[x] = falls(meeting, meeting.a if x == meeting.a.id else meeting.b)
        return self._falls[x]

    def gap(self, within_m: float) -> Gap | None:
        if within_m not in self._gaps:
            self._gaps[within_m] = self._meeting.gap(within_m)
        return self._gaps[within_m]

    def patch(self, way_m: Floats, within_m: float) -> Patch:
        key = (*way_m.tolist(), within_m)
        if key not in self._patches:
            self._patches[key] = self._meeting.patch(way_m, within_m)
        return self._patches[key]


def _direction(gap: Gap) -> tuple[float, float, float] | None:
    if gap.distance_m < _CLEAR_M:
        return None
    x, y, z = (gap.way_m / np.linalg.norm(gap.way_m)).tolist()
    return (x, y, z)


def _stack(boxes: Iterable[Boxes]) -> Boxes:
    rows = [Boxes(np.empty((0, 3)), np.empty((0, 3))), *boxes]
    return Boxes(np.concatenate([box.low for box in rows]), np.concatenate([box.high for box in rows]))
