"""Daemon threads that stop before Python exits, since a thread that computes meanwhile may crash it."""

from __future__ import annotations

import atexit
from collections.abc import Callable
from threading import Thread
from weakref import WeakKeyDictionary

from scene2hap.session.deadline import Deadline

LAST_S = 2.0
"""Longest time [s] for which Python waits at its end for all threads together."""

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
    running = list(_ENDS.items())
    for _, end in running:
        end()
    for worker, _ in running:
        worker.join(until.left_s)
