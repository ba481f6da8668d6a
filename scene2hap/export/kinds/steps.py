"""Amplitudes at equal steps of time, for formats without frequency."""

from __future__ import annotations

import numpy as np

from scene2hap.clips.haptic_clip import Curve, HapticClip
from scene2hap.common.arrays import Floats
from scene2hap.export.envelope import amplitude_of
from scene2hap.export.fidelity import played_samples
from scene2hap.export.track import ANALYSIS_HZ, Channel


def amplitudes_at_steps(channel: Channel, step_s: float) -> Floats:
    """Return the amplitude of a channel in each step (n,), 0..1 [-]; the last step may be shorter.

    Power is smoothed over one step, which keeps the attacks that the format can hold.
    """
    samples = played_samples(channel.clip or channel)
    n = max(1, int(np.ceil(channel.duration_s / step_s - 1e-6)))
    amplitude, times = amplitude_of(samples, ANALYSIS_HZ, is_loop=channel.is_loop, smoothed_s=step_s)
    middles = (np.arange(n) + 0.5) * step_s
    return np.asarray(np.clip(np.interp(middles, times, amplitude), 0.0, 1.0))


def steps_as_clip(amplitudes: Floats, step_s: float, duration_s: float) -> HapticClip:
    """Return the signal that a player makes of steps: it holds each amplitude until the next."""
    starts = np.arange(len(amplitudes)) * step_s
    ends = np.append(starts[1:], max(duration_s, starts[-1] + 1e-6))
    times = np.stack([starts, ends], axis=1).ravel()
    return HapticClip(Curve(times, np.repeat(amplitudes, 2)))
