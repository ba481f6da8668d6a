"""The shortest way of a frame: what lies wholly on its only support, and slides there, has new points and no more, but
where it touches blocks sideways.

A `Glide`, as a `Drift` of what is in the air, is kept for a thing while all that makes it so holds: one full bond, and
nobody in the way but what it is beside. Within it, a step is a handful of comparisons and additions, the same
arithmetic as the long way's. Where a step is not surely one of these, it is refused, and nothing done.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

from scene2hap.contact.body import Body
from scene2hap.contact.fat_boxes import AABB
from scene2hap.contact.free_space import NOWHERE, open_box
from scene2hap.contact.junction import Junction, Pair
from scene2hap.contact.ledge import Flat
from scene2hap.contact.level import Rest
from scene2hap.contact.pair import BodyPair
from scene2hap.contact.rooms import Neighbour, common, sideways_m, under
from scene2hap.contact.sides import Sides, SidesOf, are_beside
from scene2hap.contact.slide import SURE_M, Slide
from scene2hap.contact.stance import TopFace
from scene2hap.contact.support import TOUCH_M, fall_reach_m, is_under
from scene2hap.contact.track import Bounds, Track
from scene2hap.contact.vectors import Triple
from scene2hap.scene.pose import Pose

_new = tuple.__new__
_ONES = (1.0,) * 4


class Glide:
    """A body that slides on another.

    `on` is the other's id, `top_face` what of it is below; `sides` are blocks that it may touch as it goes by; `hosts`
    are those in whose free regions it goes on, as long as they stay where they are; `body` is changed in place as it
    goes; `refused` counts its owner's vain attempts.
    """

    __slots__ = (
        "_body_pair",
        "_fall_m",
        "_is_a",
        "_lane",
        "_normals",
        "_sides",
        "_top_m",
        "_track",
        "body",
        "hosts",
        "on",
        "pair",
        "refused",
        "top_face",
    )

    def __init__(
        self,
        body: Body,
        body_pair: BodyPair,
        top_face: TopFace,
        normal: Triple | None,
        bounds: Bounds,
        track: Track,
        sides: Sides | None,
        hosts: Sequence[str],
    ) -> None:
        self.body, self._body_pair, self._is_a = body, body_pair, body.id == body_pair.a.id
        self.pair: Pair = (body_pair.a.id, body_pair.b.id)
        self.on = body_pair.b.id if self._is_a else body_pair.a.id
        self.top_face = top_face
        self._normals = (normal,) * len(track.stance.posed_base_face.points)
        self._fall_m, self._top_m, self._lane = math.nan, bounds.top_m, bounds.lane
        self._track, self._sides = track, sides
        self.hosts, self.refused = hosts, 0

    @classmethod
    def of(
        cls,
        body: Body,
        body_pair: BodyPair,
        slide: Slide,
        normal: Triple | None,
        zone: AABB,
        around: Iterable[Neighbour],
        track: Track,
        sides_of: SidesOf,
    ) -> Glide:
        """The glide of a body that slides so, may move in a fat box, and has such neighbours; `track` is the body's,
        and bound here. It goes nowhere unless boxes tell where."""
        support, up = (body_pair.b if body.id == body_pair.a.id else body_pair.a), body.up_axis
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
                if max(sideways_m(body, room)) > margin_m:
                    others.append((room, margin_m))
                elif room[0][up] - body.high[up] > over_m:
                    opens.append(under(room, over_m, up))
                elif not hang_m and are_beside(body, other):
                    blocks.append(other.id)
                elif max(sideways_m(body, (other.low, other.high))) > margin_m:
                    # It might come nearer in its room, but has not.
                    off_m[other.id] = margin_m
                elif hang_m:
                    opens.append(NOWHERE)
                else:
                    opens.append(open_box(body, other, stands=False))
                    hosts.append(other.id)
        zone, top_face = common(opens), slide.top_face
        u, v = support.position_m[0], support.position_m[body.v_axis]
        bounds = Bounds(
            _lane(body, zone, others),
            (zone[0][up], zone[1][up]),
            middle_m,
            [(nu, nv, offset + nu * u + nv * v) for nu, nv, offset in top_face.edges],
            support.position_m[up] + top_face.height,
            SURE_M,
            2 / 3 * fall_reach_m(body.size_m),
        )
        track.bind(bounds)
        sides = sides_of(blocks, off_m) if blocks or off_m else None
        return cls(body, body_pair, top_face, normal, bounds, track, sides, hosts)

    def minds(self, x: str, room: AABB, margin_m: float) -> bool:
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
            self._body_pair.slide(body, Rest(fall_m, True, self._top_m), self._is_a)
        else:
            self._body_pair.forget()
        found[self.pair] = _new(Junction, (places, _ONES[: len(places)], self._normals, ()))
        if sides is not None:
            sides.follow(body, near, found)
        return True


def _all_in(body: Body, support: Body) -> AABB:
    """Where a body is all in another, with a bottom as low at least and a top that is higher than that."""
    up, low = body.up_axis, list(support.low)
    height_m = body.high[up] - body.low[up]
    low[up] += max(-TOUCH_M, 1.001 * TOUCH_M - height_m)
    return (low[0], low[1], low[2]), support.high


def _lane(body: Body, zone: AABB, others: Iterable[tuple[AABB, float]]) -> Flat:
    """Where a body is in its fat box and surely farther beside the boxes of others than told with each, as it is
    now."""
    flat, (low, high) = body.v_axis, zone
    u0, v0, u1, v1 = low[0], low[flat], high[0], high[flat]
    for room, margin_m in others:
        gaps = sideways_m(body, room)
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
