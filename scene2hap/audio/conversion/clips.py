"""A whole clip through a converter, as if the sound had been going on before."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from scene2hap.audio.clip import AudioClip
from scene2hap.audio.protocol import ConversionContext, TactileConverter, one_channel, opened_stream
from scene2hap.errors import AudioError

PRE_ROLL_S = 1.0
"""How much is played in before the clip; long enough for a band-pass of Q = 100 at 250 Hz to settle to -68 dB."""


def convert_clip(clip: AudioClip, converter: TactileConverter, context: ConversionContext) -> AudioClip:
    """The tactile counterpart of a clip: equally long, same rate and credit, not scaled.

    The beginning of the clip, mirrored in time, is played in first, so that filters are settled when it starts; its
    offset, which is no sound, is not.
    Raises: AudioError: the converter returns more or fewer samples than it was given.
    """
    n_before = min(round(PRE_ROLL_S * clip.sample_rate_hz), len(clip.samples) - 1)
    fed = np.concatenate([clip.samples[n_before:0:-1], clip.samples])
    fed -= clip.samples.mean(dtype=np.float64).astype(np.float32)
    stream = opened_stream(converter, clip.sample_rate_hz, context)
    felt = np.concatenate([one_channel(converter, stream.process(fed)), one_channel(converter, stream.finish())])
    if len(felt) != len(fed):
        raise AudioError(
            f"{type(converter).__name__} made {len(felt)} samples of {len(fed)}; touch must stay in step with sound. "
            "Its stream must return as many samples as it was given, counting finish()."
        )
    return replace(clip, samples=felt[n_before:])
