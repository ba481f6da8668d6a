"""The loop that a WAV file marks in its chunk "smpl", as audio editors, samplers and game engines write and read it.

Source: Microsoft and IBM, "Multimedia Programming Interface and Data Specifications 1.0", update of 1994.
"""

from __future__ import annotations

import struct
from pathlib import Path

from scene2hap.audio.riff import find_chunk

SHORTEST_MARK_S, LONGEST_MARK_S = 0.1, 60.0
"""Bounds on the length of a marked loop [s] (assumed: shorter ones are the last cycles of a musical instrument, longer
ones an ambience)."""

_SAMPLER, _LOOP = struct.Struct("<9I"), struct.Struct("<6I")
_FORWARDS, _FOR_EVER, _MIDDLE_C = 0, 0, 60


def with_loop(wav: bytes, first: int, end: int, rate_hz: int) -> bytes:
    """Append a chunk "smpl" with one loop to a WAV: the samples [first, end), forwards, for ever."""
    size = _SAMPLER.size + _LOOP.size
    sampler = _SAMPLER.pack(0, 0, round(1e9 / rate_hz), _MIDDLE_C, 0, 0, 0, 1, 0)  # one loop
    loop = _LOOP.pack(0, _FORWARDS, first, end - 1, 0, _FOR_EVER)
    body = wav[8:] + bytes(len(wav) % 2) + struct.pack("<4sI", b"smpl", size) + sampler + loop
    return b"RIFF" + len(body).to_bytes(4, "little") + body


def marked_loop(path: Path, n_samples: int, rate_hz: int) -> tuple[int, int] | None:
    """Return the first loop that runs forwards in a file of `n_samples`, as its samples [first, end).

    None if the file is no WAV of the form RIFF, or marks none of `SHORTEST_MARK_S` to `LONGEST_MARK_S` within its
    samples. Raises: OSError.
    """
    for kind, first, last in _loops(_sampler_chunk(path)):
        is_inside = first <= last < n_samples
        if kind == _FORWARDS and is_inside and SHORTEST_MARK_S <= (last + 1 - first) / rate_hz <= LONGEST_MARK_S:
            return first, last + 1
    return None


def is_marked_whole(path: Path, n_samples: int, rate_hz: int) -> bool:
    """Return True if a file of `n_samples` marks all of itself as its loop. Raises: OSError."""
    return marked_loop(path, n_samples, rate_hz) == (0, n_samples)


def _loops(chunk: bytes) -> list[tuple[int, int, int]]:
    """Return kind, first and last sample of each loop in a chunk."""
    whole = chunk[_SAMPLER.size :]
    rows = _LOOP.iter_unpack(whole[: len(whole) // _LOOP.size * _LOOP.size])
    return [(kind, first, last) for _, kind, first, last, _, _ in rows]


def _sampler_chunk(path: Path) -> bytes:
    """Return the content of the chunk "smpl", at most 1000 loops of it; empty if there is none."""
    with path.open("rb") as file:
        size = find_chunk(file, b"smpl")
        return b"" if size is None else file.read(min(size, _SAMPLER.size + 1000 * _LOOP.size))
