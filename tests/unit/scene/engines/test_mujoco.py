"""MuJoCo models as snapshots, held against MuJoCo's own numbers."""

from __future__ import annotations

import io
import sys
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image

from scene2hap import ContactGraph, SceneSnapshot
from scene2hap.errors import MissingExtra, SceneError
from scene2hap.scene.engines.mujoco import poses, snapshot

mujoco = pytest.importorskip("mujoco", reason="needs the extra mujoco")

# A tetrahedron with a corner at the origin of its file; compiling moves it to its own centre of mass.
TETRAHEDRON = "v 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 3\nvt 0.25 0.75\nvt 0.75 0.75\nvt 0.25 0.25\n" + "".join(
    f"f {a}/1 {b}/2 {c}/3\n" for a, b, c in [(1, 3, 2), (1, 2, 4), (1, 4, 3), (2, 3, 4)]
)

ALL_SHAPES = """
<mujoco model="shapes">
  <compiler angle="degree"/>
  <asset>
    <mesh name="wedge" file="wedge.obj" scale="0.1 0.1 0.1" refpos="0.3 0 0"/>
    <mesh name="mirrored" file="wedge.obj" scale="-0.1 0.1 0.2"/>
  </asset>
  <worldbody>
    <geom name="floor" type="plane" size="3 2 1" pos="0 0 -1"/>
    <geom name="pillar" type="mesh" mesh="wedge" pos="2 1 0" euler="10 20 30"/>
    <body name="sphere" pos="1 2 3"><geom type="sphere" size="0.3" pos="0.1 0 0"/></body>
    <body name="capsule" pos="0 1 0" euler="20 50 70">
      <freejoint/><geom type="capsule" size="0.1 0.4" euler="30 0 0"/>
    </body>
    <body name="cylinder" euler="0 30 60"><geom type="cylinder" size="0.2 0.1" pos="0 0 2" euler="80 0 10"/></body>
    <body name="ellipsoid" pos="0 0 5" euler="10 0 0"><geom type="ellipsoid" size="0.1 0.2 0.3" euler="0 40 20"/></body>
    <body name="box" pos="-1 0 0" euler="0 0 45">
      <geom type="box" size="0.1 0.2 0.3" euler="15 25 35"/>
      <body name="mesh" pos="0.5 0 0" euler="5 0 0">
        <joint type="hinge" axis="0 0 1" damping="1"/>
        <geom type="mesh" mesh="wedge" pos="0 0.2 0" euler="40 0 0"/>
        <geom type="mesh" mesh="mirrored" pos="0 0 0.5"/>
      </body>
    </body>
  </worldbody>
</mujoco>
"""


def load(xml: str, assets: dict[str, bytes] | None = None) -> tuple[Any, Any]:
    model = mujoco.MjModel.from_xml_string(xml, {"wedge.obj": TETRAHEDRON.encode(), **(assets or {})})
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    return model, data


def scene_of(body: str, assets: dict[str, bytes] | None = None, **options: Any) -> SceneSnapshot:
    return snapshot(*load(f"<mujoco>{body}</mujoco>", assets), **options)


def geom_bounds(model: Any, data: Any, geom: int) -> NDArray[np.float64]:
    """Lowest and highest corner (2, 3) in the world from MuJoCo's pose of the geom, by the support of each shape."""
    kind, size = mujoco.mjtGeom(int(model.geom_type[geom])), model.geom_size[geom]
    at, turn = data.geom_xpos[geom], data.geom_xmat[geom].reshape(3, 3)
    if kind == mujoco.mjtGeom.mjGEOM_MESH:
        mesh = model.geom_dataid[geom]
        first = model.mesh_vertadr[mesh]
        points = model.mesh_vert[first : first + model.mesh_vertnum[mesh]] @ turn.T + at
        return np.array([points.min(axis=0), points.max(axis=0)])
    along = np.abs(turn[:, 2])
    reach = {
        mujoco.mjtGeom.mjGEOM_PLANE: np.abs(turn[:, :2]) @ size[:2],
        mujoco.mjtGeom.mjGEOM_SPHERE: np.full(3, size[0]),
        mujoco.mjtGeom.mjGEOM_CAPSULE: along * size[1] + size[0],
        mujoco.mjtGeom.mjGEOM_CYLINDER: along * size[1] + size[0] * np.sqrt(np.maximum(1 - along**2, 0)),
        mujoco.mjtGeom.mjGEOM_ELLIPSOID: np.sqrt(turn**2 @ size**2),
        mujoco.mjtGeom.mjGEOM_BOX: np.abs(turn) @ size,
    }[kind]
    return np.array([at - reach, at + reach])


