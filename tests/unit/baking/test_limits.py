"""A bake is refused before it costs anything if its bundle could not be loaded."""

import pytest

from scene2hap import Box, Pose, SceneObject, SceneSnapshot, bake
from scene2hap.errors import SceneError
from scene2hap.scene import limits


def test_a_bake_of_too_many_objects_asks_no_model(monkeypatch: pytest.MonkeyPatch) -> None:
    scene = SceneSnapshot.build(
        [SceneObject(f"cup {i}", pose=Pose((i, 0, 0)), geometry=Box((0.1, 0.1, 0.1))) for i in range(3)]
    )
    monkeypatch.setattr(limits, "MAX_OBJECTS", 2)
    steps: list[str] = []
    with pytest.raises(SceneError, match="number of objects is 3; .*MAX_OBJECTS"):
        bake(scene, progress=lambda stage, step, done, total: steps.append(stage))
    assert steps == []
