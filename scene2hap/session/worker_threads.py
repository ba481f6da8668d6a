"""Daemon threads that stop before Python exits, since a thread that computes meanwhile may crash it."""

from __future__ import annotations

import atexit
import ctypes
from collections.abc import Callable
from threading import Thread
from weakref import WeakKeyDictionary

from scene2hap.session.deadline import Deadline

LAST_S = 10.0
"""Longest time [s] for which Python waits at its end for all threads together; a thread ends within the step of a
solver that it has begun."""

_ENDS: WeakKeyDictionary[Thread, Callable[[], object]] = WeakKeyDictionary()


def start_worker(work: Callable[[], None], name: str, end: Callable[[], object]) -> Thread:
    """Start a daemon thread that runs `work`. Before Python exits, `end` tells it to stop."""
    worker = Thread(target=work, name=f"scene2hap {name}", daemon=True)
    _ENDS[worker] = end
    worker.start()
    return worker


@atexit.register
def _end_all() -> None:
    until = Deadline(LAST_S)
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
