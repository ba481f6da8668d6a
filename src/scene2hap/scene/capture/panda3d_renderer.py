"""Pictures by Panda3D's software rasteriser (p3tinydisplay): several times faster, without smooth edges.

It needs no graphics card, and of system packages libx11-6 alone. Ids take a second pass, in which every actor has a
colour of its own; the rasteriser truncates colours, so that half a step is added. Light is baked into the colours of
the corners for each view, so that pictures look like those of ray casting.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any
from weakref import finalize

import numpy as np
from numpy.typing import NDArray
from panda3d import core
from PIL import Image

from scene2hap.errors import BackendUnavailable
from scene2hap.scene.capture.faces import planes, separates
from scene2hap.scene.capture.paint import BACKGROUND_RGB, light
from scene2hap.scene.capture.protocol import Ids, Pixels, Selection
from scene2hap.scene.capture.stage import Actor, Stage
from scene2hap.scene.capture.views import Camera

# Depth range as parts of the scene's diagonal. This rasteriser tells depths apart the better, the nearer it begins
# (tuned: from 0.01 on, a carpet 1 mm over the floor is lost).
_NEAR, _FAR = 1e-3, 8.0


@dataclass(eq=False)
class _Model:
    """An actor in the scene graph: vertices per face for light, welded ones for ids, triangles by material."""

    vertices: Any
    welded: Any
    corners: NDArray[np.uint32]
    by_material: dict[int, NDArray[np.int64]]
    planes_m: NDArray[np.float64]
    paint: NDArray[np.float32]
    lit: Any
    flat: Any


class Panda3DRenderer:
    """Draws a stage with a software rasteriser. See `Renderer`; smooth edges are not to be had."""

    def __init__(self, stage: Stage, antialias: bool = False) -> None:
        self._stage = stage
        self._engine = core.GraphicsEngine.get_global_ptr()
        selection = core.GraphicsPipeSelection.get_global_ptr()
        # The module's default wants an X server.
        self._pipe = selection.make_pipe("TinyOffscreenGraphicsPipe", "p3tinydisplay")
        if self._pipe is None:
            raise BackendUnavailable("Panda3D's p3tinydisplay does not load. Install libx11-6, or choose 'embree'.")
        self._reach_m = float(np.linalg.norm(np.ptp(stage.box_m, axis=0)))
        self._textures = {row: self._texture(row) for row in np.flatnonzero(stage.palette.is_patterned).tolist()}
        self._lit, self._flat = core.NodePath("lit"), core.NodePath("flat")
        for root in (self._lit, self._flat):
            root.set_two_sided(True)
            root.set_light_off()
        self._models = [self._model(number, actor) for number, actor in enumerate(stage.actors)]
        self._opened: set[int] = set()
        self._buffers: dict[int, tuple[Any, Any, Any]] = {}
        finalize(self, _close, self._engine, self._buffers)

    def identify(self, camera: Camera, selection: Selection) -> Ids:
        """The actor that each pixel's middle shows."""
        self._select(camera, selection)
        code = self._render(camera, self._flat, (1.0, 1.0, 1.0)).astype(np.int32)
        ids = code[..., 0] + 256 * code[..., 1]
        return np.where(ids == 0xFFFF, -1, ids).astype(np.int32)

    def draw(self, camera: Camera, selection: Selection) -> tuple[Pixels, Ids]:
        """The picture, and the ids as `identify` tells them."""
        ids = self.identify(camera, selection)
        for number in selection.shown:
            model = self._models[number]
            brightness = light(model.planes_m[:, :3].astype(np.float32), camera.axes[2], self._stage.up)
            colors = np.full((len(brightness), 3, 4), 255, np.uint8)
            colors[:, :, :3] = (model.paint * brightness[:, None])[:, None]
            model.vertices.modify_array_handle(1).copy_data_from(colors.tobytes())
        background = tuple((channel + 0.5) / 255 for channel in BACKGROUND_RGB)
        return np.ascontiguousarray(self._render(camera, self._lit, background)), ids

    def _select(self, camera: Camera, selection: Selection) -> None:
        """Show what is selected, opened actors with the faces that they keep."""
        for number, model in enumerate(self._models):
            for node in (model.lit, model.flat):
                node.show() if number in selection.shown else node.hide()
            if number in selection.opened:
                kept = ~separates(model.planes_m, camera.eye_m, np.asarray(selection.focus_m))
                self._set_geoms(model, kept)
                self._opened.add(number)
            elif number in self._opened:
                self._set_geoms(model, None)
                self._opened.remove(number)

    def _set_geoms(self, model: _Model, kept: NDArray[np.bool_] | None) -> None:
        lit, flat = model.lit.node(), model.flat.node()
        lit.remove_all_geoms()
        flat.remove_all_geoms()
        for row, triangles in model.by_material.items():
            shown = triangles if kept is None else triangles[kept[triangles]]
            if not len(shown):
                continue
            own_corners = (3 * shown[:, None] + np.arange(3)).astype(np.uint32)
            flat.add_geom(_geom(model.welded, model.corners[shown]))
            state = core.RenderState.make(core.ColorAttrib.make_vertex())
            if row in self._textures:
                state = state.set_attrib(core.TextureAttrib.make(self._textures[row]))
            if self._stage.palette.is_cutout[row]:
                state = state.set_attrib(core.TransparencyAttrib.make(core.TransparencyAttrib.M_binary))
            lit.add_geom(_geom(model.vertices, own_corners), state)

    def _model(self, number: int, actor: Actor) -> _Model:
        places = core.GeomVertexArrayFormat()
        places.add_column(core.InternalName.get_vertex(), 3, core.Geom.NT_float32, core.Geom.C_point)
        places.add_column(core.InternalName.get_texcoord(), 2, core.Geom.NT_float32, core.Geom.C_texcoord)
        colors = core.GeomVertexArrayFormat()
        colors.add_column(core.InternalName.get_color(), 4, core.Geom.NT_uint8, core.Geom.C_color)
        # Panda's textures start below.
        uv = np.stack((actor.uv[..., 0], 1 - actor.uv[..., 1]), axis=2)
        rows = np.concatenate((actor.triangles_m, uv), axis=2).reshape(-1, 5)
        white = np.full((len(rows), 4), 255, np.uint8)
        points, corners = np.unique(actor.triangles_m.reshape(-1, 3), axis=0, return_inverse=True)
        model = _Model(
            _vertex_data((places, rows), (colors, white)),
            _vertex_data((core.GeomVertexFormat.get_v3().get_array(0), points)),
            corners.reshape(-1, 3).astype(np.uint32),
            {int(row): np.flatnonzero(actor.material == row) for row in np.unique(actor.material)},
            planes(actor.triangles_m),
            self._stage.palette.rgb[actor.material] * 255,
            self._lit.attach_new_node(core.GeomNode("lit")),
            self._flat.attach_new_node(core.GeomNode("flat")),
        )
        model.flat.set_color((number % 256 + 0.5) / 255, (number // 256 + 0.5) / 255, 0.0, 1.0)
        self._set_geoms(model, None)
        return model

    def _texture(self, row: int) -> Any:
        palette = self._stage.palette
        width, height = int(palette.width[row]), int(palette.height[row])
        texels = palette.texels[palette.start[row] : palette.start[row] + width * height].reshape(height, width, 4)
        # The rasteriser takes powers of two alone.
        size = tuple(1 << max(0, round(np.log2(edge))) for edge in (width, height))
        flipped = np.asarray(Image.fromarray(texels).resize(size, Image.Resampling.BOX))[::-1, :, [2, 1, 0, 3]]
        texture = core.Texture(f"row {row}")
        texture.setup_2d_texture(*size, core.Texture.T_unsigned_byte, core.Texture.F_rgba)
        texture.set_ram_image(np.ascontiguousarray(flipped).tobytes())
        texture.set_wrap_u(core.SamplerState.WM_repeat)
        texture.set_wrap_v(core.SamplerState.WM_repeat)
        texture.set_minfilter(core.SamplerState.FT_nearest)
        texture.set_magfilter(core.SamplerState.FT_nearest)
        return texture

    def _render(self, camera: Camera, root: Any, background: tuple[float, ...]) -> NDArray[np.uint8]:
        """Pixels (size_px, size_px, 3) of one pass."""
        buffer, texture, eye = self._buffer(camera.size_px)
        lens = core.PerspectiveLens()
        lens.set_near_far(_NEAR * self._reach_m, _FAR * self._reach_m)
        lens.set_focal_length(1.0)
        lens.set_film_size(2 * camera.half, 2 * camera.half)
        lens.set_film_offset(*camera.centre.tolist())
        eye.node().set_lens(lens)
        right, up, forward = camera.axes
        # Panda looks along y with z up, and multiplies rows.
        placed = np.eye(4)
        placed[:3, :3], placed[3, :3] = (right, forward, up), camera.eye_m
        eye.reparent_to(root)
        eye.set_mat(core.LMatrix4f(*placed.ravel().tolist()))
        buffer.set_clear_color(core.LColor(*background, 1.0))
        self._engine.render_frame()
        image = np.frombuffer(texture.get_ram_image(), np.uint8).reshape(camera.size_px, camera.size_px, -1)
        pixels: NDArray[np.uint8] = image[::-1, :, 2::-1]
        eye.detach_node()
        return pixels

    def _buffer(self, size_px: int) -> tuple[Any, Any, Any]:
        for size, (buffer, _, _) in self._buffers.items():
            buffer.set_active(size == size_px)
        if size_px not in self._buffers:
            wanted = core.FrameBufferProperties()
            wanted.set_rgb_color(True)
            wanted.set_depth_bits(24)
            buffer = self._engine.make_output(
                self._pipe,
                "pictures",
                0,
                wanted,
                core.WindowProperties.size(size_px, size_px),
                core.GraphicsPipe.BF_refuse_window,
            )
            if buffer is None:
                raise BackendUnavailable(f"Panda3D opens no buffer of {size_px} pixels. Choose the renderer 'embree'.")
            texture = core.Texture()
            buffer.add_render_texture(texture, core.GraphicsOutput.RTM_copy_ram)
            eye = core.NodePath(core.Camera("eye"))
            buffer.make_display_region().set_camera(eye)
            self._buffers[size_px] = (buffer, texture, eye)
        return self._buffers[size_px]


def _close(engine: Any, buffers: dict[int, tuple[Any, Any, Any]]) -> None:
    for buffer, _, _ in buffers.values():
        engine.remove_window(buffer)
    buffers.clear()


def _vertex_data(*arrays: tuple[Any, NDArray[Any]]) -> Any:
    """Vertices whose columns stand in several arrays, each a layout and its rows."""
    layout = core.GeomVertexFormat()
    for part, _ in arrays:
        layout.add_array(part)
    vertices = core.GeomVertexData("", core.GeomVertexFormat.register_format(layout), core.Geom.UH_dynamic)
    vertices.unclean_set_num_rows(len(arrays[0][1]))
    for number, (_, rows) in enumerate(arrays):
        vertices.modify_array_handle(number).copy_data_from(np.ascontiguousarray(rows).tobytes())
    return vertices


def _geom(vertices: Any, corners: NDArray[np.uint32]) -> Any:
    primitive = core.GeomTriangles(core.Geom.UH_static)
    primitive.set_index_type(core.Geom.NT_uint32)
    primitive.modify_vertices(corners.size).modify_handle().copy_data_from(corners.tobytes())
    geom = core.Geom(vertices)
    geom.add_primitive(primitive)
    return geom