def union(bounds: list[NDArray[np.float64]]) -> NDArray[np.float64]:
    return np.array([np.min([low for low, _ in bounds], axis=0), np.max([high for _, high in bounds], axis=0)])


def names(scene: SceneSnapshot) -> dict[str, str]:
    return {item.id: item.name for item in scene.objects}


# -- where things are ------------------------------------------------------------------------------------------------


def test_every_shape_is_where_mujoco_has_it() -> None:
    model, data = load(ALL_SHAPES)
    scene = snapshot(model, data)
    assert scene.name == "shapes"
    assert scene.up_axis == "z"
    assert scene.contacts is None
    assert {item.id for item in scene.objects} == {
        "floor", "pillar", "sphere", "capsule", "cylinder", "ellipsoid", "box", "mesh"
    }  # fmt: skip
    for item in scene.objects:
        if item.id in ("floor", "pillar"):
            geoms = [model.geom(item.id).id]
        else:
            geoms = [geom for geom in range(model.ngeom) if model.geom_bodyid[geom] == model.body(item.id).id]
        truth = union([geom_bounds(model, data, geom) for geom in geoms])
        # Round shapes are inscribed polygons of 32 sides: 0.5 % of the radius.
        np.testing.assert_allclose(item.bounds_m, truth, atol=0.005 * 0.5)


@pytest.mark.parametrize("name", ["box", "mesh", "pillar", "floor"])
def test_flat_shapes_are_exact(name: str) -> None:
    model, data = load(ALL_SHAPES)
    item = snapshot(model, data).object(name)
    body = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_BODY, name)
    geoms = [geom for geom in range(model.ngeom) if model.geom_bodyid[geom] == body]
    geoms = geoms if body >= 0 else [model.geom(name).id]
    np.testing.assert_allclose(item.bounds_m, union([geom_bounds(model, data, g) for g in geoms]), atol=1e-6)


def test_meshes_face_outwards_even_if_their_scale_mirrors_them() -> None:
    mesh = snapshot(*load(ALL_SHAPES)).object("mesh").geometry.mesh
    a, b, c = np.moveaxis(mesh.vertices_m[mesh.faces], 1, 0)
    # 1 x 2 x 3 / 6 for the tetrahedron of the file.
    assert np.einsum("ij,ij->", a, np.cross(b, c)) / 6 == pytest.approx(0.001 + 0.002, rel=1e-6)


def test_poses_are_those_of_bodies_and_of_the_worlds_geoms_as_authored() -> None:
    model, data = load(ALL_SHAPES)
    scene = snapshot(model, data)
    for item in scene.objects:
        if item.id in ("floor", "pillar"):
            continue
        assert item.pose.position_m == tuple(data.body(item.id).xpos)
        w, x, y, z = data.body(item.id).xquat
        np.testing.assert_allclose(item.pose.rotation_xyzw, (x, y, z, w), atol=1e-9)
    # Compiling moves a mesh into its frame of inertia, but the file says pos="2 1 0"; refpos, to scale, stays.
    assert scene.object("pillar").pose.position_m == pytest.approx((2, 1, 0), abs=1e-6)
    corner = scene.object("pillar").geometry.mesh.bounds_m[0]
    assert corner == pytest.approx((-0.03, 0, 0), abs=1e-6)


def test_poses_after_steps_are_those_of_a_new_snapshot() -> None:
    model, data = load(ALL_SHAPES)
    before = snapshot(model, data)
    data.qvel[:] = 1.0
    for _ in range(50):
        mujoco.mj_step(model, data)
    mujoco.mj_kinematics(model, data)
    after, now = snapshot(model, data), poses(model, data)
    assert list(now) == [item.id for item in before.objects] == [item.id for item in after.objects]
    assert now == {item.id: item.pose for item in after.objects}
    moved = {key for key in now if now[key] != before.object(key).pose}
    assert moved == {"capsule", "mesh"}
    assert [item.geometry for item in after.objects] == [item.geometry for item in before.objects]


def test_a_unit_scales_meshes_and_places() -> None:
    model, data = load(ALL_SHAPES)
    metres, half = snapshot(model, data), snapshot(model, data, unit_m=0.5)
    for one, other in zip(metres.objects, half.objects, strict=True):
        np.testing.assert_allclose(other.bounds_m, one.bounds_m / 2, atol=1e-8)
    assert poses(model, data, unit_m=0.5) == {item.id: item.pose for item in half.objects}


