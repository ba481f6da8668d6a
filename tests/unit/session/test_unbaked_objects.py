"""A scene with more objects than its bundle: somebody added them after the bake."""

import warnings
from dataclasses import replace

import pytest

from scene2hap import HapticSession, SceneWarning
from scenes import box, table_with_two_phones


def test_objects_that_the_bundle_does_not_have_bring_one_warning() -> None:
    scene, bundle = table_with_two_phones()
    grown = replace(scene, objects=(*scene.objects, box("vase", (0.1, 0.3, 0.1), (4.0, 0.15, 4.0))))
    with pytest.warns(SceneWarning, match="the bundle lacks 1 of 6 objects of the scene, such as 'vase'") as told:
        HapticSession(grown, bundle)
    assert len(told) == 1
    assert told[0].filename == __file__


def test_a_part_of_the_baked_scene_brings_none() -> None:
    scene, bundle = table_with_two_phones()
    smaller = replace(scene, objects=tuple(item for item in scene.objects if item.id != "cup"))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        HapticSession(smaller, bundle)
        HapticSession(scene, bundle)
