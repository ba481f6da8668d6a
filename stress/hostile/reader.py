"""A reader of the library with a small valid input: what to write, what to damage, and how to read it.

A read also uses the result, as far as a use can meet what the reader let through.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).parents[2] / "tests" / "support"))

KEY = "sk-hostile-0123456789abcdef"
"""A key that no message may show."""


@dataclass(frozen=True)
class Reader:
    """A reader of foreign data.

    Parameters: write : writes a valid input into a folder, and returns the file to read; read : reads that file, and
    returns what is to be searched for numbers that are not finite; damaged : patterns of the files to damage;
    names_file : True if every error must name a file; opens_files : False
    if it gets bytes, so that its input is always a regular file; every : a case only in each so
    many rounds, for readers that start a process.
    """

    name: str
    write: Callable[[Path], Path]
    read: Callable[[Path], object]
    damaged: tuple[str, ...] = ("*",)
    names_file: bool = True
    opens_files: bool = True
    every: int = 1


READERS: dict[str, Reader] = {}


def add(name: str, write: Callable[[Path], Path], read: Callable[[Path], object], *damaged: str, **more: Any) -> None:
    READERS[name] = Reader(name, write, read, damaged or ("*",), **more)


def writes(name: str, content: Callable[[], bytes]) -> Callable[[Path], Path]:
    def write(folder: Path) -> Path:
        path = folder / name
        path.write_bytes(content())
        return path

    return write
