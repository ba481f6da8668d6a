"""Fields that follow the contacts by themselves.

Most models prepare a field for one moment, in a worker, and are asked of it while things move on (`protocol`). A model
whose answer is put together from a few contacts may offer a live field besides: it reads the contact graph as it is
when asked, so that there is nothing to prepare and nothing that could be out of date. Sessions take it where a model
offers one.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from typing import TYPE_CHECKING, Protocol, runtime_checkable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from scene2hap.errors import ModelDomainError
from scene2hap.haptics import Bands
from scene2hap.propagation.protocol import Body, Excitation

if TYPE_CHECKING:
    from scene2hap.contact.graph import ContactGraph

TouchedPoint = tuple[str, tuple[float, float, float]]
"""An object, and a point in the world on or near it [m]."""


Prices = list[list[float]]
"""For each hand, what the cheapest way from each source costs: 0 on the source itself, infinite where none leads."""


def checked(found: ArrayLike, shape: tuple[int, int, int]) -> NDArray[np.float64]:
    """What a field answered. Raises: ModelDomainError: it has another shape; kernels take it as it is told."""
    gains: NDArray[np.float64] = np.asarray(found, dtype=np.float64)
    if gains.shape != shape:
        raise ModelDomainError(
            f"the model's field answered with an array of shape {gains.shape}; it must be {shape}: points or hands, "
            "sources and bands."
        )
    return gains


class LiveField(Protocol):
    """What arrives now."""

    @property
    def source_ids(self) -> tuple[str, ...]:
        """The sources, in the order of the answer's second axis."""
        ...

    @property
    def most(self) -> float:
        """What no answer exceeds [-]; infinity if nothing is known of it, or where an answer might be no number."""
        ...

    def strongest(self, hands: Sequence[Sequence[TouchedPoint]]) -> NDArray[np.float64]:
        """Largest response over each source's free vibration at the points that a hand touches.

        Parameters: hands : the touched points of each; a hand that touches nothing feels nothing.
        Returns: a new array (n_hands, n_sources, n_bands) float64 [-], >= 0; 1 on the source itself.
        """
        ...


@runtime_checkable
class PricedField(LiveField, Protocol):
    """A live field whose answers fall as a price rises, so that what is too faint to matter is known by its price
    alone, before anything is worked out. `strongest(hands)` is `at(prices(hands))`."""

    def prices(
        self,
        hands: Sequence[Sequence[TouchedPoint]],
        limits: Sequence[float] | None = None,
        among: Sequence[Collection[int]] | None = None,
    ) -> Prices:
        """The price of each source at each hand; one that feels it at several points has the least of them.

        Parameters: limits : for each source, a price above which it may as well be infinite; what is farther is not
        looked for then; among : for each hand, the columns of the sources that hang together with what it touches, so
        that no other is looked for.
        """
        ...

    def at(self, prices: Prices, columns: Sequence[int] | None = None) -> NDArray[np.float64]:
        """The response at such prices, of the sources in some columns alone; else as `strongest`."""
        ...


@runtime_checkable
class LiveModel(Protocol):
    """Offers live fields."""

    def live(
        self, graph: ContactGraph, bodies: Mapping[str, Body], excitations: Sequence[Excitation], bands: Bands
    ) -> LiveField:
        """A field over a graph that is read at every question, and changes between them; the bodies stay."""
        ...
