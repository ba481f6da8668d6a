"""Whether this process can start Python: a program with an embedded Python would start itself."""

from __future__ import annotations

import sys
from pathlib import Path


def can_start_python() -> bool:
    """Return True if `sys.executable` is a Python interpreter, not a program with an embedded Python."""
    is_frozen = getattr(sys, "frozen", False)
    return not is_frozen and bool(sys.executable) and Path(sys.executable).stem.lower().startswith(("python", "pypy"))
