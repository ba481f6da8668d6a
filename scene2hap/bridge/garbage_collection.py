"""Control of Python's garbage collector."""

from __future__ import annotations

import gc


def settle_garbage() -> None:
    """Collect garbage, and exempt the rest from later collections, which take some 60 ms within a frame.

    Call this after loading or closing something large.
    """
    gc.unfreeze()
    gc.collect()
    gc.freeze()
