"""The software rasteriser gives the pictures of ray casting, except at the rims of objects."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from scipy.ndimage import maximum_filter, minimum_filter

from host import rasteriser_problem
from scene2hap import SceneSnapshot
from scene2hap.scene.capture import capture_images
from scene2hap.scene.capture.colour_table import BACKGROUND_RGB
from scene2hap.scene.capture.protocol import Selection
from scene2hap.scene.capture.render_scene import RenderScene
from scene2hap.scene.capture.views import frame
from scene2hap.scene.looks.appearance import Appearance, FaceMaterial
from scenes import box, scene

embree = pytest.importorskip(
    "scene2hap.scene.capture.embree", reason="needs the extra `pictures`", exc_type=ImportError
)
panda = pytest.importorskip(
    "scene2hap.scene.capture.panda3d_renderer", reason="needs the extra `panda3d`", exc_type=ImportError
)

pytestmark = pytest.mark.skipif(bool(rasteriser_problem()), reason=rasteriser_problem())


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
    render_scene = RenderScene.of(room())
    points = np.concatenate([item.points_m for item in render_scene.objects])
    camera = frame(points, 30.0, elevation, "y", 0.8, 200)
    cast, cast_ids = embree.EmbreeRenderer(render_scene, False).draw(camera, selection)
    drawn, drawn_ids = panda.Panda3DRenderer(render_scene).draw(camera, selection)
    assert (cast_ids != drawn_ids).mean() < 0.02
    same = cast_ids == drawn_ids
    assert (np.abs(cast[same].astype(int) - drawn[same]).max(axis=1) > 12).mean() < 0.03


def test_panda3d_renderer_is_chosen_by_name() -> None:
    images = capture_images(room(), size_px=64, renderer="panda3d").images
    assert images is not None
    assert images[0].startswith(b"\x89PNG")


def leaves(holed: bool) -> SceneSnapshot:
    """A crate, whose texture may have holes, with a core inside and a floor below."""
    texels = np.full((8, 8, 4), (30, 160, 40, 255), np.uint8)
    if holed:
        texels[:, :4, 3] = 0
    uv = np.tile(np.array([(0.1, 0.1), (0.1, 0.9), (0.9, 0.9)], np.float32), (12, 1, 1))
    looks = Appearance((FaceMaterial((1, 1, 1, 1), texels),), np.zeros(12, np.int32), uv)
    return scene(
        replace(box("crate", (1, 1, 1), (0, 0.5, 0)), appearance=looks),
        box("core", (0.5, 0.5, 0.5), (0, 0.5, 0)),
        box("floor", (3, 0.1, 3), (0, -0.05, 0)),
    )


def seen_by(renderer: Any, render_scene: RenderScene, size_px: int = 200) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The picture of a scene, its ids, and the ids of a separate id pass."""
    points = np.concatenate([item.points_m for item in render_scene.objects])
    camera = frame(points, 30.0, 40.0, "y", 0.8, size_px)
    drawn: tuple[np.ndarray, np.ndarray] = renderer.draw(camera, Selection(render_scene.everyone))
    return (*drawn, renderer.identify(camera, Selection(render_scene.everyone)))


@pytest.mark.parametrize("holed", [False, True])
def test_transparent_texels_show_objects_behind(holed: bool) -> None:
    render_scene = RenderScene.of(leaves(holed))
    picture, ids, identified = seen_by(panda.Panda3DRenderer(render_scene), render_scene)
    _, expected, _ = seen_by(embree.EmbreeRenderer(render_scene), render_scene)
    np.testing.assert_array_equal(ids, identified)
    assert (ids == 1).any() == holed
    assert (ids != expected).mean() < 0.03
    assert (picture[ids == 0][:, 1] > picture[ids == 0][:, 0]).all()


@pytest.mark.parametrize("n_objects", [250, 251])
@pytest.mark.parametrize("is_textured", [False, True])
def test_object_ids_are_distinct_in_a_large_scene(n_objects: int, is_textured: bool) -> None:
    looks = room().object("crate").appearance
    side = int(np.ceil(np.sqrt(n_objects)))
    crowd = scene(
        *(
            replace(
                box(f"tile{k}", (0.9, 0.1, 0.9), (k % side, 0, k // side)), appearance=looks if is_textured else None
            )
            for k in range(n_objects)
        )
    )
    render_scene = RenderScene.of(crowd)
    _, ids, identified = seen_by(panda.Panda3DRenderer(render_scene), render_scene, 400)
    _, expected, _ = seen_by(embree.EmbreeRenderer(render_scene), render_scene, 400)
    np.testing.assert_array_equal(ids, identified)
    assert set(np.unique(ids)) == {-1, *range(n_objects)}
    # Corners are rounded to whole pixels, so that the rims of small tiles differ.
    inner = minimum_filter(expected, 5) == maximum_filter(expected, 5)
    np.testing.assert_array_equal(ids[inner], expected[inner])


def test_an_empty_selection_shows_the_background() -> None:
    render_scene = RenderScene.of(room())
    camera = frame(render_scene.objects[0].points_m, 30.0, 45.0, "y", 0.8, 64)
    picture, ids = panda.Panda3DRenderer(render_scene).draw(camera, Selection(frozenset()))
    assert (ids == -1).all()
    assert (picture == BACKGROUND_RGB).all()


def test_pictures_do_not_depend_on_earlier_pictures() -> None:
    render_scene = RenderScene.of(room())
    camera = frame(render_scene.objects[2].points_m, 30.0, 45.0, "y", 0.4, 128)
    selections = [
        Selection(render_scene.everyone),
        Selection(render_scene.everyone, frozenset({0, 1}), (0.0, -0.5, 0.0)),
        Selection(frozenset({2})),
    ]
    first = [panda.Panda3DRenderer(render_scene).draw(camera, selection) for selection in selections]
    used = panda.Panda3DRenderer(render_scene)
    other = camera.widened(3.0).resized(48)
    for selection, (picture, ids) in [*zip(selections, first, strict=True), *zip(selections, first, strict=True)]:
        used.identify(other, selection)
        again, again_ids = used.draw(camera, selection)
        np.testing.assert_array_equal(again, picture)
        np.testing.assert_array_equal(again_ids, ids)
