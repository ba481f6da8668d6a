"""MuJoCo models as snapshots, against MuJoCo's values: places, planes and contacts."""

from __future__ import annotations

import sys
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from mujoco_scenes import RESTING, load, mujoco, scene_of
from scene2hap import ContactGraph
from scene2hap.errors import MissingExtra, SceneError
from scene2hap.scene.engines.mujoco import poses, snapshot
from scene2hap.scene.plausibility.units import UnitWarning

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


def geom_bounds(model: Any, data: Any, geom: int) -> NDArray[np.float64]:
    """World bounds (2, 3) of a geom, from MuJoCo's pose and the support function of its shape."""
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


def test_every_shape_has_the_place_that_mujoco_gives() -> None:
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
    # The file has a tetrahedron of 1 x 2 x 3 / 6 = 1; the scales give 0.1^3 and 0.1 x 0.1 x 0.2.
    assert np.einsum("ij,ij->", a, np.cross(b, c)) / 6 == pytest.approx(0.001 + 0.002, rel=1e-6)


def test_poses_equal_those_of_bodies_and_world_geoms() -> None:
    model, data = load(ALL_SHAPES)
    scene = snapshot(model, data)
    for item in scene.objects:
        if item.id in ("floor", "pillar"):
            continue
        assert item.pose.position_m == tuple(data.body(item.id).xpos)
        w, x, y, z = data.body(item.id).xquat
        np.testing.assert_allclose(item.pose.rotation_xyzw, (x, y, z, w), atol=1e-9)
    # Compiling moves a mesh into its frame of inertia, but the pose is pos="2 1 0" of the file; scaled refpos is kept.
    assert scene.object("pillar").pose.position_m == pytest.approx((2, 1, 0), abs=1e-6)
    corner = scene.object("pillar").geometry.mesh.bounds_m[0]
    assert corner == pytest.approx((-0.03, 0, 0), abs=1e-6)


def test_poses_after_steps_equal_a_new_snapshot() -> None:
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


def test_a_model_in_centimetres_is_told() -> None:
    box = '<body name="{}" pos="{}"><geom type="box" size="{}"/></body>'
    things = box.format("refrigerator", "0 0 90", "30 30 90") + box.format("table", "200 0 36", "60 35 36")
    model, data = load(f"<mujoco><worldbody>{things}</worldbody></mujoco>")
    with pytest.warns(UnitWarning, match=r"unit_m=0\.01 \(metres per unit of the engine, centimetres\)"):
        snapshot(model, data)
    np.testing.assert_allclose(
        np.ptp(snapshot(model, data, unit_m=0.01).object("table").bounds_m, axis=0), (1.2, 0.7, 0.72)
    )


def test_a_height_field_is_a_terrain() -> None:
    asset = '<asset><hfield name="hill" nrow="2" ncol="3" size="3 2 5 1" elevation="0 0 0  0 0 1"/></asset>'
    scene = scene_of(f'{asset}<worldbody><geom name="hill" type="hfield" hfield="hill" pos="1 1 1"/></worldbody>')
    np.testing.assert_allclose(scene.object("hill").bounds_m, [[-2, -1, 1], [4, 3, 6]], atol=1e-9)
    vertices = scene.object("hill").geometry.mesh.vertices_m
    # The elevations of a file begin with the upper row, which MuJoCo puts at the largest y.
    model, _ = load(f'<mujoco>{asset}<worldbody><geom type="hfield" hfield="hill"/></worldbody></mujoco>')
    peak = divmod(int(model.hfield_data.argmax()), 3)
    expected = [-3.0 + 3.0 * peak[1], -2.0 + 4.0 * peak[0], 5.0]
    np.testing.assert_allclose(vertices[vertices[:, 2].argmax()], expected, atol=1e-9)


def test_a_plane_is_a_sheet_without_thickness() -> None:
    floor = scene_of('<worldbody><geom name="floor" type="plane" size="3 2 1"/></worldbody>').object("floor")
    assert floor.size_m == pytest.approx((6, 4, 0))
    assert "zero-thickness" in floor.surface.flags
    assert floor.surface.pose.rotation[:, 2] == pytest.approx((0, 0, 1))


def test_infinite_plane_extends_below_all_objects() -> None:
    scene = scene_of(
        '<worldbody><geom name="floor" type="plane" size="0 0 1"/>'
        '<body name="far" pos="30 0 1"><geom size="0.1"/></body><body name="near"><geom size="0.1"/></body></worldbody>'
    )
    low, high = scene.object("floor").bounds_m
    assert low[0] < -0.1
    assert high[0] > 30.1
    assert np.isfinite(scene.object("floor").geometry.mesh.vertices_m).all()


def test_objects_on_a_plane_touch_it() -> None:
    scene = scene_of(
        '<worldbody><geom name="floor" type="plane" size="0 0 1"/>'
        '<body name="crate" pos="0 0 0.25"><geom type="box" size="0.25 0.25 0.25"/></body></worldbody>'
    )
    assert ContactGraph(scene).neighbours("crate") == ("floor",)


def test_engine_contacts_are_used_on_request() -> None:
    scene = snapshot(*load(RESTING), contacts="engine")
    assert scene.contacts is not None
    (contact,) = scene.contacts  # none for the body that cannot move
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


def test_contacts_of_hidden_geoms_are_left_out() -> None:
    hidden = RESTING.replace('type="plane"', 'type="plane" group="3"')
    assert snapshot(*load(hidden), contacts="engine").contacts == ()


def test_missing_mujoco_error_names_its_extra(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "mujoco", None)
    with pytest.raises(MissingExtra, match=r"pip install 'scene2hap\[mujoco\]'"):
        snapshot(None, None)


def test_wrong_arguments_are_refused() -> None:
    model, data = load(RESTING)
    with pytest.raises(
        SceneError, match=r"model is a MjData and data a MjModel; they must be mujoco\.MjModel.*env\.unwrapped"
    ):
        snapshot(data, model)
    with pytest.raises(SceneError, match="call mujoco.mj_forward"):
        snapshot(model, mujoco.MjData(model))
    with pytest.raises(SceneError, match="contacts is 'all'; it must be 'engine'"):
        snapshot(model, data, contacts="all")
    with pytest.raises(SceneError, match="unit_m is 0 m; it must be above 0"):
        snapshot(model, data, unit_m=0)
    with pytest.raises(SceneError, match="the model has no geoms"):
        scene_of('<worldbody><body name="a"/></worldbody>')


def test_diverged_simulation_is_refused() -> None:
    model, data = load(RESTING)
    data.xpos[1] = np.nan
    with pytest.raises(SceneError, match="must be finite"):
        snapshot(model, data)
