"""Gains of every hand from its touches, without sources that are too weak to be felt.

A field is queried for all sources, and weak ones are left out afterwards. Models that report path cost
(`PathCostField`) are queried for cost only: sources beyond their cut-off are left out before their gains are computed.
In a furnished room these are most sources.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from scene2hap.common.warning import warn_of
from scene2hap.contact.graph import ContactGraph
from scene2hap.errors import ModelDomainError
from scene2hap.propagation.live import CostsByHand, LiveField, PathCostField, TouchedPoint
from scene2hap.propagation.protocol import checked_gains
from scene2hap.session.config import MAX_GAIN_DB, SkipConfig
from scene2hap.session.frame import Gains, Touch, TouchesByHand
from scene2hap.session.gains.audibility import SILENT, Audibility, CutoffCost, within
from scene2hap.session.present_scene.reach import Reach
from scene2hap.session.stats import Counts, SkipCounts

HandQuery = tuple[list[TouchedPoint], frozenset[int]]
"""The touched points of one hand at which a field is evaluated, and the columns of the sources that reach them."""

GREATEST = 10 ** (MAX_GAIN_DB / 20)


class TouchGains:
    """Evaluate a field at the touches of each hand.

    Parameters: shape : (n_sources, n_bands) of a hand's gains; reach : the present groups of connected objects;
    skips_unreachable : do not evaluate the field where no source reaches; limit : cap on a gain, None for none.
    `may_be_capped` is true if the field may exceed the limit.
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
        self.may_be_capped: bool = self._limit < max(1.0, field.most)

    def path_costs(
        self,
        field: PathCostField,
        hands: Sequence[Sequence[Touch]],
        queries: Sequence[HandQuery],
        limits: Sequence[float],
    ) -> CostsByHand:
        """The path cost of each source at each hand up to its limit; 0 on a source.

        Parameters: queries : the result of `query` for the touches of each hand.
        Raises: ModelDomainError: the field returns too many or too few costs.
        """
        costs = field.path_costs([points for points, _ in queries], limits, [among for _, among in queries])
        n_costs, n_sources = [len(row) for row in costs], self._shape[0]
        if n_costs != [n_sources] * len(hands):
            raise ModelDomainError(
                f"the model's field returned {n_costs} path costs for {len(hands)} hands; it must return one for each "
                f"source at each hand, [{n_sources}] * {len(hands)}."
            )
        for row, touches in zip(costs, hands, strict=True):
            for touch in touches:
                if touch.object_id in self._own:
                    row[self._own[touch.object_id]] = 0.0
        return costs

    def of(self, hands: Sequence[Sequence[Touch]], limits: Sequence[float] | None = None) -> NDArray[np.float64]:
        """Gains (n_hands, n_sources, n_bands) [-], the largest over each hand's touches, capped; 1 or more on a source.

        Parameters: limits : for each source, the highest path cost of interest; a `PathCostField` may give 0 beyond it.
        Raises: ModelDomainError: the field returns another shape.
        """
        queries = [self.query(touches) for touches in hands]
        if limits is not None and isinstance(self._field, PathCostField):
            gains = self.at(self._field, self.path_costs(self._field, hands, queries, limits))
        else:
            gains = checked_gains(self._field.strongest([points for points, _ in queries]), (len(hands), *self._shape))
        for i, touches in enumerate(hands):
            for touch in touches:
                if touch.object_id in self._own:
                    own = gains[i, self._own[touch.object_id]]
                    # Another point of a resonant scene may vibrate more than the source.
                    np.fmax(own, 1.0, out=own)
        return self.capped(gains)

    def capped(self, gains: NDArray[np.float64]) -> NDArray[np.float64]:
        """Cap gains (n, n_columns, n_bands) in place, and return them."""
        if self.may_be_capped:
            self._warn_of_invalid(gains)
            n_capped = cap(gains, self._limit)
            if self._is_counting:
                self._counts.gains_capped += n_capped
        return gains

    def _warn_of_invalid(self, gains: NDArray[np.float64]) -> None:
        """Warn once if a third-party model gives negative gains or NaN. Warns: SceneWarning."""
        if self._counts.has_warned_of_gains or not gains.size or gains.min() >= 0:  # the least is NaN if any is
            return
        self._counts.has_warned_of_gains = True
        warn_of(
            f"the model's field gave a gain of {gains.min():.3g}, and such gains are played as 0; a gain is a factor "
            "of at least 0, not in dB. scene2hap.testing.check_propagation_model(model) finds more."
        )

    def at(self, field: PathCostField, costs: CostsByHand, columns: Sequence[int] | None = None) -> NDArray[np.float64]:
        """Gains (n_hands, n_columns, n_bands) at given path costs, see `PathCostField`. Raises as `of`."""
        n_sources, n_bands = self._shape
        n_columns = n_sources if columns is None else len(columns)
        return checked_gains(field.at(costs, columns), (len(costs), n_columns, n_bands))

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
        self._counts.skipped.unreachable_touches += len(touches) - len(points)
        return points, among


def cap(gains: NDArray[np.float64], limit: float) -> int:
    """Clip gains (n, m, k) to 0 and a limit, in place. Returns how many were above the limit.

    NaN becomes 0, since the NaN of a third-party model must not reach a hand.
    """
    n_above = int(np.count_nonzero(gains > limit))
    np.minimum(np.fmax(gains, 0.0, out=gains), limit, out=gains)
    return n_above


