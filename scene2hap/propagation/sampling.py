"""The frequencies at which a scene is solved, and the gain of a band from what was found there.

The gain of a band is the rms of |H| over its width. |H|^2 near a resonance of loss eta is a Lorentzian of half-power
width eta f; its mean over equally spaced frequencies d apart is off by 2 exp(-pi eta f / d) at most (Poisson's sum), at
d = 0.55 eta f by 0.7 % or 0.03 dB, and by more where resonances of several bodies coincide. Where a resonance is cut by
the edge of its band, the midpoint rule would be off by d^2 / 24 times the slope there; the three frequencies next to
each edge are weighted so as to take that away (the slope from two differences, derived here).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from scene2hap.errors import ModelDomainError
from scene2hap.haptics import Bands
from scene2hap.propagation.protocol import Excitation

SPACING = 0.55
"""Distance of frequencies, in half-power widths at the band's lower edge."""
LEAST = 8
"""Frequencies in a band, however lossy everything is: masses and springs bend |H| too."""
MOST = 200_000
"""Frequencies that are solved at most: some minutes for a scene of 50 objects."""
END_WEIGHTS = np.array([13 / 12, 7 / 8, 25 / 24])
"""Of the frequencies next to the edge of a band, outermost first; all others weigh 1."""


@dataclass(frozen=True, eq=False)
class Sampling:
    """Frequencies of a scene (n_frequencies,) [Hz].

    starts : (n_bands,) where each band begins among them; None if there is one frequency for each source, its own;
    weights : (n_frequencies,) what part of its band each stands for.
    """

    frequencies_hz: NDArray[np.float64]
    starts: NDArray[np.intp] | None
    weights: NDArray[np.float64]

    @classmethod
    def of(cls, bands: Bands, excitations: Sequence[Excitation], loss_factor: float, density: float = 1.0) -> Sampling:
        """Frequencies for bodies and contacts with at least that loss; `density` 2 doubles them, for checks.

        Raises: ModelDomainError: so little loss that they are too many.
        """
        if bands.kind == "dominant":
            own = np.array([item.frequency_tactile_hz for item in excitations])
            return cls(own, None, np.ones(len(own)))
        return _of_bands(bands, loss_factor, density)

    @property
    def bands(self) -> list[slice]:
        """Which frequencies are those of each band; none if there is one for each source."""
        ends = [] if self.starts is None else [*self.starts.tolist(), len(self.frequencies_hz)]
        return [slice(*pair) for pair in pairwise(ends)]

    def columns(self, sources: NDArray[np.intp]) -> NDArray[np.intp] | None:
        """Which frequency is that of each source (n_sources,), None if all are everyone's."""
        return sources if self.starts is None else None

    def gains(self, response: NDArray[np.complex128]) -> NDArray[np.float64]:
        """Rms over each band (n_bands, ...) of a response (n_frequencies, ...)."""
        if self.starts is None:
            raise ValueError("one frequency per source makes no bands")
        squares = np.square(response.real)
        squares += np.square(response.imag)
        squares *= self.weights.reshape(-1, *[1] * (squares.ndim - 1))
        gains: NDArray[np.float64] = np.sqrt(np.add.reduceat(squares, self.starts, axis=0))
        return gains


@lru_cache(maxsize=16)
def _of_bands(bands: Bands, loss_factor: float, density: float) -> Sampling:
    low, high = bands.widths_hz().T
    wanted = np.ceil(density * (high - low) / (SPACING * max(loss_factor, 1e-300) * low))
    if wanted.sum() > MOST:
        raise ModelDomainError(
            f"a loss factor of {loss_factor:.3g} takes {wanted.sum():.3g} frequencies to resolve its resonances in "
            f"these bands; at most {MOST:,} are solved. Give a loss_floor (0.01 suits assembled objects) or "
            "Bands.dominant()."
        )
    counts = np.maximum(wanted, np.ceil(LEAST * density)).astype(np.intp)
    middles = [
        begin + (end - begin) * (np.arange(n) + 0.5) / n for begin, end, n in zip(low, high, counts, strict=True)
    ]
    weights = [np.concatenate([END_WEIGHTS, np.ones(n - 6), END_WEIGHTS[::-1]]) / n for n in counts]
    starts = np.concatenate([[0], np.cumsum(counts)[:-1]]).astype(np.intp)
    return Sampling(np.concatenate(middles), starts, np.concatenate(weights))
