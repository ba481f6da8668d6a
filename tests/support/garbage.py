"""Tests without the garbage collector, as in games that switch it off, and with one that only sees new objects."""

import gc
from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def no_garbage_collection() -> Iterator[None]:
    """Run a block without the garbage collector."""
    was_enabled = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if was_enabled:
            gc.enable()


@contextmanager
def only_new_garbage() -> Iterator[None]:
    """Hide all present objects from the garbage collector during a block.

    With the thousands of tests that pytest has collected, each `gc.collect` would take about a second.
    """
    gc.freeze()
    try:
        yield
    finally:
        gc.unfreeze()
