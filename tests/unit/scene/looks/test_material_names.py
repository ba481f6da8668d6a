"""The names that an author gave to materials reach an object from every format, also of materials without colours."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from scene2hap import Box, SceneSnapshot, load_scene
from scene2hap.scene.copies import material_names, names_by_area
from usd_writing import HEADER, usd

WEDGE = "v 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 3\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"
BOX = '<geometry><box size="{0} {0} {0}"/></geometry>'
URDF = (
    '<robot name="r">{materials}<link name="cabinet">'
    f'<visual>{BOX.format(0.1)}<material name="steel"/></visual>'
    f'<visual>{BOX.format(0.5)}<material name="Oak planks"/></visual></link></robot>'
)
COLOURED = '<material name="steel"><color rgba="1 0 0 1"/></material>'
DAE = """<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><asset><up_axis>Y_UP</up_axis></asset>
<library_effects><effect id="e"><profile_COMMON><technique sid="t"><lambert><diffuse><color>1 0 0 1</color></diffuse>
</lambert></technique></profile_COMMON></effect></library_effects>
<library_materials><material id="m0" name="Oak planks"><instance_effect url="#e"/></material></library_materials>
<library_geometries><geometry id="g"><mesh><source id="p"><float_array id="a" count="9">0 0 0 1 0 0 0 1 0</float_array>
<technique_common><accessor source="#a" count="3" stride="3"><param name="X" type="float"/>
<param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices><triangles count="1" material="s">
<input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="x"><node name="cabinet"><instance_geometry url="#g"><bind_material>
<technique_common><instance_material symbol="s" target="#m0"/></technique_common></bind_material></instance_geometry>
</node></visual_scene></library_visual_scenes><scene><instance_visual_scene url="#x"/></scene></COLLADA>"""


def loaded(folder: Path, name: str, text: str) -> SceneSnapshot:
    (folder / name).write_text(text, encoding="utf-8")
    return load_scene(folder / name, unit_m=1.0)


@pytest.mark.parametrize(
    ("name", "text", "names"),
    [
        ("cabinet.obj", f"o cabinet\nusemtl Oak planks\n{WEDGE}", ("Oak planks",)),
        ("cabinet.dae", DAE, ("Oak planks",)),
        ("cabinet.urdf", URDF.format(materials=""), ("Oak planks", "steel")),
        ("cabinet.urdf", URDF.format(materials=COLOURED), ("Oak planks", "steel")),
        (
            "cabinet.xml",
            '<mujoco><asset><material name="Oak planks" rgba="1 0 0 1"/></asset><worldbody><body name="cabinet">'
            '<geom type="box" size="1 1 1" material="Oak planks"/><geom size="0.1"/></body></worldbody></mujoco>',
            ("Oak planks",),
        ),
    ],
)
def test_names_of_materials_are_read(name: str, text: str, names: tuple[str, ...], tmp_path: Path) -> None:
    if name.endswith(".xml"):
        pytest.importorskip("mujoco", reason="needs the extra mujoco")
    if name.endswith(".dae"):
        pytest.importorskip("collada", reason="needs the extra dae")
    scene = loaded(tmp_path, name, text)
    (cabinet,) = scene.objects
    assert material_names(cabinet) == names
    assert material_names(SceneSnapshot.from_json(scene.to_json()).objects[0]) == names


@pytest.mark.parametrize("colour", ["", "color3f[] primvars:displayColor = [(1, 0, 0)]"])
def test_a_usd_material_has_its_display_name(colour: str, tmp_path: Path) -> None:
    usd("Usd")
    text = (
        f'{HEADER}def Material "m0" (displayName = "Oak planks") {{}}\n'
        'def Cube "cabinet" (prepend apiSchemas = ["MaterialBindingAPI"]) {\n'
        f"rel material:binding = </m0>\n{colour}\n}}\n"
    )
    (cabinet,) = loaded(tmp_path, "cabinet.usda", text).objects
    assert material_names(cabinet) == ("Oak planks",)


def test_a_panda3d_material_has_its_name() -> None:
    core = pytest.importorskip("panda3d.core", reason="needs the extra panda3d")
    from scene2hap.scene.engines.panda3d import snapshot

    render, card = core.NodePath("render"), core.CardMaker("cabinet")
    render.attach_new_node(card.generate()).set_material(core.Material("Oak planks"))
    assert material_names(snapshot(render).objects[0]) == ("Oak planks",)


def test_a_material_without_faces_is_no_material() -> None:
    mesh = Box((1.0, 1.0, 1.0)).mesh
    rows = np.ones(len(mesh.faces), np.int32)
    assert names_by_area(mesh, rows, ["steel", "oak", "glass"]) == ("oak",)
    rows[:4] = 0
    assert names_by_area(mesh, rows, ["steel", "oak", "glass"]) == ("oak", "steel")
