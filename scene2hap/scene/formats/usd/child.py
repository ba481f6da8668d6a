"""The child process that reads one USD file, `python -m scene2hap.scene.formats.usd.child`: `Request` in, `Answer` out.

Both are pickles, on standard input and output. Time and memory are limited. The parent drops usd-core's own output.
"""

from __future__ import annotations

import faulthandler
import os
import pickle
import sys
from pathlib import Path

from scene2hap.errors import ConfigError, MissingExtra, SceneError
from scene2hap.scene import limits
from scene2hap.scene.formats.usd.process import (
    MEMORY_BYTES,
    MEMORY_PER_BYTE,
    TIME_S,
    TIME_S_PER_BYTE,
    TIME_S_PER_PRIM,
    Answer,
    Request,
)
from scene2hap.scene.tree import AuthoredScene


class _Allowance:
    """Time and memory of this process. They grow with the bytes and the prims that it reads."""

    def __init__(self) -> None:
        self._n_bytes = self._n_prims = 0
        self.add(0, 0)

    def add(self, n_bytes: int, n_prims: int) -> None:
        self._n_bytes += n_bytes
        self._n_prims += n_prims
        # faulthandler's watchdog also runs while C++ holds the interpreter's lock; Python's threads and signal handlers
        # do not.
        allowed_s = TIME_S + TIME_S_PER_BYTE * self._n_bytes + TIME_S_PER_PRIM * self._n_prims
        faulthandler.dump_traceback_later(allowed_s, exit=True)
        if sys.platform == "linux":
            import resource

            allowed = MEMORY_BYTES + MEMORY_PER_BYTE * self._n_bytes
            most = resource.getrlimit(resource.RLIMIT_DATA)[1]
            soft = allowed if most == resource.RLIM_INFINITY else min(allowed, most)
            resource.setrlimit(resource.RLIMIT_DATA, (soft, most))


def main() -> None:
    """Answer the request on standard input."""
    request: Request = pickle.load(sys.stdin.buffer)
    # Printed text must not get into the answer.
    answers = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)
    for name, value in request.limits.items():
        setattr(limits, name, value)
    try:
        answer = Answer(_scene(request))
    except (SceneError, ConfigError) as error:
        answer = Answer(None, type(error).__name__, str(error))
    # Pickling a tree is recursive, with several calls for each level.
    sys.setrecursionlimit(max(sys.getrecursionlimit(), 20 * limits.MAX_DEPTH + 1000))
    pickle.dump(answer, answers, protocol=5)
    answers.close()
    # Releasing a stage takes long, and this process ends anyway.
    os._exit(0)


def _scene(request: Request) -> AuthoredScene:
    try:
        from scene2hap.scene.formats.usd.stage import read_stage
    except ImportError as cause:
        raise MissingExtra(f"usd-core does not import: {cause}. Run: pip install 'scene2hap[usd]'") from cause
    return read_stage(Path(request.path), Path(request.assets_root), _Allowance().add)


if __name__ == "__main__":
    main()
