"""URDF: every link is an object at the pose of yourdfpy and MuJoCo; files outside and broken files are refused."""

from __future__ import annotations

import os
import re
import shutil
import sys
import warnings
from pathlib import Path

import numpy as np
import pytest

from looks import image_file
from scene2hap import HapticSession, SceneSnapshot, bake, load_scene
from scene2hap.engines import MuJoCoLink
from scene2hap.errors import MissingExtra, Scene2HapError, SceneError, SceneFormatError
from scene2hap.scene import limits
from scene2hap.scene.formats import urdf, urdf_files
from scene2hap.scene.load import TextureWarning
from systems import needs_links, needs_long_names

LAUNDRY = Path(__file__).parents[3] / "data" / "urdf" / "laundry"
MASSES_KG = {"floor": None, "washing_machine": 62.5, "machine_door": 2.0, "stool": 3.5, "towel": 0.4}
TETRAHEDRON = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"
BOX = "<visual><geometry><box size='1 1 1'/></geometry></visual>"


@pytest.fixture
def home(tmp_path: Path) -> Path:
    """The scene folder `robot`, beside a folder `other`; each holds a mesh."""
    for folder in ("robot/meshes", "other/meshes"):
        (tmp_path / folder).mkdir(parents=True)
        (tmp_path / folder / "t.obj").write_text(TETRAHEDRON)
    return tmp_path / "robot"


def write(home: Path, inside: str, name: str = "robot.urdf") -> Path:
    (home / name).write_text(f"<robot name='r'>{inside}</robot>", encoding="utf-8")
    return home / name


def loaded(home: Path, inside: str) -> SceneSnapshot:
    return load_scene(write(home, inside), unit_m=1.0)


def mesh(name: str, more: str = "") -> str:
    return f"<link name='a'><visual><geometry><mesh filename='{name}' {more}/></geometry></visual></link>"


def hangs(child: str, parent: str, origin: str = "", kind: str = "fixed") -> str:
    ends = f"<parent link='{parent}'/><child link='{child}'/>"
    return f"<joint name='{parent}_{child}' type='{kind}'>{ends}<origin {origin}/></joint>"


# -- the same scene in other formats and readers ---------------------------------------------------------------------


def laundry() -> SceneSnapshot:
    pytest.importorskip("collada", reason="needs the extra dae")
    return load_scene(LAUNDRY / "laundry.urdf")


def test_links_equal_the_nodes_of_the_glb() -> None:
    ours, theirs = laundry(), load_scene(LAUNDRY / "laundry.glb", up_axis="z")
    assert ours.up_axis == "z"
    assert [item.id for item in ours.objects] == [item.id for item in theirs.objects] == list(MASSES_KG)
    for a, b in zip(ours.objects, theirs.objects, strict=True):
        assert a.name == b.name
        np.testing.assert_allclose(a.pose.position_m, b.pose.position_m, atol=1e-6)
        np.testing.assert_allclose(a.pose.rotation, b.pose.rotation, atol=1e-6)
        np.testing.assert_allclose(a.bounds_m, b.bounds_m, atol=1e-6)
        for size in ("length_m", "width_m", "thickness_m"):
            assert getattr(a.surface, size) == pytest.approx(getattr(b.surface, size), abs=1e-6)


def test_masses_are_read_from_the_file() -> None:
    assert {item.id: item.mass_kg for item in laundry().objects} == MASSES_KG


def test_mujoco_puts_every_link_in_the_same_place() -> None:
    mujoco = pytest.importorskip("mujoco", reason="needs the extra mujoco")
    ours = laundry()
    keep = '<mujoco><compiler fusestatic="false" discardvisual="false"/></mujoco>'
    text = (LAUNDRY / "laundry.urdf").read_text(encoding="utf-8").replace('name="laundry">', f'name="laundry">{keep}')
    # MuJoCo reads neither COLLADA nor PLY; the poses of links do not depend on their meshes.
    text = re.sub(r"package://laundry/meshes/\w+\.\w+", "door.obj", text)
    model = mujoco.MjModel.from_xml_string(text, {"door.obj": (LAUNDRY / "meshes" / "door.obj").read_bytes()})
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    for item in ours.objects:
        body = data.body(item.id)
        np.testing.assert_allclose(item.pose.position_m, body.xpos, atol=1e-9)
        np.testing.assert_allclose(item.pose.rotation, body.xmat.reshape(3, 3), atol=1e-9)
        if item.mass_kg is not None:
            assert model.body(item.id).mass[0] == pytest.approx(item.mass_kg)


