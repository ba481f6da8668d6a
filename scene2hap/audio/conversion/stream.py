"""Conversion of one sound file, block by block, so that memory does not grow with its length.

The converter gets the sound without its offset. Its output is equalized for the actuator and scaled to the level of the
source, as the loops of a scene are (`felt_loop`). The level is known at the end only, so the vibration is stored in a
temporary file until then.
"""

from __future__ import annotations

import math
import os
import time
from collections.abc import Collection, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryFile
from typing import IO

import numpy as np
import soundfile
from numpy.typing import NDArray

from scene2hap.audio.actuators import actuator_profile, is_flat
from scene2hap.audio.anchor import anchor_of
from scene2hap.audio.conversion.equalizer import Equalizer
from scene2hap.audio.conversion.felt_level import FeltLevel
from scene2hap.audio.conversion.meter import Block, Meter
from scene2hap.audio.files import MAX_SAMPLE, Mixdown, opened_sound, require_finite, written_whole
from scene2hap.audio.haptic_loop import LevelWarning, Sensation, level_doubt
from scene2hap.audio.levels import NOTHING_DB, TACTILE_HEADROOM_DB, is_noise, sensation_level_db
from scene2hap.audio.protocol import (
    ConversionContext,
    TactileConverter,
    TactileStream,
    follows_anchor,
    one_channel,
    opened_stream,
    require_in_step,
)
from scene2hap.audio.tactile import CONVERTERS, DEFAULT_CONVERTER
from scene2hap.audio.tactile.sections import through_sections
from scene2hap.common import checks
from scene2hap.common.text_files import path_in_c
from scene2hap.common.warning import warn_of
from scene2hap.errors import AudioError, ConfigError

FORMATS = {
    ".wav": ("WAV", "PCM_24"),
    ".flac": ("FLAC", "PCM_24"),
    ".ogg": ("OGG", "VORBIS"),
    ".mp3": ("MP3", "MPEG_LAYER_III"),
}
"""Format and coding of output files, by suffix; `audio.files.SUFFIXES` has those that are read."""

BLOCK_FRAMES = 65_536
_FULL_SCALE = 2.0**23
_NEARLY_FULL = 1.0 - 1.0 / _FULL_SCALE
_PICTURE_COLUMNS = 900
_OFFSET_FRAMES = 65_536
_END_S = 0.01
"""Length of the fade-out at the end of a file [s]; a sound that breaks off would end with a knock."""
_LOOK_S = 10.0
"""Length of the part of a file in which the source's own frequency is searched, before the conversion [s]."""
_SLOWEST_HZ = 1.0
"""Cut-off below which a component counts as offset; its removal costs 0.04 dB at 10 Hz, where touch begins."""
_LARGEST_WAV_BYTES = 0xFFFF_0000
"""Lengths in a WAV header have 32 bits. Longer files become RF64 (EBU Tech 3306), which most programs read."""


@dataclass(frozen=True)
class Conversion:
    """Result of converting a file. Peaks are absolute samples [re full scale], before clipping.

    `n_clipped` samples were beyond full scale and were written as full scale. `level_db` is the sensation level of the
    vibration [dB]; the head-room may keep it below `asked_level_db`. It is None for silence, for `raw`, and if sound or
    vibration are only the noise of a recording (`levels.is_noise`), which is not amplified. Dominant frequencies are
    those of the mean power spectrum of all channels, 10 Hz to 20 kHz; None for silence. `picture` is None if none was
    drawn.
    """

    source: Path
    output: Path
    duration_s: float
    sample_rate_hz: int
    channels: int
    peak_in: float
    peak_out: float
    n_clipped: int
    frequency_in_hz: float | None
    frequency_out_hz: float | None
    elapsed_s: float
    picture: Path | None = None
    level_db: float | None = None
    asked_level_db: float | None = None

    @property
    def level_doubt(self) -> str:
        """The sentence that says by how much the planned level is missed; empty within `NOTICED_DB`."""
        if self.level_db is None:
            return ""
        return level_doubt(str(self.output), self.level_db, self.asked_level_db or 0.0)


