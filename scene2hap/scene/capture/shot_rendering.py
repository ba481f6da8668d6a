"""Render a shot as a PNG file: camera, culling, picture, outline."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from scene2hap.scene.capture.config import CaptureConfig
from scene2hap.scene.capture.culling import Culler
from scene2hap.scene.capture.outline import mark
from scene2hap.scene.capture.png import png
from scene2hap.scene.capture.protocol import Renderer, Selection, drawn
from scene2hap.scene.capture.render_scene import RenderScene
from scene2hap.scene.capture.views import Camera, frame
from scene2hap.scene.images import Shot

# Share of the frame that a whole scene fills, and least width of a context image relative to its target (assumed).
_SCENE_FILL = 0.95
_LEAST_FACTOR = 1.25


@dataclass(frozen=True, eq=False)
class Photographer:
    """Producer of pictures of a `RenderScene`; equal input gives equal bytes. `below` : the scene's `supports`."""

    scene: RenderScene
    renderer: Renderer
    config: CaptureConfig
    below: tuple[int | None, ...]

    @cached_property
    def culler(self) -> Culler:
        """The `Culler` that selects the objects of each picture."""
        return Culler(self.scene, self.renderer, self.config.near_share, self.config.hidden_share, self.below)

    def aim(self, shot: Shot) -> tuple[Camera, Selection]:
        """Return the camera, and its selection of objects."""
        config = self.config
        angles = (shot.azimuth_deg, shot.elevation_deg, self.scene.up_axis)
        if shot.subject is None:
            points = np.concatenate([item.points_m for item in self.scene.objects])
            camera = frame(points, *angles, _SCENE_FILL, config.size_px)
            return camera, self.culler.overview(camera)
        target = self.scene.index[shot.subject]
        item = self.scene.objects[target]
        close = frame(item.points_m, *angles, config.fill, config.size_px)
        if shot.kind == "isolated":
            return close, Selection(frozenset({target}))
        widest = max(_LEAST_FACTOR, _LEAST_FACTOR * self.scene.diagonal_m / max(item.diagonal_m, 1e-9))
        wide = close.widened(min(config.context_factor, widest))
        return wide, self.culler.around(target, close, wide)

    def take(self, shot: Shot) -> bytes:
        """Return the picture as a PNG file."""
        camera, selection = self.aim(shot)
        picture, ids = drawn(self.renderer, camera, selection)
        if shot.kind == "context" and shot.subject is not None:
            is_target = ids == self.scene.index[shot.subject]
            mark(picture, is_target, self.config.outline_px, self.config.outline_rgb)
        return png(picture)
