"""Attenuation of the paper's law by path cost, Gamma = exp(-L sqrt(omega)) with L the cost of the cheapest path."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Protocol

import numpy as np

from scene2hap.common.arrays import Floats
from scene2hap.propagation.bands.band_rms import BandRms
from scene2hap.propagation.live import CostsByHand


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
