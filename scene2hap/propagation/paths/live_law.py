"""The paper's law by path cost, and its field over a contact graph that changes between queries.

    Gamma = exp(-L sqrt(omega)), L the cost of the cheapest path

Gamma falls with the cost (`LivePaths`), so the nearest of a hand's touches is the loudest. Costs are compared first,
and the law is evaluated once for each hand and source.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Protocol

import numpy as np

from scene2hap.common.arrays import Floats
from scene2hap.contact.junction import Junction
from scene2hap.propagation.bands.band_rms import BandRms
from scene2hap.propagation.live import CostsByHand, LiveField, TouchedPoint
from scene2hap.propagation.paths.contact_paths import ContactPaths, Triple

if TYPE_CHECKING:
    from scene2hap.contact.graph import ContactGraph


_MOST_WEIGHTS = 1024
"""Most weights of contacts whose cost is kept; a lifted object has another weight in each frame."""

_FAINTEST = 1e-5
"""Gain [-] below which a point is not searched for: a path over a whole level would take seconds. Impacts are played
from -60 dB on."""
_POINT = "\0point"
"""Id of a source that is a point of an object; it is in the network only during a query."""


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

    Parameters: graph : read before each query, never copied; cost_per_m : cost of a metre through each object, >= 0;
    objects without one pass nothing on; crossing_cost : cost of crossing a contact, by its weight; max_hops :
    contacts that a path may cross, None for any number.
    """

    def __init__(
        self,
        graph: ContactGraph,
        cost_per_m: Mapping[str, float],
        crossing_cost: Callable[[float], float],
        source_ids: Sequence[str],
        max_hops: int | None,
    ) -> None:
        self._graph, self._beside = graph, graph.beside
        rows = {source_id: row for row, source_id in enumerate((*source_ids, _POINT))}
        self._point_row, self._crossing_costs = len(source_ids), _CrossingCosts(crossing_cost)
        self._given = dict(cost_per_m), rows
        self._paths = ContactPaths(*self._given, self._crossing_costs, max_hops)
        self._version = -1

    def succeed(self, before: LivePaths) -> None:
        """Take over the network of contacts from the paths of the same law and graph with other objects or sources.

        The former paths read all contacts again if they are queried.
        """
        self._paths, before._paths = before._paths, self._paths
        self._version, before._version = before._version, -1
        for one in (self, before):
            one._paths.use(*one._given)

    def __del__(self) -> None:
        # Objects and their neighbours refer to each other. When sources come and go, the garbage collector would have
        # to free them, which stops the game for some 60 ms every few seconds.
        if hasattr(self, "_paths"):
            self._paths.update(None, {})

    def _follow_graph(self) -> None:
        """Update the pairs whose contacts changed since the last call."""
        version = self._graph.version
        if version != self._version:
            # The graph's log is short: at first, and after a pause, as without a touch, all contacts are read.
            self._paths.update(self._graph.changed_since(self._version), self._beside)
            self._version = version

    def least_costs(
        self,
        touched: Iterable[tuple[str, Triple]],
        limits: Sequence[float] | None = None,
        among: Collection[int] | None = None,
    ) -> list[float]:
        """Cost of the cheapest path from each source to the nearest of several points, each with its object.

        Parameters: limits : for each source, the highest cost of interest; among : rows of the sources that are
        connected to any of the points, None if that is unknown; no other source is searched.
        Returns: one cost per source: 0 on a touched source, infinity without a path up to the limit.
        """
        self._follow_graph()
        found = self._paths.cheapest(touched, limits, among)
        found.pop()  # the row of `_POINT`
        return found

    def costs_from(
        self, object_id: str, point_m: Triple, hands: Sequence[Sequence[tuple[str, Triple]]], limit: float
    ) -> list[float]:
        """Cost of the cheapest path from a point of an object to the nearest point that each hand touches, as if a
        source without extent stood there; infinity without a path.

        Parameters: limit : the highest cost of interest; a higher one is infinite, unless the hand is on the object.
        """
        self._follow_graph()
        contact, row = [(_POINT, object_id)], self._point_row
        self._paths.update(contact, {_POINT: {object_id: Junction((point_m,), (1.0,), (None,))}})
        try:
            limits = [limit + self._crossing_costs[1.0]] * (row + 1)
            is_on = [any(touched_id == object_id for touched_id, _ in touched) for touched in hands]
            found = [
                self._paths.cheapest(touched, None if on else limits, [row])[row]
                for touched, on in zip(hands, is_on, strict=True)
            ]
        finally:
            self._paths.update(contact, {})
        # The contact of `_POINT` itself costs nothing.
        return [cost - self._crossing_costs[1.0] for cost in found]


