"""What holds a thing up, where the scene's author left a gap.

In real scenes things that rest hover 0-45 mm above what they rest on, and things that do not touch are a few
millimetres apart, so that no single tolerance tells contact. Surfaces nearer than `TOUCH_M` touch, whatever they are.
Beyond that a thing must be held:

1. *Support.* Let it fall. What its bottom meets first within `fall_reach_m` supports it, and whatever it would meet
   less than `TOUCH_M` later: a chair stands on the carpet's edge and on the floor, a cup on the saucer and not on the
   table below.
2. *Hanging.* What nothing supports hangs from the nearest larger things within `hang_reach_m`: a picture from the wall,
   a lamp from the ceiling.

All weights are smooth in the gaps and know nothing of the past: the poses alone decide.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from scene2hap.contact.narrow import Body, Meeting
from scene2hap.contact.triangles import Floats, height_range

TOUCH_M = 0.004
"""Gap at which any two surfaces cease to touch (tuned: half of what separates cups from the table below a saucer)."""

# Tuned on gaps of resting things in scenes made by others: a chair of 0.45 m hovers 45 mm and a tablet of 0.23 m 37 mm,
# and these are to weigh 1, which they do up to 2/3 of the reach.
_FALL_REACH_M, _FALL_REACH_SIZES = 0.070, 0.25
# Assumed: lamps and pictures stand 0-20 mm off their walls.
_HANG_REACH_M, _HANG_REACH_SIZES = 0.030, 0.10

# A thing can only rest on what reaches lower by at least this: of two boxes side by side neither holds the other.
_LOWER_M = 1e-5
# Triangles are tried a little smaller, so that things exactly side by side do not stand on each other's rims.
_INSET, _INSET_M = 1e-4, 1e-4
# A surface that a falling thing already cuts holds it if it is no steeper than 60 degrees; a wall does not.
_FLAT = 0.5


def weight(gap_m: float, tolerance_m: float) -> float:
    """How much of a contact a gap leaves: 1 up to 2/3 of the tolerance, then half a cosine down to 0 at the tolerance.

    At tolerance 0 only a gap of 0 counts.
    """
    if tolerance_m == 0.0:
        return 1.0 if gap_m <= 0.0 else 0.0
    x = min(max(3 * gap_m / tolerance_m - 2, 0.0), 1.0)
    return 0.5 * (1 + math.cos(math.pi * x)) if x < 1.0 else 0.0


def fall_reach_m(size_m: float) -> float:
    """How far a thing of that diagonal may hover over its support [m]."""
    return min(_FALL_REACH_M, _FALL_REACH_SIZES * size_m)


def hang_reach_m(size_m: float) -> float:
    """How far a thing of that diagonal may stand off what it hangs from [m]; less than its `fall_reach_m`."""
    return min(_HANG_REACH_M, _HANG_REACH_SIZES * size_m)


def fall(meeting: Meeting, faller: Body, up_axis: int) -> float:
    """How far the bottom of `faller`, one of the two that meet, may fall before it meets the other [m].

    Down to -`TOUCH_M` where it is sunk in a little, 0 where it is deeper in a surface that can hold it; inf where there
    is nothing within its reach, or where the other does not reach lower. The bottom is all within `fall_reach_m` of the
    lowest point.
    """
    other = meeting.b if faller is meeting.a else meeting.a
    reach = fall_reach_m(faller.size_m)
    lowest = faller.box.low[0, up_axis]
    if lowest <= other.box.low[0, up_axis] + _LOWER_M:
        return math.inf
    heights = faller.shape.triangles @ faller.pose.rotation[up_axis] + faller.pose.position_m[up_axis]
    bottom = np.flatnonzero(heights.min(axis=1) <= lowest + reach)

    up = meeting.host.pose.rotation[up_axis]
    is_guest = faller is meeting.guest
    way = (-reach if is_guest else reach) * up
    guest_rows, host_rows = (bottom, None) if is_guest else (None, bottom)
    least = math.inf
    for guest, host in meeting.near(TOUCH_M, way, sweep=True, guest_rows=guest_rows, host_rows=host_rows):
        p, q = (guest, host) if is_guest else (host, guest)
        low, high = height_range(_inset(p), q, up)
        shallow = low >= -TOUCH_M
        holds = shallow | ((high >= -TOUCH_M) & _flat(q, up))
        least = min(least, float(np.where(shallow, low, 0.0)[holds].min(initial=math.inf)))
    return least if least <= reach else math.inf


def supports(falls_m: Mapping[str, float], reach_m: float) -> dict[str, float]:
    """Which of the things below hold, and how much of a contact each is (0..1), from how far it is to fall to each."""
    return _nearest(falls_m, reach_m)


def hangs(gaps_m: Mapping[str, float], reach_m: float, supported: float) -> dict[str, float]:
    """Which of the larger things around hold what is `supported` only so much (0..1), from the gap to each."""
    return {name: (1 - supported) * share for name, share in _nearest(gaps_m, reach_m).items() if supported < 1}


def _nearest(gaps_m: Mapping[str, float], reach_m: float) -> dict[str, float]:
    least = min(gaps_m.values(), default=math.inf)
    if least > reach_m:
        return {}
    shares = {name: weight(gap, reach_m) * weight(gap - least, TOUCH_M) for name, gap in gaps_m.items()}
    return {name: share for name, share in shares.items() if share > 0}


def _inset(triangles: Floats) -> Floats:
    inwards = triangles.mean(axis=1, keepdims=True) - triangles
    extent = np.abs(inwards).max(axis=(1, 2), keepdims=True)
    inset: Floats = triangles + inwards * np.minimum(_INSET, _INSET_M / np.maximum(extent, _INSET_M))
    return inset


def _flat(triangles: Floats, up: Floats) -> NDArray[np.bool_]:
    normal = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    flat: NDArray[np.bool_] = np.abs(normal @ up) >= _FLAT * np.linalg.norm(normal, axis=1)
    return flat
