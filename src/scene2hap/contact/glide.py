"""The shortest ways of a frame: what lies wholly on its only support, and slides there, has new points and no more, but
where it touches blocks sideways; what is in the air far from everything has nothing at all.

A `Glide` or a `Drift` is kept for a thing while all that makes it so holds: one full bond or no tie, and nobody in the
way but blocks that it is beside. Within it, a step is a handful of comparisons and additions, the same arithmetic as
the long way's. Where a step is not surely one of these, it is refused, and nothing done.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import NamedTuple

from scene2hap.contact.body import Body
from scene2hap.contact.clearing import NOWHERE, open_box
from scene2hap.contact.junction import Junction, Pair
from scene2hap.contact.ledge import Flat
from scene2hap.contact.level import Rest
from scene2hap.contact.sides import Sides, are_beside
from scene2hap.contact.slide import SURE_M, Slide
from scene2hap.contact.stance import Tray
from scene2hap.contact.support import TOUCH_M, fall_reach_m, hang_reach_m, is_under
from scene2hap.contact.tie import Tie
from scene2hap.contact.track import Bounds, Track
from scene2hap.contact.vectors import Triple
from scene2hap.contact.zones import Room
from scene2hap.scene.pose import Pose


class Neighbour(NamedTuple):
    """One near a body, where it may move, and how far it may hang from the body [m], 0 if not at all."""

    body: Body
    room: Room
    hang_m: float


SidesOf = Callable[[Sequence[str], Mapping[str, float]], Sides]
"""Makes `Sides` of blocks and others, by their ids."""

_new = tuple.__new__
_ONES = (1.0,) * 4


class Glide:
    """A body that slides on another.

    `on` is the other's id, `tray` what of it is below; `sides` are blocks that it may touch as it goes by; `hosts` are
    those in whose clearings it goes on, as long as they stay where they are; `body` is changed in place as it goes;
    `refused` counts its owner's vain attempts.
    """

    __slots__ = (
        "_fall_m",
        "_is_a",
        "_lane",
        "_normals",
        "_sides",
        "_tie",
        "_top_m",
        "_track",
        "body",
        "hosts",
        "on",
        "pair",
        "refused",
        "tray",
    )

    def __init__(
        self,
        body: Body,
        tie: Tie,
        tray: Tray,
        normal: Triple | None,
        bounds: Bounds,
        track: Track,
        sides: Sides | None,
        hosts: Sequence[str],
    ) -> None:
        self.body, self._tie, self._is_a = body, tie, body.id == tie.a.id
        self.pair: Pair = (tie.a.id, tie.b.id)
        self.on = tie.b.id if self._is_a else tie.a.id
        self.tray = tray
        self._normals = (normal,) * len(track.stance.footing.points)
        self._fall_m, self._top_m, self._lane = math.nan, bounds.top_m, bounds.lane
        self._track, self._sides = track, sides
        self.hosts, self.refused = hosts, 0

    @classmethod
    def of(
        cls,
        body: Body,
        tie: Tie,
        slide: Slide,
        normal: Triple | None,
        zone: Room,
        around: Iterable[Neighbour],
        track: Track,
        sides_of: SidesOf,
    ) -> Glide:
        """The glide of a body that slides so, may move in a zone, and has such neighbours; `track` is the body's, and
        bound here. It goes nowhere unless boxes tell where."""
        support, up = (tie.b if body.id == tie.a.id else tie.a), body.up_axis
        middle_m = support.low[up] + support.high[up]
        opens, others, hosts = [zone], [], []
        blocks, off_m = [], {}
        if slide.is_ledge:
            opens.append(open_box(body, support, stands=True))
            # As `is_over` tells, for all heights of a slide: with a higher bottom, over all of it, or all in it.
            least_m = slide.rest.top_m + SURE_M
            if least_m > support.low[up] + TOUCH_M:
                middle_m = -math.inf
            elif least_m < support.high[up] - TOUCH_M:
                middle_m = -math.inf
                opens.append(_all_in(body, support))
        for other, room, hang_m in around:
            if hang_m or (other.id != support.id and not is_under(other, slide.rest.top_m)):
                margin_m = max(hang_m, TOUCH_M)
                over_m = max(margin_m, fall_reach_m(other.size_m))
                if max(_sideways_m(body, room)) > margin_m:
                    others.append((room, margin_m))
                elif room[0][up] - body.high[up] > over_m:
                    opens.append(_below(room, over_m, up))
                elif not hang_m and are_beside(body, other):
                    blocks.append(other.id)
                elif max(_sideways_m(body, (other.low, other.high))) > margin_m:
                    # It might come nearer in its room, but has not.
                    off_m[other.id] = margin_m
                elif hang_m:
                    opens.append(NOWHERE)
                else:
                    opens.append(open_box(body, other, stands=False))
                    hosts.append(other.id)
        zone, tray = _common(opens), slide.tray
        u, v = support.position_m[0], support.position_m[body.v_axis]
        bounds = Bounds(
            _lane(body, zone, others),
            (zone[0][up], zone[1][up]),
            middle_m,
            [(nu, nv, offset + nu * u + nv * v) for nu, nv, offset in tray.edges],
            support.position_m[up] + tray.height,
            SURE_M,
            2 / 3 * fall_reach_m(body.size_m),
        )
        track.bind(bounds)
        sides = sides_of(blocks, off_m) if blocks or off_m else None
        return cls(body, tie, tray, normal, bounds, track, sides, hosts)

    def minds(self, x: str, room: Room, margin_m: float) -> bool:
        """Whether it may be another once one may be anywhere in a box, and matters within a margin."""
        if self._sides is not None and self._sides.has(x):
            return self._sides.minds(x, margin_m)
        (u0, v0, u1, v1), flat, (low, high) = self._lane, self.body.v_axis, room
        gaps_m = (low[0] - u1, u0 - high[0], low[flat] - v1, v0 - high[flat])
        return max(gaps_m) <= margin_m or u0 > u1 or v0 > v1

    def reckons_with(self, x: str) -> bool:
        """Whether it asks for where another is."""
        return x in self.hosts or (self._sides is not None and self._sides.has(x))

    def resume(self, body: Body) -> None:
        """Go on from where another way has brought the body."""
        self.body, self._fall_m = body, math.nan

    def step(self, pose: Pose, found: dict[Pair, Junction | None]) -> bool:
        """Whether a step was surely a slide; then where the two touch is added to `found`."""
        slid = self._track.slid(pose.position_m, pose.rotation_xyzw)
        if slid is None:
            return False
        low, high, fall_m, places = slid
        body, sides = self.body, self._sides
        near = () if sides is None else sides.near(low, high, body.v_axis)
        if near is None:
            return False
        body.put(pose, low, high)
        if fall_m != self._fall_m:
            self._fall_m = fall_m
            self._tie.slide(body, Rest(fall_m, True, self._top_m), self._is_a)
        else:
            self._tie.forget()
        found[self.pair] = _new(Junction, (places, _ONES[: len(places)], self._normals, ()))
        if sides is not None:
            sides.follow(body, near, found)
        return True


class Drift:
    """A body far from all others, or beside them, in the air, that touches nothing and holds nothing."""

    __slots__ = ("_high", "_low", "_sides", "body", "hosts", "on", "refused")

    def __init__(self, body: Body, free: Room, sides: Sides | None, hosts: Sequence[str]) -> None:
        self.body, self._sides, self.hosts, self.on, self.refused = body, sides, hosts, "", 0
        self._low, self._high = free

    @classmethod
    def of(cls, body: Body, zone: Room, around: Iterable[Neighbour], sides_of: SidesOf) -> Drift:
        """The drift of a body that touches nothing, may move in a zone, and has such neighbours. It goes nowhere
        unless boxes tell where."""
        opens, others, hosts, off_m = [zone], [], [], {}
        up = body.up_axis
        for other, room, _ in around:
            gaps_m = _gaps_m(body, room)
            side = gaps_m.index(max(gaps_m))
            # The smaller may hang from the larger, and the upper fall onto the other unless they are beside each other.
            hang_m = max(TOUCH_M, hang_reach_m(min(body.size_m, other.size_m)))
            fall_m = fall_reach_m((other if side == up else body).size_m) if side % 3 == up else 0.0
            if gaps_m[side] > max(hang_m, fall_m):
                others.append((room, max(hang_m, fall_m)))
            elif max(_sideways_m(body, (other.low, other.high))) > hang_m:
                off_m[other.id] = hang_m
            else:
                opens.append(open_box(body, other, stands=False))
                hosts.append(other.id)
        return cls(body, _free_box(body, _common(opens), others), sides_of((), off_m) if off_m else None, hosts)

    def resume(self, body: Body) -> None:
        """Go on from where another way has brought the body."""
        self.body = body

    def minds(self, *_: object) -> bool:
        """Whether it may be another once one may be anywhere in a box, and matters within a margin."""
        return True

    def reckons_with(self, x: str) -> bool:
        """Whether it asks for where another is."""
        return x in self.hosts or (self._sides is not None and self._sides.has(x))

    def step(self, pose: Pose, _: dict[Pair, Junction | None]) -> bool:
        """Whether the body is still far from all after a step."""
        stance, (x, y, z) = self.body.stance, pose.position_m
        if pose.rotation_xyzw != stance.rotation_xyzw:
            turned = stance.turned(pose.rotation_xyzw)
            if turned.way_up != stance.way_up:
                return False
            stance = turned
        (a, b, c), (d, e, f) = stance.low, stance.high
        low, high = (x + a, y + b, z + c), (x + d, y + e, z + f)
        (a, b, c), (d, e, f) = self._low, self._high
        if low[0] < a or low[1] < b or low[2] < c or high[0] > d or high[1] > e or high[2] > f:
            return False
        if self._sides is not None and self._sides.near(low, high, stance.v_axis) is None:
            return False
        self.body.put(pose, low, high, stance)
        return True


def _common(rooms: Sequence[Room]) -> Room:
    """What of the world lies in all of these boxes, which need not meet."""
    (a, b, c), (d, e, f) = rooms[0]
    for (g, h, i), (j, k, m) in rooms[1:]:
        a, b, c, d, e, f = max(a, g), max(b, h), max(c, i), min(d, j), min(e, k), min(f, m)
    return (a, b, c), (d, e, f)


def _below(room: Room, margin_m: float, up: int) -> Room:
    """Where anything is surely farther below a box than that."""
    high = [math.inf] * 3
    high[up] = room[0][up] - 1.001 * margin_m
    return (-math.inf, -math.inf, -math.inf), (high[0], high[1], high[2])


def _all_in(body: Body, support: Body) -> Room:
    """Where a body is all in another, with a bottom as low at least and a top that is higher than that."""
    up, low = body.up_axis, list(support.low)
    height_m = body.high[up] - body.low[up]
    low[up] += max(-TOUCH_M, 1.001 * TOUCH_M - height_m)
    return (low[0], low[1], low[2]), support.high


def _sideways_m(body: Body, room: Room) -> tuple[float, float, float, float]:
    """How far a box is beyond a body, level: towards greater u, less u, greater v, less v."""
    flat, (low, high), near, far = body.v_axis, room, body.low, body.high
    return (low[0] - far[0], near[0] - high[0], low[flat] - far[flat], near[flat] - high[flat])


def _gaps_m(body: Body, room: Room) -> list[float]:
    """How far a box is beyond a body: towards greater and then towards less x, y, z."""
    (low, high), near, far = room, body.low, body.high
    return [low[k] - far[k] for k in range(3)] + [near[k] - high[k] for k in range(3)]


def _free_box(body: Body, zone: Room, others: Iterable[tuple[Room, float]]) -> Room:
    """Where a body is in its zone and surely farther from the boxes of others than told with each, as it is now."""
    low, high = list(zone[0]), list(zone[1])
    for room, margin_m in others:
        gaps = _gaps_m(body, room)
        side = gaps.index(max(gaps))
        # A little more than the margin, so that rounding does not matter.
        if side < 3:
            high[side] = min(high[side], room[0][side] - 1.001 * margin_m)
        else:
            low[side - 3] = max(low[side - 3], room[1][side - 3] + 1.001 * margin_m)
    return (low[0], low[1], low[2]), (high[0], high[1], high[2])


def _lane(body: Body, zone: Room, others: Iterable[tuple[Room, float]]) -> Flat:
    """Where a body is in its zone and surely farther beside the boxes of others than told with each, as it is now."""
    flat, (low, high) = body.v_axis, zone
    u0, v0, u1, v1 = low[0], low[flat], high[0], high[flat]
    for room, margin_m in others:
        gaps = _sideways_m(body, room)
        side = gaps.index(max(gaps))
        margin_m *= 1.001  # so that rounding does not matter
        if side == 0:
            u1 = min(u1, room[0][0] - margin_m)
        elif side == 1:
            u0 = max(u0, room[1][0] + margin_m)
        elif side == 2:
            v1 = min(v1, room[0][flat] - margin_m)
        else:
            v0 = max(v0, room[1][flat] + margin_m)
    return (u0, v0, u1, v1)
