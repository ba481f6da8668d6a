"""A box in which an object may move, and what another has there."""

from __future__ import annotations

from typing import NamedTuple

from scene2hap.contact.ledge import Flat, Upright
from scene2hap.contact.vectors import AABB


class FreeRegion(NamedTuple):
    """A box (u, v, h) in a host's frame while `own` of its axes points up, and what of the host is there: nothing, or a
    ledge of height `top_m`, which covers the rectangle `ledge`, and what is no higher."""

    own: Upright
    room: AABB
    top_m: float | None
    ledge: Flat
