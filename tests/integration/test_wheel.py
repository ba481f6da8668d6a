"""The package is built, installed into an empty environment, and used outside the source tree."""

import json
import os
import shutil
import subprocess
import sys
import tarfile
import zipfile
from collections.abc import Sequence
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
# One that `are_in_use` looks for, and one in a deeper folder that includes another's declarations. All of them take a
# minute of processor time, and were compiled by the same hook when this environment was made.
FEW_KERNELS = ("scene2hap/contact/_track", "scene2hap/propagation/bands/_band_shapes")
COMPILER = shutil.which("cc") or shutil.which("gcc") or shutil.which("clang")
NO_INDEX = ("NewConnectionError", "NameResolutionError", "ConnectTimeoutError", "connection broken by", "ProxyError")

# The README's command, in a process that then prints its state.
DEMO = """
import json, runpy, sys
sys.argv = ["scene2hap", "demo"]
try:
    runpy.run_module("scene2hap", run_name="__main__", alter_sys=True)
except SystemExit as end:
    assert not end.code, end.code
import scene2hap
from scene2hap.compiled import KERNELS, are_in_use
twins = {name: twin is not None for name, (_, twin) in KERNELS.items()}
print(json.dumps({"file": scene2hap.__file__, "in_use": are_in_use(), "twins": twins, "path": sys.path}))
"""


def run(command: Sequence[object], folder: Path, **settings: str) -> subprocess.CompletedProcess[str]:
    """Run a command without this environment's Python settings."""
    known = {k: v for k, v in os.environ.items() if not k.startswith(("SCENE2HAP_", "PYTHON", "VIRTUAL_ENV"))}
    return subprocess.run(
        list(map(str, command)), cwd=folder, env=known | settings, capture_output=True, text=True, timeout=400
    )


def wheel(source: Path, folder: Path, compiled: str) -> Path:
    """Build a wheel without build isolation, from installed packages. Returns its path."""
    folder.mkdir()
    command = [sys.executable, "-m", "pip", "wheel", "-q", "--no-deps", "--no-build-isolation", "-w", folder, source]
    built = run(command, folder, SCENE2HAP_COMPILED=compiled)
    assert built.returncode == 0, built.stderr
    (path,) = folder.glob("*.whl")
    return path


@pytest.fixture(scope="module", autouse=True)
def _can_build() -> None:
    for package in ("hatchling", "Cython", "setuptools", "pip"):
        pytest.importorskip(package, reason=f"building a wheel here needs {package}")


@pytest.fixture(scope="module")
def sdist(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("sdist")
    made = run([sys.executable, "-m", "hatchling", "build", "-t", "sdist", "-d", folder], ROOT)
    assert made.returncode == 0, made.stderr
    (path,) = folder.glob("*.tar.gz")
    return path


@pytest.fixture(scope="module")
def pure(sdist: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return wheel(sdist, tmp_path_factory.mktemp("pure") / "dist", "0")


@pytest.fixture(scope="module")
def environment(pure: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The Python of a new environment, into which pip has installed the wheel and its dependencies."""
    folder = tmp_path_factory.mktemp("environment")
    assert run([sys.executable, "-m", "venv", "--without-pip", folder / "env"], folder).returncode == 0
    python = folder / "env" / ("Scripts/python.exe" if os.name == "nt" else "bin/python")
    brought = pip(python, "--retries", "1", "--timeout", "30", pure)
    if brought.returncode and any(word in brought.stderr for word in NO_INDEX):
        pytest.skip("no package index can be reached, and the empty environment needs the dependencies from one")
    assert brought.returncode == 0, brought.stderr
    return python


def pip(python: Path, *what: object) -> subprocess.CompletedProcess[str]:
    # The demo compiles the modules that it imports; pip would compile all of every dependency.
    command = [sys.executable, "-m", "pip", "--python", python, "install", "-q", "--no-compile", *what]
    return run(command, python.parent)


def demo_of(built: Path, python: Path, folder: Path) -> dict[str, bool]:
    """Install a wheel and run the README's demo in `folder`. Returns which kernels have a compiled twin."""
    installed = pip(python, "--no-deps", "--force-reinstall", built)
    assert installed.returncode == 0, installed.stderr
    ran = run([python, "-I", "-c", DEMO], folder)
    assert ran.returncode == 0, ran.stderr
    assert (folder / "scene2hap-demo" / "tour.wav").is_file()
    told = json.loads(ran.stdout.splitlines()[-1])
    assert Path(told["file"]).is_relative_to(python.parents[1]), told["file"]
    assert not [place for place in told["path"] if Path(place).is_relative_to(ROOT)], told["path"]
    assert told["twins"]
    assert told["in_use"] == any(told["twins"].values())
    return dict(told["twins"])


@pytest.mark.skipif(COMPILER is None, reason="no C compiler")
def test_a_compiled_wheel_runs_the_demo_on_its_kernels_and_has_no_debug_symbols(
    sdist: Path, environment: Path, tmp_path: Path
) -> None:
    shutil.unpack_archive(sdist, tmp_path / "unpacked", filter="data")
    (source,) = (tmp_path / "unpacked").iterdir()
    for kernel in (source / "scene2hap").rglob("_*.pyx"):
        if kernel.relative_to(source).with_suffix("").as_posix() not in FEW_KERNELS:
            kernel.unlink()
    built = wheel(source, tmp_path / "dist", "1")
    assert "none-any" not in built.name
    with zipfile.ZipFile(built) as packed:
        libraries = [name for name in packed.namelist() if name.endswith((".so", ".pyd"))]
        assert {name.partition(".")[0] for name in libraries} == {*FEW_KERNELS, "scene2hap/_cyutility"}
        assert not any(b".debug_info" in packed.read(name) for name in libraries)
    twins = demo_of(built, environment, tmp_path)
    packages = tuple(kernel.replace("/_", ".").replace("/", ".") + "." for kernel in FEW_KERNELS)
    assert {name for name, is_compiled in twins.items() if is_compiled} == {
        name for name in twins if name.startswith(packages)
    }
    assert any(twins.values())


def test_a_pure_wheel_is_for_every_machine_and_runs_the_demo_in_plain_python(
    pure: Path, environment: Path, tmp_path: Path
) -> None:
    assert pure.name.endswith("-py3-none-any.whl")
    twins = demo_of(pure, environment, tmp_path)
    assert not any(twins.values()), [name for name, is_compiled in twins.items() if is_compiled]


def test_the_sdist_has_all_that_a_wheel_and_the_tests_need(sdist: Path, pure: Path) -> None:
    with tarfile.open(sdist) as packed:
        names = {name.partition("/")[2] for name in packed.getnames()}
    assert {"hatch_build.py", "LICENSE", "README.md", "tests/integration/test_wheel.py", ".ci/run"} <= names
    assert not [name for name in names if name.endswith((".so", ".pyd", ".pyc"))]
    with zipfile.ZipFile(pure) as packed:
        built = {name for name in packed.namelist() if name.startswith("scene2hap/")}
    assert built == {name for name in names if name.startswith("scene2hap/") and name in built}
    assert {name for name in names if name.startswith("scene2hap/") and name.endswith((".py", ".pyx", ".csv"))} <= built
