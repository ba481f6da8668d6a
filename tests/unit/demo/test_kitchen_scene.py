"""The demo kitchen: the committed file equals the output of its script, and objects touch their supports."""

from __future__ import annotations

import os
import subprocess
import sys
from itertools import combinations, product
from pathlib import Path

import numpy as np
import pytest
import trimesh

ROOT = Path(__file__).parents[3]
SCRIPT = ROOT / "examples" / "build_demo_kitchen.py"
COMMITTED = ROOT / "scene2hap" / "demo" / "kitchen.glb"
SOURCES = {
    "handheld_fan",
    "electric_toothbrush",
    "smartphone",
    "washing_machine",
    "refrigerator",
    "cooker_hood",
    "microwave",
}
TOUCH_M = 1e-6


def read_objects():
    """World meshes of the named nodes. A mesh with several colours is several children of its node."""
    scene = trimesh.load_scene(COMMITTED, process=False)
    named = set(scene.graph.transforms.children[scene.graph.base_frame])
    parts: dict[str, list[trimesh.Trimesh]] = {name: [] for name in named}
    for leaf in scene.graph.nodes_geometry:
        node = leaf
        while node not in named:
            node = scene.graph.transforms.parents[node]
        matrix, geometry = scene.graph[leaf]
        parts[node].append(scene.geometry[geometry].copy().apply_transform(matrix))
    return parts


@pytest.fixture(scope="module")
def parts():
    return read_objects()


@pytest.fixture(scope="module")
def objects(parts):
    return {
        name: trimesh.util.concatenate([trimesh.Trimesh(p.vertices, p.faces, process=False) for p in pieces])
        for name, pieces in parts.items()
    }


def test_the_script_rebuilds_the_committed_bytes(tmp_path):
    path = tmp_path / "kitchen.glb"
    environment = {**os.environ, "PYTHONDONTWRITEBYTECODE": "1"}
    done = subprocess.run(
        [sys.executable, str(SCRIPT), "-o", str(path)], capture_output=True, text=True, env=environment
    )
    assert done.returncode == 0, done.stderr
    assert path.read_bytes() == COMMITTED.read_bytes()


def test_the_file_is_small_enough_to_ship():
    assert COMMITTED.stat().st_size < 500_000


def test_names_are_those_of_a_kitchen(objects):
    assert len(objects) >= 30
    assert set(objects) >= SOURCES
    assert all(name == name.lower() and name.replace("_", "").isalnum() for name in objects)


def test_sizes_are_realistic(objects):
    sizes = {name: mesh.extents for name, mesh in objects.items()}
    assert sizes["worktop"] == pytest.approx([3.0, 0.038, 0.62], abs=TOUCH_M)
    assert objects["dining_table"].bounds[1, 1] == pytest.approx(0.74, abs=TOUCH_M)
    assert sizes["refrigerator"][1] == pytest.approx(1.80, abs=TOUCH_M)
    assert sizes["washing_machine"][1] == pytest.approx(0.85, abs=TOUCH_M)
    assert 0.14 < max(sizes["smartphone"]) < 0.16


def test_every_part_is_closed_and_faces_outwards(parts):
    for name, pieces in parts.items():
        for piece in pieces:
            assert piece.is_watertight, name
            assert piece.is_winding_consistent, name
            assert piece.volume > 0, name


