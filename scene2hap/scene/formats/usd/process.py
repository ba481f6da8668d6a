"""The parent's side of the child process that reads a USD file.

usd-core parses files in C++. Of 8,000 broken binary files it crashed on 11, and deep text overflows its stack
(`stress/fuzz_scenes.py --kinds .usdc`). A process cannot catch its own crash. The child also has limits of memory (only
on Linux) and of time, since a few bytes may define any number of prims.

A program that is no Python interpreter, such as a frozen application, cannot start a child, and reads the file itself.
"""

from __future__ import annotations

import os
import pickle
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path
from typing import NamedTuple

from scene2hap import errors
from scene2hap.common.worker_processes import can_start_python
from scene2hap.errors import MissingExtra, SceneError, SceneFormatError, reason_of
from scene2hap.scene import limits
from scene2hap.scene.files import check_file
from scene2hap.scene.tree import AuthoredScene

TIME_S, TIME_S_PER_BYTE, TIME_S_PER_PRIM = 30.0, 4e-7, 2e-3
"""Time for the child after its start [s], and further time for each byte and each prim of its layers.

Assumed: three times the time of a slow laptop.
"""
MEMORY_BYTES, MEMORY_PER_BYTE = 1 << 30, 40
"""Memory for the child's data [bytes], and further bytes for each byte that it reads (assumed; on Linux)."""
# Each thread of usd-core reserves memory for its stack, and a large machine has hundreds of threads.
_THREADS = "PXR_WORK_THREAD_LIMIT"
TIMED_OUT = "Timeout ("
"""Start of the message that the child prints when its time is over."""


class Request(NamedTuple):
    """The file for the child to read, and the limits of the parent."""

    path: str
    assets_root: str
    limits: dict[str, float]


class Answer(NamedTuple):
    """The scene, or the name of an error's class in `scene2hap.errors` and its message."""

    scene: AuthoredScene | None
    error: str = ""
    message: str = ""


def read_usd(path: Path, assets_root: Path) -> AuthoredScene:
    """Return the composed scene of a USD file with its looks and masses; `up_axis` and `unit_m` come from the stage.

    Layers and textures are read only from inside `assets_root`. Matrices, sizes and vertices are in the stage's unit.
    Raises: MissingExtra: usd-core is not installed. SceneFormatError: the file is not USD, is broken, or takes too much
    time or memory. SceneError: it is missing or too large, or needs a layer that is missing or outside `assets_root`.
    """
    if find_spec("pxr") is None:
        raise MissingExtra(f"{path.name!r} is USD, and its reader is not installed. Run: pip install 'scene2hap[usd]'")
    check_file(path)
    if not can_start_python():
        from scene2hap.scene.formats.usd.stage import read_stage

        return read_stage(path, assets_root)
    chosen = {name: value for name, value in vars(limits).items() if name.startswith("MAX_")}
    request = Request(os.path.abspath(path), os.path.abspath(assets_root), chosen)
    # The child must find the packages of this process in any working directory.
    found_in = os.pathsep.join(folder or os.getcwd() for folder in sys.path)
    try:
        done = subprocess.run(
            [sys.executable, "-P", "-m", "scene2hap.scene.formats.usd.child"],
            input=pickle.dumps(request),
            capture_output=True,
            env={_THREADS: "4", **os.environ, "PYTHONPATH": found_in},
            creationflags=getattr(subprocess, "CREATE_NO_WINDOW", 0),
            check=False,
        )
    except OSError as cause:
        raise SceneError(
            f"{path.name!r} is not read, since no process can be started for it: {reason_of(cause)}."
        ) from cause
    if done.returncode != 0:
        raise SceneFormatError(f"{path.name!r} cannot be read as USD: {_failure(done)} The file may be broken.")
    answer: Answer = pickle.loads(done.stdout)
    if answer.scene is None:
        raise getattr(errors, answer.error)(answer.message)
    return answer.scene


def _failure(done: subprocess.CompletedProcess[bytes]) -> str:
    """Return a sentence about a child that gave no answer."""
    said = done.stderr.decode("utf-8", "replace")
    if TIMED_OUT in said:
        return (
            f"it takes longer than {TIME_S:g} s, and {TIME_S_PER_BYTE * 1e6:g} s for each megabyte and "
            f"{TIME_S_PER_PRIM * 1e3:g} s for each 1,000 prims."
        )
    if "bad_alloc" in said or "MemoryError" in said:
        return f"it takes more than {MEMORY_BYTES >> 20} MB, and {MEMORY_PER_BYTE} bytes for each that it has."
    return f"usd-core ended with status {done.returncode}."
