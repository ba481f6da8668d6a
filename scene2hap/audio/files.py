"""Sound files: their formats and limits, and how they are opened, read and mixed."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager, nullcontext
from pathlib import Path

import numpy as np
import soundfile

from scene2hap.audio.clip import AudioClip, Credit, Samples
from scene2hap.audio.loop_marks import marked_loop
from scene2hap.audio.riff import is_cut_short, unsized_wav
from scene2hap.common.arrays import Floats
from scene2hap.common.files import LFS_ADVICE, is_lfs_pointer, is_there, path_in_c
from scene2hap.errors import AudioError, reason_of

MAX_FILE_S = 600.0
"""Longer files are refused before they are decoded [s]; assumed: no sound of an object needs ten minutes, and a
damaged header may promise a thousand hours."""

MAX_FILE_SAMPLES, SAMPLES_PER_BYTE = 1 << 26, 16
"""Most samples of all channels together (assumed: ten minutes of stereo at 48 kHz, decoded in a second or two), and
further samples for each byte of the file (assumed: Ogg at 48 kbit/s has 7). A megabyte of FLAC may hold hours of
silence at 655 kHz."""
MAX_SAMPLE = 1e9
"""Largest sample of a file of floats, re full scale. Larger ones are damage, and their powers exceed float32; assumed:
twice the scale of programs that write integers of 30 bits as floats."""
_SUFFIXES_OF = {
    "WAV": (".wav", ".rf64", ".w64"),
    "FLAC": (".flac",),
    "Ogg": (".ogg", ".oga"),
    "MP3": (".mp3",),
    "AIFF": (".aif", ".aiff"),
    "AU": (".au",),
    "CAF": (".caf",),
    "Opus": (".opus",),
}
READABLE = " or ".join(", ".join(_SUFFIXES_OF).rsplit(", ", 1))
"""The formats of sound files, for messages."""
SUFFIXES: frozenset[str] = frozenset(suffix for suffixes in _SUFFIXES_OF.values() for suffix in suffixes)
"""Suffixes of sound files, by which they are found in folders. A file that is given by itself may have any suffix."""

MAX_CHANNELS = 64
"""Most channels: those of seventh-order ambisonics; each has a conversion stream of its own, which takes memory."""

CANCELLED = 0.1
"""Share of the power of unrelated channels' mean below which channels cancel each other (-10 dB; assumed)."""

LARGEST_WAV_BYTES = 0xFFFF_0000
"""Most bytes of samples in a WAV file, whose lengths have 32 bits. RF64 (EBU Tech 3306) holds more, and most programs
read it."""

_BLOCK_FRAMES = 1 << 18


def read_clip(path: str | Path, credit: Credit | None = None) -> AudioClip:
    """Read a sound file as a mono clip at its own rate. Any format of libsndfile with a header is read: see `READABLE`.

    Several channels are mixed by their mean; if they cancel each other, the strongest is taken (`Mixdown`).

    A loop that a WAV marks becomes the clip's `loop` (`loop_marks`).

    Without a `credit` the file's stem becomes the title, author and licence are "unknown".
    Raises: AudioError: the file is absent, is not audio, has no samples, a sample that is not finite, or more than
    `MAX_FILE_S`.
    """
    path = Path(path)
    with opened_sound(path) as file:
        rate, mixdown = int(file.samplerate), Mixdown()
        blocks = [mixdown.mean(block).astype(np.float32) for block in _blocks(path, file)]
        strongest = mixdown.strongest
        if strongest is not None:
            with opened_sound(path) as again:  # a Vorbis file that was cut cannot be rewound
                blocks = [
                    block[:, strongest].copy() for block in again.blocks(_BLOCK_FRAMES, dtype="float32", always_2d=True)
                ]
        samples = np.concatenate(blocks)
        loop = marked_loop(path, len(samples), rate)
    try:
        return AudioClip(samples, rate, credit or Credit(path.stem, "unknown", "unknown"), loop=loop)
    except AudioError as cause:
        raise AudioError(f"{path}: {cause}") from cause


def read_channels(path: str | Path) -> tuple[Samples, int]:
    """Return all channels of a sound file (n_samples, n_channels), and its rate [Hz]. Raises: AudioError: as
    `read_clip`."""
    path = Path(path)
    with opened_sound(path) as file:
        return np.concatenate([*_blocks(path, file)]), int(file.samplerate)


