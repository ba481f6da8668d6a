"""One room, written as text in four formats and as JSON, gives the same objects, descriptions and gains from each.

The objects are unit solids under matrices, with copies, a mirrored wedge, an object of two parts, and names with spaces
and in other scripts. Nothing of the library writes the files.
"""

from __future__ import annotations

import base64
import json
import math
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from scene2hap import HapticSession, SceneObject, SceneSnapshot, Touch, load_scene
from scene2hap.scene.copies import copy_key, material_names
from with_tones import with_tones

Matrix = NDArray[np.float64]
Z_UP = np.array([[1, 0, 0, 0], [0, 0, -1, 0], [0, 1, 0, 0], [0, 0, 0, 1.0]])
"""From y up to z up."""
CORNERS = np.array([[x, y, z] for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)])
SIDES = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
SLOPES = [(0, 1, 2, 3), (0, 4, 1, 1), (3, 2, 5, 5), (0, 3, 5, 4), (1, 4, 5, 2)]
SOLIDS = {
    "box": (CORNERS, [face for a, b, c, d in SIDES for face in ((a, b, c), (a, c, d))]),
    "wedge": (
        CORNERS[[0, 4, 5, 1, 2, 3]],
        [face for a, b, c, d in SLOPES for face in ((a, b, c), (a, c, d)) if len({*face}) == 3],
    ),
}
COLOURS = {"Beech": (0.7, 0.5, 0.3), "steel": (0.7, 0.7, 0.7), "glass": (0.1, 0.1, 0.1), "oak": (0.6, 0.4, 0.2)}


@dataclass(frozen=True)
class Part:
    """A solid of one material: `scale` (3,), negative to mirror, and `at` [m], in the frame of its thing."""

    solid: str
    material: str
    scale: tuple[float, float, float]
    at: tuple[float, float, float] = (0.0, 0.0, 0.0)


@dataclass(frozen=True)
class Thing:
    """An object at a place [m], turned about the vertical [rad]; y is up."""

    name: str
    at: tuple[float, float, float]
    yaw: float
    parts: tuple[Part, ...]

    def frame(self, *, z_up: bool) -> Matrix:
        c, s = math.cos(self.yaw), math.sin(self.yaw)
        x, y, z = self.at
        frame = np.array([[c, 0, s, x], [0, 1, 0, y], [-s, 0, c, z], [0, 0, 0, 1.0]])
        return Z_UP @ frame @ Z_UP.T if z_up else frame

    def own(self, part: Part, *, z_up: bool) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
        """Vertices and outward faces of a part in the frame of its thing."""
        vertices, faces = SOLIDS[part.solid]
        points, order = vertices * part.scale + part.at, np.array(faces)
        return points @ Z_UP[:3, :3].T if z_up else points, order[:, ::-1] if np.prod(part.scale) < 0 else order


def drawn(seed: int) -> list[Thing]:
    u = np.random.default_rng(seed).uniform
    length, width, yaw = u(1.2, 1.6), u(0.7, 0.9), u(-0.3, 0.3)
    legs = [Part("box", "steel", (0.05, 0.7, 0.6), (side * (length / 2 - 0.1), 0.35, 0.0)) for side in (-1, 1)]
    table = Thing(
        "Esstisch größe table", (0, 0, 0), yaw, (Part("box", "Beech", (length, 0.04, width), (0, 0.72, 0)), *legs)
    )

    def laid(name: str, x: float, z: float, *parts: Part) -> Thing:
        at = table.frame(z_up=False) @ [x, 0.74 + parts[0].scale[1] / 2, z, 1.0]
        return Thing(name, (at[0], at[1], at[2]), u(-1, 1), parts)

    phone = laid("smartphone", 0.3, 0.2, Part("box", "glass", (0.07, 0.008, 0.15)))
    mugs = [laid("coffee mug", x, -0.1, Part("box", "Beech", (0.08, 0.1, 0.07))) for x in (0.0, 0.2, -0.3)]
    washer = Thing("washing machine", (-1.5, 0.425, -1.5), u(-0.3, 0.3), (Part("box", "steel", (-0.6, 0.85, 0.55)),))
    fridge = Thing("冷蔵庫", (1.5, 0.8, -1.5), u(-0.3, 0.3), (Part("box", "steel", (0.6, 1.6, 0.6)),))
    wedge = Thing("wedge", (1.0, 0.02, 1.2), u(-3, 3), (Part("wedge", "oak", (0.12, 0.04, -0.05)),))
    floor = Thing("wooden floor", (0, -0.05, 0), 0.0, (Part("box", "oak", (5, 0.1, 5)),))
    return [floor, table, phone, *mugs, washer, fridge, wedge]


