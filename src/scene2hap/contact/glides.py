"""The glides of all things: each is kept while all that it relies on holds."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Set

from scene2hap.contact.glide import Drift, Glide


class Glides:
    """Glides and drifts, `of` each thing that is in one, by its id.

    Parameters: near : the neighbours of each body.
    """

    def __init__(self, near: Mapping[str, Collection[str]]) -> None:
        self._near = near
        self.of: dict[str, Glide | Drift] = {}
        # By host, in whose clearings they go on.
        self._guests: dict[str, set[str]] = {}

    def keep(self, glide: Glide | Drift) -> None:
        """Go on in a glide."""
        self.of[glide.body.id] = glide
        for host in glide.hosts:
            self._guests.setdefault(host, set()).add(glide.body.id)

    def stop(self, *names: str) -> None:
        """How these go on is not sure any more."""
        for x in names:
            self.of.pop(x, None)

    def stop_around(self, x: str) -> None:
        """Nor is it for one and its neighbours."""
        self.stop(x, *self._near[x])

    def stop_in(self, hosts: Set[str]) -> None:
        """Nor for what goes on in the clearings of these."""
        if self._guests:
            for host in hosts & self._guests.keys():
                self.stop(*self._guests.pop(host))
