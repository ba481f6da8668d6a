"""The seam of a loop, and the fade that closes it at constant power.

    y = (w_in a + w_out b) / sqrt(w_in^2 + w_out^2 + 2 r w_in w_out),     r = <a, b> / (|a| |b|)

Stretches that are alike (r = 1) keep their level under a linear fade, w_in + w_out = 1, unrelated ones (r = 0) under an
equal-power one, w_in^2 + w_out^2 = 1; the root is 1 in both cases, and between them it takes away what is left of the
dip or the bump, up to 1.2 dB.
Source: M. Fink, M. Holters, U. Zölzer, "Signal-matched power-complementary cross-fading and dry-wet mixing", DAFx 2016.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from scene2hap import checks
from scene2hap.audio.clip import Samples
from scene2hap.errors import AudioError

FadeLaw = Literal["linear", "equal-power"]

_ALIKE = 0.5
"""Correlation above which a fade is linear."""
_MOST_OPPOSED = -0.5
"""Stretches more opposed than this are not brought to full power: the gain would lift what does not cancel by 3 dB."""


@dataclass(frozen=True)
class Seam:
    """Where a loop is cut and how it is closed: first sample, length and crossfade length [samples], and fade law.

    `correlation` -1..1 [-] is that of the stretches faded into each other; None stands for 1 where the law is linear
    and 0 where it is equal-power, to which each law is made.
    """

    start: int
    length: int
    crossfade: int
    law: FadeLaw
    correlation: float | None = None

    def __post_init__(self) -> None:
        if self.start < 0 or not 0 <= self.crossfade <= self.length or self.length < 1:
            raise AudioError(f"{self} is impossible; it needs start >= 0, length >= 1 and 0 <= crossfade <= length.")
        if self.correlation is not None:
            checks.number("correlation", self.correlation, "-", at_least=-1.0, at_most=1.0, error=AudioError)

    @property
    def n_samples_needed(self) -> int:
        """Least number of samples of a signal for this seam."""
        return self.start + self.length + self.crossfade

    def fitted(self, samples: ArrayLike) -> Seam:
        """The same place with the law and the correlation of another signal (n,), cut in step with the first."""
        x = _signal(samples, self)
        a, b = _stretches(x - x.mean(), self)
        energy = float(np.sqrt((a @ a) * (b @ b)))
        correlation = float(np.clip(a @ b / energy, -1.0, 1.0)) if energy > 0.0 else 1.0
        return replace(self, law="linear" if correlation > _ALIKE else "equal-power", correlation=correlation)


def apply_seam(samples: ArrayLike, seam: Seam) -> Samples:
    """The loop (seam.length,) that a seam cuts from a signal (n,). Raises: AudioError: it is too short for the seam."""
    x = _signal(samples, seam)
    loop = x[seam.start : seam.start + seam.length].copy()
    ahead, behind = _stretches(x, seam)
    w_in, w_out = _weights(seam)
    loop[: seam.crossfade] = w_in * ahead + w_out * behind
    return loop.astype(np.float32)


def _weights(seam: Seam) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    rising = np.arange(seam.crossfade) / max(1, seam.crossfade)
    if seam.law == "linear":
        w_in, w_out, made_for = rising, 1.0 - rising, 1.0
    else:
        w_in, w_out, made_for = np.sin(0.5 * np.pi * rising), np.cos(0.5 * np.pi * rising), 0.0
    r = max(_MOST_OPPOSED, made_for if seam.correlation is None else seam.correlation)
    level = np.sqrt(w_in**2 + w_out**2 + 2.0 * r * w_in * w_out)
    return w_in / level, w_out / level


def _stretches(x: NDArray[np.float64], seam: Seam) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """The samples that begin the loop, and as many behind its end."""
    end = seam.start + seam.length
    return x[seam.start : seam.start + seam.crossfade], x[end : end + seam.crossfade]


def _signal(samples: ArrayLike, seam: Seam) -> NDArray[np.float64]:
    x = np.asarray(samples, dtype=np.float64)
    if x.ndim != 1 or len(x) < seam.n_samples_needed:
        raise AudioError(
            f"samples has shape {x.shape}; this seam needs one channel of {seam.n_samples_needed} samples."
        )
    return x