# -- writers: every one returns the file ------------------------------------------------------------------------------


def ids(things: list[Thing]) -> list[str]:
    names = [thing.name for thing in things]
    return [name if names.index(name) == i else f"{name} {i}" for i, name in enumerate(names)]


def quaternion(thing: Thing, *, z_up: bool) -> list[float]:
    """x, y, z, w."""
    s, c = math.sin(thing.yaw / 2), math.cos(thing.yaw / 2)
    return [0, 0, s, c] if z_up else [0, s, 0, c]


def as_json(things: list[Thing], folder: Path, *, z_up: bool = True) -> Path:
    rows = []
    for key, thing in zip(ids(things), things, strict=True):
        vertices: list[list[float]] = []
        faces: list[list[int]] = []
        for part in thing.parts:
            points, order = thing.own(part, z_up=z_up)
            faces += (order + len(vertices)).tolist()
            vertices += points.tolist()
        pose = {"position_m": thing.frame(z_up=z_up)[:3, 3].tolist(), "rotation_xyzw": quaternion(thing, z_up=z_up)}
        geometry = {"kind": "mesh", "vertices_m": vertices, "faces": faces}
        materials = list(dict.fromkeys(part.material for part in thing.parts))
        rows.append({"id": key, "name": thing.name, "pose": pose, "geometry": geometry, "material_names": materials})
    document = {
        "format": "scene2hap/scene",
        "version": 1,
        "name": "room",
        "up_axis": "z" if z_up else "y",
        "objects": rows,
    }
    return written(folder / "room.json", json.dumps(document, ensure_ascii=False))


def as_gltf(things: list[Thing], folder: Path) -> Path:
    """Centimetres under a root of scale 0.01, parts and mirroring as nodes, copies of one mesh."""
    names, blob, views, accessors, meshes, nodes = list(COLOURS), b"", [], [], {}, []
    for vertices, faces in SOLIDS.values():
        for table, kind, shape in (
            (vertices.astype("<f4"), 5126, "VEC3"),
            (np.array(faces, "<u4").ravel(), 5125, "SCALAR"),
        ):
            views.append({"buffer": 0, "byteOffset": len(blob), "byteLength": table.nbytes})
            accessors.append({"bufferView": len(views) - 1, "componentType": kind, "count": len(table), "type": shape})
            accessors[-1] |= {"min": table.min(0).tolist(), "max": table.max(0).tolist()} if shape == "VEC3" else {}
            blob += table.tobytes()

    def mesh(part: Part) -> int:
        first = 2 * list(SOLIDS).index(part.solid)
        row = {"attributes": {"POSITION": first}, "indices": first + 1, "material": names.index(part.material)}
        return int(meshes.setdefault((part.solid, part.material), (len(meshes), {"primitives": [row]}))[0])

    for thing in things:
        placed = {
            "translation": [100 * x for x in thing.at],
            "rotation": quaternion(thing, z_up=False),
            "name": thing.name,
        }
        first = len(nodes)
        nodes.append({**placed, "scale": [100] * 3, "children": [first + 1 + i for i in range(len(thing.parts))]})
        for i, part in enumerate(thing.parts):
            name = f"{thing.name}_{i}"
            nodes.append({"name": name, "mesh": mesh(part), "scale": part.scale, "translation": part.at})
    roots = [i for i, node in enumerate(nodes) if "children" in node]
    nodes.append({"name": "RootNode", "scale": [0.01] * 3, "children": roots})
    uri = "data:application/octet-stream;base64," + base64.b64encode(blob).decode()
    document = {
        "asset": {"version": "2.0"},
        "scenes": [{"nodes": [len(nodes) - 1]}],
        "nodes": nodes,
        "meshes": [row for _, row in meshes.values()],
        "materials": [{"name": key, "pbrMetallicRoughness": {"baseColorFactor": [*COLOURS[key], 1]}} for key in names],
        "accessors": accessors,
        "bufferViews": views,
        "buffers": [{"byteLength": len(blob), "uri": uri}],
    }
    return written(folder / "room.gltf", json.dumps(document, ensure_ascii=False))


