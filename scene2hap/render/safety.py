"""The safety layer between the mix and every actuator. It cannot be switched off.

    repair -> clip -> gate -> DC block, low-pass -> gate -> peak guard -> power guard -> slew guard

1. Samples that are not finite become 0, and those beyond full scale are clipped to it.
2. A first-order high-pass at 4.6 Hz: a constant heats a coil and moves nothing. -0.22 dB at 20 Hz.
3. A fourth-order Butterworth low-pass half an octave above the actuator's f_max: -0.26 dB at f_max, so that a source
   has its level in the whole band of the actuator; -12 dB at 2 f_max, and 24 dB an octave beyond.
4. The gate fades in at the start. It fades out when the session stops or its game stops updating (the watchdog).
5. Peak, power and slew are held within the actuator's limits for any input (`scene2hap.render.guards`).

Only steps 2 to 4 change a mix within these limits. The output does not depend on the sizes of input blocks; only the
gate depends on the clock, and changes at the beginning of a block.

Threads: call `feed`, `hold` and `release` on the game's thread, and `process` on the thread that pulls samples; neither
waits for the other.
"""

from __future__ import annotations

import math
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from scene2hap.common import checks
from scene2hap.errors import ConfigError
from scene2hap.haptics import ActuatorProfile
from scene2hap.render.guards import Gate, PeakGuard, PowerGuard, SlewGuard

Block = NDArray[np.float32]

DC_BLOCK_HZ = 4.6
"""Corner of the DC block [Hz]. A constant falls by 42 dB within 200 ms from the fade-in's begin; 4.4 Hz give 40 dB."""

FADE_IN_S = 0.06
"""Length of the fade-in [s]: long enough that the DC block's settling on a 20 Hz tone stays below full scale."""

FADE_OUT_S = 0.008
"""Length of the fade-out [s]. With the wait for the next block, 5 ms on a sound card, it is still about 10 ms."""

INAUDIBLE = 2.0**-40
"""Smaller values in the filters' endless tails count as zero, so that silence becomes exact."""

_ROUNDING = 2.0**-23
"""Rounding of a sample to float32, relative to full scale: a slew at the limit must not exceed it after that."""


@dataclass(frozen=True)
class SafetyStats:
    """Numbers of samples that the safety layer changed, by reason, and of closings by the watchdog."""

    repaired: int = 0
    clipped: int = 0
    peak_limited: int = 0
    power_limited: int = 0
    slew_limited: int = 0
    watchdog_trips: int = 0


