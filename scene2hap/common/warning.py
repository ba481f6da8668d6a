"""Warnings that point at the caller's line, and the class of those about likely mistakes."""

from __future__ import annotations

import sys
import warnings
from types import FrameType

_PASSED = (__name__.partition(".")[0], "asyncio", "contextlib", "dataclasses")
"""Packages whose lines are not the caller's: our own, the event loop of `bake`, decorators, and copies of data."""
_STARTS = ("threading", "concurrent", "multiprocessing")
"""Packages that begin a worker; before their lines there is no line of a caller."""


class SceneWarning(UserWarning):
    """Input that is probably a mistake: a scene, or a use of it. The program continues."""


def warn_of(sentence: str, category: type[Warning] = SceneWarning) -> None:
    """Issue a warning that points at the caller's line; on a worker, which has none, at the line that warns."""
    level, frame = 2, sys._getframe(1)
    while frame.f_back is not None and _package(frame) in _PASSED:
        level, frame = level + 1, frame.f_back
    if _package(frame) in _STARTS:
        level = 2
    warnings.warn(sentence, category, stacklevel=level)


def _package(frame: FrameType) -> str:
    name: str = frame.f_globals.get("__name__", "")
    return name.partition(".")[0]
