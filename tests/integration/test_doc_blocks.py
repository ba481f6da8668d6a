"""Every Python block of the documentation is run, by the test of its page or here, or states why it cannot run.

Blocks of a page run in order, in one namespace and one folder. `prepared` fills both with the names and files that
pages assume: a small kitchen, its bundle, a session, and files. The demo's kitchen has only four objects here. A block
after `<!-- not run: why -->` needs a network, a device or a game; only its syntax and its names of scene2hap are
checked.
"""

from __future__ import annotations

import ast
import builtins
import json
import re
import sys
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import soundfile
import trimesh

import scene2hap
import scene2hap.engines
from scene2hap import Box, HapticBundle, HapticSession, MemorySink, Pose, SceneObject, SceneSnapshot, bake
from small_kitchen import small_kitchen

pytestmark = pytest.mark.usefixtures("short_tones")

ROOT = Path(__file__).parents[2]
RUN_BY = {
    "README.md": "integration/test_readme.py",
    "docs/designer.md": "integration/test_designer.py",
    "docs/engines.md": "integration/test_engines.py",
    "docs/getting-started.md": "integration/test_getting_started.py",
    "docs/impacts.md": "integration/test_impacts_page.py",
    "docs/pictures.md": "integration/test_pictures_page.py",
    "docs/plugins.md": "contracts/test_plugins_page.py",
    "docs/profiles.md": "unit/session/test_user_profile.py",
    "docs/scenes-in-python.md": "integration/test_scenes_in_python.py",
    "docs/spawning.md": "unit/session/test_spawning.py",
    "docs/udp.md": "integration/test_udp.py",
}
"""Tests that run the marked blocks of a page (`ci:`, `plugin:`)."""
WHOLE = ("docs/designer.md", "docs/profiles.md", "docs/spawning.md")
"""Pages whose tests also run blocks without a marker."""
PLACEHOLDERS = {
    "app",
    "backend",
    "base",
    "bundle",
    "data",
    "game",
    "link",
    "model",
    "mujoco",
    "point",
    "render",
    "scene",
}
PLACEHOLDERS |= {"session", "show", "sink", "viewer"}
"""Names that a block which is not run may use without defining them."""


@dataclass(frozen=True)
class Block:
    page: str
    line: int
    marker: str
    code: str

    @property
    def by_other_test(self) -> bool:
        if self.page == "docs/udp.md":
            return "def receive" in self.code
        return self.page in WHOLE or bool(re.match(r"<!-- (ci|plugin): \w+ -->", self.marker))

    @property
    def reason(self) -> str | None:
        found = re.fullmatch(r"<!-- not run: (.+) -->", self.marker)
        return found[1] if found else None


def read(page: Path) -> list[Block]:
    lines = page.read_text(encoding="utf-8").splitlines()
    name = page.relative_to(ROOT).as_posix()
    blocks = []
    for n in (n for n, line in enumerate(lines) if line == "```python"):
        end = lines.index("```", n)
        blocks.append(Block(name, n + 2, lines[n - 1], "\n".join(lines[n + 1 : end]) + "\n"))
    return blocks


PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").rglob("*.md"))]
BLOCKS = [block for page in PAGES for block in read(page)]
RUN_HERE = sorted({block.page for block in BLOCKS if not block.by_other_test and block.reason is None})


def test_no_block_is_overlooked() -> None:
    """Indented fences, other spellings of the language, and blocks without a blank line would escape `read`."""
    fence = re.compile(r"^[ >]*(?:```+|~~~+) *(?:py|python3?)\b", re.MULTILINE | re.IGNORECASE)
    fences = sum(len(fence.findall(page.read_text(encoding="utf-8"))) for page in PAGES)
    assert fences == len(BLOCKS) > 40


@pytest.mark.parametrize("block", BLOCKS, ids=lambda block: f"{block.page}:{block.line}")
def test_a_block_is_run_by_someone(block: Block) -> None:
    compile(block.code, f"{block.page}:{block.line}", "exec")
    if block.by_other_test:
        test = ROOT / "tests" / RUN_BY[block.page]
        assert Path(block.page).name in test.read_text(encoding="utf-8"), f"{test} does not read {block.page}"
    elif block.reason is not None:
        assert len(block.reason.split()) >= 3, "say why the block is not run"
        check_names(block)


def check_names(block: Block) -> None:
    """Check that the block's imports exist, and that each name it uses is bound in it, public, or a placeholder."""
    tree = ast.parse(block.code)
    bound = set(dir(builtins)) | PLACEHOLDERS | set(scene2hap.__all__) | set(dir(scene2hap.engines))
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and str(node.module).startswith("scene2hap"):
            for name in node.names:
                assert hasattr(import_module(str(node.module)), name.name), f"{node.module} has no {name.name}"
        if isinstance(node, (ast.Import, ast.ImportFrom)):
            bound |= {(name.asname or name.name).partition(".")[0] for name in node.names}
        elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            bound.add(node.id)
        elif isinstance(node, ast.arg):
            bound.add(node.arg)
        elif isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef):
            bound.add(node.name)
    used = {node.id for node in ast.walk(tree) if isinstance(node, ast.Name)}
    assert not used - bound, f"{block.page}:{block.line} uses {sorted(used - bound)}, which nothing defines"


