"""Memory, threads and files of a process, read from Linux's /proc."""

from __future__ import annotations

import os
from pathlib import Path


def memory_mb(pid: int | str = "self") -> float:
    """Resident memory [MB]."""
    pages = int(Path(f"/proc/{pid}/statm").read_text().split()[1])
    return pages * os.sysconf("SC_PAGE_SIZE") / 1e6


def n_threads() -> int:
    """Number of threads, native ones included."""
    return len(os.listdir("/proc/self/task"))


def n_files() -> int:
    """Number of open files."""
    return len(os.listdir("/proc/self/fd"))


def stolen_s() -> float:
    """Time since boot [s] in which the host of a virtual machine ran other machines."""
    return int(Path("/proc/stat").read_text().split()[8]) / os.sysconf("SC_CLK_TCK")