def convert(
    source: str | Path,
    output: str | Path,
    *,
    converter: object = DEFAULT_CONVERTER,
    actuator: object = "flat",
    intensity: float = 1.0,
    mono: bool = False,
    overwrite: bool = False,
    picture: str | Path | None = None,
    raw: bool = False,
) -> Conversion:
    """Convert a sound file to a tactile one of the same length and rate; written whole or not at all.

    Parameters:
    source : WAV, FLAC, Ogg, MP3, AIFF, AU, CAF or Opus of any length; silence packed into few bytes is refused.
    output : its suffix (`FORMATS`) chooses the format.
    converter : a kind, a mapping with a `kind` and its settings, or an instance; each channel gets its own stream.
    actuator : a profile, its name, or a CSV file of its response, which is compensated; intensity : of the source, 0..1
    [-], which sets the sensation level (`sensation_level_db`).
    mono : mix the channels by their mean first, or take the strongest if they cancel each other; overwrite : replace
    files that exist.
    picture : a PNG to draw: spectrograms before and after, and both envelopes; raw : apply the converter alone, without
    removal of the offset, equalization and scaling.
    Warns: LevelWarning: the planned level is missed by more than `NOTICED_DB`.
    Raises: ConfigError: settings that cannot work. AudioError: `source` cannot be read or holds a sample that is not
    finite, `output` exists or cannot be written, or the converter changes the length.
    """
    begin = time.perf_counter()
    source, output = Path(source), Path(output)
    built, context = settled(converter, actuator, intensity)
    drawn = Path(picture) if picture is not None else None
    _check_target(source, output, FORMATS, overwrite=overwrite)
    if drawn is not None:
        _check_target(source, drawn, [".png"], overwrite=overwrite)
    with opened_sound(source) as file, written_whole(output) as beside:
        if not raw and getattr(built, "follows_target", False):
            context = _looked_at(file, context)
        only = _strongest_of_cancelled(file) if mono else None
        n_columns = _PICTURE_COLUMNS if drawn else 0
        try:
            felt = _Running(built, context, file, mono=mono, only=only, raw=raw, n_columns=n_columns)
        except ConfigError as cause:  # a sample rate that no converter takes
            raise ConfigError(f"{source}: {cause}") from cause
        blocks = felt.blocks(source, file)
        with _opened_for_writing(output, beside, felt) as target, ExitStack() as held:
            if not raw:
                blocks = _at_level(blocks, felt, context, held.enter_context(TemporaryFile(dir=output.parent)))
            for block in blocks:
                felt.hear_after(block)
                with _writing(output):
                    target.write(_steps(block, is_beyond=felt.after.peak >= _NEARLY_FULL))
            with _writing(output):
                target.close()
                if (
                    soundfile.info(path_in_c(beside)).frames != felt.after.n_frames
                ):  # libsndfile ignores a failure at the end
                    raise soundfile.SoundFileRuntimeError("the file is cut short")
        if drawn is not None:
            from scene2hap.audio.conversion.picture import draw_conversion

            with written_whole(drawn) as picture_beside:
                title = f"{source.name} through {type(built).__name__}"
                meters, sensation = (felt.before, felt.after), felt.sensation(context)
                draw_conversion(title, source, beside, meters, context.actuator, picture_beside, sensation)
    made = Conversion(
        source,
        output,
        felt.before.n_frames / felt.rate,
        felt.rate,
        felt.channels,
        felt.before.peak,
        felt.after.peak,
        felt.n_clipped,
        felt.before.dominant_frequency_hz(),
        felt.after.dominant_frequency_hz(),
        time.perf_counter() - begin,
        drawn,
        felt.level_db,
        None if raw else sensation_level_db(context.intensity),
    )
    if made.level_doubt:
        warn_of(made.level_doubt, LevelWarning)
    return made


def _looked_at(file: soundfile.SoundFile, context: ConversionContext) -> ConversionContext:
    """Return the context with the source's own frequency, found in the middle of the file; unchanged if none is found,
    so that the converter tracks the frequency."""
    channels, mixdown = _middle(file), Mixdown()
    heard, strongest = mixdown.mean(channels), mixdown.strongest
    if strongest is not None:
        heard = channels[:, strongest].astype(np.float64)
    if len(heard) < 2 or not np.isfinite(heard).all():  # the conversion raises an error for this
        return context
    anchor = anchor_of(heard, file.samplerate, sensation_level_db(context.intensity), context.actuator)
    return context if anchor is None else anchor.within(context, anchor.carrier_hz)


def _strongest_of_cancelled(file: soundfile.SoundFile) -> int | None:
    """Return the strongest channel, if the channels cancel each other in the middle of the file; else None."""
    mixdown = Mixdown()
    mixdown.mean(_middle(file))
    return mixdown.strongest


