"""The path cost beyond which each source is too weak to be mixed: its cut-off.

The vibration felt falls as the cost of the path rises, and at some cost it falls below the bound of `audibility`. A
table holds, for some costs, the vibration felt of each source at its full level. The cut-off is the first cost in the
table that is too high, so that at most too much is mixed. Another level needs only another look at the same table.
"""

from __future__ import annotations

import math
from collections.abc import Hashable, Sequence, Set

import numpy as np
from numpy.typing import NDArray

from scene2hap.compiled import compiled
from scene2hap.propagation.live import PricedField, Prices, checked
from scene2hap.propagation.protocol import Excitation
from scene2hap.session.audibility import SILENT, Audibility

# From 1 to less than exp(-700) for any band between 8 Hz and 1 MHz, in steps of 6 %.
_PRICES = np.concatenate([[0.0], np.geomspace(1e-4, 100.0, 240)])
NOWHERE = -1.0
"""The cut-off of a source that is not felt even on itself."""


class CutoffCost:
    """The vibration that arrives and that is felt of each source of a field, by path cost.

    Sources of equal excitation and equal peaks, as copies of an object are, share one column of the table.
    Raises: ModelDomainError: the field returns another shape.
    """

    def __init__(self, field: PricedField, audibility: Audibility, excitations: Sequence[Excitation]) -> None:
        n_bands = audibility.shape[1]
        firsts: dict[Hashable, int] = {}
        keys = [
            (one.frequency_raw_hz, one.frequency_tactile_hz, one.mass_kg, audibility.peaks[i].tobytes())
            for i, one in enumerate(excitations)
        ]
        self._column = np.array([firsts.setdefault(key, len(firsts)) for key in keys], dtype=np.intp)
        columns = np.unique(self._column, return_index=True)[1].tolist()
        everything = field.at([[price] * len(columns) for price in _PRICES.tolist()], columns)
        gains = checked(everything, (len(_PRICES), len(columns), n_bands)).astype(np.float32)
        self._felt, self._least_felt = _falling(audibility.felt(gains, columns)), audibility.least_felt
        self._arrives = _falling(gains.max(axis=2, initial=0.0))

    def felt(self, levels: NDArray[np.float64]) -> list[float]:
        """The cut-off of each source at levels (n_sources,) [-]; infinite where a source is felt however far it is."""
        return _last_of(self._felt.take(self._column, axis=1) * levels >= self._least_felt)

    def arrives(self, levels: NDArray[np.float64]) -> list[float]:
        """The cost of each source beyond which none of its bands exceeds `SILENT`."""
        return _last_of(self._arrives.take(self._column, axis=1) * levels >= SILENT)


@compiled
def within(
    prices: Prices, cutoff: Sequence[float], sought: Sequence[Set[int]]
) -> tuple[list[int], list[list[float]], int]:
    """Sources within their cut-off: rising columns in which any row has one, their costs (infinite beyond the cut-off),
    and the number of sought sources that are beyond."""
    worth, n_beyond = set[int](), 0
    for row, among in zip(prices, sought, strict=True):
        near = {x for x, price in enumerate(row) if price <= cutoff[x]}
        n_beyond += len(among - near)
        worth |= near
    columns = sorted(worth)
    return columns, [[row[x] if row[x] <= cutoff[x] else math.inf for x in columns] for row in prices], n_beyond


def _falling(table: NDArray[np.float32]) -> NDArray[np.float32]:
    """A table by rising cost, made to fall: rounding must not let a gain rise with the cost."""
    falling: NDArray[np.float32] = np.maximum.accumulate(table[::-1], axis=0)[::-1]
    return falling


def _last_of(is_enough: NDArray[np.bool_]) -> list[float]:
    """The first cost of each source at which `is_enough` (n_costs, n_sources) is false."""
    beyond = [NOWHERE, *_PRICES[1:].tolist(), math.inf]
    return [beyond[n] for n in np.count_nonzero(is_enough, axis=0).tolist()]