class SafetyLayer:
    """The safety layer of `n_channels` outputs.

    Parameters: watchdog_s : time without `feed` after which the output fades to zero [s], None for sinks that do not
        follow wall-clock time; limits : see `hold`; clock : returns the time [s]; on_trip : called in the sink's thread
        when the watchdog expires.
    Raises: ConfigError: a watchdog that is out of bounds.
    """

    def __init__(
        self,
        actuator: ActuatorProfile,
        sample_rate_hz: float,
        n_channels: int,
        *,
        watchdog_s: float | None = None,
        limits: NDArray[np.float64] | None = None,
        clock: Callable[[], float] = time.monotonic,
        on_trip: Callable[[], None] | None = None,
    ) -> None:
        from scipy.signal import butter, sosfilt

        if watchdog_s is not None:
            watchdog_s = checks.number("watchdog_s", watchdog_s, "s", at_least=0.02, at_most=1.0, error=ConfigError)
        self._watchdog_s = watchdog_s
        self._clock = clock
        self._on_trip = on_trip
        self._fed_at = -math.inf
        self._is_released = False
        self._is_tripped = True
        self.silent: threading.Event = threading.Event()
        """Set once the gate has closed after `release`."""
        peak = self._peak_limit = actuator.max_amplitude
        corner_hz = min(math.sqrt(2) * actuator.max_frequency_hz, 0.45 * sample_rate_hz)
        self._sos = np.concatenate(
            [
                butter(1, DC_BLOCK_HZ, "highpass", fs=sample_rate_hz, output="sos"),
                butter(4, corner_hz, "lowpass", fs=sample_rate_hz, output="sos"),
            ]
        )
        self._filter = sosfilt
        self._state = np.zeros((len(self._sos), 2, n_channels))
        self._gate = Gate(round(FADE_IN_S * sample_rate_hz), round(FADE_OUT_S * sample_rate_hz))
        self._peak = PeakGuard(peak if limits is None else np.minimum(limits, peak), sample_rate_hz, n_channels)
        self._power = (
            PowerGuard(actuator.max_rms, actuator.rms_window_s, peak, sample_rate_hz, n_channels)
            if actuator.max_rms < peak
            else None
        )
        slew = 2 * math.pi * actuator.max_frequency_hz * peak / sample_rate_hz
        self._slew = SlewGuard(slew - _ROUNDING * peak, n_channels)
        self._repaired = self._clipped = self._trips = 0

    def feed(self) -> None:
        """Reset the watchdog: the game is alive."""
        self._fed_at = self._clock()

    def hold(self, limits: NDArray[np.float64]) -> None:
        """Limit each channel to (n_channels,) [-] from now on; the actuator's own limit still applies."""
        self._peak.limit = np.minimum(limits, self._peak_limit)

    def release(self) -> None:
        """Fade out permanently; `silent` is set at the end."""
        self._is_released = True

    def process(self, block: Block) -> Block:
        """Return the next samples (n_frames, n_channels) float32, safe to play."""
        # The gate is also applied before the filters, so they start from rest and have no transient.
        gate = self._gate.factors(len(block), self._may_play())
        x = self._repair(np.asarray(block, dtype=np.float64)) * gate
        if len(x):
            filtered, self._state = self._filter(self._sos, x, axis=0, zi=self._state)
            # Once the state has decayed, its denormal numbers only cost time.
            self._state[np.abs(self._state) < INAUDIBLE**2] = 0.0
            x = np.where(np.abs(filtered) < INAUDIBLE, 0.0, filtered)
        x = self._peak.pass_through(x * gate)
        if self._power is not None:
            x = self._power.pass_through(x)
        x = self._slew.pass_through(x)
        if self._is_released and self._gate.is_shut:
            self.silent.set()
        return x.astype(np.float32)

    def guard(self, fill: Callable[[int], Block]) -> Callable[[int], Block]:
        """Return a fill that is safe to play.

        With a watchdog (on a live sink), an error of `fill` first causes a fade-out and is raised after it. So the
        actuator gets no step. Without a watchdog the error is raised at once.
        """

        def safe(n_frames: int) -> Block:
            try:
                block = fill(n_frames)
            except Exception:
                if self._watchdog_s is None or self._gate.is_shut:
                    raise
                self._fed_at = -math.inf
                block = np.zeros((n_frames, self._state.shape[2]), dtype=np.float32)
            return self.process(block)

        return safe

    @property
    def is_late(self) -> bool:
        """True if the watchdog has expired: no `feed` came within its time."""
        return self._watchdog_s is not None and self._clock() - self._fed_at > self._watchdog_s

    @property
    def stats(self) -> SafetyStats:
        """Counters of the changes so far."""
        return SafetyStats(
            self._repaired,
            self._clipped,
            self._peak.n_limited,
            self._power.n_limited if self._power is not None else 0,
            self._slew.n_limited,
            self._trips,
        )

    def _may_play(self) -> bool:
        if self._is_released:
            return False
        is_late = self.is_late
        is_tripping = is_late and not self._is_tripped
        self._is_tripped = is_late
        if is_tripping:
            self._trips += 1
            if self._on_trip is not None:
                self._on_trip()
        return not is_late

    def _repair(self, x: NDArray[np.float64]) -> NDArray[np.float64]:
        is_finite = np.isfinite(x)
        if not is_finite.all():
            self._repaired += int(x.size - is_finite.sum())
            x = np.where(is_finite, x, 0.0)
        is_over = np.abs(x) > 1.0
        if is_over.any():
            self._clipped += int(is_over.sum())
            x = np.clip(x, -1.0, 1.0)
        return x
