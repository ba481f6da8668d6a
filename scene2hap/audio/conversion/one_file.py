"""Conversion of one sound file, block by block, so that memory does not grow with its length.

The converter gets the sound without its offset. Its output is equalized for the actuator and scaled to the level of the
source, as the loops of a scene are (`scene_loops`). The level is known at the end only, so the vibration is stored in a
temporary file until then.
"""

from __future__ import annotations

import time
from collections.abc import Iterator, Sequence
from contextlib import nullcontext
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryFile

import numpy as np

from scene2hap.audio.actuators import actuator_profile
from scene2hap.audio.clip import Samples
from scene2hap.audio.conversion.kept_memory import keep_freed_memory
from scene2hap.audio.conversion.levelling import levelled
from scene2hap.audio.conversion.meter import Block, Meter
from scene2hap.audio.conversion.reading import SoundReader
from scene2hap.audio.conversion.writing import FORMATS, check_target, opened_for_writing, write_blocks, written_whole
from scene2hap.audio.felt_component import felt_component_of
from scene2hap.audio.files import Mixdown, opened_sound
from scene2hap.audio.levels import FAINTEST_PEAK_DB, FULL_LEVEL_DB, sensation_level_db
from scene2hap.audio.loop_marks import is_marked_whole, with_loop
from scene2hap.audio.protocol import (
    ConversionContext,
    TactileConverter,
    TactileStream,
    follows_component,
    follows_target,
    one_channel,
    opened_stream,
    require_in_step,
)
from scene2hap.audio.sensation import LevelWarning, Sensation, level_doubt
from scene2hap.audio.tactile import CONVERTERS, DEFAULT_CONVERTER
from scene2hap.common import checks
from scene2hap.common.blas_threads import one_blas_thread
from scene2hap.common.warning import warn_of
from scene2hap.errors import AudioError, ConfigError

_PICTURE_COLUMNS = 900


