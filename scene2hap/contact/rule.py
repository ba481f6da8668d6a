"""The contact rule, with all of its tuned numbers: which objects hold an object where the scene's author left a gap.

In real scenes objects hover 0-60 mm above their supports, and objects that do not touch are a few millimetres apart. So
no single tolerance decides what touches. Surfaces nearer than `TOUCH_M` always touch. Beyond that, an object must be
held:

1. *Support.* The object is dropped. It is supported by the first object that its bottom meets within `fall_reach_m`,
   and by those that other parts of its bottom meet less than `TOUCH_M` later. A chair stands on the carpet's edge and
   on the floor; a cup stands on its saucer, not on the table below; a trash can on the carpet, not on the floor under
   it.
2. *Hanging.* An unsupported object hangs from the nearest larger objects within `hang_reach_m`: a picture from the
   wall, a lamp from the ceiling, a handle from its leaf, a cabinet from the wall and from the cabinet beside it.

An object with a hinge is held there alone: by its pivot, whatever else of the two objects is near.

All weights are smooth in the gaps and depend on the present poses alone.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping
from typing import NamedTuple

import numpy as np

from scene2hap.common.arrays import Floats
from scene2hap.contact.body import Body
from scene2hap.scene.hinges import HINGE_PLAY_M

TOUCH_M = 0.004
"""Gap at which any two surfaces cease to touch (tuned: cups on saucers stand 6 mm above the table)."""

# How much farther apart than its nearest points a contact patch may be (assumed): as a share of the tolerance, since
# the feet of a chair are never quite level; and as a share of the smaller object's size, since poses tremble. A tilt of
# 0.5 mrad lifts one end of a rail of 6 m by 3 mm.
_SLACK, _SLACK_SIZES = 0.25, 1e-3

CLEAR_M = 1e-4
"""Gap below which the vector between two surfaces has no reliable direction (assumed)."""

# Tuned on objects at rest in scenes made by others: a sofa hovers 57 mm, a chair of 0.45 m 45 mm, a tablet of 0.23 m
# 37 mm. Gaps up to 2/3 of the reach weigh 1, which includes these. Small objects, which hands lift, reach less far.
_FALL_REACH_M, _FALL_REACH_SIZES = 0.090, 0.25
# Tuned on the same scenes: a television of 1.5 m hangs 49 mm off its wall, a shelf board 12 mm, a handle of 0.16 m is
# 16 mm off its leaf. Shares from 0.05 to 0.18 give the same contacts in six scenes listed by hand; from 0.2 on, a
# picture hangs on a table.
HANG_REACH_M, _HANG_REACH_SIZES = 0.075, 0.15
# Even a short handle leaves space for fingers: gaps of up to 16 mm to its leaf weigh 1. The share of its size keeps the
# reach of a tiny object below its length, and below its fall reach.
_GRIP_REACH_M, _GRIP_REACH_SIZES = 0.024, 0.24
# A hanging object may have several holders: a wall cabinet hangs from the tall cabinet that it touches and from the
# wall 5 mm behind it. A holder may be farther than the nearest one by this share of the reach (tuned on the same six
# scenes; from 1/4 on, some pairs are wrong).
_HANG_SHARE = 1 / 6

_HIDDEN_M = 0.002  # A surface this much below another is hidden by it (assumed: the thinnest carpet).


# Play on either side at which an object ceases to be enclosed [m]: upper bound, and share of its diagonal. Up to 2/3 of
# it weighs 1. This includes 12.7 mm (and up to 0.8 mm more) beside drawers on ball-bearing rails, which models often
# lack. It includes 5 mm beside drawers on rails below them, 1-3 mm on wooden runners, and 2-4 mm around leaves and
# fronts. The smallest drawers on ball-bearing rails have diagonals of 0.4 m; smaller objects have less play.
_PLAY_M, _PLAY_SIZES = 0.0203, 0.05

SIDE_SHARE = 1 / 6
"""Share of a side that must be within the play: a wooden runner, 30-45 mm high, beside a drawer of up to 0.25 m."""

OUTSIDE_SHARE = 0.5
"""Share of its box outside the other's at which an object ceases to be enclosed."""


def weight(gap_m: float, tolerance_m: float) -> float:
    """Return the weight of a gap: 1 up to 2/3 of the tolerance, then half a cosine down to 0 at the tolerance.

    At tolerance 0, only a gap of 0 or less has weight 1.
    """
    if tolerance_m == 0.0:
        return 1.0 if gap_m <= 0.0 else 0.0
    x = 3 * gap_m / tolerance_m - 2
    return 1.0 if x <= 0 else 0.0 if x >= 1 else 0.5 * (1 + math.cos(math.pi * x))


def slack_m(size_m: float, tolerance_m: float = TOUCH_M) -> float:
    """Return how much farther apart than its nearest points a contact patch may be [m], at most the tolerance.

    Parameters: size_m : the diagonal of the smaller object; tolerance_m : gap at which two surfaces cease to touch.
    """
    return min(max(_SLACK * tolerance_m, _SLACK_SIZES * size_m), tolerance_m)


def fall_reach_m(size_m: float) -> float:
    """Return how far an object with this diagonal may hover above its support [m]."""
    return min(_FALL_REACH_M, _FALL_REACH_SIZES * size_m)


def hang_reach_m(size_m: float) -> float:
    """Return how far an object with this diagonal may be from its holder when it hangs [m]; below its fall reach."""
    return min(HANG_REACH_M, max(_HANG_REACH_SIZES * size_m, min(_GRIP_REACH_M, _GRIP_REACH_SIZES * size_m)))


