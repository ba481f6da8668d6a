"""Live fields: they read the contacts at each query and need no preparation.

Most models prepare a field for one moment on a worker thread (`protocol`). A model whose result depends on a few
contacts may offer a live field instead. A live field reads the contact graph at each query, so it needs no preparation
and is never out of date. Sessions use it where a model offers one.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from typing import TYPE_CHECKING, Protocol, runtime_checkable

import numpy as np
from numpy.typing import NDArray

from scene2hap.haptics import Bands
from scene2hap.propagation.protocol import Body, Excitation

if TYPE_CHECKING:
    from scene2hap.contact.graph import ContactGraph

TouchedPoint = tuple[str, tuple[float, float, float]]
"""An object, and a point in the world on or near it [m]."""


CostsByHand = list[list[float]]
"""For each hand, the cost of the cheapest path from each source: 0 on the source itself, infinite without a path."""


class LiveField(Protocol):
    """A field that reads the contacts at each query."""

    @property
    def source_ids(self) -> tuple[str, ...]:
        """Ids of the sources, in the order of the second axis of `strongest`."""
        ...

    @property
    def most(self) -> float:
        """Upper bound of all gains [-]; infinity if unknown, or if a gain might be no number."""
        ...

    def strongest(self, hands: Sequence[Sequence[TouchedPoint]]) -> NDArray[np.float64]:
        """Largest response over each source's free vibration at the points that a hand touches.

        Parameters: hands : the touched points of each hand; a hand that touches nothing feels nothing.
        Returns: a new array (n_hands, n_sources, n_bands) float64 [-], >= 0; 1 on the source itself.
        """
        ...


@runtime_checkable
class PathCostField(LiveField, Protocol):
    """A live field whose gains fall as the cost of a path rises, so that cost alone shows which sources are too faint.
    `strongest(hands)` is `at(path_costs(hands))`."""

    def path_costs(
        self,
        hands: Sequence[Sequence[TouchedPoint]],
        limits: Sequence[float] | None = None,
        among: Sequence[Collection[int]] | None = None,
    ) -> CostsByHand:
        """Cost of each source at each hand: the least over the points that the hand touches.

        Parameters: limits : for each source, the highest cost of interest; higher ones may be returned as infinite;
        among : for each hand, the columns of the sources that are connected to the touched objects; no other is
        searched.
        """
        ...

    def at(self, costs: CostsByHand, columns: Sequence[int] | None = None) -> NDArray[np.float64]:
        """The response at given costs, for the sources in `columns`, None for all; otherwise see `strongest`."""
        ...


@runtime_checkable
class SucceedingField(Protocol):
    """A live field that goes on with the contacts that the field before it has read, of a scene in which objects or
    sources were added or removed."""

    def succeed(self, before: LiveField) -> None:
        """Take over from a field of the same model and graph. That one still answers queries, but may have to read all
        contacts again."""
        ...


@runtime_checkable
class PointField(Protocol):
    """A live field that also has gains of a point source on an object, such as where something lands."""

    def from_point(
        self,
        object_id: str,
        point_m: tuple[float, float, float],
        hands: Sequence[Sequence[TouchedPoint]],
        frequencies_hz: NDArray[np.float64],
    ) -> NDArray[np.float64]:
        """Response at each hand over that at a point of an object [m], world.

        Parameters: hands : the touched points of each hand; frequencies_hz : (n_frequencies,) > 0 [Hz].
        Returns: (n_hands, n_frequencies) float64 [-], >= 0, 0 where nothing arrives; it may be 0 below -100 dB on other
        objects.
        """
        ...


@runtime_checkable
class LiveModel(Protocol):
    """A model that offers live fields."""

    def live(
        self, graph: ContactGraph, bodies: Mapping[str, Body], excitations: Sequence[Excitation], bands: Bands
    ) -> LiveField:
        """Make a field that reads the graph at every query. The graph may change between queries, bodies not."""
        ...


def live_model(model: object) -> LiveModel | None:
    """Return a model if it offers live fields, and these are the fields of its `prepare`; else None.

    A class that overrides `prepare` alone inherits a `live` of another law.
    """
    definitions = (_METHODS & vars(base).keys() for base in type(model).__mro__)
    newest = next(filter(None, definitions), _METHODS)
    return model if isinstance(model, LiveModel) and "live" in newest else None


_METHODS = {"prepare", "live"}
