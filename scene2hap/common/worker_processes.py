"""Worker processes of our own: new interpreters, which end at once if their work is interrupted."""

from __future__ import annotations

import multiprocessing
import signal
import sys
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from contextlib import contextmanager
from pathlib import Path
from typing import Any, TypeVar

Result = TypeVar("Result")

WAIT_S = 0.2
"""Longest wait of a main thread at once: on Windows, Ctrl-C does not end a wait for a thread or a lock."""


@contextmanager
def worker_processes(
    n_workers: int, set_up: Callable[..., object] | None = None, *given: Any
) -> Iterator[ProcessPoolExecutor]:
    """Provide workers until the block ends, or raises: they then drop their tasks.

    Parameters: set_up, given : function that each worker calls first, and its arguments.
    """
    pool = begin_workers(n_workers, set_up, *given)
    try:
        yield pool
    except BaseException:
        end_workers(pool, at_once=True)
        raise
    end_workers(pool, at_once=False)


def begin_workers(n_workers: int, set_up: Callable[..., object] | None = None, *given: Any) -> ProcessPoolExecutor:
    """Return a pool of workers, each of which is started with the first task for it."""
    # Spawned processes are the same on every system. A fork would copy the threads and locks of this process.
    context = multiprocessing.get_context("spawn")
    return ProcessPoolExecutor(n_workers, mp_context=context, initializer=_begin, initargs=(set_up, given))


def end_workers(pool: ProcessPoolExecutor, *, at_once: bool) -> None:
    """End workers when they have done what they have begun, or at once."""
    # Up to Python 3.13 no public call ends workers; `terminate_workers` of 3.14 reads the same attribute.
    for worker in list((pool._processes or {}).values()) if at_once else []:
        worker.terminate()
    # Wait for the pool's own thread: if it closes its pipe while Python exits, that prints a traceback.
    pool.shutdown(wait=True, cancel_futures=True)


def as_finished(tasks: Iterable[Future[Result]]) -> Iterator[Future[Result]]:
    """Yield tasks as they finish, as `concurrent.futures.as_completed` does, but Ctrl-C ends the wait everywhere."""
    left = set(tasks)
    while left:
        done, left = wait(left, timeout=WAIT_S, return_when=FIRST_COMPLETED)
        yield from done


def can_start_python() -> bool:
    """Return True if `sys.executable` is a Python interpreter, not a program with an embedded Python."""
    is_frozen = getattr(sys, "frozen", False)
    return not is_frozen and bool(sys.executable) and Path(sys.executable).stem.lower().startswith(("python", "pypy"))


def most_workers(n_wanted: int) -> int:
    """Return how many processes a pool may have: all that are wanted, on Windows at most 61.

    Windows waits for 63 handles at most, two of which are Python's own. Larger pools raise a ValueError there.
    """
    return min(n_wanted, 61) if sys.platform == "win32" else n_wanted


def _begin(set_up: Callable[..., object] | None, given: tuple[Any, ...]) -> None:
    # A terminal sends Ctrl-C to workers, too: each would print a traceback, or take it for the result of its task and
    # begin the next.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    if set_up is not None:
        set_up(*given)
