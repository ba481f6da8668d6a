"""Frequencies at which a scene is solved, and the gains of bands from the responses at them.

The gain of a band is the rms of |H| over its width. Near a resonance of loss factor eta, |H|^2 is a Lorentzian of
half-power width eta f. Its mean over equally spaced frequencies d apart has an error of at most 2 exp(-pi eta f / d)
(Poisson's sum): 0.7 % or 0.03 dB at d = 0.55 eta f, and more where resonances of several bodies coincide. If the edge
of a band cuts a resonance, the midpoint rule has an error of d^2 / 24 times the slope there. The weights of the three
frequencies next to each edge cancel this error (the slope from two differences, derived here).

Bands around the dominant frequencies of sources overlap. They share the frequencies of one geometric series. The
weight of a band's outermost frequencies is the part of their step that the band covers. A source's gain therefore does
not depend on the other sources.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import NamedTuple, cast

import numpy as np
from numpy.typing import NDArray

from scene2hap.common.arrays import Floats
from scene2hap.errors import ModelDomainError
from scene2hap.haptics import Bands
from scene2hap.propagation.protocol import Excitation

SPACING = 0.55
"""Distance of frequencies, in half-power widths at the band's lower edge."""
LEAST = 8
"""Least number of frequencies in a band, for any loss: masses and springs change |H| within a band too."""
MOST = 200_000
"""Largest number of frequencies that are solved: some minutes for a scene of 50 objects."""
END_WEIGHTS = np.array([13 / 12, 7 / 8, 25 / 24])
"""Weights of the frequencies next to the edge of a band, outermost first; all others have weight 1."""

AROUND = Bands.dominant(octaves=0.5)
"""Default bands of a model with resonances, since a single frequency may hit or miss a resonance. A band reaches one
just noticeable difference to each side, 0.18 to 0.25 of the frequency.

Source: Israr, Tan, Reed, Frequency and amplitude discrimination along the kinesthetic-cutaneous continuum, JASA 120
(2006) 2789. Chosen among widths by `benchmarks/bands.py`.
"""

Gains = Callable[[Floats], Floats]
"""Function from points on a body (n_points, 2) [m] to gains (n_points, n_own, n_bands) of some sources [-]."""


class Band(NamedTuple):
    """Position of a band among the frequencies, and the share of it that each frequency represents (n,)."""

    at: slice
    weights: Floats


@dataclass(frozen=True, eq=False)
class Sampling:
    """Frequencies of a scene (n_frequencies,) [Hz].

    bands : bands that all sources share, or one band for each source; is_shared : whether all sources share them.
    """

    frequencies_hz: Floats
    bands: tuple[Band, ...]
    is_shared: bool

    @classmethod
    def of(cls, bands: Bands, excitations: Sequence[Excitation], loss_factor: float, density: float = 1.0) -> Sampling:
        """Choose frequencies for bodies and contacts with at least this loss; `density` 2 doubles them, for checks.

        Raises: ModelDomainError: so little loss that more than `MOST` frequencies are needed.
        """
        if bands.kind == "edges":
            return _of_edges(bands, loss_factor, density)
        own_hz = [item.frequency_tactile_hz for item in excitations]
        return _around(bands, own_hz, loss_factor, density) if bands.octaves else _at(own_hz)

    @property
    def is_single(self) -> bool:
        """Whether each source has a single frequency of its own; frequencies are then in the order of the sources."""
        return not self.is_shared and all(band.at.stop - band.at.start == 1 for band in self.bands)

    def of_source(self, source: int, band: int) -> Band:
        """Return a band of a source, both by their indices."""
        return self.bands[band if self.is_shared else source]

    def wanted(self, sources: NDArray[np.intp]) -> NDArray[np.bool_]:
        """Whether each frequency is in a band of each source (n_sources, n_frequencies), given by their indices."""
        wanted = np.full((len(sources), len(self.frequencies_hz)), self.is_shared)
        if not self.is_shared:
            for own, source in zip(wanted, sources.tolist(), strict=True):
                own[self.bands[source].at] = True
        return wanted

    @cached_property
    def _side_by_side(self) -> tuple[list[int], Floats]:
        """Index at which each shared band begins, and the weights of all frequencies (n_frequencies, 1, 1)."""
        return [at.start for at, _ in self.bands], np.concatenate([one for _, one in self.bands])[:, None, None]

    def gains(self, response: NDArray[np.complex128], sources: NDArray[np.intp]) -> Floats:
        """Rms over each band (n_points, n_sources, n_bands) of a response (n_frequencies, n_points, n_sources) to
        sources given by their indices (n_sources,)."""
        squares = np.square(response.real)
        squares += np.square(response.imag)
        if self.is_shared:
            starts, weights = self._side_by_side
            squares *= weights
            gains = np.add.reduceat(squares, starts, axis=0).transpose(1, 2, 0)
        else:
            mine = [self.bands[number] for number in sources.tolist()]
            own = [weights @ squares[at, :, k] for k, (at, weights) in enumerate(mine)]
            gains = np.stack(own, axis=-1)[:, :, None]
        return cast("Floats", np.sqrt(gains, out=gains))


