"""Whether this process can start Python, and how often: a program with an embedded Python would start itself."""

from __future__ import annotations

import sys
from pathlib import Path


def can_start_python() -> bool:
    """Return True if `sys.executable` is a Python interpreter, not a program with an embedded Python."""
    is_frozen = getattr(sys, "frozen", False)
    return not is_frozen and bool(sys.executable) and Path(sys.executable).stem.lower().startswith(("python", "pypy"))


def most_workers(n_wanted: int) -> int:
    """Return how many processes a pool may have: all that are wanted, on Windows at most 61.

    Windows waits for 63 handles at most, two of which are Python's own. Larger pools raise a ValueError there.
    """
    return min(n_wanted, 61) if sys.platform == "win32" else n_wanted
