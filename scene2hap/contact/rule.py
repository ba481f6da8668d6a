"""The rule of contact, with all of its tuned numbers: what holds a thing up, where the scene's author left a gap.

In real scenes objects hover 0-60 mm above their supports, and objects that do not touch are a few millimetres apart, so
that no single tolerance decides what touches. Surfaces nearer than `TOUCH_M` always touch. Beyond that an object must
be held:

1. *Support.* Let it fall. What its bottom meets first within `fall_reach_m` supports it, and what other parts of its
   bottom would meet less than `TOUCH_M` later: a chair stands on the carpet's edge and on the floor, a cup on the
   saucer and not on the table below, a trash can on the carpet and not on the floor that the carpet hides.
2. *Hanging.* What nothing supports hangs from the nearest larger things within `hang_reach_m`: a picture from the
   wall, a lamp from the ceiling, a handle from its leaf, a cabinet from the wall and from the cabinet beside it.

All weights are smooth in the gaps and know nothing of the past: the poses alone decide.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from scene2hap.compiled import compiled
from scene2hap.contact.body import Body
from scene2hap.contact.level import Rest
from scene2hap.contact.vectors import Floats

TOUCH_M = 0.004
"""Gap at which any two surfaces cease to touch (tuned: cups with a saucer between stand 6 mm over the table)."""

PATCH_SHARE = 0.25
"""A patch holds what is this much farther apart than the nearest points, as a share of the tolerance (assumed): the
feet of a chair are never quite level."""
SLACK_M = PATCH_SHARE * TOUCH_M

CLEAR_M = 1e-4
"""The way between surfaces nearer than this has no direction to speak of (assumed)."""

# Tuned on resting things in scenes made by others: a sofa hovers 57 mm and a chair of 0.45 m 45 mm; a tablet of 0.23 m
# hovers 37 mm. These are to weigh 1, as gaps do up to 2/3 of the reach. Small things, which hands lift, get less.
_FALL_REACH_M, _FALL_REACH_SIZES = 0.090, 0.25
# Tuned likewise: a television of 1.5 m hangs 49 mm off its wall, a shelf board 12 mm, a handle of 0.16 m 16 mm before
# its leaf. Six scenes listed by hand give the same from a share of 0.05 to 0.18; from 0.2 a picture hangs on a table.
HANG_REACH_M, _HANG_REACH_SIZES = 0.075, 0.15
# A grip leaves room for fingers however short it is: up to 16 mm off its leaf weigh 1. Not more than this share of its
# size, or a crumb reaches farther than it is long; less than that of falling.
_GRIP_REACH_M, _GRIP_REACH_SIZES = 0.024, 0.24
# What hangs may be held by several: a wall cabinet by the tall one that it touches and by the wall 5 mm behind it. So
# much more of its reach than the nearest may others be away (tuned: the same six scenes; from 1/4 pairs are wrong).
_HANG_SHARE = 1 / 6

_HIDDEN_M = 0.002  # What lies this much below something else is hidden by it (assumed: the thinnest carpet).


# Play on either side at which a thing ceases to be enclosed [m], at most and as a share of its diagonal. Up to 2/3 of
# it a thing is to weigh 1, as gaps do everywhere: 12.7 mm (and up to 0.8 mm more) beside drawers on ball-bearing rails,
# which models often lack, 5 mm beside those on rails below them, 1-3 mm on wooden runners, 2-4 mm around leaves and
# fronts. The smallest drawers on such rails have diagonals of 0.4 m; small things have little play in what is made for
# them.
_PLAY_M, _PLAY_SIZES = 0.0203, 0.05

SIDE_SHARE = 1 / 6
"""So much of a side is to have the play: a wooden runner, some 30-45 mm high, beside a drawer of up to 0.25 m."""

OUTSIDE_SHARE = 0.5
"""Share of its box outside the other's at which a thing ceases to be enclosed."""


# Reaches are kept by size: each is looked up some thirty times a frame.
_SIZES = 4096


def weight(gap_m: float, tolerance_m: float) -> float:
    """How much of a contact a gap leaves: 1 up to 2/3 of the tolerance, then half a cosine down to 0 at the tolerance.

    At tolerance 0 only a gap of 0 counts.
    """
    if tolerance_m == 0.0:
        return 1.0 if gap_m <= 0.0 else 0.0
    x = 3 * gap_m / tolerance_m - 2
    return 1.0 if x <= 0 else 0.0 if x >= 1 else 0.5 * (1 + math.cos(math.pi * x))


def weights(gaps_m: Floats, tolerance_m: float) -> Floats:
    """The same for many gaps (...)."""
    if tolerance_m == 0.0:
        return np.where(gaps_m <= 0.0, 1.0, 0.0)
    x = 3 * gaps_m / tolerance_m - 2
    found = np.where(x < 1, 1.0, 0.0)
    # Few are in between, and numpy's cosine may end otherwise in the last bit.
    between = (x > 0) & (x < 1)
    found[between] = [0.5 * (1 + math.cos(math.pi * one)) for one in x[between].tolist()]
    return found


