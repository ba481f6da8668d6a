"""One attack: a command that has to end well or in one sentence of ours, within bounds, in its own folder."""

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
    """A command and what it may take.

    argv : what is run; "scene2hap" first means the command line of this package, which is forked for speed. call : what
    the child calls instead, its status returned. seconds : of processor time; memory_bytes : resident; untouched :
    further paths that must not change.
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
    """The number, kind, new folder and chance of each case; kinds in turn, without end."""
    for number in itertools.count():
        folder = work / str(number)
        folder.mkdir()
        yield number, kinds[number % len(kinds)], folder, random.Random(f"{family}/{seed}/{number}")
