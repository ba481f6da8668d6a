"""The two control conditions of the paper's second study: no propagation, and full propagation.

Both have live fields, as the law has, so that all conditions follow contacts and impacts within the same time.

Source: Jingu, AliAbbasi et al., Scene2Hap, CHI 2026, section "Effect of Vibration Propagation on Haptic Perception".
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np
from numpy.typing import NDArray

from scene2hap.common.arrays import Floats
from scene2hap.common.calls import clear_construction
from scene2hap.haptics import Bands
from scene2hap.propagation.exponential_plate import PreparedLaw
from scene2hap.propagation.live import CostsByHand, TouchedPoint
from scene2hap.propagation.paths.live_law import LiveLaw, LivePaths
from scene2hap.propagation.paths.prepared_paths import cheapest_arrivals
from scene2hap.propagation.protocol import Body, ContactNetwork, Excitation, require_hops, require_input

if TYPE_CHECKING:
    from scene2hap.contact.graph import ContactGraph


@clear_construction
@dataclass(frozen=True)
class NoPropagation:
    """Control condition of the paper: only the source itself vibrates."""

    kind: Literal["no_propagation"] = "no_propagation"

    def prepare(self, network: ContactNetwork, excitations: Sequence[Excitation], bands: Bands) -> PreparedLaw:
        """Prepare the field in which every source reaches itself alone."""
        require_input(network, excitations, bands)
        source_ids = tuple(item.source_id for item in excitations)
        return PreparedLaw(source_ids, {}, {}, Arrives(len(source_ids), bands.n_bands))

    def live(
        self, graph: ContactGraph, bodies: Mapping[str, Body], excitations: Sequence[Excitation], bands: Bands
    ) -> LiveItself:
        """Return the field in which every source reaches itself alone; see `LiveModel`."""
        return LiveItself(tuple(item.source_id for item in excitations), bands.n_bands)


@clear_construction
@dataclass(frozen=True)
class FullPropagation:
    """Control condition of the paper: every object connected to a source vibrates as strongly as the source.

    Parameters: max_hops : contacts that vibration may cross, at least 1, None for any number.
    Raises: ConfigError: `max_hops` is out of bounds.
    """

    max_hops: int | None = None
    kind: Literal["full_propagation"] = "full_propagation"

    def __post_init__(self) -> None:
        require_hops(self.max_hops)

    def prepare(self, network: ContactNetwork, excitations: Sequence[Excitation], bands: Bands) -> PreparedLaw:
        """Prepare the field in which every source reaches all objects connected to it by contacts of weight above 0."""
        require_input(network, excitations, bands)
        source_ids, free = tuple(item.source_id for item in excitations), dict.fromkeys(network.bodies, 0.0)
        crossing = [_free_crossing(contact.weight) for contact in network.contacts]
        arrivals = cheapest_arrivals(free, network.contacts, crossing, source_ids, self.max_hops)
        return PreparedLaw(source_ids, arrivals, free, Arrives(len(source_ids), bands.n_bands))

    def live(
        self, graph: ContactGraph, bodies: Mapping[str, Body], excitations: Sequence[Excitation], bands: Bands
    ) -> LiveLaw:
        """Return the field over a contact graph that changes between queries: the law, with paths that cost nothing;
        see `LiveModel`."""
        source_ids = tuple(item.source_id for item in excitations)
        paths = LivePaths(graph, dict.fromkeys(bodies, 0.0), _free_crossing, source_ids, self.max_hops)
        return LiveLaw(paths, source_ids, Arrives(len(source_ids), bands.n_bands), 0.0)


def _free_crossing(weight: float) -> float:
    return 0.0 if weight > 0 else math.inf


@dataclass(frozen=True)
class Arrives:
    """The `Gamma` of the control conditions: 1 where a path arrives at any cost, else 0, in all bands."""

    n_sources: int
    n_bands: int

    def __call__(self, costs: CostsByHand | Floats, columns: Sequence[int] | None = None) -> Floats:
        """See `Gamma`."""
        n_columns = self.n_sources if columns is None else len(columns)
        is_reached = np.isfinite(np.reshape(costs, (len(costs), n_columns, 1)))
        return np.repeat(is_reached.astype(np.float64), self.n_bands, axis=2)


class LiveItself:
    """A live field with gain 1 on the source itself, and on the object that is struck."""

    most: float = 1.0

    def __init__(self, source_ids: tuple[str, ...], n_bands: int) -> None:
        self.source_ids = source_ids
        self._n_bands = n_bands

    def strongest(self, hands: Sequence[Sequence[TouchedPoint]]) -> NDArray[np.float64]:
        """See `LiveField`."""
        return _touched(hands, self.source_ids, self._n_bands)

    def from_point(
        self,
        object_id: str,
        point_m: tuple[float, float, float],
        hands: Sequence[Sequence[TouchedPoint]],
        frequencies_hz: NDArray[np.float64],
    ) -> NDArray[np.float64]:
        """See `PointField`."""
        return _touched(hands, (object_id,), len(frequencies_hz))[:, 0]


def _touched(hands: Sequence[Sequence[TouchedPoint]], ids: Sequence[str], n_bands: int) -> NDArray[np.float64]:
    """1 where a hand touches an object, else 0 (n_hands, n_ids, n_bands)."""
    is_touched = [[any(object_id == one for object_id, _ in touched) for one in ids] for touched in hands]
    gains = np.array(is_touched, dtype=np.float64).reshape(len(hands), len(ids), 1)
    return np.repeat(gains, n_bands, axis=2)
