"""Daemon threads that stop before Python exits, since a thread that computes meanwhile may crash it."""

from __future__ import annotations

import atexit
import ctypes
from collections.abc import Callable
from concurrent.futures import Future
from functools import partial
from queue import SimpleQueue
from threading import Event, Thread
from typing import Any, TypeVar
from weakref import WeakKeyDictionary, finalize

from scene2hap.common.deadline import Deadline

LAST_S = 10.0
"""Longest time [s] for which Python waits at its end for all threads together; a thread ends within the step of a
solver that it has begun."""

_Result = TypeVar("_Result")
_Tasks = SimpleQueue[Callable[[], None] | None]
_ENDING = Event()
_ENDS: WeakKeyDictionary[Thread, Callable[[], object]] = WeakKeyDictionary()


def start_worker(work: Callable[[], None], name: str, end: Callable[[], object]) -> Thread:
    """Start a daemon thread that runs `work`. Before Python exits, `end` tells it to stop."""
    worker = Thread(target=work, name=f"scene2hap {name}", daemon=True)
    _ENDS[worker] = end
    worker.start()
    return worker


class WorkerPool:
    """Up to `most` threads that carry out tasks, in the order in which they were submitted.

    A `ThreadPoolExecutor` would keep Python from exiting until its tasks are done. Threads start as tasks need them,
    and end once the pool is unused and its tasks are done.
    """

    def __init__(self, most: int, name: str) -> None:
        self._most, self._name = most, name
        self._tasks: _Tasks = SimpleQueue()
        self._unfinished: list[Future[Any]] = []
        self._n_threads = 0
        finalize(self, self._tasks.put, None)

    def submit(self, task: Callable[[], _Result]) -> Future[_Result]:
        """Let a thread carry out a task, and return its future result or error."""
        future: Future[_Result] = Future()
        self._tasks.put(partial(_carry_out, task, future))
        if self._n_threads < self._most:
            self._unfinished = [*(one for one in self._unfinished if not one.done()), future]
            if self._n_threads < len(self._unfinished):
                self._n_threads += 1
                start_worker(partial(_work, self._tasks), self._name, partial(self._tasks.put, None))
        return future


def _work(tasks: _Tasks) -> None:
    while (task := tasks.get()) is not None and not _ENDING.is_set():
        task()
        del task  # else what it refers to would live until the next one
    tasks.put(None)  # for the other threads


def _carry_out(task: Callable[[], _Result], future: Future[_Result]) -> None:
    try:
        future.set_result(task())
    except BaseException as problem:  # also the SystemExit of `_leave`
        future.set_exception(problem)


@atexit.register
def _end_all() -> None:
    until = Deadline(LAST_S)
    _ENDING.set()
    running = [(worker, end) for worker, end in _ENDS.items() if worker.is_alive()]
    for worker, end in running:
        end()
        _leave(worker)
    for worker, _ in running:
        worker.join(until.left_s)


def _leave(worker: Thread) -> None:
    """Raise SystemExit in a thread at its next step in Python: a model may prepare for longer than anybody waits."""
    assert worker.ident is not None
    ctypes.pythonapi.PyThreadState_SetAsyncExc(ctypes.c_ulong(worker.ident), ctypes.py_object(SystemExit))
