"""Contacts from geometry, pair by pair, looked at anew only where something moved.

All that is kept about a pair depends on the poses of its two objects alone, and what holds an object on its pairs
alone, so that moving step by step ends exactly where building from nothing does.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence

from scene2hap.contact.body import Body
from scene2hap.contact.broad_phase import BroadPhase
from scene2hap.contact.glides import Glides
from scene2hap.contact.holding import Holding
from scene2hap.contact.junction import Junction, Pair, pair_of
from scene2hap.contact.pair import BodyPair, apart_by
from scene2hap.contact.short_ways import ShortWays
from scene2hap.contact.support import TOUCH_M, margins_m
from scene2hap.scene.pose import Pose
from scene2hap.scene.snapshot import SceneObject


class ContactFinder:
    """The contacts between things, with tolerances that follow them as `contact.support` does.

    Parameters: up_axis : 1 or 2, the world axis that points up.
    """

    def __init__(self, up_axis: int) -> None:
        self._up_axis = up_axis
        self._broad_phase = BroadPhase(up_axis, margins_m)
        self._glides = Glides()
        holding = self._holding = Holding(up_axis, self._broad_phase.neighbours, self._glides.stop)
        self._bodies, self._body_pairs, self._held, self._unsupported = (
            holding.bodies,
            holding.body_pairs,
            holding.held,
            holding.unsupported,
        )
        self._short_ways = ShortWays(holding, self._broad_phase, self._glides)

    def replace(
        self, moved: Mapping[str, Pose], added: Sequence[SceneObject] = (), gone: Collection[str] = ()
    ) -> dict[Pair, Junction | None]:
        """Take things out, in, and elsewhere.

        Returns where the pairs touch that may have changed, None for those that do not touch.
        """
        bodies, glides = self._bodies, self._glides.of
        found: dict[Pair, Junction | None] = {}
        placed = []
        self._glides.draw(moved)
        self._glides.stop_in(moved.keys())
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
        self._glides.stop_in({*gone})
        for x in gone:
            del bodies[x]
            self._glides.stop(x)
            neighbours = self._broad_phase.remove(x)
            self._glides.look_away(neighbours, x)
            for y in neighbours:
                self._part(x, y, found, unsure)
            self._body_pairs.pop(x, None)
            self._held.pop(x, None)
            self._unsupported.discard(x)
            self._short_ways.forget(x)
        for body in placed:
            bodies[body.id] = body
        left = self._broad_phase.update(placed)
        for x, others in left.items():
            self._glides.stop(x)
            self._short_ways.announce(bodies[x])
            self._glides.look_away(others, x)
        seen: set[str] = set()
        for body in placed:
            x = body.id
            for y in left.get(x, ()):
                self._part(x, y, found, unsure)
            if self._short_ways.take(body, found):
                continue
            self._look_around(body, seen, dirty, unsure)
            seen.add(x)
        unsure.update(seen)
        if not (unsure or dirty):
            return
        for x in unsure:
            if x in bodies:
                self._hold_anew(x, dirty)
        found.update(self._holding.junctions(dirty))
        for x in seen:
            if not self._body_pairs[x]:
                self._short_ways.drift(bodies[x])

    def _part(self, x: str, y: str, found: dict[Pair, Junction | None], unsure: set[str]) -> None:
        """Note that two are neighbours no more."""
        mine = self._body_pairs.get(x)
        body_pair = mine.pop(y, None) if mine else None
        if body_pair is not None:
            self._body_pairs[y].pop(x, None)
            self._glides.stop(x, y)
            found[body_pair.a.id, body_pair.b.id] = None
            if body_pair.rest(y) is not None or y in self._unsupported:
                unsure.add(y)

    def _look_around(self, body: Body, seen: set[str], dirty: set[Pair], unsure: set[str]) -> None:
        """Pair a body that moved to what is now near enough to matter."""
        x, bodies, unsupported, within_m = body.id, self._bodies, self._unsupported, TOUCH_M
        self._glides.stop(x)
        body_pairs = self._body_pairs.get(x)
        if body_pairs is None:
            body_pairs = self._body_pairs[x] = {}
        (x0, x1, x2), (x3, x4, x5) = body.low, body.high
        flat, upright = (2, 1) if self._up_axis == 1 else (1, 2)
        if upright == 2:
            x1, x2, x4, x5 = x2, x1, x5, x4
        for y in self._broad_phase.neighbours[x]:
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
            body_pair = BodyPair.between(body, other) if x < y else BodyPair.between(other, body)
            if (
                body_pair.rest_a is None
                and body_pair.rest_b is None
                and (apart_by(body, other, within_m) or body_pair.has_nothing_near)
            ):
                if old is not None:
                    del body_pairs[y], self._body_pairs[y][x]
                    self._glides.stop(x, y)
                    dirty.add(pair_of(x, y))
            else:
                body_pairs[y] = body_pair
                self._body_pairs.setdefault(y, {})[x] = body_pair
                self._glides.stop(x, y)
                dirty.add(pair_of(x, y))
            may_hang = y in unsupported and body.size_m > other.size_m
            if may_hang or body_pair.rest(y) is not None or (old is not None and old.rest(y) is not None):
                unsure.add(y)

    def _hold_anew(self, x: str, dirty: set[Pair]) -> None:
        """Find out what holds a body; the pairs in which another than before does are dirty."""
        was_loose = x in self._unsupported
        before, now = self._held.get(x), self._holding.holders(x)
        self._glides.stop(x)
        if x in self._unsupported and not was_loose:
            self._short_ways.announce(self._bodies[x])
        if now:
            self._held[x] = now
        elif before:
            del self._held[x]
        for y in (before or {}).keys() | now.keys():
            dirty.add(pair_of(x, y))
