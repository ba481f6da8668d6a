"""The interface of renderers."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from inspect import signature
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from scene2hap.common import checks
from scene2hap.common.calls import misfit
from scene2hap.errors import ConfigError
from scene2hap.plugins import Members, lacking
from scene2hap.scene.capture.render_scene import RenderScene
from scene2hap.scene.capture.views import Camera

Ids = NDArray[np.int32]
"""The object of each pixel (size_px, size_px), as its number in `RenderScene.objects`; -1 for the background."""

Pixels = NDArray[np.uint8]
"""Colours (size_px, size_px, 3), sRGB."""


@dataclass(frozen=True)
class Selection:
    """The content of a picture: objects `shown`. Objects `opened` show only faces that cannot hide the point `focus_m`.

    A face can hide a point if its plane separates the point from the eye. So an opened room loses the walls between the
    point and the camera, and keeps floor and far walls, whether it is one mesh or several.
    """

    shown: frozenset[int]
    opened: frozenset[int] = frozenset()
    focus_m: tuple[float, float, float] = (0.0, 0.0, 0.0)


class Renderer(Protocol):
    """Interface of renderers of a `RenderScene`. The library makes one call at a time."""

    def identify(self, camera: Camera, selection: Selection, /) -> Ids:
        """Return the object at the middle of each pixel."""
        ...

    def draw(self, camera: Camera, selection: Selection, /) -> tuple[Pixels, Ids]:
        """Return the picture, and the ids as from `identify`."""
        ...


RendererFactory = Callable[[RenderScene, bool], Renderer]
"""Function that builds a renderer for a `RenderScene`; the flag requests smooth edges."""

_RENDERER: Members = {"identify": ("camera", "selection"), "draw": ("camera", "selection")}


def drawn(renderer: Renderer, camera: Camera, selection: Selection) -> tuple[Pixels, Ids]:
    """Draw a picture. Raises: ConfigError: the renderer returned an invalid result."""
    size, given = (camera.size_px, camera.size_px), renderer.draw(camera, selection)
    by = f"{type(renderer).__name__}.draw"
    if not isinstance(given, tuple) or len(given) != 2:
        raise ConfigError(f"{by} gave {checks.described(given)}; it must give pixels and ids.")
    for name, found, shape in (("pixels", given[0], (*size, 3)), ("ids", given[1], size)):
        if np.shape(found) != shape or np.asarray(found).dtype.kind not in "ui":
            raise ConfigError(
                f"{by} gave {name} of shape {np.shape(found)} and type {np.asarray(found).dtype}; they must be "
                f"integers of shape {shape}."
            )
    return given


def made_renderer(factory: RendererFactory, scene: RenderScene, smooth: bool) -> Renderer:
    """Build a renderer. Raises: ConfigError: the factory returned no `Renderer`."""
    name = getattr(factory, "__qualname__", repr(factory))
    if misfit(factory, (scene, smooth), {}):
        raise ConfigError(f"{name}{signature(factory)} must take (scene, smooth) and give a Renderer.")
    renderer = factory(scene, smooth)
    if problem := lacking(renderer, _RENDERER):
        raise ConfigError(f"{name} gave no Renderer: {problem}")
    return renderer
