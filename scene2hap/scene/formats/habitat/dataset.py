"""Habitat datasets: from a template's name to its model file, with the scale and rotation of that model.

A scene names templates, such as `frl_apartment_chair_01` or a hash. They are searched for in this order:

1. an entry of `configs` in the dataset's `*.scene_dataset_config.json`;
2. `NAME.object_config.json`, `NAME.stage_config.json` or `NAME.ao_config.json` in a folder that this file lists under
   `paths`;
3. a model file that the dataset file lists: `NAME.glb`, or `NAME.urdf` of an articulated object;
4. such a configuration or model anywhere below the dataset's folder, even without a dataset file.

In 1 to 3 a name matches a file's name, the end of its path, or, as in Habitat, any part of its path; of several such
paths, the first in alphabetical order counts. In 4 a name matches a file's name or the end of its path.

Habitat reads two values that it does not apply to the models that it draws. We do not apply them either: the stage's
`origin`, and `units_to_meters`, which causes a warning if it is not 1.

Sources: "Using JSON Files to configure Attributes" (docs/pages/attributesJSON.rst of habitat-sim,
https://aihabitat.org/docs/habitat-sim/attributesJSON.html), and in habitat-sim's src/esp: the names of templates in
metadata/managers/AbstractAttributesManager.h (`getFullAttrNameFromStr`, `buildAttrSrcPathsFromJSONAndLoad`) and
SceneDatasetAttributesManager.cpp, their fields in AbstractObjectAttributesManager.h and ObjectAttributesManager.cpp,
the frame in assets/ResourceManager.cpp (`buildFrameFromAttributes`) and geo/CoordinateFrame.cpp.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Literal
from urllib.parse import quote

import numpy as np

from scene2hap.common import checks
from scene2hap.common.arrays import Floats
from scene2hap.common.printable import quoted, writable
from scene2hap.common.warning import warn_of
from scene2hap.errors import SceneError, SceneFormatError
from scene2hap.scene import limits
from scene2hap.scene.files import inside
from scene2hap.scene.formats.habitat.folder import DatasetFolder, Json, is_file, resolved, with_slashes
from scene2hap.scene.tree import Matrix

Kind = Literal["objects", "stages", "articulated_objects"]

MODEL_SUFFIXES = (".glb", ".gltf", ".obj", ".dae", ".stl", ".ply")
_CONFIG_SUFFIX: dict[Kind, str] = {
    "objects": ".object_config.json",
    "stages": ".stage_config.json",
    "articulated_objects": ".ao_config.json",
}
_URDF = ".urdf"
_SUFFIXES = (*_CONFIG_SUFFIX.values(), _URDF, *MODEL_SUFFIXES)
# Shapes that Habitat generates; they have no file.
_PRIMITIVE = re.compile(r"(capsule3D|cone|cube|cylinder|icosphere|uvSphere)(Solid|Wireframe)(_.*)?")
_OWN_NAME = "%%CONFIG_NAME_AS_ASSET_FILENAME%%"
_ORTHOGONAL = 1e-5


@dataclass(frozen=True, eq=False)
class Template:
    """A model, and its scale, rotation and mass.

    Parameters: place : the file that defines it, for messages; model : the file that is drawn, None for a shape that
        Habitat generates; scale : (3,) [-]; frame : rotates the model's own up and front to Y and -Z; com : (3,) the
        dataset's centre of mass, without scale, None for the middle of the model's box; mass_kg : [kg], None if the
        dataset gives none.
    """

    place: str
    model: Path | None
    scale: Floats
    frame: Matrix
    com: Floats | None = None
    mass_kg: float | None = None


@dataclass(frozen=True, eq=False)
class _Source:
    """The definition of a template: a file, or `attributes` in the dataset file that change another template."""

    file: Path | None = None
    attributes: Json = field(default_factory=dict)
    place: str = ""


class Dataset:
    """The templates of the dataset of a scene."""

    def __init__(self, scene: Path, assets_root: Path | None) -> None:
        """Find the dataset of a scene; see `DatasetFolder`.

        Raises: SceneFormatError, SceneError: the dataset file is broken or too large.
        """
        self._indices: dict[Kind, _Index] = {}
        self._below: _Index | None = None
        self._templates: dict[tuple[Kind, str], Template] = {}
        self.folder: DatasetFolder = DatasetFolder(scene, assets_root)
        self._document, self._file = self._of_scene(scene)
        self.folder.count(scene)

    def template(self, kind: Kind, name: str, place: str) -> Template:
        """Return the template called `name`; `place` is where the scene names it, for messages.

        Raises: SceneFormatError, SceneError: there is none, it is broken, or its model is missing or outside the root.
        """
        if (kind, name) not in self._templates:
            self._templates[kind, name] = self._read(kind, name, place)
        return self._templates[kind, name]

    def _of_scene(self, scene: Path) -> tuple[Json, str]:
        """Return content and name of the dataset file that lists the scene's folder, else of the first dataset file."""
        here, folder = resolved(scene).parent, self.folder
        files = folder.dataset_files
        for file in files if len(files) > 1 else ():
            patterns = _patterns(folder.document(file), "scene_instances", file.name).get(".json", [])
            if any(resolved(match) == here for one in patterns for match in folder.matching(one)):
                return folder.document(file), file.name
        return (folder.document(files[0]), files[0].name) if files else ({}, "")

    # -- names -------------------------------------------------------------------------------------------------------

    def _read(self, kind: Kind, name: str, place: str) -> Template:
        index = self._index(kind)
        source = index.find(name)
        if source is None and _PRIMITIVE.fullmatch(name):
            return Template(name, None, np.ones(3), np.eye(4))
        if source is None:
            below, plain = self._all_below(), _plain(name)
            bare = _URDF if kind == "articulated_objects" else ""
            source = below.exact(plain + _CONFIG_SUFFIX[kind]) or below.exact(plain + bare)
        if source is None:
            known = [*index.names(), *map(_plain, self._all_below().names())]
            hint = checks.did_you_mean(_plain(name).rpartition("/")[2], known)
            raise SceneError(
                f"{place} names the template {name!r}, which the dataset in {quoted(self.folder.path)} does not have. "
                f"{hint or self._advice(kind)}"
            )
        attributes, folder, written_in = self._attributes(kind, source)
        own_name = plain_name(name if source.file is None else writable(source.file.name))
        return self._template(kind, {**self._defaults(kind), **attributes}, folder, written_in, own_name)

    def _advice(self, kind: Kind) -> str:
        if self.folder.outside:
            return (
                f"{self.folder.outside[0]!r} of {self._file} lies outside {quoted(self.folder.root)}; give "
                "assets_root=<the folder that holds both>."
            )
        return (
            f"It wants a file NAME{_CONFIG_SUFFIX[kind]} or NAME{_models(kind)[0]} there; give "
            "assets_root=<the dataset's folder>, and download the dataset whole."
        )

    def _index(self, kind: Kind) -> _Index:
        if kind not in self._indices:
            index = self._indices[kind] = _Index()
            for handle, source in (*self._written(kind), *self._matched(kind)):
                index.add(handle, source)
        return self._indices[kind]

    def _written(self, kind: Kind) -> Iterator[tuple[str, _Source]]:
        """Yield the configurations that the dataset's own file holds."""
        section = _section(self._document, kind, self._file)
        for i, row in enumerate(rows_of(section.get("configs"), f"{self._file}: {kind}.configs")):
            place = f"{self._file}: {kind}.configs[{i}]"
            if not isinstance(row, dict) or not isinstance(row.get("attributes", {}), dict):
                raise SceneFormatError(f"{place} must be an object whose attributes are an object.")
            handle = row.get("template_handle", row.get("original_file"))
            if not isinstance(handle, str):
                raise SceneFormatError(f"{place} has no template_handle; give it a name.")
            yield _plain(handle), _Source(None, row, place)

    def _matched(self, kind: Kind) -> Iterator[tuple[str, _Source]]:
        """Yield the files that the dataset's patterns match, configurations first."""
        patterns = _patterns(self._document, kind, self._file)
        for suffix, ones in sorted(patterns.items(), key=lambda pair: pair[0] != ".json"):
            wanted = _CONFIG_SUFFIX[kind] if suffix == ".json" else suffix
            if suffix == ".json" or suffix in _models(kind):
                for pattern in dict.fromkeys(ones):
                    for handle, file in self.folder.files_of(pattern, wanted):
                        yield handle.removesuffix(wanted), _Source(file)

    def _all_below(self) -> _Index:
        """Return an index of all models below the dataset's folder. Configurations and URDF files keep their suffix in
        it."""
        if self._below is None:
            self._below = _Index()
            found = list(self.folder.all_files(_SUFFIXES))
            for suffix in _SUFFIXES:
                for handle, file in found:
                    if handle.endswith(suffix):
                        handle = handle.removesuffix(suffix) if suffix in MODEL_SUFFIXES else handle
                        self._below.add(handle, _Source(file))
        return self._below

    # -- fields ------------------------------------------------------------------------------------------------------

    def _attributes(self, kind: Kind, source: _Source) -> tuple[Json, Path, str]:
        """Return the document of a template, the folder for its relative paths, and the place of the document."""
        if (file := source.file) is not None:
            is_config = file.name.endswith(_CONFIG_SUFFIX[kind])
            return (self.folder.document(file) if is_config else {_key(kind): file.name}), file.parent, file.name
        original = source.attributes.get("original_file")
        own = source.attributes.get("attributes", {})
        if original is None:
            return own, self.folder.path, source.place
        if not isinstance(original, str):
            raise SceneFormatError(f"{source.place}.original_file is {original!r}; it must be a file name.")
        file = inside(
            self.folder.root, self.folder.path, quote(with_slashes(original)), f"{source.place}.original_file"
        )
        return {**self.folder.document(file), **own}, file.parent, source.place

    def _defaults(self, kind: Kind) -> Json:
        section = _section(self._document, kind, self._file)
        given = section.get("default_attributes", {})
        if not isinstance(given, dict):
            raise SceneFormatError(f"{self._file}: {kind}.default_attributes must be an object.")
        # One mass for all objects of a dataset is a placeholder, not the mass of any object.
        return {key: value for key, value in given.items() if key != "mass"}

    def _template(self, kind: Kind, attributes: Json, folder: Path, place: str, name: str) -> Template:
        def numbers(key: str, default: tuple[float, ...]) -> Floats:
            return np.array(
                checks.vector(f"{place}: {key}", attributes.get(key, default), "-", size=3, error=SceneFormatError)
            )

        which = _key(kind) if attributes.get(_key(kind)) else "collision_asset"
        model = attributes.get(which)
        if not isinstance(model, str) or not model:
            raise SceneFormatError(f"{place}: {_key(kind)} is {model!r}; it must be the name of a model file.")
        unit = attributes.get("units_to_meters", 1.0)
        if checks.number(f"{place}: units_to_meters", unit, "-", above=0.0, error=SceneFormatError) != 1.0:
            warn_of(
                f"{place} has units_to_meters {unit!r}, which Habitat keeps and does not apply; its model is read as "
                "metres. If objects are then too large or too small, set scale there."
            )
        mass = attributes.get("mass", 0.0)
        mass_kg = checks.number(
            f"{place}: mass", mass, "kg", at_least=0.0, at_most=limits.MAX_MASS_KG, error=SceneFormatError
        )
        given = attributes.get("uniform_scale", 1.0) if kind == "articulated_objects" else 1.0
        uniform = checks.number(f"{place}: uniform_scale", given, "-", above=0.0, error=SceneFormatError)
        file = None
        if not _PRIMITIVE.fullmatch(model):
            file = self._model(kind, folder, model.replace(_OWN_NAME, name), f"{place}: {which}")
        return Template(
            place,
            file,
            uniform * scale_of(f"{place}: scale", attributes.get("scale", (1.0, 1.0, 1.0))),
            _frame(numbers("up", (0.0, 1.0, 0.0)), numbers("front", (0.0, 0.0, -1.0))),
            numbers("COM", (0.0, 0.0, 0.0)) if "COM" in attributes else None,
            mass_kg or None,
        )

    def _model(self, kind: Kind, folder: Path, name: str, place: str) -> Path:
        file = inside(self.folder.root, folder, quote(with_slashes(name)), place)
        if file.suffix.lower() not in _models(kind):
            kinds = ", ".join(_models(kind))
            raise SceneFormatError(f"{place} is {name!r}; models of these kinds are read: {kinds}.")
        if not is_file(file):
            near = checks.near_files(file) or "Download the dataset with its models."
            raise SceneError(f"{place} is {name!r}, but there is no file {quoted(file)}. {near}")
        return file


