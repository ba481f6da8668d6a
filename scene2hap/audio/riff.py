"""Chunks of WAV files, and the lengths that programs leave in the header of a WAV that they write into a pipe.

A header comes before its samples, so that a program that writes into a pipe does not know their length. It leaves 0
(older ffmpeg, GStreamer), the largest length (ffmpeg), or about 2 GB (sox and espeak 0x7ffff000, arecord 0x80000000).
"""

from __future__ import annotations

import io
import struct
from pathlib import Path
from typing import Any, BinaryIO, Final

_UNKNOWN_WITHIN: Final = 0x1_0000
"""Lengths this near to 2 or 4 GiB are unknown [bytes]: sox rounds 0x7ffff000 down to whole frames (assumed: below 60 kB
each). Other lengths of that size are those of real files."""


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
    is_known = all(abs(stated - unknown) > _UNKNOWN_WITHIN for unknown in (2**31, 2**32))
    return header[:4] == b"RIFF" and is_known and path.stat().st_size < stated


class UnsizedWav(io.FileIO):
    """A WAV file whose header has 0 for the length of the file and of its samples: it is read up to its end.

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
    """Open a WAV file without lengths; None for any other file. Raises: OSError."""
    with path.open("rb") as file:
        if file.read(8) != b"RIFF\0\0\0\0":
            return None
        file.seek(0)
        return UnsizedWav(path, file.tell() - 4) if find_chunk(file, b"data") == 0 else None