def test_poses_follow_a_running_mujoco_model(home: Path) -> None:
    """As described in docs/urdf.md."""
    mujoco = pytest.importorskip("mujoco", reason="needs the extra mujoco")
    keep = "<mujoco><compiler fusestatic='false' discardvisual='false'/></mujoco>"
    mass = "<inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial>"
    links = f"<link name='base'/><link name='table'>{BOX}</link><link name='phone'>{mass}{BOX}</link>"
    slide = "<axis xyz='1 0 0'/><limit lower='-9' upper='9' effort='9' velocity='9'/></joint>"
    joint = hangs("phone", "table", "xyz='0 0 1'", "prismatic").replace("</joint>", slide)
    path = write(home, f"{keep}{links}{hangs('table', 'base')}{joint}")
    scene = load_scene(path)
    model = mujoco.MjModel.from_xml_path(str(path))
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    session = HapticSession(scene, bake(scene))
    link = MuJoCoLink(model, data, session)
    data.qpos[:] = 0.25
    mujoco.mj_forward(model, data)
    link.update()
    assert session.poses["phone"].position_m == pytest.approx((0.25, 0.0, 1.0))
    assert session.poses["table"].position_m == (0.0, 0.0, 0.0)


def test_every_load_is_the_same() -> None:
    assert len({laundry().to_json() for _ in range(3)}) == 1


# -- links -----------------------------------------------------------------------------------------------------------


def test_links_without_shape_are_frames(home: Path) -> None:
    links = f"<link name='base'/><link name='tip'>{BOX}</link><link name='tool'/>"
    scene = loaded(home, links + hangs("tip", "base", "xyz='0 0 1'") + hangs("tool", "tip"))
    assert [(item.id, item.pose.position_m) for item in scene.objects] == [("tip", (0.0, 0.0, 1.0))]


def test_a_visual_sphere_of_radius_0_hides_its_link(home: Path) -> None:
    hidden = f"<visual><geometry><sphere radius='0.0'/></geometry></visual>{BOX.replace('visual', 'collision')}"
    scene = loaded(home, f"<link name='leg'>{BOX}</link><link name='toe'>{hidden}</link>{hangs('toe', 'leg')}")
    assert [item.id for item in scene.objects] == ["leg"]


@pytest.mark.parametrize("kind", ["fixed", "revolute", "continuous", "prismatic", "floating", "planar"])
def test_joints_are_placed_at_zero(home: Path, kind: str) -> None:
    joint = hangs("b", "a", "xyz='1 2 3' rpy='0 0 1.5707963267948966'", kind)
    item = loaded(home, f"<link name='a'/><link name='b'>{BOX}</link>{joint}").object("b")
    assert item.pose.position_m == (1.0, 2.0, 3.0)
    np.testing.assert_allclose(item.pose.rotation, [[0, -1, 0], [1, 0, 0], [0, 0, 1]], atol=1e-12)


def test_angles_turn_about_fixed_axes(home: Path) -> None:
    roll, pitch, yaw = 0.3, -0.4, 0.5
    joint = hangs("b", "a", f"rpy='{roll} {pitch} {yaw}'")
    rotation = loaded(home, f"<link name='a'/><link name='b'>{BOX}</link>{joint}").object("b").pose.rotation

    def about(axis: int, angle: float) -> np.ndarray:
        turn, (i, j) = np.eye(3), ((1, 2), (2, 0), (0, 1))[axis]
        turn[[i, i, j, j], [i, j, i, j]] = np.cos(angle), -np.sin(angle), np.sin(angle), np.cos(angle)
        return turn

    np.testing.assert_allclose(rotation, about(2, yaw) @ about(1, pitch) @ about(0, roll), atol=1e-12)


