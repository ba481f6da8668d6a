"""URDF files, robots and furniture with joints, as authored trees.

1. Every link with geometry is an object. It has the link's name, and the pose of the link's frame with all joints at 0.
   Links with a fixed joint stay separate. A link without geometry is a frame, and no object. A link that turns on
   another, or is fixed to one that moves, has a hinge.
2. The <visual> geometry of a link is drawn; its <collision> geometry only if it has no other.
3. A mesh keeps its own materials. A mesh without materials, such as STL, and shapes such as boxes have the material of
   their <visual>. As in ROS, meshes are never rotated to another up axis, and COLLADA's unit counts.
4. <inertial> gives the object's mass.

We do not use MuJoCo's reader (4.0). It does not read COLLADA or textures, refuses flat sheets, and opens any file that
a file names. A model that MuJoCo compiles from the same file has the same names and poses.

Source: URDF XML specification (ROS), `link`, `joint`, `material`; MuJoCo documentation, "URDF extensions".
"""

from __future__ import annotations

from collections.abc import Callable, Collection
from dataclasses import dataclass, field, replace
from pathlib import Path
from xml.etree import ElementTree

import numpy as np

from scene2hap.common import checks
from scene2hap.errors import MissingExtra, SceneError, SceneFormatError
from scene2hap.scene import limits, solids
from scene2hap.scene.files import read_bytes
from scene2hap.scene.formats.urdf_files import UrdfFiles
from scene2hap.scene.formats.xml_files import walk_xml
from scene2hap.scene.joints import Joint, pivots
from scene2hap.scene.looks.appearance import Appearance, FaceMaterial
from scene2hap.scene.looks.texture_files import TextureFiles
from scene2hap.scene.pose import Pose
from scene2hap.scene.tree import AuthoredNode, AuthoredScene, Matrix, Piece, transform, with_own_keys

MAX_XML_BYTES = 1 << 24
"""Largest size of a URDF file [bytes] (assumed: a hundred times a large robot)."""
_EXPAND = "Write the file out first: xacro FILE > robot.urdf"
_MESHES = (".obj", ".stl", ".dae", ".ply", ".glb", ".gltf")

_SOLIDS: dict[str, tuple[dict[str, int], Callable[..., solids.Triangles]]] = {
    "box": ({"size": 3}, lambda *edges: solids.box([edge / 2 for edge in edges])),
    "sphere": ({"radius": 1}, lambda radius: solids.ellipsoid([radius] * 3)),
    "cylinder": ({"radius": 1, "length": 1}, lambda radius, length: solids.cylinder(radius, length / 2)),
    "capsule": ({"radius": 1, "length": 1}, lambda radius, length: solids.capsule(radius, length / 2)),
}
"""The attributes of each shape with their numbers of values, and the function that makes its triangles."""

Element = ElementTree.Element


def read_urdf(path: Path, assets_root: Path, read_mesh: Callable[[Path, Path], AuthoredScene]) -> AuthoredScene:
    """Return the links of a URDF file in metres, Z up, in file order; `read_mesh(file, root)` reads a mesh file.

    Raises: SceneFormatError: the file is not URDF, or broken. SceneError: a mesh is missing, too large or outside
    `assets_root`; the message names the root that is needed. MissingExtra: a mesh is COLLADA, and pycollada is not
    installed.
    """
    return _Reader(path, assets_root, read_mesh, _parsed(path)).scene()


def _parsed(path: Path) -> Element:
    """Return the root element of a file."""
    builder = ElementTree.TreeBuilder()

    def start(tag: str, attributes: dict[str, str], line: int, depth: int) -> None:
        if depth == 0 and tag != "robot":
            hint = " An MJCF file has the suffix .xml." if tag == "mujoco" else ""
            raise SceneFormatError(f"{path.name!r} begins with <{tag}>; a URDF file begins with <robot>.{hint}")
        if tag.startswith("xacro:"):
            raise SceneFormatError(f"{path.name!r} has <{tag}>, a macro of xacro. {_EXPAND}")
        builder.start(tag, attributes)

    walk_xml(path, "URDF", MAX_XML_BYTES, start, builder.end)
    return builder.close()


