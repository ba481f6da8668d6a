"""Compile the kernels, `scene2hap/**/_*.pyx`, if a C compiler is available; see docs/decisions/0012.

Without a compiler the package is built without them: every kernel has a twin in Python. The environment variable
`SCENE2HAP_COMPILED` controls the build. With 0 the kernels are left out; with 1 the build fails if they cannot be
compiled. "checked" is like 1 and also checks every index, for tests of the kernels. A wheel for every machine,
py3-none-any, in addition to compiled ones:

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

# No contraction and no fast mathematics, so that results are the same on every machine. No debug symbols: Python's own
# flags request them, and they are two thirds of a wheel.
_FLAGS = (
    ["/O2", "/fp:precise"]
    if sys.platform == "win32"
    else ["-O3", "-ffp-contract=off", "-fno-math-errno", "-g0", "-Wall"]
)
# Arrays and divisions as in C: indices are not checked, and negative ones do not count from the end. Set here and not
# in each module, since Cython would take a directive below the docstring as a comment.
_DIRECTIVES = {"boundscheck": False, "wraparound": False, "cdivision": True}
_SHARED = "scene2hap._cyutility"


class CompiledKernels(BuildHookInterface):  # type: ignore[type-arg]  # hatchling's own examples give none
    """Build hook that adds the compiled modules to a wheel, or puts them beside their sources for an editable one."""

    _work = ""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Compile the kernels before hatchling collects the files."""
        wish = os.environ.get("SCENE2HAP_COMPILED", "")
        if self.target_name != "wheel" or wish == "0":
            return
        self._work = mkdtemp()
        source = Path(self.root)
        try:
            built = dict(_compiled(source, Path(self._work), is_checked=wish == "checked"))
        except Exception as problem:  # a missing or incomplete compiler can raise any error
            if wish in ("1", "checked"):
                raise
            self.app.display_warning(f"scene2hap is built without its compiled kernels: {problem}")
            return
        if version == "editable":
            for name, path in built.items():
                # Replaced, not overwritten: overwriting a module that a running program has loaded would crash it.
                shutil.copy2(path, source / f"{name}.new")
                os.replace(source / f"{name}.new", source / name)
        else:
            build_data["force_include"] |= {str(path): name for name, path in built.items()}
            build_data["pure_python"], build_data["infer_tag"] = False, True

    def finalize(self, version: str, build_data: dict[str, Any], artifact_path: str) -> None:
        """Delete temporary files after hatchling has packed the modules."""
        shutil.rmtree(self._work, ignore_errors=True)


def _compiled(source: Path, work: Path, *, is_checked: bool) -> Iterator[tuple[str, Path]]:
    """Compile the kernels in `work`. Yields the path of each module relative to `source`, and the compiled file."""
    from Cython.Build import cythonize
    from setuptools import Distribution, Extension

    kernels = [
        Extension(".".join(path.relative_to(source).with_suffix("").parts), [str(path)], extra_compile_args=_FLAGS)
        for path in sorted((source / "scene2hap").rglob("_*.pyx"))
    ]
    # Code that every module with typed arrays needs, two thirds of their C, is compiled once.
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
