"""A cache for functions whose results are large and shared: bodies of plates and their modes.

A scene may have any number of plates, so no fixed number of results suffices for all of them: an LRU cache that is one
entry too small for a scene returns none of its plates. A result therefore stays cached as long as anything refers to
it, such as a field. The newest results stay cached longer, for objects that are lifted and put down again.
"""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable, Hashable
from functools import update_wrapper
from typing import Generic, ParamSpec, TypeVar
from weakref import WeakValueDictionary

from scene2hap.common.byte_bounded_lru import Sized
from scene2hap.common.forks import lock_of_process

KEPT_BYTES = 128 * 2**20
"""Size of the newest results of a function, which stay cached although nothing refers to them."""

_Given = ParamSpec("_Given")
_Result = TypeVar("_Result", bound=Sized)


class cached_while_used(Generic[_Given, _Result]):
    """Cache the results of a function of hashable arguments: all that anything refers to, and the newest `KEPT_BYTES`.

    Safe to call from several threads: a worker prepares a field while another one prepares an impact. Both may compute
    the same result; they then share the first one.
    """

    def __init__(self, function: Callable[_Given, _Result]) -> None:
        self._function, self._lock = function, lock_of_process()
        self._used: WeakValueDictionary[Hashable, _Result] = WeakValueDictionary()
        self._newest: OrderedDict[Hashable, _Result] = OrderedDict()
        self._kept_bytes = 0
        update_wrapper(self, function)

    def __call__(self, *args: _Given.args, **kwargs: _Given.kwargs) -> _Result:
        """Return the result for these arguments."""
        key = (args, tuple(sorted(kwargs.items())))
        result = self._used.get(key)
        if result is None:
            result = self._function(*args, **kwargs)
        dropped = []  # freed without the lock, since that takes time
        with self._lock:
            result = self._used.setdefault(key, result)
            if key not in self._newest:
                self._newest[key] = result
                self._kept_bytes += result.nbytes
            self._newest.move_to_end(key)
            while self._kept_bytes > KEPT_BYTES and len(self._newest) > 1:
                dropped.append(self._newest.popitem(last=False)[1])
                self._kept_bytes -= dropped[-1].nbytes
        return result

    def cache_clear(self) -> None:
        """Forget all results."""
        with self._lock:
            self._used.clear()
            self._newest.clear()
            self._kept_bytes = 0
