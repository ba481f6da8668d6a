"""A composed USD stage as an authored tree.

Left out: prims that are inactive, abstract or invisible, or of purpose "guide" or "proxy"; points, curves and volumes.
Skinning is left out too: a skinned mesh keeps the pose in which it was modelled. Copies of native instances and point
instancers share their pieces.

Three kinds of prims are one object with all prims below: a rigid body (`PhysicsRigidBodyAPI`) without another rigid
body below it; a model of kind "component" with at most one rigid body below it, unless it holds the whole scene; each
copy of a point instancer. Other prims become objects by the rules of `scene.grouping.groups`. The mesh of an object of
Blender is no node of its own.

Joints between rigid bodies are pivots (`usd.joints`).

Source: OpenUSD 26.11, schemas Xformable, Imageable, PointInstancer, RigidBodyAPI; `UsdGeomGetStageMetersPerUnit`.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np
from pxr import Kind, Usd, UsdGeom, UsdPhysics, UsdUtils

from scene2hap.errors import SceneError, SceneFormatError
from scene2hap.scene import limits
from scene2hap.scene.formats.usd.joints import pivots_of
from scene2hap.scene.formats.usd.layers import Layers, reason_of
from scene2hap.scene.formats.usd.masses import Masses
from scene2hap.scene.formats.usd.materials import UsdMaterials
from scene2hap.scene.formats.usd.meshes import Triangles, mesh_triangles, shape_triangles, subsets
from scene2hap.scene.formats.usd.values import integers, is_data_of_parent, name_of, rest_time, value
from scene2hap.scene.looks.texture_files import TextureFiles
from scene2hap.scene.objects import UpAxis
from scene2hap.scene.tree import AuthoredNode, AuthoredPivot, AuthoredScene, Matrix, Piece

_FREE_NUMBERS, _NUMBERS_PER_BYTE = 20_000_000, 4.0
"""Most numbers in all meshes: a fixed number, and a further number for each byte of the layers.

