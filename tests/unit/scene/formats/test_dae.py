"""COLLADA files: node tree, axis, unit and materials; skipped where pycollada is not installed."""

from __future__ import annotations

import sys
from importlib.util import find_spec
from pathlib import Path

import numpy as np
import pytest

from looks import BLUE, UPRIGHT, image_file, looks, refused, shown
from scene2hap.errors import MissingExtra, SceneError, SceneFormatError
from scene2hap.scene import limits
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
    shelf, board, book, second = load_scene(write(tmp_path, dae(nodes))).objects
    assert [item.id for item in (shelf, board, book, second)] == ["shelf", "board", "book", "shelf#2"]
    np.testing.assert_allclose(shelf.bounds_m, [[5, 0, 0], [6, 2, 0]], atol=1e-6)
    for item in (board, book):
        np.testing.assert_allclose(item.bounds_m, [[5, 0, 0], [7, 4, 0]], atol=1e-6)
    np.testing.assert_allclose(second.bounds_m, [[-2, 0, 0], [0, 1, 0]], atol=1e-6)
    assert shelf.geometry is second.geometry


@needs_pycollada
@pytest.mark.parametrize("unit", ["0", "-1", "nan"])
def test_invalid_unit_is_refused(tmp_path: Path, unit: str) -> None:
    path = write(tmp_path, dae(f'<node id="n" name="n">{FLAT}</node>', unit=unit))
    with pytest.raises(SceneFormatError, match=f"has {unit} metres per unit; it must be above 0"):
        load_scene(path)
    np.testing.assert_allclose(load_scene(path, unit_m=1.0).objects[0].bounds_m[1], [1.0, 2.0, 0.0], atol=1e-9)


@needs_pycollada
@pytest.mark.parametrize(
    ("limit", "value", "what"),
    [("MAX_DEPTH", 2, "depth of the node tree is 3"), ("MAX_NODES", 3, "number of nodes is 4")],
)
def test_nodes_are_limited(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, limit: str, value: int, what: str) -> None:
    below = f'<node id="b" name="b">{FLAT}<node id="c" name="c">{FLAT}</node></node>'
    path = write(tmp_path, dae(f'<node id="a" name="a">{FLAT}{below}</node><node id="d" name="d">{FLAT}</node>'))
    load_scene(path)
    monkeypatch.setattr(limits, limit, value)
    with pytest.raises(SceneError, match=f"{what}; .*{limit}"):
        load_scene(path)


@needs_pycollada
def test_axis_and_unit_come_from_the_file_or_the_arguments(tmp_path: Path) -> None:
    path = write(tmp_path, dae(f'<node id="n" name="n">{FLAT}</node>', up="Z_UP", unit="0.01"))
    snapshot = load_scene(path)
    assert snapshot.up_axis == "z"
    np.testing.assert_allclose(snapshot.objects[0].bounds_m[1], [0.01, 0.02, 0.0], atol=1e-9)
    told = load_scene(path, up_axis="y", unit_m=1.0)
    assert told.up_axis == "y"
    np.testing.assert_allclose(told.objects[0].bounds_m[1], [1.0, 2.0, 0.0], atol=1e-9)


@needs_pycollada
def test_decimal_commas_are_read(tmp_path: Path) -> None:
    nodes = f'<node id="n" name="shelf"><translate>0,5 0 0</translate>{FLAT}</node>'
    (shelf,) = load_scene(write(tmp_path, dae(nodes, unit="0,5"))).objects
    np.testing.assert_allclose(shelf.bounds_m, [[0.25, 0, 0], [0.75, 1, 0]], atol=1e-6)


@needs_pycollada
def test_x_up_is_refused(tmp_path: Path) -> None:
    with pytest.raises(SceneError, match="has X up"):
        load_scene(write(tmp_path, dae(f'<node id="n" name="n">{FLAT}</node>', up="X_UP")))


