"""MuJoCo geoms as triangles with looks.

MuJoCo transforms compiled meshes to the frame of their principal inertia, and moves their geoms accordingly. Both
transforms are used unchanged, so together they give the pose that the author gave.

Source: MuJoCo documentation (Google DeepMind), XML reference, `geom`, `mesh`, `texture`, `material`; mjmodel.h.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from scene2hap.common.arrays import Bytes, Floats, Floats32, Ints32
from scene2hap.scene import limits, solids
from scene2hap.scene.looks.appearance import Appearance, FaceMaterial
from scene2hap.scene.pose import Pose
from scene2hap.scene.tree import Piece

_SPHERE, _CAPSULE, _ELLIPSOID, _CYLINDER, _BOX = 2, 3, 4, 5, 6
_PLANE, _TERRAIN = 0, 1
_TEXTURE_2D, _ROLE_RGB = 0, 1
_SOLIDS: dict[int, Callable[[list[float]], solids.Triangles]] = {
    _SPHERE: lambda size: solids.ellipsoid([size[0]] * 3),
    _CAPSULE: lambda size: solids.capsule(size[0], size[1]),
    _ELLIPSOID: solids.ellipsoid,
    _CYLINDER: lambda size: solids.cylinder(size[0], size[1]),
}
# A geom of this colour takes the colour of its material (MuJoCo's default).
_NO_COLOUR = (0.5, 0.5, 0.5, 1.0)
# An infinite plane is cut to this multiple of the model's extent, and to at least this size [model unit]. Assumed:
# moving objects stay above it.
_PLANE_EXTENTS, _MIN_PLANE = 2.0, 5.0
# Bound on the triangles of all geoms: a fixed number, plus a multiple of the stored triangles of meshes (assumed: a
# height field of 1,000 x 1,000, or two thousand spheres).
_FREE_TRIANGLES, _PER_TRIANGLE = 2_000_000, 4.0
_TRIANGLES_OF_A_SOLID = 2 * solids.SIDES**2


class GeomReader:
    """Reader of the geoms of one `MjModel`; materials and textures are read once."""

    def __init__(self, model: Any) -> None:
        self.model = model
        self._colours = colours_rgba(model)
        self._materials: dict[tuple[object, ...], FaceMaterial] = {}
        self._textures: dict[int, Bytes] = {}
        self._drawn = limits.Budget(
            "the triangles of its geoms",
            _FREE_TRIANGLES,
            _PER_TRIANGLE,
            stored=int(model.nmeshface),
            unit="triangles of meshes",
            advice="Draw fewer round geoms, a smaller height field, or fewer copies of large meshes.",
        )

    def piece(self, geom: int) -> Piece:
        """Return the geom in the frame of its body; a geom of the world body in its own frame, as authored.

        Raises: SceneError: its numbers are invalid.
        """
        model = self.model
        kind, mesh = int(model.geom_type[geom]), _mesh(model, geom)
        frame = Pose()
        if model.geom_bodyid[geom] != 0:
            frame = Pose.from_wxyz(model.geom_pos[geom], model.geom_quat[geom])
        elif mesh is not None:
            frame = Pose.from_wxyz(model.mesh_pos[mesh], model.mesh_quat[mesh])
        size = tuple(model.geom_size[geom].tolist())
        key = (kind, int(model.geom_dataid[geom]), size, frame.position_m, frame.rotation_xyzw)
        self._drawn.spend(self._n_triangles(geom), f"geom {geom}")
        vertices, faces = self._shape(geom)
        material = int(model.geom_matid[geom])
        name = model.mat(material).name if material >= 0 else ""
        piece = Piece.checked(key, frame.to_world(vertices), faces, name, f"geom {geom}")
        return replace(piece, appearance=self._appearance(geom, len(faces)), is_made=mesh is None)

    # -- shapes ------------------------------------------------------------------------------------------------------

    def _shape(self, geom: int) -> solids.Triangles:
        """Return triangles in the compiled frame of the geom."""
        model = self.model
        kind, size, mesh = int(model.geom_type[geom]), model.geom_size[geom].tolist(), _mesh(model, geom)
        if kind == _PLANE:
            reach = _PLANE_EXTENTS * model.stat.extent + float(np.linalg.norm(model.stat.center - model.geom_pos[geom]))
            half = [edge if edge > 0 else max(reach, _MIN_PLANE) for edge in size[:2]]
            return solids.rectangle(*half)
        if kind == _TERRAIN:
            return self._terrain(int(model.geom_dataid[geom]))
        if mesh is None:
            return _SOLIDS.get(kind, solids.box)(size)
        first, n = model.mesh_vertadr[mesh], model.mesh_vertnum[mesh]
        return model.mesh_vert[first : first + n].astype(np.float64), self._of_faces(model.mesh_face, mesh)

    def _n_triangles(self, geom: int) -> int:
        """Return an upper bound on the triangles of the geom, before they are made."""
        model, kind, mesh = self.model, int(self.model.geom_type[geom]), _mesh(self.model, geom)
        if kind == _TERRAIN:
            number = int(model.geom_dataid[geom])
            return 2 * int(model.hfield_nrow[number]) * int(model.hfield_ncol[number])
        if mesh is not None:
            return int(model.mesh_facenum[mesh])
        return 12 if kind in (_PLANE, _BOX) else _TRIANGLES_OF_A_SOLID

    def _terrain(self, number: int) -> solids.Triangles:
        model = self.model
        half_x, half_y, top, _ = model.hfield_size[number].tolist()
        n_rows, n_columns = int(model.hfield_nrow[number]), int(model.hfield_ncol[number])
        first = int(model.hfield_adr[number])
        heights = model.hfield_data[first : first + n_rows * n_columns].reshape(n_rows, n_columns)
        return solids.terrain(top * heights.astype(np.float64), half_x, half_y)

    def _of_faces(self, table: Ints32, mesh: int) -> Ints32:
        first, n = self.model.mesh_faceadr[mesh], self.model.mesh_facenum[mesh]
        return table[first : first + n]

    # -- looks -------------------------------------------------------------------------------------------------------

    def _appearance(self, geom: int, n_faces: int) -> Appearance:
        """Return the geom's texture if its mesh has texture coordinates, else the texture's mean colour."""
        model, mesh, texture = self.model, _mesh(self.model, geom), self._texture(geom)
        is_image = texture >= 0 and model.tex_type[texture] == _TEXTURE_2D
        uv = self._texture_coordinates(mesh) if is_image and mesh is not None else None
        colour = self._colours[geom]
        key = (*colour.tolist(), texture, uv is None)
        if key not in self._materials:
            image = self._image(texture) if texture >= 0 else None
            if image is not None and uv is None:
                colour = colour * [*image[..., :3].reshape(-1, 3).mean(axis=0) / 255.0, 1.0]
                image = None
            r, g, b, a = np.clip(colour, 0.0, 1.0).tolist()
            self._materials[key] = FaceMaterial((r, g, b, a), image)
        return Appearance.plain(self._materials[key], n_faces, uv)

    def _texture(self, geom: int) -> int:
        """Return the number of the colour texture, -1 for none."""
        material = int(self.model.geom_matid[geom])
        return int(self.model.mat_texid[material, _ROLE_RGB]) if material >= 0 else -1

    def _texture_coordinates(self, mesh: int) -> Floats32 | None:
        first = int(self.model.mesh_texcoordadr[mesh])
        if first < 0:
            return None
        uv: Floats32 = self.model.mesh_texcoord[first + self._of_faces(self.model.mesh_facetexcoord, mesh)]
        return uv

    def _image(self, texture: int) -> Bytes:
        if texture not in self._textures:
            model = self.model
            height, width = int(model.tex_height[texture]), int(model.tex_width[texture])
            n, first = int(model.tex_nchannel[texture]), int(model.tex_adr[texture])
            image = model.tex_data[first : first + height * width * n].reshape(height, width, n)
            self._textures[texture] = image.copy() if n >= 3 else np.repeat(image[..., :1], 3, axis=-1)
        return self._textures[texture]


def colours_rgba(model: Any) -> Floats:
    """Return the geoms' own colours (n_geoms, 4) [-]; geoms without one have the colour of their material."""
    colours: Floats = model.geom_rgba.astype(np.float64)
    borrows = (model.geom_matid >= 0) & (model.geom_rgba == _NO_COLOUR).all(axis=1)
    colours[borrows] = model.mat_rgba[model.geom_matid[borrows]]
    return colours


def _mesh(model: Any, geom: int) -> int | None:
    """Return the number of a geom's mesh, None for other shapes."""
    number = int(model.geom_dataid[geom])
    return number if number >= 0 and model.geom_type[geom] > _BOX else None


def authored_pose(model: Any, geom: int) -> Pose:
    """Return the pose of a geom of the world body, without the frame that the compiler gave to its mesh."""
    compiled = Pose.from_wxyz(model.geom_pos[geom], model.geom_quat[geom])
    mesh = _mesh(model, geom)
    if mesh is None:
        return compiled
    return compiled.compose(Pose.from_wxyz(model.mesh_pos[mesh], model.mesh_quat[mesh]).inverse())
