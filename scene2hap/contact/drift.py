"""The shortest way of what is in the air, far from everything or beside it: it touches nothing and goes on so."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from scene2hap.contact.body import Body
from scene2hap.contact.fat_boxes import AABB
from scene2hap.contact.free_space import open_box
from scene2hap.contact.junction import Junction, Pair
from scene2hap.contact.rooms import Neighbour, common, gaps_m, sideways_m
from scene2hap.contact.sides import Sides, SidesOf
from scene2hap.contact.support import TOUCH_M, fall_reach_m, hang_reach_m
from scene2hap.scene.pose import Pose


class Drift:
    """A body in the air that touches nothing and holds nothing; see `Glide` for `on`, `hosts`, `body` and `refused`."""

    __slots__ = ("_high", "_low", "_sides", "body", "hosts", "on", "refused")

    def __init__(self, body: Body, free: AABB, sides: Sides | None, hosts: Sequence[str]) -> None:
        self.body, self._sides, self.hosts, self.on, self.refused = body, sides, hosts, "", 0
        self._low, self._high = free

    @classmethod
    def of(cls, body: Body, zone: AABB, around: Iterable[Neighbour], sides_of: SidesOf) -> Drift:
        """The drift of a body that touches nothing, may move in a fat box, and has such neighbours. It goes nowhere
        unless boxes tell where."""
        opens, others, hosts, off_m = [zone], [], [], {}
        up = body.up_axis
        for other, room, _ in around:
            gaps = gaps_m(body, room)
            side = gaps.index(max(gaps))
            # The smaller may hang from the larger, and the upper fall onto the other unless they are beside each other.
            hang_m = max(TOUCH_M, hang_reach_m(min(body.size_m, other.size_m)))
            fall_m = fall_reach_m((other if side == up else body).size_m) if side % 3 == up else 0.0
            if gaps[side] > max(hang_m, fall_m):
                others.append((room, max(hang_m, fall_m)))
            elif max(sideways_m(body, (other.low, other.high))) > hang_m:
                off_m[other.id] = hang_m
            else:
                opens.append(open_box(body, other, stands=False))
                hosts.append(other.id)
        return cls(body, _free_box(body, common(opens), others), sides_of((), off_m) if off_m else None, hosts)

    def resume(self, body: Body) -> None:
        """Go on from where another way has brought the body."""
        self.body = body

    def minds(self, x: str, _: AABB, margin_m: float) -> bool:
        """Whether it may be another once one may be anywhere in a box, and matters within a margin."""
        return self._sides is None or not self._sides.has(x) or self._sides.minds(x, margin_m)

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


def _free_box(body: Body, zone: AABB, others: Iterable[tuple[AABB, float]]) -> AABB:
    """Where a body is in its fat box and surely farther from the boxes of others than told with each, as it is now."""
    low, high = list(zone[0]), list(zone[1])
    for room, margin_m in others:
        gaps = gaps_m(body, room)
        side = gaps.index(max(gaps))
        # A little more than the margin, so that rounding does not matter.
        if side < 3:
            high[side] = min(high[side], room[0][side] - 1.001 * margin_m)
        else:
            low[side - 3] = max(low[side - 3], room[1][side - 3] + 1.001 * margin_m)
    return (low[0], low[1], low[2]), (high[0], high[1], high[2])
