"""Pictures by ray casting with Intel Embree: exact ids in the same pass, and no system package.

One search tree over the whole scene is built once. Objects that a picture leaves out stay in the tree; rays that hit
them continue behind them. Only opened shells are left out of the tree, since half of a picture's rays would have to
pass them. A second tree holds the few large faces of shells that remain in this view. Isolated objects have trees of
their own. Embree uses single precision; a ray continues a little behind the surface that it passed, so that it does not
hit the surface again.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from embreex.mesh_construction import TriangleMesh
from embreex.rtcore_scene import EmbreeScene

from scene2hap.common.arrays import Bools, Bytes, Floats, Floats32, Ints
from scene2hap.scene.capture.colour_table import BACKGROUND_RGB, light
from scene2hap.scene.capture.faces import planes, separates
from scene2hap.scene.capture.protocol import Ids, Pixels, Selection
from scene2hap.scene.capture.render_scene import RenderScene
from scene2hap.scene.capture.views import Camera
from scene2hap.scene.geometry import corners_of

# Step behind a passed hit, as a share of its depth and of the scene's size: some ulps of float32 (tuned).
_STEP_OF_DEPTH, _STEP_OF_SCENE = 1e-6, 1e-6
# Most hits that one ray passes; after them, the ray hits nothing (assumed: no scene is that deep).
_MAX_PASSES = 512
# Pictures of at most this many objects use the objects' own trees.
_FEW = 2
# Opened objects of at most this many triangles are left out of the tree (tuned: 5 ms to build the second tree).
_LIGHT = 4096
# Most cached trees over more than one object; each takes about 150 bytes a triangle (assumed).
_LARGE_TREES = 4
# A pixel is smoothed if a channel differs from the next pixel's by more than this, of 255 (tuned by eye).
_VISIBLE_STEP = 24
# Offsets [px] of the added rays from the middle of a smoothed pixel. The pixel's colour is the mean of these rays and
# the ray in its middle, so that level, upright and slanted edges all get three steps (assumed).
_ADDED_RAYS = ((-0.33, 0.17), (0.17, -0.33))


@dataclass(frozen=True, eq=False)
class _Hits:
    """Hits of rays: triangle (n,) of the scene, -1 for none; depth (n,) [m]; weights (2, n) of corners 2 and 3."""

    triangle: Ints
    depth: Floats32
    weights: Floats32


@dataclass(frozen=True, eq=False)
class _Tree:
    """A search tree over some triangles; `numbers` are their numbers in the `RenderScene`, then -1 for no triangle."""

    scene: Any
    numbers: Ints

    def cast(self, origins: Floats32, directions: Floats32) -> _Hits:
        """Return the first hits of rays; depths are measured from their origins."""
        run = self.scene.run(origins, directions, output=True)
        return _Hits(self.numbers.take(run["primID"]), run["tfar"], np.stack((run["u"], run["v"])))


class EmbreeRenderer:
    """Render a scene by ray casting, with smooth edges; the default. See `Renderer`."""

    def __init__(self, scene: RenderScene, antialias: bool = False) -> None:
        self._scene = scene
        self._antialias = antialias
        counts = [len(item.triangles_m) for item in scene.objects]
        self._first = np.cumsum([0, *counts])
        # The last entry is for triangle -1, which is no triangle.
        self._object_of = np.append(np.repeat(np.arange(len(counts), dtype=np.int32), counts), np.int32(-1))
        self._corners = np.concatenate([item.triangles_m for item in scene.objects])
        self._material = np.concatenate([item.material for item in scene.objects])
        uv = np.concatenate([item.uv for item in scene.objects]).transpose(2, 1, 0)
        # In one piece, since `take` copies the whole of any other array, at each call.
        self._uv = np.ascontiguousarray(np.stack((uv[:, 0], uv[:, 1] - uv[:, 0], uv[:, 2] - uv[:, 0]), axis=1))
        self._paint = scene.palette.rgb[self._material] * 255
        self._is_patterned = np.append(scene.palette.is_patterned[self._material], False)
        self._has_cutouts = bool(scene.palette.is_cutout.any())
        self._trees: dict[frozenset[int], _Tree] = {}
        self._light = frozenset(k for k, count in enumerate(counts) if count <= _LIGHT)
        self._cut: tuple[object, list[_Tree]] = (None, [])
        # All rays of a picture share an eye, but Embree needs an origin for each ray, so the array is reused.
        self._origins = np.empty((0, 3), np.float32)
        self._step = scene.diagonal_m * _STEP_OF_SCENE

    def identify(self, camera: Camera, selection: Selection) -> Ids:
        """Return the object at the middle of each pixel."""
        pixels = self._covered(camera, selection)
        return self._ids(camera, pixels, self._cast(camera, camera.directions(pixels), selection))

    def draw(self, camera: Camera, selection: Selection) -> tuple[Pixels, Ids]:
        """Return the picture, and the ids as from `identify`."""
        pixels = self._covered(camera, selection)
        directions = camera.directions(pixels)
        hits = self._cast(camera, directions, selection)
        ids = self._ids(camera, pixels, hits)
        colors = self._colors(camera, hits)
        picture = colors
        if len(pixels) < camera.size_px**2:
            picture = np.full((camera.size_px**2, 3), BACKGROUND_RGB, np.uint8)
            picture[pixels] = colors
        if self._antialias:
            edges = np.flatnonzero(_edges(picture.reshape(camera.size_px, camera.size_px, 3)))
            finer = np.concatenate([camera.directions(edges, offset) for offset in _ADDED_RAYS])
            added = self._colors(camera, self._cast(camera, finer, selection)).reshape(len(_ADDED_RAYS), -1, 3)
            total = added.sum(axis=0, dtype=np.uint16) + picture[edges]
            picture[edges] = (total + 2) // (len(_ADDED_RAYS) + 1)
        return picture.reshape(camera.size_px, camera.size_px, 3), ids

    def _covered(self, camera: Camera, selection: Selection) -> Ints:
        """Return the numbers of the pixels that the selection can cover."""
        few = len(selection.shown) <= _FEW
        boxes = [self._scene.objects[k].box_m for k in selection.shown] if few else [self._scene.box_m]
        is_covered = np.zeros((camera.size_px, camera.size_px), bool)
        for box in boxes:
            top, bottom, left, right = camera.window_of(corners_of(box))
            is_covered[top:bottom, left:right] = True
        return np.flatnonzero(is_covered)

    def _cast(self, camera: Camera, directions: Floats32, selection: Selection) -> _Hits:
        """Return the first hits on objects that the selection shows."""
        passed = self._passed(camera, selection)
        if len(selection.shown) <= _FEW:
            trees = [self._tree(frozenset({number})) for number in sorted(selection.shown)]
        else:
            apart = selection.opened & selection.shown & self._light
            trees = [
                self._tree(self._scene.everyone - apart),
                *self._faces_left(apart, camera, selection, passed),
            ]
        found = [self._first_hits(tree, camera, directions, passed) for tree in trees]
        return _nearest(found) if found else _nothing(len(directions))

    def _first_hits(self, tree: _Tree, camera: Camera, directions: Floats32, passed: Bools | None) -> _Hits:
        """Return the first hits that are not passed."""
        eye = camera.eye_m.astype(np.float32)
        if len(self._origins) < len(directions) or (self._origins[:1] != eye).any():
            self._origins = np.tile(eye, (len(directions), 1))
        hits = tree.cast(self._origins[: len(directions)], directions)
        rays = np.flatnonzero(self._is_passed(hits, passed))
        for _ in range(_MAX_PASSES):
            if not len(rays):
                break
            start = hits.depth[rays] * np.float32(1 + _STEP_OF_DEPTH) + np.float32(self._step)
            ahead = directions.take(rays, axis=0)
            further = tree.cast(eye + ahead * start[:, None], ahead)
            hits.triangle[rays] = further.triangle
            hits.depth[rays] = start + further.depth
            hits.weights[:, rays] = further.weights
            rays = rays[self._is_passed(further, passed)]
        hits.triangle[rays] = -1
        return hits

    def _is_passed(self, hits: _Hits, passed: Bools | None) -> Bools:
        """Return a mask of the rays to continue: their hit is not shown, or is in a hole of a texture."""
        triangle = hits.triangle
        is_passed = np.zeros(len(triangle), bool) if passed is None else passed.take(triangle)
        if self._has_cutouts:
            palette, material = self._scene.palette, self._material[triangle]
            holed = np.flatnonzero(palette.is_cutout[material] & (triangle >= 0) & ~is_passed)
            texel = palette.texel(material[holed], self._uv_at(triangle[holed], hits.weights[:, holed]))
            is_passed[holed] = palette.texels[texel, 3] < 128
        return is_passed

    def _passed(self, camera: Camera, selection: Selection) -> Bools | None:
        """Return a mask of the triangles that the selection hides; None if it shows all. The last entry is for no
        triangle."""
        if not selection.opened and selection.shown == self._scene.everyone:
            return None
        is_left_out = np.ones(len(self._scene.objects) + 1, bool)
        is_left_out[[*selection.shown, -1]] = False
        passed = is_left_out[self._object_of]
        for number in selection.opened & selection.shown:
            own = slice(self._first[number], self._first[number + 1])
            passed[own] = separates(self._planes[own], camera.eye_m, np.asarray(selection.focus_m))
        return passed

    def _colors(self, camera: Camera, hits: _Hits) -> Bytes:
        """Return the colour of each ray."""
        # The light comes along the view, so each triangle has one brightness per view. Only triangles that are hit get
        # a colour, since a picture shows few triangles of a large scene. The last row is for no triangle.
        is_hit = np.zeros(len(self._paint) + 1, bool)
        is_hit[hits.triangle] = True
        hit = np.flatnonzero(is_hit[:-1])
        paint = np.empty((len(is_hit), 3))
        paint[hit] = self._paint[hit] * light(self._normals[hit], camera.axes[2], self._scene.up)[:, None]
        paint[-1] = BACKGROUND_RGB
        colors = paint.take(hits.triangle, axis=0).astype(np.uint8)
        patterned = np.flatnonzero(self._is_patterned.take(hits.triangle))
        triangle = hits.triangle[patterned]
        pattern = self._scene.palette.pattern(
            self._material.take(triangle), self._uv_at(triangle, hits.weights[:, patterned])
        )
        colors[patterned] = paint.take(triangle, axis=0) * pattern
        return colors

    def _uv_at(self, triangle: Ints, weights: Floats32) -> Floats32:
        # Column by column, since numpy is six times slower along rows of two.
        u, v = (
            corner.take(triangle) + weights[0] * to_second.take(triangle) + weights[1] * to_third.take(triangle)
            for corner, to_second, to_third in self._uv
        )
        return np.stack((u, v), axis=1)

    def _ids(self, camera: Camera, pixels: Ints, hits: _Hits) -> Ids:
        ids = np.full(camera.size_px**2, -1, np.int32)
        ids[pixels] = self._object_of.take(hits.triangle)
        return ids.reshape(camera.size_px, camera.size_px)

    def _tree(self, objects: frozenset[int]) -> _Tree:
        """Return the tree over whole objects, built at the first use. Of those over several, the last used are kept."""
        tree = self._trees.pop(objects, None)
        if tree is None:
            large = [known for known in self._trees if len(known) > 1]
            if len(objects) > 1 and len(large) >= _LARGE_TREES:
                del self._trees[large[0]]
            tree = self._built(np.flatnonzero(np.isin(self._object_of, list(objects))))
        self._trees[objects] = tree  # at the end: the first is the one that was not used for the longest time
        return tree

    def _faces_left(
        self, objects: frozenset[int], camera: Camera, selection: Selection, passed: Bools | None
    ) -> list[_Tree]:
        """Return a tree over the visible faces of opened objects. The last one is cached, since a view needs it several
        times."""
        view = (objects, camera.eye_m.tobytes(), selection.focus_m)
        if passed is None or not objects:
            return []
        if self._cut[0] != view:
            left = np.flatnonzero(np.isin(self._object_of, list(objects)) & ~passed)
            self._cut = (view, [self._built(left)] if len(left) else [])
        return self._cut[1]

    def _built(self, numbers: Ints) -> _Tree:
        scene = EmbreeScene()
        TriangleMesh(scene, np.ascontiguousarray(self._corners[numbers]))
        return _Tree(scene, np.append(numbers, -1))

    @cached_property
    def _planes(self) -> Floats:
        return planes(self._corners)

    @cached_property
    def _normals(self) -> Floats32:
        return self._planes[:, :3].astype(np.float32)


def _nothing(n_rays: int) -> _Hits:
    return _Hits(np.full(n_rays, -1, np.int64), np.full(n_rays, np.inf, np.float32), np.zeros((2, n_rays), np.float32))


def _nearest(found: list[_Hits]) -> _Hits:
    """Return the nearer hit of each ray."""
    best = found[0]
    for other in found[1:]:
        is_nearer = (other.triangle >= 0) & ((best.triangle < 0) | (other.depth < best.depth))
        best = _Hits(
            np.where(is_nearer, other.triangle, best.triangle),
            np.where(is_nearer, other.depth, best.depth),
            np.where(is_nearer, other.weights, best.weights),
        )
    return best


def _edges(picture: Pixels) -> Bools:
    """Return a mask of pixels that differ visibly from their right or lower neighbour, and of these neighbours."""
    is_edge = np.zeros(picture.shape[:2], bool)
    across, down = is_edge[:, 1:].copy(), is_edge[1:].copy()
    for level in np.moveaxis(picture, 2, 0):
        level = np.ascontiguousarray(level)
        across |= _distance(level[:, 1:], level[:, :-1]) > _VISIBLE_STEP
        down |= _distance(level[1:], level[:-1]) > _VISIBLE_STEP
    is_edge[:, 1:] |= across
    is_edge[:, :-1] |= across
    is_edge[1:] |= down
    is_edge[:-1] |= down
    return is_edge


def _distance(one: Bytes, other: Bytes) -> Bytes:
    return np.maximum(one, other) - np.minimum(one, other)
