"""Contacts from geometry, pair by pair, looked at anew only where something moved.

All that is kept about a pair depends on the poses of its two objects alone, and what holds an object on its pairs
alone, so that moving step by step ends exactly where building from nothing does.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence

from scene2hap.contact.body import Body
from scene2hap.contact.bond import Bond
from scene2hap.contact.clearing import is_clear
from scene2hap.contact.crowd import Crowd, Room
from scene2hap.contact.cuboid_meeting import gaps_of
from scene2hap.contact.falls_together import falls_of
from scene2hap.contact.glide import Drift, Glide
from scene2hap.contact.holding import Holding
from scene2hap.contact.junction import Junction, Pair, pair_of
from scene2hap.contact.sides import Sides, are_beside
from scene2hap.contact.support import TOUCH_M, Support, hang_reach_m, margins_m
from scene2hap.contact.tie import WITHIN_M, Slide, Tie, apart_by, slide
from scene2hap.scene.pose import Pose
from scene2hap.scene.snapshot import SceneObject

_ONES = (1.0,) * 4
_VAIN = 15  # A glide that was refused so often is drawn anew.
# Of so many things that are not in a glide one more may have one drawn in a frame; what lands or is lifted counts as
# that. So what can wait for the next frame is not added to what cannot.
_EACH = 4


class ContactFinder:
    """The contacts between things, with tolerances that follow them as `contact.support` does.

    Parameters: up_axis : 1 or 2, the world axis that points up.
    """

    def __init__(self, up_axis: int) -> None:
        self._up_axis = up_axis
        self._crowd = Crowd(up_axis, margins_m)
        self._glides: dict[str, Glide | Drift] = {}
        holding = self._holding = Holding(up_axis, self._crowd.near, self._glides)
        self._bodies, self._ties, self._held, self._loose = holding.bodies, holding.ties, holding.held, holding.loose
        # By host, whose glides end when it moves.
        self._guests: dict[str, set[str]] = {}
        self._n_to_draw = 0

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
                self._part(x, y, found, unsure)
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
        self._n_to_draw = 1 + len(placed) // _EACH
        for body in placed:
            x = body.id
            for y in left.get(x, ()):
                self._part(x, y, found, unsure)
            if self._slide(body, found):
                continue
            self._look_around(body, seen, dirty, unsure)
            seen.add(x)
        unsure.update(seen)
        if not (unsure or dirty):
            return
        self._tell_cuboids_apart(seen)
        self._tell_falls(unsure)
        for x in unsure:
            if x in bodies:
                self._hold_anew(x, dirty)
        found.update(self._holding.junctions(dirty))
        for x in seen:
            if not self._ties[x]:
                self._keep(Drift.of(bodies[x], self._crowd.room(x), self._around(x)))

    def _part(self, x: str, y: str, found: dict[Pair, Junction | None], unsure: set[str]) -> None:
        """Note that two are neighbours no more."""
        mine = self._ties.get(x)
        tie = mine.pop(y, None) if mine else None
        if tie is not None:
            self._ties[y].pop(x, None)
            self._stop(x, y)
            found[tie.a.id, tie.b.id] = None
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
        """The short way for what stays on its only support, with nothing else near enough to matter but blocks that it
        is beside.

        It ends where the long way does. False, and nothing done, where that is not sure.
        """
        x, bodies = body.id, self._bodies
        ties, held = self._ties.get(x), self._held.get(x)
        if ties is None:
            return False
        if not ties:
            amid = self._amid(body)
            if amid is None:
                return False
            return self._land(body, amid, found) if amid else self._float(body, found)
        if held is None or len(held) > 1 or x in self._loose:
            return False
        ((y, bond),) = held.items()
        tie = ties.get(y)
        if tie is None or tie.falling(x)[1] is not bodies[y] or not bond.lies or bond.weight != 1.0:
            return False
        sides = self._sides(body, y)
        slid = None if sides is None else slide(body, bodies[y])
        if sides is None or slid is None:
            return False
        tie.slide(body, slid.rest, x == tie.a.id)
        found[tie.a.id, tie.b.id] = _lies(slid, bond)
        if sides:
            before = set(ties)
            self._sides_of(sides).follow(body, sides, found)
            for z in before ^ ties.keys():
                self._stop(x, z)
        glide = self._glides.get(x)
        if isinstance(glide, Glide) and glide.refused <= _VAIN and glide.tray == slid.tray:
            glide.resume(body)
        elif self._n_to_draw > 0:
            self._n_to_draw -= 1
            self._keep(Glide.of(body, tie, slid, bond.normal, self._crowd.room(x), self._around(x), self._sides_of))
        return True

    def _sides(self, body: Body, support: str) -> list[str] | None:
        """The blocks that a body on its support may touch sideways, or did; None if anything else may matter to it."""
        bodies, ties = self._bodies, self._ties[body.id]
        sides = [z for z in ties if z != support]
        if any(ties[z].may_bear or not are_beside(body, bodies[z]) for z in sides):
            return None
        amid = self._amid(body)
        if amid is None:
            return None
        for z in amid:
            other = bodies[z]
            if z == support or z in ties:
                continue
            if are_beside(body, other):
                sides.append(z)
            elif body.size_m >= other.size_m or not is_clear(body, other):
                return None
        return sides

    def _sides_of(self, names: Sequence[str]) -> Sides:
        return Sides(names, self._bodies, self._ties)

    def _land(self, body: Body, amid: Sequence[str], found: dict[Pair, Junction | None]) -> bool:
        """The short way for what touched nothing, and comes to lie on one thing alone; else as `_slide`."""
        x, bodies = body.id, self._bodies
        y = min(amid, key=lambda z: bodies[z].size_m)
        slid = slide(body, bodies[y])
        if slid is None or (len(amid) > 1 and not self._lets_alone(body, y)):
            return False
        one, other = (body, bodies[y]) if x < y else (bodies[y], body)
        tie = Tie(one, other, slid.rest if one is body else None, slid.rest if other is body else None)
        self._ties[x][y] = self._ties.setdefault(y, {})[x] = tie
        self._loose.discard(x)
        self._stop_around(x)
        bond = self._holding.support(x, y, Support(1.0, slid.rest.fall_m), lies=True)
        self._held[x] = {y: bond}
        found[one.id, other.id] = _lies(slid, bond)
        self._n_to_draw -= 1
        return True

    def _float(self, body: Body, found: dict[Pair, Junction | None]) -> bool:
        """The short way for what touched nothing, is beside all that is near, and hangs from none of it; else as
        `_slide`."""
        x, reach_m, around = body.id, hang_reach_m(body.size_m), self._around(body.id)
        if any(other.size_m > body.size_m and not apart_by(body, other, reach_m) for other, _ in around):
            return False
        for y in self._held.pop(x, ()):
            found[pair_of(x, y)] = None
        if x not in self._loose:
            self._loose.add(x)
            self._stop_around(x)
        self._keep(Drift.of(body, self._crowd.room(x), around))
        self._n_to_draw -= 1
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

    def _lets_alone(self, body: Body, support: str) -> bool:
        """Whether all neighbours but its support are beside a body or around it, and none may hang from it."""
        amid, bodies, size_m = self._amid(body), self._bodies, body.size_m
        return amid is not None and all(
            z == support or (size_m < bodies[z].size_m and is_clear(body, bodies[z])) for z in amid
        )

    def _amid(self, body: Body) -> list[str] | None:
        """The neighbours that a body is not beside; None if one may hang from it."""
        bodies, loose, margin_m, size_m, amid = self._bodies, self._loose, TOUCH_M, body.size_m, []
        (x0, x1, x2), (x3, x4, x5) = body.low, body.high
        flat = 3 - self._up_axis
        if flat == 1:
            x2, x5 = x1, x4
        x0, x2, x3, x5 = x0 - margin_m, x2 - margin_m, x3 + margin_m, x5 + margin_m
        for z in self._crowd.near[body.id]:
            other = bodies[z]
            low, high = other.low, other.high
            if not (x0 > high[0] or low[0] > x3 or x2 > high[flat] or low[flat] > x5):
                amid.append(z)
            if z in loose and size_m > other.size_m:
                return None
        return amid

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
        if ties:
            for tie, gap in zip(ties.values(), gaps_of([(t.a, t.b) for t in ties.values()], WITHIN_M), strict=True):
                tie.tell_apart(gap)

    def _tell_falls(self, unsure: Iterable[str]) -> None:
        """Find out all at once how far what has few triangles is to fall."""
        asked = [(tie, x) for x in unsure for tie in self._ties.get(x, {}).values() if tie.asks_falls(x)]
        if asked:
            for (tie, x), falls_m in zip(asked, falls_of([tie.falling(x) for tie, x in asked]), strict=True):
                tie.tell_falls(x, falls_m)

    def _hold_anew(self, x: str, dirty: set[Pair]) -> None:
        """Find out what holds a body; the pairs in which another than before does are dirty."""
        was_loose = x in self._loose
        before, now = self._held.get(x), self._holding.holders(x)
        self._glides.pop(x, None)
        if was_loose != (x in self._loose):
            self._stop_around(x)
        if now:
            self._held[x] = now
        elif before:
            del self._held[x]
        for y in (before or {}).keys() | now.keys():
            dirty.add(pair_of(x, y))


def _lies(slid: Slide, bond: Bond) -> Junction:
    """Where a body lies wholly on another."""
    n = len(slid.points)
    return Junction(slid.points, _ONES[:n], bond.normals[:n])
