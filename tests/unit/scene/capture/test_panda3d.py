"""The software rasteriser draws what ray casting does, up to the rims of things."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from scene2hap import SceneSnapshot
from scene2hap.scene.appearance import Appearance, FaceMaterial
from scene2hap.scene.capture import capture_images
from scene2hap.scene.capture.protocol import Selection
from scene2hap.scene.capture.stage import Stage
from scene2hap.scene.capture.views import frame
from scenes import box, scene

embree = pytest.importorskip(
    "scene2hap.scene.capture.embree", reason="needs the extra `pictures`", exc_type=ImportError
)
panda = pytest.importorskip(
    "scene2hap.scene.capture.panda3d_renderer", reason="needs the extra `panda3d`", exc_type=ImportError
)


def room() -> SceneSnapshot:
    checker = np.zeros((4, 4, 3), np.uint8)
    checker[::2, ::2] = checker[1::2, 1::2] = (250, 200, 0)
    uv = np.tile(np.array([(0, 0), (0, 1), (1, 1)], np.float32), (12, 1, 1))
    looks = Appearance((FaceMaterial((1, 1, 1, 1), checker),), np.zeros(12, np.int32), uv)
    return scene(
        box("floor", (3, 0.1, 3), (0, -0.05, 0)),
        box("wall", (3, 2, 0.1), (0, 1, 1.45)),
        replace(box("crate", (1, 1, 1), (0, 0.5, 0)), appearance=looks),
        box("lamp", (0.3, 0.3, 0.3), (0.8, 1.5, 0.3)),
    )


@pytest.mark.parametrize("elevation", [45.0, -45.0])
@pytest.mark.parametrize(
    "selection",
    [
        Selection(frozenset({0, 1, 2, 3})),
        Selection(frozenset({2})),
        Selection(frozenset({0, 1, 2}), frozenset({0, 1}), (0.0, -0.5, 0.0)),
    ],
)
def test_both_renderers_agree(selection: Selection, elevation: float) -> None:
    stage = Stage.of(room())
    points = np.concatenate([actor.points_m for actor in stage.actors])
    camera = frame(points, 30.0, elevation, "y", 0.8, 200)
    cast, cast_ids = embree.EmbreeRenderer(stage, False).draw(camera, selection)
    drawn, drawn_ids = panda.Panda3DRenderer(stage).draw(camera, selection)
    assert (cast_ids != drawn_ids).mean() < 0.02
    same = cast_ids == drawn_ids
    assert (np.abs(cast[same].astype(int) - drawn[same]).max(axis=1) > 12).mean() < 0.03


def test_it_is_chosen_by_name() -> None:
    images = capture_images(room(), size_px=64, renderer="panda3d").images
    assert images is not None
    assert images[0].startswith(b"\x89PNG")