def test_a_height_field_is_a_terrain() -> None:
    asset = '<asset><hfield name="hill" nrow="2" ncol="3" size="3 2 5 1" elevation="0 0 0  0 0 1"/></asset>'
    scene = scene_of(f'{asset}<worldbody><geom name="hill" type="hfield" hfield="hill" pos="1 1 1"/></worldbody>')
    np.testing.assert_allclose(scene.object("hill").bounds_m, [[-2, -1, 1], [4, 3, 6]], atol=1e-9)
    vertices = scene.object("hill").geometry.mesh.vertices_m
    # The elevations of a file begin at its upper row, which MuJoCo puts at the far end of y.
    model, _ = load(f'<mujoco>{asset}<worldbody><geom type="hfield" hfield="hill"/></worldbody></mujoco>')
    peak = divmod(int(model.hfield_data.argmax()), 3)
    expected = [-3.0 + 3.0 * peak[1], -2.0 + 4.0 * peak[0], 5.0]
    np.testing.assert_allclose(vertices[vertices[:, 2].argmax()], expected, atol=1e-9)


# -- planes ----------------------------------------------------------------------------------------------------------


def test_a_plane_is_a_sheet_without_thickness() -> None:
    floor = scene_of('<worldbody><geom name="floor" type="plane" size="3 2 1"/></worldbody>').object("floor")
    assert floor.size_m == pytest.approx((6, 4, 0))
    assert "zero-thickness" in floor.surface.flags
    assert floor.surface.pose.rotation[:, 2] == pytest.approx((0, 0, 1))


def test_a_plane_without_end_reaches_under_everything() -> None:
    scene = scene_of(
        '<worldbody><geom name="floor" type="plane" size="0 0 1"/>'
        '<body name="far" pos="30 0 1"><geom size="0.1"/></body><body name="near"><geom size="0.1"/></body></worldbody>'
    )
    low, high = scene.object("floor").bounds_m
    assert low[0] < -0.1
    assert high[0] > 30.1
    assert np.isfinite(scene.object("floor").geometry.mesh.vertices_m).all()


def test_things_on_a_plane_touch_it() -> None:
    scene = scene_of(
        '<worldbody><geom name="floor" type="plane" size="0 0 1"/>'
        '<body name="crate" pos="0 0 0.25"><geom type="box" size="0.25 0.25 0.25"/></body></worldbody>'
    )
    assert ContactGraph(scene).neighbours("crate") == ("floor",)


# -- what is an object, and what it is called ------------------------------------------------------------------------


def test_doors_and_knobs_are_objects_and_bodies_without_geoms_are_looked_through() -> None:
    scene = scene_of(
        '<worldbody><body name="room"><body name="cabinet"><geom size="1"/>'
        '<body name="door"><joint/><geom size="0.5"/><body name="knob"><geom size="0.1"/></body></body></body>'
        '<body name="shelf"><geom size="1"/></body></body></worldbody>'
    )
    assert names(scene) == {name: name for name in ("cabinet", "door", "knob", "shelf")}


def test_a_wrapper_lends_its_name_to_the_only_thing_in_it() -> None:
    scene = scene_of(
        '<worldbody><body name="microwave"><body name="microroot"><geom size="1"/>'
        '<body name="microdoor"><joint/><geom size="0.5"/></body></body></body>'
        '<body name="kitchen"><body name="table"><geom size="1"/></body></body>'
        '<body name="rail"><body name="slider"><joint/><geom size="1"/></body></body></worldbody>'
    )
    # Not of places, and not if the thing moves in its wrapper.
    assert names(scene) == {
        "microroot": "microwave", "microdoor": "microdoor", "table": "table", "slider": "slider"
    }  # fmt: skip


def test_what_has_no_name_is_told_by_where_it_is() -> None:
    xml = (
        '<asset><mesh name="wedge" file="wedge.obj"/></asset>'
        '<worldbody><geom type="plane" size="1 1 1"/><geom name="wall" type="box" size="1 1 1"/>'
        '<body><geom name="top" size="1"/><body/><body><geom size="1"/></body></body>'
        '<body name="cup"><geom size="1"/><body><geom type="mesh" mesh="wedge"/></body></body></worldbody>'
    )
    scene = scene_of(xml)
    assert names(scene) == {
        "world/body1": "top",
        "world/body1/body2": "world/body1/body2",
        "cup": "cup",
        "cup/body1": "wedge",
        "world/geom1": "world/geom1",
        "wall": "wall",
    }
    again = scene_of(xml)
    assert names(again) == names(scene)
    assert [item.geometry for item in again.objects] == [item.geometry for item in scene.objects]


