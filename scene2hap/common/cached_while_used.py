"""A cache for results that are large and shared: bodies of plates and their modes, loops in bands.

A scene may have any number of plates, so no fixed number of results suffices for all of them: an LRU cache that is one
entry too small for a scene returns none of its plates. A result therefore stays cached as long as anything refers to
it, such as a field. The newest results stay cached longer, for objects that are lifted and put down again.
"""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable, Hashable
from functools import partial, update_wrapper
from typing import Generic, ParamSpec, Protocol, TypeVar
from weakref import WeakValueDictionary

from scene2hap.common.forks import lock_of_process


class Sized(Protocol):
    """A value with a known size in memory, such as an array."""

    @property
    def nbytes(self) -> int:
        """Memory [byte]."""
        ...


MOST_BYTES = 128 * 2**20
"""Size of the newest results of a function, which stay cached although nothing refers to them."""

_Given = ParamSpec("_Given")
_Result = TypeVar("_Result", bound=Sized)


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
