"""The Unity component of the C# client, on stubs of Unity: scenes in its coordinates, hinges, and both controllers."""

import json
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from csharp_client import needs_csharp
from hinged_doors import check_door
from scene2hap import HapticSession, SceneObject, load_scene
from scene2hap.scene.snapshot import SceneSnapshot
from scene2hap.testing.bridge_client import serving

pytest.importorskip("websockets", reason="no WebSocket server; pip install websockets")
DOOR = ("Kitchen/Door", "Kitchen/Cabinet")
TOKEN = "a token that nobody else may read"
pytestmark = needs_csharp


def test_unity_scene_equals_the_matrix_conversion(trial: Callable[..., list[str]]) -> None:
    """A point p of Unity's world is M p in a right-handed world, M = diag(-1, 1, 1), through any nested frames."""
    text = trial("unity-scene", "meshes")
    assert text[1] == "none True"
    scene = json.loads(text[0])
    assert [item["id"] for item in scene["objects"]] == ["Room/Wedge (1)", "Room#0/Mug#1", "Room#0/Mug#2", *DOOR]
    assert [item["name"] for item in scene["objects"]] == ["Wedge", "Mug", "Mug", "Door", "Cabinet"]
    room = affine((0.5, 0, -1), (0, 0.6, 0, 0.8), (1, 1, 1))
    wedge = room @ affine((1, 2, 3), (0.48, 0.36, 0, 0.8), (2, 0.5, 1))
    part = wedge @ affine((0, 1, 0), (0, 0, 0.6, 0.8), (-1, 1, 1))
    corners = np.array([(0, 0, 0), (2, 0, 0), (0, 1, 0), (0, 0, 0.5)], float)
    mirror = np.diag([-1.0, 1.0, 1.0])
    in_unity = np.concatenate([moved(wedge, corners), moved(part, corners)])
    item = scene["objects"][0]
    frame = affine(item["pose"]["position_m"], item["pose"]["rotation_xyzw"], (1, 1, 1))
    written = np.array(item["geometry"]["vertices_m"])
    np.testing.assert_allclose(moved(frame, written), in_unity @ mirror, atol=1e-5)
    # The pose: its rotation is M R M, its origin M p.
    rotation = room[:3, :3] @ turn((0.48, 0.36, 0, 0.8))
    np.testing.assert_allclose(frame[:3, :3], mirror @ rotation @ mirror, atol=1e-6)
    np.testing.assert_allclose(frame[:3, 3], mirror @ wedge[:3, 3], atol=1e-5)
    # Unity's faces are clockwise seen from outside, and (b - a) x (c - a) by components points outwards there. The quad
    # of Unity's manual shows this: corners 0, (0, h, 0), (w, 0, 0) have the normal (0, 0, -1).
    # The faces of both pieces, also the mirrored one, point outwards: volume 2 * 1 * 0.5 / 6, scaled by 2 * 0.5 * 1.
    faces = np.array(item["geometry"]["faces"])
    for piece in (faces[:4], faces[4:]):
        a, b, c = written[piece].transpose(1, 0, 2)
        assert (a * np.cross(b, c)).sum() / 6 == pytest.approx(1 / 6, rel=1e-5)
    found = SceneSnapshot.from_json(text[0]).objects
    assert [one.material_names for one in found] == [("Walnut", "Brass"), *4 * [()]]  # the largest area first