Binary files pack numbers, and may use one list in many meshes (assumed: `usdcat` packs the indices of a grid to 1.1
bytes each).
"""

_DRAWN = Usd.TraverseInstanceProxies(Usd.PrimDefaultPredicate)
# Prototypes may be below prims that are only over or class and so are not drawn themselves.
_PROTOTYPE = Usd.TraverseInstanceProxies(Usd.PrimIsActive & Usd.PrimIsLoaded)
_NOT_DRAWN = ("guide", "proxy")
# Parts of meshes and of materials, which are no nodes of the scene's tree.
_NO_NODES = ("GeomSubset", "Material", "NodeGraph", "Shader")


def read_stage(
    path: Path, assets_root: Path, allow: Callable[[int, int], None] = lambda n_bytes, n_prims: None
) -> AuthoredScene:
    """Return the scene in a USD file, read in this process; see `read_usd`, and `Layers` for `allow`."""
    folder = path.parent.resolve()
    textures = TextureFiles(folder, assets_root)
    with _silent():
        layers = Layers(folder / path.name, assets_root, textures, allow)
        try:
            stage = Usd.Stage.Open(layers.root(), Usd.Stage.LoadAll)
            layers.check(stage)
            reader = _Reader(stage, layers)
            roots, pivots = reader.roots(), reader.pivots()
        except SceneError:
            raise
        # usd-core raises its own errors, and attributes may hold values of any type.
        except Exception as cause:
            raise SceneFormatError(f"{path.name!r} cannot be read as USD: {reason_of(cause)}.") from cause
        # The format defines centimetres for a stage without a unit, and other programs read it so.
        unit_m = float(UsdGeom.GetStageMetersPerUnit(stage))
        return AuthoredScene(roots, _up_axis(stage, path.name), unit_m, textures.left_out, pivots)


def _up_axis(stage: Any, name: str) -> UpAxis:
    up = str(UsdGeom.GetStageUpAxis(stage))
    if up not in ("Y", "Z"):
        raise SceneError(f"{name!r} has {up} up; scene2hap knows Y and Z. Export it with Y or Z up.")
    return "z" if up == "Z" else "y"


@dataclass(frozen=True, eq=False)
class _Above:
    """Properties that a prim inherits from the prims above it."""

    world: Matrix = field(default_factory=lambda: np.eye(4))
    purpose: str = "default"
    density: float | None = None
    depth: int = 0
    predicate: Any = _DRAWN


class _Reader:
    """Convert prims to authored nodes. Each gprim is read once."""

    def __init__(self, stage: Any, layers: Layers) -> None:
        self._stage, self._materials, self._masses = stage, UsdMaterials(layers), Masses(stage)
        self._numbers = limits.Budget(
            "the numbers of its meshes", _FREE_NUMBERS, _NUMBERS_PER_BYTE, stored=layers.n_bytes
        )
        self._triangles: dict[Hashable, Triangles | None] = {}
        self._pieces: dict[Hashable, tuple[Piece, ...]] = {}
        self._components: dict[int, AuthoredNode] = {}
        self._data: dict[int, AuthoredNode] = {}
        self._size, self._n_bodies = limits.TreeSize(), 0
        # Whether each rigid body has geometry, by its path.
        self._bodies: dict[str, bool] = {}
        self._joints: list[Any] = []

    def roots(self) -> tuple[AuthoredNode, ...]:
        """Return the nodes of the prims at the top of the stage."""
        found = self._below(self._stage.GetPseudoRoot(), _Above())
        n_pieces = sum(_n_pieces(node) for node in found)
        return tuple(self._unwrapped(node, n_pieces) for node in found)

    def pivots(self) -> tuple[AuthoredPivot, ...]:
        """Return the joints among the prims that `roots` has read."""
        return pivots_of(self._joints, self._bodies, _world)

    def _unwrapped(self, node: AuthoredNode, n_pieces: int) -> AuthoredNode:
        """Return the node. A component that holds the whole scene is no object, since exporters declare any file a
        component."""
        if _n_pieces(node) < n_pieces or not node.children:
            return node
        is_object = node.is_object and id(node) not in self._components
        return replace(
            node, is_object=is_object, children=tuple(self._unwrapped(child, n_pieces) for child in node.children)
        )

    def _below(self, prim: Any, above: _Above) -> tuple[AuthoredNode, ...]:
        children = prim.GetFilteredChildren(above.predicate)
        return tuple(node for child in children if (node := self._node(child, above)) is not None)

    def _node(self, prim: Any, above: _Above) -> AuthoredNode | None:
        """Return the node of a prim and of its descendants. Returns None for prims that are never drawn."""
        if prim.GetTypeName() in _NO_NODES:
            return None
        depth = above.depth + 1
        self._size.add_nodes(1, depth)
        is_imageable, purpose = prim.IsA(UsdGeom.Imageable), above.purpose
        if is_imageable:
            imageable = UsdGeom.Imageable(prim)
            if value(imageable.GetVisibilityAttr()) == UsdGeom.Tokens.invisible:
                return None
            attribute = imageable.GetPurposeAttr()
            purpose = str(value(attribute)) if attribute.HasAuthoredValue() else purpose
        matrix = _matrix(prim, above.world) if prim.IsA(UsdGeom.Xformable) else np.eye(4)
        world = above.world @ matrix
        density = self._masses.density(prim, above.density)
        within = _Above(world, purpose, density, depth, above.predicate)

        if prim.IsA(UsdPhysics.Joint):
            self._joints.append(prim)
        n_bodies, is_body = self._n_bodies, prim.HasAPI(UsdPhysics.RigidBodyAPI)
        pieces: tuple[Piece, ...] = ()
        own_kg: float | None = 0.0
        if prim.IsA(UsdGeom.PointInstancer):
            # Prototypes below an instancer are drawn only as its copies.
            children = self._copies(UsdGeom.PointInstancer(prim), within)
        else:
            if purpose not in _NOT_DRAWN and is_imageable:
                pieces = self._drawn(prim)
                if pieces:
                    own_kg = self._own_kg(prim, density, world)
            children = self._below(prim, within)
        is_single = self._n_bodies == n_bodies if is_body else self._n_bodies <= n_bodies + 1
        self._n_bodies += is_body
        mass_kg = self._masses.of_all_below(prim) or _sum_kg(own_kg, children)
        own = [child for child in children if id(child) in self._data]
        pieces += tuple(piece for child in own for piece in child.pieces)
        children = tuple(child for child in children if id(child) not in self._data)
        is_component = Kind.Registry.IsA(Usd.ModelAPI(prim).GetKind(), Kind.Tokens.component)
        node = AuthoredNode(
            name_of(prim),
            matrix,
            pieces,
            children,
            is_object=is_single and (is_body or is_component),
            mass_kg=mass_kg,
            key=str(prim.GetPath()) if is_body else "",
        )
        if is_body and value(UsdPhysics.RigidBodyAPI(prim).GetRigidBodyEnabledAttr()) is not False:
            self._bodies[node.key] = _n_pieces(node) > 0
        if is_data_of_parent(prim) and not children and prim.IsA(UsdGeom.Gprim) and (matrix == np.eye(4)).all():
            self._data[id(node)] = node
        if is_component and not is_body:
            self._components[id(node)] = node
        return node

    # -- gprims ------------------------------------------------------------------------------------------------------

    def _drawn(self, prim: Any) -> tuple[Piece, ...]:
        """Return the pieces of a gprim, one for each material; none for other prims."""
        key = _key(prim)
        if key not in self._triangles:
            self._triangles[key] = self._shape(prim)
        found = self._triangles[key]
        if found is None or not len(found.vertices):
            return ()
        self._size.add_triangles(len(found.vertices))
        parts = [(None, np.arange(len(found.vertices)))] if found.is_made else subsets(UsdGeom.Mesh(prim), found)
        bound = [self._materials.bound(subset or prim) for subset, _ in parts]
        # Copies share their triangles, but may have materials of their own.
        painted = (key, *(each.GetPath() if each else None for each in bound))
        if painted not in self._pieces:
            pieces = []
            for number, ((_, rows), material) in enumerate(zip(parts, bound, strict=True)):
                name = name_of(material.GetPrim()) if material else ""
                piece = Piece.checked((key, number), found.points, found.vertices[rows], name, f"prim {prim.GetPath()}")
                looks = self._materials.looks(prim, material, found, rows)
                pieces.append(replace(piece, appearance=looks, is_made=found.is_made))
            self._pieces[painted] = tuple(pieces)
        return self._pieces[painted]

    def _shape(self, prim: Any) -> Triangles | None:
        if prim.IsA(UsdGeom.Mesh):
            return mesh_triangles(UsdGeom.Mesh(prim), f"prim {prim.GetPath()}", self._numbers)
        return shape_triangles(prim)

    def _own_kg(self, prim: Any, density: float | None, world: Matrix) -> float | None:
        found = self._triangles[_key(prim)]
        if found is None:
            return None
        return self._masses.of_shape(prim, _key(prim), found, density, float(np.linalg.det(world[:3, :3])))

    # -- point instancers --------------------------------------------------------------------------------------------

    def _copies(self, instancer: Any, above: _Above) -> tuple[AuthoredNode, ...]:
        """Return the nodes of a point instancer: each copy is one object."""
        place = f"prim {instancer.GetPath()}"
        targets = instancer.GetPrototypesRel().GetForwardedTargets()
        prototypes = [self._stage.GetPrimAtPath(target) for target in targets]
        attributes = (
            instancer.GetProtoIndicesAttr(),
            instancer.GetPositionsAttr(),
            instancer.GetOrientationsAttr(),
            instancer.GetScalesAttr(),
        )
        which = integers(attributes[0])
        # Checked before usd-core makes a matrix for each copy.
        self._size.add_nodes(len(which))
        if which.min(initial=0) < 0 or which.max(initial=-1) >= len(prototypes):
            raise SceneFormatError(
                f"{place}: protoIndices go to {int(which.max())}; it has {len(prototypes)} prototypes (from 0)."
            )
        time = rest_time(attributes)
        matrices = np.array(
            instancer.ComputeInstanceTransformsAtTime(
                time, time, UsdGeom.PointInstancer.ExcludeProtoXform, UsdGeom.PointInstancer.IgnoreMask
            )
        ).reshape(-1, 4, 4)
        if len(matrices) != len(which):
            raise SceneFormatError(f"{place} has {len(which)} protoIndices and places for {len(matrices)} copies.")
        shown = np.array(instancer.ComputeMaskAtTime(time), dtype=bool)
        made: dict[Hashable, AuthoredNode | None] = {}
        copies = []
        for number in np.flatnonzero(shown) if len(shown) == len(which) else range(len(which)):
            matrix, prototype = matrices[number].T, prototypes[which[number]]
            world = above.world @ matrix
            # Masses from density grow with the scale, so copies of different scale are read separately.
            key = (int(which[number]), round(float(np.linalg.det(world[:3, :3])), 9))
            if key not in made:
                is_drawn = prototype and prototype.IsActive()
                within = replace(above, world=world, predicate=_PROTOTYPE)
                made[key] = self._node(prototype, within) if is_drawn else None
            elif (again := made[key]) is not None:
                self._size.add_nodes(sum(1 for _ in again.walk()))
                self._size.add_triangles(again.n_triangles)
            node = made[key]
            if node is not None:
                copies.append(replace(node, matrix=matrix @ node.matrix, is_object=True, key=""))
        return tuple(copies)


def _key(prim: Any) -> str:
    """Return a key that is equal for the copies of a prim in native instances."""
    shared = prim.GetPrimInPrototype() if prim.IsInstanceProxy() else prim
    return str(shared.GetPath())


def _n_pieces(node: AuthoredNode) -> int:
    return sum(len(each.pieces) for each in node.walk())


def _sum_kg(own_kg: float | None, children: tuple[AuthoredNode, ...]) -> float | None:
    """Return the mass of a prim's own shape and its drawn children; None if a mass is unknown, or there is none."""
    below = [child.mass_kg for child in children if child.mass_kg is not None or _n_pieces(child)]
    known = [kg for kg in (own_kg, *below) if kg is not None]
    return sum(known) or None if len(known) == len(below) + 1 else None


