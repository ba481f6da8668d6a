"""The client for C: compiled programs, and a driver that plays with it by commands."""

import json
import os
import shutil
import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

MAIN = Path(__file__).parents[2]
CLIENT = MAIN / "clients" / "c"
HERE = MAIN / "tests" / "integration" / "bridge" / "c"
C = shutil.which("cc") or shutil.which("gcc") or shutil.which("clang")
CPP = shutil.which("c++") or shutil.which("g++") or shutil.which("clang++")
WARNINGS = ("-Wall", "-Wextra", "-Wpedantic", "-Werror", "-Wconversion", "-Wsign-conversion", "-Wshadow")
SANITIZERS = ("-g", "-fsanitize=address,undefined", "-fno-sanitize-recover=all")
needs_cpp = pytest.mark.skipif(CPP is None, reason="no C++ compiler; on Debian: apt-get install g++")

needs_c = [
    pytest.mark.skipif(C is None, reason="no C compiler; on Debian: apt-get install gcc libc6-dev"),
    pytest.mark.skipif(os.name != "posix", reason="the C client is tested on POSIX systems"),
]

Build = Callable[..., Path]


def builder(folder: Path) -> Build:
    """Return a function that compiles a program once, with all warnings as errors."""
    made = dict[tuple[object, ...], Path]()
    (folder / "empty.c").write_text("int main(void) { return 0; }\n")
    command = [str(C), *SANITIZERS, "-o", str(folder / "empty"), str(folder / "empty.c")]
    has_sanitizers = not subprocess.run(command, capture_output=True, check=False).returncode

    def built(*sources: Path, language: str = "c99", flags: tuple[str, ...] = (), sanitized: bool = True) -> Path:
        key = (*sources, language, *flags, sanitized)
        if key not in made:
            compiler = [str(CPP), "-x", "c++"] if "++" in language else [str(C)]
            if sanitized and has_sanitizers:
                flags = (*flags, *SANITIZERS)
            program = folder / f"program{len(made)}"
            command = [*compiler, f"-std={language}", *WARNINGS, *flags, f"-I{CLIENT}", "-o", str(program)]
            run = subprocess.run([*command, *map(str, sources)], capture_output=True, text=True, check=False)
            assert run.returncode == 0, run.stderr
            made[key] = program
        return made[key]

    return built


class Driver:
    """The client in a driver program that executes commands, one per line."""

    def __init__(self, program: Path, **environment: str) -> None:
        self._process = subprocess.Popen(
            [str(program)],
            env={**os.environ, **environment},
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            encoding="utf-8",
        )
        self.printed: list[str] = []

    def do(self, command: str) -> list[dict[str, Any]]:
        """Send a command. Returns the lines printed until it was done."""
        assert self._process.stdin is not None
        assert self._process.stdout is not None
        self._process.stdin.write(command + "\n")
        self._process.stdin.flush()
        found: list[dict[str, Any]] = []
        for text in self._process.stdout:
            self.printed.append(text)
            found.append(json.loads(text))
            if "did" in found[-1]:
                return found[:-1]
        raise AssertionError(f"the driver ended during {command!r}: {self.end()}")

    def one(self, command: str) -> dict[str, Any]:
        (found,) = self.do(command)
        return found

    def until(self, kind: str, timeout_s: float = 60.0) -> dict[str, Any]:
        """Poll until an event of a kind comes; `before` holds the earlier events."""
        self.before = self.do(f"until {kind} {timeout_s:g}")
        assert self.before, f"no {kind}, and nothing else"
        assert self.before[-1]["event"] == kind, self.before
        return self.before.pop()

    def end(self) -> str:
        """End the program. Returns its error output, which is empty unless a sanitizer found a fault."""
        _, errors = self._process.communicate(timeout=60)
        if self._process.returncode:
            errors += f"status {self._process.returncode}"
        return errors

    def kill(self) -> None:
        self._process.kill()
        self._process.wait()


def kinds(events: list[dict[str, Any]]) -> list[str]:
    return [one["event"] for one in events]
