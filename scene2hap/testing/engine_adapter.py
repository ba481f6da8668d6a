"""The contract of `EngineAdapter`."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence

from scene2hap.engines.adapter import EngineAdapter
from scene2hap.engines.changes import moved
from scene2hap.scene.geometry import bounds_of, distances
from scene2hap.scene.objects import Contact
from scene2hap.scene.plausibility.contact_normals import are_reversed
from scene2hap.scene.pose import Pose
from scene2hap.scene.snapshot import SceneSnapshot
from scene2hap.session.frame import Touch

_NEAR_M = 0.1
"""Largest distance of a point from the bounding box of the touched object (assumed: fingers have a thickness)."""


def check_engine_adapter(
    adapter: EngineAdapter, scene: SceneSnapshot, *, step: Callable[[], object], moves: str | None = None
) -> None:
    """Check an adapter against its protocol, before and after a step of the engine.

    Parameters: scene : the snapshot that sessions of this engine play, in the engine's present state; step : advances
    the engine; moves : the id of an object that a step moves, None if none is known.
    Raises: AssertionError: names the broken promise.
    """
    for name in ("poses", "touches", "contacts"):
        assert callable(getattr(adapter, name, None)), f"{type(adapter).__name__} has no method {name!r}"
    poses = {item.id: item.pose for item in scene.objects}
    assert moves is None or moves in poses, f"moves is {moves!r}, which is no object of the scene"
    before = _held(adapter, scene)
    for object_id in moved(before, poses):
        way_m = math.dist(before[object_id].position_m, poses[object_id].position_m)
        turn_deg = math.degrees(_angle_rad(before[object_id], poses[object_id]))
        raise AssertionError(
            f"poses() has {object_id!r} {way_m:.3g} m and {turn_deg:.3g} degrees from where the snapshot has it; both "
            "are in the world, in metres, with rotations (x, y, z, w)"
        )
    step()
    after = _held(adapter, scene)
    if moves is not None:
        assert after[moves] != before[moves], f"poses() has {moves!r} where it was before the step"


def _held(adapter: EngineAdapter, scene: SceneSnapshot) -> dict[str, Pose]:
    """Check poses, touches and contacts. Returns the poses of the scene's objects."""
    ids = {item.id for item in scene.objects}
    poses, touches, contacts = adapter.poses(), adapter.touches(), adapter.contacts()
    assert isinstance(poses, Mapping), f"poses() is a {type(poses).__name__}; it must be a mapping of ids to Pose"
    missing = sorted(ids - poses.keys())
    assert not missing, f"poses() lacks {missing[0]!r}; it must have every object of the scene, also those at rest"
    found = {object_id: poses[object_id] for object_id in sorted(ids)}
    for object_id, pose in found.items():
        assert isinstance(pose, Pose), f"poses()[{object_id!r}] is a {type(pose).__name__}; it must be a Pose"
    assert isinstance(touches, Sequence), f"touches() is a {type(touches).__name__}; it must be a list, or empty"
    for touch in touches:
        assert isinstance(touch, Touch), f"touches() has a {type(touch).__name__}; it must have Touch alone"
        assert isinstance(touch.hand, str), f"touches() has the hand {touch.hand!r}; it must be a name"
        assert touch.object_id in poses, f"touches() has {touch.object_id!r}, which poses() has not"
        _hold_near("touches", touch.point_m, touch.object_id, scene, found)
    is_list = contacts is None or isinstance(contacts, Sequence)
    assert is_list, f"contacts() is a {type(contacts).__name__}; it must be a list, or None to find them"
    for contact in contacts or ():
        assert isinstance(contact, Contact), f"contacts() has a {type(contact).__name__}; it must have Contact alone"
        for end in (contact.a, contact.b):
            assert end in poses, f"contacts() has {end!r}, which poses() has not"
        for end in (contact.a, contact.b):
            _hold_near("contacts", contact.point_m, end, scene, found)
    objects = {item.id: item for item in scene.objects}
    assert not are_reversed(contacts or (), objects, found.__getitem__), (
        "contacts() has normals that point from b to a; a normal points from a to b, so swap a and b"
    )
    return found


def _hold_near(
    method: str, point_m: tuple[float, float, float], object_id: str, scene: SceneSnapshot, poses: dict[str, Pose]
) -> None:
    if object_id not in poses:  # the engine has this object, but the scene does not
        return
    own_m = poses[object_id].to_own([point_m])
    off_m = float(distances(bounds_of(own_m), scene.object(object_id).geometry.mesh.bounds_m))
    assert off_m <= _NEAR_M, (
        f"{method}() has a point {off_m:.3g} m off {object_id!r}; points are in the world, in metres"
    )


def _angle_rad(a: Pose, b: Pose) -> float:
    overlap = abs(sum(p * q for p, q in zip(a.rotation_xyzw, b.rotation_xyzw, strict=True)))
    return 2 * math.acos(min(1.0, overlap))
