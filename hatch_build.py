"""Compiles the kernels, `scene2hap/**/_*.pyx`, where a C compiler is at hand; see docs/decisions/0012.

Without one the package is built all the same: every kernel has a plain twin in Python. `SCENE2HAP_COMPILED` in the
environment of the build: 0 leaves them out, 1 makes it an error that they cannot be built, and so does "checked", with
which every index is looked at, for tests of the kernels themselves. A wheel for every machine, py3-none-any, to stand
beside compiled ones:

    SCENE2HAP_COMPILED=0 python3 -m pip wheel --no-deps --wheel-dir dist .
"""

from __future__ import annotations

import os
import shutil
import sys
from collections.abc import Iterator
from pathlib import Path
from tempfile import mkdtemp
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

# No contraction and no fast mathematics: the same digits on every machine. No debug symbols: Python's own flags ask for
# them, and they are two thirds of a wheel.
_FLAGS = (
    ["/O2", "/fp:precise"]
    if sys.platform == "win32"
    else ["-O3", "-ffp-contract=off", "-fno-math-errno", "-g0", "-Wall"]
)
# C's arrays and divisions, as its compiler knows them: indices are not looked at, and count from 0. Told here and not
# in each module, where a directive below the docstring would be a comment to Cython.
_DIRECTIVES = {"boundscheck": False, "wraparound": False, "cdivision": True}
_SHARED = "scene2hap._cyutility"


class CompiledKernels(BuildHookInterface):  # type: ignore[type-arg]  # hatchling's own examples give none
    """Adds the compiled modules to a wheel, or puts them beside their sources for an editable one."""

    _work = ""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Compile, before hatchling gathers the files."""
        wish = os.environ.get("SCENE2HAP_COMPILED", "")
        if self.target_name != "wheel" or wish == "0":
            return
        self._work = mkdtemp()
        source = Path(self.root)
        try:
            built = dict(_compiled(source, Path(self._work), is_checked=wish == "checked"))
        except Exception as problem:  # whatever a compiler that is not there, or half there, may bring about
            if wish in ("1", "checked"):
                raise
            self.app.display_warning(f"scene2hap is built without its compiled kernels: {problem}")
            return
        if version == "editable":
            for name, path in built.items():
                # A module that a running program has loaded is replaced, never written over: that would crash it.
                shutil.copy2(path, source / f"{name}.new")
                os.replace(source / f"{name}.new", source / name)
        else:
            build_data["force_include"] |= {str(path): name for name, path in built.items()}
            build_data["pure_python"], build_data["infer_tag"] = False, True

    def finalize(self, version: str, build_data: dict[str, Any], artifact_path: str) -> None:
        """Clean up, after hatchling has packed them."""
        shutil.rmtree(self._work, ignore_errors=True)


def _compiled(source: Path, work: Path, *, is_checked: bool) -> Iterator[tuple[str, Path]]:
    """Each compiled module: its place under `source`, and the file that was made of it in `work`."""
    from Cython.Build import cythonize
    from setuptools import Distribution, Extension

    kernels = [
        Extension(".".join(path.relative_to(source).with_suffix("").parts), [str(path)], extra_compile_args=_FLAGS)
        for path in sorted((source / "scene2hap").rglob("_*.pyx"))
    ]
    # What every module with typed arrays needs, two thirds of their C, is compiled once.
    shared = Extension(_SHARED, [str(work / "_cyutility.c")], extra_compile_args=_FLAGS)
    modules = cythonize(
        [shared, *kernels],
        build_dir=str(work / "c"),
        language_level=3,
        compiler_directives={**_DIRECTIVES, "boundscheck": is_checked},
        quiet=True,
        shared_utility_qualified_name=_SHARED,
    )
    command = Distribution({"ext_modules": modules}).get_command_obj("build_ext")
    command.build_lib, command.build_temp = str(work / "lib"), str(work / "o")
    command.parallel = os.cpu_count()
    command.ensure_finalized()
    command.run()
    for path in sorted((work / "lib").rglob("_*")):
        if path.is_file():
            yield path.relative_to(work / "lib").as_posix(), path
