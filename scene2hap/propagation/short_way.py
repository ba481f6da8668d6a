"""Ways over one or two contacts, put together from their junctions when asked for.

What a junction that did not move contributes is kept: a junction that moved is another object.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING

from scene2hap.compiled import compiled
from scene2hap.propagation.entries import Entries, Triple, least_cost, nearest_m

if TYPE_CHECKING:
    from scene2hap.contact.junction import Junction, Pair

_NOTHING: dict[str, Junction] = {}


class ShortWay:
    """A way from a source into an object by its first junction `out[via]`, and, if it goes through another object, by
    its second `into[via]`.

    Parameters: price_via_per_m : what a metre through that other object costs, None if the way goes through none;
    crossing : what a contact of each weight costs. `entries` is where it comes in, as last told.
    """

    __slots__ = ("_crossing", "_first", "_least", "_price_via_per_m", "_second", "entries", "into", "out", "via")

    def __init__(
        self,
        via: str,
        out: Mapping[str, Junction],
        into: Mapping[str, Junction],
        price_via_per_m: float | None,
        crossing: Mapping[float, float],
    ) -> None:
        self.via, self.out, self.into = via, out, into
        self._price_via_per_m, self._crossing = price_via_per_m, crossing
        self._first: Junction | None = None
        self._second: Junction | None = None
        self._least = 0.0
        self.entries: Entries = []

    def least_cost(self, price_per_m: float, point_m: Triple, limit: float, known: float) -> float:
        """What it costs to come to a point of the object now, if that is less than what is known, and within a limit;
        else what is known."""
        first, second = self.out[self.via], None if self._price_via_per_m is None else self.into[self.via]
        if self._first is not first or self._second is not second:
            # From where it enters alone it may be too far, whatever way led there.
            if second is not None and price_per_m * nearest_m(second.points_m, point_m) > limit:
                return known
            self._tell(first, second)
        if self._least >= known or self._least > limit:
            return known
        return min(known, least_cost(self.entries, price_per_m, point_m))

    def _tell(self, first: Junction, second: Junction | None) -> None:
        crossing = self._crossing
        entries = [(place, crossing[weight]) for place, weight in zip(first.points_m, first.weights, strict=True)]
        if second is not None and self._price_via_per_m is not None:
            entries = [
                (there, crossing[weight] + least_cost(entries, self._price_via_per_m, there))
                for there, weight in zip(second.points_m, second.weights, strict=True)
            ]
        self._first, self._second, self.entries = first, second, entries
        self._least = min([cost for _, cost in entries])


@compiled
class WaysInto:
    """All ways of at most two contacts into an object.

    Parameters: rows : of the sources by their ids; beside : what each object touches, changed by its owner;
    price_per_m : what a metre through an object costs, no entry where it carries nothing on; crossing : what a contact
    of each weight costs; is_through : whether ways may go through another object.
    """

    def __init__(
        self,
        object_id: str,
        rows: Mapping[str, int],
        beside: Mapping[str, Mapping[str, Junction]],
        price_per_m: Mapping[str, float],
        crossing: Mapping[float, float],
        *,
        is_through: bool,
    ) -> None:
        self._object_id, self._rows, self._beside, self._is_through = object_id, rows, beside, is_through
        self._price_per_m, self._crossing = price_per_m, crossing
        self._by_row: list[list[ShortWay]] = [[] for _ in rows]
        self.follow(None)

    def follow(self, turned: Iterable[Pair] | None) -> None:
        """Take in that these pairs have come to touch or ceased to; None : that any may have.

        Other ways than before may lead from a source whose contact that is, and from those beside what has come to the
        object or gone from it.
        """
        own, object_id, beside = self._rows, self._object_id, self._beside
        if turned is None:
            stale = set(own)
        else:
            stale = {x for pair in turned for x in pair if x in own}
            for a, b in turned:
                if object_id in (a, b):
                    via = b if a == object_id else a
                    stale.update([x for x in own if via in beside.get(x, _NOTHING)])
        for x in stale - {object_id}:
            self._by_row[own[x]] = self._found_from(x)

    def _found_from(self, source_id: str) -> list[ShortWay]:
        """The ways from a source, the same as those known where they still are."""
        object_id, price_per_m, crossing = self._object_id, self._price_per_m, self._crossing
        out, into = self._beside.get(source_id, _NOTHING), self._beside.get(object_id, _NOTHING)
        vias = [object_id] if object_id in out else []
        if self._is_through:
            fewer, more = (out, into) if len(out) <= len(into) else (into, out)
            vias += [via for via in fewer if via in more and via in price_per_m]
        before = {way.via: way for way in self._by_row[self._rows[source_id]]}
        return [
            before[via]
            if via in before
            else ShortWay(via, out, into, None if via == object_id else price_per_m[via], crossing)
            for via in vias
        ]

    def lower(self, found: list[float], point_m: Triple, limits: Sequence[float] | None) -> None:
        """Take in, for each source, what is cheaper to a point of the object; those that surely cost more than their
        limit are left out."""
        price = self._price_per_m[self._object_id]
        for row, ways in enumerate(self._by_row):
            limit = math.inf if limits is None else limits[row]
            for way in ways:
                found[row] = way.least_cost(price, point_m, limit, found[row])
