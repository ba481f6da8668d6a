"""LRU caches of functions of arrays, bounded in bytes over all instances (`MOST_BYTES`)."""

from __future__ import annotations

from collections import OrderedDict, deque
from collections.abc import Callable, Iterator
from inspect import ismethod
from itertools import count
from threading import Lock
from typing import Any, ClassVar, Generic, TypeVar
from weakref import ReferenceType, WeakMethod, ref

import numpy as np
from numpy.typing import NDArray

from scene2hap.common.cached_while_used import Sized
from scene2hap.common.forks import lock_of_process

MOST_BYTES = 128 * 2**20

Answer = TypeVar("Answer", bound=Sized | tuple[Sized, ...])
_Key = tuple[Any, ...]


class ByteBoundedLru(Generic[Answer]):
    """LRU cache of a function of arrays: at most `room` values, and at most `MOST_BYTES` over all instances.

    Each instance holds its values, so that they are freed together with the instance: a value may refer to all data of
    its body, which its `nbytes` does not count. The object of a bound method is referred to weakly: it has the cache as
    an attribute, and only the garbage collector could free such a cycle. Safe to call from several threads: a worker
    prepares a field while the game's thread evaluates another.
    """

    # Owner and size of every value of all instances, the most recently used last.
    _shelf: ClassVar[OrderedDict[_Key, tuple[ReferenceType[ByteBoundedLru[Any]], int]]] = OrderedDict()
    _held_bytes: ClassVar[int] = 0
    _lock: ClassVar[Lock] = lock_of_process()
    # Keys of deleted instances, to be removed later: the garbage collector may run while this thread has the lock.
    _gone: ClassVar[deque[_Key]] = deque()
    _numbers: ClassVar[Iterator[int]] = count()

    def __init__(self, function: Callable[..., Answer], room: int = 16) -> None:
        self._function = WeakMethod(function) if ismethod(function) else lambda: function
        self._room, self._number = room, next(self._numbers)
        self._own: OrderedDict[_Key, Answer] = OrderedDict()

    def __del__(self) -> None:
        self._gone.extend(self._own)

    def __call__(self, *arrays: NDArray[np.float64]) -> Answer:
        """Return the value for these arrays. Arrays with equal bytes count as equal, so shapes must not vary."""
        key = (self._number, *[array.tobytes() for array in arrays])
        with self._lock:
            if key in self._own:
                self._shelf.move_to_end(key)
                self._own.move_to_end(key)
                return self._own[key]
        function = self._function()
        assert function is not None, "the caller holds the object of the method"
        answer: Answer = function(*arrays)
        with self._lock:
            if key not in self._own:
                self._put(key, answer)
        return answer

    def _put(self, key: _Key, answer: Answer) -> None:
        size = sum(one.nbytes for one in answer) if isinstance(answer, tuple) else answer.nbytes
        self._shelf[key], self._own[key] = (ref(self), size), answer
        ByteBoundedLru._held_bytes += size
        while self._gone:
            self._forget(self._gone.popleft())
        if len(self._own) > self._room:
            self._forget(next(iter(self._own)))
        while self._held_bytes > MOST_BYTES and len(self._shelf) > 1:
            self._forget(next(iter(self._shelf)))

    @staticmethod
    def _forget(key: _Key) -> None:
        found = ByteBoundedLru._shelf.pop(key, None)
        if found is None:
            return  # the instance was deleted, and its value was evicted before
        owner, size = found
        ByteBoundedLru._held_bytes -= size
        if (lru := owner()) is not None:
            del lru._own[key]