def test_a_body_and_a_geom_of_one_name_are_told_apart() -> None:
    scene = scene_of('<worldbody><geom name="a" size="1"/><body name="a"><geom size="2"/></body></worldbody>')
    assert {item.id: round(item.bounds_m[1, 0]) for item in scene.objects} == {"a": 2, "a#2": 1}


def test_geoms_that_cannot_collide_are_the_looks_of_a_body() -> None:
    body = (
        '<worldbody><body name="drawer">'
        '<geom size="1" group="1" contype="0" conaffinity="0"/><geom size="2" group="4" contype="0" conaffinity="1"/>'
        '<geom size="3" group="2" contype="0" conaffinity="0" rgba="1 1 1 0"/></body>'
        '<body name="block"><geom size="2" group="4"/></body></worldbody>'
    )

    def radii(**options: Any) -> dict[str, int]:
        return {item.id: round(item.bounds_m[1, 0]) for item in scene_of(body, **options).objects}

    assert radii() == {"drawer": 1, "block": 2}
    assert radii(geom_groups={4}) == {"drawer": 2, "block": 2}
    assert radii(geom_groups=[1, 2]) == {"drawer": 3}
    with pytest.raises(SceneError, match="no geom is in geom_groups {0}"):
        radii(geom_groups=(0,))
    with pytest.raises(SceneError, match="geom_groups is 4; it must be a set of group numbers"):
        radii(geom_groups=4)


def test_of_the_worlds_geoms_hidden_walls_are_left_out() -> None:
    scene = scene_of(
        '<worldbody><geom name="floor" size="1"/><geom name="hidden" size="1" group="3"/>'
        '<geom name="poster" size="1" group="3" contype="0" conaffinity="0"/></worldbody>'
    )
    assert {item.id for item in scene.objects} == {"floor", "poster"}


def test_copies_share_a_mesh() -> None:
    thing = '<geom type="cylinder" size="0.1 0.2" pos="0 0 0.2"/><geom type="box" size="0.2 0.2 0.01"/>'
    scene = scene_of(
        f'<worldbody><body name="a" pos="1 2 3">{thing}</body><body name="b" euler="10 20 30">{thing}</body>'
        f'<body name="c"><geom type="box" size="0.2 0.2 0.01" rgba="1 0 0 1"/></body></worldbody>'
    )
    a, b, c = scene.objects
    assert a.geometry is b.geometry
    assert a.instance_key == b.instance_key != c.instance_key


# -- contacts --------------------------------------------------------------------------------------------------------

RESTING = (
    '<mujoco><worldbody><geom name="floor" type="plane" size="2 2 1"/>'
    '<body name="ball" pos="0.5 0 0.199"><freejoint/><geom size="0.2"/></body>'
    '<body name="still" pos="-1 0 0.2"><geom size="0.2"/></body></worldbody></mujoco>'
)


def test_the_engines_contacts_are_taken_when_asked_for() -> None:
    scene = snapshot(*load(RESTING), contacts="engine")
    assert scene.contacts is not None
    (contact,) = scene.contacts  # none of the body that cannot move
    assert (contact.a, contact.b) == ("floor", "ball")
    assert contact.point_m == pytest.approx((0.5, 0, 0), abs=1e-3)
    assert contact.normal == pytest.approx((0, 0, 1))
    assert ContactGraph(scene).neighbours("still") == ()
    scaled = snapshot(*load(RESTING), contacts="engine", unit_m=2.0)
    assert scaled.contacts is not None
    assert scaled.contacts[0].point_m == pytest.approx((1.0, 0, 0), abs=2e-3)


def test_contacts_are_found_from_geometry_otherwise() -> None:
    scene = snapshot(*load(RESTING))
    assert ContactGraph(scene).neighbours("floor") == ("ball", "still")


def test_contacts_of_what_is_not_drawn_are_left_out() -> None:
    hidden = RESTING.replace('type="plane"', 'type="plane" group="3"')
    assert snapshot(*load(hidden), contacts="engine").contacts == ()


# -- looks -----------------------------------------------------------------------------------------------------------


def png(pixels: list[list[tuple[int, int, int]]]) -> bytes:
    stream = io.BytesIO()
    Image.fromarray(np.array(pixels, dtype=np.uint8)).save(stream, "png")
    return stream.getvalue()


