"""Output files of a conversion: their formats, and the writing of blocks as 24-bit integers."""

from __future__ import annotations

import os
from collections.abc import Collection, Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import soundfile
from numpy.typing import NDArray

from scene2hap.audio.conversion.meter import Block, Meter
from scene2hap.audio.files import LARGEST_WAV_BYTES
from scene2hap.common.files import draft_of, path_in_c
from scene2hap.errors import AudioError, unwritable

FORMATS = {
    ".wav": ("WAV", "PCM_24"),
    ".flac": ("FLAC", "PCM_24"),
    ".ogg": ("OGG", "VORBIS"),
    ".mp3": ("MP3", "MPEG_LAYER_III"),
}
"""Format and coding of output files, by suffix; `audio.files.SUFFIXES` has those that are read."""

_FULL_SCALE = 2.0**23
_NEARLY_FULL = 1.0 - 1.0 / _FULL_SCALE


def check_target(source: Path, output: Path, suffixes: Collection[str], *, overwrite: bool) -> None:
    """Check the path of a file to write. Raises: AudioError."""
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


@contextmanager
def written_whole(path: Path) -> Iterator[Path]:
    """Yield a draft of a file, as `common.files.draft_of`. Raises: AudioError: the file cannot be written."""
    try:
        with draft_of(path) as beside:
            yield beside
    except OSError as cause:
        raise AudioError(unwritable(path, cause)) from cause


def opened_for_writing(
    output: Path, beside: Path, sample_rate_hz: int, channels: int, n_expected: int
) -> soundfile.SoundFile:
    """Open the draft `beside` of an output file of about `n_expected` frames. Raises: AudioError."""
    container, subtype = FORMATS[output.suffix.lower()]
    if container == "WAV" and 3 * channels * n_expected > LARGEST_WAV_BYTES:
        container = "RF64"
    beside.touch()  # unlike libsndfile, it names the reason of a failure
    try:
        return soundfile.SoundFile(path_in_c(beside), "w", sample_rate_hz, channels, subtype=subtype, format=container)
    except (soundfile.SoundFileError, ValueError) as cause:
        reason = getattr(cause, "error_string", cause)  # the whole text names the draft
        raise AudioError(
            f"{output}: cannot be written as {container} of {channels} channels at {sample_rate_hz} Hz ({reason}). "
            "Choose a folder that exists, is yours and has room, or WAV."
        ) from cause


def write_blocks(target: soundfile.SoundFile, blocks: Iterator[Block], meter: Meter, output: Path, beside: Path) -> int:
    """Measure and write all blocks, and close the file. Returns the number of samples beyond full scale.

    Raises: AudioError: the file cannot be written whole.
    """
    n_clipped = 0
    for block in blocks:
        meter.add(block)
        if meter.peak > 1.0:
            n_clipped += int(np.count_nonzero(np.abs(block) > 1.0))
        with _writing(output):
            target.write(_steps(block, is_beyond=meter.peak >= _NEARLY_FULL))
    with _writing(output):
        target.close()
        if soundfile.info(path_in_c(beside)).frames != meter.n_frames:  # libsndfile ignores a failure at the end
            raise soundfile.SoundFileRuntimeError("the file is cut short")
    return n_clipped


def _steps(block: Block, *, is_beyond: bool) -> NDArray[np.int32]:
    """Return 24-bit integers in the upper bits of int32, on the scale of `encoding.encoded`; clipped if `is_beyond`."""
    scaled = block * np.float32(_FULL_SCALE)
    np.rint(scaled, out=scaled)
    if is_beyond:
        np.clip(scaled, -_FULL_SCALE, _FULL_SCALE - 1.0, out=scaled)
    steps = scaled.astype(np.int32)
    return np.left_shift(steps, 8, out=steps)


@contextmanager
def _writing(output: Path) -> Iterator[None]:
    """Raises: AudioError: libsndfile cannot write, else `opened_sound` would take it for a fault of the sound read."""
    try:
        yield
    except soundfile.SoundFileError as cause:
        raise AudioError(
            f"{output} cannot be written ({cause}). Make room on its disk, or choose another folder."
        ) from cause
