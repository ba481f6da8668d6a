"""Warnings of baking point at the line of the caller, not at a line of the library."""

import pytest

from scene2hap import Box, SceneObject, SceneSnapshot, SceneWarning, bake


def test_warning_of_bake_points_at_the_calling_line() -> None:
    scene = SceneSnapshot.build([SceneObject(name, geometry=Box((1, 1, 1))) for name in ("table", "chair")])
    with pytest.warns(SceneWarning, match="none of 2 objects") as caught:
        bake(scene)
    assert {one.filename for one in caught} == {__file__}
