"""The wheel alone: built, installed where nothing else is, and used far from the sources."""

import os
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
COMPILER = shutil.which("cc") or shutil.which("gcc") or shutil.which("clang")


def wheel(folder: Path, compiled: str) -> Path:
    """Built without isolation from an index: only where the build's own packages are at hand."""
    command = [sys.executable, "-m", "pip", "wheel", "--quiet", "--no-deps", "--no-build-isolation", "-w", folder, ROOT]
    run = subprocess.run(
        list(map(str, command)), env={**os.environ, "SCENE2HAP_COMPILED": compiled}, capture_output=True, text=True
    )
    assert run.returncode == 0, run.stderr
    (built,) = folder.glob("*.whl")
    return built


def used(built: Path, folder: Path) -> bool:
    """Whether kernels are in use once the wheel is unpacked, and the demo has run, away from the sources."""
    with zipfile.ZipFile(built) as packed:
        packed.extractall(folder / "site")
    code = (
        f"import sys; sys.path.insert(0, {str(folder / 'site')!r})\n"
        "import scene2hap; from scene2hap.cli import main; from scene2hap.compiled import are_in_use\n"
        f"assert scene2hap.__file__.startswith({str(folder)!r}), scene2hap.__file__\n"
        "assert main(['demo']) == 0\n"
        "print('kernels', are_in_use())"
    )
    settings = {name: value for name, value in os.environ.items() if name != "SCENE2HAP_COMPILED"}
    run = subprocess.run([sys.executable, "-c", code], cwd=folder, env=settings, capture_output=True, text=True)
    assert run.returncode == 0, run.stderr
    assert (folder / "scene2hap-demo" / "tour.wav").is_file()
    return "kernels True" in run.stdout


@pytest.fixture(autouse=True)
def _can_build() -> None:
    for package in ("hatchling", "Cython", "setuptools"):
        pytest.importorskip(package, reason=f"building a wheel here needs {package}, which pip else fetches")


@pytest.mark.skipif(COMPILER is None, reason="no C compiler")
def test_a_compiled_wheel_has_its_kernels_and_no_debug_symbols(tmp_path: Path) -> None:
    built = wheel(tmp_path / "dist", "1")
    assert "none-any" not in built.name
    with zipfile.ZipFile(built) as packed:
        libraries = [name for name in packed.namelist() if name.endswith((".so", ".pyd"))]
        assert libraries
        assert not any(b".debug_info" in packed.read(name) for name in libraries)
    assert used(built, tmp_path)


def test_a_pure_wheel_is_for_every_machine(tmp_path: Path) -> None:
    built = wheel(tmp_path / "dist", "0")
    assert built.name.endswith("-py3-none-any.whl")
    assert not used(built, tmp_path)
