"""The shortest ways of a frame: what lies wholly on its only support, and slides there, has new points and no more;
what is in the air far from everything has nothing at all.

A `Glide` or a `Drift` is kept for a thing while all that makes it so holds: one tie and a full bond or no tie, and
nobody in the way. Within it, a step is a handful of comparisons and additions, the same arithmetic as the long way's.
Where a step is not surely one of these, it is refused, and nothing done.
"""

from __future__ import annotations

import math
from collections.abc import Iterable

from scene2hap.contact.body import Body
from scene2hap.contact.crowd import Room
from scene2hap.contact.junction import Junction, Pair
from scene2hap.contact.level import Rest
from scene2hap.contact.profile import Triple
from scene2hap.contact.stance import Stance
from scene2hap.contact.support import fall_reach_m
from scene2hap.contact.tie import SURE_M, Tie
from scene2hap.scene.pose import Pose

_new = tuple.__new__
_ONES = (1.0,) * 4


class Glide:
    """A body that slides on another.

    `on` is the other's id; `body` is changed in place as it goes along; `refused` counts its owner's vain attempts.
    """

    __slots__ = (
        "_fall_m",
        "_flat",
        "_is_a",
        "_lane",
        "_most_m",
        "_normals",
        "_reach",
        "_stance",
        "_support_middle",
        "_tie",
        "_top_m",
        "_up",
        "_zone",
        "body",
        "on",
        "pair",
        "refused",
    )

    def __init__(
        self, body: Body, tie: Tie, normal: Triple | None, zone: Room, others: Iterable[Room], margin_m: float
    ) -> None:
        self.body, self._tie, self._is_a = body, tie, body.id == tie.a.id
        support = tie.b if self._is_a else tie.a
        self.pair: Pair = (tie.a.id, tie.b.id)
        self.on = support.id
        self._stance, self._up, self._flat = body.stance, body.up_axis, body.stance.v_axis
        footing, tray = body.stance.footing, support.stance.tray
        assert tray is not None
        self._normals = (normal,) * len(footing.points)
        self._fall_m, self._most_m = math.nan, 2 / 3 * fall_reach_m(body.size_m)
        self._top_m = support.position_m[self._up] + tray.height
        self._support_middle = support.low[self._up] + support.high[self._up]
        u, v = support.position_m[0], support.position_m[self._flat]
        self._reach = tuple([(nu, nv, offset + nu * u + nv * v) for nu, nv, offset in tray.edges])
        self._zone = zone
        self.refused = 0
        self._lane = _lane(body, zone, others, self._flat, margin_m)

    def resume(self, body: Body) -> None:
        """Go on from where another way has brought the body."""
        self.body, self._fall_m = body, math.nan

    def step(self, pose: Pose, found: dict[Pair, Junction | None]) -> bool:
        """Whether a step was surely a slide; then where the two touch is added to `found`."""
        stance = self._stance
        position_m, rotation_xyzw = pose.position_m, pose.rotation_xyzw
        if rotation_xyzw != stance.rotation_xyzw:
            turned = stance.turned(rotation_xyzw)
            if turned is None:
                return False
            stance = turned
        up, flat = self._up, self._flat
        x, y, z = position_m
        (a, b, c), (d, e, f) = stance.low, stance.high
        low, high = (x + a, y + b, z + c), (x + d, y + e, z + f)
        u0, v0, u1, v1 = self._lane
        if low[0] < u0 or high[0] > u1 or low[flat] < v0 or high[flat] > v1:
            return False
        down, over = low[up], high[up]
        zone_low, zone_high = self._zone
        if down < zone_low[up] or over > zone_high[up] or down + over <= self._support_middle:
            return False
        points, sole, (mu, mv), radius, _ = stance.footing
        h, u, v = position_m[up], x, position_m[flat]
        fall_m = h + sole - self._top_m
        if not SURE_M < fall_m < self._most_m:
            return False
        cu, cv = mu + u, mv + v
        for nu, nv, offset in self._reach:
            if nu * cu + nv * cv - offset < radius:
                return False
        # As in `rest_points`, to the last bit.
        height = (h + sole + self._top_m) / 2
        if up == 1:
            places = tuple([(u + pu, height, v + pv) for pu, pv in points])
        else:
            places = tuple([(u + pu, v + pv, height) for pu, pv in points])
        body, tie = self.body, self._tie
        _place(body, pose, stance, low, high)
        self._stance = stance
        if fall_m != self._fall_m:
            self._fall_m = fall_m
            tie.slide(body, Rest(fall_m, True, self._top_m), self._is_a)
        else:
            tie.forget()
        found[self.pair] = _new(Junction, (places, _ONES[: len(places)], self._normals, ()))
        return True


