"""The short ways of what is not in a glide: it slides on its only support, lands on one, or floats far from all others.

Each ends where the long way does, to the last bit, at a fraction of the time, and is taken where that is sure.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence

from scene2hap.contact.body import Body
from scene2hap.contact.bond import Bond
from scene2hap.contact.broad_phase import BroadPhase
from scene2hap.contact.drift import Drift
from scene2hap.contact.free_space import has_nothing_near
from scene2hap.contact.glide import Glide
from scene2hap.contact.glides import Glides
from scene2hap.contact.holding import Holding
from scene2hap.contact.junction import Junction, Pair, pair_of
from scene2hap.contact.pair import BodyPair, apart_by
from scene2hap.contact.rooms import Neighbour
from scene2hap.contact.sides import Sides, are_beside
from scene2hap.contact.slide import Slide, slide
from scene2hap.contact.support import TOUCH_M, Support, fall_reach_m, hang_reach_m, is_under
from scene2hap.contact.track import Track

_ONES = (1.0,) * 4
_VAIN = 15  # A glide that was refused so often is drawn anew.


class ShortWays:
    """The short ways of things, which change what is kept of them; where they touch then is added to what is `found`.

    Parameters: holding : what is known of all things; crowd : their neighbours; glides : those that are in one.
    """

    def __init__(self, holding: Holding, crowd: BroadPhase, glides: Glides) -> None:
        self._holding, self._broad_phase, self._glides = holding, crowd, glides
        self._bodies, self._body_pairs, self._held, self._unsupported = (
            holding.bodies,
            holding.body_pairs,
            holding.held,
            holding.unsupported,
        )
        # What is known of how a thing slides outlasts a glide.
        self._tracks: dict[str, Track] = {}

    def take(self, body: Body, found: dict[Pair, Junction | None]) -> bool:
        """Take one for a body that has moved, if there is one; else nothing is done."""
        x = body.id
        body_pairs, held = self._body_pairs.get(x), self._held.get(x)
        if body_pairs is None:
            return False
        overlapping = self._overlapping_in_plan(body)
        if overlapping is None:
            return False
        if not body_pairs:
            return self._land(body, overlapping, found) or self._float(body, overlapping, found)
        if held is None or len(held) > 1 or x in self._unsupported:
            return False
        ((support, bond),) = held.items()
        body_pair = body_pairs.get(support)
        if (
            body_pair is None
            or body_pair.falling(x)[1] is not self._bodies[support]
            or not bond.lies
            or bond.weight != 1.0
        ):
            return False
        return self._slide(body, body_pair, bond, overlapping, found) or self._float(body, overlapping, found)

    def forget(self, x: str) -> None:
        """One is gone."""
        self._tracks.pop(x, None)

    def announce(self, body: Body) -> None:
        """Have the glides around look out for a body that may be elsewhere now, or come to hang from others."""
        x = body.id
        margin_m = max(TOUCH_M, hang_reach_m(body.size_m)) if x in self._unsupported else TOUCH_M
        self._glides.look_out(self._broad_phase.neighbours[x], x, self._broad_phase.room(x), margin_m)

    def drift(self, body: Body) -> None:
        """Let a body that touches nothing drift from now on."""
        x = body.id

        def draw() -> Drift:
            body = self._bodies[x]
            return Drift.of(body, self._broad_phase.room(x), self._around(body), self._sides_of)

        self._glides.begin(x, draw)

    def _glide(self, body: Body, body_pair: BodyPair, slid: Slide, bond: Bond) -> None:
        """Let a body that lies so on another glide from now on."""
        x, track, stance = body.id, self._tracks.get(body.id), body.stance
        if track is None or track.stance.shape is not stance.shape or track.stance.way_up != stance.way_up:
            track = self._tracks[x] = Track(stance)

        def draw() -> Glide:
            body = self._bodies[x]
            room, around = self._broad_phase.room(x), self._around(body)
            return Glide.of(body, body_pair, slid, bond.normal, room, around, track, self._sides_of)

        self._glides.begin(x, draw)

    def _slide(
        self,
        body: Body,
        body_pair: BodyPair,
        bond: Bond,
        overlapping: Sequence[str],
        found: dict[Pair, Junction | None],
    ) -> bool:
        """For what stays on its only support, with nothing else near enough to matter but blocks that it is beside."""
        x, (_, support) = body.id, body_pair.falling(body.id)
        slid = slide(body, support)
        sides = None if slid is None else self._sides(body, support.id, overlapping, slid.rest.top_m)
        if sides is None or slid is None:
            return False
        body_pair.slide(body, slid.rest, x == body_pair.a.id)
        found[body_pair.a.id, body_pair.b.id] = _lies(slid, bond)
        self._follow(body, support.id, slid.rest.top_m, sides, found)
        glide = self._glides.of.get(x)
        if isinstance(glide, Glide) and glide.refused <= _VAIN and glide.top_face == slid.top_face:
            glide.resume(body)
        else:
            self._glide(body, body_pair, slid, bond)
        return True

    def _land(self, body: Body, overlapping: Sequence[str], found: dict[Pair, Junction | None]) -> bool:
        """For what touched nothing, and comes to lie on one thing, with nothing else near enough to matter but blocks
        that it is beside then."""
        x, bodies = body.id, self._bodies
        for support in sorted([bodies[z] for z in overlapping], key=lambda other: other.size_m):
            slid = slide(body, support)
            sides = None if slid is None else self._sides(body, support.id, overlapping, slid.rest.top_m)
            if sides is not None and slid is not None:
                break
        else:
            return False
        is_a = x < support.id
        one, other = (body, support) if is_a else (support, body)
        body_pair = BodyPair(one, other, slid.rest if is_a else None, None if is_a else slid.rest)
        self._body_pairs[x][support.id] = self._body_pairs.setdefault(support.id, {})[x] = body_pair
        self._unsupported.discard(x)
        self._glides.stop(support.id)
        bond = self._holding.support(x, support.id, Support(1.0, slid.rest.fall_m), lies=True)
        self._held[x] = {support.id: bond}
        found[one.id, other.id] = _lies(slid, bond)
        self._follow(body, support.id, slid.rest.top_m, sides, found)
        self._glide(body, body_pair, slid, bond)
        return True

    def _float(self, body: Body, overlapping: Collection[str], found: dict[Pair, Junction | None]) -> bool:
        """For what touches nothing, since it is far over or under all that it is not beside, hangs from nothing, and
        bore nothing."""
        x, body_pairs, reach_m = body.id, self._body_pairs[body.id], hang_reach_m(body.size_m)
        if any(body_pair.rest(z) is not None for z, body_pair in body_pairs.items()):
            return False
        for z in self._broad_phase.neighbours[x]:
            other = self._bodies[z]
            if z in body_pairs or z in overlapping:
                if not _are_far(body, other):
                    return False
            elif other.size_m > body.size_m and not apart_by(body, other, reach_m):
                return False
        for z in body_pairs:
            del self._body_pairs[z][x]
            self._glides.stop(z)
            found[pair_of(x, z)] = None
        body_pairs.clear()
        for y in self._held.pop(x, ()):
            found[pair_of(x, y)] = None
        if x not in self._unsupported:
            self._unsupported.add(x)
            self.announce(body)
        drift = self._glides.of.get(x)
        if isinstance(drift, Drift) and drift.refused <= _VAIN:
            drift.resume(body)
        else:
            self.drift(body)
        return True

    def _sides(self, body: Body, support: str, overlapping: Sequence[str], top_m: float) -> list[str] | None:
        """The blocks that a body on its support may touch sideways, or did; None if anything else may matter to it.

        Parameters: top_m : the height of what it lies on; what is all below that, such as cupboards under a worktop,
        does not matter, nor what is far above, such as cabinets over it.
        """
        bodies, body_pairs = self._bodies, self._body_pairs[body.id]
        sides: list[str] = []
        for z in (*body_pairs, *[z for z in overlapping if z not in body_pairs]):
            other = bodies[z]
            if z == support or is_under(other, top_m) or (z not in body_pairs and _are_far(body, other)):
                continue
            if are_beside(body, other) and not (z in body_pairs and body_pairs[z].may_bear):
                sides.append(z)
            elif z in body_pairs or body.size_m >= other.size_m or not has_nothing_near(body, other):
                return None
        return sides

    def _follow(
        self, body: Body, support: str, top_m: float, sides: Sequence[str], found: dict[Pair, Junction | None]
    ) -> None:
        """Pair a body to what it touches sideways, in reserve to what is below its support, and to nothing else."""
        x, body_pairs, bodies = body.id, self._body_pairs[body.id], self._bodies
        under = [z for z in self._broad_phase.neighbours[x] if z != support and is_under(bodies[z], top_m)]
        if not (under or sides) and len(body_pairs) == 1:
            return
        before = set(body_pairs)
        for z in before.difference(under, sides, (support,)):
            del body_pairs[z], self._body_pairs[z][x]
            found[pair_of(x, z)] = None
        for z in under:
            body_pairs[z] = self._body_pairs.setdefault(z, {})[x] = BodyPair.in_reserve(body, bodies[z])
            found[pair_of(x, z)] = None
        if sides:
            self._sides_of(sides, {}).follow(body, sides, found)
        for z in before ^ body_pairs.keys():
            self._glides.stop(x, z)

    def _sides_of(self, blocks: Sequence[str], off_m: Mapping[str, float]) -> Sides:
        return Sides(blocks, off_m, self._bodies, self._body_pairs)

    def _around(self, body: Body) -> list[Neighbour]:
        room, bodies, unsupported, size_m = self._broad_phase.room, self._bodies, self._unsupported, body.size_m
        around = []
        for z in self._broad_phase.neighbours[body.id]:
            other = bodies[z]
            hang_m = hang_reach_m(other.size_m) if z in unsupported and size_m > other.size_m else 0.0
            around.append(Neighbour(other, room(z), hang_m))
        return around

    def _overlapping_in_plan(self, body: Body) -> list[str] | None:
        """The neighbours that a body is not beside; None if one may hang from it, or did."""
        bodies, unsupported, margin_m, size_m, overlapping = self._bodies, self._unsupported, TOUCH_M, body.size_m, []
        body_pairs = self._body_pairs.get(body.id, ())
        (x0, x1, x2), (x3, x4, x5) = body.low, body.high
        flat = body.v_axis
        if flat == 1:
            x2, x5 = x1, x4
        x0, x2, x3, x5 = x0 - margin_m, x2 - margin_m, x3 + margin_m, x5 + margin_m
        for z in self._broad_phase.neighbours[body.id]:
            other = bodies[z]
            low, high = other.low, other.high
            if not (x0 > high[0] or low[0] > x3 or x2 > high[flat] or low[flat] > x5):
                overlapping.append(z)
            may_hang = z in unsupported and size_m > other.size_m
            if may_hang and (z in body_pairs or not apart_by(body, other, hang_reach_m(other.size_m))):
                return None
        return overlapping


def _are_far(x: Body, y: Body) -> bool:
    """Whether two that are over each other are too far apart for one to fall onto the other or to hang from it."""
    up = x.up_axis
    upper, smaller_m = (x if x.low[up] > y.low[up] else y), min(x.size_m, y.size_m)
    return apart_by(x, y, max(TOUCH_M, hang_reach_m(smaller_m), fall_reach_m(upper.size_m)))


def _lies(slid: Slide, bond: Bond) -> Junction:
    """Where a body lies wholly on another."""
    n = len(slid.points)
    return Junction(slid.points, _ONES[:n], bond.normals[:n])
