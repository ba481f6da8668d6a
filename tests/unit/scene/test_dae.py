"""COLLADA: its node tree, axis and unit; skipped where pycollada is not installed."""

from __future__ import annotations

import sys
from importlib.util import find_spec
from pathlib import Path

import numpy as np
import pytest

from scene2hap.errors import MissingExtra, SceneError
from scene2hap.scene.load import load_scene

needs_pycollada = pytest.mark.skipif(find_spec("collada") is None, reason="pycollada is not installed")


def dae(nodes: str, *, up: str = "Y_UP", unit: str = "1") -> str:
    """A document with the triangle `flat` (1 m by 2 m, in x and y) in its library."""
    return f"""<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><created>2020-01-01T00:00:00</created><modified>2020-01-01T00:00:00</modified>
<unit name="u" meter="{unit}"/><up_axis>{up}</up_axis></asset>
<library_geometries><geometry id="flat" name="flat"><mesh>
<source id="p"><float_array id="pa" count="9">0 0 0 1 0 0 0 2 0</float_array>
<technique_common><accessor source="#pa" count="3" stride="3">
<param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/>
</accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s">{nodes}</visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>"""


FLAT = '<instance_geometry url="#flat"/>'


def write(tmp_path: Path, text: str) -> Path:
    path = tmp_path / "scene.dae"
    path.write_text(text, encoding="utf-8")
    return path


@needs_pycollada
def test_nodes_keep_names_and_transforms(tmp_path: Path) -> None:
    nodes = f"""<node id="n1" name="shelf"><translate>5 0 0</translate>{FLAT}
        <node id="n2" name="board"><scale>2 2 2</scale>{FLAT}<node id="n3" name="book">{FLAT}</node></node></node>
        <node id="n4" name="shelf"><rotate>0 0 1 90</rotate>{FLAT}</node>"""
    shelf, board, second = load_scene(write(tmp_path, dae(nodes))).objects
    assert [item.id for item in (shelf, board, second)] == ["shelf", "board", "shelf#2"]
    np.testing.assert_allclose(shelf.bounds_m, [[5, 0, 0], [6, 2, 0]], atol=1e-6)
    np.testing.assert_allclose(board.bounds_m, [[5, 0, 0], [7, 4, 0]], atol=1e-6)
    np.testing.assert_allclose(second.bounds_m, [[-2, 0, 0], [0, 1, 0]], atol=1e-6)
    assert shelf.geometry is second.geometry


@needs_pycollada
def test_axis_and_unit_are_those_of_the_file_unless_told(tmp_path: Path) -> None:
    path = write(tmp_path, dae(f'<node id="n" name="n">{FLAT}</node>', up="Z_UP", unit="0.01"))
    snapshot = load_scene(path)
    assert snapshot.up_axis == "z"
    np.testing.assert_allclose(snapshot.objects[0].bounds_m[1], [0.01, 0.02, 0.0], atol=1e-9)
    told = load_scene(path, up_axis="y", unit_m=1.0)
    assert told.up_axis == "y"
    np.testing.assert_allclose(told.objects[0].bounds_m[1], [1.0, 2.0, 0.0], atol=1e-9)


@needs_pycollada
def test_x_up_is_refused(tmp_path: Path) -> None:
    with pytest.raises(SceneError, match="has X up"):
        load_scene(write(tmp_path, dae(f'<node id="n" name="n">{FLAT}</node>', up="X_UP")))


@needs_pycollada
@pytest.mark.parametrize(
    "text",
    [
        "a shopping list",
        "<html></html>",
        "PK\x03\x04",
        dae(FLAT)[:700],
        '<!DOCTYPE x [<!ENTITY a SYSTEM "file:///etc/hostname">]>' + dae(FLAT),
        dae(f'<node id="n" name="n">{FLAT}</node>').replace("0 1 2</p>", "0 1 7</p>"),
    ],
)
def test_broken_collada_is_refused(tmp_path: Path, text: str) -> None:
    with pytest.raises(SceneError, match="is not COLLADA|cannot be read as COLLADA|holds no triangles"):
        load_scene(write(tmp_path, text))


def test_without_pycollada_the_cure_is_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "collada", None)
    with pytest.raises(MissingExtra, match="'scene.dae' is COLLADA.*pip install pycollada"):
        load_scene(write(tmp_path, dae("")))