@dataclass(eq=False)
class _Joint:
    """A joint above a link: the link that it is on, its <origin>, its type, and its element."""

    on: str
    origin: Matrix
    kind: str
    row: Element


@dataclass(eq=False)
class _Reader:
    """Reader of one robot. It reads each mesh file once."""

    path: Path
    root: Path
    read_mesh: Callable[[Path, Path], AuthoredScene]
    robot: Element
    _left_out: list[str] = field(default_factory=list)
    _meshes: dict[Path, AuthoredNode] = field(default_factory=dict)
    _paths: dict[str, Path] = field(default_factory=dict)
    _materials: dict[str, Element] = field(default_factory=dict)
    _n_bytes: int = 0
    _size: limits.TreeSize = field(default_factory=limits.TreeSize)

    def __post_init__(self) -> None:
        self._textures = TextureFiles(self.path.parent, self.root)
        self._files = UrdfFiles(self.path, self.root, self.robot.find("mujoco/compiler"))
        for row in self.robot.iter("material"):
            # A material without content only refers to another by name.
            if len(row) and (name := row.get("name")):
                self._materials.setdefault(name, row)

    def scene(self) -> AuthoredScene:
        links = self._named("link")
        limits.at_most("the number of links", len(links), "MAX_OBJECTS")
        joints = self._joints(links)
        frames = self._frames(links, joints)
        nodes = {name: self._link(name, row, frames[name]) for name, row in links.items()}
        turning = {name: _turning(name, joint, frames[name]) for name, joint in joints.items()}
        held = tuple(pivots(turning, {name for name, node in nodes.items() if node.children}))
        return AuthoredScene(tuple(nodes.values()), "z", 1.0, (*self._left_out, *self._textures.left_out), held)

    def _named(self, tag: str) -> dict[str, Element]:
        """Return the direct children of the root with a tag, by name."""
        found: dict[str, Element] = {}
        for row in self.robot.findall(tag):
            name = _text(row, "name", f"a <{tag}>")
            if name in found:
                raise SceneFormatError(f"{self.path.name!r} has two elements <{tag} name={name!r}>; names are unique.")
            found[name] = row
        return found

    # -- poses of links ----------------------------------------------------------------------------------------------

    def _joints(self, links: Collection[str]) -> dict[str, _Joint]:
        """Return the joint of each link that has one."""
        above: dict[str, _Joint] = {}
        for name, row in self._named("joint").items():
            place = f"joint {name!r}"
            parent, child = (_text(_child(row, tag, place), "link", f"{place}: <{tag}>") for tag in ("parent", "child"))
            for link in (parent, child):
                if link not in links:
                    near = checks.did_you_mean(link, links)
                    raise SceneFormatError(f"{place} joins link {link!r}, which does not exist. {near}".rstrip())
            if child in above:
                raise SceneFormatError(f"{place} hangs link {child!r} on {parent!r}; it hangs on {above[child].on!r}.")
            above[child] = _Joint(parent, _origin(row, place), row.get("type") or "", row)
        return above

    def _frames(self, links: Collection[str], above: dict[str, _Joint]) -> dict[str, Matrix]:
        """Return the world transform of each link's frame, with all joints at 0."""
        below: dict[str, list[str]] = {}
        for child, joint in above.items():
            below.setdefault(joint.on, []).append(child)
        frames: dict[str, Matrix] = {name: np.eye(4) for name in links if name not in above}
        todo = list(frames)
        with np.errstate(all="ignore"):  # overflows are refused when meshes are placed
            while todo:
                parent = todo.pop()
                for child in below.get(parent, ()):
                    frames[child] = frames[parent] @ above[child].origin
                    todo.append(child)
        if len(frames) < len(links):
            ring = next(name for name in links if name not in frames)
            raise SceneFormatError(f"link {ring!r} hangs below itself; the links of a robot form a tree.")
        return frames

    # -- looks of links ----------------------------------------------------------------------------------------------

    def _link(self, name: str, row: Element, frame: Matrix) -> AuthoredNode:
        place = f"link {name!r}"
        drawn: list[AuthoredNode] = []
        for tag in ("visual", "collision"):
            if not drawn:
                drawn = [
                    self._drawn(shape, geometry, f"{place}, <{tag}>", shape.get("name") or name)
                    for shape in row.findall(tag)
                    for geometry in shape.findall("geometry")[:1]
                    if len(geometry)
                ]
        mass = row.find("inertial/mass")
        mass_kg = 0.0 if mass is None else _numbers(mass, "value", f"{place}: <mass>", 1)[0]
        if mass_kg < 0.0:
            raise SceneFormatError(f"{place} has a mass of {mass_kg:g} kg; it must be 0 or more.")
        return AuthoredNode(name, frame, (), tuple(drawn), is_object=True, mass_kg=mass_kg or None, key=name)

    def _drawn(self, row: Element, geometry: Element, place: str, name: str) -> AuthoredNode:
        """Return a node with the geometry of a <visual> or <collision>, in the frame of its link."""
        shape, origin = geometry[0], _origin(row, place)
        material = row.find("material")
        if shape.tag == "mesh":
            mesh = self._mesh(_text(shape, "filename", f"{place}, <mesh>"), place)
            with np.errstate(all="ignore"):
                origin = origin @ np.diag([*_numbers(shape, "scale", f"{place}, <mesh>", 3, "1 1 1"), 1.0])
        else:
            mesh = AuthoredNode(name, np.eye(4), _solid(shape, f"{place}, <{shape.tag}>"))
        self._size.add_triangles(mesh.n_triangles)
        if material is not None:
            mesh = self._painted(mesh, material, place)
        return AuthoredNode(name, origin, (), (replace(mesh, name=name),))

    def _painted(self, mesh: AuthoredNode, row: Element, place: str) -> AuthoredNode:
        """Return a node whose pieces without looks of their own have the looks of a <material>."""
        name = row.get("name") or ""
        look = row if len(row) else self._materials.get(name)
        colour, texture = (None, None) if look is None else (look.find("color"), look.find("texture"))
        rgba = None
        if colour is not None:
            r, g, b, a = (min(max(x, 0.0), 1.0) for x in _numbers(colour, "rgba", f"{place}, <color>", 4))
            rgba = (r, g, b, a)
        if texture is not None:
            rgba = self._mean_rgba(texture, place) or rgba
        material = None if rgba is None else FaceMaterial(rgba, name=name)

        def painted(node: AuthoredNode) -> AuthoredNode:
            pieces = tuple(
                piece
                if piece.appearance is not None or piece.material
                else replace(
                    piece,
                    material=name,
                    appearance=None if material is None else Appearance.plain(material, len(piece.faces)),
                )
                for piece in node.pieces
            )
            return replace(node, pieces=pieces, children=tuple(map(painted, node.children)))

        return painted(mesh)

    def _mean_rgba(self, row: Element, place: str) -> tuple[float, float, float, float] | None:
        """Return the mean colour of a texture; None if it cannot be read. Shapes of URDF have no texture
        coordinates."""
        name = row.get("filename") or ""
        try:
            path = self._files.find(name, f"{place}, <texture>")
        except SceneError as error:
            self._textures.refuse(name, str(error))
            return None
        texture = self._textures.named(str(path), lambda: read_bytes(path), False)
        texels = None if texture is None else texture.texels
        if texels is None:
            return None
        r, g, b = (texels[..., :3].reshape(-1, 3).mean(axis=0) / 255.0).tolist()
        return r, g, b, 1.0

    # -- meshes ------------------------------------------------------------------------------------------------------

    def _mesh(self, name: str, place: str) -> AuthoredNode:
        if name not in self._paths:
            self._paths[name] = self._files.find(name, f"{place}, <mesh>")
        path = self._paths[name]
        if path not in self._meshes:
            suffix = path.suffix.lower()
            if suffix not in _MESHES:
                raise SceneError(f"{place} wants the mesh {name!r}; {', '.join(_MESHES)} are read. Convert it.")
            self._n_bytes += path.stat().st_size
            limits.at_most("the bytes of all meshes", self._n_bytes, "MAX_FILE_BYTES")
            try:
                scene = self.read_mesh(path, self.root)
                unit = scene.metres_per_unit(path.name)
            except (SceneError, MissingExtra) as cause:
                raise type(cause)(f"{place}, mesh {name!r}: {cause}") from cause
            self._left_out += scene.left_out
            roots = with_own_keys(scene.roots, str(path))
            self._meshes[path] = AuthoredNode("", np.diag([unit, unit, unit, 1.0]), (), roots)
        return self._meshes[path]


