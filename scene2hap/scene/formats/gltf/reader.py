"""glTF and GLB files as authored trees.

Nodes are identified by their number in the file, so an object stays the same on every load, even if its name changes.
Cameras, lights, animations and hidden nodes are left out. Skinned meshes and morph targets have their stored pose
(`gltf.deformation`). Each copy of an instanced mesh is a node.

Source: glTF 2.0 specification, sections 3.5 (scenes and nodes) and 3.7 (meshes); KHR_node_visibility.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np

from scene2hap.common import checks
from scene2hap.common.arrays import Floats, Ints
from scene2hap.errors import SceneError, SceneFormatError
from scene2hap.scene import limits
from scene2hap.scene.formats.gltf.accessors import indices, vectors
from scene2hap.scene.formats.gltf.container import GltfFile, Json, mapping, natural
from scene2hap.scene.formats.gltf.deformation import Deformation, Deformations
from scene2hap.scene.formats.gltf.draco import DRACO, draco
from scene2hap.scene.formats.gltf.instances import INSTANCES, instances
from scene2hap.scene.formats.gltf.materials import GltfMaterials, TexturedMaterial
from scene2hap.scene.looks.appearance import Appearance, FaceMaterial, painted, srgb
from scene2hap.scene.looks.texture_files import TextureFiles
from scene2hap.scene.pose import Pose
from scene2hap.scene.tree import AuthoredNode, AuthoredScene, Matrix, Piece, transform

_TRIANGLES, _STRIP, _FAN = 4, 5, 6
_FLOAT = 5126
# Vertex colours above this do not change a material.
_NEARLY_WHITE = 0.999

_Attribute = Callable[[str, tuple[str, ...]], Floats]
"""Function from an attribute's name and its allowed types to the attribute's values (n, columns) in a primitive."""


def read_gltf(path: Path, assets_root: Path) -> AuthoredScene:
    """Return the file's default scene with its looks.

    Raises: SceneFormatError, SceneError: the file is broken, has a reference to something missing, or needs an
    extension that cannot be read.
    """
    file = GltfFile(path, assets_root)
    textures = TextureFiles(path.parent, assets_root)
    reader = _Reader(file, GltfMaterials(file, textures))
    roots = tuple(node for number in _roots(file) for node in reader.nodes(number, 1))
    return AuthoredScene(roots, left_out=textures.left_out)


class _Reader:
    """Convert nodes to authored nodes. Each mesh is read once."""

    def __init__(self, file: GltfFile, materials: GltfMaterials) -> None:
        self._file, self._materials = file, materials
        self._seen: set[int] = set()
        self._deformations = Deformations(file, _matrix)
        self._pieces: dict[tuple[object, ...], tuple[Piece, ...]] = {}
        # By the text of a mesh's primitives: trimesh repeats these in a mesh of its own for each copy.
        self._same_pieces: dict[str, tuple[Piece, ...]] = {}
        self._scaled_pieces: dict[tuple[object, bytes], Piece] = {}
        self._size = limits.TreeSize()

    def nodes(self, number: int, depth: int) -> tuple[AuthoredNode, ...]:
        """Return one node, or one for each copy of an instanced mesh: those of the file before it was packed."""
        row = self._file.row("nodes", number, "a node or scene")
        if number in self._seen:
            raise SceneFormatError(f"nodes[{number}] hangs below itself or below two nodes; nodes must form a tree.")
        self._seen.add(number)
        self._size.add_nodes(1, depth)
        if mapping(mapping(row.get("extensions")).get("KHR_node_visibility")).get("visible") is False:
            return ()
        name = _name(row)
        place = f"node {name!r}" if name else f"nodes[{number}]"
        matrix = _matrix(row, place)
        pieces: tuple[Piece, ...] = ()
        places = None
        if "mesh" in row:
            mesh = self._file.row("meshes", row["mesh"], place)
            pieces = self._mesh(row["mesh"], mesh, place, self._deformations.of(number, row, mesh, place))
            name = name or _name(mesh)
            places = instances(self._file, row, place)
            n_copies = 1 if places is None else len(places)
            self._size.add_triangles(n_copies * sum(len(piece.faces) for piece in pieces))
        below = _numbers(row.get("children", []), f"{place}.children")
        rows = self._file.table("nodes")
        found = [(rows[child], node) for child in below for node in self.nodes(child, depth + 1)]
        if "mesh" not in row:
            only_scale = [self._only_scales(child, node) for child, node in found]
            scaled = [node for (_, node), is_one in zip(found, only_scale, strict=True) if is_one]
            pieces = tuple(self._scaled(piece, node.matrix) for node in scaled for piece in node.pieces)
            found = [each for each, is_one in zip(found, only_scale, strict=True) if not is_one]
            name = name or (scaled[0].name if len(scaled) == 1 else "")
        children = tuple(node for _, node in found)
        if places is not None:
            self._size.add_nodes(len(places))
            # Blender calls the node of all copies "chairs.0", and its mesh "chair".
            copies = tuple(AuthoredNode(_name(mesh) or name, matrix @ each, pieces) for each in places)
            return (*copies, AuthoredNode(name, matrix, (), children)) if children else copies
        return (AuthoredNode(name, matrix, pieces, children),)

    def _only_scales(self, row: Json, node: AuthoredNode) -> bool:
        """Return True if a node only converts quantised positions (stored as whole numbers) to lengths.

        gltfpack moves a quantised mesh into such a node, below the author's node. Without this rule a door below a
        cupboard would be part of another object than in the file before packing.
        """
        if node.children or not node.pieces or _name(row) or row.keys() & {"matrix", "rotation", "skin"}:
            return False
        if INSTANCES in mapping(row.get("extensions")):
            return False
        primitives = self._file.table("meshes")[row["mesh"]]["primitives"]
        return all(map(self._is_quantised, primitives)) and bool((np.diag(node.matrix) > 0).all())

    def _is_quantised(self, primitive: Json) -> bool:
        """Return True if positions are whole numbers. Rows of points and lines may be broken: these give False."""
        rows = self._file.table("accessors")
        number = mapping(primitive.get("attributes")).get("POSITION")
        return isinstance(number, int) and 0 <= number < len(rows) and rows[number].get("componentType") != _FLOAT

    def _scaled(self, piece: Piece, matrix: Matrix) -> Piece:
        """Return a piece in the frame of the parent node; `matrix` scales and moves it. Copies share the result."""
        key = (piece.key, matrix.tobytes())
        if key not in self._scaled_pieces:
            # A file may scale one mesh differently in each node, so the memory is bounded.
            self._file.values.spend(piece.vertices.size, "a node that scales a quantised mesh")
            with np.errstate(over="ignore", invalid="ignore"):
                vertices = piece.vertices * np.diag(matrix)[:3] + matrix[:3, 3]
            self._scaled_pieces[key] = replace(piece, key=key, vertices=vertices)
        return self._scaled_pieces[key]

    def _mesh(self, number: int, mesh: Json, place: str, deformation: Deformation) -> tuple[Piece, ...]:
        which = (number, *deformation.key)
        if which not in self._pieces:
            rows = mesh.get("primitives")
            if not isinstance(rows, list) or not all(isinstance(row, dict) for row in rows):
                raise SceneFormatError(f"meshes[{number}].primitives must be a list of objects.")
            place, text = f"{place}, meshes[{number}]", repr((rows, deformation.key))
            if text not in self._same_pieces:
                pieces = (self._piece((*which, i), row, place, deformation) for i, row in enumerate(rows))
                self._same_pieces[text] = tuple(piece for piece in pieces if piece is not None and len(piece.faces))
            self._pieces[which] = self._same_pieces[text]
        return self._pieces[which]

    def _piece(self, key: tuple[object, ...], row: Json, place: str, deformation: Deformation) -> Piece | None:
        mode = natural(row.get("mode", _TRIANGLES), f"{place}.mode")
        if mode not in (_TRIANGLES, _STRIP, _FAN):
            return None  # points and lines cannot be touched
        attributes = row.get("attributes")
        if not isinstance(attributes, dict):
            raise SceneFormatError(f"{place}.attributes must be an object.")
        if "POSITION" not in attributes:
            return None
        compressed = mapping(row.get("extensions")).get(DRACO)
        if isinstance(compressed, dict):
            mesh, numbers = draco(self._file, compressed, place), mapping(compressed.get("attributes"))
            points, faces = mesh.points, mesh.faces
            self._file.triangles.spend(len(faces), place)

            def attribute(name: str, types: tuple[str, ...]) -> Floats:
                return mesh.vectors(numbers.get(name), f"{place}: its {name}")

        else:
            points = vectors(self._file, attributes["POSITION"], ("VEC3",), f"{place}: positions")
            order = indices(self._file, row["indices"], place) if "indices" in row else np.arange(len(points))
            self._file.triangles.spend(len(order) // 3 if mode == _TRIANGLES else max(len(order) - 2, 0), place)
            faces = _triangles(order, mode)

            def attribute(name: str, types: tuple[str, ...]) -> Floats:
                return vectors(self._file, attributes.get(name), types, f"{place}: its {name}")

        if deformation.key:
            self._file.values.spend(points.size, place)
            points = deformation.deformed(self._file, row, points, attribute, place)
        material = None if row.get("material") is None else self._file.row("materials", row["material"], place)
        piece = Piece.checked(key, points, faces, "" if material is None else _name(material), place)
        paint = None if material is None else self._materials.paint(row["material"], material)
        looks = self._looks(paint, faces, len(points), attribute, "COLOR_0" in attributes)
        return replace(piece, appearance=looks)

    def _looks(
        self,
        paint: TexturedMaterial | None,
        faces: Ints,
        n_points: int,
        attribute: _Attribute,
        is_colored: bool,
    ) -> Appearance | None:
        """Return the looks of a primitive; None if the file has none."""

        def corners(name: str, types: tuple[str, ...], columns: slice) -> Floats | None:
            """Return an attribute at each corner (m, 3, columns). If it is broken: None, and the reason is recorded."""
            try:
                values = attribute(name, types)[:, columns]
                if len(values) != n_points:
                    raise SceneFormatError(f"{name} has {len(values)} values for {n_points} vertices.")
            except SceneError as error:
                self._materials.textures.refuse(str(error), str(error))
                return None
            return values[faces]

        material, uv = FaceMaterial((1.0, 1.0, 1.0, 1.0)) if paint is None else paint.material, None
        if paint is not None and material.has_texture:
            stored = corners(f"TEXCOORD_{paint.uv_set}", ("VEC2",), slice(2))
            if stored is None:
                material = material.untextured()
            else:
                uv = (stored @ paint.transform[:, :2].T + paint.transform[:, 2]).astype(np.float32)
        colors = corners("COLOR_0", ("VEC3", "VEC4"), slice(4)) if is_colored else None
        if colors is not None and len(faces) and not colors.min() > _NEARLY_WHITE:
            means = colors.mean(axis=1)
            means[:, :3] = srgb(means[:, :3])
            return painted(means, material, uv)
        return None if paint is None else Appearance.plain(material, len(faces), uv)


def _roots(file: GltfFile) -> list[int]:
    """Return the nodes of the default scene. Without a default scene: all nodes without a parent."""
    if file.table("scenes"):
        scene = file.row("scenes", file.header.get("scene", 0), "scene")
        return _numbers(scene.get("nodes", []), "scene.nodes")
    below = {child for row in file.table("nodes") for child in _numbers(row.get("children", []), "node.children")}
    return [number for number in range(len(file.table("nodes"))) if number not in below]


def _triangles(order: Ints, mode: int) -> Ints:
    """Return faces (m, 3) of vertex numbers in the order of a list, strip or fan of triangles."""
    if mode == _TRIANGLES:
        return order[: len(order) // 3 * 3].reshape(-1, 3)
    n = max(len(order) - 2, 0)
    if mode == _FAN:
        return np.stack((order[1 : n + 1], order[2 : n + 2], np.repeat(order[:1], n)), axis=1)
    faces = np.stack((order[:n], order[1 : n + 1], order[2 : n + 2]), axis=1)
    # Every second triangle of a strip has the opposite orientation.
    faces[1::2] = faces[1::2, [0, 2, 1]]
    # Degenerate triangles, which use a vertex twice, join strips.
    joins = (faces == np.roll(faces, 1, axis=1)).any(axis=1)
    kept: Ints = faces[~joins]
    return kept


def _matrix(row: Json, place: str) -> Matrix:
    """Return the node's transform: `matrix` by columns, or translation, rotation and scale."""
    if "matrix" in row:
        entries = checks.vector(f"{place}.matrix", row["matrix"], "-", size=16, error=SceneFormatError)
        matrix = np.array(entries).reshape(4, 4).T
        if not np.allclose(matrix[3], [0, 0, 0, 1], atol=1e-6):
            raise SceneFormatError(f"{place}.matrix ends in the row {matrix[3].tolist()}; it must be 0, 0, 0, 1.")
        matrix[3] = 0, 0, 0, 1
        return matrix

    def numbers(key: str, default: float) -> Floats:
        given = row.get(key, [default] * 3)
        return np.array(checks.vector(f"{place}.{key}", given, "-", size=3, error=SceneFormatError))

    try:
        rotation = Pose(rotation_xyzw=row.get("rotation", (0.0, 0.0, 0.0, 1.0))).rotation
    except SceneError as cause:
        raise SceneFormatError(f"{place}.rotation: {cause}") from cause
    return transform(rotation * numbers("scale", 1.0), numbers("translation", 0.0))


def _numbers(value: object, place: str) -> list[int]:
    if not isinstance(value, list):
        raise SceneFormatError(f"{place} is {value!r}; it must be a list of node numbers.")
    return [natural(item, place) for item in value]


def _name(row: Json) -> str:
    name = row.get("name")
    return name.strip() if isinstance(name, str) else ""