class Gamma(Protocol):
    """Attenuation as a function of path cost."""

    def __call__(self, costs: CostsByHand, columns: Sequence[int] | None = None) -> Floats:
        """Attenuation (n, n_columns, n_bands) [-] at n costs of each source in `columns`, None for all sources."""
        ...


class GammaAt:
    """Gamma at one frequency [Hz] for each source, which is its only band."""

    def __init__(self, frequencies_hz: Floats) -> None:
        self._minus_root_omega = -np.sqrt(2 * math.pi * frequencies_hz)

    def __call__(self, costs: CostsByHand | Floats, columns: Sequence[int] | None = None) -> Floats:
        """See `Gamma`; one band. A single column of costs (n, 1) is that of all sources."""
        minus_root_omega = self._minus_root_omega if columns is None else self._minus_root_omega.take(columns)
        gamma: Floats = np.multiply(costs, minus_root_omega)
        np.exp(gamma, out=gamma)
        return gamma[:, :, None]


class GammaOver:
    """The root mean square of Gamma over bands."""

    def __init__(self, bands: BandRms) -> None:
        self._bands = bands

    def __call__(self, costs: CostsByHand, columns: Sequence[int] | None = None) -> Floats:
        """See `Gamma`; the same for all sources."""
        gamma = self._bands([cost for row in costs for cost in row])
        return gamma.reshape(len(costs), len(costs[0]) if costs else 0, gamma.shape[1])


def floored(gamma: Floats, costs: CostsByHand | Floats, floor: float) -> Floats:
    """Attenuation (n, n_columns, n_bands) of at least `floor` [-] wherever a source arrives at all."""
    return np.maximum(gamma, floor * np.isfinite(costs)[:, :, None]) if floor else gamma


class LiveLaw:
    """A live field of the paper's law.

    Parameters: floor : least attenuation wherever a source arrives at all [-].
    """

    most: float = 1.0

    def __init__(self, paths: LivePaths, source_ids: tuple[str, ...], gamma: Gamma, floor: float) -> None:
        self.source_ids = source_ids
        self._paths, self._gamma, self._floor = paths, gamma, floor

    def succeed(self, before: LiveField) -> None:
        """See `SucceedingField`."""
        if isinstance(before, LiveLaw):
            self._paths.succeed(before._paths)

    def strongest(self, hands: Sequence[Sequence[TouchedPoint]]) -> Floats:
        """See `LiveField`."""
        return self.at(self.path_costs(hands))

    def path_costs(
        self,
        hands: Sequence[Sequence[TouchedPoint]],
        limits: Sequence[float] | None = None,
        among: Sequence[Collection[int]] | None = None,
    ) -> CostsByHand:
        """See `PathCostField`."""
        least_costs = self._paths.least_costs
        if among is None:
            return [least_costs(touched, limits) for touched in hands]
        return [least_costs(touched, limits, rows) for touched, rows in zip(hands, among, strict=True)]

    def at(self, costs: CostsByHand, columns: Sequence[int] | None = None) -> Floats:
        """See `PathCostField`."""
        return floored(self._gamma(costs, columns), costs, self._floor)

    def from_point(
        self, object_id: str, point_m: Triple, hands: Sequence[Sequence[TouchedPoint]], frequencies_hz: Floats
    ) -> Floats:
        """See `PointField`."""
        root_omega = math.sqrt(2 * math.pi * frequencies_hz.min())
        limit = math.inf if self._floor else -math.log(_FAINTEST) / root_omega
        costs = np.array(self._paths.costs_from(object_id, point_m, hands, limit)).reshape(-1, 1)
        return floored(GammaAt(frequencies_hz)(costs), costs, self._floor)[:, :, 0]
