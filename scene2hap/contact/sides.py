"""What one slides past: blocks that it may touch sideways, and where, and things that it must stay off.

Whose boxes are beside each other, neither lies on the other, hangs from it or is built into it; all that is between
them is a touch, which blocks tell by themselves.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Mapping, Sequence

from scene2hap.contact.body import Body
from scene2hap.contact.bond import direction
from scene2hap.contact.junction import Junction, Pair, pair_of
from scene2hap.contact.pair import BodyPair, apart_by
from scene2hap.contact.support import SLACK_M, TOUCH_M, weight
from scene2hap.contact.vectors import Triple


class Sides:
    """The blocks that a body may come to touch sideways, and others that it may not.

    Parameters: blocks : their ids; off_m : how far it must stay off others, by their ids; bodies, pairs : of all things
    by id, as their owner keeps them; pairs are changed.
    """

    __slots__ = ("_blocks", "_bodies", "_body_pairs", "_off_m")

    def __init__(
        self,
        blocks: Sequence[str],
        off_m: Mapping[str, float],
        bodies: Mapping[str, Body],
        body_pairs: dict[str, dict[str, BodyPair]],
    ) -> None:
        self._blocks, self._off_m, self._bodies, self._body_pairs = blocks, off_m, bodies, body_pairs

    def has(self, x: str) -> bool:
        """Whether one is among them."""
        return x in self._blocks or x in self._off_m

    def minds(self, x: str, margin_m: float) -> bool:
        """Whether it makes a difference that one matters within a margin."""
        return self._off_m.get(x, TOUCH_M if x in self._blocks else -math.inf) < margin_m

    def near(self, low: Triple, high: Triple, v_axis: int) -> Sequence[str] | None:
        """Which blocks may touch what is in a box; None if it is not beside all of them, and off all others."""
        bodies, within_m = self._bodies, TOUCH_M
        for z, margin_m in self._off_m.items():
            if _gap_m(low, high, bodies[z], v_axis) <= margin_m:
                return None
        near = []
        for z in self._blocks:
            gap_m = _gap_m(low, high, bodies[z], v_axis)
            if gap_m < 0:
                return None
            if gap_m <= within_m:
                near.append(z)
        return near

    def follow(self, body: Body, near: Collection[str], found: dict[Pair, Junction | None]) -> None:
        """Pair a block to those of them that it touches, which may be some that are near; where is added to `found`."""
        x, bodies, mine = body.id, self._bodies, self._body_pairs[body.id]
        for z in self._blocks:
            body_pair = None
            if z in near:
                other = bodies[z]
                body_pair = BodyPair(body, other, None, None) if x < z else BodyPair(other, body, None, None)
            if body_pair is not None and not (
                apart_by(body_pair.a, body_pair.b, TOUCH_M) or body_pair.has_nothing_near
            ):
                mine[z] = self._body_pairs.setdefault(z, {})[x] = body_pair
                found[body_pair.a.id, body_pair.b.id] = _touch(body_pair)
            elif mine.pop(z, None) is not None:
                del self._body_pairs[z][x]
                found[pair_of(x, z)] = None


SidesOf = Callable[[Sequence[str], Mapping[str, float]], Sides]
"""Makes `Sides` of blocks and others, by their ids."""


def are_beside(x: Body, y: Body) -> bool:
    """Whether two are blocks with their boxes beside each other."""
    return _gap_m(x.low, x.high, y, x.v_axis) >= 0 and x.stance.is_block and y.stance.is_block


def _gap_m(low: Triple, high: Triple, other: Body, v_axis: int) -> float:
    """How far a box is beside that of a body, below 0 if not at all."""
    near, far = other.low, other.high
    return max(low[0] - far[0], near[0] - high[0], low[v_axis] - far[v_axis], near[v_axis] - high[v_axis])


def _touch(body_pair: BodyPair) -> Junction | None:
    """Where two that are not clear of each other touch."""
    side = body_pair.aside(TOUCH_M, SLACK_M)
    share = 0.0 if side is None else weight(side.distance_m, TOUCH_M)
    if side is None or share <= 0:
        return None
    n = len(side.points)
    return Junction(side.points, (share,) * n, (direction(side.distance_m, side.way_m),) * n)
