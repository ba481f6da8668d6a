"""Errors of code from outside, in a sentence: what was raised, and where."""

from __future__ import annotations

from traceback import walk_tb

from scene2hap.errors import Scene2HapError

_OWN = __name__.partition(".")[0]


def failure_of(problem: Exception) -> str:
    """Return the message of one of our errors; for any other error its type, message, and the line that raised it.

    The line is the innermost one outside scene2hap, where a part of somebody else failed.
    """
    if isinstance(problem, Scene2HapError):
        return str(problem)
    at = ""
    for frame, line in walk_tb(problem.__traceback__):
        if frame.f_globals.get("__name__", "").partition(".")[0] != _OWN:
            at = f" at {frame.f_code.co_filename}:{line}"
    return f"{problem!r}{at}"
