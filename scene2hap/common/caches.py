"""Caches of large results of functions, bounded in bytes: of arrays (`ByteBoundedLru`), and of shared results.

A scene may have any number of plates, so no fixed number of results suffices for all of them: an LRU cache that is one
entry too small for a scene returns none of its plates. The bodies of plates, their modes and loops in bands therefore
stay cached as long as anything refers to them, such as a field (`cached_while_used`). The newest results stay cached
longer, for objects that are lifted and put down again.
"""

from __future__ import annotations

from collections import OrderedDict, deque
from collections.abc import Callable, Hashable, Iterator
from functools import partial, update_wrapper
from inspect import ismethod
from itertools import count
from threading import Lock
from typing import Any, ClassVar, Generic, ParamSpec, Protocol, TypeVar
from weakref import ReferenceType, WeakMethod, WeakValueDictionary, ref

import numpy as np
from numpy.typing import NDArray

from scene2hap.common.forks import lock_of_process

MOST_BYTES = 128 * 2**20
"""Size of the values of all `ByteBoundedLru`, and of the newest results of a function of `cached_while_used`."""


class Sized(Protocol):
    """A value with a known size in memory, such as an array."""

    @property
    def nbytes(self) -> int:
        """Memory [byte]."""
        ...


Answer = TypeVar("Answer", bound=Sized | tuple[Sized, ...])
_Given = ParamSpec("_Given")
_Result = TypeVar("_Result", bound=Sized)
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


class CacheWhileUsed(Generic[_Result]):
    """Results by key: all that anything refers to, and the newest `most_bytes`.

    Safe to call from several threads: a worker prepares a field while another one prepares an impact. Both may compute
    the same result; they then share the first one.
    """

    def __init__(self, most_bytes: int) -> None:
        self.most_bytes = most_bytes
        self.kept_bytes: int = 0
        self._lock = lock_of_process()
        self._used: WeakValueDictionary[Hashable, _Result] = WeakValueDictionary()
        self._newest: OrderedDict[Hashable, _Result] = OrderedDict()

    def get(self, key: Hashable, compute: Callable[[], _Result]) -> _Result:
        """Return the result of a key, which is computed if it is not cached."""
        result = self._used.get(key)
        if result is None:
            result = compute()
        dropped = []  # freed without the lock, since that takes time
        with self._lock:
            result = self._used.setdefault(key, result)
            if key not in self._newest:
                self._newest[key] = result
                self.kept_bytes += result.nbytes
            self._newest.move_to_end(key)
            while self.kept_bytes > self.most_bytes and len(self._newest) > 1:
                dropped.append(self._newest.popitem(last=False)[1])
                self.kept_bytes -= dropped[-1].nbytes
        return result

    def clear(self) -> None:
        """Forget all results."""
        with self._lock:
            self._used.clear()
            self._newest.clear()
            self.kept_bytes = 0


class cached_while_used(Generic[_Given, _Result]):
    """Cache the results of a function of hashable arguments, see `CacheWhileUsed`."""

    def __init__(self, function: Callable[_Given, _Result]) -> None:
        self._function = function
        self.cache: CacheWhileUsed[_Result] = CacheWhileUsed(MOST_BYTES)
        update_wrapper(self, function)

    def __call__(self, *args: _Given.args, **kwargs: _Given.kwargs) -> _Result:
        """Return the result for these arguments."""
        key = (args, tuple(sorted(kwargs.items())))
        return self.cache.get(key, partial(self._function, *args, **kwargs))

    def cache_clear(self) -> None:
        """Forget all results, as the caches of functools do."""
        self.cache.clear()
