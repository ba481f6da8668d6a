"""The contract of `EngineAdapter`."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from scene2hap.engines.adapter import EngineAdapter
from scene2hap.scene.objects import Contact
from scene2hap.scene.pose import Pose
from scene2hap.scene.snapshot import SceneSnapshot
from scene2hap.session.frame import Touch

_ROUNDING_M = 1e-6


def check_engine_adapter(
    adapter: EngineAdapter, scene: SceneSnapshot, *, step: Callable[[], object], moves: str | None = None
) -> None:
    """Hold an adapter against its protocol, before and after a step of the engine.

    Parameters: scene : the snapshot that sessions of this engine play, as the engine stands now; step : lets the engine
    go on; moves : the id of an object that a step moves, None if none is known.
    Raises: AssertionError: the sentence says which promise is broken.
    """
    assert isinstance(adapter, EngineAdapter), f"{type(adapter).__name__} lacks poses, touches or contacts"
    before = _held(adapter, scene)
    for item in scene.objects:
        way_m = float(np.abs(np.subtract(before[item.id].position_m, item.pose.position_m)).max())
        assert way_m <= _ROUNDING_M, (
            f"poses() has {item.id!r} {way_m:.3g} m from where the snapshot has it; both are in metres, in the world"
        )
    step()
    after = _held(adapter, scene)
    if moves is not None:
        assert after[moves] != before[moves], f"poses() has {moves!r} where it was before the step"


def _held(adapter: EngineAdapter, scene: SceneSnapshot) -> dict[str, Pose]:
    poses = adapter.poses()
    ids = {item.id for item in scene.objects}
    missing = sorted(ids - poses.keys())
    assert not missing, f"poses() lacks {missing[0]!r}; it must have every object of the scene, also those at rest"
    found = {object_id: poses[object_id] for object_id in ids}
    for object_id, pose in found.items():
        assert isinstance(pose, Pose), f"poses()[{object_id!r}] is a {type(pose).__name__}; it must be a Pose"
    for touch in adapter.touches():
        assert isinstance(touch, Touch), f"touches() has a {type(touch).__name__}; it must have Touch alone"
        assert touch.object_id in ids, f"touches() has {touch.object_id!r}, which is no object of the scene"
    for contact in adapter.contacts() or ():
        assert isinstance(contact, Contact), f"contacts() has a {type(contact).__name__}; it must have Contact alone"
        assert {contact.a, contact.b} <= ids, f"contacts() has {contact.a!r} and {contact.b!r}; both must be objects"
    return found