def _world(prim: Any) -> Matrix:
    """Return the prim's transform in the world, for column vectors."""
    if not prim or prim.IsPseudoRoot():
        return np.eye(4)
    above = _world(prim.GetParent())
    return above @ _matrix(prim, above) if prim.IsA(UsdGeom.Xformable) else above


def _matrix(prim: Any, above: Matrix) -> Matrix:
    """Return the prim's transform in its parent, for column vectors."""
    xformable = UsdGeom.Xformable(prim)
    operations = xformable.GetOrderedXformOps()
    if not operations:
        return np.eye(4)
    matrix: Matrix = np.array(
        xformable.GetLocalTransformation(rest_time([each.GetAttr() for each in operations]))
    ).T.copy()
    place = f"prim {prim.GetPath()}"
    if not (np.abs(matrix[3] - [0, 0, 0, 1]) <= 1e-6).all():
        raise SceneFormatError(
            f"{place} has a transform whose last column is {matrix[3].tolist()}; it must be 0, 0, 0, 1."
        )
    matrix[3] = 0, 0, 0, 1
    if xformable.GetResetXformStack():
        try:
            return np.linalg.inv(above) @ matrix
        except np.linalg.LinAlgError as cause:
            raise SceneError(
                f"{place} resets its transform below a prim of scale 0. Check the scales above it."
            ) from cause
    return matrix


@contextmanager
def _silent() -> Iterator[None]:
    """Keep usd-core's output off the terminal; our own errors state the cause."""
    delegate = UsdUtils.CoalescingDiagnosticDelegate()
    try:
        yield
    finally:
        delegate.TakeUncoalescedDiagnostics()
        del delegate