@pytest.fixture(scope="module")
def kitchen() -> tuple[SceneSnapshot, HapticBundle]:
    def on_table(name: str, size_m: tuple[float, float, float], x_m: float) -> SceneObject:
        return SceneObject(name, pose=Pose((x_m, 0.74 + size_m[1] / 2, 0.0)), geometry=Box(size_m))

    things = [
        SceneObject("table", pose=Pose((0.0, 0.37, 0.0)), geometry=Box((1.8, 0.74, 0.8))),
        on_table("phone", (0.07, 0.008, 0.15), 0.3),
        on_table("kettle", (0.16, 0.24, 0.16), 0.6),
        on_table("fan", (0.3, 0.4, 0.3), -0.6),
        on_table("radio", (0.3, 0.2, 0.1), -0.2),
        on_table("cup", (0.08, 0.1, 0.08), 0.1),
    ]
    scene = SceneSnapshot.build(things, name="kitchen")
    return scene, bake(scene)


def prepared(folder: Path, scene: SceneSnapshot, bundle: HapticBundle) -> dict[str, Any]:
    """Write the files that pages name into a folder. Returns the names that pages assume."""
    bundle.save(folder / "kitchen.bundle")
    t = np.arange(4 * 48_000) / 48_000
    sounds = {"hum": np.sin(880 * t), "my_fan": np.sin(600 * t), "pings": np.sin(5000 * t) * (t % 1 < 0.1)}
    sounds["hiss"] = np.random.default_rng(1).uniform(-1.0, 1.0, len(t))
    for name, samples in sounds.items():
        soundfile.write(folder / f"{name}.wav", 0.5 * samples, 48_000)
    event = {"Event": {"Time": 0.0, "EventType": "HapticContinuous", "EventDuration": 3.0}}
    (folder / "kettle.ahap").write_text(json.dumps({"Version": 1.0, "Pattern": [event]}))
    model = trimesh.Scene()
    model.add_geometry(trimesh.creation.box((1.0, 0.7, 0.7)), node_name="table")
    model.add_geometry(trimesh.creation.box((0.1, 0.1, 0.1)), node_name="Cube.012", parent_node_name="table")
    model.export(folder / "kitchen.glb")
    box = '<link name="body"><visual><geometry><box size="1 1 1"/></geometry></visual></link>'
    urdf = folder / "cabinet_description" / "urdf" / "cabinet.urdf"
    urdf.parent.mkdir(parents=True)
    urdf.write_text(f'<robot name="cabinet">{box}</robot>')
    stage = folder / "scenes" / "kitchen.usd"
    stage.parent.mkdir()
    stage.write_text(
        '#usda 1.0\n(\n    metersPerUnit = 1\n    upAxis = "Y"\n)\ndef Cube "table"\n{\n    double size = 1\n}\n'
    )
    own_package(folder)
    sink = MemorySink()
    started = HapticSession(scene, bundle, sink=sink)
    started.start()
    names = {name: getattr(scene2hap, name) for name in scene2hap.__all__}
    return names | {
        "scene": scene,
        "bundle": bundle,
        "session": HapticSession(scene, bundle),
        "sink": sink,
        "started": started,
        "point": (0.2, 0.74, 0.0),
        "pose": Pose((0.1, 0.9, 0.0)),
        "show": print,
    }


def own_package(folder: Path) -> None:
    """Install the package that docs/plugins.md assumes: its propagation model, with an entry point."""
    (model,) = (block.code for block in BLOCKS if block.marker == "<!-- plugin: propagation -->")
    (folder / "my_package").mkdir()
    (folder / "my_package" / "models.py").write_text(model)
    told = folder / "my_package-1.0.dist-info"
    told.mkdir()
    (told / "METADATA").write_text("Metadata-Version: 2.1\nName: my_package\nVersion: 1.0\n")
    (told / "entry_points.txt").write_text("[scene2hap.propagation]\nneighbours = my_package.models:Neighbours\n")


# The prepared bundle has no actuator, while a page that names one would bake for it.
@pytest.mark.filterwarnings("ignore:the bundle's loops were made for the actuator")
@pytest.mark.parametrize("page", RUN_HERE)
def test_the_blocks_of_a_page_run(
    page: str, kitchen: tuple[SceneSnapshot, HapticBundle], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    if page == "docs/usd.md":
        pytest.importorskip("pxr", reason="needs the extra usd")
    small = small_kitchen(tmp_path / "small.glb", "floor", "dining_table", "smartphone", "handheld_fan")
    monkeypatch.setattr("scene2hap.demo.kitchen_path", lambda: small)
    monkeypatch.chdir(tmp_path)
    monkeypatch.syspath_prepend(tmp_path)
    names = prepared(tmp_path, *kitchen)
    for block in BLOCKS:
        if block.page == page and block.reason is None and (not block.by_other_test or page == "docs/plugins.md"):
            exec(compile(block.code, f"{page}:{block.line}", "exec"), names)
    names["started"].stop()
    for module in ("my_package", "my_package.models"):
        sys.modules.pop(module, None)


def test_each_kind_of_part_has_code_that_is_run() -> None:
    """Every row of the table in docs/plugins.md has an example there; an adapter has one in docs/engines.md."""
    page = (ROOT / "docs" / "plugins.md").read_text(encoding="utf-8")
    rows = page.partition("\n|---")[2].partition("\n\n")[0].splitlines()[1:]
    groups = {row.split("|")[4].strip(" `") for row in rows}
    shown = {f"scene2hap.{kind}" for block in BLOCKS for kind in re.findall(r"<!-- plugin: (\w+) -->", block.marker)}
    assert groups == shown
    assert any("class Adapter" in block.code and block.by_other_test for block in BLOCKS)