def _turning(name: str, joint: _Joint, frame: Matrix) -> Joint:
    """Return how a link with a frame in the world turns on the link before it."""
    if joint.kind not in ("revolute", "continuous"):
        return Joint(joint.on, "fixed" if joint.kind == "fixed" else "other")
    place = f"joint of link {name!r}: <axis>"
    row = joint.row.find("axis")
    axis = np.array([1.0, 0.0, 0.0] if row is None else _numbers(row, "xyz", place, 3, "1 0 0"))
    if not axis.any():
        raise SceneFormatError(f"{place} is 0 0 0; it must have a direction.")
    with np.errstate(all="ignore"):  # as in `_frames`
        axis = frame[:3, :3] @ axis
        return Joint(joint.on, "turns", frame[:3, 3], axis / np.linalg.norm(axis))


def _origin(row: Element, place: str) -> Matrix:
    """Return the matrix of an <origin>: rotations about the fixed axes x, y, z [rad], then a translation [m]."""
    origin = row.find("origin")
    if origin is None:
        return np.eye(4)
    place = f"{place}: <origin>"
    pose = Pose.from_euler(_numbers(origin, "xyz", place, 3, "0 0 0"), _numbers(origin, "rpy", place, 3, "0 0 0"))
    return transform(pose.rotation, pose.position_m)


