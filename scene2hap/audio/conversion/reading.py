"""A sound file that is read block by block: its channels or their mix, measured on the way."""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import cached_property
from pathlib import Path

import numpy as np
import soundfile

from scene2hap.audio.conversion.clips import PRE_ROLL_S, with_repetitions
from scene2hap.audio.conversion.meter import Block, Meter
from scene2hap.audio.files import MAX_SAMPLE, Mixdown, opened_sound, require_finite
from scene2hap.audio.loop_marks import LONGEST_MARK_S, SHORTEST_MARK_S
from scene2hap.audio.tactile.sections import through_sections
from scene2hap.common.arrays import Floats
from scene2hap.errors import AudioError

BLOCK_FRAMES = 65_536
_OFFSET_FRAMES = 65_536
_BEGINNING_S = 0.05
_MIDDLE_S = 10.0
"""Length of the part of a file that is analysed before the conversion [s]."""
_SLOWEST_HZ = 1.0
"""Cut-off below which a component counts as offset; its removal costs 0.04 dB at 10 Hz, where touch begins."""


class SoundReader:
    """Reads a sound file, of which `meter` measures each block.

    Each pass opens the file for itself: libsndfile 1.2.2 cannot return to the beginning of a Vorbis file whose
    beginning was cut off.

    Parameters:
    mono : mix the channels by their mean, or take the strongest if they cancel each other in the middle of the file.
    n_columns : points of the meter's envelope.
    is_loop : the file is a loop, of at most `LONGEST_MARK_S`: it is converted as if it were repeated.
    Raises: AudioError: a loop that is too short or too long.
    """

    def __init__(
        self, source: Path, file: soundfile.SoundFile, *, mono: bool, n_columns: int, is_loop: bool = False
    ) -> None:
        self.rate: int = int(file.samplerate)
        if is_loop:
            _require_length_of_loop(source, int(file.frames) / self.rate)
        self.n_around: int = round(PRE_ROLL_S * self.rate) if is_loop else 0
        """Frames by which `blocks_to_convert` continues the file on both sides, as its repetitions do."""
        self.channels: int = 1 if mono else int(file.channels)
        self.meter: Meter = Meter(self.rate, self.channels, n_frames=int(file.frames), n_columns=n_columns)
        self._source, self._file, self._mono = source, file, mono
        self.gain: float = 1.0
        """Factor by which `blocks_to_convert` scales the file [-]."""
        self._strongest: int | None = None
        if mono:
            mixdown = Mixdown()
            mixdown.mean(self.middle())
            self._strongest = mixdown.strongest

    def middle(self) -> Block:
        """Return all channels of the middle of the file (n, n_channels), at most `_MIDDLE_S`."""
        n = round(_MIDDLE_S * self.rate)
        if self._whole is not None:
            return self._whole
        with opened_sound(self._source) as file:
            file.seek(max(0, int(file.frames) - n) // 2)
            return _read(file, n)

    def blocks(self) -> Iterator[Block]:
        """Yield the whole file in blocks (n, channels).

        Raises: AudioError: it has no samples, a sample that is not finite, or fewer samples than its header states.
        """
        stated, n_read = int(self._file.frames), 0
        for part in self._parts(BLOCK_FRAMES):
            with np.errstate(over="ignore"):  # of samples that are refused below
                block = self._mixed(part)
                self.meter.add(block)
            if not self.meter.peak <= MAX_SAMPLE:
                require_finite(self._source, block, n_read)
            n_read += len(block)
            yield block
        if n_read == 0:
            raise AudioError(f"{self._source} has no samples. Use a sound that is longer than 0 s.")
        if n_read < stated and self._file.format != "MP3":  # the length of an MP3 is an estimate
            raise AudioError(f"{self._source} is cut short: {n_read} of {stated} frames. Copy it again.")

    def blocks_to_convert(self) -> Iterator[Block]:
        """Yield `blocks` with `n_around` frames on both sides, within full scale and without slow components.

        The high-pass starts at the offset of the file's beginning.

        A file that peaks above full scale is scaled down as a whole, since a converter clips such samples. The level of
        the result does not depend on the level of the file.
        """
        share = 1.0 / (1.0 + 2.0 * math.pi * _SLOWEST_HZ / self.rate)
        section = np.array([[share, -share, 0.0, 1.0, -share, 0.0]])
        state = np.zeros((1, self.channels, 2))
        state[0, :, 0] = -share * self._first_offsets()
        self.gain = 1.0 / max(1.0, self._peak())
        section[0, :2] *= self.gain
        state *= self.gain
        for block in _repeated(self.blocks(), self.n_around) if self.n_around else self.blocks():
            rows = np.ascontiguousarray(block.T, dtype=np.float64)
            yield through_sections(section, rows, state).T.astype(np.float32)

    def _peak(self) -> float:
        """Return the peak of a file that can exceed full scale [-]; 0 for PCM, and for samples that are refused later.

        This reads a long file once more; decoding takes far less time than the conversion.
        """
        if self._file.subtype.startswith("PCM_"):
            return 0.0
        peak = 0.0
        for part in self._parts(BLOCK_FRAMES):
            with np.errstate(over="ignore"):
                peak = max(peak, float(np.abs(self._mixed(part)).max()))
        return peak if peak <= MAX_SAMPLE else 0.0

    def _first_offsets(self) -> Floats:
        """Return the offset of each channel at the beginning of the file.

        The mean of the first 50 ms counts where it is nearer to 0 than that of the first second, by more than the
        samples vary: the recording was faded in together with its offset. A boom, which begins with half a slow wave,
        is farther from 0.
        """
        head = next(self._parts(_OFFSET_FRAMES), None)
        if head is None or not np.isfinite(head).all():  # the conversion raises an error for this
            return np.zeros(self.channels)
        channels = np.ascontiguousarray(self._mixed(head).T, dtype=np.float64)
        beginning = channels[:, : round(_BEGINNING_S * self.rate)]
        offsets, own = channels.mean(axis=1), beginning.mean(axis=1)
        is_faded = np.abs(offsets) - np.abs(own) > beginning.std(axis=1)
        first: Floats = np.where(is_faded, own, offsets)
        return first

    @cached_property
    def _whole(self) -> Block | None:
        """All channels of a file (n, n_channels) that is no longer than its middle, decoded once; None for others."""
        most = round(_MIDDLE_S * self.rate)
        if self._file.frames > most:
            return None
        with opened_sound(self._source) as file:
            channels = _read(file, most + 1)
        return channels if len(channels) <= most else None  # the length of an MP3 is an estimate

    def _parts(self, n_frames: int) -> Iterator[Block]:
        """Yield all channels of the file in parts (n, n_channels)."""
        whole = self._whole
        if whole is not None:
            yield from (whole[at : at + n_frames] for at in range(0, len(whole), n_frames))
            return
        with opened_sound(self._source) as file:
            while len(part := _read(file, n_frames)):
                yield part

    def _mixed(self, block: Block) -> Block:
        """Return the channels, or in mono their mean or the one that stands for all, as (n, 1)."""
        if not self._mono or block.shape[1] == 1:
            return block
        if self._strongest is not None:
            return np.ascontiguousarray(block[:, self._strongest, None])
        mean: Block = block.mean(axis=1, keepdims=True, dtype=np.float32)
        return mean


def _read(file: soundfile.SoundFile, n_frames: int) -> Block:
    channels: Block = file.read(n_frames, dtype="float32", always_2d=True)
    return channels


def _repeated(blocks: Iterator[Block], n_around: int) -> Iterator[Block]:
    """Yield a loop `with_repetitions`."""
    repeated = with_repetitions(np.concatenate([*blocks]), n_around)
    yield from (repeated[at : at + BLOCK_FRAMES] for at in range(0, len(repeated), BLOCK_FRAMES))


def _require_length_of_loop(source: Path, duration_s: float) -> None:
    if not SHORTEST_MARK_S <= duration_s <= LONGEST_MARK_S:
        raise AudioError(
            f"{source} lasts {duration_s:.3g} s; a loop lasts {SHORTEST_MARK_S:g} to {LONGEST_MARK_S:g} s. Convert it "
            "as a sound that ends (loop=False, --no-loop)."
        )
