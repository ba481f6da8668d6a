"""Enclosed objects, which fit into another with play: a drawer in its carcass, a door leaf in its frame, a battery in
its slot.

The smaller of two bodies is enclosed if most of its box is inside the other's box, and if the other's surface is near
on two opposite sides of it. The distance is measured along a grid of outward rays. The play of a side is the distance
that a given share of its rays do not exceed, so that a single corner does not decide.

A sofa at a wall is near the wall on one side only. A book between two others is near each of them on one side only.
Neither is enclosed.
"""

from __future__ import annotations

import math

import numpy as np

from scene2hap.common.arrays import Floats
from scene2hap.contact.body import Body, box_in_frame, roles
from scene2hap.contact.geometry.triangle_tree import ALL, meeting
from scene2hap.contact.geometry.triangles import first_hits
from scene2hap.contact.geometry.vectors import Triple
from scene2hap.contact.rule import OUTSIDE_SHARE, SIDE_SHARE, play_reach_m, weight


def enclosed(a: Body, b: Body) -> tuple[float, float]:
    """Return the weight (0..1) of the contact by which one body encloses the other, and the play [m]."""
    guest, host = roles(a, b)
    # A box that is more than half inside another has its middle inside, too.
    (x, y, z), (u, v, w) = host.low, host.high
    p, q, r = guest.middle_m
    if not (x <= p <= u and y <= q <= v and z <= r <= w):
        return 0.0, math.inf
    middle, half = box_in_frame(guest, host)
    within = weight(1.0 - _inside(host, middle, half, 1e-9 * guest.size_m), OUTSIDE_SHARE)
    reach_m = play_reach_m(guest.size_m)
    if within <= 0:
        return 0.0, math.inf
    if not _has_sides(host, middle, half, reach_m):
        return 0.0, math.inf
    play_m = _play_m(guest, host, reach_m)
    return within * weight(play_m, reach_m), play_m


def _inside(host: Body, middle: Triple, half: Triple, least_m: float) -> float:
    """Return the share of a box that is inside the host's; `least_m` is added to edges, for sheets of no thickness."""
    share = 1.0
    for c, h, a, b in zip(middle, half, host.shape.middle, host.shape.half, strict=True):
        common = min(a + b, c + h) - max(a - b, c - h)
        share *= max(common + least_m, 0.0) / (2 * h + least_m)
    return share


def _has_sides(host: Body, middle: Triple, half: Triple, reach_m: float) -> bool:
    """Return True if a host may have triangles near two opposite sides of a box.

    This skips the rays for most objects in a room, since these are far from its walls. It also skips objects near a
    single part of the host, such as the leg of a table.
    """
    (x, y, z), (u, v, w) = middle, half
    low, high = (x - u, y - v, z - w), (x + u, y + v, z + w)
    (a, b, c), (d, e, f) = low, high
    around = (a - reach_m, b - reach_m, c - reach_m), (d + reach_m, e + reach_m, f + reach_m)
    near = meeting(host.shape.tree, *around, ALL)
    if not len(near):
        return False
    hull = host.shape.boxes.some(near).hull()
    return not ((hull.low[:, 0] > high) | (hull.high[:, 0] < low)).any()


def _play_m(guest: Body, host: Body, reach_m: float) -> float:
    """Return the play [m] of the guest: the least over the axes of the larger play of two opposite sides."""
    turn = host.pose.rotation.T @ guest.pose.rotation
    shift = host.pose.to_own(np.asarray(guest.position_m))
    points = guest.shape.sides.reshape(-1, 3)
    n = len(points) // 6
    seen = np.flatnonzero(~np.isnan(points[:, 0]))
    outwards = np.concatenate([-np.eye(3), np.eye(3)])[seen // n]
    plays = np.full(len(points), np.inf)
    start, way = turn @ points[seen].T + shift[:, None], reach_m * turn @ outwards.T
    plays[seen] = reach_m * first_hits(start, way, host.shape.triangles, host.shape.boxes)
    side_plays: Floats = np.sort(plays.reshape(6, n), axis=1)[:, int(SIDE_SHARE * n)]
    return float(np.maximum(side_plays[:3], side_plays[3:]).min())