@needs_pycollada
@pytest.mark.parametrize("encoding", ["utf-16-le", "utf-16-be", "utf-16", "utf-32", "utf-7", "cp037"])
def test_a_document_type_in_another_encoding_is_refused(tmp_path: Path, encoding: str) -> None:
    said = f'<?xml version="1.0" encoding="{encoding.removesuffix("-le").removesuffix("-be")}"?>'
    typed = '<!DOCTYPE COLLADA [<!ENTITY a "b">]>' + dae(FLAT).partition("?>")[2]
    (tmp_path / "a.dae").write_bytes((said + typed).encode(encoding))
    with pytest.raises(SceneError, match="without a document type"):
        load_scene(tmp_path / "a.dae")
    if encoding == "utf-7":
        (tmp_path / "a.dae").write_bytes(said.encode() + typed.replace("<", "+ADw-").encode())
        with pytest.raises(SceneError, match="without a document type"):
            load_scene(tmp_path / "a.dae")


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


def test_missing_pycollada_error_names_the_install_command(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "collada", None)
    with pytest.raises(MissingExtra, match="'scene.dae' is COLLADA.*pip install pycollada"):
        load_scene(write(tmp_path, dae("")))


# -- looks -----------------------------------------------------------------------------------------------------------


def textured(folder: Path, diffuse: str, *, more: str = "", image: str = "wood%20floor.png", bound: str = "1") -> Path:
    """Write a square with and without a material; of its two coordinate sets, set 1 shows the image upright."""
    phong = f"<phong>{diffuse and f'<diffuse>{diffuse}</diffuse>'}{more}</phong>"
    link = f"""<bind_material><technique_common><instance_material symbol="m" target="#wood">
        <bind_vertex_input semantic="UV" input_semantic="TEXCOORD" input_set="{bound}"/>
        </instance_material></technique_common></bind_material>"""

    def source(name: str, values: str, axes: str) -> str:
        n, width = len(values.split()), len(axes)
        params = "".join(f'<param name="{axis}" type="float"/>' for axis in axes)
        return f"""<source id="{name}"><float_array id="{name}a" count="{n}">{values}</float_array><technique_common>
            <accessor source="#{name}a" count="{n // width}" stride="{width}">{params}</accessor>
            </technique_common></source>"""

    text = f"""<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><created>2020-01-01T00:00:00</created><modified>2020-01-01T00:00:00</modified><up_axis>Y_UP</up_axis></asset>
<library_images><image id="i"><init_from>{image}</init_from></image></library_images>
<library_effects><effect id="e"><profile_COMMON>
<newparam sid="f"><surface type="2D"><init_from>i</init_from></surface></newparam>
<newparam sid="s"><sampler2D><source>f</source></sampler2D></newparam>
<technique sid="t">{phong}</technique></profile_COMMON></effect></library_effects>
<library_materials><material id="wood"><instance_effect url="#e"/></material></library_materials>
<library_geometries><geometry id="g"><mesh>
{source("p", "0 0 0 1 0 0 1 1 0 0 1 0", "XYZ")}
{source("u", "0.25 0.25", "ST")}{source("w", "0.25 0.25 0.75 0.25 0.75 0.75 0.25 0.75", "ST")}
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<polylist count="1" material="m"><input semantic="VERTEX" source="#v" offset="0"/>
<input semantic="TEXCOORD" source="#u" offset="1" set="0"/><input semantic="TEXCOORD" source="#w" offset="2" set="1"/>
<vcount>4</vcount><p>0 0 0 1 0 1 2 0 2 3 0 3</p></polylist></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s">
<node id="n1" name="painted"><instance_geometry url="#g">{link}</instance_geometry></node>
<node id="n2" name="bare"><instance_geometry url="#g"/></node>
</visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>"""
    return write(folder, text)


MAP = '<texture texture="s" texcoord="UV"/>'


@needs_pycollada
def test_texture_uses_the_bound_coordinate_set(tmp_path: Path) -> None:
    (tmp_path / "wood floor.png").write_bytes(image_file())
    painted, bare = load_scene(textured(tmp_path, MAP), unit_m=1.0).objects
    assert shown(painted) == UPRIGHT
    assert looks(painted).materials[0].color_rgba == (1.0, 1.0, 1.0, 1.0)
    assert bare.appearance is None
    assert painted.geometry is bare.geometry
    assert painted.instance_key != bare.instance_key


