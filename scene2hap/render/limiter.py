"""The last step of the mix: all samples are within [-1, 1], and quiet mixes are unchanged.

The gain of a mix that is too loud is reduced within milliseconds and released slowly, so the mix is scaled and keeps
its shape:

    h[n] = max(a h[n - 1], ln(|x[n]| / t))      t = -3 dB re full scale, a release per frame
    u[n] = q u[n - 1] + (1 - q) h[n]            q attack per frame
    y = x exp(-u)

Three loud tones then have 0.3 % of odd harmonics. With only the curve below they had 14 %. A gain that is reduced at
once has a kink, which is heard: -35 dB re full scale above 1.4 kHz for a tone at 0 dB, against -58 dB. The curve limits
what is beyond t meanwhile, and sums of mixes:

    y = x                                       |x| <= t
    y = sign(x) (t + (1 - t) tanh((|x| - t) / (1 - t)))     |x| > t

Both act sample by sample, independent of the size of blocks. They run at the session's rate, after resampling, so no
later step can overshoot.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from scene2hap.compiled import compiled

THRESHOLD = 10 ** (-3 / 20)
"""Level from which samples are changed, t [-]: 3 dB below full scale."""
NOTHING = 1e-7
"""A smaller reduction [Np] is not applied: 1e-6 dB."""
RELEASE_S = 1.0
"""Release time constant [s]: longer than beats that are felt one by one. At 0.3 s there are twice the harmonics."""
ATTACK_S = 0.002
"""Attack time constant [s]: less than a period of what is felt best, so that the curve limits little of it."""


def decays(sample_rate_hz: float, n_frames: int) -> NDArray[np.float64]:
    """Return a, a^2, ... and q, q^2, ..., (2, n_frames) [-]."""
    times_s = np.arange(1, n_frames + 1) / sample_rate_hz
    return np.asarray(np.exp(np.outer([-1 / RELEASE_S, -1 / ATTACK_S], times_s)))


@compiled
def turn_down_in_place(
    mix: NDArray[np.float32],
    held: NDArray[np.float64],
    scratch: NDArray[np.float64],
    threshold: float,
    decays: NDArray[np.float64],
) -> None:
    """Reduce the gain of the next frames of a mix (n_channels, n_frames). `held` (2, n_channels) is h and u of the last
    frame [Np].

    Parameters: scratch : (2, n_channels, n_frames), so that nothing large is allocated; decays : see `decays`,
        (2, n_frames).
    """
    (x, u), (h_before, u_before), (releases, attacks) = scratch, held, decays
    np.copyto(x, mix)
    np.abs(x, out=u)
    if not mix.size or (not held.any() and np.maximum.reduce(u, axis=None) <= threshold):
        return
    np.maximum(u, threshold, out=u)
    np.divide(u, threshold, out=u)
    np.log(u, out=u)
    # Values are divided by the decay since the frame before the first. A decaying maximum then is a running maximum,
    # and a smoothed value a running sum.
    np.divide(u, releases, out=u)
    np.maximum.accumulate(u, axis=1, out=u)
    np.maximum(u, h_before[:, None], out=u)
    np.multiply(u, releases, out=u)
    h_before[:] = u[:, -1]
    np.multiply(u, 1 - attacks[0], out=u)
    np.divide(u, attacks, out=u)
    np.cumsum(u, axis=1, out=u)
    np.add(u, u_before[:, None], out=u)
    np.multiply(u, attacks, out=u)
    u_before[:] = u[:, -1]
    held[held < NOTHING] = 0.0
    np.negative(u, out=u)
    np.exp(u, out=u)
    np.multiply(u, x, out=u)
    np.copyto(mix, u, casting="same_kind")


def soft_limit_sum(
    mix: NDArray[np.float32], total: NDArray[np.float32], threshold: float = THRESHOLD
) -> NDArray[np.float32]:
    """Return the sum of a limited mix and more signals within [-1, 1]; float32, `mix` and `total` of one shape.

    The curve begins at the threshold [-], or at the level of the mix where the mix is louder. A mix without additions
    is therefore unchanged. A second pass of the whole curve would begin and end each impact with a step, at all hands.
    Of several limited mixes, `mix` is the loudest.
    """
    size = np.abs(total)
    if not total.size or np.maximum.reduce(size, axis=None) <= threshold:
        return total
    knee = np.maximum(np.abs(mix), np.float32(threshold))
    rest = np.maximum(1 - knee, np.float32(1e-9))  # no division by 0 at full scale
    limited = np.copysign(knee + rest * np.tanh((size - knee) / rest), total)
    return np.where(size > knee, limited, total)


@compiled
def limit_in_place(mix: NDArray[np.float32], scratch: NDArray[np.float32], threshold: float) -> None:
    """Apply the curve in place to (n_channels, n_frames). Scratch has the mix's shape, so nothing large is
    allocated."""
    np.abs(mix, out=scratch)
    if not mix.size or np.maximum.reduce(scratch, axis=None) <= threshold:
        return
    rest = 1 - threshold
    is_over = scratch > threshold
    np.subtract(scratch, threshold, out=scratch)
    np.divide(scratch, rest, out=scratch)
    np.tanh(scratch, out=scratch)
    np.multiply(scratch, rest, out=scratch)
    np.add(scratch, threshold, out=scratch)
    np.copysign(scratch, mix, out=scratch)
    np.copyto(mix, scratch, where=is_over)
