"""Loops of whole clips: a hand-made clip, closed at the end of its last cycle, and a sound between silences."""

from __future__ import annotations

import numpy as np

from scene2hap.audio.clip import Samples

_LAST_CYCLE_S = 0.025
"""Stretch at the end in which the last cycle may end [s] (assumed: the loss of one cycle at 40 Hz is not felt)."""
_FADE_S = 0.005
_AT_REST = 1e-3
"""Share of the peak below which the end of a clip counts as at rest [-]."""
_SILENCE_S = 0.2
"""Least silence at the end of a sound that repeats as a whole [s]: the length of the fade of a seam."""


def whole_loop(samples: Samples, sample_rate_hz: float) -> Samples:
    """Cut a clip (n,) at the end of its last whole cycle, so that its beginning follows it. Returns: (m,), m <= n.

    The clip must begin at a rising zero crossing, as one synthesized from curves does. A clip that ends at rest is
    unchanged. A clip without a rising zero crossing near its end is faded out.
    """
    n_last = min(len(samples) // 2, round(_LAST_CYCLE_S * sample_rate_hz))
    tail = samples[len(samples) - n_last :]
    if n_last < 2 or np.abs(tail).max() <= _AT_REST * np.abs(samples).max():
        return samples
    rising = np.flatnonzero((tail[:-1] <= 0.0) & (tail[1:] > 0.0))
    if rising.size:
        # The zero crossing lies between two samples. The loop ends at the nearer one.
        k = int(rising[-1])
        return samples[: len(samples) - n_last + k + int(tail[k + 1] < -tail[k])].copy()
    faded = samples.copy()
    n_fade = max(2, round(_FADE_S * sample_rate_hz))
    faded[-n_fade:] *= np.linspace(1.0, 0.0, n_fade, dtype=np.float32)
    return faded


def is_between_silences(samples: Samples, sample_rate_hz: float) -> bool:
    """Return True if a sound (n,) ends in silence at the level of its first sample, so that it repeats without a seam.

    A level other than 0 is an offset of the recording.
    """
    moved = np.abs(samples - samples[0])
    n_tail = round(_SILENCE_S * sample_rate_hz)
    return n_tail < len(moved) and float(moved[len(moved) - n_tail :].max()) <= _AT_REST * float(moved.max())


def meets_itself(samples: Samples) -> bool:
    """Return True if the last sample of a sound (n,) is followed by the first without a step."""
    return abs(float(samples[0]) - float(samples[-1])) <= _AT_REST * float(np.abs(samples).max(initial=0.0))
