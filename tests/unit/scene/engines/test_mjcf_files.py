"""MJCF files: limits on the files they may read, limits on their size, and no output of MuJoCo."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
import pytest

from others import SCENES, needed, there
from rooms.furniture import COUNTER_BOUNDS_M, IDS, write_furniture
from scene2hap import load_scene
from scene2hap.errors import SceneError, SceneFormatError
from scene2hap.scene.engines import mjcf_files
from scene2hap.scene.engines.mjcf_files import check_files
from scene2hap.scene.engines.mujoco import load_mjcf, open_mjcf, snapshot
from scene2hap.scene.formats import xml_files
from systems import needs_links, needs_long_names

pytest.importorskip("mujoco", reason="needs the extra mujoco")

TETRAHEDRON = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"
WORLD = '<worldbody><body name="a"><geom type="mesh" mesh="t"/></body></worldbody>'
BALL = '<worldbody><body name="ball"><geom size="0.1"/></body></worldbody>'


def write(path: Path, text: str) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")
    return path


@pytest.fixture
def home(tmp_path: Path) -> Path:
    """The folder `scene`, beside a folder `other`; each holds a mesh."""
    write(tmp_path / "scene" / "meshes" / "t.obj", TETRAHEDRON)
    write(tmp_path / "other" / "t.obj", TETRAHEDRON)
    write(tmp_path / "other" / "part.xml", f"<mujocoinclude>{BALL}</mujocoinclude>")
    return tmp_path / "scene"


def mjcf(folder: Path, inside: str, name: str = "main.xml") -> Path:
    return write(folder / name, f"<mujoco>{inside}</mujoco>")


# -- files that may be read ------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "inside",
    [
        '<asset><mesh name="t" file="meshes/t.obj"/></asset>',
        '<compiler meshdir="meshes"/><asset><mesh name="t" file="t.obj"/></asset>',
        '<compiler meshdir="./meshes/../meshes/"/><asset><mesh name="t" file="t.obj"/></asset>',
        '<asset><mesh name="t" file="t.obj"/></asset><compiler assetdir="meshes"/>',
        '<compiler meshdir="nowhere"/><compiler meshdir="meshes"/><asset><mesh name="t" file="t.obj"/></asset>',
        '<compiler strippath="true" meshdir="meshes"/><asset><mesh name="t" file="/home/me/t.obj"/></asset>',
        '<compiler meshdir="../scene/meshes"/><asset><mesh name="t" file="t.obj"/></asset>',
        r'<asset><mesh name="t" file="meshes\t.obj"/></asset>',
    ],
)
def test_files_in_the_folder_of_the_scene_are_read(home: Path, inside: str) -> None:
    assert [item.id for item in load_mjcf(mjcf(home, inside + WORLD)).objects] == ["a"]


def test_includes_are_followed_and_their_folders_count(home: Path) -> None:
    write(home / "parts" / "mesh.xml", '<mujocoinclude><asset><mesh name="t" file="t.obj"/></asset></mujocoinclude>')
    write(home / "parts" / "all.xml", '<mujocoinclude><compiler meshdir="meshes"/></mujocoinclude>')
    includes = '<include file="parts/all.xml"/><include file="parts/mesh.xml"/>'
    assert len(load_mjcf(mjcf(home, includes + WORLD)).objects) == 1


REACHING_OUT = {
    "mesh": '<asset><mesh name="t" file="../other/t.obj"/></asset>',
    "meshdir": '<compiler meshdir="../other"/><asset><mesh name="t" file="t.obj"/></asset>',
    "assetdir": '<compiler assetdir="../other"/><asset><mesh name="t" file="t.obj"/></asset>',
    "backslash": r'<asset><mesh name="t" file="..\other\t.obj"/></asset>',
    "capitals": '<COMPILER meshdir="../other"/><asset><mesh name="t" file="t.obj"/></asset>',
    "include": '<include file="../other/part.xml"/>',
    "Include": '<Include file="../other/part.xml"/>',
    "model": '<asset><model name="m" file="../other/part.xml"/></asset>',
    "hfield": '<asset><hfield name="h" file="../other/t.obj" size="1 1 1 1"/></asset>',
    "skin": '<asset><skin name="s" file="../other/t.obj"/></asset>',
    "texture": '<compiler texturedir="../other"/><asset><texture name="x" file="t.obj"/></asset>',
    "cube": '<asset><texture name="x" type="cube" fileleft="../other/t.obj"/></asset>',
    "flexcomp": '<worldbody><flexcomp name="f" type="mesh" file="../other/t.obj"/></worldbody>',
}


@pytest.mark.parametrize("how", REACHING_OUT)
def test_file_outside_the_root_is_refused_with_the_needed_assets_root(home: Path, how: str) -> None:
    with pytest.raises(SceneError, match="lies outside") as caught:
        load_mjcf(mjcf(home, REACHING_OUT[how]))
    assert f"give assets_root={str(home.parent)!r}" in str(caught.value)
    assert "main.xml, line 1, <" in str(caught.value)


@pytest.mark.parametrize("how", ["mesh", "meshdir", "backslash", "include"])
def test_file_outside_the_folder_loads_with_assets_root(home: Path, how: str) -> None:
    world = "" if how == "include" else WORLD
    assert len(load_mjcf(mjcf(home, REACHING_OUT[how] + world), assets_root=home.parent).objects) == 1


def test_absolute_paths_are_refused_outside_and_read_inside(home: Path) -> None:
    inside, outside = home / "meshes" / "t.obj", home.parent / "other" / "t.obj"
    assert load_mjcf(mjcf(home, f'<asset><mesh name="t" file="{inside}"/></asset>{WORLD}'))
    with pytest.raises(SceneError, match="lies outside"):
        load_mjcf(mjcf(home, f'<asset><mesh name="t" file="{outside}"/></asset>{WORLD}'))


def test_the_root_of_a_disk_is_never_advised(home: Path) -> None:
    absolute = Path(home.anchor) / "elsewhere" / "t.obj"
    with pytest.raises(SceneError, match="give assets_root=<a folder that holds both>"):
        load_mjcf(mjcf(home, f'<asset><mesh name="t" file="{absolute}"/></asset>{WORLD}'))


@needs_links
def test_symbolic_link_out_of_the_root_is_refused(home: Path) -> None:
    os.symlink(home.parent / "other", home / "linked")
    with pytest.raises(SceneError, match="lies outside"):
        load_mjcf(mjcf(home, f'<asset><mesh name="t" file="linked/t.obj"/></asset>{WORLD}'))


def test_included_file_cannot_leave_the_root(home: Path) -> None:
    write(home / "part.xml", '<mujocoinclude><include file="../other/part.xml"/></mujocoinclude>')
    write(home / "sub" / "model.xml", '<mujoco><asset><mesh name="t" file="../../other/t.obj"/></asset></mujoco>')
    with pytest.raises(SceneError, match=r"part\.xml, line 1, <include> wants '\.\./other/part\.xml'"):
        load_mjcf(mjcf(home, '<include file="part.xml"/>'))
    write(home / "sub" / "model.txt", '<mujoco><asset><mesh name="t" file="../../other/t.obj"/></asset></mujoco>')
    for name in ("model.xml", "model.txt"):
        with pytest.raises(SceneError, match=rf"{name}, line 1, <mesh> wants '\.\./\.\./other/t\.obj'"):
            load_mjcf(mjcf(home, f'<asset><model name="m" content_type="text/xml" file="sub/{name}"/></asset>'))


def test_nothing_outside_is_opened(home: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    opened: list[Path] = []
    read = xml_files.read_bytes
    monkeypatch.setattr(xml_files, "read_bytes", lambda path: (opened.append(path), read(path))[1])
    with pytest.raises(SceneError, match="lies outside"):
        check_files(mjcf(home, REACHING_OUT["include"] + REACHING_OUT["model"]), home)
    assert opened == [home / "main.xml"]


def test_a_scene_outside_its_root_is_refused(home: Path) -> None:
    with pytest.raises(SceneError, match="lies outside assets_root"):
        load_mjcf(mjcf(home, BALL), assets_root=home / "meshes")


def test_a_missing_file_is_named(home: Path) -> None:
    with pytest.raises(SceneError, match=r"line 1, <mesh> wants 'u\.obj'; there is no such file"):
        load_mjcf(mjcf(home, f'<asset><mesh name="t" file="u.obj"/></asset>{WORLD}'))
    with pytest.raises(SceneError, match="there is no file"):
        load_mjcf(home / "none.xml")


@needs_long_names
def test_a_name_that_is_too_long_is_no_usable_one(home: Path) -> None:
    with pytest.raises(SceneError, match="is no usable file name"):
        load_mjcf(mjcf(home, f'<asset><mesh name="t" file="{"x" * 5000}"/></asset>{WORLD}'))


# -- limits on size --------------------------------------------------------------------------------------------------


def test_a_document_type_is_refused_before_any_entity_grows(home: Path) -> None:
    bomb = '<!DOCTYPE m [<!ENTITY a "aaaaaaaaaa">' + "".join(
        f'<!ENTITY {new} "{f"&{old};" * 10}">' for old, new in zip("abcdefgh", "bcdefghi", strict=True)
    )
    for text in (f"{bomb}]><mujoco>&i;</mujoco>", '<!DOCTYPE m SYSTEM "file:///etc/passwd"><mujoco/>'):
        with pytest.raises(SceneFormatError, match="has a document type"):
            load_mjcf(write(home / "bomb.xml", text))


def test_files_that_include_each_other_are_refused(home: Path) -> None:
    write(home / "a.xml", '<mujocoinclude><include file="b.xml"/></mujocoinclude>')
    write(home / "b.xml", '<mujocoinclude><include file="./a.xml"/></mujocoinclude>')
    with pytest.raises(SceneFormatError, match=r"'a\.xml' is included twice"):
        load_mjcf(mjcf(home, '<include file="a.xml"/>'))
    with pytest.raises(SceneFormatError, match=r"'main\.xml' is included twice"):
        load_mjcf(mjcf(home, '<asset><model name="m" file="main.xml"/></asset>'))


def test_a_long_chain_of_files_is_refused(home: Path) -> None:
    for i in range(30):
        write(home / f"{i}.xml", f'<mujocoinclude><include file="{i + 1}.xml"/></mujocoinclude>')
    with pytest.raises(SceneError, match="one in the other; up to 20 are read"):
        load_mjcf(mjcf(home, '<include file="0.xml"/>'))


@pytest.mark.parametrize(
    ("inside", "sentence"),
    [
        (f'<worldbody><replicate count="1000000000">{BALL[11:-12]}</replicate></worldbody>', "1,000,000,000 copies"),
        ('<worldbody><replicate count="200"><replicate count="200"/></replicate></worldbody>', "40,000 copies"),
        ('<worldbody><replicate count="1e9"/></worldbody>', "1,000,000,000 copies"),
        ('<worldbody><flexcomp name="f" count="100 100 100"/></worldbody>', "1,000,000 copies"),
        (
            '<asset><texture name="x" builtin="flat" width="1000000" height="1000"/></asset>',
            "cells .* to 6,000,000,000,000",
        ),
        ('<asset><hfield name="x" nrow="100000" ncol="100000" size="1 1 1 1"/></asset>', "cells .* to 10,000,000,000"),
        ("<worldbody>" + "<body>" * 300 + "</body>" * 300 + "</worldbody>", "MAX_DEPTH"),
    ],
)
def test_excessive_models_are_refused(home: Path, inside: str, sentence: str) -> None:
    with pytest.raises(SceneError, match=sentence):
        load_mjcf(mjcf(home, inside))


def test_copies_count_across_files(home: Path) -> None:
    write(home / "row.xml", '<mujocoinclude><replicate count="200"><geom size="1"/></replicate></mujocoinclude>')
    with pytest.raises(SceneError, match=r"row\.xml, line 1, <replicate> makes 40,000 copies"):
        load_mjcf(mjcf(home, '<worldbody><replicate count="200"><include file="row.xml"/></replicate></worldbody>'))


def test_large_files_are_refused(home: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(mjcf_files, "MAX_XML_BYTES", 10)
    with pytest.raises(SceneError, match="MJCF of up to 10 is read"):
        load_mjcf(mjcf(home, BALL))


# -- errors and warnings of MuJoCo -----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("", "is empty"),
        ("hello", "is not well-formed XML"),
        ("<mujoco>", "is not well-formed XML"),
        ("<mujoco><?xml?></mujoco>", "is not well-formed XML"),
        ("\ufeff<mujoco>\x00</mujoco>", "is not well-formed XML"),
        ("<html/>", "begins with <html>; an MJCF file begins with <mujoco>"),
        ("<robot name='urdf'/>", "begins with <robot>"),
        ("<mujoco><sofa/></mujoco>", "MuJoCo cannot read 'main.xml': .*unrecognized element"),
        ("<mujoco><worldbody><geom size='nan'/></worldbody></mujoco>", "MuJoCo cannot read"),
        ("<mujoco><size memory='100000T'/><worldbody><geom size='1'/></worldbody></mujoco>", "MuJoCo cannot read"),
        ("<mujoco/>", "the model has no geoms"),
        ("<mujoco><worldbody><body pos='1e300 0 0'><geom size='1'/></body></worldbody></mujoco>", "is 1e.300 m from"),
    ],
)
def test_broken_files_raise_scene_errors_without_output(
    home: Path, text: str, sentence: str, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(home)
    try:
        with pytest.raises(SceneError, match=sentence):
            load_mjcf(write(home / "main.xml", text))
    finally:
        told = capfd.readouterr()
    assert told.out + told.err == ""
    assert {path.name for path in home.iterdir()} == {"main.xml", "meshes"}


def test_warnings_of_mujoco_reach_neither_terminal_nor_disk(
    home: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(home)
    # MuJoCo warns of every NaN in a file.
    model, _ = open_mjcf(mjcf(home, f'<option gravity="nan 0 0"/>{BALL}'))
    assert model.nbody == 2
    told = capfd.readouterr()
    assert told.out + told.err == ""
    assert not (home / "MUJOCO_LOG.TXT").exists()


def test_broken_assets_raise_scene_errors(home: Path) -> None:
    flat = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 2 3 4\n"
    for name, text in {"junk.obj": "junk", "junk.stl": "junk", "flat.obj": flat}.items():
        write(home / name, text)
        with pytest.raises(SceneFormatError, match="MuJoCo cannot read"):
            load_mjcf(mjcf(home, f'<asset><mesh name="t" file="{name}"/></asset>{WORLD}'))


# -- through load_scene ----------------------------------------------------------------------------------------------


def test_load_scene_reads_xml(home: Path) -> None:
    path = mjcf(home, BALL)
    scene = load_scene(path, unit_m=0.5)
    assert scene.name == "main"
    assert scene.up_axis == "z"
    assert scene.object("ball").bounds_m[1, 2] == pytest.approx(0.05)
    assert load_scene(path, unit_m=1, up_axis="z").object("ball").bounds_m[1, 2] == pytest.approx(0.1)
    for wrong in ({"up_axis": "y"}, {"group": "leaf"}):
        with pytest.raises(SceneError, match="leave up_axis and group out"):
            load_scene(path, **wrong)


# -- kitchens --------------------------------------------------------------------------------------------------------

SIM = (SCENES / "furniture_sim").resolve()
REAL = {
    "kitchen/kitchen1.xml": (24, {"microroot": "microwave", "wallroot": "backwall", "knob 1": "knob 1"}),
    "kitchen/kitchen3.xml": (23, {"microroot": "microwave", "kettleroot2": "kettle", "slidelink": "slidelink"}),
    "dishwasher.xml": (3, {"dishwasher": "dishwasher", "top_rack": "top_rack", "door": "door"}),
}
KITCHENS = [name for name in REAL if name.startswith("kitchen/")]


@pytest.fixture(scope="module")
def furniture(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The root folder of the furniture that the tests build."""
    return write_furniture(tmp_path_factory.mktemp("furniture"))