@pytest.mark.parametrize(
    ("thing", "support", "axis", "plane_m"),
    [
        ("refrigerator", "floor", "y", 0.0),
        ("washing_machine", "floor", "y", 0.0),
        ("dining_table", "floor", "y", 0.0),
        ("worktop", "base_cabinet_1", "y", 0.862),
        ("worktop", "sink_cabinet", "y", 0.862),
        ("microwave", "worktop", "y", 0.900),
        ("sink", "worktop", "y", 0.900),
        ("smartphone", "dining_table", "y", 0.740),
        ("handheld_fan", "dining_table", "y", 0.740),
        ("electric_toothbrush", "open_shelf", "y", 1.400),
        ("tea_towel", "washing_machine", "y", 0.850),
        ("cooker_hood", "back_wall", "z", 0.0),
        ("open_shelf", "back_wall", "z", 0.0),
        ("window", "left_wall", "y", 1.000),
    ],
)
def test_objects_touch_in_the_plane_of_their_support(objects, thing, support, axis, plane_m):
    along = "xyz".index(axis)
    one, other = objects[thing], objects[support]
    assert corner_on_face(one, other, along, plane_m) or corner_on_face(other, one, along, plane_m)


def corner_on_face(corners_of, faces_of, along, plane_m):
    """Whether a corner in the plane lies within a face in the plane, from the signs of three areas."""
    across = [axis for axis in range(3) if axis != along]
    corners = corners_of.vertices[np.abs(corners_of.vertices[:, along] - plane_m) <= TOUCH_M][:, across]
    flat = (np.abs(faces_of.triangles[:, :, along] - plane_m) <= TOUCH_M).all(axis=1)
    a, b, c = np.moveaxis(faces_of.triangles[flat][:, :, across], 1, 0)
    areas = np.stack(
        [
            (q[:, 0] - p[:, 0]) * (corners[:, None, 1] - p[:, 1])
            - (q[:, 1] - p[:, 1]) * (corners[:, None, 0] - p[:, 0])
            for p, q in ((a, b), (b, c), (c, a))
        ]
    )
    slack = 1e-9
    return bool(((areas >= -slack).all(axis=0) | (areas <= slack).all(axis=0)).any())


def test_objects_do_not_intersect(objects):
    for one, other in combinations(objects, 2):
        for inner, outer in ((one, other), (other, one)):
            depth = sunk_corners(objects[inner], objects[outer])
            assert depth == 0, f"{depth} corners of {inner} lie inside {outer}"


def sunk_corners(inner, outer, margin_m=1e-5):
    """The number of corners and face centres of one mesh inside another, without those on its faces."""
    points = np.concatenate([inner.vertices, inner.triangles_center])
    low, high = outer.bounds
    points = points[((points > low + margin_m) & (points < high - margin_m)).all(axis=1)]
    for step in margin_m * np.array(list(product((-1, 1), repeat=3))):
        points = points[turns_around(outer, points + step) > 0.5] if len(points) else points
    return len(points)


def turns_around(mesh, points):
    """Winding number of a mesh at points (n, 3): 1 inside, 0 outside (Van Oosterom and Strackee 1983, equation 8)."""
    a, b, c = np.moveaxis(mesh.triangles[None] - points[:, None, None], 2, 0)
    la, lb, lc = (np.linalg.norm(side, axis=-1) for side in (a, b, c))
    ab, bc, ca = (np.einsum("ijk,ijk->ij", p, q) for p, q in ((a, b), (b, c), (c, a)))
    volume = np.einsum("ijk,ijk->ij", a, np.cross(b, c))
    return np.arctan2(volume, la * lb * lc + ab * lc + bc * la + ca * lb).sum(axis=1) / (2 * np.pi)


@pytest.mark.parametrize("walk_m", [0.4, 0.8, 1.2])
def test_a_hand_finds_the_worktop_free_beside_the_microwave(objects, walk_m):
    feet = objects["microwave"].vertices
    foot_x = feet[np.abs(feet[:, 1] - 0.9) <= TOUCH_M][:, 0].min()
    point = np.array([foot_x - walk_m, 0.9, 0.40])
    low, high = objects["worktop"].bounds
    assert (point >= low - TOUCH_M).all()
    assert (point <= high + TOUCH_M).all()
    for name, mesh in objects.items():
        if name != "worktop":
            apart = np.maximum(np.maximum(mesh.bounds[0] - point, point - mesh.bounds[1]), 0.0)
            assert np.linalg.norm(apart) > 0.03, name
