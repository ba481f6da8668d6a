"""The glides of all things: each is kept while all that it relies on holds.

What comes to be so that it may glide has one drawn when it next moves: what it costs is not added to the frame in which
something is put down, and nothing is drawn for what then stays. So it is where only the surroundings have changed.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Set

from scene2hap.contact.drift import Drift
from scene2hap.contact.fat_boxes import AABB
from scene2hap.contact.glide import Glide

Draw = Callable[[], Glide | Drift]
"""Draws a glide from where all things are now."""


class Glides:
    """Glides and drifts, `of` each thing that is in one, by its id."""

    def __init__(self) -> None:
        self.of: dict[str, Glide | Drift] = {}
        self._draws: dict[str, Draw] = {}
        self._due: set[str] = set()
        # By host, in whose free regions they go on.
        self._guests: dict[str, set[str]] = {}

    def begin(self, x: str, draw: Draw) -> None:
        """One is in a glide from now on; draw it when it next moves, and again when that is due."""
        self.of.pop(x, None)
        self._draws[x] = draw
        self._due.add(x)

    def draw(self, names: Iterable[str]) -> None:
        """Draw those of these that are due, before anything moves."""
        due = self._due
        if not due:
            return
        for x in names:
            if x in due:
                due.discard(x)
                glide = self.of[x] = self._draws[x]()
                for host in glide.hosts:
                    self._guests.setdefault(host, set()).add(x)

    def stop(self, *names: str) -> None:
        """How these go on is not sure any more."""
        for x in names:
            if x in self._draws:
                del self._draws[x]
                self.of.pop(x, None)
                self._due.discard(x)

    def stop_in(self, hosts: Set[str]) -> None:
        """Nor for what goes on in the free regions of these."""
        if self._guests:
            for host in hosts & self._guests.keys():
                self.stop(*self._guests.pop(host))

    def look_out(self, names: Iterable[str], x: str, room: AABB, margin_m: float) -> None:
        """One may be anywhere in a box now, and matters to these, its neighbours, within a margin around it."""
        for z in names:
            glide = self.of.get(z)
            if glide is not None and glide.minds(x, room, margin_m):
                self._draw_anew(z)

    def look_away(self, names: Iterable[str], x: str) -> None:
        """One is a neighbour of these no more; if it goes altogether, nobody tells them."""
        for z in names:
            glide = self.of.get(z)
            if glide is not None and glide.reckons_with(x):
                self._draw_anew(z)

    def _draw_anew(self, x: str) -> None:
        del self.of[x]
        self._due.add(x)
