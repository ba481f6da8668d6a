"""Boxes in which things may move, and how far they are from each other."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from scene2hap.contact.body import Body
from scene2hap.contact.fat_boxes import AABB


class Neighbour(NamedTuple):
    """One near a body, where it may move, and how far it may hang from the body [m], 0 if not at all."""

    body: Body
    room: AABB
    hang_m: float


def common(rooms: Sequence[AABB]) -> AABB:
    """What of the world lies in all of these boxes, which need not meet."""
    (a, b, c), (d, e, f) = rooms[0]
    for (g, h, i), (j, k, m) in rooms[1:]:
        a, b, c, d, e, f = max(a, g), max(b, h), max(c, i), min(d, j), min(e, k), min(f, m)
    return (a, b, c), (d, e, f)


def under(room: AABB, margin_m: float, up: int) -> AABB:
    """Where anything is surely farther under a box than that."""
    high = [math.inf] * 3
    high[up] = room[0][up] - 1.001 * margin_m
    return (-math.inf, -math.inf, -math.inf), (high[0], high[1], high[2])


def sideways_m(body: Body, room: AABB) -> tuple[float, float, float, float]:
    """How far a box is beyond a body, level: towards greater u, less u, greater v, less v."""
    flat, (low, high), near, far = body.v_axis, room, body.low, body.high
    return (low[0] - far[0], near[0] - high[0], low[flat] - far[flat], near[flat] - high[flat])


def gaps_m(body: Body, room: AABB) -> list[float]:
    """How far a box is beyond a body: towards greater and then towards less x, y, z."""
    (low, high), near, far = room, body.low, body.high
    return [low[k] - far[k] for k in range(3)] + [near[k] - high[k] for k in range(3)]
