"""Gate, peak guard, power guard and slew guard of the safety layer. Their samples do not depend on the size of blocks.

State is reset at frames counted from the first one, never at the start of a block. Arrays are float64 (n_frames,
n_channels).
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from scene2hap.common.arrays import Floats
from scene2hap.render import limiter

FULL_SCALE_S = 0.05
"""Time in which a limit changes by full scale, so that a change of profile does not click [s]."""

WINDOW_PARTS = 4
"""The power guard's time constant is the budget's window divided by this."""

KNEE = 0.7
"""Share of the budget's power above which the power guard reduces the gain."""


class Gate:
    """A gate that opens and closes over raised cosines; a reversal continues from the present gain.

    The position in the fade is an integer, so a fade ends on an exact frame.
    """

    def __init__(self, n_opening: int, n_closing: int) -> None:
        self._up, self._down = n_closing, n_opening
        self._top = n_opening * n_closing
        self._place = 0

    @property
    def is_shut(self) -> bool:
        """True if the gate is closed."""
        return self._place == 0

    def factors(self, n_frames: int, is_opening: bool) -> Floats | float:
        """Return factors of the next frames (n_frames, 1), while the gate opens or closes."""
        target = self._top if is_opening else 0
        if self._place == target:
            return 1.0 if is_opening else 0.0
        step = self._up if is_opening else -self._down
        places = np.clip(self._place + step * np.arange(1, n_frames + 1), 0, self._top)
        if n_frames:
            self._place = int(places[-1])
        return np.asarray(0.5 - 0.5 * np.cos(math.pi * places / self._top))[:, None]


class PeakGuard:
    """A limiter that turns each channel down to its limit, by the idea of `scene2hap.render.limiter`.

        h[n] = max(a h[n - 1], ln(|x[n]| / t)),   u[n] = q u[n - 1] + (1 - q) h[n],   z = x exp(-u)
        y = z up to t,   sign(z) (t + (P - t) tanh((|z| - t) / (P - t))) beyond

    So a signal that stays too loud is scaled rather than clipped, and turned down without a click. Symbols: P limit; t
    where it begins to act, 3 dB below the limit, or as far below as full scale is above it; a, q release and attack per
    frame. A limit of full scale changes nothing within full scale.

    `limit` is a number, or one for each channel (n_channels,). It may be replaced at any time; the limits in force
    change linearly to the new ones. A limit that rises is felt within seconds, by the release.
    """

    _CELL = 4096

    def __init__(self, limit: float | NDArray[np.float64], sample_rate_hz: float, n_channels: int) -> None:
        from scipy.signal import lfilter

        self.limit = limit
        self._now = np.broadcast_to(limit, n_channels)
        self._step = 1.0 / (FULL_SCALE_S * sample_rate_hz)
        self._release, self._attack = limiter.decays(sample_rate_hz, 1)[:, 0]
        self._powers = self._release ** np.arange(self._CELL)[:, None]
        self._smooth = lfilter
        self._held, self._applied = np.zeros((2, n_channels))
        self._frame = 0
        self.n_limited: int = 0

    def rearrange(self, former: Sequence[int | None], limit: Floats) -> None:
        """Change the channels: each continues a former one, by index, or is new (None), with its limit at once."""

        def kept(state: Floats, new: Floats) -> Floats:
            return np.array([new[i] if one is None else state[one] for i, one in enumerate(former)])

        nothing = np.zeros(len(former))
        self._held, self._applied = kept(self._held, nothing), kept(self._applied, nothing)
        self._now, self.limit = kept(self._now, limit), limit

    def pass_through(self, x: Floats) -> Floats:
        """Return the signal within the limit."""
        parts, begin = [], 0
        while begin < len(x):
            end = min(len(x), begin + self._CELL - self._frame)
            parts.append(self._within_a_cell(x[begin:end]))
            begin = end
        return np.concatenate(parts) if parts else x

    def _within_a_cell(self, x: Floats) -> Floats:
        level, limit = np.abs(x), self._limits(len(x))
        threshold = limit * np.maximum(limiter.THRESHOLD, limit)
        is_over = level > threshold
        powers = self._powers[self._frame : self._frame + len(x)]
        self._frame += len(x)
        y = x
        if is_over.any() or self._held.any() or self._applied.any():
            self.n_limited += int(is_over.sum())
            wanted = np.log(np.maximum(level, threshold) / threshold)
            # Values are divided by the decay since the cell's first frame. A decaying maximum then is a plain running
            # maximum, without accumulated rounding.
            held = np.maximum(np.maximum.accumulate(wanted / powers, axis=0), self._held)
            self._held = held[-1]
            q = self._attack
            reduction, last = self._smooth([1 - q], [1, -q], held * powers, axis=0, zi=self._applied[None])
            self._applied = last[0]
            y = _bent(x * np.exp(-reduction), threshold, limit)
        if self._frame == self._CELL:
            self._frame = 0
            self._held = self._held * self._release**self._CELL
            for state in (self._held, self._applied):
                state[state < limiter.NOTHING] = 0.0
        return y

    def _limits(self, n_frames: int) -> Floats:
        """Return the limits in force (n_frames or 1, n_channels) and advance them."""
        left = self.limit - self._now
        if not left.any():
            return self._now[None]
        farthest = self._step * np.arange(1, n_frames + 1)[:, None]
        limits: Floats = self._now + np.clip(left, -farthest, farthest)
        self._now = limits[-1]
        return limits