def as_usd(things: list[Thing], folder: Path) -> Path:
    """Centimetres, z up, rigid bodies; names that USD does not allow are display names."""
    pytest.importorskip("pxr.Usd", reason="usd-core is not installed; run: pip install usd-core")
    text = ['#usda 1.0\n(\n metersPerUnit = 0.01\n upAxis = "Z"\n)']
    for i, (name, colour) in enumerate(COLOURS.items()):
        text.append(
            f'def Material "m{i}" (displayName = "{name}") {{\n'
            f"token outputs:surface.connect = </m{i}/s.outputs:surface>\n"
            'def Shader "s" {\nuniform token info:id = "UsdPreviewSurface"\n'
            f"color3f inputs:diffuseColor = {colour}\ntoken outputs:surface\n}}\n}}"
        )
    for i, thing in enumerate(things):
        frame = thing.frame(z_up=True)
        frame[:3, 3] *= 100
        rows = ", ".join(f"({', '.join(map(repr, row))})" for row in frame.T.tolist())
        text.append(
            f'def Xform "t{i}" (\ndisplayName = "{thing.name}"\nprepend apiSchemas = ["PhysicsRigidBodyAPI"]) {{\n'
            f'matrix4d xformOp:transform = ({rows})\nuniform token[] xformOpOrder = ["xformOp:transform"]'
        )
        for k, part in enumerate(thing.parts):
            points, faces = thing.own(part, z_up=True)
            text.append(
                f'def Mesh "p{k}" (prepend apiSchemas = ["MaterialBindingAPI"]) {{\n'
                f"point3f[] points = {[tuple(point) for point in (100 * points).tolist()]}\n"
                f"int[] faceVertexCounts = {[3] * len(faces)}\nint[] faceVertexIndices = {faces.ravel().tolist()}\n"
                f"rel material:binding = </m{list(COLOURS).index(part.material)}>\n}}"
            )
        text.append("}")
    return written(folder / "room.usda", "\n".join(text))


def as_urdf(things: list[Thing], folder: Path) -> Path:
    """Boxes as boxes, wedges as scaled meshes."""
    text = ['<robot name="room"><link name="world"/>']
    text += [f'<material name="{key}"><color rgba="{r} {g} {b} 1"/></material>' for key, (r, g, b) in COLOURS.items()]
    for key, thing in zip(ids(things), things, strict=True):
        text.append(f'<link name="{key}">')
        for part in thing.parts:
            x, y, z = part.at
            sx, sy, sz = part.scale
            shape = f'<box size="{abs(sx)} {abs(sz)} {sy}"/>'
            if part.solid != "box":
                shape = f'<mesh filename="{solid(part.solid, folder)}" scale="{sx} {sz} {sy}"/>'
            text.append(f'<visual><origin xyz="{x} {-z} {y}"/><geometry>{shape}</geometry>')
            text.append(f'<material name="{part.material}"/></visual>')
        x, y, z = thing.frame(z_up=True)[:3, 3]
        text.append(f'</link><joint name="to {key}" type="fixed"><parent link="world"/><child link="{key}"/>')
        text.append(f'<origin xyz="{x} {y} {z}" rpy="0 0 {thing.yaw}"/></joint>')
    return written(folder / "room.urdf", "\n".join([*text, "</robot>"]))


def as_mjcf(things: list[Thing], folder: Path) -> Path:
    pytest.importorskip("mujoco", reason="needs the extra mujoco")
    assets = [f'<material name="{key}" rgba="{r} {g} {b} 1"/>' for key, (r, g, b) in COLOURS.items()]
    bodies = []
    for key, thing in zip(ids(things), things, strict=True):
        x, y, z = thing.frame(z_up=True)[:3, 3]
        s, c = quaternion(thing, z_up=True)[2:]
        bodies.append(f'<body name="{key}" pos="{x} {y} {z}" quat="{c} 0 0 {s}">')
        for part in thing.parts:
            (x, y, z), (sx, sy, sz) = part.at, part.scale
            shape = f'type="box" size="{abs(sx) / 2} {abs(sz) / 2} {sy / 2}"'
            if part.solid != "box":
                assets.append(f'<mesh name="m" file="{solid(part.solid, folder)}" scale="{sx} {sz} {sy}"/>')
                shape = 'type="mesh" mesh="m"'
            bodies.append(f'<geom {shape} pos="{x} {-z} {y}" material="{part.material}"/>')
        bodies.append("</body>")
    text = [
        '<mujoco model="room"><compiler angle="radian"/><asset>', *assets,
        "</asset><worldbody>", *bodies, "</worldbody></mujoco>",
    ]  # fmt: skip
    return written(folder / "room.xml", "\n".join(text))


