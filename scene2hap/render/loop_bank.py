"""The sources' tactile loops, split in bands and ready to be read at any position.

A loop of n samples at f Hz lasts n f_t / f tactile samples, seldom a whole number. It is stored as the nearest whole
number N of samples, repeated for the number of turns within a second that makes the error smallest. It is read at

    u(t) = round(t N / (turns n f_t / f)) mod N

in exact integer arithmetic. So it keeps the period of the audible loop: the error never exceeds one tactile sample,
while simple repetition of N samples would accumulate an error. Seldom (10 s or more for a loop of 5 s, never if the
rates divide) u steps by 0 or 2 samples. Over that cell the two readings are cross-faded.

A mixer reads a fixed number of loops. In a `SlotBank` loops can be added and removed under a running mixer. An empty
slot costs nothing, since a mixer reads only loops with gains above 0, and it may be filled while the mixer plays.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from scene2hap.audio.bands import split_bands
from scene2hap.audio.clip import AudioClip, Samples
from scene2hap.compiled import compiled
from scene2hap.haptics import Bands

CELL = 24
"""Samples that are read at once.

numpy keeps Python's interpreter lock in operations on up to 500 numbers, and 20 bands over 24 samples are 480. An audio
thread that releases the lock may have to wait for a game's whole update.
"""

_SPAN_S = 1.0
"""Longest time that a stored loop is repeated for, to get nearest to a whole number of samples [s]."""
_FADE = (0.5 - 0.5 * np.cos(np.pi * np.arange(1, CELL + 1) / CELL)).astype(np.float32)

Block = NDArray[np.float32]


@compiled
class StoredLoop:
    """A loop in bands.

    Parameters: samples : (length + CELL, n_bands), where the last CELL repeat the first; numerator / denominator : the
        speed in samples per tactile sample. Bands are adjacent in memory, so a cell of a loop is one block. fade :
        (CELL,) weights of the cross-fade between two readings.
    """

    def __init__(self, samples: Block, length: int, numerator: int, denominator: int, fade: Block) -> None:
        self._samples, self._length, self._numerator, self._denominator = samples, length, numerator, denominator
        self._fade, self._other = fade, np.zeros((samples.shape[1], CELL), dtype=np.float32)

    def write(self, begin: int, out: Block) -> None:
        """Write CELL samples of its bands into (n_bands, CELL), from a tactile sample of the common clock on."""
        samples, numerator, denominator = self._samples, self._numerator, self._denominator
        here = (2 * begin * numerator + denominator) // (2 * denominator)
        there = (2 * (begin + CELL) * numerator + denominator) // (2 * denominator) - CELL
        start = here % self._length
        out[...] = samples[start : start + CELL].T
        if there != here:
            start = there % self._length
            np.subtract(samples[start : start + CELL].T, out, out=self._other)
            np.multiply(self._other, self._fade, out=self._other)
            np.add(out, self._other, out=out)


@compiled
def read(loops: Sequence[StoredLoop | None], begin: int, out: Block) -> None:
    """Write a cell of the bands of some loops, one after the other, into (n_rows, CELL); 0 for None."""
    for loop, rows in zip(loops, out.reshape(max(1, len(loops)), -1, CELL), strict=False):
        if loop is None:
            rows.fill(0.0)
        else:
            loop.write(begin, rows)


@compiled
def read_between(loop: StoredLoop, below: NDArray[np.intp], weights: Block, cell: Block, out: Block) -> None:
    """Write CELL samples of a loop at places between its own samples into (CELL, n_bands).

    Parameters: below : (CELL,) the tactile sample before each place, on the common clock; weights : (4, CELL) of the
        samples from the one before `below` to the second after it; cell : (n_bands, CELL) of the caller, overwritten.
    The loop is read in the cells of the common clock, as a mixer reads it that began with the clock.
    """
    out.fill(0.0)
    for number in range((int(below.min()) - 1) // CELL, (int(below.max()) + 2) // CELL + 1):
        loop.write(number * CELL, cell)
        for offset, weight in enumerate(weights, -1 - number * CELL):
            at = below + offset
            places = np.flatnonzero((at >= 0) & (at < CELL))
            out[places] += (cell[:, at[places]] * weight[places]).T


class LoopBank:
    """Loops at one tactile rate, in a fixed order; a row is one band of one loop.

    Parameters: loops : of any rates; bands : of the split; sample_rate_hz : the tactile rate.
    """

    def __init__(self, loops: Sequence[AudioClip], bands: Bands, sample_rate_hz: int) -> None:
        self.sample_rate_hz = sample_rate_hz
        self.n_bands: int = bands.n_bands
        self._stored = [_stored(loop, bands, sample_rate_hz) for loop in loops]
        self.loops: list[StoredLoop] = [one.loop for one in self._stored]

    def __len__(self) -> int:
        return len(self.loops)

    @property
    def n_rows(self) -> int:
        """Number of bands of all loops together."""
        return len(self) * self.n_bands

    @property
    def nbytes(self) -> int:
        """Memory of the loops [bytes]."""
        return sum(one.samples.nbytes for one in self._stored)

    def taken(self, loop: int, begin: int, n_samples: int) -> Block:
        """Return samples of a loop (n_samples, n_bands), from a tactile sample of the common clock on.

        It allocates memory, so it is not for an audio thread.
        """
        one = self._stored[loop]
        first = begin * 2 * one.numerator + one.denominator
        turn = 2 * one.denominator * one.length
        unwrapped = (first % turn + np.arange(n_samples) * 2 * one.numerator) // (2 * one.denominator)
        found: Block = one.samples[unwrapped % one.length]
        # Where a sample is left out or repeated, one reading fades into the other, as in `StoredLoop.write`.
        for i in (np.flatnonzero(np.diff(unwrapped) != 1) + 1).tolist():
            fade = _FADE[: n_samples - i, None]
            before = one.samples[(unwrapped[i - 1] + 1 + np.arange(len(fade))) % one.length]
            found[i : i + CELL] = before + fade * (found[i : i + CELL] - before)
        return found

    def read(self, loops: Sequence[int], begin: int, out: Block) -> None:
        """Write CELL samples of some loops into (n_loops * n_bands, CELL), from a tactile sample of the common clock
        on."""
        read([self.loops[loop] for loop in loops], begin, out)

    def only(self, begin: int) -> StoredLoop | None:
        """Return the loop of a bank of one; see `Slot`."""
        return self.loops[0]


class Slot(Protocol):
    """The content of a slot: a bank of one loop, or a start or stop."""

    def only(self, begin: int) -> StoredLoop | None:
        """Return the loop to read at a tactile sample of the common clock; None for silence."""
        ...


class SlotBank(LoopBank):
    """A bank of slots, some of which may be empty.

    Parameters: slots : None for an empty one; shift : tactile samples by which the clock of its mixer is behind the
        session's.
    """

    def __init__(self, slots: list[Slot | None], bands: Bands, sample_rate_hz: int, shift: int = 0) -> None:
        super().__init__((), bands, sample_rate_hz)
        self.slots = slots
        self._bands, self._shift = bands, shift

    def shifted(self, shift: int) -> SlotBank:
        """Return the same slots, for a mixer that began `shift` tactile samples after the session."""
        return SlotBank(self.slots, self._bands, self.sample_rate_hz, shift)

    def __len__(self) -> int:
        return len(self.slots)

    def read(self, loops: Sequence[int], begin: int, out: Block) -> None:
        """Write as `LoopBank`; an empty slot is silent."""
        slots, at = [self.slots[loop] for loop in loops], begin + self._shift
        read([None if slot is None else slot.only(at) for slot in slots], at, out)


def position_s(n: int, rate_hz: int, frame: int, sample_rate_hz: int) -> float:
    """Return the position [s] of a loop of n samples at a frame of a clock with another rate."""
    return (frame * rate_hz % (n * sample_rate_hz)) / (sample_rate_hz * rate_hz)


class _Stored(NamedTuple):
    """A loop, and the data of which it was made; see `StoredLoop`."""

    loop: StoredLoop
    samples: Block
    length: int
    numerator: int
    denominator: int


def stored_cell(samples: Block) -> StoredLoop:
    """Return a loop that reads the present content of samples (CELL, n_bands) at any position."""
    return StoredLoop(samples, CELL, 0, 1, _FADE)


def _stored(loop: AudioClip, bands: Bands, sample_rate_hz: int) -> _Stored:
    """Split a loop into bands and store it as the module describes."""
    # In `turns` turns the loop lasts exact / unit tactile samples.
    turns = _turns(len(loop.samples), loop.sample_rate_hz, sample_rate_hz)
    exact, unit = turns * len(loop.samples) * sample_rate_hz, loop.sample_rate_hz
    length = max(1, (2 * exact + unit) // (2 * unit))
    split = split_bands(_resampled(np.tile(loop.samples, turns), length), length * sample_rate_hz * unit / exact, bands)
    samples = np.empty((length + CELL, len(split)), dtype=np.float32)
    samples[:length] = split.T
    samples[length:] = samples[np.arange(CELL) % length]
    common = math.gcd(length * unit, exact)
    numerator, denominator = length * unit // common, exact // common
    return _Stored(StoredLoop(samples, length, numerator, denominator, _FADE), samples, length, numerator, denominator)


def _turns(n_samples: int, sample_rate_hz: int, tactile_rate_hz: int) -> int:
    """Return the number of turns within a second whose length is nearest to a whole number of tactile samples."""

    def error(turns: int) -> float:
        rest = turns * n_samples * tactile_rate_hz % sample_rate_hz
        return min(rest, sample_rate_hz - rest) / turns

    return min(range(1, max(1, int(_SPAN_S * sample_rate_hz) // n_samples) + 1), key=error)


def _resampled(samples: Samples, n_out: int) -> Samples:
    n_in = len(samples)
    if n_in == n_out:
        return samples
    # irfft of the truncated or zero-padded spectrum is exact band-limited interpolation of a periodic signal.
    spectrum = np.fft.rfft(samples.astype(np.float64))
    return (np.fft.irfft(spectrum, n_out) * (n_out / n_in)).astype(np.float32)
