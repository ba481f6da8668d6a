"""The glides of all things: each is kept while all that it relies on holds.

What comes to be so that it may glide has one drawn when it next moves: what it costs is not added to the frame in which
something is put down, and nothing is drawn for what then stays. So it is where only the surroundings have changed.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping, Set

from scene2hap.contact.glide import Drift, Glide
from scene2hap.contact.zones import Room

Draw = Callable[[], Glide | Drift | None]
"""Draws a glide from where all things are now; None where it is not sure how that would go on."""


class Glides:
    """Glides and drifts, `of` each thing that is in one, by its id.

    Parameters: near : the neighbours of each body.
    """

    def __init__(self, near: Mapping[str, Collection[str]]) -> None:
        self._near = near
        self.of: dict[str, Glide | Drift] = {}
        self._draws: dict[str, Draw] = {}
        self._due: set[str] = set()
        # By host, in whose clearings they go on.
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
                glide = self._draws[x]()
                if glide is not None:
                    self.of[x] = glide
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
        """Nor for what goes on in the clearings of these."""
        if self._guests:
            for host in hosts & self._guests.keys():
                self.stop(*self._guests.pop(host))

    def stop_amid(self, x: str) -> None:
        """Nor is it for one amid others, and what these look out for has changed."""
        self.stop(x)
        self.look_anew(self._near[x])

    def look_anew(self, names: Iterable[str]) -> None:
        """What is around these has changed, but nothing of what they touch."""
        for x in names:
            if x in self._draws:
                self.of.pop(x, None)
                self._due.add(x)

    def look_out(self, names: Iterable[str], room: Room) -> None:
        """A neighbour of these may be elsewhere now: anywhere in a box."""
        for x in names:
            glide = self.of.get(x)
            if glide is not None and glide.minds(room):
                del self.of[x]
                self._due.add(x)