def _middle(file: soundfile.SoundFile) -> Block:
    """Return the middle of a file (n, n_channels), at most `_LOOK_S`."""
    n = round(_LOOK_S * file.samplerate)
    file.seek(max(0, int(file.frames) - n) // 2)
    channels: Block = file.read(n, dtype="float32", always_2d=True)
    file.seek(0)
    return channels


def settled(converter: object, actuator: object, intensity: float) -> tuple[TactileConverter, ConversionContext]:
    """Return the converter and its context. Raises: ConfigError: settings that cannot work."""
    built = CONVERTERS.build(converter)
    if not isinstance(built, TactileConverter):
        raise ConfigError(f"converter is {built!r}; it has no stream. Name a kind: {', '.join(CONVERTERS.kinds())}.")
    checks.number("intensity", intensity, "-", above=0.0, at_most=1.0, error=ConfigError)
    return built, ConversionContext(actuator_profile(actuator), intensity)


class _Running:
    """A running conversion: a stream for each channel, a meter for the sound and one for the vibration."""

    def __init__(
        self,
        converter: TactileConverter,
        context: ConversionContext,
        file: soundfile.SoundFile,
        *,
        mono: bool,
        only: int | None,
        raw: bool,
        n_columns: int,
    ) -> None:
        self.rate = int(file.samplerate)
        self.channels = 1 if mono else int(file.channels)
        self.level_db: float | None = None
        self._n_clipped = self._n_made = 0
        self.before, self.after = (
            Meter(self.rate, self.channels, n_frames=int(file.frames), n_columns=n_columns) for _ in range(2)
        )
        self._raw = raw
        self.follows_anchor = follows_anchor(converter, context)
        self._converter = converter
        self._mono, self._only = mono, only
        self._streams: list[TactileStream] = [
            opened_stream(converter, self.rate, context) for _ in range(self.channels)
        ]

    def blocks(self, source: Path, file: soundfile.SoundFile) -> Iterator[Block]:
        """Yield the output of the converter in blocks (n, channels)."""
        stated, n_read = int(file.frames), 0
        offset = None if self._raw else _OffsetFilter(self.rate, self._offsets(file))
        while len(block := file.read(BLOCK_FRAMES, dtype="float32", always_2d=True)):
            with np.errstate(over="ignore"):  # of samples that are refused below
                if self._mono and block.shape[1] > 1:
                    block = self._mixed(block)
                self.before.hear(block)
            if not self.before.peak <= MAX_SAMPLE:
                require_finite(source, block, n_read)
            n_read += len(block)
            rows = block.T if offset is None else offset.filtered_rows(block)
            yield self._felt([stream.process(x) for stream, x in zip(self._streams, rows, strict=True)])
        if n_read == 0:
            raise AudioError(f"{source} has no samples. Use a sound that is longer than 0 s.")
        if n_read < stated and file.format != "MP3":  # the length of an MP3 is an estimate
            raise AudioError(f"{source} is cut short: {n_read} of {stated} frames. Copy it again.")
        yield self._felt([stream.finish() for stream in self._streams])
        require_in_step(self._converter, self._n_made, n_read)

    def _offsets(self, file: soundfile.SoundFile) -> list[float]:
        """Return the offset of each channel at the beginning of the file."""
        head = file.read(_OFFSET_FRAMES, dtype="float32", always_2d=True)
        file.seek(0)
        if not len(head) or not np.isfinite(head).all():  # the conversion raises an error for this
            return [0.0] * self.channels
        mixed = self._mixed(head) if self._mono else head
        offsets: list[float] = mixed.mean(axis=0, dtype=np.float64).tolist()
        return offsets

    def _mixed(self, block: Block) -> Block:
        """Return the mean of the channels, or the one that stands for all, as (n, 1)."""
        if self._only is not None:
            return np.ascontiguousarray(block[:, self._only, None])
        mean: Block = block.mean(axis=1, keepdims=True, dtype=np.float32)
        return mean

    def _felt(self, channels: list[NDArray[np.float32]]) -> Block:
        channels = [one_channel(self._converter, channel) for channel in channels]
        lengths = [*map(len, channels)]
        if len(set(lengths)) > 1:
            raise AudioError(f"{type(self._converter).__name__} made {lengths} samples of equal channels.")
        self._n_made += len(channels[0])
        return np.stack(channels, axis=1).astype(np.float32, copy=False)

    def hear_after(self, block: Block) -> None:
        """Measure a block of the output."""
        self.after.hear(block)
        if self.after.peak > 1.0:
            self._n_clipped += int(np.count_nonzero(np.abs(block) > 1.0))

    def sensation(self, context: ConversionContext) -> Sensation | None:
        """Return how the vibration is felt, None if it was not scaled to a level."""
        if self.level_db is None:
            return None
        own_hz, target_hz = context.own_hz, context.target_hz or context.own_hz
        asked_db = sensation_level_db(context.intensity)
        return Sensation(self.level_db, asked_db, own_hz, target_hz, context.rough_hz)

    @property
    def n_clipped(self) -> int:
        """The number of samples that were clipped to full scale, by the streams or on writing."""
        return self._n_clipped + sum(getattr(stream, "n_clipped", 0) for stream in self._streams)


class _OffsetFilter:
    """Removes the offset of a recording: a high-pass that starts at the offset of each channel's beginning."""

    def __init__(self, sample_rate_hz: int, at_first: list[float]) -> None:
        share = 1.0 / (1.0 + 2.0 * math.pi * _SLOWEST_HZ / sample_rate_hz)
        self._section = np.array([[share, -share, 0.0, 1.0, -share, 0.0]])
        self._state = np.zeros((1, len(at_first), 2))
        self._state[0, :, 0] = -share * np.array(at_first)

    def filtered_rows(self, block: Block) -> NDArray[np.float32]:
        """Return the next frames (n, channels) without the offset, as rows (channels, n)."""
        rows = np.ascontiguousarray(block.T, dtype=np.float64)
        return through_sections(self._section, rows, self._state).astype(np.float32)


def _at_level(blocks: Iterator[Block], felt: _Running, context: ConversionContext, held: IO[bytes]) -> Iterator[Block]:
    """Yield the blocks, equalized and scaled to the level of their source, or to the peak limit if that is lower.

    All blocks go through the temporary file `held`, since the gain follows from the whole sound.
    """
    heard = FeltLevel(felt.rate, felt.channels, context.actuator)
    played = blocks if is_flat(context.actuator) else _equalized(blocks, felt, context)
    for block in _faded_out(played, max(1, round(_END_S * felt.rate))):
        heard.hear(block)
        held.write(np.ascontiguousarray(block).data)
    now_db, gain = heard.level_db(), 1.0
    if now_db > NOTHING_DB and not is_noise(felt.before.peak, heard.peak, is_chosen=felt.follows_anchor):
        asked_db = sensation_level_db(context.intensity)
        gain = min(10 ** ((asked_db - now_db) / 20), 10 ** (-TACTILE_HEADROOM_DB / 20) / heard.peak)
        felt.level_db = now_db + 20 * math.log10(gain)
    held.seek(0)
    while len(part := np.frombuffer(held.read(4 * BLOCK_FRAMES * felt.channels), dtype=np.float32)):
        yield part.reshape(-1, felt.channels) * np.float32(gain)


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


def _equalized(blocks: Iterator[Block], felt: _Running, context: ConversionContext) -> Iterator[Block]:
    equalizers = [Equalizer(context.actuator, felt.rate) for _ in range(felt.channels)]
    for block in blocks:
        yield np.stack([one.process(block[:, i]) for i, one in enumerate(equalizers)], axis=1)
    yield np.stack([one.finish() for one in equalizers], axis=1)


def _steps(block: Block, *, is_beyond: bool) -> NDArray[np.int32]:
    """Return 24-bit integers in the upper bits of int32, on the scale of `files.write_wav`; clipped if `is_beyond`."""
    scaled = block * np.float32(_FULL_SCALE)
    np.rint(scaled, out=scaled)
    if is_beyond:
        np.clip(scaled, -_FULL_SCALE, _FULL_SCALE - 1.0, out=scaled)
    steps = scaled.astype(np.int32)
    return np.left_shift(steps, 8, out=steps)


def _opened_for_writing(output: Path, beside: Path, felt: _Running) -> soundfile.SoundFile:
    container, subtype = FORMATS[output.suffix.lower()]
    n_bytes = 3 * felt.channels * felt.before.n_expected
    if container == "WAV" and n_bytes > _LARGEST_WAV_BYTES:
        container = "RF64"
    beside.touch()  # unlike libsndfile, it names the reason of a failure
    try:
        return soundfile.SoundFile(path_in_c(beside), "w", felt.rate, felt.channels, subtype=subtype, format=container)
    except (soundfile.SoundFileError, ValueError) as cause:
        reason = getattr(cause, "error_string", cause)  # the whole text names the draft
        raise AudioError(
            f"{output}: cannot be written as {container} of {felt.channels} channels at {felt.rate} Hz ({reason}). "
            "Choose a folder that exists, is yours and has room, or WAV."
        ) from cause


@contextmanager
def _writing(output: Path) -> Iterator[None]:
    """Raises: AudioError: libsndfile cannot write, else `opened_sound` would take it for a fault of the sound read."""
    try:
        yield
    except soundfile.SoundFileError as cause:
        raise AudioError(
            f"{output} cannot be written ({cause}). Make room on its disk, or choose another folder."
        ) from cause


def _check_target(source: Path, output: Path, suffixes: Collection[str], *, overwrite: bool) -> None:
    if output.suffix.lower() not in suffixes:
        known = ", ".join(suffixes)
        raise AudioError(
            f"{output} has no suffix of a known format; it must end in one of {known}, or be a folder that exists."
        )
    if os.path.exists(output) and os.path.exists(source) and output.samefile(source):
        raise AudioError(f"{output} is the sound itself. Choose another name for what is made of it.")
    if os.path.isdir(output):
        raise AudioError(f"{output} is a folder. Choose another name.")
    if os.path.exists(output) and not overwrite:
        raise AudioError(f"{output} exists. Choose another name, or allow overwriting (overwrite=True, --force).")
