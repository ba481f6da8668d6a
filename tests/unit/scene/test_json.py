"""Scenes as JSON: exact in both directions, each geometry stored once, and errors that name the field."""

from __future__ import annotations

import json
import re
import warnings
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from scene2hap.common.warning import SceneWarning
from scene2hap.errors import SceneError
from scene2hap.scene.copies import copy_key
from scene2hap.scene.objects import Contact, SceneObject
from scene2hap.scene.pose import Pose
from scene2hap.scene.shapes import Box, DominantSurface, TriMesh
from scene2hap.scene.snapshot import SceneSnapshot
from scenes import box, scene

lengths = st.floats(1e-6, 1e6)
coordinates = st.floats(-1e6, 1e6)
points = st.tuples(coordinates, coordinates, coordinates)
quaternions = st.tuples(*[st.floats(-1, 1)] * 4).filter(lambda q: sum(x * x for x in q) > 1e-6)
poses = st.builds(Pose, points, quaternions)
meshes = st.builds(
    lambda vertices, order: TriMesh(vertices, [order]),
    st.lists(points, min_size=3, max_size=6),
    st.permutations([0, 1, 2]),
)
geometries = st.one_of(st.builds(Box, st.tuples(lengths, lengths, lengths)), meshes)
# Thin enough for any geometry, since the reader compares a given thickness with the mesh.
surfaces = st.builds(
    lambda pose, length, width, share, flags: DominantSurface(
        pose, length, width, min(0.5, share * min(length, width)), flags
    ),
    poses,
    lengths,
    lengths,
    st.floats(0.01, 0.3),
    st.sets(st.sampled_from(["open-mesh", "zero-thickness"])).map(tuple),
)


@st.composite
def snapshots(draw: st.DrawFn) -> SceneSnapshot:
    ids = draw(st.lists(st.text(min_size=1), min_size=2, max_size=4, unique=True))
    shared = draw(geometries)
    objects = [
        SceneObject(
            id=name,
            name=draw(st.text()),
            pose=draw(poses),
            geometry=draw(st.one_of(st.just(shared), geometries)),
            surface=draw(surfaces),
            relative_height_m=draw(coordinates),
            instance_key=draw(st.text()),
        )
        for name in ids
    ]
    area = st.one_of(st.none(), st.floats(0, 1))
    contact = st.builds(
        Contact, st.just(ids[0]), st.just(ids[1]), points, st.one_of(st.none(), points), area, st.floats(0, 1)
    )
    contacts = draw(st.one_of(st.none(), st.lists(contact, max_size=2).map(tuple)))
    return SceneSnapshot(draw(st.text()), draw(st.sampled_from(["y", "z"])), tuple(objects), contacts)


@given(snapshots())
@settings(max_examples=60)
def test_a_round_trip_is_exact(snapshot: SceneSnapshot) -> None:
    assert SceneSnapshot.from_json(snapshot.to_json()) == snapshot


def test_a_byte_order_mark_before_the_text_is_no_fault() -> None:
    """`path.read_text()` keeps the mark with which C# and PowerShell begin a file."""
    before = scene(box("table", (1.0, 0.7, 0.6), (0.0, 0.35, 0.0)))
    assert SceneSnapshot.from_json("\ufeff" + before.to_json()) == before


def test_the_round_trip_keeps_every_bit_of_a_mesh() -> None:
    vertices = np.random.default_rng(7).normal(size=(30, 3)) / 3
    mesh = TriMesh(vertices, np.arange(30).reshape(10, 3))
    before = SceneSnapshot("s", "z", (replace(box("a", (1, 1, 1), (0, 0, 0)), geometry=mesh),))
    after = SceneSnapshot.from_json(before.to_json()).object("a").geometry
    assert isinstance(after, TriMesh)
    assert after.vertices_m.tobytes() == mesh.vertices_m.tobytes()
    assert after.vertices_m.dtype == np.float64
    assert not after.vertices_m.flags.writeable


def test_instances_share_one_geometry_row() -> None:
    document = json.loads(scene(box("a", (1, 1, 1), (0, 0, 0)), box("b", (1, 1, 1), (5, 0, 0))).to_json())
    assert len(document["geometries"]) == 1
    assert document["objects"][0]["geometry"] == document["objects"][1]["geometry"]
    again = SceneSnapshot.from_json(json.dumps(document))
    assert again.object("a").geometry is again.object("b").geometry


