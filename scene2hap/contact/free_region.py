"""Boxes in which objects may move, and what another has there."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from typing import NamedTuple

from scene2hap.contact.ledge import Flat, Upright
from scene2hap.contact.vectors import AABB

_MOST_REGIONS = 64
_MOST_GUESTS = 256


class FreeRegion(NamedTuple):
    """A box (u, v, h) in a host's frame while `own` of its axes points up, and what of the host is there: nothing, or a
    ledge of height `top_m`, which covers the rectangle `ledge`, and what is no higher."""

    own: Upright
    room: AABB
    top_m: float | None
    ledge: Flat

    def holds(self, taken: AABB) -> bool:
        """Whether a box is in it."""
        ((a, b, c), (d, e, f)), ((u0, v0, h0), (u1, v1, h1)) = self.room, taken
        return u0 >= a and v0 >= b and h0 >= c and u1 <= d and v1 <= e and h1 <= f

    def bears(self, foot: Flat) -> bool:
        """Whether its ledge covers a rectangle."""
        u0, v0, u1, v1 = self.ledge
        return foot[0] >= u0 and foot[1] >= v0 and foot[2] <= u1 and foot[3] <= v1


class FreeRegions:
    """The latest free regions of a host. They depend on the host alone, so that one drawn for a guest serves others."""

    __slots__ = ("_latest", "_of_guests")

    def __init__(self) -> None:
        self._latest: deque[FreeRegion] = deque(maxlen=_MOST_REGIONS)
        self._of_guests: dict[str, FreeRegion] = {}

    def of(self, guest_id: str) -> FreeRegion | None:
        """The region that a guest was in last."""
        return self._of_guests.get(guest_id)

    def find(self, guest_id: str, serves: Callable[[FreeRegion], bool]) -> FreeRegion | None:
        """A region that serves a guest, which is in it from now on."""
        known = self._of_guests.get(guest_id)
        if known is not None and serves(known):
            return known
        for known in self._latest:
            if serves(known):
                self._note(guest_id, known)
                return known
        return None

    def keep(self, guest_id: str, region: FreeRegion) -> None:
        """Keep a region that was drawn for a guest."""
        self._latest.appendleft(region)
        self._note(guest_id, region)

    def _note(self, guest_id: str, region: FreeRegion) -> None:
        if len(self._of_guests) >= _MOST_GUESTS:
            # Nobody reports guests that left; those that stay find their regions again.
            self._of_guests.clear()
        self._of_guests[guest_id] = region