class _Index:
    """Templates by their handles: paths without suffix."""

    def __init__(self) -> None:
        self._by_handle: dict[str, _Source] = {}
        self._by_name: dict[str, list[str]] = {}

    def add(self, handle: str, source: _Source) -> None:
        """Add a template; the first one of a handle counts."""
        if handle not in self._by_handle:
            self._by_handle[handle] = source
            self._by_name.setdefault(handle.rpartition("/")[2], []).append(handle)

    def names(self) -> list[str]:
        """Return the last parts of all handles."""
        return list(self._by_name)

    def exact(self, name: str) -> _Source | None:
        """Return the template whose handle is the name or ends in it."""
        ends = [one for one in self._by_name.get(name.rpartition("/")[2], ()) if f"/{one}".endswith(f"/{name}")]
        return self._by_handle[name if name in ends else min(ends)] if ends else None

    def find(self, name: str) -> _Source | None:
        """Return the template whose handle is the name, else ends in it, else contains it."""
        wanted = _plain(name)
        found = self.exact(wanted)
        if found is None and wanted:
            holding = min((one for one in self._by_handle if wanted in one), default=None)
            found = None if holding is None else self._by_handle[holding]
        return found


def plain_name(template: str) -> str:
    """Return the name of a template without folders and suffix."""
    return _plain(template).rpartition("/")[2]


