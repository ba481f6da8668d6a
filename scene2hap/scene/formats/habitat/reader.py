"""Habitat scenes (`*.scene_instance.json`: HSSD, ReplicaCAD, conversions of AI2-THOR) as authored trees.

1. Every row of `object_instances` is one object: the whole model of its template, with all its nodes. Every row of
   `articulated_object_instances` is one object too: all links of its URDF, with their joints at 0. Y is up.
2. The nodes of the stage (walls, floors) are grouped like the nodes of any file.
3. An object has the frame of its model. `translation_origin`, of the row or else of the scene, is "asset_local", "COM"
   or missing. With "asset_local", `translation` is the position of the model's origin. Otherwise it is the position of
   the centre of mass: `COM` of the configuration times its scale, or else the middle of the model's box. As in Habitat,
   that box joins the boxes of the model's nodes, each rotated by its node's transform. If nodes are rotated, the joined
   box is larger than the box of their vertices. An articulated object is placed by the origin of its URDF.
4. Scale is that of the configuration times `uniform_scale` and `non_uniform_scale`; a negative one mirrors the model.
   `mass` of a configuration is multiplied by the volume of this scale, unless `apply_scale_to_mass` is false, and by
   `mass_scale`. The mass is unknown without `mass`; a mass in `default_attributes`, which all objects share, does not
   count. The mass of an articulated object is the sum over its links, if all links with geometry have one.
5. Left out with a warning: shapes without a file, which Habitat generates. Left out without a warning: rows whose
   `is_instance_visible` is false. As in Habitat, a translation or rotation of the stage is not applied; it causes a
   warning, and so do joints that do not begin at 0.
6. The name of an object comes from `scene2hap.scene.formats.habitat.names`, else from its template. The model of a
   template is read once.

Sources: "Using JSON Files to configure Attributes" (https://aihabitat.org/docs/habitat-sim/attributesJSON.html), and in
habitat-sim's src/esp: metadata/managers/SceneInstanceAttributesManager.cpp (fields; `rotation` begins with w),
metadata/attributes/SceneInstanceAttributes.cpp (defaults), sim/Simulator.cpp (`defaultCOMCorrection`, the stage),
physics/PhysicsManager.cpp (`addObjectInstance`: scale and mass), physics/RigidObject.cpp (`finalizeObject`,
`resetStateFromSceneInstanceAttr`: the centre of mass), scene/SceneNode.cpp (`computeCumulativeBB`).
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass
from itertools import islice
from pathlib import Path
from typing import Any

import numpy as np

from scene2hap.common import checks
from scene2hap.common.arrays import Floats
from scene2hap.common.counted import first_of
from scene2hap.common.printable import writable
from scene2hap.common.warning import warn_of
from scene2hap.errors import MissingExtra, SceneError, SceneFormatError
from scene2hap.scene import limits
from scene2hap.scene.formats.habitat.dataset import Dataset, Kind, Template, rows_of, scale_of
from scene2hap.scene.formats.habitat.folder import Json, read_object
from scene2hap.scene.formats.habitat.names import Names, ObjectNames
from scene2hap.scene.geometry import Bounds, bounds_of, corners_of, joined
from scene2hap.scene.pose import Pose
from scene2hap.scene.tree import AuthoredNode, AuthoredScene, transform, with_own_keys

_INSTANCES: dict[Kind, str] = {
    "objects": "object_instances",
    "articulated_objects": "articulated_object_instances",
}
_NO_STAGE = ("", "none")
_ORIGINS = {"com": True, "asset_local": False, "default": None, "unknown": None}
_MOST_NAMED = 5
# Most files counted for one articulated object (assumed: ten times the files of a kitchen).
_MOST_PARTS = 1_000


def read_habitat(
    path: Path, assets_root: Path | None, names: Names | None, read_model: Callable[[Path, Path], AuthoredScene]
) -> AuthoredScene:
    """Return the scene with its stage and objects. `read_model(file, root)` reads a model file, and files beside it in
    a root.

    Parameters: assets_root : the dataset's folder; None means the folder of the dataset file above the scene, else the
        scene's own. names : object names by template, or the path of a table of them.
    Raises: SceneFormatError, SceneError: the scene, a configuration or a model is broken, missing, or outside the root.
    Warns: SceneWarning: something is left out.
    """
    document = _document(path)
    dataset = Dataset(path, assets_root)
    reader = _Reader(path.name, document, dataset, ObjectNames(names, dataset.folder), read_model)
    with np.errstate(all="ignore"):  # overflows are refused when meshes are placed
        roots = reader.nodes()
    reader.warn()
    return AuthoredScene(tuple(roots), "y", left_out=tuple(reader.left_out))


def referenced_files(path: Path, assets_root: Path | None) -> list[Path]:
    """Return the files of a scene: itself, configurations, tables and models.

    Raises: SceneFormatError, SceneError: as `read_habitat`.
    """
    document = _document(path)
    dataset = Dataset(path, assets_root)
    ObjectNames(None, dataset.folder)
    for kind, place, row in _rows(path.name, document):
        template = _template(dataset, kind, place, row)
        if template is not None and template.model is not None:
            for file in _with_parts(template.model):
                dataset.folder.count(file)
    return list(dict.fromkeys(dataset.folder.files))


@dataclass(frozen=True, eq=False)
class _Model:
    """The nodes of a model file, and the numbers of its triangles and nodes."""

    roots: tuple[AuthoredNode, ...]
    n_triangles: int
    n_nodes: int


class _Reader:
    """Reader that places the models of a scene. It reads each model file once."""

    def __init__(
        self,
        name: str,
        document: Json,
        dataset: Dataset,
        names: ObjectNames,
        read_model: Callable[[Path, Path], AuthoredScene],
    ) -> None:
        self._name, self._document, self._dataset, self._names = name, document, dataset, names
        self._read_model = read_model
        self._models: dict[Path, _Model] = {}
        self._middles: dict[Template, Floats] = {}
        self._size = limits.TreeSize()
        # All models share one budget. With a budget each, thousands of small files could have a million triangles each.
        self._stored = limits.Budget("the triangles of its models", 1_000_000, 1.0)
        self._primitives: Counter[str] = Counter()
        self._bent: Counter[str] = Counter()
        self.left_out: dict[str, None] = {}

    def nodes(self) -> list[AuthoredNode]:
        """Return the nodes of the stage, if there is one, and of all object instances."""
        is_com = _is_com(self._document, self._name, None) is not False
        found = []
        for kind, place, row in _rows(self._name, self._document):
            template = _template(self._dataset, kind, place, row)
            if template is None:
                continue
            if template.model is None:
                self._primitives[template.place] += 1
            elif kind == "stages":
                found.append(self._stage(row, place, template, template.model))
            elif _flag(row, "is_instance_visible", place):
                found.append(self._object(row, place, template, template.model, is_com))
                if kind == "articulated_objects" and _is_bent(row.get("initial_joint_pose")):
                    self._bent[row["template_name"]] += 1
        return found

    def _stage(self, row: Json, place: str, template: Template, file: Path) -> AuthoredNode:
        if np.any(_translation(row, place)) or not np.allclose(_rotation(row, place), np.eye(3)):
            warn_of(f"{place} is moved or turned, which Habitat does not apply to stages; neither is it here.")
        scale = np.append(_scale(row, place) * template.scale, 1.0)
        # The node has no name, so that the stage's own nodes keep their names.
        return AuthoredNode("", template.frame * scale[:, None], (), self._drawn(file, place).roots)

    def _object(self, row: Json, place: str, template: Template, file: Path, is_com: bool) -> AuthoredNode:
        model = self._drawn(file, place)
        scale = _scale(row, place) * template.scale
        rotation = _rotation(row, place)
        origin = _translation(row, place)
        # Habitat places articulated objects by their origin and ignores `translation_origin`.
        if file.suffix != ".urdf" and _is_com(row, place, is_com):
            middle = self._middle(template, model) if template.com is None else template.com
            origin = origin - rotation @ (scale * middle)
        matrix = transform(rotation @ (template.frame[:3, :3] * scale[:, None]), origin)
        name = self._names.of(row["template_name"])
        mass_kg = _mass(row, place, template.mass_kg or _links_kg(model), abs(float(np.prod(scale))))
        return AuthoredNode(name, matrix, (), model.roots, is_object=True, mass_kg=mass_kg)

    def _middle(self, template: Template, model: _Model) -> Floats:
        if template not in self._middles:
            box = _turned_box(AuthoredNode("", template.frame, (), model.roots))
            self._middles[template] = np.zeros(3) if box is None else box.mean(axis=0)
        return self._middles[template]

    def _drawn(self, file: Path, place: str) -> _Model:
        """Return the model in a file, and count its triangles and nodes once more."""
        if file not in self._models:
            self._models[file] = self._read(file, place)
        model = self._models[file]
        self._size.add_triangles(model.n_triangles)
        self._size.add_nodes(model.n_nodes)
        return model

    def _read(self, file: Path, place: str) -> _Model:
        self._dataset.folder.count(file)
        try:
            authored = self._read_model(file, self._dataset.folder.root)
        except MissingExtra:
            raise
        except SceneError as error:
            raise type(error)(f"{place}: its model {file.name!r} cannot be read: {error}") from error
        # Many models may use one picture. Each sentence names the model that lacks the picture.
        for sentence in authored.left_out:
            self.left_out[f"{file.name}: {sentence}"] = None
        roots = with_own_keys(authored.roots, len(self._models))
        nodes = [node for root in roots for node in root.walk()]
        pieces = [piece for node in nodes for piece in node.pieces]
        self._stored.stored += sum(one.stat().st_size for one in _with_parts(file))
        self._stored.spend(sum(len(piece.faces) for piece in set(pieces)), place)
        return _Model(roots, sum(len(piece.faces) for piece in pieces), len(nodes))

    def warn(self) -> None:
        """Warn of everything that is left out."""
        if self._bent:
            warn_of(
                f"{self._name!r} has {self._bent.total()} articulated objects that begin with joints turned "
                f"({first_of(self._bent, _MOST_NAMED)}); they are read with all joints at 0."
            )
        if self._primitives:
            warn_of(
                f"{self._name!r} is read without {self._primitives.total()} shapes that have no model file "
                f"({first_of(self._primitives, _MOST_NAMED)}): Habitat makes these itself."
            )


# -- rows ------------------------------------------------------------------------------------------------------------


def _document(path: Path) -> Json:
    document = read_object(path)
    if not {"stage_instance", "object_instances"} & document.keys():
        raise SceneFormatError(
            f"{path.name!r} is no Habitat scene: it has neither stage_instance nor object_instances. Scenes of "
            "scene2hap itself are named NAME.json."
        )
    n_rows = sum(len(rows_of(document.get(key), f"{path.name}: {key}")) for key in _INSTANCES.values())
    limits.at_most("the number of object instances", n_rows, "MAX_OBJECTS")
    return document


def _rows(name: str, document: Json) -> list[tuple[Kind, str, Json]]:
    """Return the stage's row and the rows of objects, each with its kind and its place for messages."""
    stage = document.get("stage_instance")
    found: list[tuple[Kind, str, Any]] = [] if stage is None else [("stages", f"{name}: stage_instance", stage)]
    for kind, key in _INSTANCES.items():
        found += [
            (kind, f"{name}: {key}[{i}]", row) for i, row in enumerate(rows_of(document.get(key), f"{name}: {key}"))
        ]
    for _, place, row in found:
        if not isinstance(row, dict):
            raise SceneFormatError(f"{place} is {checks.represented(row)}; it must be an object.")
    return found


