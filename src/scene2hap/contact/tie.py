"""What is known of two bodies where they are now: who may fall onto whom, how far they are apart, where they meet.

Level things by their outlines, all others by their triangles, each fact found when first asked for.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from scene2hap.contact.body import Body
from scene2hap.contact.level import Aside, Rest, aside, rest_on
from scene2hap.contact.narrow import Gap, Meeting, Patch
from scene2hap.contact.profile import Floats, Triple
from scene2hap.contact.support import TOUCH_M, fall_reach_m, falls, is_over

# Above this a fall is surely none of a thing that stands in another: tops and soles may be 0.2 mm uneven each.
_SURE_M = -TOUCH_M + 0.001

UNCLEAR = Rest(math.nan, False)
"""Stands for a fall that only triangles can tell."""


class Tie:
    """Two bodies; `a` is the one with the lower id. `rest_a` is how a may lie on b and `rest_b` the other way round:
    None if not at all, `UNCLEAR` where triangles must tell."""

    __slots__ = ("_facts", "_meeting_made", "a", "b", "rest_a", "rest_b")

    def __init__(self, a: Body, b: Body, rest_a: Rest | None, rest_b: Rest | None) -> None:
        self.a, self.b, self.rest_a, self.rest_b = a, b, rest_a, rest_b
        self._meeting_made: Meeting | None = None
        self._facts: dict[object, Any] | None = None

    @classmethod
    def between(cls, a: Body, b: Body, infers: bool) -> Tie:
        """What is known of two bodies; without `infers` nothing falls."""
        rest_a = _rest(a, b) if infers else None
        return cls(a, b, rest_a, _rest(b, a) if infers and rest_a is None else None)

    def rest(self, x: str) -> Rest | None:
        """How x, one of the two, may lie on the other."""
        return self.rest_a if x == self.a.id else self.rest_b

    def slide(self, body: Body, rest: Rest, is_a: bool) -> None:
        """Take in that one has moved, and how it lies on the other now."""
        self._meeting_made = self._facts = None
        if is_a:
            self.a, self.rest_a = body, rest
        else:
            self.b, self.rest_b = body, rest

    def falls(self, x: str) -> Floats | None:
        """How far the triangles of x are to fall; see `support.falls`."""
        found: Floats | None = self._once(x, lambda: falls(self._meeting, self.a if x == self.a.id else self.b))
        return found

    def aside(self, within_m: float, slack_m: float) -> Aside | None:
        """How the two are beside each other, if both are blocks; see `level.aside`."""
        if not (self.a.stance.is_block and self.b.stance.is_block):
            return None
        found: Aside | None = self._once((within_m, slack_m), lambda: aside(self.a, self.b, within_m, slack_m))
        return found

    def gap(self, within_m: float) -> Gap | None:
        """How far their triangles are apart; see `Meeting.gap`."""
        found: Gap | None = self._once(within_m, lambda: self._meeting.gap(within_m))
        return found

    def patch(self, way_m: Floats, within_m: float) -> Patch:
        """Where their triangles meet; see `Meeting.patch`."""
        found: Patch = self._once((*way_m.tolist(), within_m), lambda: self._meeting.patch(way_m, within_m))
        return found

    def _once(self, key: object, find: Callable[[], object]) -> Any:
        facts = self._facts
        if facts is None:
            facts = self._facts = {}
        if key not in facts:
            facts[key] = find()
        return facts[key]

    @property
    def _meeting(self) -> Meeting:
        if self._meeting_made is None:
            self._meeting_made = Meeting(self.a, self.b)
        return self._meeting_made


def apart_by(x: Body, y: Body, margin_m: float) -> bool:
    """Whether the boxes around two bodies are farther apart than that along some axis."""
    (a, b, c), (d, e, f), (g, h, i), (j, k, m) = x.low, x.high, y.low, y.high
    return max(a - j, g - d, b - k, h - e, c - m, i - f) > margin_m


def _rest(x: Body, y: Body) -> Rest | None:
    """How x may lie on y."""
    reach_m = fall_reach_m(x.size_m)
    up, v_axis = x.up_axis, x.stance.v_axis
    if (
        x.low[up] - y.high[up] > reach_m
        or x.low[0] >= y.high[0]
        or y.low[0] >= x.high[0]
        or x.low[v_axis] >= y.high[v_axis]
        or y.low[v_axis] >= x.high[v_axis]
        or not is_over(x, y)
    ):
        return None
    rest = rest_on(x, y)
    if rest is None or rest.fall_m < -TOUCH_M:
        return UNCLEAR
    return rest if rest.fall_m <= reach_m else None


def slide(x: Body, y: Body) -> tuple[Rest, tuple[Triple, ...]] | None:
    """How and where x lies on y if it does so wholly, without doubt and with full weight; else None: `Tie` must tell.

    The same as `rest_on` and `rest_points`, in one go.
    """
    up = x.up_axis
    sole, tray = x.stance.footing, y.stance.tray
    if sole is None or tray is None:
        return None
    points, sole_height, (mu, mv), radius, _ = sole
    px, py, v_axis = x.position_m, y.position_m, x.stance.v_axis
    u, v, h, over = px[0], px[v_axis], px[up], py[up]
    fall_m = h + sole_height - over - tray.height
    if not _SURE_M < fall_m < 2 / 3 * fall_reach_m(x.size_m) or x.low[up] + x.high[up] <= y.low[up] + y.high[up]:
        return None
    cu, cv = mu + (u - py[0]), mv + (v - py[v_axis])
    for nu, nv, offset in tray.edges:
        if nu * cu + nv * cv - offset < radius:
            rest = rest_on(x, y)
            if rest is None or not rest.wholly:
                return None
            break
    # The same arithmetic as in `rest_points`, so that the last bits are those of building from nothing.
    height = (h + sole_height + over + tray.height) / 2
    if up == 1:
        return Rest(fall_m, True), tuple([(u + pu, height, v + pv) for pu, pv in points])
    return Rest(fall_m, True), tuple([(u + pu, v + pv, height) for pu, pv in points])
