"""Analysis of a signal: amplitude, frequency and transients over time.

Amplitude is the magnitude of the analytic signal (Hilbert transform; Oppenheim and Schafer, Discrete-Time Signal
Processing, ch. 12), with its power smoothed over `SMOOTHED_S`: that of a sine wave of equal power. Frequency is a ridge
of the short-time spectrum (`ridge`). Transients are pulses that exceed the surrounding amplitude by `PROMINENCE_DB` and
end within `LONGEST_PULSE_S`. A train of pulses closer than `APART_S` is roughness, and stays in the amplitude.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import scipy

from scene2hap.audio.spectra.windows import hann
from scene2hap.common.arrays import Floats
from scene2hap.export.frequency_ridge import ridge_hz

STEP_S = 0.005
"""Time between two values of an envelope [s]."""
SMOOTHED_S = 0.025
"""Width at half height of the window that smooths power [s]: the distance of points at 40 points a second. Exports with
more points smooth less."""
FLOOR_DB = -40.0
"""Floor of amplitudes relative to the peak [dB]; weaker vibration is not felt beside the rest."""

_SHARPENING_STEPS = 5
_PADDING_S = 0.1
"""Time by which a signal is extended at both ends before the transform [s]: two cycles at 20 Hz."""
PROMINENCE_DB = 9.0
LONGEST_PULSE_S = 0.06
APART_S = 0.08


@dataclass(frozen=True)
class Pulse:
    """A short pulse: its start and end [s], its amplitude [-] and frequency [Hz]."""

    start_s: float
    end_s: float
    amplitude: float
    frequency_hz: float


@dataclass(frozen=True, eq=False)
class Envelope:
    """A signal over time: times_s (n,), amplitude (n,) [-], frequency_hz (n,), and its pulses.

    Times are `STEP_S` apart, from 0 to the end. A loop has equal values at both ends.
    """

    times_s: Floats
    amplitude: Floats
    frequency_hz: Floats
    pulses: tuple[Pulse, ...] = ()
    is_loop: bool = False
    smoothed_s: float = SMOOTHED_S

    @property
    def duration_s(self) -> float:
        """Length [s]."""
        return float(self.times_s[-1])

    def smoothed_over(self, smoothed_s: float, samples: Floats, sample_rate_hz: float) -> Envelope:
        """Return the envelope of the same signal (n_samples,), with its power smoothed over another time [s]."""
        amplitude, times = amplitude_of(samples, sample_rate_hz, is_loop=self.is_loop, smoothed_s=smoothed_s)
        pulses = _pulses(times, amplitude, self.frequency_hz)
        return replace(self, amplitude=amplitude, pulses=pulses, smoothed_s=smoothed_s)

    def sharpened(self) -> Floats:
        """Return the amplitude (n,) that gives this envelope when it is played and analysed again.

        The analysis smooths the signal again, so some steps of Richardson (1972) and Lucy (1974) undo that. This
        preserves attacks.
        """
        window = hann(2 * round(self.smoothed_s / STEP_S) + 1)
        half = len(window) // 2

        def smooth(values: Floats) -> Floats:
            # The two ends of a loop are one instant.
            padded = np.pad(values[:-1], (half, half + 1), mode="wrap") if self.is_loop else np.pad(values, half)
            return np.asarray(scipy.signal.convolve(padded, window, mode="valid", method="direct"))

        inside = smooth(np.ones(len(self.times_s)))
        power = np.maximum(self.amplitude**2, 1e-12)
        found = power.copy()
        # In steps of 5 ms the window is wider than a shorter smoothing: more steps would exaggerate roughness.
        for _ in range(_SHARPENING_STEPS if self.smoothed_s >= SMOOTHED_S else 1):
            found *= np.clip(power / (smooth(found) / inside), 0.1, 10.0)
        return np.sqrt(found)

    def without_pulses(self) -> Floats:
        """Return `sharpened` with each pulse replaced by a straight line from before it to after it."""
        smooth = self.sharpened()
        for pulse in self.pulses:
            inside = np.flatnonzero((self.times_s >= pulse.start_s) & (self.times_s <= pulse.end_s))
            first, last = max(0, inside[0] - 1), min(len(smooth) - 1, inside[-1] + 1)
            smooth[first : last + 1] = np.minimum(
                smooth[first : last + 1], np.linspace(smooth[first], smooth[last], last - first + 1)
            )
        return smooth


def analyse(samples: Floats, sample_rate_hz: float, *, is_loop: bool) -> Envelope:
    """Return the envelope of a signal (n_samples,). A loop is analysed as a periodic signal."""
    amplitude, times = amplitude_of(samples, sample_rate_hz, is_loop=is_loop)
    frequency = ridge_hz(samples, sample_rate_hz, times, is_loop=is_loop)
    return Envelope(times, amplitude, frequency, _pulses(times, amplitude, frequency), is_loop)


def amplitude_of(
    samples: Floats, sample_rate_hz: float, *, is_loop: bool, smoothed_s: float = SMOOTHED_S
) -> tuple[Floats, Floats]:
    """Return the amplitude of a signal (n_samples,), (n,), and its times (n,) [s]."""
    n = len(samples)
    half = max(1, round(smoothed_s * sample_rate_hz))
    window = hann(2 * half + 1)
    pad = half + round(_PADDING_S * sample_rate_hz)
    power = _analytic_power(np.pad(samples, pad, mode="wrap" if is_loop else "constant"))
    near = slice(pad - half, pad + n + half)
    weight = np.ones(n + 2 * pad) if is_loop else np.pad(np.ones(n), pad)
    inside = scipy.signal.oaconvolve(weight[near], window, mode="valid")
    smooth = scipy.signal.oaconvolve((power * weight)[near], window, mode="valid") / inside
    duration_s = n / sample_rate_hz
    times = np.linspace(0.0, duration_s, max(2, round(duration_s / STEP_S) + 1))
    at = np.arange(n + 1) / sample_rate_hz
    power_at = np.append(smooth[:n], smooth[0] if is_loop else smooth[n - 1])
    return np.sqrt(np.maximum(np.interp(times, at, power_at), 0.0)), times


def _analytic_power(samples: Floats) -> Floats:
    """Return the squared magnitude (n,) of the analytic signal of a signal (n,)."""
    n = scipy.fft.next_fast_len(len(samples))
    spectrum = scipy.fft.fft(samples, n)
    spectrum[0] = 0.0
    spectrum[(n + 1) // 2 :] = 0.0
    return np.asarray(np.abs(2.0 * scipy.fft.ifft(spectrum)[: len(samples)]) ** 2)


def decibels(amplitude: Floats, peak: float) -> Floats:
    """Return amplitudes relative to a peak [dB], at least `FLOOR_DB`."""
    floor = 10.0 ** (FLOOR_DB / 20.0)
    return np.asarray(20.0 * np.log10(np.maximum(amplitude / max(peak, 1e-12), floor)))


def _pulses(times: Floats, amplitude: Floats, frequency_hz: Floats) -> tuple[Pulse, ...]:
    level = decibels(amplitude, float(amplitude.max()))
    widest = LONGEST_PULSE_S / STEP_S
    tops, found_at = scipy.signal.find_peaks(level, prominence=PROMINENCE_DB, width=(None, widest), rel_height=0.5)
    rhythm, _ = scipy.signal.find_peaks(level, prominence=PROMINENCE_DB / 2)
    found = []
    for top, left, right in zip(tops, found_at["left_ips"], found_at["right_ips"], strict=True):
        others = rhythm[rhythm != top]
        if others.size and np.abs(times[others] - times[top]).min() < APART_S:
            continue
        start, end = (float(np.interp(at, np.arange(len(times)), times)) for at in (left, right))
        found.append(Pulse(start, end, float(amplitude[top]), float(frequency_hz[top])))
    return tuple(found)
