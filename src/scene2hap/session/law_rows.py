"""`ExponentialField` asked for a few touches again and again: the same law, all touches at once.

Hands stay on their objects for many frames, so what belongs to the touched objects is put together once: their contacts
p_c, and per source the price L_c of the way up to each. Then Gamma = exp(-sqrt(omega) min_c (L_c + price |x - p_c|)).
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from scene2hap.propagation.exponential_plate import ExponentialField, band_rms

Point = tuple[float, float, float]
Floats = NDArray[np.float64]

MOST_REMEMBERED = 64


class LawRows:
    """A field of the paper's law, and what belongs to objects that were touched together."""

    def __init__(self, field: ExponentialField) -> None:
        self._field = field
        self._known: dict[tuple[str, ...], tuple[Floats, Floats, Floats]] = {}
        self._minus_root_omega = -np.sqrt(2 * math.pi * field.dominant_hz)
        self._edges_hz = field.bands.widths_hz()
        self._is_dominant = field.bands.kind == "dominant"

    def attenuations(self, object_ids: tuple[str, ...], points_m: Sequence[Point]) -> Floats:
        """Gamma at a point of each object (n_touches, n_sources, n_bands), but for a source's own 1."""
        known = self._known.get(object_ids)
        contacts, costs, prices = self._put_together(object_ids) if known is None else known
        away = np.array(points_m)[:, None] - contacts
        away *= away
        distance = np.sqrt(np.add.reduce(away, axis=2))
        distance *= prices
        length = np.minimum.reduce(costs + distance[:, None], axis=2)
        if self._is_dominant:
            gamma: Floats = np.exp(length * self._minus_root_omega)[:, :, None]
        else:
            gamma = band_rms(length, self._edges_hz)
        floor = self._field.floor
        return np.maximum(gamma, floor * np.isfinite(length)[:, :, None]) if floor else gamma

    def _put_together(self, object_ids: tuple[str, ...]) -> tuple[Floats, Floats, Floats]:
        """Contacts (n, most, 3), costs (n, n_sources, most), infinite where an object has fewer, and prices (n, 1)."""
        field = self._field
        arrivals = [field.arrivals.get(object_id) for object_id in object_ids]
        most = max((len(found.points_m) for found in arrivals if found is not None), default=0)
        contacts = np.zeros((len(object_ids), max(1, most), 3))
        costs = np.full((len(object_ids), len(field.source_ids), max(1, most)), math.inf)
        for i, found in enumerate(arrivals):
            if found is not None:
                contacts[i, : len(found.points_m)] = found.points_m
                costs[i, :, : len(found.points_m)] = found.costs
        prices = np.array([[field.price_per_m.get(object_id, 0.0)] for object_id in object_ids])
        if len(self._known) >= MOST_REMEMBERED:
            del self._known[next(iter(self._known))]
        self._known[object_ids] = contacts, costs, prices
        return contacts, costs, prices
