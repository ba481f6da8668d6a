"""Synthesis of a haptic clip as a signal, by the rule of the .haptic format.

The rule is that of Meta's haptics SDK (`resources/acf`, `core/renderer_c`), with the numbers of its actuator file for
Quest controllers. A sine wave follows both curves. A transient is a pulse of a few cycles; a duller one is longer and
softer. During a transient the sine wave has half its amplitude.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from scene2hap.clips.haptic_clip import HapticClip, Transient

RATE_HZ = 8000
"""Sample rate of the signal and of all tactile signals [Hz]."""

DUCKING = 0.5
_PULSE_HZ = (55.0, 165.0)
_PULSE_S = (0.0364, 0.0121)
_TAIL_S = 0.1
"""Extra duration of a clip whose last point has a transient [s]."""


def synthesize(clip: HapticClip, sample_rate_hz: float = RATE_HZ) -> NDArray[np.float64]:
    """Return the signal of a clip (n_samples,); its peaks may exceed 1 where a transient adds to the sine wave."""
    end_s = clip.duration_s
    if clip.transients and clip.transients[-1].time_s >= end_s:
        end_s += _TAIL_S
    t = np.arange(max(1, int(end_s * sample_rate_hz + 1e-6))) / sample_rate_hz
    frequency = clip.frequency_hz(t)
    phase = np.concatenate([[0.0], np.cumsum(frequency[:-1])]) / sample_rate_hz
    amplitude = clip.amplitude.at(t)
    amplitude[t < clip.amplitude.times_s[0]] = 0.0
    pulses = np.zeros_like(t)
    for i, pulse in enumerate(clip.transients):
        first = int(np.ceil(pulse.time_s * sample_rate_hz - 1e-6))
        pulse_s = _PULSE_S[0] + pulse.frequency * (_PULSE_S[1] - _PULSE_S[0])
        end = min(len(t), first + int(pulse_s * sample_rate_hz))
        if i + 1 < len(clip.transients):  # the next transient ends this one
            end = min(end, max(first, int(np.ceil(clip.transients[i + 1].time_s * sample_rate_hz - 1e-6))))
        pulses[first:end] = _pulse(pulse, end - first, sample_rate_hz)
        amplitude[first:end] *= DUCKING
    return amplitude * np.sin(2.0 * np.pi * phase) + pulses


def _pulse(pulse: Transient, n: int, sample_rate_hz: float) -> NDArray[np.float64]:
    frequency = _PULSE_HZ[0] + pulse.frequency * (_PULSE_HZ[1] - _PULSE_HZ[0])
    phase = np.arange(n) * frequency / sample_rate_hz % 1.0
    square = np.where(phase < 0.5, 1.0, -1.0)
    shape = (1.0 - pulse.frequency) * np.sin(2.0 * np.pi * phase) + pulse.frequency * square
    return np.asarray(pulse.amplitude * shape)
