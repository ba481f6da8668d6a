"""Which sources can reach which objects at all: those that hang together over contacts."""

from __future__ import annotations

from collections.abc import Container, Iterable, Sequence
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from scene2hap.contact.junction import Pair
from scene2hap.scene.snapshot import Contact


class Reach:
    """The groups of objects that hang together, and the sources in each.

    Parameters: pairs : who touches whom, with whatever weight, since that may change; carriers : ids of all that may
    pass vibration on, sources included.
    """

    def __init__(self, pairs: Iterable[Pair], carriers: Container[str], source_ids: Sequence[str]) -> None:
        leader: dict[str, str] = {}

        def find(x: str) -> str:
            while (above := leader.setdefault(x, x)) != x:
                leader[x] = leader[above]
                x = above
            return x

        for a, b in pairs:
            if a in carriers and b in carriers:
                leader[find(a)] = find(b)
        self._group = {x: find(x) for x in leader}
        self._sources: dict[str, NDArray[np.bool_]] = {}
        for column, source_id in enumerate(source_ids):
            if source_id in self._group:
                reached = self._sources.setdefault(self._group[source_id], np.zeros(len(source_ids), dtype=np.bool_))
                reached[column] = True

    def sources(self, object_id: str) -> NDArray[np.bool_] | None:
        """Which sources (n_sources,) hang together with an object, itself included; None if none does."""
        return self._sources.get(self._group.get(object_id, ""))

    def any_of(self, object_ids: Iterable[str]) -> bool:
        """Whether a source reaches one of these over contacts."""
        return any(self._group.get(x, "") in self._sources for x in object_ids)

    def within(self, contacts: Iterable[Contact]) -> tuple[Contact, ...]:
        """The contacts of objects that a source reaches."""
        return tuple(contact for contact in contacts if self._group.get(contact.a, "") in self._sources)

    @cached_property
    def objects(self) -> frozenset[str]:
        """All that a source reaches over contacts, sources in contact included."""
        return frozenset(x for x, group in self._group.items() if group in self._sources)