def scale_of(place: str, given: object) -> Floats:
    """Return a scale (3,); as in Habitat, a negative one mirrors. Raises: SceneFormatError: it is 0 along an axis."""
    scale = checks.vector(place, given, "-", size=3, error=SceneFormatError)
    if 0.0 in scale:
        raise SceneFormatError(f"{place}[{scale.index(0.0)}] is 0; a model without thickness cannot be touched.")
    return np.array(scale)


def rows_of(value: object, place: str) -> list[Any]:
    """Return a list of a file, empty if it is missing. Raises: SceneFormatError: it is something else."""
    if value is not None and not isinstance(value, list):
        raise SceneFormatError(f"{place} is {checks.represented(value)}; it must be a list.")
    return value or []


def _models(kind: Kind) -> tuple[str, ...]:
    """Return the suffixes of model files for a kind of template."""
    return (_URDF,) if kind == "articulated_objects" else MODEL_SUFFIXES


def _key(kind: Kind) -> str:
    """Return the name of the field that contains the model's file."""
    return "urdf_filepath" if kind == "articulated_objects" else "render_asset"


def _frame(up: Floats, front: Floats) -> Matrix:
    """Return the rotation of `up` to Y and `front` to -Z; the identity if they are not perpendicular, as in Habitat."""
    matrix: Matrix = np.eye(4)
    with np.errstate(all="ignore"):
        up, front = up / np.linalg.norm(up), front / np.linalg.norm(front)
    if abs(float(up @ front)) < _ORTHOGONAL:  # also False if one has no length
        matrix[:3, :3] = np.cross(front, up), up, -front
    return matrix


def _section(document: Json, kind: str, place: str) -> Json:
    section = document.get(kind, {})
    if not isinstance(section, dict):
        raise SceneFormatError(f"{place}: {kind} is {checks.represented(section)}; it must be an object.")
    return section


def _patterns(document: Json, kind: str, place: str) -> Mapping[str, list[str]]:
    """Return patterns of paths by the suffix of the files."""
    paths = _section(document, kind, place).get("paths", {})
    if not isinstance(paths, dict):
        raise SceneFormatError(f"{place}: {kind}.paths must be an object of lists.")
    found = {suffix: rows_of(rows, f"{place}: {kind}.paths.{suffix}") for suffix, rows in paths.items()}
    for suffix, patterns in found.items():
        for pattern in patterns:
            if not isinstance(pattern, str) or "\0" in pattern:
                raise SceneFormatError(
                    f"{place}: {kind}.paths[{suffix!r}] has {checks.represented(pattern)}; it must have paths."
                )
    return found


def _plain(name: str) -> str:
    """Return a template's name without the suffix of a configuration or model."""
    name = with_slashes(name)
    for suffix in _SUFFIXES:
        if name.endswith(suffix):
            return name.removesuffix(suffix)
    return name
