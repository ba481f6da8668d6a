"""Warnings that point at the caller's line, and the class of those about input that is probably a mistake."""

from __future__ import annotations

import sys
import threading
import warnings

_PASSED = (__name__.partition(".")[0], "asyncio", "contextlib", "dataclasses")
"""Packages whose lines are not the caller's: our own, the event loop of `bake`, decorators, and copies of data."""


class SceneWarning(UserWarning):
    """Input that is probably a mistake: a scene, or a use of it. The program continues."""


def warn_of(sentence: str, category: type[Warning] = SceneWarning) -> None:
    """Issue a warning that points at the caller's line; on a worker thread, which has none, at the line that warns."""
    level, frame = 2, sys._getframe(1)
    while frame.f_back is not None and frame.f_globals.get("__name__", "").partition(".")[0] in _PASSED:
        level, frame = level + 1, frame.f_back
    if frame.f_globals.get("__name__") == threading.__name__:
        level = 2
    warnings.warn(sentence, category, stacklevel=level)
