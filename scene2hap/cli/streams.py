"""Robust standard output and error: they may be closed, full, without reader, or in a limited encoding."""

from __future__ import annotations

import errno
import io
import os
import sys
from typing import IO


def prepare() -> None:
    """Let both streams accept any text: a closed one discards it, and letters outside the encoding are escaped."""
    for name in ("stdout", "stderr"):
        stream = getattr(sys, name)
        if stream is None:
            setattr(sys, name, open(os.devnull, "w", encoding="utf-8"))  # noqa: SIM115  # open until the process ends
        elif isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="backslashreplace")


def give_up(stream: IO[str] | None) -> None:
    """Discard all further output of a stream. Otherwise the interpreter would fail to flush it when it exits."""
    try:
        if stream is not None:
            nothing = os.open(os.devnull, os.O_WRONLY)
            os.dup2(nothing, stream.fileno())
            os.close(nothing)
    except (OSError, ValueError):  # not a stream of the operating system
        return


def flush() -> OSError | None:
    """Flush both streams. Returns the error of standard output, None if it was written or has no reader."""
    failed: OSError | None = None
    for stream in (sys.stderr, sys.stdout):
        try:
            stream.flush()
        except OSError as cause:
            give_up(stream)
            if stream is sys.stdout and not is_unread(cause):
                failed = cause
        except ValueError:  # closed in the meantime
            continue
    return failed


def is_unread(cause: OSError) -> bool:
    """Return True if the reader of a pipe has gone (`| head`), which is no error. Windows reports EINVAL then."""
    return isinstance(cause, BrokenPipeError) or (os.name == "nt" and cause.errno == errno.EINVAL)
