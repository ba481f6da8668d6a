"""LRU caches of functions of arrays, bounded in bytes over all instances (`MOST_BYTES`)."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable
from threading import Lock
from typing import Any, ClassVar, Generic, Protocol, TypeVar

import numpy as np
from numpy.typing import NDArray

MOST_BYTES = 128 * 2**20


class Sized(Protocol):
    """A value with a known size in memory, such as an array."""

    @property
    def nbytes(self) -> int:
        """Memory [byte]."""
        ...


Answer = TypeVar("Answer", bound=Sized | tuple[Sized, ...])
_Key = tuple[Any, ...]


class ByteBoundedLru(Generic[Answer]):
    """LRU cache of a function of arrays: `room` values at most, and `MOST_BYTES` over all instances.

    Safe to call from several threads: a worker prepares a field while the game's thread evaluates another.
    """

    # Of all instances: values and sizes by instance and arguments, the most recently used last.
    _shelf: ClassVar[OrderedDict[_Key, tuple[Any, int]]] = OrderedDict()
    _held_bytes: ClassVar[int] = 0
    _lock: ClassVar[Lock] = Lock()

    def __init__(self, function: Callable[..., Answer], room: int = 16) -> None:
        self._function, self._room = function, room
        self._own: OrderedDict[_Key, None] = OrderedDict()

    def __call__(self, *arrays: NDArray[np.float64]) -> Answer:
        """The function's value for these arrays. Arrays of equal bytes count as equal, so shapes must not vary."""
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
