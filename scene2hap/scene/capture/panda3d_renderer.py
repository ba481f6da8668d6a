"""Pictures by Panda3D's software rasteriser (p3tinydisplay): several times faster, without smooth edges.

The renderer needs no graphics card, and only libx11-6 as a system package. Its time grows with the number of corners
rather than pixels, so only triangles that can colour a pixel are drawn (`in_view`): a ninth of a furnished house. Light
is baked into their colours, so that pictures look like those of ray casting. In scenes of up to `_BASE` objects, a
picture and its ids take one pass: a pixel's object is encoded in its opacity, which is otherwise unused.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from PIL import Image

from scene2hap.common.arrays import Bytes, Floats, Ints
from scene2hap.scene.capture.colour_table import BACKGROUND_RGB, light
from scene2hap.scene.capture.faces import planes, separates
from scene2hap.scene.capture.panda3d_in_view import Extents, extents, in_view
from scene2hap.scene.capture.panda3d_screen import Screen, textured
from scene2hap.scene.capture.protocol import Ids, Pixels, Selection
from scene2hap.scene.capture.render_scene import RenderScene
from scene2hap.scene.capture.views import Camera

# Objects are encoded as digits in this base, plus one, since zero is the background. Textures multiply by 255 / 256 and
# round down, so one more is added to a digit that is drawn with a texture.
_BASE = 250

_MOST_DIRECTIONS = 72


class Panda3DRenderer:
    """Render a scene by a software rasteriser, faster and without smooth edges. See `Renderer`."""

    def __init__(self, scene: RenderScene, antialias: bool = False) -> None:
        self._scene = scene
        palette = scene.palette
        counts = [len(item.triangles_m) for item in scene.objects]
        material = np.concatenate([item.material for item in scene.objects])
        # Triangles of one texture are drawn together. Triangles without a texture come first.
        order = np.argsort(np.where(palette.is_patterned[material], material, -1), kind="stable")
        material = material[order]
        self._object_of = np.repeat(np.arange(len(counts)), counts)[order]
        self._triangles_of = np.split(np.argsort(self._object_of, kind="stable"), np.cumsum(counts)[:-1])
        corners = np.concatenate([item.triangles_m for item in scene.objects])[order]
        u, v = np.concatenate([item.uv for item in scene.objects])[order].transpose(2, 0, 1)
        # The texture coordinate v of Panda3D runs up.
        self._corners = np.concatenate((corners, np.stack((u, 1 - v), axis=2)), axis=2)
        self._by_axis = np.ascontiguousarray(corners.transpose(2, 1, 0))
        self._planes = planes(corners)
        self._normals = self._planes[:, :3].astype(np.float32)
        self._paint = palette.rgb[material] * 255
        digits = np.stack(np.divmod(self._object_of, _BASE), axis=1) + 1
        self._codes = np.full((len(order), 4), 255, np.uint8)
        self._codes[:, :2] = digits + palette.is_cutout[material, None]
        self._opacity = (digits[:, 1] + palette.is_patterned[material]).astype(np.uint8)
        self._lit_along: dict[bytes, Bytes] = {}
        self._screen = Screen(scene.diagonal_m)
        self._painted = {row: self._textured(row) for row in np.flatnonzero(palette.is_patterned).tolist()}
        self._holed = {row: self._textured(row, only_holes=True) for row in np.flatnonzero(palette.is_cutout).tolist()}
        self._paint_row = np.where(palette.is_patterned, np.arange(len(palette.rgb)), -1)[material]
        self._hole_row = np.where(palette.is_cutout, np.arange(len(palette.rgb)), -1)[material]
        # A picture and the passes before it share their eye, and some of them the camera, so both results are cached.
        self._eye: tuple[bytes, Extents] | None = None
        self._view: tuple[Camera, Ints] | None = None

    def identify(self, camera: Camera, selection: Selection) -> Ids:
        """Return the object at the middle of each pixel."""
        triangles = self._shown(camera, selection)
        groups = _groups(self._hole_row[triangles], self._holed)
        pixels = self._screen.draw(camera, self._corners[triangles], self._codes[triangles], groups, (0, 0, 0))
        image = pixels.astype(np.int32)
        # The order in memory is blue, green, red.
        ids: Ids = np.maximum((image[..., 2] - 1) * _BASE + image[..., 1] - 1, -1)
        return ids

    def draw(self, camera: Camera, selection: Selection) -> tuple[Pixels, Ids]:
        """Return the picture, and the ids as from `identify`."""
        triangles = self._shown(camera, selection)
        groups = _groups(self._paint_row[triangles], self._painted)
        colors = self._lit(camera.axes[2])[triangles]
        image = self._screen.draw(camera, self._corners[triangles], colors, groups, BACKGROUND_RGB)
        ids = _opacity(image) - 1 if len(self._scene.objects) <= _BASE else self.identify(camera, selection)
        # Pillow is five times faster than numpy in dropping every fourth byte.
        picture = Image.frombuffer("RGB", image.shape[:2], image, "raw", "BGRX", 0, 1)
        return np.array(picture), ids

    def _lit(self, forward: Floats) -> Bytes:
        """Return colours of all triangles (n, 4), seen along `forward`. Cached, since pictures share few directions."""
        key = forward.tobytes()
        if key not in self._lit_along:
            if len(self._lit_along) >= _MOST_DIRECTIONS:
                self._lit_along.clear()
            colors = np.empty((len(self._paint), 4), np.uint8)
            colors[:, :3] = self._paint * light(self._normals, forward, self._scene.up)[:, None]
            colors[:, 3] = self._opacity
            self._lit_along[key] = colors
        return self._lit_along[key]

    def _shown(self, camera: Camera, selection: Selection) -> Ints:
        """Return the triangles that the selection shows and that can colour a pixel, in the order of drawing."""
        triangles = self._visible(camera, selection.shown)
        is_shown = np.zeros(len(self._scene.objects), bool)
        is_shown[list(selection.shown)] = True
        triangles = triangles[is_shown[self._object_of[triangles]]]
        if not selection.opened:
            return triangles
        is_opened = np.zeros(len(self._scene.objects), bool)
        is_opened[list(selection.opened)] = True
        is_hiding = is_opened[self._object_of[triangles]]
        planes_m = self._planes[triangles[is_hiding]]
        is_hiding[is_hiding] = separates(planes_m, camera.eye_m, np.asarray(selection.focus_m))
        return triangles[~is_hiding]

    def _visible(self, camera: Camera, shown: frozenset[int]) -> Ints:
        """Return the triangles that can colour a pixel: of one object if it is shown alone, else of all."""
        if len(shown) == 1:
            triangles = self._triangles_of[next(iter(shown))]
            return triangles[in_view(extents(self._by_axis[..., triangles], camera), camera)]
        if self._view is None or self._view[0] is not camera:
            eye = camera.eye_m.tobytes() + camera.axes.tobytes()
            if self._eye is None or self._eye[0] != eye:
                self._eye = (eye, extents(self._by_axis, camera))
            self._view = (camera, np.flatnonzero(in_view(self._eye[1], camera)))
        return self._view[1]

    def _textured(self, row: int, only_holes: bool = False) -> Any:
        palette = self._scene.palette
        width, height = int(palette.width[row]), int(palette.height[row])
        texels = palette.texels[palette.start[row] : palette.start[row] + width * height].reshape(height, width, 4)
        if only_holes:
            texels = np.dstack((np.full_like(texels[..., :3], 255), texels[..., 3]))
        return textured(texels, bool(palette.is_cutout[row]))


def _groups(rows: Ints, states: dict[int, Any]) -> list[tuple[int, Any]]:
    """Return the ends of the ranges of triangles with one texture, and their state."""
    if not states:
        return [(len(rows), None)]
    ends = [*(np.flatnonzero(rows[1:] != rows[:-1]) + 1).tolist(), len(rows)] if len(rows) else []
    return [(end, states.get(int(rows[end - 1]))) for end in ends]


def _opacity(image: Bytes) -> Ids:
    # Read as 4-byte integers, which numpy shifts ten times faster than it copies every fourth byte.
    opacity: Ids = (image.view("<u4")[..., 0] >> 24).astype(np.int32)
    return opacity
