"""The paper's law over a contact graph that changes between queries.

    Gamma = exp(-L sqrt(omega)),  L the cost of the cheapest path (`live_paths`)

falls with L, so the nearest of a hand's touches is the loudest. Costs are compared first, and the law is evaluated
once for each hand and source.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Sequence
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from scene2hap.propagation.band_rms import BandRms
from scene2hap.propagation.contact_paths import Triple
from scene2hap.propagation.live import Prices, TouchedPoint
from scene2hap.propagation.live_paths import LivePaths

Floats = NDArray[np.float64]


class Gamma(Protocol):
    """Attenuation by the cost of the path."""

    def __call__(self, prices: Prices, columns: Sequence[int] | None) -> Floats:
        """Attenuation (n, n_columns, n_bands) [-] for n prices of each of some sources, None for all in order."""
        ...


class LiveLaw:
    """A live field of the paper's law.

    Parameters: floor : least attenuation wherever a source arrives at all [-].
    """

    most = 1.0

    def __init__(self, paths: LivePaths, source_ids: tuple[str, ...], gamma: Gamma, floor: float) -> None:
        self.source_ids = source_ids
        self._paths, self._gamma, self._floor = paths, gamma, floor

    def strongest(self, hands: Sequence[Sequence[TouchedPoint]]) -> Floats:
        """See `LiveField`."""
        return self.at(self.prices(hands))

    def prices(
        self,
        hands: Sequence[Sequence[TouchedPoint]],
        limits: Sequence[float] | None = None,
        among: Sequence[Collection[int]] | None = None,
    ) -> Prices:
        """See `PricedField`."""
        least_costs = self._paths.least_costs
        if among is None:
            return [least_costs(touched, limits) for touched in hands]
        return [least_costs(touched, limits, rows) for touched, rows in zip(hands, among, strict=True)]

    def at(self, prices: Prices, columns: Sequence[int] | None = None) -> Floats:
        """See `PricedField`."""
        gamma = self._gamma(prices, columns)
        return np.maximum(gamma, self._floor * np.isfinite(prices)[:, :, None]) if self._floor else gamma

    def from_point(
        self, object_id: str, point_m: Triple, hands: Sequence[Sequence[TouchedPoint]], frequencies_hz: Floats
    ) -> Floats:
        """See `PointField`."""
        costs = np.array(self._paths.costs_from(object_id, point_m, hands)).reshape(-1, 1)
        gamma: Floats = np.exp(-costs * np.sqrt(2 * math.pi * frequencies_hz))
        arrives: Floats = np.isfinite(costs).astype(np.float64)
        return np.maximum(gamma, self._floor * arrives)


class GammaAt:
    """exp(-L sqrt(omega)) at one frequency [Hz] for each source, which is its only band."""

    def __init__(self, frequencies_hz: Floats) -> None:
        self._minus_root_omega = -np.sqrt(2 * math.pi * frequencies_hz)

    def __call__(self, prices: Prices, columns: Sequence[int] | None) -> Floats:
        """See `Gamma`; one band."""
        gamma = np.array(prices)
        gamma *= self._minus_root_omega if columns is None else self._minus_root_omega.take(columns)
        np.exp(gamma, out=gamma)
        return gamma[:, :, None]


class GammaOver:
    """The root mean square of exp(-L sqrt(omega)) over bands."""

    def __init__(self, bands: BandRms) -> None:
        self._bands = bands

    def __call__(self, prices: Prices, columns: Sequence[int] | None) -> Floats:
        """See `Gamma`; the same for all sources."""
        gamma = self._bands([price for row in prices for price in row])
        return gamma.reshape(len(prices), len(prices[0]) if prices else 0, gamma.shape[1])