def solid(name: str, folder: Path) -> str:
    """Write a unit solid with z up as OBJ."""
    vertices, faces = SOLIDS[name]
    rows = [f"v {x} {y} {z}" for x, y, z in (vertices @ Z_UP[:3, :3].T).tolist()]
    return written(
        folder / f"{name}.obj", "\n".join([*rows, *(f"f {a + 1} {b + 1} {c + 1}" for a, b, c in faces)])
    ).name


def written(path: Path, text: str) -> Path:
    path.write_text(text, encoding="utf-8")
    return path


# -- what is read -----------------------------------------------------------------------------------------------------

Writer = Callable[[list[Thing], Path], Path]
FORMATS: dict[str, Writer] = {"gltf": as_gltf, "usda": as_usd, "urdf": as_urdf, "xml": as_mjcf}


def volume_m3(item: SceneObject) -> float:
    """The volume of a closed mesh, negative if its faces look inwards."""
    a, b, c = np.moveaxis(item.geometry.mesh.vertices_m[item.geometry.mesh.faces], 1, 0)
    return float((a * np.cross(b, c)).sum() / 6)


def apart_m(one: SceneObject, other: SceneObject) -> float:
    """The largest distance of a vertex to the nearest of the other object."""
    here, there = (item.pose.to_world(item.geometry.mesh.vertices_m) for item in (one, other))
    distances = np.linalg.norm(here[:, None] - there, axis=2)
    return float(max(distances.min(axis=0).max(), distances.min(axis=1).max()))


def both(write: Writer, seed: int, folder: Path) -> tuple[SceneSnapshot, SceneSnapshot]:
    """The room in a format, and in JSON with the same up axis."""
    things = drawn(seed)
    found = load_scene(write(things, folder))
    return found, load_scene(as_json(things, folder, z_up=found.up_axis == "z"))


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("write", FORMATS.values(), ids=FORMATS)
def test_objects_are_the_same(write: Writer, seed: int, tmp_path: Path) -> None:
    found, expected = both(write, seed, tmp_path)
    for ours, theirs in zip(found.objects, expected.objects, strict=True):
        assert ours.name.startswith(theirs.name)  # names are unique in URDF and MJCF, so a number follows
        np.testing.assert_allclose(ours.pose.position_m, theirs.pose.position_m, atol=1e-6)
        np.testing.assert_allclose(ours.pose.rotation, theirs.pose.rotation, atol=1e-6)
        assert apart_m(ours, theirs) < 1e-6
        assert volume_m3(ours) == pytest.approx(volume_m3(theirs), rel=1e-5)
        np.testing.assert_allclose(ours.size_m, theirs.size_m, rtol=1e-3)
        assert ours.relative_height_m == pytest.approx(theirs.relative_height_m, abs=1e-6)
        assert material_names(ours) == material_names(theirs)
    for scene in (found, expected):
        assert len({copy_key(item) for item in scene.objects if item.name.startswith("coffee mug")}) == 1


@pytest.mark.parametrize("write", FORMATS.values(), ids=FORMATS)
def test_descriptions_and_gains_are_the_same(write: Writer, tmp_path: Path) -> None:
    found, expected = both(write, 1, tmp_path)
    bundles = [with_tones(scene) for scene in (found, expected)]
    ours, theirs = (
        [(row.object_category, row.material, [state.name for state in row.states]) for row in bundle.objects.values()]
        for bundle in bundles
    )
    assert ours == theirs
    sessions = [HapticSession(bundle, config={"prepare": "blocking"}) for bundle in bundles]
    assert len(sessions[0].source_ids) == 3
    for here, there in zip(found.objects, expected.objects, strict=True):
        point = there.bounds_m.mean(axis=0)
        point["xyz".index(found.up_axis)] = there.bounds_m[1, "xyz".index(found.up_axis)]
        frames = [
            session.update(touches=[Touch("left", key, tuple(point.tolist()))])
            for session, key in zip(sessions, (here.id, there.id), strict=True)
        ]
        np.testing.assert_allclose(frames[0].gains, frames[1].gains, rtol=1e-3, atol=1e-6)
