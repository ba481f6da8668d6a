"""Conversion of a whole clip in memory: as if the sound had started earlier, or as a loop that is repeated for ever.

A converter gets more sound than the clip, so that its filters have settled when the clip starts. A loop is continued by
its own repetitions on both sides. One period of the output is kept, and the repetition after its end fades into its
beginning.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from scene2hap.audio.clip import AudioClip, Samples
from scene2hap.audio.protocol import ConversionContext, TactileConverter, one_channel, opened_stream, require_in_step
from scene2hap.audio.seam import Seam, apply_seam
from scene2hap.common.arrays import Floats32

PRE_ROLL_S = 1.0
"""Length of the pre-roll before the clip [s]: a band-pass with Q = 100 at 250 Hz settles to -68 dB in it."""
_FADE_S = 0.02
"""Length of the cross-fade of a loop [s]. The oscillator of a converter may have another phase after the end than at
the beginning, and opposed waves cancel each other in a fade: the level of 30 ms falls by up to 7 dB, with 0.2 s by
15."""


def convert_clip(
    clip: AudioClip, converter: TactileConverter, context: ConversionContext, *, from_rest: bool = False
) -> AudioClip:
    """Convert a clip to its tactile counterpart: same length, rate and credit, not scaled.

    The beginning of the clip, mirrored in time and without its offset, is converted first, so that filters have settled
    when the clip starts. With `from_rest`, the clip begins at 0: silence is converted first, and nothing is subtracted.
    Raises: AudioError: the converter returns more or fewer samples than it was given.
    """
    n_before = min(round(PRE_ROLL_S * clip.sample_rate_hz), len(clip.samples) - 1)
    if from_rest:
        fed = np.pad(clip.samples, (n_before, 0))
    else:
        offset = clip.samples.mean(dtype=np.float64).astype(np.float32)
        fed = np.pad(clip.samples - offset, (n_before, 0), mode="reflect")
    stream = opened_stream(converter, clip.sample_rate_hz, context)
    felt = np.concatenate([one_channel(converter, stream.process(fed)), one_channel(converter, stream.finish())])
    require_in_step(converter, len(felt), len(fed))
    return replace(clip, samples=felt[n_before:])


def convert_loop(loop: AudioClip, converter: TactileConverter, context: ConversionContext) -> Samples:
    """Convert a clip that repeats as it is. Returns: one period of the vibration (n,). Raises: as `convert_clip`."""
    n_around = round(PRE_ROLL_S * loop.sample_rate_hz)
    repeated = replace(loop, samples=with_repetitions(loop.samples, n_around), loop=None)
    return one_period(convert_clip(repeated, converter, context).samples, n_around, loop.sample_rate_hz)


def with_repetitions(loop: Floats32, n_around: int) -> Floats32:
    """Return a loop (n, ...) with `n_around` frames of its repetitions before and after it (n + 2 n_around, ...)."""
    return np.take(loop, np.arange(-n_around, len(loop) + n_around), axis=0, mode="wrap")


def one_period(felt: Samples, n_around: int, sample_rate_hz: int) -> Samples:
    """Return the loop (n,) in the conversion of `with_repetitions` (n + 2 n_around,); its end meets its beginning."""
    n = len(felt) - 2 * n_around
    seam = Seam(n_around, n, min(n // 2, round(_FADE_S * sample_rate_hz)), "linear")
    return apply_seam(felt, seam.fitted(felt))
