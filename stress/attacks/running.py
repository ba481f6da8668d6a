"""Run an attack in a child process with limits, and check the outcome."""

from __future__ import annotations

import contextlib
import hashlib
import os
import re
import resource
import shutil
import signal
import sys
import time
import traceback
from dataclasses import dataclass
from pathlib import Path

from stress.attacks.attack import Attack

_WALL_FACTOR = 6.0
_RAW_CONTROL = re.compile(rb"[\x00-\x08\x0b\x0c\x0e-\x1f\x7f]|\xc2[\x80-\x9f]")
_OURS = re.compile(rb"^(scene2hap(\.\w+)?|scene2hap \w+|[\w.]+): (error|warning): ", re.MULTILINE)


@dataclass(frozen=True)
class Verdict:
    """Outcome of one attack; `fault` is "" if it passed."""

    attack: Attack
    status: int
    seconds: float
    memory_bytes: int
    bytes_outside: int
    is_raw: bool
    fault: str


def run(attack: Attack, around: Path) -> Verdict:
    """Run an attack in a new folder within `around`, whose other files are the canaries."""
    folder = around / "case"
    shutil.rmtree(folder, ignore_errors=True)
    for inner in ("home", "tmp"):
        (folder / inner).mkdir(parents=True)
    watched = (around, *attack.untouched)
    before = _contents(watched, folder)
    logs = folder / "tmp"
    (logs / "stdin").write_bytes(attack.stdin)
    status, seconds, memory = _child(attack, folder, logs)
    out, err = ((logs / name).read_bytes() for name in ("stdout", "stderr"))
    after = _contents(watched, folder)
    outside = sum(
        max(len_ for len_, _ in (before.get(path, (0, "")), after.get(path, (0, "")))) or 1
        for path in before.keys() | after.keys()
        if before.get(path) != after.get(path)
    )
    is_raw = b"Traceback (most recent call last)" in err + out
    fault = _fault(attack, status, seconds, memory, outside, out, err, is_raw=is_raw)
    shutil.rmtree(folder, ignore_errors=True)
    return Verdict(attack, status, seconds, memory, outside, is_raw, fault)


def _fault(
    attack: Attack, status: int, seconds: float, memory: int, outside: int, out: bytes, err: bytes, *, is_raw: bool
) -> str:
    tail = err.decode("utf-8", "replace").strip()[-200:].replace("\n", " | ")
    if is_raw:
        return f"traceback: {tail}"
    if status < 0:
        return f"ended by signal {-status} after {seconds:.1f} s"
    if status not in (0, 1, 2, 130):
        return f"exit status {status}: {tail}"
    if status and not _OURS.search(err):
        return f"exit status {status} without a sentence: {tail}"
    if outside:
        return f"{outside} bytes changed outside"
    if seconds > attack.seconds:
        return f"{seconds:.1f} s of processor time"
    if memory > attack.memory_bytes:
        return f"{memory >> 20} MB"
    if _RAW_CONTROL.search(out + err):
        return f"raw control characters: {_RAW_CONTROL.findall(out + err)[:3]}"
    return ""


def _child(attack: Attack, folder: Path, logs: Path) -> tuple[int, float, int]:
    """Fork and run the attack. Returns exit status (negative: a signal), processor time [s] and peak memory [bytes]."""
    pid = os.fork()
    if pid == 0:
        status = 71
        try:
            status = _in_child(attack, folder, logs)
        except BaseException:
            traceback.print_exc()
        finally:
            for stream in (sys.stdout, sys.stderr):
                with contextlib.suppress(Exception):
                    stream.flush()
            os._exit(status)
    deadline = time.monotonic() + _WALL_FACTOR * attack.seconds + 5.0
    while True:
        done, status, used = os.wait4(pid, os.WNOHANG)
        if done:
            break
        if time.monotonic() > deadline:
            os.kill(pid, signal.SIGKILL)
            deadline = float("inf")
        time.sleep(0.002)
    return os.waitstatus_to_exitcode(status), used.ru_utime + used.ru_stime, used.ru_maxrss * 1024


def _in_child(attack: Attack, folder: Path, logs: Path) -> int:
    os.setsid()
    os.chdir(folder)
    for number, (name, flags) in enumerate(
        (("stdin", os.O_RDONLY), ("stdout", os.O_WRONLY | os.O_CREAT), ("stderr", os.O_WRONLY | os.O_CREAT))
    ):
        os.dup2(os.open(logs / name, flags, 0o600), number)
    sys.stdin = os.fdopen(0, encoding="utf-8", closefd=False)
    sys.stdout = os.fdopen(1, "w", encoding="utf-8", closefd=False)
    sys.stderr = os.fdopen(2, "w", encoding="utf-8", errors="backslashreplace", closefd=False)
    os.environ.update(HOME=str(folder / "home"), XDG_CACHE_HOME=str(folder / "home"), TMPDIR=str(folder / "tmp"))
    limit = int(attack.seconds * 2) + 2
    resource.setrlimit(resource.RLIMIT_CPU, (limit, limit + 1))
    resource.setrlimit(resource.RLIMIT_DATA, (2 * attack.memory_bytes,) * 2)
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    if attack.call is not None:
        return attack.call()
    if attack.argv[0] != "scene2hap" and shutil.which(attack.argv[0]):
        os.execvp(attack.argv[0], attack.argv)
    from scene2hap.cli import main

    try:
        return main(attack.argv[1:] if attack.argv[0] == "scene2hap" else attack.argv)
    except SystemExit as ended:
        return ended.code if isinstance(ended.code, int) else 1


def _contents(roots: tuple[Path, ...], leave_out: Path) -> dict[str, tuple[int, str]]:
    """Size and digest of every file, and the name of every folder, below the roots."""
    found: dict[str, tuple[int, str]] = {}
    for root in roots:
        paths = (
            [root] if root.is_file() else [path for path in root.rglob("*") if leave_out not in (path, *path.parents)]
        )
        for path in paths:
            is_file = path.is_file() and not path.is_symlink()
            data = path.read_bytes() if is_file else b""
            found[str(path)] = (len(data), hashlib.sha256(data).hexdigest() if is_file else "folder")
    return found
