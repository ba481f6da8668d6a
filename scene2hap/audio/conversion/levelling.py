"""Vibration of any length, equalized for an actuator and scaled to the level of its source."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import IO

import numpy as np

from scene2hap.audio.actuators import is_flat
from scene2hap.audio.conversion.clips import one_period
from scene2hap.audio.conversion.equalizer import Equalizer
from scene2hap.audio.conversion.felt_level import FeltLevel
from scene2hap.audio.conversion.meter import Block
from scene2hap.audio.conversion.reading import BLOCK_FRAMES, SoundReader
from scene2hap.audio.levels import NOTHING_DB, TACTILE_HEADROOM_DB, is_noise, sensation_level_db
from scene2hap.audio.protocol import ConversionContext
from scene2hap.haptics import ActuatorProfile

_END_S = 0.01
"""Length of the fade-out at the end of a file [s]; a sound that breaks off would end with a knock."""


def levelled(
    blocks: Iterator[Block], sound: SoundReader, context: ConversionContext, held: IO[bytes], *, is_chosen: bool
) -> tuple[Iterator[Block], float | None]:
    """Equalize a vibration, end it, and scale it to the level of its source, or to the peak limit if that is lower.

    A sound fades out. The end of a loop meets its beginning, and the frames around it are dropped.

    Returns the blocks, and the sensation level [dB]; None if the vibration is nothing, or noise (`is_noise`), which is
    not scaled. All blocks go through the temporary file `held`, since the gain follows from the whole sound.
    """
    felt = FeltLevel(sound.rate, sound.channels, context.actuator)
    if not is_flat(context.actuator):
        blocks = _equalized(blocks, sound, context.actuator)
    ended = _looped(blocks, sound) if sound.n_around else _faded_out(blocks, max(1, round(_END_S * sound.rate)))
    for block in ended:
        felt.add(block)
        held.write(np.ascontiguousarray(block).data)
    now_db = felt.level_db()
    if now_db <= NOTHING_DB or is_noise(sound.meter.peak * sound.gain, felt.peak, is_chosen=is_chosen):
        return _scaled(held, sound.channels, 1.0), None
    asked_db = sensation_level_db(context.intensity)
    gain = min(10 ** ((asked_db - now_db) / 20), 10 ** (-TACTILE_HEADROOM_DB / 20) / felt.peak)
    return _scaled(held, sound.channels, gain), now_db + 20 * math.log10(gain)


def _scaled(held: IO[bytes], channels: int, gain: float) -> Iterator[Block]:
    held.seek(0)
    while len(part := np.frombuffer(held.read(4 * BLOCK_FRAMES * channels), dtype=np.float32)):
        yield part.reshape(-1, channels) * np.float32(gain)


def _looped(blocks: Iterator[Block], sound: SoundReader) -> Iterator[Block]:
    felt = np.concatenate([*blocks])
    yield np.stack([one_period(channel, sound.n_around, sound.rate) for channel in felt.T], axis=1)


def _faded_out(blocks: Iterator[Block], n_frames: int) -> Iterator[Block]:
    """Yield the blocks, of which at least one has frames, with a fade-out over the last frames."""
    last = next(blocks)
    for block in blocks:
        # Only a short block is copied.
        after = block if len(block) >= n_frames else np.concatenate([last, block])
        if after is block:
            yield last
        yield after[:-n_frames]
        last = after[-n_frames:].copy()
    yield last[:-n_frames]
    end = last[-n_frames:]
    yield end * (0.5 + 0.5 * np.cos(np.pi * np.arange(1, len(end) + 1) / len(end))).astype(np.float32)[:, None]


def _equalized(blocks: Iterator[Block], sound: SoundReader, actuator: ActuatorProfile) -> Iterator[Block]:
    equalizer = Equalizer(actuator, sound.rate, sound.channels)
    for block in blocks:
        yield equalizer.process(block)
    yield equalizer.finish()
