"""Gains at touched points: the part of each source that arrives there."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from scene2hap.compiled import compiled
from scene2hap.errors import ModelDomainError
from scene2hap.propagation.live import LiveField, PricedField, Prices, TouchedPoint, checked
from scene2hap.session.config import MAX_GAIN_DB
from scene2hap.session.counts import Counts
from scene2hap.session.frame import Touch
from scene2hap.session.reach import Reach

HandQuery = tuple[list[TouchedPoint], frozenset[int]]
"""The touched points of one hand at which a field is evaluated, and the columns of the sources that reach them."""

GREATEST = 10 ** (MAX_GAIN_DB / 20)


class TouchGains:
    """Evaluate a field at the touches of each hand.

    Parameters: shape : (n_sources, n_bands) of a hand's gains; reach : the objects that are connected now;
    skips_unreachable : do not evaluate the field where no source reaches; limit : cap on a gain, None for none.
    `may_be_capped` is whether the field may exceed it.
    """

    def __init__(
        self,
        field: LiveField,
        shape: tuple[int, int],
        reach: Reach,
        counts: Counts,
        *,
        skips_unreachable: bool,
        limit: float | None,
    ) -> None:
        self._field, self._shape = field, shape
        self._own = {source_id: column for column, source_id in enumerate(field.source_ids)}
        self._reach, self._counts = reach, counts
        self._skips_unreachable = skips_unreachable
        self._is_counting = limit is not None
        self._limit = GREATEST if limit is None else min(limit, GREATEST)
        self.may_be_capped = self._limit < max(1.0, field.most)

    def prices(
        self,
        field: PricedField,
        hands: Sequence[Sequence[Touch]],
        queries: Sequence[HandQuery],
        limits: Sequence[float],
    ) -> Prices:
        """The path cost of each source at each hand up to its limit; 0 on a source.

        Parameters: queries : the result of `query` for the touches of each hand.
        Raises: ModelDomainError: the field returns too many or too few costs.
        """
        prices = field.prices([points for points, _ in queries], limits, [among for _, among in queries])
        n_costs, n_sources = [len(row) for row in prices], self._shape[0]
        if n_costs != [n_sources] * len(hands):
            raise ModelDomainError(
                f"the model's field returned {n_costs} prices for {len(hands)} hands; it must return one for each "
                f"source at each hand, [{n_sources}] * {len(hands)}."
            )
        for row, touches in zip(prices, hands, strict=True):
            for touch in touches:
                if touch.object_id in self._own:
                    row[self._own[touch.object_id]] = 0.0
        return prices

    def of(self, hands: Sequence[Sequence[Touch]]) -> NDArray[np.float64]:
        """Gains (n_hands, n_sources, n_bands) [-], the largest over each hand's touches, capped; 1 on a source.

        Raises: ModelDomainError: the field returns another shape.
        """
        found = self._field.strongest([self.query(touches)[0] for touches in hands])
        gains = checked(found, (len(hands), *self._shape))
        for i, touches in enumerate(hands):
            for touch in touches:
                if touch.object_id in self._own:
                    gains[i, self._own[touch.object_id]] = 1.0
        if self.may_be_capped:
            n_capped = cap(gains, self._limit)
            if self._is_counting:
                self._counts.gains_capped += n_capped
        return gains

    def at(self, field: PricedField, prices: Prices, columns: Sequence[int] | None = None) -> NDArray[np.float64]:
        """Gains (n_hands, n_columns, n_bands) at given path costs, see `PricedField`. Raises as `of`."""
        n_sources, n_bands = self._shape
        n_columns = n_sources if columns is None else len(columns)
        return checked(field.at(prices, columns), (len(prices), n_columns, n_bands))

    def query(self, touches: Sequence[Touch]) -> HandQuery:
        """The touches of a hand that some source reaches, and the columns of these sources. Counts the others."""
        points: list[TouchedPoint] = []
        among: frozenset[int] = frozenset()
        for touch in touches:
            more = self._reach.sources(touch.object_id)
            if more or not self._skips_unreachable:
                points.append((touch.object_id, touch.point_m))
            if more is not among:
                among = among | more if among else more
        self._counts.unreachable_touches += len(touches) - len(points)
        return points, among


@compiled
def cap(gains: NDArray[np.float64], limit: float) -> int:
    """Clip gains (n, m, k) to 0 and a limit, in place. Returns how many were above the limit.

    NaN becomes 0, since the NaN of a guest model must not reach a hand.
    """
    n_above = int(np.count_nonzero(gains > limit))
    np.minimum(np.fmax(gains, 0.0, out=gains), limit, out=gains)
    return n_above
