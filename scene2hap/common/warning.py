"""Warnings that point at the caller's line, the class of those about likely mistakes, and the one about a gain."""

from __future__ import annotations

import sys
import warnings
from types import FrameType

_PASSED = (__name__.partition(".")[0], "asyncio", "contextlib", "dataclasses")
"""Packages whose lines are not the caller's: our own, the event loop of `bake`, decorators, and copies of data."""
_STARTS = ("threading", "concurrent", "multiprocessing")
"""Packages that begin a worker; before their lines there is no line of a caller."""
_USUAL_DB = 40.0
"""Usual bound of a gain [dB]: a factor of 100, more than from the weakest to the strongest felt vibration."""


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


def warn_if_percent(gain_db: float) -> None:
    """Warn of a level above `_USUAL_DB` [dB], which is probably a percentage. Warns: SceneWarning."""
    if gain_db > _USUAL_DB:
        warn_of(
            f"gain_db is {gain_db:g} dB, a factor of {10 ** (gain_db / 20):.3g}, more than {_USUAL_DB:g} dB; it is in "
            "decibels, not in percent: 0 leaves the level, 6 doubles it, -6 halves it."
        )


def _package(frame: FrameType) -> str:
    name: str = frame.f_globals.get("__name__", "")
    return name.partition(".")[0]
