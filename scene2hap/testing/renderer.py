"""The contract of `RendererFactory` and `Renderer`."""

from __future__ import annotations

import numpy as np

from scene2hap.common.checks import described
from scene2hap.scene.capture.protocol import RendererFactory, Selection, drawn, made_renderer
from scene2hap.scene.capture.render_scene import RenderScene
from scene2hap.scene.capture.views import frame
from scene2hap.scene.objects import SceneObject
from scene2hap.scene.pose import Pose
from scene2hap.scene.shapes import Box
from scene2hap.scene.snapshot import SceneSnapshot

_ROOM = SceneSnapshot.build(
    [
        SceneObject("table", pose=Pose((0.0, 0.36, 0.0)), geometry=Box((1.2, 0.72, 0.7))),
        SceneObject("crate", pose=Pose((0.3, 0.92, 0.1)), geometry=Box((0.3, 0.4, 0.3))),
        SceneObject("lamp", pose=Pose((-0.4, 0.92, 0.1)), geometry=Box((0.1, 0.4, 0.1))),
    ]
)
_SIZE_PX = 64


def check_renderer(factory: RendererFactory) -> None:
    """Check a renderer against its protocol: a table with two objects on it, drawn whole, in part, and empty.

    Raises: AssertionError: names the broken promise; ConfigError: the result is no picture.
    """
    assert callable(factory), (
        f"factory is {described(factory)}; it must be the class of the renderer, or a function of a scene and smooth."
    )
    render_scene = RenderScene.of(_ROOM)
    points = np.concatenate([item.points_m for item in render_scene.objects])
    camera = frame(points, 30.0, 35.0, render_scene.up_axis, 0.8, _SIZE_PX)
    for smooth in (False, True):
        renderer = made_renderer(factory, render_scene, smooth)
        name = type(renderer).__name__
        for shown in (render_scene.everyone, frozenset({1}), frozenset[int]()):
            selection = Selection(shown)
            pixels, ids = drawn(renderer, camera, selection)
            seen = set(np.unique(ids).tolist()) - {-1}
            assert pixels.dtype == np.uint8, f"{name}.draw gives pixels of type {pixels.dtype}; it must be uint8"
            assert seen == shown, f"{name} shows the objects {sorted(seen)}; requested were {sorted(shown)}"
            identified = renderer.identify(camera, selection)
            assert np.array_equal(identified, ids), f"{name}.identify and draw tell other ids"
            again, _ = drawn(renderer, camera, selection)
            assert np.array_equal(again, pixels), f"{name} draws another picture when it draws again"
            _hold_background(name, pixels, ids)


def _hold_background(name: str, pixels: np.ndarray[tuple[int, ...], np.dtype[np.uint8]], ids: object) -> None:
    """Check that the background has one colour, and that objects have others."""
    is_background = np.asarray(ids) == -1
    inner = is_background.copy()
    for axis in (0, 1):  # smooth edges mix object and background, so border pixels are left out
        for way in (-1, 1):
            inner &= np.roll(is_background, way, axis)
    colours = np.unique(pixels[inner].reshape(-1, 3), axis=0)
    assert len(colours) == 1, f"{name} draws a background of {len(colours)} colours; it must be one"
    if not is_background.all():
        assert (pixels[~is_background] != colours[0]).any(), f"{name} draws objects in the colour of the background"