@pytest.mark.parametrize(
    ("shape", "half_m"),
    [
        ("<box size='1 2 3'/>", (0.5, 1.0, 1.5)),
        ("<cylinder radius='0.5' length='2'/>", (0.5, 0.5, 1.0)),
        ("<capsule radius='0.5' length='2'/>", (0.5, 0.5, 1.5)),
        ("<sphere radius='0.25'/>", (0.25, 0.25, 0.25)),
    ],
)
def test_solids_have_their_sizes(home: Path, shape: str, half_m: tuple[float, float, float]) -> None:
    scene = loaded(home, f"<link name='a'><visual><geometry>{shape}</geometry></visual></link>")
    np.testing.assert_allclose(scene.object("a").bounds_m, [-np.array(half_m), half_m], atol=1e-9)


def test_visuals_are_used_and_collision_shapes_only_without_visuals(home: Path) -> None:
    hull = "<collision><geometry><box size='9 9 9'/></geometry></collision>"
    scene = loaded(home, f"<link name='a'>{BOX}{hull}</link><link name='b'>{hull}</link>")
    assert [np.ptp(item.bounds_m, axis=0).tolist() for item in scene.objects] == [[1.0] * 3, [9.0] * 3]


def test_shapes_of_one_link_are_one_object_in_the_link_frame(home: Path) -> None:
    far = "<visual><origin xyz='2 0 0'/><geometry><box size='1 1 1'/></geometry></visual>"
    scene = loaded(home, f"<link name='r'/><link name='a'>{BOX}{far}</link>" + hangs("a", "r", "xyz='0 5 0'"))
    (item,) = scene.objects
    assert item.pose.position_m == (0.0, 5.0, 0.0)
    np.testing.assert_allclose(item.bounds_m, [[-0.5, 4.5, -0.5], [2.5, 5.5, 0.5]], atol=1e-9)


def test_copies_of_a_mesh_are_instances(home: Path) -> None:
    one = mesh("meshes/t.obj", "scale='2 2 2'")
    scene = loaded(home, one + one.replace("'a'", "'b'") + one.replace("'a'", "'c'").replace("2 2 2", "1 1 1"))
    keys = {item.id: item.instance_key for item in scene.objects}
    assert keys["a"] == keys["b"] != keys["c"]
    np.testing.assert_allclose(scene.object("b").bounds_m, [[0.0] * 3, [2.0] * 3], atol=1e-9)


def test_mirrored_meshes_still_face_outwards(home: Path) -> None:
    import trimesh

    shape = loaded(home, mesh("meshes/t.obj", "scale='-1 1 1'")).object("a").geometry.mesh
    assert trimesh.Trimesh(shape.vertices_m, shape.faces).volume == pytest.approx(1 / 6)


def colour(scene: SceneSnapshot, key: str = "a") -> list[tuple[float, ...]]:
    looks = scene.object(key).appearance
    return [] if looks is None else [material.color_rgba for material in looks.materials]


def test_colours_are_read_inline_or_by_name(home: Path) -> None:
    red = "<material name='red'><color rgba='1 0 0 1'/></material>"
    named = BOX.replace("</visual>", "<material name='red'/></visual>")
    own = BOX.replace("</visual>", "<material name='x'><color rgba='0 1 0 0.5'/></material></visual>")
    scene = loaded(home, f"{red}<link name='a'>{named}</link><link name='b'>{own}</link><link name='c'>{BOX}</link>")
    assert colour(scene) == [(1.0, 0.0, 0.0, 1.0)]
    assert colour(scene, "b") == [(0.0, 1.0, 0.0, 0.5)]
    assert colour(scene, "c") == []


def test_a_mesh_keeps_its_own_materials(home: Path) -> None:
    (home / "blue.mtl").write_text("newmtl blue\nKd 0 0 1\n")
    (home / "blue.obj").write_text("mtllib blue.mtl\nusemtl blue\n" + TETRAHEDRON)
    red = "<material name='red'><color rgba='1 0 0 1'/></material>"
    scene = loaded(home, mesh("blue.obj").replace("</visual>", f"{red}</visual>"))
    assert colour(scene)[0][2] == 1.0


