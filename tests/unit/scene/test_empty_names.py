"""The only object of a file is called like the file, if nobody has named it."""

from pathlib import Path

import pytest

from scene2hap import LexiconBackend, infer_haptics, load_scene
from scene2hap.scene.names import says_nothing

SQUARE = "v 0 0 0\nv 0.1 0 0\nv 0.1 0.3 0\nv 0 0.3 0\n"
URDF = """<robot name="any"><link name="{name}"><visual><geometry><box size="0.1 0.1 0.3"/></geometry></visual></link>
{more}</robot>"""
MORE = '<link name="lid"><visual><geometry><box size="0.1 0.1 0.1"/></geometry></visual></link>'
JOINT = '<joint name="j" type="fixed"><parent link="baseLink"/><child link="lid"/></joint>'


@pytest.mark.parametrize(
    "name",
    [
        "object",
        "base_link",
        "baseLink",
        "Cube.001",
        "world/body1",
        "Object_7",
        "mesh_0_3f2a9c1",
        "p3",
        "",
        "12",
        "pCube1",
        "MeshInstance3D2",
        "StaticMeshComponent0",
        "Section1",
        "instance_0",
        "component_3",
        "GameObject (1)",
        "BezierCurve.003",
        "Text.001",
    ],
)
def test_names_of_tools_say_nothing(name: str) -> None:
    assert says_nothing(name)


@pytest.mark.parametrize("name", ["mug", "mug_base", "Box", "table.001", "panda_link0", "\u51b7\u8535\u5eab", "\u673a"])
def test_names_with_a_word_of_their_own_say_something(name: str) -> None:
    assert not says_nothing(name)


def test_only_object_without_a_name_is_called_like_its_file(tmp_path: Path) -> None:
    urdf, obj = tmp_path / "coffee_mug.urdf", tmp_path / "wine_bottle.obj"
    urdf.write_text(URDF.format(name="baseLink", more=""))
    obj.write_text(SQUARE + "o object\nf 1 2 3 4\n")
    scene = load_scene(urdf)
    assert [(item.id, item.name) for item in scene.objects] == [("baseLink", "coffee_mug")]
    assert infer_haptics(scene, LexiconBackend())["baseLink"].object_category == "mug"
    assert load_scene(obj).objects[0].name == "wine_bottle"


def test_other_names_stay(tmp_path: Path) -> None:
    two, named, nameless = (tmp_path / name for name in ("mug.urdf", "asset.urdf", "model.urdf"))
    two.write_text(URDF.format(name="baseLink", more=MORE + JOINT))
    named.write_text(URDF.format(name="kettle", more=""))
    nameless.write_text(URDF.format(name="baseLink", more=""))
    assert [item.name for item in load_scene(two).objects] == ["baseLink", "lid"]
    assert load_scene(named).objects[0].name == "kettle"
    assert load_scene(nameless).objects[0].name == "baseLink"