def _solid(shape: Element, place: str) -> tuple[Piece, ...]:
    """Return the triangles of a shape; none of a sphere of radius 0, by which authors hide a link."""
    if shape.tag not in _SOLIDS:
        raise SceneFormatError(f"{place}: geometry is a box, cylinder, capsule, sphere or mesh.")
    counts, make = _SOLIDS[shape.tag]
    sizes = [size for key, n in counts.items() for size in _numbers(shape, key, place, n)]
    if not any(sizes):
        return ()
    if min(sizes) <= 0.0 or max(sizes) > limits.MAX_COORDINATE_M:
        raise SceneFormatError(f"{place} has sizes {sizes} m; they must be above 0 and sensible.")
    return (replace(Piece.checked((shape.tag, *sizes), *make(*sizes), "", place), is_made=True),)


def _child(row: Element, tag: str, place: str) -> Element:
    found = row.find(tag)
    if found is None:
        raise SceneFormatError(f"{place} has no <{tag}>.")
    return found


def _text(row: Element, key: str, place: str) -> str:
    text = (row.get(key) or "").strip()
    if not text:
        raise SceneFormatError(f"{place} has no {key}.")
    return text


def _numbers(row: Element, key: str, place: str, n: int, default: str | None = None) -> list[float]:
    """Return the n numbers of an attribute; `default` is used if it is missing.

    Raises: SceneFormatError: it does not have n finite numbers.
    """
    text = row.get(key, default)
    words = [] if text is None else text.split()
    try:
        numbers = [float(word) for word in words]
    except ValueError:
        numbers = []
    if len(numbers) != n or not np.isfinite(numbers).all():
        wanted = "a finite number" if n == 1 else f"{n} finite numbers"
        hint = f" $ is an expression of xacro. {_EXPAND}" if text is not None and "$" in text else ""
        raise SceneFormatError(f"{place}.{key} is {checks.represented(text)}; it must be {wanted}.{hint}")
    return numbers
