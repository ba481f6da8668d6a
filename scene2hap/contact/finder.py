"""Contacts from geometry, pair by pair, looked at anew only where something moved.

All that is kept about a pair depends on the poses of its two objects alone, and what holds an object on its pairs
alone, so that moving step by step ends exactly where building from nothing does.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence

from scene2hap.contact.body import Body
from scene2hap.contact.crowd import Crowd
from scene2hap.contact.glides import Glides
from scene2hap.contact.holding import Holding
from scene2hap.contact.junction import Junction, Pair, pair_of
from scene2hap.contact.short_ways import ShortWays
from scene2hap.contact.support import TOUCH_M, margins_m
from scene2hap.contact.tie import Tie, apart_by
from scene2hap.scene.pose import Pose
from scene2hap.scene.snapshot import SceneObject


class ContactFinder:
    """The contacts between things, with tolerances that follow them as `contact.support` does.

    Parameters: up_axis : 1 or 2, the world axis that points up.
    """

    def __init__(self, up_axis: int) -> None:
        self._up_axis = up_axis
        self._crowd = Crowd(up_axis, margins_m)
        self._glides = Glides()
        holding = self._holding = Holding(up_axis, self._crowd.near, self._glides.stop)
        self._bodies, self._ties, self._held, self._loose = holding.bodies, holding.ties, holding.held, holding.loose
        self._short_ways = ShortWays(holding, self._crowd, self._glides)

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
            neighbours = self._crowd.take_out(x)
            self._glides.look_away(neighbours, x)
            for y in neighbours:
                self._part(x, y, found, unsure)
            self._ties.pop(x, None)
            self._held.pop(x, None)
            self._loose.discard(x)
            self._short_ways.forget(x)
        for body in placed:
            bodies[body.id] = body
        left = self._crowd.put(placed)
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
            if not self._ties[x]:
                self._short_ways.drift(bodies[x])

    def _part(self, x: str, y: str, found: dict[Pair, Junction | None], unsure: set[str]) -> None:
        """Note that two are neighbours no more."""
        mine = self._ties.get(x)
        tie = mine.pop(y, None) if mine else None
        if tie is not None:
            self._ties[y].pop(x, None)
            self._glides.stop(x, y)
            found[tie.a.id, tie.b.id] = None
            if tie.rest(y) is not None or y in self._loose:
                unsure.add(y)

    def _look_around(self, body: Body, seen: set[str], dirty: set[Pair], unsure: set[str]) -> None:
        """Tie a body that moved to what is now near enough to matter."""
        x, bodies, loose, within_m = body.id, self._bodies, self._loose, TOUCH_M
        self._glides.stop(x)
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
                    self._glides.stop(x, y)
                    dirty.add(pair_of(x, y))
            else:
                ties[y] = tie
                self._ties.setdefault(y, {})[x] = tie
                self._glides.stop(x, y)
                dirty.add(pair_of(x, y))
            may_hang = y in loose and body.size_m > other.size_m
            if may_hang or tie.rest(y) is not None or (old is not None and old.rest(y) is not None):
                unsure.add(y)

    def _hold_anew(self, x: str, dirty: set[Pair]) -> None:
        """Find out what holds a body; the pairs in which another than before does are dirty."""
        was_loose = x in self._loose
        before, now = self._held.get(x), self._holding.holders(x)
        self._glides.stop(x)
        if x in self._loose and not was_loose:
            self._short_ways.announce(self._bodies[x])
        if now:
            self._held[x] = now
        elif before:
            del self._held[x]
        for y in (before or {}).keys() | now.keys():
            dirty.add(pair_of(x, y))
