"""State of this process that a forked child must not take over.

A fork copies memory, but only the thread that forks. In the child, a lock that another thread held would stay locked,
and a thread pool would never do its work.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from threading import Lock


def renew_in_child(renew: Callable[[], object]) -> None:
    """Call `renew` in each process that is forked from this one, before anything else runs there."""
    if hasattr(os, "register_at_fork"):  # Windows has no fork
        os.register_at_fork(after_in_child=renew)


def lock_of_process() -> Lock:
    """Return a lock that is open in a forked child. It is never freed, so it is for the state of modules."""
    lock = Lock()
    # The standard library uses this method for its own locks. Locks of Windows, which has no fork, are without it.
    if hasattr(lock, "_at_fork_reinit"):
        renew_in_child(lock._at_fork_reinit)
    return lock