def test_unity_boxes_enclose_their_meshes(trial: Callable[..., list[str]]) -> None:
    scene = json.loads(trial("unity-scene", "boxes")[0])
    room = affine((0.5, 0, -1), (0, 0.6, 0, 0.8), (1, 1, 1))
    assert scene["objects"][0]["material_names"] == ["Walnut", "Brass"]
    mug = scene["objects"][2]
    assert mug["geometry"]["kind"] == "box"
    np.testing.assert_allclose(mug["geometry"]["size_m"], (2, 1, 0.5), atol=1e-5)
    # Centred on the middle of its mesh (1, 0.5, 0.25), 1 m above the room's origin.
    centre = moved(room @ affine((0, 1, 0), (0, 0, 0, 1), (1, 1, 1)), np.array([[1, 0.5, 0.25]]))[0]
    np.testing.assert_allclose(mug["pose"]["position_m"], centre * (-1, 1, 1), atol=1e-5)
    wedge = scene["objects"][0]
    turned = turn((0.48, 0.36, 0, 0.8))
    corners = np.array([(x, y, z) for x in (0, 2) for y in (0, 1) for z in (0, 0.5)], float)
    pieces = affine((0, 0, 0), (0, 0, 0, 1), (2, 0.5, 1))
    part = pieces @ affine((0, 1, 0), (0, 0, 0.6, 0.8), (-1, 1, 1))
    own = np.concatenate([moved(pieces, corners), moved(part, corners)])
    np.testing.assert_allclose(wedge["geometry"]["size_m"], np.ptp(own, axis=0), atol=1e-5)
    middle = (own.max(axis=0) + own.min(axis=0)) / 2
    position = moved(room, np.array([turned @ middle + (1, 2, 3)]))[0]
    np.testing.assert_allclose(wedge["pose"]["position_m"], position * (-1, 1, 1), atol=1e-5)


@pytest.mark.parametrize("geometry", ["meshes", "boxes"])
def test_a_hinge_joint_of_unity_is_a_hinge(trial: Callable[..., list[str]], tmp_path: Path, geometry: str) -> None:
    path = tmp_path / "scene.json"
    path.write_text(trial("unity-scene", geometry)[0], encoding="utf-8")
    scene = load_scene(path)
    assert [one.id for one in scene.objects if one.hinge] == ["Kitchen/Door"]  # no mug
    kitchen = affine((0.5, 0, -1), (0, 0.6, 0, 0.8), (0.5, 0.5, 0.5))
    pivot = moved(kitchen, np.array([(3, 1.8, -0.01)]))[0]
    check_door(scene, pivot * (-1, 1, 1), *DOOR)


def test_the_unity_component_drives_both_controllers(
    trial: Callable[..., list[str]], monkeypatch: pytest.MonkeyPatch
) -> None:
    added: list[SceneObject] = []
    add = HapticSession.add
    monkeypatch.setattr(HapticSession, "add", lambda session, item: (added.append(item), add(session, item)))
    with serving(token=TOKEN) as server:
        lines = trial("unity-play", server.url, token=TOKEN)
    assert lines[:2] == ["tracked True", "untracked False"]
    left, right = [float(word) for word in lines[2].split()[1:]]
    assert 0 < left < right <= 1  # the right hand holds the phone, the left hand touches the table 10 cm beside it
    assert lines[3:7] == ["removed", "added", "lifted True", "held True"]
    (hinge,) = [one.hinge for one in added]
    assert hinge is not None
    assert hinge.to == "Wooden table"
    assert hinge.point_m == pytest.approx((0, 0, 0), abs=1e-6)
    assert hinge.other_point_m == pytest.approx((0.2, 0.065, 0.1))
    assert not [line for line in lines if line.startswith("logged error")]


def turn(q: tuple[float, ...]) -> np.ndarray:
    """The matrix of a quaternion (x, y, z, w)."""
    x, y, z, w = q
    return np.array(
        [
            (1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)),
            (2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)),
            (2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)),
        ]
    )


def affine(position: tuple[float, ...], q: tuple[float, ...], scale: tuple[float, ...]) -> np.ndarray:
    found = np.eye(4)
    found[:3, :3] = turn(q) * np.array(scale)
    found[:3, 3] = position
    return found


def moved(by: np.ndarray, points: np.ndarray) -> np.ndarray:
    return np.asarray(points @ by[:3, :3].T + by[:3, 3])
