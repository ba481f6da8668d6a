"""Panda3D geoms as triangles with looks.

Geoms have many layouts, packings and kinds of primitives. Panda3D itself turns each geom into triangles of 32-bit
floats, which are then read as one block of memory.

Source: Panda3D manual, "Internal structures" (GeomVertexData, GeomPrimitive) and "Render attributes".
"""

from __future__ import annotations

import hashlib
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from scene2hap.common.arrays import Bytes, Floats, Floats32, Ints
from scene2hap.scene.looks.appearance import Appearance, FaceMaterial
from scene2hap.scene.tree import Piece

_INDEX = {1: np.uint8, 2: np.uint16, 4: np.uint32}
_WHITE = (1.0, 1.0, 1.0, 1.0)


@dataclass(eq=False)
class GeomReader:
    """Reader of the geoms of one scene graph; `core` is `panda3d.core`. Data that instances share is read once."""

    core: Any
    _shapes: dict[tuple[Any, int, str], _Shape] = field(default_factory=dict)
    _materials: dict[tuple[float | None, ...], FaceMaterial] = field(default_factory=dict)
    _images: dict[Any, Bytes] = field(default_factory=dict)

    def read(self, path: Any) -> list[Piece]:
        """Return the triangles of a NodePath's own node, in its own frame; none if it is no GeomNode.

        Raises: SceneFormatError, SceneError: a face refers to a vertex that does not exist, or a vertex is not finite.
        """
        node = path.node()
        if not isinstance(node, self.core.GeomNode):
            return []
        found = []
        for number in range(node.get_num_geoms()):
            geom = node.get_geom(number)
            if geom.get_primitive_type() != self.core.Geom.PT_polygons:
                continue  # points and lines cannot be touched
            state = path.get_net_state().compose(node.get_geom_state(number))
            stage, texture = self._texture(state)
            shape = self._shape(node, number, "texcoord" if stage is None else str(stage.get_texcoord_name()))
            if not len(shape.faces):
                continue
            place = f"node {path.get_name()!r}, geom {number}"
            material = self._material(state)
            name = "" if material is None else str(material.get_name())
            piece = Piece.checked(shape.key, shape.vertices, shape.faces, name, place)
            found.append(replace(piece, appearance=self._appearance(state, shape, texture)))
        return found

    # -- triangles ---------------------------------------------------------------------------------------------------

    def _shape(self, node: Any, number: int, uv_name: str) -> _Shape:
        key = (node, number, uv_name)
        if key not in self._shapes:
            self._shapes[key] = self._read_shape(node.get_geom(number), uv_name)
        return self._shapes[key]

    def _read_shape(self, geom: Any, uv_name: str) -> _Shape:
        core, data = self.core, geom.get_vertex_data()
        names = {"vertex": 3, uv_name: 2, "color": 4}
        contents = (core.Geom.C_point, core.Geom.C_texcoord, core.Geom.C_color)
        layout = core.GeomVertexArrayFormat()
        for (name, n), content in zip(names.items(), contents, strict=True):
            layout.add_column(core.InternalName.make(name), n, core.Geom.NT_float32, content)
        plain = data.convert_to(core.GeomVertexFormat.register_format(layout))
        rows = np.frombuffer(memoryview(plain.get_array(0)), dtype=np.float32).reshape(-1, layout.get_stride() // 4)
        has_uv, has_colour = (data.has_column(core.InternalName.make(name)) for name in (uv_name, "color"))
        triangles = [self._faces(primitive) for primitive in geom.decompose().get_primitives()]
        faces = np.concatenate([np.empty((0, 3), np.int64), *triangles])
        vertices = rows[:, :3].astype(np.float64)
        # In Panda3D v runs up from the lower edge of a picture.
        uv = np.stack((rows[:, 3], 1 - rows[:, 4]), axis=1) if has_uv else None
        colour = rows[:, 5:9].mean(axis=0).astype(np.float64) if has_colour and len(rows) else None
        return _Shape(_name_of(vertices, faces), vertices, faces, uv, colour)

    def _faces(self, primitive: Any) -> Ints:
        n = primitive.get_num_vertices()
        if primitive.is_indexed():
            array = primitive.get_vertices()
            kind = _INDEX[array.get_array_format().get_stride()]
            order = np.frombuffer(memoryview(array), dtype=kind)[:n].astype(np.int64)
        else:
            order = np.arange(n, dtype=np.int64) + primitive.get_first_vertex()
        return order[: n // 3 * 3].reshape(-1, 3)

    # -- looks -------------------------------------------------------------------------------------------------------

    def _appearance(self, state: Any, shape: _Shape, texture: Any) -> Appearance:
        image = None if shape.uv is None else self._image(texture)
        uv = None if shape.uv is None or image is None else shape.uv[shape.faces]
        r, g, b, a = np.clip(np.round(self._colour(state, shape), 6), 0.0, 1.0).tolist()
        key = (r, g, b, a, None if image is None else id(image))
        return Appearance.plain(
            self._materials.setdefault(key, FaceMaterial((r, g, b, a), image)), len(shape.faces), uv
        )

    def _colour(self, state: Any, shape: _Shape) -> Floats:
        core = self.core
        flat, scale = (state.get_attrib(kind) for kind in (core.ColorAttrib, core.ColorScaleAttrib))
        colour: Any = shape.colour if shape.colour is not None else _WHITE
        if flat is not None and flat.get_color_type() != core.ColorAttrib.T_vertex:
            colour = flat.get_color() if flat.get_color_type() == core.ColorAttrib.T_flat else _WHITE
        material = self._material(state)
        if material is not None and (material.has_base_color() or material.has_diffuse()):
            colour = material.get_base_color() if material.has_base_color() else material.get_diffuse()
        scaled = scale.get_scale() if scale is not None and scale.has_scale() else _WHITE
        return np.array(tuple(colour), dtype=np.float64) * np.array(tuple(scaled), dtype=np.float64)

    def _material(self, state: Any) -> Any | None:
        paint = state.get_attrib(self.core.MaterialAttrib)
        return None if paint is None else paint.get_material()

    def _texture(self, state: Any) -> tuple[Any, Any]:
        """Return the first texture stage that changes the colour, and its texture; (None, None) without."""
        core = self.core
        textures = state.get_attrib(core.TextureAttrib)
        stage_modes = core.TextureStage
        painting = (stage_modes.M_modulate, stage_modes.M_decal, stage_modes.M_replace, stage_modes.M_blend)
        for i in range(0 if textures is None else textures.get_num_on_stages()):
            stage = textures.get_on_stage(i)
            texture = textures.get_on_texture(stage)
            if stage.get_mode() in painting and texture.get_texture_type() == core.Texture.TT_2d_texture:
                return stage, texture
        return None, None

    def _image(self, texture: Any) -> Bytes | None:
        """Return the picture, upper row first; None if Panda3D has released it."""
        if texture is None or not texture.has_ram_image():
            return None
        if texture not in self._images:
            channels = "RGBA" if texture.get_num_components() in (2, 4) else "RGB"
            data = memoryview(texture.get_ram_image_as(channels))
            rows = np.frombuffer(data, dtype=np.uint8).reshape(texture.get_y_size(), texture.get_x_size(), -1)
            self._images[texture] = rows[::-1].copy()
        return self._images[texture]


def _name_of(*arrays: NDArray[Any]) -> str:
    """Return a hash that is equal for equal arrays."""
    content = hashlib.sha256()
    for array in arrays:
        content.update(f"{array.shape}".encode())
        content.update(array.tobytes())
    return content.hexdigest()[:16]


@dataclass(frozen=True, eq=False)
class _Shape:
    """Triangles of one geom: `uv` (n_vertices, 2) as in `Appearance`; `colour` (4,) is the mean of its vertices."""

    key: str
    vertices: Floats
    faces: Ints
    uv: Floats32 | None
    colour: Floats | None