def _template(dataset: Dataset, kind: Kind, place: str, row: Json) -> Template | None:
    """Return the template of a row; None if the row says that there is no stage."""
    name = row.get("template_name", "" if kind == "stages" else None)
    if kind == "stages" and isinstance(name, str) and name.lower() in _NO_STAGE:
        return None
    if not isinstance(name, str) or not name:
        raise SceneFormatError(f"{place}.template_name is {checks.represented(name)}; it must be a template's name.")
    return dataset.template(kind, writable(name), place)


def _translation(row: Json, place: str) -> Floats:
    given = row.get("translation", (0.0, 0.0, 0.0))
    return np.array(checks.vector(f"{place}.translation", given, "m", size=3, error=SceneFormatError))


def _rotation(row: Json, place: str) -> Floats:
    """Return the rotation (3, 3) of a row, whose quaternion begins with w."""
    given = row.get("rotation", (1.0, 0.0, 0.0, 0.0))
    w, x, y, z = checks.vector(f"{place}.rotation", given, "-", size=4, error=SceneFormatError)
    try:
        return Pose(rotation_xyzw=(x, y, z, w)).rotation
    except SceneError as cause:
        raise SceneFormatError(f"{place}.rotation (w, x, y, z): {cause}") from cause


def _scale(row: Json, place: str) -> Floats:
    """Return the scale (3,) of a row, to be multiplied by its template's."""
    given = row.get("uniform_scale", 1.0)
    uniform = checks.number(f"{place}.uniform_scale", given, "-", above=0.0, error=SceneFormatError)
    return uniform * scale_of(f"{place}.non_uniform_scale", row.get("non_uniform_scale", (1.0, 1.0, 1.0)))


