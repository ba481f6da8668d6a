"""Run code of the documentation in this process; a process of its own would spend seconds on imports."""

from __future__ import annotations

import io
import sys
import warnings
from contextlib import chdir, redirect_stdout
from pathlib import Path
from unittest.mock import patch


def run_pasted(code: str, folder: Path, *arguments: str) -> str:
    """Run code in a folder, in a namespace of its own, with warnings as errors. Returns what it prints."""
    printed = io.StringIO()
    arguments_of_program = patch.object(sys, "argv", ["-c", *arguments])
    with chdir(folder), arguments_of_program, redirect_stdout(printed), warnings.catch_warnings():
        warnings.simplefilter("error")
        exec(compile(code, "<pasted>", "exec"), {"__name__": "__main__"})
    return printed.getvalue()