@pytest.mark.parametrize("name", [*(f"own {name}" for name in IDS), *there(REAL, SIM.joinpath)])
def test_kitchens_are_loaded_by_their_bodies(furniture: Path, name: str) -> None:
    """The expected numbers of real kitchens are counted in the XML: bodies with visual geoms."""
    if name.startswith("own "):
        root, name = furniture, name.removeprefix("own ")
        n_objects, some = len(IDS[name]), {key: "kettle" if key == "kettleroot" else key for key in IDS[name]}
    else:
        root, (n_objects, some) = SIM, REAL[name]
    scene = load_mjcf(root / name, assets_root=root)
    assert len(scene.objects) == n_objects
    assert {item.id: item.name for item in scene.objects if item.id in some} == some
    again = load_mjcf(root / name, assets_root=root)
    assert again == scene


@pytest.mark.parametrize("name", ["own", *there(KITCHENS, SIM.joinpath)])
def test_kitchens_are_refused_with_the_needed_assets_root(furniture: Path, name: str) -> None:
    root, name = (furniture.resolve(), "kitchen/kitchen.xml") if name == "own" else (SIM, name)
    with pytest.raises(SceneError, match="lies outside") as caught:
        load_mjcf(root / name)
    assert f"give assets_root={str(root)!r}" in str(caught.value)


