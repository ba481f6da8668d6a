"""The warning of a scene, or of a use of it, that is almost certainly wrong."""

from __future__ import annotations

import sys
import warnings

_PACKAGE = __name__.partition(".")[0]


class SceneWarning(UserWarning):
    """A scene, or a use of it, that is almost certainly wrong."""


def warn_of(sentence: str) -> None:
    """Issue a SceneWarning that points at the calling line outside of this package."""
    level, frame = 2, sys._getframe(1)
    while frame.f_back is not None and frame.f_globals.get("__name__", "").partition(".")[0] == _PACKAGE:
        level, frame = level + 1, frame.f_back
    warnings.warn(sentence, SceneWarning, stacklevel=level)
