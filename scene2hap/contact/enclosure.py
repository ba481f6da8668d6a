"""What is built into another with play: a drawer in its carcass, a door leaf in its frame, a battery in its slot.

The smaller of two is enclosed if most of it is inside the other's box, and if on two opposite sides of its own box it
sees the other's surface near, outwards from its own. It is seen along a grid of rays, so that the play of a side is
what a share of the side has at most, and not what a single corner has.

A sofa along a wall is near it on one side; a book between others and a cup between two walls are near two things on one
side each.
"""

from __future__ import annotations

import math

import numpy as np

from scene2hap.contact.body import Body
from scene2hap.contact.broad import Boxes
from scene2hap.contact.rays import first_hits
from scene2hap.contact.relative import box_in_frame, middle_m, roles
from scene2hap.contact.support import weight
from scene2hap.contact.vectors import Floats, Triple

# Play on either side at which a thing ceases to be enclosed [m], at most and as a share of its diagonal. Up to 2/3 of
# it a thing is to weigh 1, as gaps do everywhere: 12.7 mm (and up to 0.8 mm more) beside drawers on ball-bearing rails,
# which models often lack, 5 mm beside those on rails below them, 1-3 mm on wooden runners, 2-4 mm around leaves and
# fronts. The smallest drawers on such rails have diagonals of 0.4 m; small things have little play in what is made for
# them.
_PLAY_M, _PLAY_SIZES = 0.0203, 0.05

_SIDE_SHARE = 1 / 6
"""So much of a side is to have the play: a wooden runner, some 30-45 mm high, beside a drawer of up to 0.25 m."""

_OUTSIDE = 0.5
"""Share of its box outside the other's at which a thing ceases to be enclosed."""


def play_reach_m(size_m: float) -> float:
    """With how much play on either side a thing of that diagonal may be enclosed [m]."""
    return min(_PLAY_M, _PLAY_SIZES * size_m)


def enclosed(a: Body, b: Body) -> tuple[float, float]:
    """How much of a contact it is that one of two is enclosed by the other (0..1), and the greater play [m]."""
    guest, host = roles(a, b)
    # Of what lies by more than half in the other's box, so does the middle.
    (x, y, z), (u, v, w) = host.low, host.high
    p, q, r = middle_m(guest)
    if not (x <= p <= u and y <= q <= v and z <= r <= w):
        return 0.0, math.inf
    middle, half = box_in_frame(guest, host)
    within = weight(1.0 - _inside(host, middle, half, 1e-9 * guest.size_m), _OUTSIDE)
    reach_m = play_reach_m(guest.size_m)
    if within <= 0:
        return 0.0, math.inf
    # Most of what is in a room is far from its walls.
    low, high = ([[c + sign * (h + reach_m)] for c, h in zip(middle, half, strict=True)] for sign in (-1, 1))
    if not len(host.shape.boxes.meeting(Boxes(np.array(low), np.array(high)))):
        return 0.0, math.inf
    play_m = _play_m(guest, host, reach_m)
    return within * weight(play_m, reach_m), play_m


def _inside(host: Body, middle: Triple, half: Triple, least_m: float) -> float:
    """The share of a box that is in the host's; a sheet has no thickness to be outside with."""
    share = 1.0
    for c, h, a, b in zip(middle, half, host.shape.middle, host.shape.half, strict=True):
        common = min(a + b, c + h) - max(a - b, c - h)
        share *= max(common + least_m, 0.0) / (2 * h + least_m)
    return min(share, 1.0)


def _play_m(guest: Body, host: Body, reach_m: float) -> float:
    """The least play with which the guest is held between two opposite sides."""
    turn = host.pose.rotation.T @ guest.pose.rotation
    shift = host.pose.to_own(np.asarray(guest.position_m))
    points = guest.shape.sides.reshape(-1, 3)
    n = len(points) // 6
    seen = np.flatnonzero(~np.isnan(points[:, 0]))
    outwards = np.concatenate([-np.eye(3), np.eye(3)])[seen // n]
    plays = np.full(len(points), np.inf)
    start, way = turn @ points[seen].T + shift[:, None], reach_m * turn @ outwards.T
    plays[seen] = reach_m * first_hits(start, way, host.shape.triangles, host.shape.boxes)
    side_plays: Floats = np.sort(plays.reshape(6, n), axis=1)[:, int(_SIDE_SHARE * n)]
    return float(np.maximum(side_plays[:3], side_plays[3:]).min())