def test_texture_becomes_its_mean_colour(home: Path) -> None:
    (home / "t.png").write_bytes(image_file(np.full((4, 4, 3), (255, 0, 51), np.uint8)))
    textured = "<material name='m'><texture filename='t.png'/></material></visual>"
    scene = loaded(home, f"<link name='a'>{BOX.replace('</visual>', textured)}</link>")
    np.testing.assert_allclose(colour(scene), [(1.0, 0.0, 0.2, 1.0)], atol=1e-6)


@pytest.mark.parametrize("name", ["gone.png", "../other/t.png", "robot.urdf"])
def test_missing_texture_warns_and_keeps_the_colour(home: Path, name: str) -> None:
    textured = f"<material name='m'><color rgba='1 0 0 1'/><texture filename='{name}'/></material></visual>"
    with pytest.warns(TextureWarning, match="read without 1 texture, in"):
        scene = loaded(home, f"<link name='a'>{BOX.replace('</visual>', textured)}</link>")
    assert colour(scene) == [(1.0, 0.0, 0.0, 1.0)]


def test_collada_unit_is_applied_and_its_axis_is_ignored(home: Path) -> None:
    pytest.importorskip("collada", reason="needs the extra dae")
    text = (LAUNDRY / "meshes" / "drum.dae").read_text(encoding="utf-8")
    plain = load_scene(LAUNDRY / "meshes" / "drum.dae", unit_m=1.0).objects[0].bounds_m
    asset = '<asset><created>2024-01-01</created><modified>2024-01-01</modified><unit meter="0.01"/>'
    (home / "d.dae").write_text(
        re.sub(r"<asset>.*?</asset>", f"{asset}<up_axis>Y_UP</up_axis></asset>", text, flags=re.S)
    )
    np.testing.assert_allclose(loaded(home, mesh("d.dae")).object("a").bounds_m, plain / 100, atol=1e-9)


def test_collada_without_reader_is_refused_with_the_install_command(
    home: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    shutil.copy(LAUNDRY / "meshes" / "drum.dae", home / "d.dae")
    monkeypatch.setitem(sys.modules, "collada", None)
    with pytest.raises(MissingExtra, match=r"link 'a', <visual>, mesh 'd\.dae': .*pip install pycollada"):
        loaded(home, mesh("d.dae"))


# -- files that may be read ------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "name",
    ["meshes/t.obj", r"meshes\t.obj", "package://robot/meshes/t.obj", "model://robot/meshes/t.obj", "./meshes/./t.obj"],
)
def test_mesh_paths_are_resolved(home: Path, name: str) -> None:
    assert len(loaded(home, mesh(name)).objects) == 1


def test_a_package_around_the_file_is_found(home: Path) -> None:
    (home / "urdf").mkdir()
    path = write(home / "urdf", mesh("package://robot/meshes/t.obj"))
    assert len(load_scene(path, assets_root=home).objects) == 1
    path = write(home / "urdf", mesh("package://other/meshes/t.obj"))
    assert len(load_scene(path, assets_root=home.parent).objects) == 1


def test_absolute_paths_inside_the_root_are_read(home: Path) -> None:
    assert len(loaded(home, mesh((home / "meshes" / "t.obj").as_uri())).objects) == 1
    assert len(loaded(home, mesh(f"{home}/meshes/t.obj")).objects) == 1


@pytest.mark.parametrize(
    ("compiler", "name"),
    [
        ("meshdir='meshes'", "t.obj"),
        ("meshdir='meshes'", "/home/me/t.obj"),
        ("strippath='false' meshdir='.'", "meshes/t.obj"),
    ],
)
def test_mujoco_meshdir_is_used(home: Path, compiler: str, name: str) -> None:
    assert len(loaded(home, f"<mujoco><compiler {compiler}/></mujoco>{mesh(name)}").objects) == 1


