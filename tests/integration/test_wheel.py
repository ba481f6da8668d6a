"""The package is built, installed beside nothing but its declared dependencies, and used outside the source tree."""

import json
import os
import shutil
import subprocess
import sys
import tarfile
import zipfile
from collections.abc import Sequence
from importlib.metadata import Distribution, PathDistribution, distribution
from pathlib import Path

import pytest
from packaging.requirements import Requirement

ROOT = Path(__file__).parents[2]
# One that `are_in_use` looks for, and one in a deeper folder that includes another's declarations. All of them take a
# minute of processor time, and were compiled by the same hook when this environment was made.
FEW_KERNELS = ("scene2hap/contact/_certificate", "scene2hap/propagation/bands/_band_shapes")
COMPILER = shutil.which("cc") or shutil.which("gcc") or shutil.which("clang")

# A hand slides on a table that a fan shakes. `.ci/bare` runs the demo, which takes ten times as long.
TABLE = """
import scene2hap.propagation.bands.band_shapes
from scene2hap.demo import kitchen_path, tour_path
assert kitchen_path().is_file() and tour_path().is_file()
from scene2hap import Box, HapticSession, Pose, SceneObject, SceneSnapshot, Touch, bake
table = SceneObject("oak table", pose=Pose((0.0, 0.36, 0.0)), geometry=Box((1.2, 0.72, 0.7)))
fan = SceneObject("fan", pose=Pose((0.3, 0.97, 0.0)), geometry=Box((0.4, 0.5, 0.3)))
session = HapticSession(bake(SceneSnapshot.build([table, fan])))
for x_m in (-0.2, -0.3, -0.4):
    frame = session.update({"fan": Pose((x_m + 0.5, 0.97, 0.0))}, [Touch("left", "oak table", (x_m, 0.72, 0.0))])
    assert frame.gain("left", "fan") > 0.0
    assert session.render(480).shape == (480, 2)
"""
STATE = """
import json, sys
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
    """The Python of a new environment with what the wheel declares to need, and nothing else.

    The dependencies are links to those of this environment: to download and unpack them takes half a minute.
    """
    folder = tmp_path_factory.mktemp("environment")
    assert run([sys.executable, "-m", "venv", "--without-pip", folder / "env"], folder).returncode == 0
    python = folder / "env" / ("Scripts/python.exe" if os.name == "nt" else "bin/python")
    where = run([python, "-c", "import sysconfig; print(sysconfig.get_path('purelib'))"], folder)
    packages = Path(where.stdout.strip())
    for needed in dependencies(pure):
        for name in {file.parts[0] for file in needed.files or ()} - {"..", "__pycache__"}:
            if not (packages / name).exists():
                (packages / name).symlink_to(Path(str(needed.locate_file(name))))
    return python


def dependencies(built: Path) -> list[Distribution]:
    """The distributions that a wheel requires without extras, and those that these require, in turn."""
    with zipfile.ZipFile(built) as packed:
        (told,) = {name.partition("/")[0] for name in packed.namelist() if ".dist-info/" in name}
        waiting = [(line, {""}) for line in PathDistribution(zipfile.Path(packed, f"{told}/")).requires or ()]
    found: dict[str, Distribution] = {}
    while waiting:
        line, extras = waiting.pop()
        one = Requirement(line)
        if one.marker is None or any(one.marker.evaluate({"extra": extra}) for extra in extras):
            needed = distribution(one.name)
            assert one.specifier.contains(needed.version, prereleases=True), f"{line}, and here is {needed.version}"
            if one.name not in found:
                found[one.name] = needed
                waiting += [(line, one.extras or {""}) for line in needed.requires or ()]
    return list(found.values())


def state_after(program: str, built: Path, python: Path, folder: Path) -> dict[str, bool]:
    """Install a wheel and run a program in `folder`. Returns which kernels have a compiled twin."""
    # The program compiles the modules that it imports; pip would compile all.
    command = [sys.executable, "-m", "pip", "--python", python, "install", "-q", "--no-compile", "--no-index"]
    installed = run([*command, "--no-deps", "--force-reinstall", built], python.parent)
    assert installed.returncode == 0, installed.stderr
    ran = run([python, "-I", "-W", "error", "-c", program + STATE], folder)
    assert ran.returncode == 0, ran.stderr
    told = json.loads(ran.stdout.splitlines()[-1])
    assert Path(told["file"]).is_relative_to(python.parents[1]), told["file"]
    assert not [place for place in told["path"] if Path(place).is_relative_to(ROOT)], told["path"]
    assert told["twins"]
    assert told["in_use"] == any(told["twins"].values())
    return dict(told["twins"])


@pytest.mark.skipif(COMPILER is None, reason="no C compiler")
def test_a_compiled_wheel_runs_on_its_kernels_and_has_no_debug_symbols(
    sdist: Path, pure: Path, environment: Path, tmp_path: Path
) -> None:
    shutil.unpack_archive(sdist, tmp_path / "unpacked", filter="data")
    (source,) = (tmp_path / "unpacked").iterdir()
    for kernel in (source / "scene2hap").rglob("_*.pyx"):
        if kernel.relative_to(source).with_suffix("").as_posix() not in FEW_KERNELS:
            kernel.unlink()
    hook = source / "hatch_build.py"
    hook.write_text(hook.read_text().replace("-O3", "-O0"))  # a third of the time; `.ci/run` tests the fast ones
    built = wheel(source, tmp_path / "dist", "1")
    assert "none-any" not in built.name
    with zipfile.ZipFile(built) as packed:
        libraries = [name for name in packed.namelist() if name.endswith((".so", ".pyd"))]
        assert {name.partition(".")[0] for name in libraries} == {*FEW_KERNELS, "scene2hap/_cyutility"}
        assert not any(b".debug_info" in packed.read(name) for name in libraries)
        with zipfile.ZipFile(pure) as plain:  # the files that its test shows to be enough without kernels
            needed = {name for name in plain.namelist() if name.startswith("scene2hap/") and not name.endswith(".pyx")}
        assert needed <= set(packed.namelist())
    twins = state_after(TABLE, built, environment, tmp_path)
    packages = tuple(kernel.replace("/_", ".").replace("/", ".") + "." for kernel in FEW_KERNELS)
    assert {name for name, is_compiled in twins.items() if is_compiled} == {
        name for name in twins if name.startswith(packages)
    }
    assert any(twins.values())


def test_a_pure_wheel_is_for_every_machine_and_runs_in_plain_python(
    pure: Path, environment: Path, tmp_path: Path
) -> None:
    assert pure.name.endswith("-py3-none-any.whl")
    twins = state_after(TABLE, pure, environment, tmp_path)
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
