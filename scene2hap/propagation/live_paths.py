"""Cheapest paths over a contact graph that changes between queries."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from typing import TYPE_CHECKING

from scene2hap.contact.junction import Junction
from scene2hap.propagation.contact_paths import ContactPaths, Triple

if TYPE_CHECKING:
    from scene2hap.contact.graph import ContactGraph

_MOST_WEIGHTS = 1024

_POINT = "\0point"
"""Stands for a source that is a point of some object, and that the network has only during a query."""


class _CrossingCosts(dict[float, float]):
    """Cost of crossing a contact by its weight, computed once per weight."""

    def __init__(self, cost: Callable[[float], float]) -> None:
        self._cost = cost

    def __missing__(self, weight: float) -> float:
        if len(self) >= _MOST_WEIGHTS:
            self.clear()
        found = self[weight] = self._cost(weight)
        return found


class LivePaths:
    """Cost of the cheapest path from each source to a touch, over a contact graph as it is now.

    Parameters: graph : read before each query, never copied; price_per_m : cost of a metre through each object, >= 0;
    objects without a price pass nothing on; crossing_cost : cost of crossing a contact of some weight; max_hops :
    contacts that a path may cross, None for any number.
    """

    def __init__(
        self,
        graph: ContactGraph,
        price_per_m: Mapping[str, float],
        crossing_cost: Callable[[float], float],
        source_ids: Sequence[str],
        max_hops: int | None,
    ) -> None:
        self._graph, self._beside = graph, graph.beside
        rows = {source_id: row for row, source_id in enumerate((*source_ids, _POINT))}
        self._point_row, self._crossing_costs = len(source_ids), _CrossingCosts(crossing_cost)
        self._paths = ContactPaths(dict(price_per_m), rows, self._crossing_costs, max_hops)
        self._version = -1

    def __del__(self) -> None:
        # Objects and their neighbours refer to each other: left to the garbage collector, those of sources that come
        # and go stop the game for some 60 ms every few seconds.
        if hasattr(self, "_paths"):
            self._paths.update(None, {})

    def _follow_graph(self) -> None:
        """Update the pairs whose contacts changed since the last call."""
        version = self._graph.version
        if version != self._version:
            # The graph's log is short: after a longer pause, as without a touch, all contacts are compared.
            changed = None if self._version < 0 else self._graph.changed_since(self._version)
            self._paths.update(changed, self._beside)
            self._version = version

    def costs(self, object_id: str, point_m: Triple, limits: Sequence[float] | None = None) -> list[float]:
        """Cost of the cheapest path from each source to one point; otherwise as `least_costs`."""
        return self.least_costs([(object_id, point_m)], limits)

    def least_costs(
        self,
        touched: Iterable[tuple[str, Triple]],
        limits: Sequence[float] | None = None,
        among: Collection[int] | None = None,
    ) -> list[float]:
        """Cost of the cheapest path from each source to the nearest of several points, each with its object.

        Parameters: limits : for each source, the highest cost of interest; among : rows of the sources that are
        connected to any of the points, None if that is unknown; no other is looked for.
        Returns: one cost per source: 0 on a touched source, infinity without a path up to the limit.
        """
        self._follow_graph()
        found = self._paths.cheapest(touched, limits, among)
        found.pop()  # of the point
        return found

    def costs_from(self, object_id: str, point_m: Triple, hands: Iterable[Iterable[tuple[str, Triple]]]) -> list[float]:
        """Cost of the cheapest path from a point of an object to the nearest point that each hand touches, as if a
        source without extent stood there; infinity without a path."""
        self._follow_graph()
        contact, row = [(_POINT, object_id)], self._point_row
        self._paths.update(contact, {_POINT: {object_id: Junction((point_m,), (1.0,), (None,))}})
        try:
            found = [self._paths.cheapest(touched, None, [row])[row] for touched in hands]
        finally:
            self._paths.update(contact, {})
        # Its own contact is no crossing.
        return [cost - self._crossing_costs[1.0] for cost in found]
