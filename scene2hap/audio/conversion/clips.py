"""Conversion of a whole clip, with a pre-roll, as if the sound had started earlier."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from scene2hap.audio.clip import AudioClip
from scene2hap.audio.protocol import ConversionContext, TactileConverter, one_channel, opened_stream, require_in_step

PRE_ROLL_S = 1.0
"""Length of the pre-roll before the clip [s]: a band-pass with Q = 100 at 250 Hz settles to -68 dB in it."""


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