class Drift:
    """A body far from all others, in the air, that touches nothing and holds nothing."""

    __slots__ = ("_high", "_low", "body", "on", "refused")

    def __init__(self, body: Body, zone: Room, others: Iterable[tuple[Room, float]]) -> None:
        self.body, self.on, self.refused = body, "", 0
        self._low, self._high = _free_box(body, zone, others)

    def step(self, pose: Pose, _: dict[Pair, Junction | None]) -> bool:
        """Whether the body is still far from all after a step."""
        stance, (x, y, z) = self.body.stance, pose.position_m
        if pose.rotation_xyzw != stance.rotation_xyzw:
            turned = stance.turned(pose.rotation_xyzw)
            if turned is None:
                return False
            stance = turned
        (a, b, c), (d, e, f) = stance.low, stance.high
        low, high = (x + a, y + b, z + c), (x + d, y + e, z + f)
        (a, b, c), (d, e, f) = self._low, self._high
        if low[0] < a or low[1] < b or low[2] < c or high[0] > d or high[1] > e or high[2] > f:
            return False
        _place(self.body, pose, stance, low, high)
        return True


def _place(body: Body, pose: Pose, stance: Stance, low: Triple, high: Triple) -> None:
    body.pose, body.position_m, body.low, body.high, body.stance = pose, pose.position_m, low, high, stance
    if body.__dict__:
        body.__dict__.clear()


_NOWHERE = ((1.0, 1.0, 1.0), (0.0, 0.0, 0.0))


def _free_box(body: Body, zone: Room, others: Iterable[tuple[Room, float]]) -> Room:
    """Where a body is in its zone and surely farther from the zones of others than told with each."""
    low, high = list(zone[0]), list(zone[1])
    near, far = body.low, body.high
    for (other_low, other_high), margin_m in others:
        gaps = [other_low[k] - far[k] for k in range(3)] + [near[k] - other_high[k] for k in range(3)]
        widest = max(gaps)
        if widest <= margin_m:
            return _NOWHERE
        side = gaps.index(widest)
        # A little more than the margin, so that rounding does not matter.
        if side < 3:
            high[side] = min(high[side], other_low[side] - 1.001 * margin_m)
        else:
            low[side - 3] = max(low[side - 3], other_high[side - 3] + 1.001 * margin_m)
    return (low[0], low[1], low[2]), (high[0], high[1], high[2])


def _lane(
    body: Body, zone: Room, others: Iterable[Room], flat: int, margin_m: float
) -> tuple[float, float, float, float]:
    """Where a body is in its zone and surely beside the zones of others: least and greatest u and v, as (u0, v0, u1,
    v1); nowhere if there is no such place."""
    (low, high), near, far = zone, body.low, body.high
    u0, v0, u1, v1 = low[0], low[flat], high[0], high[flat]
    for other_low, other_high in others:
        gaps = (
            other_low[0] - far[0],
            near[0] - other_high[0],
            other_low[flat] - far[flat],
            near[flat] - other_high[flat],
        )
        widest = max(gaps)
        if widest <= margin_m:
            return (1.0, 1.0, 0.0, 0.0)
        side = gaps.index(widest)
        # A little more than the margin, so that rounding does not matter.
        room_m = margin_m * 1.001
        if side == 0:
            u1 = min(u1, other_low[0] - room_m)
        elif side == 1:
            u0 = max(u0, other_high[0] + room_m)
        elif side == 2:
            v1 = min(v1, other_low[flat] - room_m)
        else:
            v0 = max(v0, other_high[flat] + room_m)
    return (u0, v0, u1, v1)
