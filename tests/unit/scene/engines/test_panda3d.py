"""Panda3D scene graphs as snapshots, against Panda3D's bounds and transforms."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from scene2hap import ContactGraph, SceneObject
from scene2hap.common.warning import SceneWarning
from scene2hap.errors import MissingExtra, SceneError
from scene2hap.scene.engines.panda3d import PoseReader, snapshot
from scene2hap.scene.plausibility.units import UnitWarning

core = pytest.importorskip("panda3d.core", reason="needs the extra panda3d")

QUADS = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
CORNERS = [(x, y, z) for x in (0.0, 1.0) for y in (0.0, 1.0) for z in (0.0, 1.0)]


def geom(
    vertices: Sequence[Sequence[float]] = CORNERS, primitive: Any = None, layout: Any = None, **columns: Any
) -> Any:
    """A geom with vertices and other columns (`texcoord=[...]`); by default a unit cube."""
    names = {"texcoord": "v3t2", "color": "v3c4"}
    layout = layout or getattr(core.GeomVertexFormat, f"get_{names[next(iter(columns))] if columns else 'v3'}")()
    data = core.GeomVertexData("data", layout, core.Geom.UH_static)
    data.set_num_rows(len(vertices))
    for name, rows in {"vertex": vertices, **columns}.items():
        writer = core.GeomVertexWriter(data, name)
        for row in rows:
            getattr(writer, f"set_data{len(row)}")(*row)
    if primitive is None:
        primitive = core.GeomTriangles(core.Geom.UH_static)
        for a, b, c, d in QUADS:
            primitive.add_vertices(a, b, c)
            primitive.add_vertices(a, c, d)
    made = core.Geom(data)
    made.add_primitive(primitive)
    return made


def attach(parent: Any, name: str, *geoms: Any) -> Any:
    node = core.GeomNode(name)
    for one in geoms or (geom(),):
        node.add_geom(one)
    return parent.attach_new_node(node)


def graph() -> Any:
    """A table of two pieces in centimetres, its mirror image, and two instances of a non-uniformly scaled cup."""
    render = core.NodePath("render")
    table = render.attach_new_node("table")
    table.set_pos_hpr_scale((1, 2, 0.1), (30, 0, 0), 0.01)
    attach(table, "table_top").set_scale(120, 80, 4)
    leg = attach(table, "table_leg")
    leg.set_pos_hpr_scale((5, 5, -70), (45, 0, 0), (6, 6, 70))
    mirror = table.copy_to(render)
    mirror.set_name("table mirrored")
    mirror.set_pos_hpr_scale((-3, 0, 0), (0, 20, 40), (-0.01, 0.01, 0.01))
    for child, name in zip(mirror.get_children(), ("table mirrored top", "table mirrored leg"), strict=True):
        child.set_name(name)
    cup = attach(render, "cup")
    cup.set_pos_hpr_scale((5, 0, 0), (10, 20, 30), (0.05, 0.08, 0.12))
    holder = render.attach_new_node("holder")
    holder.set_pos(0, 4, 0)
    cup.instance_to(holder)
    return render


def tight_bounds(path: Any, top: Any) -> NDArray[np.float64]:
    return np.array([tuple(corner) for corner in path.get_tight_bounds(top)])


def volume(item: SceneObject) -> float:
    mesh = item.geometry.mesh
    a, b, c = np.moveaxis(mesh.vertices_m[mesh.faces], 1, 0)
    return float(np.einsum("ij,ij->", a, np.cross(b, c)) / 6)


# -- geometry and places ---------------------------------------------------------------------------------------------


def test_objects_have_the_place_that_panda3d_gives() -> None:
    render = graph()
    scene = snapshot(render)
    assert (scene.name, scene.up_axis, scene.contacts) == ("render", "z", None)
    ids = {"table": "table", "table mirrored": "table mirrored", "cup": "cup", "holder": "holder"}
    assert {item.id: item.name for item in scene.objects} == ids
    for item in scene.objects:
        expected = tight_bounds(render.find(f"**/{item.id}"), render)
        np.testing.assert_allclose(item.bounds_m, expected, atol=1e-5)


def test_meshes_contain_scale_and_mirroring_and_face_outwards() -> None:
    scene = snapshot(graph())
    table = 1.2 * 0.8 * 0.04 + 0.06 * 0.06 * 0.7
    volumes = {item.id: volume(item) for item in scene.objects}
    assert volumes == pytest.approx(
        {"table": table, "table mirrored": table, "cup": 0.05 * 0.08 * 0.12, "holder": 0.05 * 0.08 * 0.12}, rel=1e-5
    )


def test_instances_share_a_mesh() -> None:
    scene = snapshot(graph())
    cup, other = scene.object("cup"), scene.object("holder")
    assert cup.geometry is other.geometry
    assert cup.instance_key == other.instance_key
    np.testing.assert_allclose(np.subtract(other.pose.position_m, cup.pose.position_m), (0, 4, 0), atol=1e-6)


def test_subgraph_has_the_coordinates_of_the_whole_graph() -> None:
    render = graph()
    part = snapshot(render.find("holder"))
    assert [item.id for item in part.objects] == ["holder"]
    np.testing.assert_allclose(part.objects[0].bounds_m, snapshot(render).object("holder").bounds_m, atol=1e-6)


def test_the_grouping_rule_is_that_of_the_loaders() -> None:
    render = graph()
    leaves = {item.id for item in snapshot(render, group="leaf").objects}
    assert leaves == {"table_top", "table_leg", "table mirrored top", "table mirrored leg", "cup", "cup#2"}
    by_hand = snapshot(render, group={"table": "furniture", "holder": "cup 2"})
    assert {item.id for item in by_hand.objects} == {"furniture", "cup 2", "table mirrored", "cup"}
    with pytest.raises(SceneError, match="group maps the node 'chair'"):
        snapshot(render, group={"chair": "chair"})


def test_stacked_objects_touch() -> None:
    render = core.NodePath("render")
    attach(render, "crate")
    attach(render, "box").set_pos(0.2, 0.2, 1)
    assert ContactGraph(snapshot(render)).neighbours("box") == ("crate",)


def test_every_kind_of_triangles_is_read_and_nothing_else() -> None:
    render = core.NodePath("render")
    square = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 0)]
    strip = core.GeomTristrips(core.Geom.UH_static)
    strip.add_consecutive_vertices(0, 4)
    strip.close_primitive()
    fan = core.GeomTrifans(core.Geom.UH_static)
    for corner in (0, 1, 3, 2):
        fan.add_vertex(corner)
    fan.close_primitive()
    loose = core.GeomTriangles(core.Geom.UH_static)
    loose.set_nonindexed_vertices(0, 3)
    wide = core.GeomTriangles(core.Geom.UH_static)
    wide.set_index_type(core.Geom.NT_uint32)
    wide.add_vertices(0, 1, 3)
    lines = core.GeomLines(core.Geom.UH_static)
    lines.add_vertices(0, 3)
    for name, primitive in {"strip": strip, "fan": fan, "loose": loose, "wide": wide, "lines": lines}.items():
        attach(render, name, geom(square, primitive))
    scene = snapshot(render)
    assert {item.id: len(item.geometry.mesh.faces) for item in scene.objects} == {
        "strip": 2, "fan": 2, "loose": 1, "wide": 1
    }  # fmt: skip
    for item in scene.objects:
        mesh = item.geometry.mesh
        a, b, c = np.moveaxis(mesh.vertices_m[mesh.faces], 1, 0)
        np.testing.assert_allclose(np.cross(b - a, c - a), [[0, 0, 1]] * len(mesh.faces))


def test_packed_and_wide_vertices_are_read() -> None:
    array = core.GeomVertexArrayFormat()
    array.add_column("color", 4, core.Geom.NT_uint8, core.Geom.C_color)
    array.add_column("vertex", 3, core.Geom.NT_float64, core.Geom.C_point)
    render = core.NodePath("render")
    attach(render, "cube", geom(layout=core.GeomVertexFormat.register_format(array)))
    np.testing.assert_allclose(snapshot(render).object("cube").bounds_m, [[0, 0, 0], [1, 1, 1]])


def test_hidden_nodes_and_coarser_levels_are_left_out() -> None:
    render = core.NodePath("render")
    attach(render, "seen")
    attach(render, "hidden").hide()
    attach(render, "stashed").stash()
    lod = core.LODNode("lamp")
    for far, near in ((1000, 100), (10, 0), (100, 10)):
        lod.add_switch(far, near)
    levels = render.attach_new_node(lod)
    for name, size in (("far", 3.0), ("near", 1.0), ("middle", 2.0)):
        attach(levels, f"lamp_{name}").set_scale(size)
    scene = snapshot(render)
    assert {item.id for item in scene.objects} == {"seen", "lamp"}
    np.testing.assert_allclose(scene.object("lamp").bounds_m[1], (1, 1, 1), atol=1e-6)


def test_nodes_of_scale_0_are_left_out_and_followed_all_the_same() -> None:
    """Games hide things so. A session that was baked while the thing was shown still follows it."""
    render = core.NodePath("render")
    attach(render, "table")
    fan = render.attach_new_node("fan")
    attach(fan, "fan_blade").set_x(2.0)
    assert {item.id for item in snapshot(render).objects} == {"table", "fan"}
    fan.set_scale(0.0)
    with pytest.warns(SceneWarning, match=r"is read without 1 node .*: 'fan'\."):
        assert [item.id for item in snapshot(render).objects] == ["table"]
    assert set(PoseReader(render).read()) == {"table", "fan"}


def test_what_hangs_below_the_camera_keeps_its_own_name() -> None:
    render = core.NodePath("render")
    camera = render.attach_new_node("camera")
    camera.attach_new_node(core.Camera("cam"))
    attach(camera, "drill")
    attach(render.attach_new_node("camera"), "body")  # a thing on a shelf
    assert [item.id for item in snapshot(render).objects] == ["drill", "camera"]


def centimetres() -> Any:
    """A table 120 cm wide and 72 cm high, and a refrigerator 180 cm high that is scaled and mirrored."""
    render = core.NodePath("render")
    places = {"table": ((0, 0, 0), (120, 70, 72)), "refrigerator": ((200, 50, 0), (-60, 60, 180))}
    for name, (place, size) in places.items():
        path = attach(render, name)
        path.set_pos(*place)
        path.set_scale(*size)
    return render


def test_a_graph_in_centimetres_is_told_and_read_in_metres() -> None:
    render = centimetres()
    with pytest.warns(UnitWarning, match=r"unit_m=0\.01 \(metres per unit of the engine, centimetres\)"):
        snapshot(render)
    scene = snapshot(render, unit_m=0.01)
    np.testing.assert_allclose(scene.object("table").bounds_m, [(0, 0, 0), (1.2, 0.7, 0.72)], atol=1e-6)
    np.testing.assert_allclose(scene.object("refrigerator").bounds_m, [(1.4, 0.5, 0), (2, 1.1, 1.8)], atol=1e-6)
    render.find("table").set_x(50)
    now = PoseReader(render, unit_m=0.01).read()
    assert now["table"].position_m == pytest.approx((0.5, 0, 0))
    assert now["refrigerator"].position_m == pytest.approx((2, 0.5, 0))


@pytest.mark.parametrize("unit_m", [0, -1.0, "cm"])
def test_a_unit_that_is_no_length_is_refused(unit_m: Any) -> None:
    with pytest.raises(SceneError, match="unit_m"):
        snapshot(graph(), unit_m=unit_m)


@pytest.mark.parametrize(("system", "axis"), [("y-up-left", "y"), ("y-up", "y"), ("z-up-left", "z"), ("z-up", "z")])
def test_up_axis_is_that_of_the_engine(system: str, axis: str) -> None:
    page = core.load_prc_file_data("", f"coordinate-system {system}")
    try:
        assert snapshot(graph()).up_axis == axis
        assert snapshot(graph(), up_axis="z").up_axis == "z"
    finally:
        core.unload_prc_file(page)


def test_loaded_model_is_named_after_its_file() -> None:
    render = core.NodePath("render")
    model = render.attach_new_node(core.ModelRoot("reading lamp.egg.pz"))
    attach(model, "Cube.001")
    assert [item.id for item in snapshot(render).objects] == ["reading lamp"]


# -- poses -----------------------------------------------------------------------------------------------------------


def test_poses_at_rest_equal_those_of_the_snapshot() -> None:
    render = graph()
    scene = snapshot(render)
    assert PoseReader(render).read() == {item.id: item.pose for item in scene.objects}


@pytest.mark.parametrize("moved", ["table", "table mirrored", "holder", "cup"])
def test_poses_follow_the_nodes(moved: str) -> None:
    render = graph()
    scene, reader = snapshot(render), PoseReader(render)
    path = render.find(moved)
    path.set_pos(path.get_pos() + core.LVector3(0.5, -1, 2))
    path.set_hpr(path.get_hpr() + core.LVector3(70, 10, -20))
    now = reader.read()
    # The cup's node is also a child of the holder, in its frame.
    followers = {"cup": {"cup", "holder"}}.get(moved, {moved})
    assert {key for key in now if now[key] != scene.object(key).pose} == followers
    for key in followers:
        mesh = scene.object(key).geometry.mesh
        points = now[key].to_world(mesh.vertices_m)
        expected = tight_bounds(render.find(key), render)
        np.testing.assert_allclose([points.min(axis=0), points.max(axis=0)], expected, atol=1e-5)


def test_inner_node_of_a_wrapper_is_followed() -> None:
    render = graph()
    reader = PoseReader(render)
    render.find("holder").get_child(0).set_z(1.0)
    assert reader.read()["holder"].position_m[2] == pytest.approx(1.0)


def test_nodes_of_ray_hits_belong_to_their_objects() -> None:
    """A table in an entity, with a cup below it; two crates of one name, one of them at the origin; and no objects."""
    render = core.NodePath("render")
    entities = {}
    for key, name, above in (("t", "table", None), ("c", "cup", "t"), ("k", "crate", None), ("l", "crate", None)):
        entity = entities[key] = entities.get(above, render).attach_new_node(name)
        attach(entity.attach_new_node("cube"), "mesh_geom")
    entities["l"].set_x(3)
    entities["c"].set_pos(0.2, 0.2, 1)
    expected = {"t": "table", "c": "cup", "k": "crate", "l": "crate#2"}
    reader = PoseReader(render)
    assert reader.read().keys() == set(expected.values())
    for key, object_id in expected.items():
        collider = entities[key].attach_new_node(core.CollisionNode("collider"))  # also after the graph was read
        drawn = entities[key].find("cube/mesh_geom")
        for node in (entities[key], collider, collider.node(), drawn, drawn.get_parent(), drawn.node()):
            assert reader.object_id(node) == object_id
    assert reader.object_id(render.attach_new_node(core.CollisionNode("trigger zone"))) is None
    assert reader.object_id(core.NodePath()) is None
    for wrong in ("table", None):
        with pytest.raises(SceneError, match="must be a NodePath or a PandaNode"):
            reader.object_id(wrong)


def test_instances_are_told_apart_by_their_paths() -> None:
    render = graph()
    reader = PoseReader(render)
    assert reader.object_id(render.find("cup")) == "cup"
    assert reader.object_id(render.find("holder").get_child(0)) == "holder"
    assert reader.object_id(render.find("table/table_leg")) == "table"


def test_removed_node_has_no_pose() -> None:
    render = graph()
    reader = PoseReader(render)
    render.find("table").remove_node()
    assert reader.read().keys() == {"table mirrored", "cup", "holder"}


# -- looks -----------------------------------------------------------------------------------------------------------


def picture() -> Any:
    """A texture: red and green above, blue and white below."""
    image = core.PNMImage(2, 2)
    for x, y, colour in [(0, 0, (1, 0, 0)), (1, 0, (0, 1, 0)), (0, 1, (0, 0, 1)), (1, 1, (1, 1, 1))]:
        image.set_xel(x, y, *colour)
    texture = core.Texture("quarters")
    texture.load(image)
    return texture


def test_texture_coordinates_follow_those_of_panda3d() -> None:
    render = core.NodePath("render")
    card = core.CardMaker("card")
    card.set_frame(0, 1, 0, 1)
    for name, scale in (("card", 1), ("mirror", -1)):
        path = render.attach_new_node(card.generate())
        path.set_name(name)
        path.set_texture(picture())
        path.set_sx(scale)
    for item in snapshot(render).objects:
        look = item.appearance
        assert look is not None
        assert look.uv is not None
        texture = look.materials[0].texture
        assert texture is not None
        np.testing.assert_array_equal(texture, [[(255, 0, 0), (0, 255, 0)], [(0, 0, 255), (255, 255, 255)]])
        # A card shows its picture upright: the upper left corner, at x = 0 and z = 1, has (0, 0).
        mesh = item.geometry.mesh
        corners = item.pose.to_world(mesh.vertices_m)[mesh.faces].reshape(-1, 3)
        expected = np.stack((np.abs(corners[:, 0]), 1 - corners[:, 2]), axis=1)
        np.testing.assert_allclose(look.uv.reshape(-1, 2), expected, atol=1e-6)


def test_colours_come_from_states_materials_and_vertices() -> None:
    render = core.NodePath("render")
    half = [(1.0, 0.0, 0.0, 1.0)] * 4 + [(0.0, 0.0, 1.0, 1.0)] * 4
    attach(render, "vertices", geom(color=half))
    attach(render, "plain")
    attach(render, "flat", geom(color=half)).set_color(0, 1, 0, 1)
    material = core.Material()
    material.set_diffuse((0.25, 0.5, 0.75, 1))
    attach(render, "material").set_material(material)
    attach(render, "dimmed").set_color_scale(0.5, 0.5, 0.5, 1)
    found = {item.id: item.appearance.materials[0].color_rgba for item in snapshot(render).objects if item.appearance}
    expected = {
        "vertices": (0.5, 0, 0.5, 1),
        "plain": (1, 1, 1, 1),
        "flat": (0, 1, 0, 1),
        "material": (0.25, 0.5, 0.75, 1),
        "dimmed": (0.5, 0.5, 0.5, 1),
    }
    assert found.keys() == expected.keys()
    for key, colour in found.items():
        np.testing.assert_allclose(colour, expected[key], atol=2 / 255)


# -- errors ----------------------------------------------------------------------------------------------------------


def test_missing_panda3d_error_names_its_extra(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "panda3d.core", None)
    with pytest.raises(MissingExtra, match=r"pip install 'scene2hap\[panda3d\]'"):
        snapshot(None)


def test_wrong_arguments_are_refused() -> None:
    with pytest.raises(SceneError, match="it must be a panda3d.core.NodePath"):
        snapshot("render")
    with pytest.raises(SceneError, match="it must be a panda3d.core.NodePath with a node"):
        snapshot(core.NodePath())
    with pytest.raises(SceneError, match="'render' draws no triangles"):
        snapshot(core.NodePath("render"))
    with pytest.raises(SceneError, match="up_axis is 'x'"):
        snapshot(graph(), up_axis="x")


def test_error_names_broken_vertices() -> None:
    render = core.NodePath("render")
    attach(render, "dust", geom([(float("nan"), 0, 0), *CORNERS[1:]]))
    with pytest.raises(SceneError, match="node 'dust', geom 0: vertex 0 is"):
        snapshot(render)
