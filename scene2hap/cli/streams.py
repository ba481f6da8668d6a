"""Standard output and error as they may be: closed, full, unread, or of an encoding that lacks most letters."""

from __future__ import annotations

import errno
import io
import os
import sys
from typing import IO


def prepare() -> None:
    """Let both take any text: into nothing where one is closed, and as escapes what the encoding has no letter for."""
    for name in ("stdout", "stderr"):
        stream = getattr(sys, name)
        if stream is None:
            setattr(sys, name, open(os.devnull, "w", encoding="utf-8"))  # noqa: SIM115  # as long as the process lives
        elif isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="backslashreplace")


def give_up(stream: IO[str] | None) -> None:
    """Send what is still to come into nothing, lest the interpreter fails to write it when it ends."""
    try:
        if stream is not None:
            nothing = os.open(os.devnull, os.O_WRONLY)
            os.dup2(nothing, stream.fileno())
            os.close(nothing)
    except (OSError, ValueError):  # no stream of the system's
        return


def flush() -> OSError | None:
    """Write out both. Returns why standard output could not be written, None where it was or nobody reads it."""
    failed: OSError | None = None
    for stream in (sys.stderr, sys.stdout):
        try:
            stream.flush()
        except OSError as cause:
            give_up(stream)
            if stream is sys.stdout and not is_unread(cause):
                failed = cause
        except ValueError:  # closed meanwhile
            continue
    return failed


def is_unread(cause: OSError) -> bool:
    """Whether the reader of a pipe has gone (`| head`), which is nobody's fault. Windows says so by EINVAL."""
    return isinstance(cause, BrokenPipeError) or (os.name == "nt" and cause.errno == errno.EINVAL)
