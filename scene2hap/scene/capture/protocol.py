"""The interface of renderers."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from scene2hap.scene.capture.stage import Stage
from scene2hap.scene.capture.views import Camera

Ids = NDArray[np.int32]
"""Which actor each pixel shows (size_px, size_px), numbered as in the stage; -1 for the background."""

Pixels = NDArray[np.uint8]
"""Colours (size_px, size_px, 3), sRGB."""


@dataclass(frozen=True)
class Selection:
    """What a picture shows: the actors `shown`; of those `opened` only faces that cannot hide the `focus_m`.

    A face can hide a point if its plane separates the point from the eye. So an opened room loses the walls between it
    and the camera and keeps floor and far walls, whether it is one mesh or several.
    """

    shown: frozenset[int]
    opened: frozenset[int] = frozenset()
    focus_m: tuple[float, float, float] = (0.0, 0.0, 0.0)


class Renderer(Protocol):
    """Draws a stage. Calls come one at a time."""

    def identify(self, camera: Camera, selection: Selection) -> Ids:
        """The actor that each pixel's middle shows."""
        ...

    def draw(self, camera: Camera, selection: Selection) -> tuple[Pixels, Ids]:
        """The picture, and the ids as `identify` tells them."""
        ...


RendererFactory = Callable[[Stage, bool], Renderer]
"""Builds a renderer for a stage; the flag asks for smooth edges."""
