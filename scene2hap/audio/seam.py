"""The seam of a loop, and its cross-fade at constant power.

    y = (w_in a + w_out b) / sqrt(w_in^2 + w_out^2 + 2 r w_in w_out),     r = <a, b> / (|a| |b|)

a and b are the stretches that begin the loop and follow its end, w_in and w_out their weights. Equal stretches (r = 1)
keep their level under a linear fade, w_in + w_out = 1. Uncorrelated ones (r = 0) keep it under an equal-power fade,
w_in^2 + w_out^2 = 1. The root is 1 in both cases. At other r it removes what the fade leaves: a bump of up to
1.8 dB, or a dip of up to 3 dB.

If the level changes by T dB from one stretch to the other, the loop is tilted back, so that both are equally loud:
sample i of L gets a gain of T (i / L - 1/2) dB. Levels are medians over pieces of 20 ms, so that a single tick does not
change them. Differences up to 1 dB stay, so that a tone keeps its amplitude exactly. A hundredth of the sound's mean
power is added to both levels. Otherwise two pauses of unequal noise would tilt the sound between them.
Source: M. Fink, M. Holters, U. Zölzer, "Signal-matched power-complementary cross-fading and dry-wet mixing", DAFx 2016.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from scene2hap.audio.clip import Samples
from scene2hap.common import checks
from scene2hap.common.arrays import Floats
from scene2hap.errors import AudioError

FadeLaw = Literal["linear", "equal-power"]

_ALIKE = 0.5
"""Correlation above which a fade is linear."""
_LEVEL_PARTS = 10
"""Parts of a stretch over which the level's median is taken: 20 ms of 200."""
QUIET = 0.01
"""Share of a sound's mean power below which a stretch of it is hardly noticed [-] (assumed: 20 dB below its level)."""
_LEVEL_FREE_DB, _MOST_TILTED_DB = 1.0, 12.0
"""Largest level difference that is imperceptible and stays, and largest tilt [dB]."""
_MOST_OPPOSED = -0.5
"""Least correlation for the constant-power gain; below it the gain would lift the remainder by more than 3 dB."""


@dataclass(frozen=True)
class Seam:
    """The cut of a loop and its cross-fade: first sample, length and crossfade length [samples], and fade law.

    `correlation` -1..1 [-] is that of the two cross-faded stretches; None means 1 for the linear law and 0 for the
    equal-power law. `tilt_db` is the gain of the loop's end relative to its beginning [dB].
    """

    start: int
    length: int
    crossfade: int
    law: FadeLaw
    correlation: float | None = None
    tilt_db: float = 0.0

    def __post_init__(self) -> None:
        if self.start < 0 or not 0 <= self.crossfade <= self.length or self.length < 1:
            raise AudioError(f"{self} is impossible; it needs start >= 0, length >= 1 and 0 <= crossfade <= length.")
        if self.correlation is not None:
            checks.number("correlation", self.correlation, "-", at_least=-1.0, at_most=1.0, error=AudioError)
        checks.number("tilt_db", self.tilt_db, "dB", at_least=-60.0, at_most=60.0, error=AudioError)

    @property
    def n_samples_needed(self) -> int:
        """The least number of samples that a signal must have for this seam."""
        return self.start + self.length + self.crossfade

    def fitted(self, samples: ArrayLike) -> Seam:
        """Return a seam at the same place, with the law, correlation and tilt that suit another signal (n,)."""
        x = _signal(samples, self)
        a, b = _stretches(x - x.mean(), self)
        energy = float(np.sqrt((a @ a) * (b @ b)))
        correlation = float(np.clip(a @ b / energy, -1.0, 1.0)) if energy > 0.0 else 1.0
        law: FadeLaw = "linear" if correlation > _ALIKE else "equal-power"
        return replace(self, law=law, correlation=correlation, tilt_db=_tilt_db(a, b, QUIET * float(x.var())))


def apply_seam(samples: ArrayLike, seam: Seam) -> Samples:
    """Cut the loop (seam.length,) from a signal (n,). Raises: AudioError: it is too short for the seam."""
    x = _tilted(_signal(samples, seam), seam)
    loop = x[seam.start : seam.start + seam.length].copy()
    ahead, behind = _stretches(x, seam)
    w_in, w_out = _weights(seam)
    loop[: seam.crossfade] = w_in * ahead + w_out * behind
    return loop.astype(np.float32)


def _tilt_db(ahead: Floats, behind: Floats, quiet: float) -> float:
    """Return how much louder the stretch ahead is than the one behind [dB], 0 if the difference is imperceptible.

    Parameters: quiet : power that is hardly noticed.
    """
    n = len(ahead) // _LEVEL_PARTS
    if n < 1:
        return 0.0
    one, other = (float(np.median((x[: n * _LEVEL_PARTS].reshape(-1, n) ** 2).mean(axis=1))) for x in (ahead, behind))
    if min(one, other) <= 0.0:
        return 0.0
    difference_db = 10.0 * float(np.log10((one + quiet) / (other + quiet)))
    return float(np.clip(difference_db, -_MOST_TILTED_DB, _MOST_TILTED_DB)) * (abs(difference_db) > _LEVEL_FREE_DB)


def _tilted(x: Floats, seam: Seam) -> Floats:
    if seam.tilt_db == 0.0:
        return x
    n, mean = seam.n_samples_needed, x.mean()
    along = (np.arange(n) - seam.start) / seam.length - 0.5
    return np.asarray(mean + (x[:n] - mean) * 10.0 ** (seam.tilt_db * along / 20.0))


def _weights(seam: Seam) -> tuple[Floats, Floats]:
    rising = np.arange(seam.crossfade) / max(1, seam.crossfade)
    if seam.law == "linear":
        w_in, w_out, made_for = rising, 1.0 - rising, 1.0
    else:
        w_in, w_out, made_for = np.sin(0.5 * np.pi * rising), np.cos(0.5 * np.pi * rising), 0.0
    r = max(_MOST_OPPOSED, made_for if seam.correlation is None else seam.correlation)
    level = np.sqrt(w_in**2 + w_out**2 + 2.0 * r * w_in * w_out)
    return w_in / level, w_out / level


def _stretches(x: Floats, seam: Seam) -> tuple[Floats, Floats]:
    """Return the samples that begin the loop, and as many that follow its end."""
    end = seam.start + seam.length
    return x[seam.start : seam.start + seam.crossfade], x[end : end + seam.crossfade]


def _signal(samples: ArrayLike, seam: Seam) -> Floats:
    x = np.asarray(samples, dtype=np.float64)
    if x.ndim != 1 or len(x) < seam.n_samples_needed:
        raise AudioError(
            f"samples has shape {x.shape}; this seam needs one channel of {seam.n_samples_needed} samples."
        )
    return x
