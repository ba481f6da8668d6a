"""Remembering what a function said about the arrays that it was asked last.

All that is remembered together is bounded, `MOST_BYTES`; what was asked for longest ago is forgotten first.
"""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable
from threading import Lock
from typing import Any, ClassVar, Generic, Protocol, TypeVar

import numpy as np
from numpy.typing import NDArray

MOST_BYTES = 128 * 2**20


class Sized(Protocol):
    """What tells how much memory it holds, as arrays do."""

    @property
    def nbytes(self) -> int:
        """Memory [byte]."""
        ...


Answer = TypeVar("Answer", bound=Sized | tuple[Sized, ...])
_Key = tuple[Any, ...]


class ByteBoundedLru(Generic[Answer]):
    """A function of arrays that remembers its last answers, `room` of them at most.

    A worker may prepare a field while the game's thread asks another, so that both may call.
    """

    # Of all: the answers and their sizes, by who remembers them and what was asked, the last asked for last.
    _shelf: ClassVar[OrderedDict[_Key, tuple[Any, int]]] = OrderedDict()
    _held_bytes: ClassVar[int] = 0
    _lock: ClassVar[Lock] = Lock()

    def __init__(self, function: Callable[..., Answer], room: int = 16) -> None:
        self._function, self._room = function, room
        self._own: OrderedDict[_Key, None] = OrderedDict()

    def __call__(self, *arrays: NDArray[np.float64]) -> Answer:
        """What the function says of these arrays; those of equal bytes are the same, so shapes must not vary."""
        key = (self, *[array.tobytes() for array in arrays])
        with self._lock:
            found = self._shelf.get(key)
            if found is not None:
                self._shelf.move_to_end(key)
                self._own.move_to_end(key)
                known: Answer = found[0]
                return known
        answer = self._function(*arrays)
        with self._lock:
            if key not in self._shelf:
                self._put(key, answer)
        return answer

    def _put(self, key: _Key, answer: Answer) -> None:
        size = sum(one.nbytes for one in answer) if isinstance(answer, tuple) else answer.nbytes
        self._shelf[key], self._own[key] = (answer, size), None
        ByteBoundedLru._held_bytes += size
        if len(self._own) > self._room:
            self._forget(next(iter(self._own)))
        while self._held_bytes > MOST_BYTES and len(self._shelf) > 1:
            self._forget(next(iter(self._shelf)))

    @staticmethod
    def _forget(key: _Key) -> None:
        _, size = ByteBoundedLru._shelf.pop(key)
        del key[0]._own[key]
        ByteBoundedLru._held_bytes -= size
