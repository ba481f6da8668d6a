"""The warning of a scene, or of a use of it, that is almost certainly wrong."""

from __future__ import annotations

import sys
import warnings

_PASSED = (__name__.partition(".")[0], "asyncio")
"""Packages whose lines are not the caller's: our own, and the event loop in which `bake` runs."""


class SceneWarning(UserWarning):
    """A scene, or a use of it, that is almost certainly wrong."""


def warn_of(sentence: str) -> None:
    """Issue a SceneWarning that points at the caller's line."""
    level, frame = 2, sys._getframe(1)
    while frame.f_back is not None and frame.f_globals.get("__name__", "").partition(".")[0] in _PASSED:
        level, frame = level + 1, frame.f_back
    warnings.warn(sentence, SceneWarning, stacklevel=level)