@dataclass(frozen=True)
class Conversion:
    """Result of converting a file. Peaks are absolute samples [re full scale], before clipping.

    `n_clipped` samples were beyond full scale and were written as full scale. `level_db` is the sensation level of the
    vibration [dB]; the head-room may keep it below `asked_level_db`. It is None for silence, for `raw`, and if sound or
    vibration are only the noise of a recording (`levels.is_noise`), which is not amplified. `frequency_in_hz`
    is the highest peak of the mean power spectrum of all channels, 10 Hz to 20 kHz. `frequency_out_hz` is the peak of
    the vibration that is farthest over the threshold of touch, 10 Hz to 1 kHz, as in a bundle. Both are None for
    silence. `picture` is None if none was drawn. `is_loop` : it repeats without a gap.
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
    is_loop: bool = False

    @property
    def level_doubt(self) -> str:
        """The sentence that says by how much the planned level is missed, or why it was not set; empty within
        `NOTICED_DB`, for an intensity of 1, for `raw` and for digital silence."""
        if self.asked_level_db is None or self.peak_in == 0.0:
            return ""
        if self.level_db is not None:
            if self.asked_level_db == FULL_LEVEL_DB:  # as strong as possible, and so it is
                return ""
            return level_doubt(str(self.output), self.level_db, self.asked_level_db)
        if self.peak_in < 10 ** (FAINTEST_PEAK_DB / 20):
            return (
                f"{self.output} keeps its level: {self.source} peaks below {FAINTEST_PEAK_DB:g} dB re full scale, as "
                "the noise of a recording does. If it is no noise, raise its level first."
            )
        return (
            f"{self.output} is not felt: the converter leaves nothing of {self.source} but noise. Choose another "
            "converter, such as 'auto'."
        )


@one_blas_thread
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
    loop: bool | None = None,
) -> Conversion:
    """Convert a sound file to a tactile one of the same length and rate; written whole or not at all.

    Parameters:
    source : WAV, FLAC, Ogg, MP3, AIFF, AU, CAF or Opus of any length; silence packed into few bytes is refused.
    output : its suffix (`FORMATS`) chooses the format.
    converter : a kind, a mapping with a `kind` and its settings, or an instance; each channel gets its own stream.
    actuator : a profile, its name, or a CSV file of its response, which is compensated; intensity : of the source,
    above 0 [-], which sets the sensation level (`sensation_level_db`); 1 is as strong as the sound and the actuator
    allow, up to 31 dB.
    mono : mix the channels by their mean first, or take the strongest if they cancel each other; overwrite : replace
    files that exist.
    picture : a PNG to draw: spectrograms before and after, and both envelopes; raw : apply the converter alone, without
    removal of the offset, equalization and scaling.
    loop : the sound is a loop of 0.1 to 60 s, and so is the result, which a WAV marks (chunk "smpl"); None if a WAV
    marks all of itself as one. Otherwise the last 10 ms fade out.
    Warns: LevelWarning: the level of an intensity below 1 is missed by more than `NOTICED_DB`, or nothing of the sound
    is felt.
    Raises: ConfigError: settings that cannot work. AudioError: `source` cannot be read, holds a sample that is not
    finite, or is too short or long for a loop; `output` exists or cannot be written; or the converter changes the
    length.
    """
    begin = time.perf_counter()
    keep_freed_memory()
    source, output, drawn = Path(source), Path(output), None if picture is None else Path(picture)
    built, context = settled(converter, actuator, intensity)
    if raw and loop:
        raise ConfigError("raw=True applies the converter alone, so that no loop is closed; leave out raw or loop.")
    check_target(source, output, FORMATS, overwrite=overwrite)
    if drawn is not None:
        check_target(source, drawn, [".png"], overwrite=overwrite)
    n_columns = 0 if drawn is None else _PICTURE_COLUMNS
    level_db, asked_db = None, None if raw else sensation_level_db(context.intensity)
    with opened_sound(source) as file, written_whole(output) as beside:
        is_loop = not raw and (is_marked_whole(source, file.frames, file.samplerate) if loop is None else loop)
        sound = SoundReader(source, file, mono=mono, n_columns=n_columns, is_loop=is_loop)
        if not raw and follows_target(built):
            context = _with_own_frequency(sound, context)
        streams = _opened_streams(source, built, sound, context)
        before = sound.meter
        after = Meter(sound.rate, sound.channels, n_frames=before.n_expected, n_columns=n_columns)
        blocks = _converted(sound.blocks() if raw else sound.blocks_to_convert(), built, streams)
        with (
            opened_for_writing(output, beside, sound.rate, sound.channels, before.n_expected) as target,
            nullcontext() if raw else TemporaryFile(dir=output.parent) as held,
        ):
            if held is not None:
                is_chosen = follows_component(built, context)
                blocks, level_db = levelled(blocks, sound, context, held, is_chosen=is_chosen)
            n_clipped = write_blocks(target, blocks, after, output, beside)
        if is_loop and target.format == "WAV":
            beside.write_bytes(with_loop(beside.read_bytes(), 0, after.n_frames, sound.rate))
        if drawn is not None:
            from scene2hap.audio.conversion.picture import draw_conversion

            title = f"{source.name} through {type(built).__name__}"
            felt = None if level_db is None or asked_db is None else Sensation.of(level_db, asked_db, built, context)
            if felt is not None and (most_hz := after.most_felt_hz(context.actuator)) is not None:
                felt = felt.felt_at(most_hz)
            with written_whole(drawn) as picture_beside:
                draw_conversion(title, source, beside, (before, after), context.actuator, picture_beside, felt)
    made = Conversion(
        source=source,
        output=output,
        duration_s=before.n_frames / sound.rate,
        sample_rate_hz=sound.rate,
        channels=sound.channels,
        peak_in=before.peak,
        peak_out=after.peak,
        n_clipped=n_clipped + sum(getattr(stream, "n_clipped", 0) for stream in streams),
        frequency_in_hz=before.dominant_frequency_hz(),
        frequency_out_hz=after.most_felt_hz(context.actuator),
        elapsed_s=time.perf_counter() - begin,
        picture=drawn,
        level_db=level_db,
        asked_level_db=asked_db,
        is_loop=is_loop,
    )
    if made.level_doubt:
        warn_of(made.level_doubt, LevelWarning)
    return made


def settled(converter: object, actuator: object, intensity: float) -> tuple[TactileConverter, ConversionContext]:
    """Return the converter and its context. Raises: ConfigError: settings that cannot work."""
    built = CONVERTERS.build(converter)
    if not isinstance(built, TactileConverter):
        raise ConfigError(f"converter is {built!r}; it has no stream. Name a kind: {', '.join(CONVERTERS.kinds())}.")
    checks.number("intensity", intensity, "-", above=0.0, at_most=1.0, error=ConfigError)
    return built, ConversionContext(actuator_profile(actuator), intensity)


def _with_own_frequency(sound: SoundReader, context: ConversionContext) -> ConversionContext:
    """Return the context with the source's own frequency, found in the middle of the file; unchanged if none is found,
    so that the converter tracks the frequency."""
    channels, mixdown = sound.middle(), Mixdown()
    heard, strongest = mixdown.mean(channels), mixdown.strongest
    if strongest is not None:
        heard = channels[:, strongest].astype(np.float64)
    if len(heard) < 2 or not np.isfinite(heard).all():  # the conversion raises an error for this
        return context
    component = felt_component_of(heard, sound.rate, sensation_level_db(context.intensity), context.actuator)
    return context if component is None else component.added_to(context, component.carrier_hz)


def _opened_streams(
    source: Path, converter: TactileConverter, sound: SoundReader, context: ConversionContext
) -> list[TactileStream]:
    """Return a stream for each channel. Raises: ConfigError: no converter takes the sample rate."""
    try:
        return [opened_stream(converter, sound.rate, context) for _ in range(sound.channels)]
    except ConfigError as cause:
        raise ConfigError(f"{source}: {cause}") from cause


def _converted(
    blocks: Iterator[Block], converter: TactileConverter, streams: Sequence[TactileStream]
) -> Iterator[Block]:
    """Yield the output of the converter in blocks (n, channels); each channel has its own stream."""
    n_given = n_made = 0
    for block in blocks:
        n_given += len(block)
        felt = _stacked(converter, [stream.process(x) for stream, x in zip(streams, block.T, strict=True)])
        n_made += len(felt)
        yield felt
    rest = _stacked(converter, [stream.finish() for stream in streams])
    yield rest
    require_in_step(converter, n_made + len(rest), n_given)


def _stacked(converter: TactileConverter, channels: list[Samples]) -> Block:
    channels = [one_channel(converter, channel) for channel in channels]
    lengths = [*map(len, channels)]
    if len(set(lengths)) > 1:
        raise AudioError(f"{type(converter).__name__} made {lengths} samples of equal channels.")
    return np.stack(channels, axis=1).astype(np.float32, copy=False)
