"""From touches to what every hand is given, and to what of it is worth mixing.

Any field is asked for everything, and what is too faint is left out afterwards. A field that tells prices is asked for
these alone: what lies beyond its horizon is left out before it is worked out, which is most of it in a furnished room.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from scene2hap.propagation.live import PricedField
from scene2hap.session.audibility import Audibility
from scene2hap.session.config import SkipConfig
from scene2hap.session.counts import Counts
from scene2hap.session.frame import Gains, Touch
from scene2hap.session.horizon import NOWHERE, Horizon
from scene2hap.session.touch_gains import TouchGains

Felt = dict[int, list[Touch]]
"""The touches of each hand that touches anything, by its number, rising."""


class Heard(NamedTuple):
    """What hands are given.

    told : gains (n_hands, n_sources, n_bands), or what works them out; mixed : those (n_hands, n_columns, n_bands) of
    the sources in some columns that are worth mixing, None for all.
    """

    told: Gains | Callable[[], Gains]
    mixed: Gains
    columns: Sequence[int] | None = None


@dataclass(eq=False)
class Loudness:
    """What each source's signal is multiplied with, `levels` (n_sources,) [-]; whether that is 1 for all; and what of
    it is worth mixing."""

    levels: NDArray[np.float64]
    audibility: Audibility

    def __post_init__(self) -> None:
        self.is_even = bool((self.levels == 1.0).all())

    def applied(self, gains: NDArray[np.float64], columns: Sequence[int] | None = None) -> Gains:
        """Gains (n, n_columns, n_bands) of some sources, None for all, at their levels; changes what it is given."""
        if not self.is_even:
            gains *= (self.levels if columns is None else self.levels.take(columns))[:, None]
        return gains.astype(np.float32)


class Hearing(Protocol):
    """Hears what hands touch."""

    def hear(self, n_hands: int, felt: Felt) -> Heard:
        """What that many hands are given, of which some touch something."""
        ...


class HearingAll:
    """Asks a field for everything."""

    def __init__(self, gains: TouchGains, loudness: Loudness, skip: SkipConfig, counts: Counts) -> None:
        self._gains, self._loudness, self._skip, self._counts = gains, loudness, skip, counts

    def hear(self, n_hands: int, felt: Felt) -> Heard:
        """See `Hearing`."""
        given = self._loudness.applied(self._gains.of(list(felt.values())))
        told = _among(given, n_hands, felt)
        worth = self._loudness.audibility.worth_mixing
        if self._skip.idle_hands:
            self._counts.idle_hands += n_hands - len(felt)
            mixed = _among(worth(given), n_hands, felt)
        else:
            mixed = worth(told)
        if not self._skip.silent_bands:
            return Heard(told, mixed)
        columns: list[int] = np.flatnonzero(np.any(mixed, axis=(0, 2))).tolist()
        return Heard(told, mixed if len(columns) == mixed.shape[1] else mixed[:, columns], columns)


class HearingNear:
    """Asks a field for prices, and for what lies within the horizon."""

    def __init__(
        self,
        gains: TouchGains,
        field: PricedField,
        horizon: Horizon,
        loudness: Loudness,
        counts: Counts,
        *,
        skips_silent_bands: bool,
    ) -> None:
        self._gains, self._field, self._loudness, self._counts = gains, field, loudness, counts
        self._horizon = horizon.at_levels(loudness.levels)
        self._skips_silent_bands = skips_silent_bands

    def hear(self, n_hands: int, felt: Felt) -> Heard:
        """See `Hearing`."""
        counts, horizon, inf = self._counts, self._horizon, math.inf
        counts.idle_hands += n_hands - len(felt)
        prices = self._gains.prices(self._field, list(felt.values()))
        worth, n_out = set[int](), 0
        for row in prices:
            for column, price in enumerate(row):
                if price <= horizon[column]:
                    worth.add(column)
                elif price < inf and horizon[column] != NOWHERE:
                    n_out += 1
        counts.below_threshold += n_out
        columns = sorted(worth)
        near = [[row[x] if row[x] <= horizon[x] else inf for x in columns] for row in prices]
        mixed = self._loudness.applied(self._field.at(near, columns), columns)
        if self._skips_silent_bands:
            mixed = self._loudness.audibility.loud(mixed, columns)
        return Heard(self._told(n_hands, felt, prices), _among(mixed, n_hands, felt), columns)

    def _told(self, n_hands: int, felt: Felt, prices: list[list[float]]) -> Callable[[], Gains]:
        # By itself, so that who keeps a frame does not keep what it was heard with changing under it.
        field, loudness = self._field, self._loudness
        return lambda: _among(loudness.applied(field.at(prices)), n_hands, felt)


def _among(given: Gains, n_hands: int, felt: Felt) -> Gains:
    """Gains of the hands that touch something, among those of all."""
    if len(felt) == n_hands:
        return given
    every = np.zeros((n_hands, *given.shape[1:]), dtype=np.float32)
    every[list(felt)] = given
    return every