@needs_pycollada
def test_missing_coordinate_set_falls_back_to_the_first(tmp_path: Path) -> None:
    (tmp_path / "wood floor.png").write_bytes(image_file())
    painted, _ = load_scene(textured(tmp_path, MAP, bound="7"), unit_m=1.0).objects
    assert set(shown(painted).values()) == {BLUE}


@needs_pycollada
@pytest.mark.parametrize(
    ("more", "opacity"),
    [
        ("", 1.0),
        ("<transparency><float>0.25</float></transparency>", 0.25),
        ('<transparent opaque="A_ONE"><color>0 0 0 0.5</color></transparent>', 0.5),
        (
            '<transparent opaque="RGB_ZERO"><color>0.5 0.5 0.5 1</color></transparent>'
            "<transparency><float>0.5</float></transparency>",
            0.75,
        ),
        ("<transparency><float>0</float></transparency>", 1.0),
    ],
)
def test_colour_and_opacity_are_read(tmp_path: Path, more: str, opacity: float) -> None:
    painted, _ = load_scene(textured(tmp_path, "<color>0.1 0.2 0.3 1</color>", more=more), unit_m=1.0).objects
    (material,) = looks(painted).materials
    assert material.color_rgba == pytest.approx((0.1, 0.2, 0.3, opacity))
    assert material.texture is None


@needs_pycollada
@pytest.mark.parametrize(
    ("image", "reason"),
    [("gone.png", "there is no file"), ("../x.png", "lies outside"), ("file:///C:/x.png", "never fetched")],
)
def test_unreadable_texture_warns(tmp_path: Path, image: str, reason: str) -> None:
    scene, message = refused(textured(tmp_path, MAP, image=image))
    assert reason in message
    assert looks(scene.objects[0]).materials[0].texture is None


@needs_pycollada
def test_effect_without_colours_is_accepted(tmp_path: Path) -> None:
    painted, _ = load_scene(textured(tmp_path, ""), unit_m=1.0).objects
    assert len(looks(painted).materials) == 1


def worktop(faces: str) -> str:
    """A document with an L-shaped face as its geometry."""
    text = dae(f'<node name="top">{FLAT}</node>').replace('count="3" stride', 'count="6" stride')
    text = text.replace('count="9">0 0 0 1 0 0 0 2 0<', 'count="18">0 0 0 3 0 0 3 0.6 0 0.6 0.6 0 0.6 2 0 0 2 0<')
    before, _, rest = text.partition("<triangles")
    return before + faces + rest.partition("</triangles>")[2]


VERTEX = '<input semantic="VERTEX" source="#v" offset="0"/>'


@needs_pycollada
@pytest.mark.parametrize("corners", ["0 1 2 3 4 5", "1 2 3 4 5 0", "4 5 0 1 2 3"])
@pytest.mark.parametrize("kind", ["polylist", "polygons"])
def test_concave_faces_are_cut_within_their_outline(tmp_path: Path, kind: str, corners: str) -> None:
    count = "<vcount>6</vcount>" if kind == "polylist" else ""
    faces = f'<{kind} count="1">{VERTEX}{count}<p>{corners}</p></{kind}>'
    mesh = load_scene(write(tmp_path, worktop(faces)), unit_m=1.0).object("top").geometry.mesh
    a, b, c = mesh.vertices_m[mesh.faces].transpose(1, 0, 2)
    assert np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2 == pytest.approx(2.64)


@needs_pycollada
@pytest.mark.parametrize("faces", ["<vcount>6</vcount><p>0 1 2 3 4 9</p>", "<vcount>7</vcount><p>0 1 2 3 4 5</p>"])
def test_broken_polygons_are_refused(tmp_path: Path, faces: str) -> None:
    with pytest.raises(SceneFormatError):
        load_scene(write(tmp_path, worktop(f'<polylist count="1">{VERTEX}{faces}</polylist>')))