def test_objects_of_equal_mesh_are_copies_as_in_python() -> None:
    mug = (0.08, 0.1, 0.08)
    objects = [box("mug 1", mug, (0, 0, 0)), box("mug 2", mug, (1, 0, 0)), box("pan", (0.3, 0.1, 0.3), (2, 0, 0))]
    document = json.loads(scene(*objects).to_json())
    for row in document["objects"]:
        del row["instance_key"]
    found = SceneSnapshot.from_json(json.dumps(document))
    built = SceneSnapshot.build(objects)
    assert [item.instance_key for item in found.objects] == [item.instance_key for item in built.objects]
    assert copy_key(found.objects[0]) == copy_key(found.objects[1]) != copy_key(found.objects[2])


def test_object_can_contain_its_geometry() -> None:
    document = json.loads(scene(box("a", (1, 2, 3), (0, 0, 0))).to_json())
    del document["geometries"]
    document["objects"][0]["geometry"] = {"kind": "box", "size_m": [1, 2, 3]}
    assert SceneSnapshot.from_json(json.dumps(document)).object("a").geometry == Box((1.0, 2.0, 3.0))


@pytest.mark.parametrize(
    ("geometry", "sentence"),
    [
        ({"kind": "mesh", "vertices_m": [[0, 0, 0]] * 4, "faces": [[0, 1, 2, 3]]}, ": faces has shape (1, 4)"),
        ({"kind": "mesh", "vertices_m": [0, 0, 0], "faces": [0, 0, 0]}, ": vertices_m has shape (3,)"),
        ({"vertices_m": [[0, 0, 0]] * 3}, ".faces: it is missing"),
        ({"kind": "box", "size_m": [1, 0, 1]}, ": size_m[1] is 0 m"),
        ({"kind": "sphere", "radius_m": 1}, ".kind is 'sphere'; it must be 'box' or 'mesh'"),
        ([1, 1, 1], " is [1, 1, 1]; it must be a box or a mesh"),
    ],
)
def test_errors_of_a_geometry_are_those_of_its_kind(geometry: object, sentence: str) -> None:
    """Errors of a mesh once said that `Box.size_m` is missing."""
    own, shared = _document(), _document()
    own["objects"][0]["geometry"] = geometry
    shared["objects"][0]["geometry"], shared["geometries"]["desk"] = "desk", geometry
    for document, place in ((own, "objects.0.geometry"), (shared, "geometries.desk")):
        with pytest.raises(SceneError, match=re.escape(f"scene field {place}{sentence}")):
            SceneSnapshot.from_json(json.dumps(document))


@pytest.mark.parametrize("where", ["object", "pose"])
def test_a_scale_is_ignored_with_a_warning(where: str) -> None:
    document = _document()
    row = document["objects"][0]
    (row if where == "object" else row["pose"])["scale"] = [1, 1, 1]
    SceneSnapshot.from_json(json.dumps(document))
    (row if where == "object" else row["pose"])["scale"] = [1, 2, 1]
    with pytest.warns(SceneWarning, match=r"'scale', \[1, 2, 1\], is ignored: .* Multiply size_m or vertices_m by it"):
        SceneSnapshot.from_json(json.dumps(document))


def test_optional_fields_have_defaults() -> None:
    """The minimum that an engine must write: name, axis, and objects with pose, geometry and surface."""
    surface = {"pose": {}, "length_m": 1, "width_m": 1, "thickness_m": 0.1}
    row = {"id": "a", "name": "a", "pose": {}, "geometry": {"kind": "box", "size_m": [1, 1, 1]}, "surface": surface}
    text = json.dumps({"format": "scene2hap/scene", "version": 1, "name": "s", "up_axis": "y", "objects": [row]})
    item = SceneSnapshot.from_json(text).object("a")
    assert item.pose == Pose()
    assert item.surface.flags == ()


def _document() -> dict[str, Any]:
    document: dict[str, Any] = json.loads(
        scene(box("a", (1, 1, 1), (0, 0, 0)), box("b", (2, 1, 1), (5, 0, 0))).to_json()
    )
    return document


