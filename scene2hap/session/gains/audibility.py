"""Choose the sources and bands that are strong enough to be mixed at a hand, by the threshold of touch.

The loop is weighted by the threshold T(f), so that a vibration at the threshold has a peak of 1 at any frequency. Then
it is split into bands; p_b is the peak of band b over the whole loop. At band gains g_b the loop never exceeds
sum_b g_b p_b, in thresholds. A source is left out if this sum is below 10^(-10/20) / n for n sources. So the sum of all
sources left out at a hand always stays 10 dB below the threshold.

Bands that are below -140 dB re full scale at their gain are left out as well.

If a model reports path cost, each source has a cut-off: the cost beyond which it is too weak to be mixed. The vibration
felt falls as the cost rises. A table holds, for some costs, the vibration felt of each source at its full level. The
cut-off is the first cost in the table that is too high. So a source may be mixed needlessly, but is never missed. A
change of level needs only another look-up in the same table.
"""

from __future__ import annotations

import math
from collections.abc import Hashable, Sequence, Set

import numpy as np
from numpy.typing import NDArray

from scene2hap.compiled import compiled
from scene2hap.propagation.live import CostsByHand, PathCostField
from scene2hap.propagation.protocol import Excitation, checked_gains
from scene2hap.session.config import SkipConfig
from scene2hap.session.stats import SkipCounts

BELOW_THRESHOLD_DB = 10.0
"""Margin below the threshold of touch of the sum of all sources that are left out of a hand's mix."""
SILENT = 1e-7
"""Peak re full scale below which a band counts as silent."""
NOWHERE = -1.0
"""Cut-off of a source that is not felt even on itself."""

# Costs in steps of 6 %, at which gains fall from 1 to less than exp(-700) for any band between 8 Hz and 1 MHz.
_COSTS = np.concatenate([[0.0], np.geomspace(1e-4, 100.0, 240)])


def arriving(gains: NDArray[np.float64], peaks: NDArray[np.float32]) -> NDArray[np.float64]:
    """Return the amplitude of each source over all bands, re that on the source itself (..., n_sources) [-].

    Parameters: gains (..., n_sources, n_bands) [-]; peaks (n_sources, n_bands) in thresholds of touch. A gain in a band
    in which a source has no vibration is not felt, however high. 0 for a source whose loop is not ready.
    """
    given = peaks.astype(np.float64)
    whole = np.linalg.norm(given, axis=-1)
    found: NDArray[np.float64] = np.linalg.norm(gains * given, axis=-1) / np.where(whole > 0.0, whole, 1.0)
    return found


class Audibility:
    """Decides which bands of some sources are strong enough to be mixed.

    Parameters: peaks : (n_sources, 2, n_bands), see `prepared_loops.peaks_of`; skip : the switches of the pruning.
    """

    def __init__(self, peaks: NDArray[np.float32], skip: SkipConfig, counts: SkipCounts) -> None:
        self.peaks = peaks
        self._skip, self._counts = skip, counts
        self._felt = peaks[:, 0, :, None].copy()
        with np.errstate(divide="ignore", over="ignore"):
            self._least_gain = np.float32(SILENT) / peaks[:, 1]
        self.least_felt: np.float32 = np.float32(10 ** (-BELOW_THRESHOLD_DB / 20) / max(1, len(peaks)))

    @property
    def shape(self) -> tuple[int, int]:
        """Numbers of sources and bands."""
        n_sources, n_bands = self._least_gain.shape
        return n_sources, n_bands

    def felt(self, gains: NDArray[np.float32], columns: Sequence[int]) -> NDArray[np.float32]:
        """Upper bound (n, n_columns) of the vibration felt of the sources in some columns, in thresholds of touch, at
        gains (n, n_columns, n_bands)."""
        felt: NDArray[np.float32] = (gains[:, :, None] @ self._felt[columns])[:, :, 0, 0]
        return felt

    def worth_mixing(self, gains: NDArray[np.float32]) -> tuple[NDArray[np.float32], Sequence[int]]:
        """Drop sources and bands that nobody would feel from gains (n_hands, n_sources, n_bands).

        Returns the gains of the sources that remain (n_hands, n_columns, n_bands), and their columns.
        """
        felt = self._felt[:, :, 0] if self._skip.below_threshold else None
        least = self._least_gain if self._skip.silent_bands else None
        mixed, columns, n_below, n_silent = sifted(gains, felt, float(self.least_felt), least)
        self._counts.below_threshold += n_below
        self._counts.silent_bands += n_silent
        return mixed, columns

    def silence(self, gains: NDArray[np.float32], columns: Sequence[int]) -> None:
        """Zero silent bands in the gains of the sources in some columns, in place."""
        self._counts.silent_bands += silence(gains, self._least_gain, columns)


