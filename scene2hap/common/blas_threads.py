"""One BLAS thread while scene2hap computes.

Its matrices are small. Several BLAS threads would wait for each other, busily: beside a game that uses the cores, the
demo kitchen then takes four to six times as long to prepare, and an update up to twice as long
(docs/figures/playing.md).
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import ContextDecorator
from functools import cache
from typing import Final, Protocol

from scene2hap.common.forks import lock_of_process, renew_in_child


class _Library(Protocol):
    """A BLAS library of this process, as `threadpoolctl` describes it."""

    def get_num_threads(self) -> int | None:
        """Return the number of its threads."""

    def set_num_threads(self, num_threads: int) -> object:
        """Set the number of its threads, for the whole process."""


class OneBlasThread(ContextDecorator):
    """Context, and decorator of functions, in which BLAS has one thread. Contexts may overlap, on any threads.

    The number of threads belongs to the process: programs that use numpy beside scene2hap have one thread, too, until
    the last context ends. It is then as before.
    """

    def __init__(self) -> None:
        self._lock = lock_of_process()
        self._n_inside = 0
        self._before: list[tuple[_Library, int]] = []
        renew_in_child(self._leave)

    def _leave(self) -> None:
        """Forget the threads of the parent. The last exit in the child still restores the numbers of threads."""
        self._n_inside = 0

    def __enter__(self) -> None:
        with self._lock:
            if not self._n_inside:
                for library in _libraries():
                    n_threads = library.get_num_threads()
                    if n_threads is not None and n_threads > 1:
                        self._before.append((library, n_threads))
                        set_threads(library, 1)
            self._n_inside += 1

    def __exit__(self, *error: object) -> None:
        with self._lock:
            self._n_inside -= 1
            if not self._n_inside:
                for library, n_threads in self._before:
                    set_threads(library, n_threads)
                self._before.clear()


one_blas_thread: Final = OneBlasThread()
"""The one context of the process."""


def set_threads(library: _Library, n_threads: int) -> None:
    """Set the number of threads of a library, without effect if the program limits it by `threadpoolctl` itself."""
    library.set_num_threads(n_threads)
    # From version 3.8 on, only the first thread that sets a number may set others, until it gives that up.
    give_up = getattr(library, "clear_controlling_thread", None)
    if give_up is not None:
        give_up()


@cache
def _libraries() -> Sequence[_Library]:
    """Return the BLAS libraries of numpy and scipy, which have one each."""
    import scipy.linalg  # noqa: F401  # loads scipy's library
    from threadpoolctl import ThreadpoolController

    found: Sequence[_Library] = ThreadpoolController().select(user_api="blas").lib_controllers
    return found
