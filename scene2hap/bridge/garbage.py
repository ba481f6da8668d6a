"""Pauses of Python's garbage collector."""

from __future__ import annotations

import gc


def settle_garbage() -> None:
    """Collect now, and leave what survives out of later collections, which would take some 60 ms in the middle of a
    frame. Call it after something large was loaded or closed."""
    gc.unfreeze()
    gc.collect()
    gc.freeze()
