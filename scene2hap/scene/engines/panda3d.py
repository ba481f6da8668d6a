"""Panda3D scene graphs as snapshots.

Objects are found by the rule of the file loaders (`scene.grouping.groups`), since a scene graph keeps the structure
of its artists' files. The pose of an object is that of the innermost node that contains all its triangles, even if
another node names it. Instances are separate objects that share a mesh. Hidden and stashed nodes, lines and points are
left out, as are nodes of scale 0. Only the finest level of detail is read. Animated characters keep the pose in which
they were modelled.

A session follows a graph by `scene2hap.engines.Panda3DLink`, which reads poses by a `PoseReader`.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any, NamedTuple

import numpy as np

from scene2hap.common import checks
from scene2hap.errors import SceneError
from scene2hap.scene import limits
from scene2hap.scene.engines import engine
from scene2hap.scene.engines.panda3d_geoms import GeomReader
from scene2hap.scene.grouping.groups import Group, Grouping, group_objects, unique_ids
from scene2hap.scene.grouping.not_drawn import warn_of_collapsed, without_collapsed
from scene2hap.scene.grouping.object_maker import ObjectMaker
from scene2hap.scene.objects import UpAxis, with_relative_heights
from scene2hap.scene.plausibility.units import metres_per_unit, warn_if_implausible
from scene2hap.scene.pose import Pose
from scene2hap.scene.snapshot import SceneSnapshot
from scene2hap.scene.tree import AuthoredNode, Matrix, rigid_part

_VIEWPOINT = "camera"
"""Name of the node above Panda3D's camera. What is below it, such as a sky or a tool in the hand, has its own name."""


def snapshot(
    render: Any,
    *,
    name: str | None = None,
    up_axis: UpAxis | None = None,
    group: Grouping = "authored",
    unit_m: float | None = None,
) -> SceneSnapshot:
    """Return the scene below a NodePath, in the coordinates of the graph's root.

    Parameters: render : a `panda3d.core.NodePath`; name : of the scene, None means the NodePath's; up_axis : None means
        Panda3D's own, which `coordinate-system` sets; group : the rule by which nodes become objects; unit_m : metres
        per unit of the graph; None means metres.
    Raises: MissingExtra: Panda3D is not installed. SceneError: there are no triangles, or a number is invalid.
    Warns: UnitWarning: without unit_m, if sizes are implausible as metres. SceneWarning: nodes without size are left
    out.
    """
    if up_axis not in ("y", "z", None):
        raise SceneError(f"up_axis is {up_axis!r}; it must be 'y', 'z' or None.")
    core = engine("panda3d.core")
    is_y_up = core.get_default_coordinate_system() in (core.CS_yup_right, core.CS_yup_left)
    up_axis = up_axis or ("y" if is_y_up else "z")
    metres = metres_per_unit(unit_m)
    graph = _Graph.read(render)
    maker = ObjectMaker(up_axis, metres)
    # Objects without size are left out after ids are given: a link made while one is hidden by scale 0 finds it too.
    shown, collapsed = without_collapsed([graph.root])
    pieces = {id(piece) for root in shown for node in root.walk() for piece in node.pieces}
    objects = [
        maker.make(object_id, found, _pose(path.get_net_transform(), metres))
        for object_id, (found, path, _) in graph.objects(group).items()
        if any(id(piece) in pieces for _, piece in found.parts)
    ]
    title = name or render.get_name() or "panda3d"
    if not objects:
        raise SceneError(f"scene {title!r} draws no triangles; nothing in it can be touched.")
    warn_of_collapsed(title, collapsed)
    scene = SceneSnapshot(title, up_axis, with_relative_heights(objects, up_axis))
    if unit_m is None:
        warn_if_implausible(scene, source="engine")
    return scene


class PoseReader:
    """Reader of the poses of the objects of `snapshot` with the same arguments. Nodes are looked up once; `follow` adds
    one that comes later.

    A node at rest costs almost nothing. Panda3D never changes a transform object, and the reader keeps the last one
    alive, so an equal address means an equal transform.
    """

    def __init__(self, render: Any, *, group: Grouping = "authored", unit_m: float = 1.0) -> None:
        self._render, self._unit_m = render, metres_per_unit(unit_m)
        objects = _Graph.read(render).objects(group)
        self._nodes = {object_id: found.path for object_id, found in objects.items()}
        self._owners = {path: object_id for object_id, found in objects.items() for path in found.owned}
        self._last: dict[str, tuple[Any, Pose]] = {}

    def follow(self, object_id: str, node: Any) -> None:
        """Read the pose of an object from a node, as that of the one object of `snapshot(node, group=1)`.

        Raises: SceneError: it is no NodePath, or draws no triangles.
        """
        found = _Graph.read(node).objects(1)
        if not found:
            raise SceneError(f"{node!r} draws no triangles; nothing of {object_id!r} can be touched.")
        ((_, path, owned),) = found.values()
        self._nodes[object_id] = path
        self._owners.update(dict.fromkeys((node, *owned), object_id))
        self._last.pop(object_id, None)

    def object_id(self, node: Any) -> str | None:
        """Return the id of the object that a NodePath or node belongs to, such as one that a ray hits; None if to none.

        It may draw the object, name it, or be below such a node, as colliders are.
        Raises: SceneError: it is neither a NodePath nor a node.
        """
        core = engine("panda3d.core")
        path = core.NodePath.any_path(node) if isinstance(node, core.PandaNode) else node
        if not isinstance(path, core.NodePath):
            raise SceneError(f"node is {checks.described(node)}; it must be a NodePath or a PandaNode.")
        while not path.is_empty():
            if path in self._owners:
                return self._owners[path]
            path = path.get_parent()
        return None

    def read(self) -> dict[str, Pose]:
        """Return the current pose of every object, by id; without objects whose node has left the graph."""
        last, placed = self._last, {}
        for object_id, path in self._nodes.items():
            if path.is_empty() or not (path == self._render or self._render.is_ancestor_of(path)):
                continue
            transform = path.get_net_transform()
            known = last.get(object_id)
            if known is None or known[0].this != transform.this:
                known = last[object_id] = (transform, _pose(transform, self._unit_m))
            placed[object_id] = known[1]
        return placed