def test_colours_are_the_geoms_own_or_their_materials() -> None:
    scene = scene_of(
        '<asset><material name="red" rgba="2 0 0 1"/></asset><worldbody>'
        '<body name="a"><geom size="1" material="red"/>'
        '<geom size="1" pos="3 0 0" material="red" rgba="0 1 0 1"/></body>'
        '<body name="b"><geom size="1"/></body></worldbody>'
    )
    a, b = (item.appearance for item in scene.objects)
    assert a is not None
    assert b is not None
    assert [material.color_rgba for material in a.materials] == [(1, 0, 0, 1), (0, 1, 0, 1)]
    assert np.bincount(a.face_material).tolist() == [len(b.face_material)] * 2
    assert b.materials[0].color_rgba == (0.5, 0.5, 0.5, 1)


def test_a_texture_lies_on_a_mesh_as_its_file_says() -> None:
    quarters = [[(255, 0, 0), (0, 255, 0)], [(0, 0, 255), (255, 255, 255)]]
    scene = scene_of(
        '<asset><mesh name="wedge" file="wedge.obj"/><mesh name="other" file="wedge.obj" scale="-1 1 1"/>'
        '<texture name="t" type="2d" file="t.png"/>'
        '<material name="m" texture="t" rgba="1 0.5 1 1"/></asset><worldbody>'
        '<body name="a"><geom type="mesh" mesh="other" material="m"/>'
        '<geom type="mesh" mesh="wedge" material="m"/></body></worldbody>',
        {"t.png": png(quarters)},
    )
    look = scene.object("a").appearance
    assert look is not None
    assert look.uv is not None
    (material,) = look.materials
    assert material.color_rgba == (1, 0.5, 1, 1)
    assert material.texture is not None
    np.testing.assert_array_equal(material.texture, quarters)
    # In an OBJ file v goes up: (0.25, 0.75) is the upper left quarter, then upper right, then lower left.
    corners = {tuple(pair) for pair in look.uv.reshape(-1, 2).tolist()}
    assert corners == {(0.25, 0.25), (0.75, 0.25), (0.25, 0.75)}
    # The vertex at the file's origin is always a face's first corner: red.
    mesh = scene.object("a").geometry.mesh
    at_origin = np.isclose(mesh.vertices_m[mesh.faces], 0, atol=1e-6).all(axis=-1)
    assert at_origin.sum() == 6
    np.testing.assert_allclose(look.uv[at_origin], [(0.25, 0.25)] * 6)


def test_without_texture_coordinates_a_texture_is_its_mean_colour() -> None:
    halves = [[(255, 0, 0)] * 2, [(0, 0, 255)] * 2]
    scene = scene_of(
        '<asset><texture name="t" type="2d" file="t.png"/><material name="m" texture="t" rgba="1 1 0.5 1"/></asset>'
        '<worldbody><body name="a"><geom type="box" size="1 1 1" material="m"/></body></worldbody>',
        {"t.png": png(halves)},
    )
    look = scene.object("a").appearance
    assert look is not None
    assert look.uv is None
    assert look.materials[0].texture is None
    assert look.materials[0].color_rgba == pytest.approx((0.5, 0, 0.25, 1))


# -- what cannot be read ---------------------------------------------------------------------------------------------


def test_a_missing_engine_names_its_extra(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "mujoco", None)
    with pytest.raises(MissingExtra, match=r"pip install 'scene2hap\[mujoco\]'"):
        snapshot(None, None)


def test_wrong_arguments_are_told() -> None:
    model, data = load(RESTING)
    with pytest.raises(SceneError, match=r"model is a MjData and data a MjModel; they must be mujoco\.MjModel"):
        snapshot(data, model)
    with pytest.raises(SceneError, match="call mujoco.mj_forward"):
        snapshot(model, mujoco.MjData(model))
    with pytest.raises(SceneError, match="contacts is 'all'; it must be 'engine'"):
        snapshot(model, data, contacts="all")  # type: ignore[arg-type]
    with pytest.raises(SceneError, match="unit_m is 0 m; it must be above 0"):
        snapshot(model, data, unit_m=0)
    with pytest.raises(SceneError, match="the model has no geoms"):
        scene_of('<worldbody><body name="a"/></worldbody>')


def test_a_simulation_that_blew_up_is_told() -> None:
    model, data = load(RESTING)
    data.xpos[1] = np.nan
    with pytest.raises(SceneError, match="must be finite"):
        snapshot(model, data)