class CutoffCost:
    """Table of the gain and of the vibration felt of each source of a field, by path cost.

    Sources of equal excitation and equal peaks, such as copies of an object, share one column of the table.
    Raises: ModelDomainError: the field returns another shape.
    """

    def __init__(self, field: PathCostField, audibility: Audibility, excitations: Sequence[Excitation]) -> None:
        n_bands = audibility.shape[1]
        firsts: dict[Hashable, int] = {}
        keys = [
            (one.frequency_raw_hz, one.frequency_tactile_hz, one.mass_kg, audibility.peaks[i].tobytes())
            for i, one in enumerate(excitations)
        ]
        self._column = np.array([firsts.setdefault(key, len(firsts)) for key in keys], dtype=np.intp)
        columns = np.unique(self._column, return_index=True)[1].tolist()
        everything = field.at([[cost] * len(columns) for cost in _COSTS.tolist()], columns)
        gains = checked_gains(everything, (len(_COSTS), len(columns), n_bands)).astype(np.float32)
        self._felt, self._least_felt = _falling(audibility.felt(gains, columns)), audibility.least_felt
        self._arrives = _falling(gains.max(axis=2, initial=0.0))

    def felt(self, levels: NDArray[np.float64]) -> list[float]:
        """Cut-off of each source at levels (n_sources,) [-]; infinite for a source that is felt at any distance."""
        return _last_of(self._felt.take(self._column, axis=1) * levels >= self._least_felt)

    def arrives(self, levels: NDArray[np.float64]) -> list[float]:
        """The cost of each source beyond which none of its bands exceeds `SILENT`."""
        return _last_of(self._arrives.take(self._column, axis=1) * levels >= SILENT)


@compiled
def silence(gains: NDArray[np.float32], least: NDArray[np.float32], columns: Sequence[int] | None) -> int:
    """Zero all gains (n, n_columns, k) below the minimum `least` (m, k) of their source. Returns how many were zeroed.

    `columns` are the rows of `least` for the columns of `gains`, None for all.
    """
    is_silent = ~(gains >= (least if columns is None else least[columns]))
    n_silent = int(np.count_nonzero(gains[is_silent]))
    gains[is_silent] = 0.0
    return n_silent


@compiled
def sifted(
    gains: NDArray[np.float32], peaks: NDArray[np.float32] | None, least_felt: float, least: NDArray[np.float32] | None
) -> tuple[NDArray[np.float32], list[int], int, int]:
    """Copy gains (n, m, k) without sources too weak to be felt and without silent bands.

    A source is too weak if its peaks (m, k), weighted by its gains, add up to less than `least_felt`. A band is silent
    below `least` (m, k). If `peaks` or `least` is None, that test is skipped; without `least` all columns stay. Returns
    the gains of the columns that are not all 0, these columns, and the numbers of sources and bands that were zeroed.
    """
    kept, n_below = gains.copy(), 0
    if peaks is not None:
        felt = np.einsum("nmk,mk->nm", gains.astype(np.float64), peaks.astype(np.float64))
        is_below = felt < least_felt
        kept[is_below] = 0.0
        n_below = int(np.count_nonzero(felt[is_below]))
    if least is None:
        return kept, list(range(gains.shape[1])), n_below, 0
    is_silent = ~(kept >= least)
    n_silent = int(np.count_nonzero(kept[is_silent]))
    kept[is_silent] = 0.0
    columns: list[int] = np.flatnonzero(kept.any(axis=(0, 2))).tolist()
    return np.ascontiguousarray(kept[:, columns]), columns, n_below, n_silent


@compiled
def within(
    costs: CostsByHand, cutoff: Sequence[float], sought: Sequence[Set[int]]
) -> tuple[list[int], list[list[float]], int]:
    """Return the sources within their cut-off in any row: their ascending columns, their costs (infinite beyond the
    cut-off), and the number of sought sources beyond their cut-off."""
    worth, n_beyond = set[int](), 0
    for row, among in zip(costs, sought, strict=True):
        near = {x for x, cost in enumerate(row) if cost <= cutoff[x]}
        n_beyond += len(among - near)
        worth |= near
    columns = sorted(worth)
    return columns, [[row[x] if row[x] <= cutoff[x] else math.inf for x in columns] for row in costs], n_beyond


def _falling(table: NDArray[np.float32]) -> NDArray[np.float32]:
    """Make a table monotonic: a gain must not rise with the cost by rounding."""
    falling: NDArray[np.float32] = np.maximum.accumulate(table[::-1], axis=0)[::-1]
    return falling


def _last_of(is_enough: NDArray[np.bool_]) -> list[float]:
    """The first cost of each source at which `is_enough` (n_costs, n_sources) is false."""
    beyond = [NOWHERE, *_COSTS[1:].tolist(), math.inf]
    return [beyond[n] for n in np.count_nonzero(is_enough, axis=0).tolist()]
