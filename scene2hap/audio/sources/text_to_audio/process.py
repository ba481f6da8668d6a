"""Run an external program with limits of time and disk space.

The program gets its own folder, no standard input, and no keys; its output is written to a file in that folder.
Processes that the program started end with it.
"""

from __future__ import annotations

import contextlib
import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from scene2hap.audio.sources.disk_cache import plain_line
from scene2hap.common.checks import SECRET_NAME
from scene2hap.common.key_search import masked
from scene2hap.errors import BackendUnavailable

MAX_FILES = 1000
LOG_NAME = "log.txt"

_POLL_S = 0.05
_TAIL_BYTES = 2000
_SHOWN = 400
_SHORTEST_SCRUBBED = 8


class CannotStart(BackendUnavailable):
    """The program is missing or may not be run, so that every other request would fail, too."""


@dataclass(frozen=True)
class ProgramLimits:
    """Limits of a program: running time [s], and written data including its output [bytes]."""

    timeout_s: float
    max_bytes: int


def environment(kept: Iterable[str], variables: Mapping[str, str]) -> dict[str, str]:
    """Return the variables whose names are `kept`, or do not end in key, token, secret, password or credential."""
    named = set(kept)
    return {name: value for name, value in variables.items() if name in named or not SECRET_NAME.search(name)}


def scrubbed(text: str, variables: Mapping[str, str]) -> str:
    """Return a text in which the keys among the program's variables are masked."""
    for name, value in variables.items():
        if SECRET_NAME.search(name) and len(value) >= _SHORTEST_SCRUBBED:
            text = masked(text, value)
    return text


def run(command: Sequence[str], folder: Path, allowance: ProgramLimits, variables: Mapping[str, str]) -> None:
    """Run a command to its end; it must write all files into `folder`.

    Raises: CannotStart; BackendUnavailable: it failed, took too long or wrote too much. The message ends with the
    program's last output.
    """
    log = folder / LOG_NAME
    with log.open("wb") as output:
        try:
            process = subprocess.Popen(
                list(command),
                stdin=subprocess.DEVNULL,
                stdout=output,
                stderr=subprocess.STDOUT,
                env=dict(variables),
                start_new_session=True,
            )
        except (OSError, ValueError) as cause:
            reason = cause.strerror if isinstance(cause, OSError) else cause
            raise CannotStart(f"cannot start {command[0]!r}: {reason}. Check `command` or `python`.") from cause
    name = Path(command[0]).name
    try:
        fate = _watched(process, folder, allowance)
    finally:
        _end(process)
    if not fate and process.returncode:
        fate = _died(process.returncode)
    if fate:
        raise BackendUnavailable(f"{name} {fate}. It said last: {_last_words(log, variables)}", retryable=False)


def _watched(process: subprocess.Popen[bytes], folder: Path, allowance: ProgramLimits) -> str:
    """Wait for the end of a program. Returns: the limit that it broke; "" if none."""
    deadline = time.monotonic() + allowance.timeout_s
    while True:
        try:
            process.wait(_POLL_S)
            over = True
        except subprocess.TimeoutExpired:
            over = False
        n_files, n_bytes = _written(folder)
        if n_bytes > allowance.max_bytes or n_files > MAX_FILES:
            return (
                f"wrote {n_files} files of {n_bytes / 1e6:.0f} MB in all, above {MAX_FILES} files or "
                f"{allowance.max_bytes / 1e6:.0f} MB"
            )
        if over:
            return ""
        if time.monotonic() > deadline:
            return f"did not finish within {allowance.timeout_s:g} s; raise timeout_s if it needs longer"


def _written(folder: Path) -> tuple[int, int]:
    """Return the numbers of files and bytes below a folder, counted up to `MAX_FILES`; links are not followed."""
    n_files = n_bytes = 0
    unread = [str(folder)]
    while unread and n_files <= MAX_FILES:
        try:
            with os.scandir(unread.pop()) as entries:
                for entry in entries:
                    n_files += 1
                    if entry.is_dir(follow_symlinks=False):
                        unread.append(entry.path)
                    else:
                        n_bytes += entry.stat(follow_symlinks=False).st_size
                    if n_files > MAX_FILES:
                        break
        except FileNotFoundError:
            continue  # gone since it was listed
    return n_files, n_bytes


def _end(process: subprocess.Popen[bytes]) -> None:
    """End the program and all processes of its group, also those that it left behind."""
    if sys.platform != "win32":
        with contextlib.suppress(ProcessLookupError, PermissionError):  # it has ended already
            os.killpg(process.pid, signal.SIGKILL)
    elif process.poll() is None:
        process.kill()
    process.wait()


def _died(status: int) -> str:
    if sys.platform != "win32" and status < 0:
        hint = " (out of memory?)" if -status == signal.SIGKILL else ""
        return f"was ended by signal {-status}{hint}"
    return f"ended with status {status}"


def _last_words(log: Path, variables: Mapping[str, str]) -> str:
    with log.open("rb") as file:
        file.seek(max(0, log.stat().st_size - _TAIL_BYTES))
        text = plain_line(file.read().decode("utf-8", "replace"), _TAIL_BYTES)
    return scrubbed(text, variables)[-_SHOWN:] or "nothing"