def _blocks(path: Path, file: soundfile.SoundFile) -> Iterator[Samples]:
    """Yield the samples of an open file in blocks (n, n_channels). Raises: AudioError: as `read_clip`."""
    if file.frames > MAX_FILE_S * file.samplerate:
        raise AudioError(
            f"{path} lasts {file.frames / file.samplerate:.0f} s; it must be at most {MAX_FILE_S:.0f} s. "
            "Cut out the part you want."
        )
    n_read = 0
    while len(block := file.read(_BLOCK_FRAMES, dtype="float32", always_2d=True)):
        require_finite(path, block, n_read)
        n_read += len(block)
        yield block
    if n_read == 0:
        raise AudioError(f"{path} has no samples. Use a sound that is longer than 0 s.")


class Mixdown:
    """Mixes blocks of channels by their mean, and tells whether the channels cancel each other.

    A microphone with its wires exchanged, or a widened stereo image, has the same sound in both channels with opposite
    signs, so that their mean is nearly silent.
    """

    def __init__(self) -> None:
        self._n = 0
        self._sums: Floats = np.zeros((2, 1))  # of samples and squares

    def mean(self, channels: Samples) -> Floats:
        """Return the mean of samples (n, n_channels), as (n,)."""
        rows = np.ascontiguousarray(channels.T, dtype=np.float64)  # sums along rows are several times as fast
        mean: Floats = rows.mean(axis=0)
        if len(rows) > 1:
            everything = [*rows, mean]
            self._sums = self._sums + np.array([[row.sum() for row in everything], [row @ row for row in everything]])
        self._n += len(mean)
        return mean

    @property
    def strongest(self) -> int | None:
        """The strongest channel, if the channels cancel each other; None if their mean is as good."""
        sums, squares = self._sums
        if len(sums) < 3:
            return None
        with np.errstate(invalid="ignore"):  # samples that are not finite are refused elsewhere
            *powers, mixed = squares - sums**2 / max(self._n, 1)
        # Of channels that have nothing in common, the mean has their mean power over their number.
        return int(np.argmax(powers)) if mixed < CANCELLED * np.mean(powers) / len(powers) else None


def _require_bounded(path: Path, file: soundfile.SoundFile) -> None:
    """Check the size in a file's header. Raises: AudioError: too many channels, or samples for its bytes."""
    if file.channels > MAX_CHANNELS:
        raise AudioError(f"{path} has {file.channels} channels; it must have at most {MAX_CHANNELS}. Mix some.")
    n_samples = file.frames * file.channels
    most = MAX_FILE_SAMPLES + SAMPLES_PER_BYTE * path.stat().st_size
    if n_samples > most:
        raise AudioError(
            f"{path} has {file.frames:,} frames of {file.channels} channels at {file.samplerate:,} Hz, "
            f"{n_samples:,} samples; a file of its size must have at most {most:,}. Shorten it, or save it as WAV."
        )


@contextmanager
def opened_sound(path: Path) -> Iterator[soundfile.SoundFile]:
    """Open a sound file for reading.

    Raises: AudioError: it is absent, no sound, or cut short, now or while it is read; it has more than `MAX_CHANNELS`,
    or more samples than `MAX_FILE_SAMPLES` and `SAMPLES_PER_BYTE` allow.
    """
    try:
        if not (is_there(path) and path.is_file()):
            raise AudioError(f"{path} is not a file. Give the path of an existing sound file.")
        if is_cut_short(path):
            raise AudioError(f"{path} is cut short: fewer bytes than its header says. Copy it again.")
        with unsized_wav(path) or nullcontext() as unsized, soundfile.SoundFile(unsized or path_in_c(path)) as file:
            _require_bounded(path, file)
            yield file
    except OSError as cause:
        raise AudioError(f"{path} cannot be read ({cause.strerror}). Choose a file that is yours.") from cause
    except (soundfile.SoundFileError, TypeError) as cause:  # TypeError: a headerless file, for which a rate is needed
        if is_lfs_pointer(path):
            raise AudioError(f"{path} {LFS_ADVICE}.") from cause
        # The text of libsndfile's error repeats the path, as bytes.
        reason = str(getattr(cause, "error_string", "") or reason_of(cause)).rstrip(".")
        raise AudioError(f"{path}: not a readable sound ({reason}). Use {READABLE}.") from cause


def require_finite(path: Path, channels: Samples, start: int = 0) -> None:
    """Check samples (n, channels) that begin at `start` in the file.

    Raises: AudioError: one of them is not finite, or exceeds `MAX_SAMPLE`.
    """
    good = (np.abs(channels) <= MAX_SAMPLE).all(axis=1)
    if not good.all():
        at = int(np.argmin(good))
        raise AudioError(
            f"{path}: sample {start + at} is {channels[at]}; every sample must be finite, and within {MAX_SAMPLE:g} "
            "[-], where full scale is 1. Export it again."
        )