def _at(own_hz: Sequence[float]) -> Sampling:
    return Sampling(np.array(own_hz), tuple(Band(slice(i, i + 1), np.ones(1)) for i in range(len(own_hz))), False)


def _around(bands: Bands, own_hz: Sequence[float], loss_factor: float, density: float) -> Sampling:
    """Bands around frequencies: each has those of a series f_k = exp(k step) whose steps it covers, even in part."""
    step = min(SPACING * loss_factor, bands.octaves * math.log(2) / LEAST) / density
    _require_few(len(own_hz) * bands.octaves * math.log(2) / max(step, 1e-300), loss_factor)
    ends = [tuple(math.log(edge) / step for edge in bands.around_hz(f)) for f in own_hz]
    rows = np.unique([k for low, high in ends for k in range(round(low), round(high) + 1)]).astype(np.int64)
    frequencies_hz, found = np.exp(step * rows), []
    for low, high in ends:
        at = slice(*np.searchsorted(rows, (round(low), round(high) + 1)).tolist())
        k = rows[at]
        covered = np.minimum(k + 0.5, high) - np.maximum(k - 0.5, low)
        weights = covered * frequencies_hz[at]
        found.append(Band(at, weights / weights.sum()))
    return Sampling(frequencies_hz, tuple(found), False)


@lru_cache(maxsize=16)
def _of_edges(bands: Bands, loss_factor: float, density: float) -> Sampling:
    low, high = bands.widths_hz().T
    wanted = np.ceil(density * (high - low) / (SPACING * max(loss_factor, 1e-300) * low))
    _require_few(float(wanted.sum()), loss_factor)
    counts = np.maximum(wanted, np.ceil(LEAST * density)).astype(np.intp)
    middles = [
        begin + (end - begin) * (np.arange(n) + 0.5) / n for begin, end, n in zip(low, high, counts, strict=True)
    ]
    ends = np.cumsum(counts).tolist()
    found = [
        Band(slice(end - n, end), np.concatenate([END_WEIGHTS, np.ones(n - 6), END_WEIGHTS[::-1]]) / n)
        for n, end in zip(counts.tolist(), ends, strict=True)
    ]
    return Sampling(np.concatenate(middles), tuple(found), True)


def _require_few(n_frequencies: float, loss_factor: float) -> None:
    if n_frequencies > MOST:
        raise ModelDomainError(
            f"a loss factor of {loss_factor:.3g} takes {n_frequencies:.3g} frequencies to resolve its resonances in "
            f"these bands; at most {MOST:,} are solved. Give a loss_floor (0.01 suits assembled objects) or "
            "Bands.dominant()."
        )