def _is_com(row: Json, place: str, default: bool | None) -> bool | None:
    """Return True if a translation places the centre of mass; `default` if the row does not say."""
    given = row.get("translation_origin", "default")
    known = _ORIGINS.get(given.lower(), "") if isinstance(given, str) else ""
    if isinstance(known, str):
        raise SceneFormatError(
            f"{place}: translation_origin is {checks.represented(given)}; it must be 'COM' or 'asset_local'."
        )
    return default if known is None else known


def _flag(row: Json, key: str, place: str) -> bool:
    return checks.flag(f"{place}.{key}", row.get(key, True), error=SceneFormatError)


def _mass(row: Json, place: str, mass_kg: float | None, volume: float) -> float | None:
    """Return the mass [kg] of an instance, scaled `volume` times, from its template's mass; None if unknown."""
    given = row.get("mass_scale", 1.0)
    factor = checks.number(f"{place}.mass_scale", given, "-", at_least=0.0, error=SceneFormatError)
    if _flag(row, "apply_scale_to_mass", place):
        factor *= volume
    if mass_kg is None or factor == 0.0:
        return None
    scaled_kg = mass_kg * factor
    return checks.number(f"{place}: its mass", scaled_kg, "kg", at_most=limits.MAX_MASS_KG, error=SceneFormatError)