@pytest.mark.parametrize(
    "name",
    [
        "../other/meshes/t.obj",
        r"..\other\meshes\t.obj",
        "package://robot/../other/meshes/t.obj",
        pytest.param("linked/t.obj", marks=needs_links),
    ],
)
def test_file_outside_the_root_is_refused_with_the_needed_assets_root(home: Path, name: str) -> None:
    if "linked" in name:
        os.symlink(home.parent / "other" / "meshes", home / "linked")
    with pytest.raises(SceneError, match="link 'a', <visual>, <mesh> wants .* lies outside") as caught:
        loaded(home, mesh(name))
    assert f"give assets_root={str(home.parent)!r}" in str(caught.value)
    assert len(load_scene(write(home, mesh(name)), assets_root=home.parent).objects) == 1


def test_error_suggests_the_package_folder_as_assets_root(home: Path) -> None:
    (home / "urdf").mkdir()
    with pytest.raises(SceneError, match="lies outside") as caught:
        load_scene(write(home / "urdf", mesh("package://robot/meshes/t.obj")))
    assert f"give assets_root={str(home)!r}" in str(caught.value)


def test_nothing_outside_is_opened(home: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    opened: list[Path] = []
    read = Path.read_bytes
    monkeypatch.setattr(Path, "read_bytes", lambda path: (opened.append(path), read(path))[1])
    with pytest.raises(SceneError, match="lies outside"):
        loaded(home, mesh("../other/meshes/t.obj"))
    assert opened == [home / "robot.urdf"]


@pytest.mark.parametrize(
    ("name", "sentence"),
    [
        ("gone.obj", r"wants 'gone\.obj'; there is no such file"),
        ("package://gone/t.obj", "there is no such file.*as assets_root"),
        ("http://example.org/t.obj", "Addresses are never fetched"),
        pytest.param("x" * 5000, "is no usable file name", marks=needs_long_names),
        ("robot.urdf", r"\.obj, \.stl, \.dae, \.ply, \.glb, \.gltf are read"),
        ("meshes", "there is no such file"),
    ],
)
def test_error_names_an_unreadable_mesh(home: Path, name: str, sentence: str) -> None:
    with pytest.raises(SceneError, match=f"link 'a', <visual>.*{sentence}"):
        loaded(home, mesh(name))


def test_broken_mesh_error_names_its_link(home: Path) -> None:
    (home / "short.stl").write_bytes(b"\0" * 80 + b"\xff\0\0\0")
    with pytest.raises(SceneFormatError, match=r"link 'a', <visual>, mesh 'short\.stl': "):
        loaded(home, mesh("short.stl"))


# -- faults ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("inside", "sentence"),
    [
        (f"<link>{BOX}</link>", "a <link> has no name"),
        (f"<link name='a'>{BOX}</link><link name='a'/>", r"two elements <link name='a'>"),
        (f"<link name='a'>{BOX}</link>{hangs('b', 'a')}", "joins link 'b', which does not exist"),
        (f"<link name='arm'>{BOX}</link>{hangs('Arm', 'arm')}", "joins link 'Arm'.*Did you mean 'arm'"),
        (
            f"<link name='a'>{BOX}</link><link name='b'/><link name='c'/>{hangs('c', 'a')}{hangs('c', 'b')}",
            "hangs link 'c' on 'b'; it hangs on 'a'",
        ),
        (f"<link name='a'>{BOX}</link><link name='b'/>{hangs('a', 'b')}{hangs('b', 'a')}", "hangs below itself"),
        (f"<link name='a'>{BOX}</link>{hangs('a', 'a')}", "link 'a' hangs below itself"),
        (f"<link name='a'>{BOX}</link><joint name='j'><child link='a'/></joint>", "joint 'j' has no <parent>"),
        (f"<link name='a'>{BOX}</link><joint name='j'><parent/><child/></joint>", "<parent> has no link"),
        (f"<link name='a'>{BOX.replace('1 1 1', '1 1')}</link>", "size is '1 1'; it must be 3 finite numbers"),
        (
            f"<link name='a'>{BOX.replace('1 1 1', '$(optenv SIZE 1 1 1)')}</link>",
            r"must be 3 finite numbers\. \$ is an expression of xacro\. .*xacro FILE > robot\.urdf",
        ),
        (f"<link name='a'>{BOX.replace('1 1 1', '1 1 nan')}</link>", "it must be 3 finite numbers"),
        (f"<link name='a'>{BOX.replace('1 1 1', '1 1 -1')}</link>", "they must be above 0"),
        (f"<link name='a'>{BOX.replace('1 1 1', '1 1 1e30')}</link>", "and sensible"),
        (f"<link name='a'>{BOX.replace('box', 'cone')}</link>", "geometry is a box, cylinder"),
        (mesh(""), "<mesh> has no filename"),
        (mesh("meshes/t.obj", "scale='0 0 0'"), "no object in scene .* has a size"),
        (mesh("meshes/t.obj", "scale='1'"), "scale is '1'; it must be 3 finite numbers"),
        (f"<link name='a'><inertial><mass value='-1'/></inertial>{BOX}</link>", "a mass of -1 kg"),
        (f"<link name='a'><inertial><mass/></inertial>{BOX}</link>", "value is None; it must be a finite number"),
        (f"<link name='a'><inertial><mass value='1e300'/></inertial>{BOX}</link>", "mass_kg of object .a. is"),
        (f"<link name='a'/><link name='b'>{BOX}</link>" + hangs("b", "a", "xyz='1e300 0 0'"), "beyond 1e.06 m"),
        ("<link name='a'/>", "holds no triangles"),
        ("<xacro:macro name='x'/>", "a macro of xacro.*xacro FILE > robot.urdf"),
        ("<link name='a'>", "is not well-formed XML"),
    ],
)
def test_invalid_urdf_is_refused(home: Path, inside: str, sentence: str) -> None:
    with pytest.raises(SceneError, match=sentence):
        loaded(home, inside)


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("", "is empty"),
        ("a shopping list", "is not well-formed XML"),
        ("\n<?xml version='1.0'?><robot/>", "remove what is before them"),
        ("<mujoco/>", "begins with <mujoco>; a URDF file begins with <robot>. An MJCF file has the suffix .xml"),
        ("<sdf/>", "begins with <sdf>; a URDF file begins with <robot>"),
        ("<?xml version='1.0' encoding='nowhere'?><robot/>", "is not well-formed XML"),
        ("<!DOCTYPE robot SYSTEM 'file:///etc/passwd'><robot/>", "has a document type"),
        ("<!DOCTYPE r [<!ENTITY a 'aa'><!ENTITY b '&a;&a;'>]><robot name='&b;'/>", "has a document type"),
        ("<robot>" + "<link>" * 300 + "</link>" * 300 + "</robot>", "MAX_DEPTH"),
    ],
)
def test_text_that_is_not_urdf_is_refused(tmp_path: Path, text: str, sentence: str) -> None:
    (tmp_path / "r.urdf").write_text(text, encoding="utf-8")
    with pytest.raises(SceneError, match=sentence):
        load_scene(tmp_path / "r.urdf")


