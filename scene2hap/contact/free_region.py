"""Free regions: boxes in a concave host's frame that hold nothing of the host, or one ledge of it."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from typing import NamedTuple

from scene2hap.contact.geometry.vectors import AABB
from scene2hap.contact.ledge import Flat, Upright

_MOST_REGIONS = 64
_MOST_GUESTS = 256


class FreeRegion(NamedTuple):
    """A `box` (u, v, h) in a host's frame, valid while the host's axis `own` points up.

    The host has nothing in it if `top_m` is None. Else it has a ledge at height `top_m` [m], which covers the rectangle
    `ledge`, and nothing above that height.
    """

    own: Upright
    box: AABB
    top_m: float | None
    ledge: Flat

    def holds(self, taken: AABB) -> bool:
        """Return True if the region contains a box."""
        ((a, b, c), (d, e, f)), ((u0, v0, h0), (u1, v1, h1)) = self.box, taken
        return u0 >= a and v0 >= b and h0 >= c and u1 <= d and v1 <= e and h1 <= f

    def bears(self, foot: Flat) -> bool:
        """Return True if the ledge covers a rectangle."""
        u0, v0, u1, v1 = self.ledge
        return foot[0] >= u0 and foot[1] >= v0 and foot[2] <= u1 and foot[3] <= v1


class FreeRegions:
    """The latest free regions of a host. They depend on the host alone, so that a guest can use another guest's."""

    __slots__ = ("_latest", "_of_guests")

    def __init__(self) -> None:
        self._latest: deque[FreeRegion] = deque(maxlen=_MOST_REGIONS)
        self._of_guests: dict[str, FreeRegion] = {}

    def find(self, guest_id: str, serves: Callable[[FreeRegion], bool]) -> FreeRegion | None:
        """Return a region for which `serves` is True, the guest's last one first, and store it as the guest's."""
        known = self._of_guests.get(guest_id)
        if known is not None and serves(known):
            return known
        for known in self._latest:
            if serves(known):
                self._note(guest_id, known)
                return known
        return None

    def keep(self, guest_id: str, region: FreeRegion) -> None:
        """Add a region that was computed for a guest."""
        self._latest.appendleft(region)
        self._note(guest_id, region)

    def _note(self, guest_id: str, region: FreeRegion) -> None:
        if len(self._of_guests) >= _MOST_GUESTS:
            # Removed guests are not reported, so all are cleared. This costs each of the others one search.
            self._of_guests.clear()
        self._of_guests[guest_id] = region