def _bent(z: Floats, threshold: Floats, limit: Floats) -> Floats:
    """Return the signal, bent beyond a threshold so that it stays within the limit."""
    rest = np.maximum(limit - threshold, np.finfo(np.float64).tiny)
    excess = np.maximum(np.abs(z) - threshold, 0.0)
    bent = np.minimum(threshold + rest * np.tanh(excess / rest), limit)
    return np.where(excess > 0.0, np.copysign(bent, z), z)


class PowerGuard:
    """Limit the mean square over any window of T seconds to W, by a thermal model of the first order.

        q' = (y^2 - q) / tau,   g^2 = min(1, (V - q) / (V (1 - KNEE))),   y = g x,   V = W / (1 + tau / T)

    As q approaches V the gain goes to zero, so q never exceeds it; then the integral of y^2 over T is tau (q_1 - q_0) +
    integral of q <= (tau + T) V = T W. The gain changes linearly within each cell. Symbols: W power budget [1], T
    window [s], tau time constant [s], P peak of the input.
    """

    def __init__(self, rms: float, window_s: float, peak: float, sample_rate_hz: float, n_channels: int) -> None:
        tau_frames = window_s / WINDOW_PARTS * sample_rate_hz
        self._most = rms**2 / (1 + 1 / WINDOW_PARTS)
        knee = self._most * (1 - KNEE)
        # A small budget fills within few frames and needs short cells.
        n_frames = min(knee * tau_frames / (2 * peak**2), 0.002 * sample_rate_hz)
        self._n = max(8, round(n_frames))
        self._keep = math.exp(-self._n / tau_frames)
        # Two cells at full power must fit into the rest of the budget, since a gain is decided one cell ahead.
        self._knee = max(knee, 2 * (1 - self._keep) * peak**2)
        self._ramp = (np.arange(1, self._n + 1) / self._n)[:, None]
        self._power = [0.0] * n_channels
        self._gains = [(self._gain_for(0.0),) * 2] * n_channels
        self._moments = np.zeros((3, n_channels))
        self._frame = 0
        self.n_limited: int = 0

    def pass_through(self, x: Floats) -> Floats:
        """Return the signal within the budget."""
        if not len(x):
            return x
        n_cells = -(-(self._frame + len(x)) // self._n)
        begin, end = self._frame, self._frame + len(x)
        self._frame = end % self._n
        n_full = end // self._n
        cells = np.zeros((n_cells * self._n, x.shape[1]))
        cells[begin:end] = x
        gains = self._advance(cells.reshape(n_cells, self._n, -1), begin, n_full)
        factors = (gains[:, 0, None] + gains[:, 1, None] * self._ramp).reshape(n_cells * self._n, -1)[begin:end]
        self.n_limited += int(((factors < 1.0) & (x != 0.0)).sum())
        return np.asarray(x * factors)

    def _advance(self, cells: Floats, begin: int, n_full: int) -> Floats:
        """Return gain at the start of each cell and its change within (n_cells, 2, n_channels). Advances the thermal
        model."""
        squares = cells**2
        # Energy under the gain g + d r is g^2 sum x^2 + 2 g d sum x^2 r + d^2 sum x^2 r^2. It is summed in order, since
        # numpy's pairwise sums would depend on the block boundaries.
        moments = np.stack([squares, squares * self._ramp, squares * self._ramp**2])
        if begin:
            moments[:, 0, begin - 1] = self._moments
        sums = np.cumsum(moments, axis=2)[:, :, -1]
        self._moments = sums[:, -1] if n_full < len(cells) else np.zeros_like(self._moments)
        gains = np.zeros((len(cells), 2, cells.shape[2]))
        for channel, sums_of_cells in enumerate(np.moveaxis(sums, 2, 0).tolist()):
            for cell, (a, b, c) in enumerate(zip(*sums_of_cells, strict=True)):
                now, following = self._gains[channel]
                change = following - now
                gains[cell, :, channel] = now, change
                if cell < n_full:
                    energy = now * now * a + 2 * now * change * b + change * change * c
                    power = self._keep * self._power[channel] + (1 - self._keep) * energy / self._n
                    self._power[channel] = power
                    self._gains[channel] = (following, self._gain_for(power))
        return gains

    def _gain_for(self, power: float) -> float:
        return math.sqrt(min(max((self._most - power) / self._knee, 0.0), 1.0))


class SlewGuard:
    """Limit the change of each channel to `step` per frame. Signals within this limit are unchanged."""

    def __init__(self, step: float, n_channels: int) -> None:
        self._step = step
        self._last = np.zeros(n_channels)
        self.n_limited: int = 0

    def pass_through(self, x: Floats) -> Floats:
        """Return the signal, or the nearest signal within the slew limit."""
        if not len(x):
            return x
        steps = np.diff(x, axis=0, prepend=self._last[None])
        if (np.abs(steps) > self._step).any():
            x = np.stack([self._follow(x[:, c], steps[:, c], self._last[c]) for c in range(x.shape[1])], axis=1)
        self._last = x[-1]
        return x

    def _follow(self, x: Floats, steps: Floats, last: float) -> Floats:
        """Limit one channel frame by frame, from each step that is too large until the output meets the signal."""
        y = x.copy()
        too_large = np.flatnonzero(np.abs(steps) > self._step).tolist()
        done = 0
        for start in too_large:
            if start < done:
                continue
            at = y[start - 1] if start else last
            done = start
            while done < len(x) and abs(x[done] - at) > self._step:
                at += math.copysign(self._step, x[done] - at)
                y[done] = at
                done += 1
                self.n_limited += 1
        return y