class HandGains(NamedTuple):
    """Gains of all hands.

    full : computes the gains (n_hands, n_sources, n_bands); mixed : gains (n_hands, n_columns, n_bands) of the sources
    in `columns` that are mixed, None for all.
    """

    full: Callable[[], Gains]
    mixed: Gains
    columns: Sequence[int] | None = None


@dataclass(eq=False)
class Loudness:
    """Factors of the sources' signals, `levels` (n_sources,) [-], and the pruning of the mix."""

    levels: NDArray[np.float64]
    audibility: Audibility

    def __post_init__(self) -> None:
        self.is_even: bool = bool((self.levels == 1.0).all())

    def applied(self, gains: NDArray[np.float64], columns: Sequence[int] | None = None) -> Gains:
        """Multiply gains (n, n_columns, n_bands) of some sources (None for all) by their levels, in place."""
        if not self.is_even:
            gains *= (self.levels if columns is None else self.levels.take(columns))[:, None]
        return gains.astype(np.float32)


class GainMethod(Protocol):
    """Computes the gains of all hands from their touches."""

    def of_hands(self, hands: tuple[str, ...], touches: TouchesByHand) -> HandGains:
        """Gains of these hands; `touches` has those that touch something."""
        ...


class AllGains:
    """Query a field for all sources."""

    def __init__(self, gains: TouchGains, loudness: Loudness, skip: SkipConfig, counts: SkipCounts) -> None:
        self._gains, self._loudness, self._skip, self._counts = gains, loudness, skip, counts

    def of_hands(self, hands: tuple[str, ...], touches: TouchesByHand) -> HandGains:
        """See `GainMethod`."""
        given = self._loudness.applied(self._gains.of(list(touches.values())))
        worth = self._loudness.audibility.worth_mixing
        if self._skip.idle_hands:
            self._counts.idle_hands += len(hands) - len(touches)
            mixed, columns = worth(given)
            mixed = _with_idle_hands(mixed, hands, touches)
        else:
            mixed, columns = worth(_with_idle_hands(given, hands, touches))
        columns_or_all = columns if self._skip.silent_bands else None
        return HandGains(lambda: _reported(given, hands, touches), mixed, columns_or_all)


class PrunedGains:
    """Query a field for path costs, then for the gains of sources within their cut-off."""

    def __init__(
        self,
        gains: TouchGains,
        field: PathCostField,
        cutoff: CutoffCost,
        loudness: Loudness,
        counts: SkipCounts,
        *,
        skips_silent_bands: bool,
        graph: ContactGraph,
    ) -> None:
        self._gains, self._field, self._loudness, self._counts = gains, field, loudness, counts
        levels = loudness.levels
        self._cutoff, self._arrives = cutoff.felt(levels), cutoff.arrives(levels)
        self._on = frozenset(np.flatnonzero(levels).tolist())
        self._skips_silent_bands, self._graph = skips_silent_bands, graph

    def of_hands(self, hands: tuple[str, ...], touches: TouchesByHand) -> HandGains:
        """See `GainMethod`."""
        gains, cutoff, on = self._gains, self._cutoff, self._on
        of_each = list(touches.values())
        queries = [gains.query(touched) for touched in of_each]
        costs = gains.path_costs(self._field, of_each, queries, cutoff)
        columns, each, n_beyond = within(costs, cutoff, [among & on for _, among in queries])
        self._counts.below_threshold += n_beyond
        self._counts.idle_hands += len(hands) - len(touches)
        mixed = self._loudness.applied(gains.at(self._field, each, columns), columns)
        if self._skips_silent_bands:
            self._loudness.audibility.silence(mixed, columns)

        version = self._graph.version

        def full() -> Gains:
            if self._graph.version == version:
                everything = gains.path_costs(self._field, of_each, queries, self._arrives)
            else:
                # The contacts of that frame are gone, so only the costs that were computed then are valid.
                everything = _cut_off(costs, cutoff)
            return _reported(self._loudness.applied(gains.at(self._field, everything)), hands, touches)

        return HandGains(full, _with_idle_hands(mixed, hands, touches), columns)


def _cut_off(costs: CostsByHand, limits: Sequence[float]) -> CostsByHand:
    """Copy path costs; those beyond their limits become infinite."""
    return [[x if x <= limit else math.inf for x, limit in zip(row, limits, strict=True)] for row in costs]


def _reported(given: Gains, hands: tuple[str, ...], touches: TouchesByHand) -> Gains:
    """Gains as `HapticFrame` reports them: 0 below -140 dB, whatever the model. A copy."""
    return _with_idle_hands(np.where(given < SILENT, np.float32(0.0), given), hands, touches)


def _with_idle_hands(given: Gains, hands: tuple[str, ...], touches: TouchesByHand) -> Gains:
    """Gains of all hands, from those of the hands that touch something; 0 for the others."""
    if len(touches) == len(hands):
        return given
    every = np.zeros((len(hands), *given.shape[1:]), dtype=np.float32)
    every[[hands.index(hand) for hand in touches]] = given
    return every