class _Found(NamedTuple):
    """An object in the frame of the NodePath that moves it, and the NodePaths that move, name and draw it."""

    group: Group
    path: Any
    owned: tuple[Any, ...]


@dataclass(eq=False)
class _Graph:
    """A scene graph as an authored tree, with a map from its pieces back to NodePaths.

    `trails` has, for every piece, the world transforms and NodePaths from the root to the node that draws it.
    """

    core: Any
    root: AuthoredNode = field(init=False)
    trails: dict[int, tuple[tuple[Matrix, Any], ...]] = field(default_factory=dict)
    size: limits.TreeSize = field(default_factory=limits.TreeSize)

    @classmethod
    def read(cls, render: Any) -> _Graph:
        core = engine("panda3d.core")
        if not isinstance(render, core.NodePath) or render.is_empty():
            raise SceneError(f"render is {render!r}; it must be a panda3d.core.NodePath with a node.")
        graph = cls(core)
        matrix = _matrix(render.get_net_transform())
        graph.root = graph._node(render, matrix, (), GeomReader(core))
        return graph

    def objects(self, group: Grouping) -> dict[str, _Found]:
        """Return the objects by id."""
        groups = group_objects([self.root], group)
        ids = unique_ids([found.name for found in groups])
        return {object_id: self._bound(found) for object_id, found in zip(ids, groups, strict=True)}

    def _bound(self, found: Group) -> _Found:
        trails = [self.trails[id(piece)] for _, piece in found.parts]
        shared = [level[0] for level in zip(*trails, strict=False) if all(node is level[0] for node in level)]
        frame, path = shared[-1]
        naming = [
            node for at, node in shared if np.array_equal(at, found.frame) and self._name(node, True) == found.name
        ]
        return _Found(replace(found, frame=frame), path, (path, *naming[:1], *(trail[-1][1] for trail in trails)))

    def _node(
        self, path: Any, matrix: Matrix, above: tuple[tuple[Matrix, Any], ...], reader: GeomReader
    ) -> AuthoredNode:
        self.size.add_nodes(1, len(above) + 1)
        trail = (*above, ((above[-1][0] if above else np.eye(4)) @ matrix, path))
        pieces = tuple(reader.read(path))
        self.size.add_triangles(sum(len(piece.faces) for piece in pieces))
        self.trails.update((id(piece), trail) for piece in pieces)
        children = tuple(
            self._node(child, _matrix(child.get_transform()), trail, reader) for child in self._drawn_children(path)
        )
        return AuthoredNode(self._name(path, bool(above)), matrix, pieces, children)

    def _drawn_children(self, path: Any) -> list[Any]:
        children = list(path.get_children())
        if isinstance(path.node(), self.core.LODNode) and children:
            finest = path.node().get_highest_switch()
            children = children[finest : finest + 1]
        return [child for child in children if not child.is_hidden()]

    def _name(self, path: Any, is_below: bool) -> str:
        """Return the authored name, or none: the root of a graph and the node that moves the camera are no things.

        A loaded model is named after its file: `lamp.egg`.
        """
        if not is_below and not path.has_parent():
            return ""
        name = str(path.get_name()).strip()
        if name == _VIEWPOINT and path.find("**/+Camera"):
            return ""
        return name.partition(".")[0] if isinstance(path.node(), self.core.ModelRoot) else name


def _matrix(transform: Any) -> Matrix:
    # Panda3D's vectors are rows, so its matrices are transposed.
    return np.array([tuple(row) for row in transform.get_mat().get_rows()], dtype=np.float64).T


def _pose(transform: Any, unit_m: float) -> Pose:
    """Return the rigid pose of a node in the graph's root [m]. Transforms with shear or mirroring use `rigid_part`."""
    is_similar = transform.has_components() and transform.has_uniform_scale() and not transform.has_nonzero_shear()
    if is_similar and transform.get_uniform_scale() > 0:
        w, x, y, z = transform.get_quat()
        a, b, c = transform.get_pos()
        return Pose((a * unit_m, b * unit_m, c * unit_m), (x, y, z, w))
    matrix = rigid_part(_matrix(transform))
    matrix[:3, 3] *= unit_m
    return Pose.from_matrix(matrix)
