"""Chunks of WAV files, and the lengths that programs leave in the header of a WAV that they write into a pipe.

A header comes before its samples, so that a program that writes into a pipe does not know their length. It leaves 0 for
the samples (older ffmpeg; GStreamer, with the length of the header for the file), the largest length (ffmpeg), or about
2 GB (sox and espeak 0x7ffff000, arecord 0x80000000).
"""

from __future__ import annotations

import io
import struct
from pathlib import Path
from typing import Any, BinaryIO, Final

_UNKNOWN: Final = (2**31, 2**32)
"""Lengths within 64 KiB of these are unknown [bytes]: sox rounds 0x7ffff000 down to whole frames (assumed: below 60 kB
each), and the file is longer than its samples."""


def find_chunk(file: BinaryIO, wanted: bytes) -> int | None:
    """Move to the content of a chunk. Returns its stated length [bytes]; None if it is absent, or this is no WAV."""
    riff, _, wave = struct.unpack("<4sI4s", file.read(12).ljust(12, b"\0"))
    while (riff, wave) == (b"RIFF", b"WAVE") and len(header := file.read(8)) == 8:
        name, size = struct.unpack("<4sI", header)
        if name == wanted:
            return int(size)
        if name == b"data" and size == 0:  # samples follow, up to the end of the file
            return None
        file.seek(size + size % 2, 1)
    return None


def is_cut_short(path: Path) -> bool:
    """Return True if a WAV ends before its stated length, which libsndfile does not report.

    Some programs count the eight bytes before the length as well. Raises: OSError.
    """
    with path.open("rb") as file:
        header = file.read(8)
    stated = int.from_bytes(header[4:], "little")
    is_unknown = any(abs(stated - one) < 0x1_0000 for one in _UNKNOWN)
    return header[:4] == b"RIFF" and not is_unknown and path.stat().st_size < stated


class UnsizedWav(io.FileIO):
    """A WAV file whose header has 0 for the length of its samples: it is read up to its end.

    libsndfile would find no samples. It gets the largest length instead.
    """

    def __init__(self, path: Path, length_at: int) -> None:
        super().__init__(path)
        self._length_at = length_at

    def readinto(self, buffer: Any, /) -> int:
        """Read as a file does, with another length of the samples."""
        start, view = self.tell(), memoryview(buffer).cast("B")
        n_read = super().readinto(view)
        for at in range(max(self._length_at, start), min(self._length_at + 4, start + n_read)):
            view[at - start] = 0xFF
        return n_read


def unsized_wav(path: Path) -> UnsizedWav | None:
    """Open a WAV whose stated length ends before its samples, of length 0; None for any other file. Raises: OSError."""
    with path.open("rb") as file:
        stated = int.from_bytes(file.read(8)[4:], "little")
        file.seek(0)
        is_unsized = find_chunk(file, b"data") == 0 and stated + 8 <= file.tell()
        return UnsizedWav(path, file.tell() - 4) if is_unsized else None
