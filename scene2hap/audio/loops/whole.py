"""A hand-made clip as a loop: all of it, closed where its last cycle ends."""

from __future__ import annotations

import numpy as np

from scene2hap.audio.clip import Samples

_LAST_CYCLE_S = 0.025
"""Where the end of the last cycle is looked for; assumed: nobody feels a clip as shorter by one cycle at 40 Hz."""
_FADE_S = 0.005
_AT_REST = 1e-3
"""Of the peak: below, the clip has ended by itself."""


def whole_loop(samples: Samples, sample_rate_hz: float) -> Samples:
    """The clip (n,) without the rest of its last cycle, so that its beginning continues it; (m,), m <= n.

    A clip begins at a rising zero, as one that was synthesized from curves does. One that ends at rest is left alone,
    and one without such a zero near its end is faded out.
    """
    n_last = min(len(samples) // 2, round(_LAST_CYCLE_S * sample_rate_hz))
    tail = samples[len(samples) - n_last :]
    if n_last < 2 or np.abs(tail).max() <= _AT_REST * np.abs(samples).max():
        return samples
    rising = np.flatnonzero((tail[:-1] <= 0.0) & (tail[1:] > 0.0))
    if rising.size:
        # The zero lies between two samples; the one nearer to it is where the clip begins again.
        k = int(rising[-1])
        return samples[: len(samples) - n_last + k + int(tail[k + 1] < -tail[k])].copy()
    faded = samples.copy()
    n_fade = max(2, round(_FADE_S * sample_rate_hz))
    faded[-n_fade:] *= np.linspace(1.0, 0.0, n_fade, dtype=np.float32)
    return faded
