"""Imports follow the layers of docs/architecture.md; they are read from the source with `ast`."""

import ast
import re
from functools import cache
from pathlib import Path

import networkx as nx
import pytest

PACKAGE = Path(__file__).parents[2] / "scene2hap"
UNIT = Path(__file__).parent
ARCHITECTURE = PACKAGE.parent / "docs" / "architecture.md"

# From bottom to top; packages of one row never import each other.
LAYERS = [
    {"errors", "compiled"},
    {"common"},
    {"plugins"},
    {"materials", "contact_needs"},
    {"haptics"},
    {"audio"},
    {"clips", "scene"},
    {"contact"},
    {"propagation", "bundle"},
    {"llm", "render", "devices"},
    {"baking", "session"},
    {"engines"},
    {"bridge", "export", "report"},
    {"testing"},
    {"demo"},
    {"cli"},
    {"__main__", "__pyinstaller"},
]
HEIGHT = {package: height for height, packages in enumerate(LAYERS) for package in packages}
PLAY_SIDE = ("session", "render", "devices", "propagation", "contact")
DESIGN_TIME_ONLY = (
    "scene2hap.llm",
    "scene2hap.baking",
    "scene2hap.audio.sources",
    "scene2hap.common.web",
    "httpx",
    "trimesh",
)


def package_of(path: Path) -> str:
    return path.relative_to(PACKAGE).parts[0].removesuffix(".py")


@cache
def imports_of(path: Path) -> set[str]:
    """Every module that a file imports, at module level or inside a function."""
    found: set[str] = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{path}: relative imports hide the layer"
            found |= {f"{node.module}.{alias.name}" for alias in node.names} | {str(node.module)}
    return found


SOURCES = [path for path in sorted(PACKAGE.rglob("*.py")) if path != PACKAGE / "__init__.py"]


def test_unit_tests_stand_where_the_package_stands() -> None:
    folders = {path.parent.relative_to(UNIT) for path in UNIT.rglob("test_*.py")}
    assert {folder.as_posix() for folder in folders if not (PACKAGE / folder).is_dir()} == {"kernels", "plots"}


def test_every_package_has_a_layer() -> None:
    assert {package_of(path) for path in SOURCES} <= set(HEIGHT)


def test_imports_point_down() -> None:
    wrong = []
    for path in SOURCES:
        here = package_of(path)
        for name in imports_of(path):
            root, _, rest = name.partition(".")
            there = rest.partition(".")[0]
            if root == "scene2hap" and there != here and HEIGHT.get(there, -1) >= HEIGHT[here]:
                wrong.append(f"{path}: {here} must not import {name}")
    assert not wrong


def test_packages_within_a_package_import_each_other_in_one_direction() -> None:
    """Below the top level too: `propagation.bodies` does not know what `propagation.coupled` makes of bodies."""
    graph: nx.DiGraph[str] = nx.DiGraph()
    for path in SOURCES:
        here = path.relative_to(PACKAGE.parent).parent.parts
        for name in imports_of(path):
            there = name.split(".")
            depth = next((i for i, pair in enumerate(zip(here, there, strict=False)) if len(set(pair)) > 1), None)
            if depth is not None and (PACKAGE.parent / Path(*there[: depth + 1])).is_dir():
                graph.add_edge(".".join(here[: depth + 1]), ".".join(there[: depth + 1]))
    assert graph.has_edge("scene2hap.propagation.coupled", "scene2hap.propagation.bands")
    circles = [group for group in nx.strongly_connected_components(graph) if len(group) > 1]
    assert not circles


def test_the_playing_side_reaches_no_network() -> None:
    playing = [path for path in SOURCES if package_of(path) in PLAY_SIDE]
    assert playing
    assert not [(str(path), name) for path in playing for name in imports_of(path) if name.startswith(DESIGN_TIME_ONLY)]


def test_sound_sources_are_imported_at_design_time_alone() -> None:
    users = {
        package_of(path)
        for path in SOURCES
        if "sources" not in path.parts and any(name.startswith("scene2hap.audio.sources") for name in imports_of(path))
    }
    assert users == {"baking", "cli", "testing"}


def test_no_modules_import_each_other_in_a_circle() -> None:
    """Includes imports for types and within functions."""
    names = {path: ".".join(path.relative_to(PACKAGE.parent).with_suffix("").parts) for path in SOURCES}
    graph: nx.DiGraph[str] = nx.DiGraph()
    for path, name in names.items():
        graph.add_edges_from((name, other) for other in imports_of(path) & set(names.values()) if other != name)
    circles = [group for group in nx.strongly_connected_components(graph) if len(group) > 1]
    assert not circles


@pytest.mark.parametrize(
    "package",
    ["common", "scene", "audio", "llm", "session", "propagation", "baking", "bundle", "render", "devices"],
)
def test_the_table_of_a_package_names_its_modules(package: str) -> None:
    """Rows are "`module`, `module`" or "`subpackage`: `module`, `module`"."""
    text = ARCHITECTURE.read_text(encoding="utf-8")
    section = text.partition(f"## Inside `{package}`\n")[2].partition("\n## ")[0]
    section = section or text.partition(f"| modules of `{package}` | content |\n")[2].partition("\n\n")[0]
    named = set()
    for row in re.findall(r"^\| (`.*?) \|", section, re.MULTILINE):
        folder, colon, modules = row.partition(": ")
        parent = folder.strip("`") if colon else ""
        named |= {f"{parent}/{name}".strip("/") for name in re.findall(r"`(\w+)`", modules if colon else row)}
        named |= {parent} if colon else set()
    there = {path.stem for path in (PACKAGE / package).iterdir() if not path.name.startswith("_")}
    assert there == {name for name in named if "/" not in name}
    assert not {
        name for name in named if not ((at := PACKAGE / package / name).is_dir() or at.with_suffix(".py").is_file())
    }