def test_furniture_is_measured_from_its_visual_geoms(furniture: Path) -> None:
    model, data = open_mjcf(furniture / "kitchen" / "kitchen.xml", assets_root=furniture)
    scene = snapshot(model, data, unit_m=0.5)
    np.testing.assert_allclose(scene.object("counter").bounds_m, np.array(COUNTER_BOUNDS_M) / 2, atol=1e-6)
    assert len({scene.object(f"knob {i}").instance_key for i in range(4)}) == 1


def test_a_real_kitchen_is_measured_from_its_visual_geoms() -> None:
    model, data = open_mjcf(needed(SIM / "kitchen" / "kitchen1.xml"), assets_root=SIM)
    scene = snapshot(model, data, unit_m=0.5)
    # box_counter_body.xml: a top of half size 0.463 x 1.08 x 0.03 at z = 1.57, on a base on the floor.
    np.testing.assert_allclose(
        scene.object("box_counter").bounds_m,
        np.array([[-0.855 - 0.465, -0.508 - 1.08, 0.003], [-0.855 + 0.463, -0.508 + 1.08, 1.60]]) / 2,
        atol=1e-6,
    )
    # The four equal knobs are copies.
    assert len({scene.object(f"knob {i}").instance_key for i in range(1, 5)}) == 1


@pytest.mark.parametrize(
    "inside",
    [
        '<size nuser_body="2000000000"/>' + BALL,
        '<size nuser_geom="100000000"/>' + BALL,
        '<size nkey="10000000"/>' + BALL,
        '<asset><mesh name="t" builtin="torus" params="5000 0.5 1 1"/></asset>' + WORLD,
        '<asset><mesh name="t" builtin="sphere" params="1e9"/></asset>' + WORLD,
    ],
)
def test_sizes_of_generated_rooms_and_meshes_are_bounded(home: Path, inside: str) -> None:
    with pytest.raises(SceneError, match="up to .* is read"):
        open_mjcf(mjcf(home, inside))


def test_mujoco_errors_become_scene_errors(home: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    import mujoco

    def fails(model: object) -> None:
        raise RuntimeError("could not allocate")

    monkeypatch.setattr(mujoco, "MjData", fails)
    with pytest.raises(SceneFormatError, match="could not allocate"):
        open_mjcf(mjcf(home, BALL))
