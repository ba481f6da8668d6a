"""One attack: a command that must succeed or end in a one-line error, within limits, in its own folder."""

from __future__ import annotations

import itertools
import random
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TypeVar

Kind = TypeVar("Kind")


@dataclass(frozen=True)
class Attack:
    """A command with its limits.

    argv : the command; if it starts with "scene2hap", the child is forked and calls scene2hap's command line directly,
    which is faster. call : a function that the child calls instead; it returns the status. seconds : limit of processor
    time. memory_bytes : limit of resident memory. untouched : further paths that must not change.
    """

    family: str
    name: str
    argv: tuple[str, ...]
    stdin: bytes = b""
    call: Callable[[], int] | None = None
    seconds: float = 5.0
    memory_bytes: int = 1 << 30
    untouched: tuple[Path, ...] = ()


def in_turn(
    family: str, kinds: Sequence[Kind], seed: int, work: Path
) -> Iterator[tuple[int, Kind, Path, random.Random]]:
    """Yield number, kind, new folder and random generator of each case; kinds in turn, without end."""
    for number in itertools.count():
        folder = work / str(number)
        folder.mkdir()
        yield number, kinds[number % len(kinds)], folder, random.Random(f"{family}/{seed}/{number}")
