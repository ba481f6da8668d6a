"""The hooks for PyInstaller name everything of scene2hap that is imported or read by a name made at run time.

`stress/freeze.py` freezes a game and runs it, which takes minutes.
"""

import runpy
from importlib.metadata import entry_points
from pathlib import Path

import pytest

import scene2hap
from scene2hap.audio.sources import SOURCES
from scene2hap.audio.tactile import CONVERTERS
from scene2hap.devices import SINKS
from scene2hap.export import EXPORTS
from scene2hap.llm import BACKENDS
from scene2hap.propagation import MODELS
from scene2hap.scene.capture import RENDERERS

pytest.importorskip("PyInstaller", reason="the hooks are PyInstaller's: pip install pyinstaller")

PACKAGE = Path(scene2hap.__file__).parent
HOOKS = PACKAGE / "__pyinstaller"


@pytest.fixture(scope="module")
def hook() -> dict[str, list[str]]:
    return runpy.run_path(str(HOOKS / "hook-scene2hap.py"))


def test_pyinstaller_finds_the_folder_of_the_hooks() -> None:
    found = [entry for entry in entry_points(group="pyinstaller40") if entry.value.startswith("scene2hap.")]
    folders = {folder for entry in found for folder in entry.load()()}
    assert folders == {str(HOOKS)}


def test_every_built_in_kind_is_packed(hook: dict[str, list[str]]) -> None:
    for group in (SOURCES, CONVERTERS, SINKS, EXPORTS, BACKENDS, MODELS, RENDERERS):
        modules = {place.partition(":")[0] for place in group.builtins.values()}
        assert modules <= {*hook["hiddenimports"]}, group.name


def test_every_compiled_kernel_is_packed(hook: dict[str, list[str]]) -> None:
    kernels = {path for path in PACKAGE.rglob("_*.*") if path.suffix in (".so", ".pyd")}
    names = {".".join((*path.relative_to(PACKAGE.parent).parent.parts, path.name.split(".")[0])) for path in kernels}
    assert names <= {*hook["hiddenimports"]}


def test_every_data_file_is_packed_in_its_place(hook: dict[str, list[str]]) -> None:
    data = {
        path.relative_to(PACKAGE.parent).as_posix()
        for path in PACKAGE.rglob("*")
        if path.suffix in (".csv", ".txt", ".json", ".glb", ".html", ".css", ".js")
    }
    runners = {f"scene2hap/audio/sources/runners/{name}.py" for name in ("audiogen", "contract", "stable_audio")}
    packed = {(Path(folder) / Path(source).name).as_posix() for source, folder in hook["datas"]}
    assert data | runners <= packed
    assert not [name for name in packed if name.endswith((".pyx", ".pxd"))]
