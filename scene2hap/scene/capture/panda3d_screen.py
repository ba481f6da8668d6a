"""Rasterisation of triangles by p3tinydisplay: the part of the renderer that uses Panda3D."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any
from weakref import finalize

import numpy as np
from panda3d import core
from PIL import Image

from scene2hap.common.arrays import Bytes, Floats32
from scene2hap.errors import BackendUnavailable
from scene2hap.scene.capture.views import Camera

# Depth range as shares of the scene's diagonal. The nearer the range begins, the better this rasteriser resolves depths
# (tuned: from 0.01 on, a carpet 1 mm over the floor is lost).
_NEAR, _FAR = 1e-3, 8.0


# Colours of triangles as they are stored, visible from both sides, drawn in the given order.
_PLAIN: Any = core.RenderState.make(
    core.ColorAttrib.make_vertex(),
    core.ShadeModelAttrib.make(core.ShadeModelAttrib.M_flat),
    core.CullFaceAttrib.make(core.CullFaceAttrib.M_cull_none),
    core.CullBinAttrib.make("unsorted", 0),
)


def textured(texels: Bytes, has_holes: bool) -> Any:
    """Return the `RenderState` that multiplies colours of triangles by a texture (height, width, 4), RGBA.

    It is opaque, except for holes if `has_holes`.
    """
    height, width = texels.shape[:2]
    # The rasteriser accepts only powers of two.
    size = tuple(1 << max(0, round(np.log2(edge))) for edge in (width, height))
    image = np.array(Image.fromarray(texels).resize(size, Image.Resampling.BOX))[::-1, :, [2, 1, 0, 3]]
    image[..., 3] = np.where(image[..., 3] < 128, 0, 255) if has_holes else 255
    texture = core.Texture()
    texture.setup_2d_texture(*size, core.Texture.T_unsigned_byte, core.Texture.F_rgba)
    texture.set_ram_image(np.ascontiguousarray(image).tobytes())
    texture.set_wrap_u(core.SamplerState.WM_repeat)
    texture.set_wrap_v(core.SamplerState.WM_repeat)
    texture.set_minfilter(core.SamplerState.FT_nearest)
    texture.set_magfilter(core.SamplerState.FT_nearest)
    state = _PLAIN.set_attrib(core.TextureAttrib.make(texture))
    return state.set_attrib(core.AlphaTestAttrib.make(core.AlphaTestAttrib.M_greater, 0.0)) if has_holes else state


class Screen:
    """Off-screen buffers that show triangles of a scene with the diagonal `reach_m`."""

    def __init__(self, reach_m: float) -> None:
        self._engine = core.GraphicsEngine.get_global_ptr()
        # The module's default pipe needs an X server.
        self._pipe = core.GraphicsPipeSelection.get_global_ptr().make_pipe("TinyOffscreenGraphicsPipe", "p3tinydisplay")
        if self._pipe is None:
            raise BackendUnavailable("Panda3D's p3tinydisplay does not load. Install libx11-6, or choose 'embree'.")
        self._lens = core.PerspectiveLens()
        self._lens.set_near_far(_NEAR * reach_m, _FAR * reach_m)
        self._lens.set_focal_length(1.0)
        self._node = core.GeomNode("triangles")
        # Culling is done already, and Panda3D would compute bounds for every picture.
        self._node.set_bounds(core.OmniBoundingVolume())
        self._node.set_final(True)
        root = core.NodePath("root")
        root.attach_new_node(self._node)
        self._eye = root.attach_new_node(core.Camera("eye", self._lens))
        self._layout = _layout()
        self._buffers: dict[int, tuple[Any, Any]] = {}
        finalize(self, _close, self._engine, self._buffers)

    def draw(
        self,
        camera: Camera,
        corners: Floats32,
        colors: Bytes,
        groups: Sequence[tuple[int, Any]],
        background: tuple[int, int, int],
    ) -> Bytes:
        """Return blue, green, red and opacity of pixels (size_px, size_px, 4). Opacity is 0 without a triangle.

        Parameters: corners : (n, 3, 5), positions [m] and texture coordinates; colors : (n, 4), RGBA; groups : ends of
            ranges of triangles, and their state from `textured`, None for no texture.
        """
        vertices = core.GeomVertexData("", self._layout, core.Geom.UH_static)
        vertices.unclean_set_num_rows(3 * len(corners))
        vertices.modify_array_handle(0).copy_data_from(corners)
        vertices.modify_array_handle(1).copy_data_from(np.repeat(colors, 3, axis=0))
        self._node.remove_all_geoms()
        begin = 0
        for end, state in groups:
            primitive = core.GeomTriangles(core.Geom.UH_static)
            primitive.add_consecutive_vertices(3 * begin, 3 * (end - begin))
            geom = core.Geom(vertices)
            geom.add_primitive(primitive)
            geom.set_bounds(core.OmniBoundingVolume())
            self._node.add_geom(geom, _PLAIN if state is None else state)
            begin = end
        self._aim(camera)
        buffer, texture = self._buffer(camera.size_px)
        buffer.set_clear_color(core.LColor(*(channel / 255 for channel in background), 0.0))
        # The engine is global and draws all active buffers of this process.
        buffer.set_active(True)
        self._engine.render_frame()
        buffer.set_active(False)
        image = np.frombuffer(texture.get_ram_image(), np.uint8).reshape(camera.size_px, camera.size_px, 4)
        return np.ascontiguousarray(image[::-1])

    def _aim(self, camera: Camera) -> None:
        self._lens.set_film_size(2 * camera.half, 2 * camera.half)
        self._lens.set_film_offset(*camera.centre.tolist())
        right, up, forward = camera.axes
        # Panda3D looks along y with z up, and its vectors are rows.
        placed = np.eye(4)
        placed[:3, :3], placed[3, :3] = (right, forward, up), camera.eye_m
        self._eye.set_mat(core.LMatrix4f(*placed.ravel().tolist()))

    def _buffer(self, size_px: int) -> tuple[Any, Any]:
        if size_px not in self._buffers:
            wanted = core.FrameBufferProperties()
            wanted.set_rgb_color(True)
            wanted.set_alpha_bits(8)
            wanted.set_depth_bits(24)
            size, flags = core.WindowProperties.size(size_px, size_px), core.GraphicsPipe.BF_refuse_window
            buffer = self._engine.make_output(self._pipe, "pictures", 0, wanted, size, flags)
            if buffer is None:
                raise BackendUnavailable(f"Panda3D opens no buffer of {size_px} pixels. Choose the renderer 'embree'.")
            texture = core.Texture()
            buffer.add_render_texture(texture, core.GraphicsOutput.RTM_copy_ram)
            buffer.make_display_region().set_camera(self._eye)
            self._buffers[size_px] = (buffer, texture)
        return self._buffers[size_px]


def _close(engine: Any, buffers: dict[int, tuple[Any, Any]]) -> None:
    for buffer, _ in buffers.values():
        engine.remove_window(buffer)
    buffers.clear()


def _layout() -> Any:
    """Return the format of two arrays: positions with texture coordinates, and colours."""
    places, colors = core.GeomVertexArrayFormat(), core.GeomVertexArrayFormat()
    places.add_column(core.InternalName.get_vertex(), 3, core.Geom.NT_float32, core.Geom.C_point)
    places.add_column(core.InternalName.get_texcoord(), 2, core.Geom.NT_float32, core.Geom.C_texcoord)
    colors.add_column(core.InternalName.get_color(), 4, core.Geom.NT_uint8, core.Geom.C_color)
    layout = core.GeomVertexFormat()
    layout.add_array(places)
    layout.add_array(colors)
    return core.GeomVertexFormat.register_format(layout)