@lru_cache(_SIZES)
def fall_reach_m(size_m: float) -> float:
    """How far a thing of that diagonal may hover over its support [m]."""
    return min(_FALL_REACH_M, _FALL_REACH_SIZES * size_m)


@lru_cache(_SIZES)
def hang_reach_m(size_m: float) -> float:
    """How far a thing of that diagonal may stand off what it hangs from [m]; less than its `fall_reach_m`."""
    return min(HANG_REACH_M, max(_HANG_REACH_SIZES * size_m, min(_GRIP_REACH_M, _GRIP_REACH_SIZES * size_m)))


@lru_cache(_SIZES)
def play_reach_m(size_m: float) -> float:
    """With how much play on either side a thing of that diagonal may be enclosed [m]."""
    return min(_PLAY_M, _PLAY_SIZES * size_m)


def margins_m(body: Body) -> tuple[float, float]:
    """How far a body may touch or hang from others, and how much farther it may fall [m]."""
    return max(TOUCH_M, hang_reach_m(body.size_m)), fall_reach_m(body.size_m)


class Support(NamedTuple):
    """How much of a contact a support is, 0..1, and how far it is to fall to it [m]."""

    weight: float
    fall_m: float


def supports(falls_m: Mapping[str, Floats], reach_m: float) -> dict[str, Support]:
    """Which of the things below hold a thing, from how far each of its triangles (m,) is to fall to each of them."""
    found = support_weights(list(falls_m.values()), reach_m, TOUCH_M, _HIDDEN_M) if falls_m else []
    return {name: Support(*support) for name, support in zip(falls_m, found, strict=True) if support[0] > 0}


@compiled
def support_weights(
    falls_m: Sequence[Floats], reach_m: float, touch_m: float, hidden_m: float
) -> list[tuple[float, float]]:
    """The weight of each support, and how far it is to fall to the nearest part that bears [m]; from how far each
    triangle (m,) is to fall to each of them, inf where it meets nothing."""
    table = np.stack(falls_m)
    table = table[:, np.isfinite(table).any(axis=0)]
    first = table.min(axis=0)
    least = first.min(initial=math.inf)
    seen = weights(table, reach_m) * weights(table - least, touch_m) * weights(table - first, hidden_m)
    return [
        (float(share.max(initial=0.0)), float(falls[share > 0].min(initial=math.inf)))
        for falls, share in zip(table, seen, strict=True)
    ]


def level_supports(rests: Mapping[str, Rest], reach_m: float) -> dict[str, Support] | None:
    """The same for a thing with one level base face, from how it lies on what is level below; None where that depends
    on which part of the base face sees what."""
    first = min(rest.fall_m for rest in rests.values())
    found = {}
    for name, (fall_m, *_) in rests.items():
        share = weight(fall_m, reach_m) * weight(fall_m - first, TOUCH_M)
        if share > 0 and weight(fall_m - first, _HIDDEN_M) < 1:
            if not any(rest.wholly and rest.fall_m == first for rest in rests.values()):
                return None
            share *= weight(fall_m - first, _HIDDEN_M)
        if share > 0:
            found[name] = Support(share, fall_m)
    return found


def hang_later_m(reach_m: float) -> float:
    """How much farther off than the nearest a second object may be to hold a hanging one as well [m]."""
    return max(TOUCH_M, _HANG_SHARE * reach_m)


def hangs(gaps_m: Mapping[str, float], reach_m: float) -> dict[str, float]:
    """Which of the larger things around hold what nothing supports, and how much of a contact each is (0..1)."""
    least = min(gaps_m.values(), default=math.inf)
    later_m = hang_later_m(reach_m)
    shares = {name: weight(gap, reach_m) * weight(gap - least, later_m) for name, gap in gaps_m.items()}
    return {name: share for name, share in shares.items() if share > 0}


def is_over(x: Body, y: Body) -> bool:
    """Whether x may rest on y; never true both ways.

    A thing on another lies over all of it, give or take `TOUCH_M`, or stands in it with a higher bottom, or with one as
    low where it is all in it, as in a room whose floor has no thickness. Things side by side on one floor are neither.
    """
    up = x.up_axis
    bottom_m, top_m, other_bottom_m, other_top_m = x.low[up], x.high[up], y.low[up], y.high[up]
    if bottom_m >= other_top_m - TOUCH_M or other_bottom_m >= top_m - TOUCH_M:
        return bottom_m + top_m > other_bottom_m + other_top_m
    if bottom_m > other_bottom_m + TOUCH_M:
        return True
    if bottom_m < other_bottom_m - TOUCH_M or top_m > other_top_m or x.size_m >= y.size_m:
        return False
    (a, b, c), (d, e, f), (g, h, i), (j, k, m) = x.low, x.high, y.low, y.high
    if up == 1:
        return a >= g and d <= j and c >= i and f <= m
    return a >= g and d <= j and b >= h and e <= k


def is_under(x: Body, top_m: float) -> bool:
    """Whether x is surely too far below an object that lies on something of that height to touch it."""
    return x.high[x.up_axis] < top_m - 3 * TOUCH_M