def test_urdf_with_xml_suffix_is_refused_with_a_hint(home: Path) -> None:
    with pytest.raises(SceneFormatError, match=r"begins with <robot>.*A URDF file has the suffix \.urdf"):
        load_scene(write(home, f"<link name='a'>{BOX}</link>", "robot.xml"))


def test_error_names_the_exceeded_limit(home: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("t", "u"):
        (home / f"meshes/{name}.obj").write_text(f"# {'a' * 500}\n{TETRAHEDRON}")
    path = write(home, mesh("meshes/t.obj") + mesh("meshes/u.obj").replace("'a'", "'b'"))
    for owner, limit, value, what in (
        (urdf, "MAX_XML_BYTES", 10, "URDF of up to 10 is read"),
        (limits, "MAX_OBJECTS", 1, "number of links is 2"),
        (limits, "MAX_TRIANGLES", 7, "number of triangles is 8"),
        (limits, "MAX_NODES", 3, "number of elements"),
        (limits, "MAX_FILE_BYTES", 2 * (home / "meshes/t.obj").stat().st_size - 1, "bytes of all meshes"),
    ):
        with monkeypatch.context() as patch, pytest.raises(SceneError, match=what):
            patch.setattr(owner, limit, value)
            load_scene(path)


def test_a_long_chain_of_links_is_read(home: Path) -> None:
    links = "".join(f"<link name='l{i}'/>" for i in range(2000))
    joints = "".join(hangs(f"l{i + 1}", f"l{i}", "xyz='0 0 0.01'") for i in range(1999))
    scene = loaded(home, f"{links}{joints}<link name='end'>{BOX}</link>{hangs('end', 'l1999')}")
    assert scene.object("end").pose.position_m[2] == pytest.approx(19.99)


def test_changed_files_raise_only_scene_errors(tmp_path: Path) -> None:
    pytest.importorskip("collada", reason="needs the extra dae")
    shutil.copytree(LAUNDRY, tmp_path / "laundry")
    path = tmp_path / "laundry" / "laundry.urdf"
    data = np.frombuffer(path.read_bytes(), np.uint8)
    rng, outcomes = np.random.default_rng(9), set()
    for _ in range(60):
        mutated = data.copy()
        at = rng.integers(0, len(data), size=rng.integers(1, 4))
        mutated[at] = rng.choice(np.frombuffer(b'0123456789-.e<>/="abz', np.uint8), size=len(at))
        path.write_bytes(mutated.tobytes())
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", UserWarning)
            try:
                load_scene(path)
                outcomes.add("ok")
            except Scene2HapError as error:
                outcomes.add(type(error).__name__)
    assert {"ok", "SceneFormatError"} <= outcomes <= {"ok", "SceneFormatError", "SceneError", "MissingExtra"}


def test_files_are_searched_in_few_folders(home: Path) -> None:
    finder = urdf_files.UrdfFiles(home / "robot.urdf", home, None)
    assert finder.find("package://robot/meshes/t.obj", "x") == (home / "meshes" / "t.obj").resolve()
    with pytest.raises(SceneError, match="no such file"):
        finder.find("package://meshes/robot/t.obj", "x")


def test_links_that_turn_on_others_have_hinges(home: Path) -> None:
    inside = (
        f"<link name='base'>{BOX}</link><link name='frame'/><link name='door'>{BOX}</link>"
        f"<link name='knob'>{BOX}</link><link name='drawer'>{BOX}</link><link name='plate'>{BOX}</link>"
        f"<link name='foot'>{BOX}</link><link name='cart'>{BOX}</link><link name='lid'>{BOX}</link>"
        + hangs("cart", "base", kind="prismatic")
        + hangs("lid", "base", "xyz='0 0 0.6'", "revolute")
        + hangs("plate", "door", "xyz='0 0 0.9'")
        + hangs("foot", "base", "xyz='0 0 -1'")
        + hangs("frame", "cart", "xyz='0 1 0'")
        + hangs("door", "frame", "xyz='0.5 0 0.25' rpy='0 0.3 0'", "revolute").replace("</j", "<axis xyz='0 2 0'/></j")
        + hangs("knob", "door", "xyz='0 0.5 0'", "continuous")
        + hangs("drawer", "base", "xyz='1 0 0'", "prismatic")
    )
    scene = loaded(home, inside)
    held = {item.id: item.hinge for item in scene.objects if item.hinge is not None}
    # The foot is fixed to the base, which does not move.
    on = {"lid": "base", "door": "cart", "knob": "door", "plate": "door"}
    assert {x: hinge.to for x, hinge in held.items()} == on
    # The plate's box and the door's have 0.1 m in common.
    assert held["plate"].other_point_m == pytest.approx((0.0, 0.0, 0.45), abs=1e-9)
    # Along y, the cart ends at 0.5 m and the door begins there; the knob turns about x, as without an axis.
    assert held["door"].other_point_m == pytest.approx((0.5, 0.5, 0.25), abs=1e-9)
    assert held["door"].point_m == pytest.approx((0.0, -0.5, 0.0), abs=1e-9)
    assert held["knob"].point_m == pytest.approx((0.0, 0.0, 0.0), abs=1e-9)
    for item in scene.objects:
        if item.hinge is not None:
            here, there = item.pose.to_world([item.hinge.point_m]), scene.object(item.hinge.to).pose
            assert here == pytest.approx(there.to_world([item.hinge.other_point_m]), abs=1e-9)
    with pytest.raises(SceneFormatError, match="must have a direction"):
        loaded(home, inside.replace("0 2 0", "0 0 0"))