# -- models ----------------------------------------------------------------------------------------------------------


def _turned_box(node: AuthoredNode) -> Bounds | None:
    """Return the box, in the parent's frame, around the turned box of a node and all nodes below; None without any."""
    boxes = [bounds_of(piece.vertices) for piece in node.pieces]
    boxes += [box for child in node.children if (box := _turned_box(child)) is not None]
    if not boxes:
        return None
    return bounds_of(corners_of(joined(boxes)) @ node.matrix[:3, :3].T + node.matrix[:3, 3])


def _with_parts(file: Path) -> list[Path]:
    """Return a model file and its parts: the buffer beside a .gltf, all files below the folder of a .urdf."""
    if file.suffix == ".urdf":
        return sorted(one for one in islice(file.parent.rglob("*"), _MOST_PARTS) if one.is_file())
    buffer = file.with_suffix(".bin")
    return [file, buffer] if file.suffix == ".gltf" and buffer.is_file() else [file]


def _links_kg(model: _Model) -> float | None:
    """Return the mass of a model whose roots are links [kg]; None if any link with geometry has no mass."""
    masses = [root.mass_kg for root in model.roots if root.with_geometry() is not None]
    return None if None in masses else sum(mass for mass in masses if mass is not None) or None


def _is_bent(pose: object) -> bool:
    """Return True if any initial joint position, in a list or in a table by name, is not 0."""
    values = list(pose.values()) if isinstance(pose, dict) else pose
    return isinstance(values, list) and any(value not in (0, None) for value in values)