def play_reach_m(size_m: float) -> float:
    """Return the play on either side with which an object of this diagonal may be enclosed [m]."""
    return min(_PLAY_M, _PLAY_SIZES * size_m)


def margins_m(body: Body) -> tuple[float, float]:
    """Return the distance within which a body may touch or hang, and how much farther down it may fall [m]."""
    touch_m = TOUCH_M if body.hinge is None else HINGE_PLAY_M
    return max(touch_m, hang_reach_m(body.size_m)), fall_reach_m(body.size_m)


class Support(NamedTuple):
    """The weight of a support, 0..1, and the fall distance to it [m]."""

    weight: float
    fall_m: float


def supports(falls_m: Mapping[str, Floats], reach_m: float) -> dict[str, Support]:
    """Return the support weight of each object below, and the least fall distance to a part of it that bears.

    Parameters: falls_m : for each object, the fall distance of each triangle (m,) onto it [m], inf where it meets
    nothing.
    """
    if not falls_m:
        return {}
    falls = np.stack(list(falls_m.values()))
    first = falls.min(axis=0)
    least = first.min(initial=math.inf)
    # The others, some of them infinite, bear nothing.
    bears = first < least + TOUCH_M
    falls, first = falls[:, bears], first[bears]
    shares = _weights(falls, reach_m) * _weights(falls - least, TOUCH_M) * _weights(falls - first, _HIDDEN_M)
    most = shares.max(axis=1, initial=0.0).tolist()
    nearest = np.where(shares > 0, falls, math.inf).min(axis=1, initial=math.inf).tolist()
    found = zip(falls_m, map(Support, most, nearest), strict=True)
    return {name: support for name, support in found if support.weight > 0}


def _weights(gaps_m: Floats, tolerance_m: float) -> Floats:
    """Return the `weight` of each gap, for a tolerance above 0."""
    return 0.5 * (1 + np.cos(math.pi * np.minimum(np.maximum(3 * gaps_m / tolerance_m - 2, 0.0), 1.0)))


def supports_of_faces(
    falls_m: Mapping[str, float], reach_m: float, whole: Collection[str] = ()
) -> dict[str, Support] | None:
    """Return the support weight of each object below, as `supports`, from the least fall distance to each [m].

    None where one object may hide only parts of another, since only triangles can show this.

    Parameters: whole : the objects with a level face under the whole base face, which hide all below.
    """
    least_m = min(falls_m.values(), default=math.inf)
    hides_all = any(falls_m[name] == least_m for name in whole)
    found = {}
    for name, fall_m in falls_m.items():
        share = weight(fall_m, reach_m) * weight(fall_m - least_m, TOUCH_M)
        seen = weight(fall_m - least_m, _HIDDEN_M)
        if share > 0 and seen < 1 and not hides_all:
            return None
        if share * seen > 0:
            found[name] = Support(share * seen, fall_m)
    return found


def hang_later_m(reach_m: float) -> float:
    """Return how much farther than the nearest holder another holder of a hanging object may be [m]."""
    return max(TOUCH_M, _HANG_SHARE * reach_m)


def hangs(gaps_m: Mapping[str, float], reach_m: float) -> dict[str, float]:
    """Return the weight (0..1) of each larger object that holds an unsupported one, from their gaps [m]."""
    least = min(gaps_m.values(), default=math.inf)
    later_m = hang_later_m(reach_m)
    shares = {name: weight(gap, reach_m) * weight(gap - least, later_m) for name, gap in gaps_m.items()}
    return {name: share for name, share in shares.items() if share > 0}


def is_over(x: Body, y: Body) -> bool:
    """Return True if x, of two bodies the upper one, may rest on the other, by their AABBs."""
    up, v = x.up_axis, x.v_axis
    (a, b), (c, d) = (x.low, x.high), (y.low, y.high)
    overlap = a[0] < d[0] and c[0] < b[0] and a[v] < d[v] and c[v] < b[v]
    return overlap and a[up] - d[up] <= fall_reach_m(x.size_m)


def upper_of(x: Body, y: Body) -> Body | None:
    """Return the one of two bodies that may rest on the other, by their AABBs; None if neither may.

    It is wholly above the other, give or take `TOUCH_M`; or its bottom is higher than that of the other; or its bottom
    is about as low and it is wholly inside the other, as in a room whose floor has no thickness. Two objects side by
    side on a floor are none of these.
    """
    up, v = x.up_axis, x.v_axis
    bottom_m, top_m, other_bottom_m, other_top_m = x.low[up], x.high[up], y.low[up], y.high[up]
    if bottom_m >= other_top_m - TOUCH_M or other_bottom_m >= top_m - TOUCH_M:
        above_m, other_above_m = bottom_m + top_m, other_bottom_m + other_top_m
        return x if above_m > other_above_m else y if above_m < other_above_m else None
    if bottom_m > other_bottom_m + TOUCH_M:
        return x
    if other_bottom_m > bottom_m + TOUCH_M:
        return y
    small, large = (x, y) if x.size_m < y.size_m else (y, x)
    (a, b), (c, d) = (small.low, small.high), (large.low, large.high)
    is_inside = b[up] <= d[up] and a[0] >= c[0] and b[0] <= d[0] and a[v] >= c[v] and b[v] <= d[v]
    return small if is_inside and x.size_m != y.size_m else None
