"""The process of a bake: its answers on standard output."""

import io
import json
import sys
import time
import warnings
from concurrent.futures import ThreadPoolExecutor
from contextvars import copy_context
from typing import Any

import pytest

from scene2hap.bridge import bake_process
from scene2hap.errors import Scene2HapError


class SlowOutput(io.StringIO):
    """Lets other threads run before each write, as a full pipe does."""

    def write(self, text: str) -> int:
        time.sleep(0.001)
        return super().write(text)


def test_warnings_of_threads_and_progress_are_whole_lines(monkeypatch: pytest.MonkeyPatch) -> None:
    def baked(_: Any, progress: Any) -> Any:
        def work(number: int) -> None:
            progress("loops", f"item {number}", number, 20)
            warnings.showwarning(f"warning {number}", UserWarning, __file__, 1)

        with ThreadPoolExecutor(4) as threads:
            list(threads.map(work, range(20)))
        raise Scene2HapError("the end")

    output = SlowOutput()
    monkeypatch.setattr(sys, "stdin", io.StringIO("{}"))
    monkeypatch.setattr(sys, "stdout", output)
    monkeypatch.setattr(warnings, "showwarning", warnings.showwarning)
    monkeypatch.setattr(bake_process, "baked", baked)
    copy_context().run(bake_process.main)
    kinds = [next(iter(json.loads(line))) for line in output.getvalue().splitlines()]
    assert sorted(kinds) == ["error"] + ["progress"] * 20 + ["warning"] * 20