@pytest.mark.parametrize(
    ("path", "value", "sentence"),
    [
        (("format",), "other", '"format": "scene2hap/scene"'),
        (("version",), 2, "version is 2; this scene2hap reads version 1"),
        (("version",), True, "version is True; this scene2hap reads version 1"),
        (("up_axis",), "x", "scene field up_axis"),
        (("objects",), [], "no object with a surface"),
        (("objects", 0, "id"), "b", "id 'b' is used more than once"),
        (("objects", 0, "pose", "position_m"), [0, "high", 0], r"scene field objects\.0\.pose"),
        (("objects", 0, "pose", "rotation_xyzw"), [0, 0, 0, 0], "length 0"),
        (("objects", 0, "surface", "length_m"), -1, "length_m is -1 m"),
        (("objects", 0, "surface", "flags"), ["odd"], "scene field objects.0.surface.flags.0"),
        (("objects", 0, "geometry"), "mesh-none", "object 'a' names geometry 'mesh-none'"),
        (("objects", 0, "geometry"), 5, "scene field objects.0.geometry"),
        (("geometries",), [], "geometries must be an object"),
        (("contacts",), [{"a": "a", "b": "c", "point_m": [0, 0, 0]}], "no object 'c'"),
        (("objects", 0, "mass_kg"), True, r"objects\.0\.mass_kg: it must be a number, as 0\.5\."),
        (("objects", 0, "relative_height_m"), "1", r"objects\.0\.relative_height_m: it must be a number"),
        (("objects", 0, "pose", "position_m"), [0, True, 0], r"position_m\.1: it must be a number"),
        (("objects", 0, "pose", "rotation_xyzw"), [0, 0, 0, "1"], r"rotation_xyzw\.3: it must be a number"),
        (("objects", 0, "surface", "length_m"), "1", r"surface\.length_m: it must be a number"),
        (("objects", 0, "surface", "outline"), {"rings_m": [[[0, 0], [1, 0], ["1", 1]]]}, "it must be a number"),
        (("objects", 0, "surface", "outline"), {"rings_m": [[[0, 0], [True, 0], [1, 1]]]}, "it must be a number"),
        (("objects", 0, "geometry"), {"size_m": [1, True, 1]}, r"geometry\.size_m\.1: it must be a number"),
        (("objects", 0, "hinge"), {"to": "b", "point_m": [0, 0, "0"], "other_point_m": [0, 0, 0]}, "must be a number"),
        (("contacts",), [{"a": "a", "b": "b", "point_m": [0, 0, 0], "weight": True}], "weight: it must be a number"),
    ],
)
def test_error_names_the_invalid_field(path: tuple[str | int, ...], value: object, sentence: str) -> None:
    document: Any = _document()
    place = document
    for step in path[:-1]:
        place = place[step]
    place[path[-1]] = value
    with pytest.raises(SceneError, match=sentence):
        SceneSnapshot.from_json(json.dumps(document))


@pytest.mark.parametrize("field", ["name", "up_axis", "objects"])
def test_error_names_the_missing_field(field: str) -> None:
    document = _document()
    del document[field]
    with pytest.raises(SceneError, match=f"scene field {field}"):
        SceneSnapshot.from_json(json.dumps(document))


@pytest.mark.parametrize("text", ["", "{", "[" * 100_000, "[]", "7", '"scene"', "null"])
def test_text_that_is_not_a_scene_is_refused(text: str) -> None:
    with pytest.raises(SceneError, match="not JSON|not a scene"):
        SceneSnapshot.from_json(text)


@pytest.mark.parametrize(
    ("place", "missing", "written", "near"),
    [
        ("object", "mass_kg", "mass", "of an object is ignored. Did you mean 'mass_kg'"),
        ("pose", "rotation_xyzw", "rotation_xyxw", "of a pose is ignored. Did you mean 'rotation_xyzw'"),
        ("scene", "contacts", "contact", "of the scene is ignored. Did you mean 'contacts'"),
    ],
)
def test_misspelt_optional_field_brings_a_warning(place: str, missing: str, written: str, near: str) -> None:
    document = json.loads(scene(box("cup", (0.1, 0.1, 0.1), (0, 0, 0))).to_json())
    row = {"scene": document, "object": document["objects"][0], "pose": document["objects"][0]["pose"]}[place]
    row[written] = row.pop(missing, None)
    with pytest.warns(SceneWarning, match=near) as told:
        SceneSnapshot.from_json(json.dumps(document))
    assert len(told) == 1
    assert told[0].filename == __file__


def test_own_fields_bring_no_warning() -> None:
    document = json.loads(scene(box("cup", (0.1, 0.1, 0.1), (0, 0, 0))).to_json())
    document["objects"][0] |= {"unity_guid": 7, "layer": "Default", "name_de": "Tasse", "mass_kg": 0.2, "mass": 0.2}
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        SceneSnapshot.from_json(json.dumps(document))
