"""Find and bound the files that an MJCF file makes MuJoCo read, before MuJoCo opens any.

MuJoCo opens any file that an MJCF file names, `../../x` and absolute paths included, and makes any number of copies. So
this module reads the include graph first. MuJoCo's versions differ in the base folder of included files, so a name may
mean several files. None of these files may be outside the root.

Source: MuJoCo documentation (Google DeepMind), XML reference, `include`, `compiler`, `asset`, `replicate`.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from math import prod
from pathlib import Path
from typing import NamedTuple

from scene2hap.common.files import is_there
from scene2hap.common.printable import quoted
from scene2hap.errors import SceneError, SceneFormatError, reason_of
from scene2hap.scene import limits
from scene2hap.scene.files import outside, usable_name
from scene2hap.scene.formats.xml_files import walk_xml

MAX_XML_BYTES = 1 << 26
"""Largest size of one XML file [bytes] (assumed: a hundred times a large robot)."""
MAX_FILES_DEEP = 20
"""Greatest depth of files within files (assumed)."""
MAX_COPIES = 10_000
"""Most copies of one place in the file (assumed: MuJoCo takes 14 s to compile 10,000 bodies)."""
MAX_COPIED_ELEMENTS = 50_000
"""Most elements of all copies together (assumed: MuJoCo takes some seconds for them)."""
MAX_CELLS = 1 << 25
"""Most cells of all textures and height fields, besides those of stored pictures (assumed: eight of 2048 x 2048)."""
_CELLS_PER_BYTE = 20.0
"""Cells allowed for each stored byte of a picture (assumed: ten times the cells of photographs)."""
MAX_INCLUDED = 1_000
"""Most files that one model includes (assumed: as many as a kitchen with hundreds of objects has)."""
MAX_MODELS = 200
"""Most models within models; a model counts each time it is named (assumed)."""
MAX_RESERVED = 1_000
"""Greatest number of values that <size> may reserve in each element, or of key frames (assumed)."""
MAX_MESH_STEPS = 200
"""Most subdivisions of a built-in mesh (assumed: 80,000 triangles)."""
MAX_MADE_TRIANGLES = 400_000
"""Most triangles of all built-in meshes together (assumed: MuJoCo takes 600 bytes for each while it compiles)."""
FREE_MESH_BYTES, MESH_BYTES_PER_STORED = 8 << 20, 2.0
"""Bound on the bytes of all mesh files together; a file counts once for each element that names it.

The bound is a fixed number, plus a multiple of the stored bytes. Assumed: MuJoCo decodes a file again for every such
element, a megabyte in 0.2 s.
"""

# Elements that multiply their content, and elements that make a grid of cells, with the attributes for the numbers.
_COPIES = {"replicate": "count", "composite": "count", "flexcomp": "count"}
_BODIES = frozenset({"body", "composite", "flexcomp"})
_GRIDS = {"texture": ("width", "height"), "hfield": ("nrow", "ncol")}


def check_files(path: Path, assets_root: Path) -> None:
    """Check that MuJoCo may open an MJCF file and all files that it names.

    Raises: SceneFormatError: it is not well-formed XML, not MJCF, has a document type, or includes a file twice.
    SceneError: a file is missing, too large or outside `assets_root`; the message names the root that is needed.
    """
    root = assets_root.resolve()
    path = path.resolve()
    if not path.is_relative_to(root):
        raise SceneError(f"{quoted(path)} lies outside assets_root {quoted(root)}; give a folder that holds the scene.")
    _Model(path, root).check()


class _Wanted(NamedTuple):
    """A file that an element names: the place and folder of the element, the file's name, and the element's kind."""

    place: str
    folder: Path
    name: str
    kind: str


class _Totals:
    """Totals of a model and all models in it, since a million small elements cost as much as a large one."""

    def __init__(self) -> None:
        self.cells = limits.Budget(
            "the cells of textures and height fields", MAX_CELLS, _CELLS_PER_BYTE, unit="bytes of pictures"
        )
        self.made = limits.Budget("the triangles of built-in meshes", MAX_MADE_TRIANGLES)
        self.mesh_bytes = limits.Budget(
            "the bytes of mesh files, as often as they are named,",
            FREE_MESH_BYTES,
            MESH_BYTES_PER_STORED,
            advice="Name each file in one <mesh>, and use that mesh in all geoms.",
        )
        self.copied = limits.Budget("the elements of all copies", MAX_COPIED_ELEMENTS, advice="Copy less.")
        self.n_bodies = 0
        self.models = limits.Budget("the models within models", MAX_MODELS, advice="Name fewer.")


@dataclass
class _Model:
    """An MJCF file with all included files; `around` are the models that contain this one."""

    path: Path
    root: Path
    around: tuple[Path, ...] = ()
    seen: set[Path] = field(default_factory=set)
    mesh_folders: list[str] = field(default_factory=lambda: [""])
    texture_folders: list[str] = field(default_factory=lambda: [""])
    strips_paths: bool = False
    assets: list[_Wanted] = field(default_factory=list)
    outside: list[tuple[_Wanted, Path]] = field(default_factory=list)
    totals: _Totals = field(default_factory=_Totals)

    def check(self) -> None:
        _not_too_deep(self.path, len(self.around))
        self.read(self.path, copies=1, depth=0)
        # The folders are known only after reading: the last <compiler> with a folder also applies to earlier elements.
        read: set[Path] = set()
        for wanted in self.assets:
            found = self.find(wanted)
            if found is None:
                continue
            size = found.stat().st_size
            limits.at_most(f"the size of {found.name!r} in bytes", size, "MAX_FILE_BYTES")
            if wanted.kind == "model":
                self.totals.models.spend(1, wanted.place)
                _Model(found, self.root, (*self.around, self.path), totals=self.totals).check()
            elif wanted.kind in _GRIDS:
                self.totals.cells.stored += size
                self.totals.cells.spend(_png_cells(found), wanted.place)
            else:
                self.totals.mesh_bytes.stored += 0 if found in read else size
                self.totals.mesh_bytes.spend(size, wanted.place)
                read.add(found)
        if self.outside:
            wanted = self.outside[0][0]
            beyond = (path for _, path in self.outside)
            raise outside(wanted.place, wanted.name, self.root, *beyond)

    def read(self, path: Path, copies: int, depth: int) -> None:
        """Read the model's own file or an included one, inside an element that is copied `copies` times."""
        _not_too_deep(path, depth)
        if path in self.seen or path in self.around:
            raise SceneFormatError(f"{path.name!r} is included twice; MuJoCo takes every file once.")
        self.seen.add(path)
        if len(self.seen) > MAX_INCLUDED:
            raise SceneError(f"{path.name!r} is one of more than {MAX_INCLUDED:,} included files. Join them.")
        _Reader(self, path, [copies], depth).read()

    def find(self, wanted: _Wanted) -> Path | None:
        """Return the file with a wanted name. If it is outside the root: None, and the file is recorded."""
        with usable_name(wanted.name, wanted.place):
            candidates = [(base / self._name(wanted)).resolve() for base in self._bases(wanted)]
            existing = [path for path in candidates if is_there(path)]
        beyond = [path for path in existing or candidates if not path.is_relative_to(self.root)]
        if beyond:
            self.outside.append((wanted, beyond[0]))
            return None
        if not existing:
            raise SceneError(f"{wanted.place} wants {wanted.name!r}; there is no such file. Copy it beside the scene.")
        return existing[0]

    def _bases(self, wanted: _Wanted) -> list[Path]:
        own = self.path.parent
        if wanted.kind == "include":
            return [own, wanted.folder]
        named = self.texture_folders if wanted.kind == "texture" else self.mesh_folders
        return [base / _plain(inner) for base in dict.fromkeys([own, wanted.folder]) for inner in reversed(named)]

    def _name(self, wanted: _Wanted) -> str:
        name = _plain(wanted.name)
        return Path(name).name if self.strips_paths and wanted.kind != "include" else name


@dataclass
class _Reader:
    """Reader of one XML file that adds the named files to its model.

    `open_copies` : the number of copies of the whole file, and of each open element's content.
    """

    model: _Model
    path: Path
    open_copies: list[int]
    depth: int

    def read(self) -> None:
        # MuJoCo always reads UTF-8 and ignores a declared encoding, so this parser must too.
        walk_xml(self.path, "MJCF", MAX_XML_BYTES, self._start, lambda tag: self.open_copies.pop(), encoding="utf-8")

    def _start(self, tag: str, attributes: Mapping[str, str], line: int, level: int) -> None:
        tag = tag.lower()
        place = f"{self.path.name}, line {line}, <{tag}>"
        if level == 0 and self.depth == 0 and tag != "mujoco":
            hint = " A URDF file has the suffix .urdf." if tag == "robot" else ""
            raise SceneFormatError(f"{self.path.name!r} begins with <{tag}>; an MJCF file begins with <mujoco>.{hint}")
        self.open_copies.append(self._counted(tag, attributes, place, self.open_copies[-1]))
        if tag == "compiler":
            self._compiler(attributes)
        if tag == "size":
            for key in attributes:
                if key == "nkey" or key.startswith("nuser"):
                    _at_most(f"{key} of {place}", attributes[key], MAX_RESERVED)
        if tag == "mesh" and "builtin" in attributes:
            for number in attributes.get("params", "").split():
                _at_most(f"a parameter of {place}", number, MAX_MESH_STEPS)
            self.model.totals.made.spend(_made_triangles(attributes), place)
        # MuJoCo reserves the longest row of user numbers in each element of its kind.
        if "user" in attributes and (n := len(attributes["user"].split())) > MAX_RESERVED:
            raise SceneError(f"user of {place} has {n:,} numbers; up to {MAX_RESERVED:,} are read.")
        for key, name in attributes.items():
            # The attributes for a cube's sides are fileright, fileleft, ...
            if key.startswith("file") and name:
                wanted = _Wanted(place, self.path.parent, name, tag)
                if tag != "include":
                    self.model.assets.append(wanted)
                elif (found := self.model.find(wanted)) is not None:
                    self.model.read(found, self.open_copies[-1], self.depth + 1)

    def _counted(self, tag: str, attributes: Mapping[str, str], place: str, around: int) -> int:
        """Return the number of copies of this element's content."""
        if tag in _COPIES:
            around *= _product(attributes.get(_COPIES[tag], ""))
            if around > MAX_COPIES:
                raise SceneError(f"{place} makes {around:,} copies; MJCF with up to {MAX_COPIES:,} is read.")
        if tag in _GRIDS:
            cells = _product(" ".join(attributes.get(key, "") for key in _GRIDS[tag]))
            if tag == "texture" and attributes.get("type", "cube") != "2d":
                # The six sides of a cube are as high as they are wide.
                cells = max(cells, 6 * _product(attributes.get("width", "")) ** 2)
            self.model.totals.cells.spend(cells, place)
        if tag in _BODIES:
            self.model.totals.n_bodies += around
            limits.at_most("the number of bodies", self.model.totals.n_bodies, "MAX_OBJECTS")
        if around > 1:
            self.model.totals.copied.spend(around, place)
        return around

    def _compiler(self, attributes: Mapping[str, str]) -> None:
        model = self.model
        for key, folders in {"meshdir": model.mesh_folders, "texturedir": model.texture_folders}.items():
            folders += [attributes[name] for name in ("assetdir", key) if name in attributes]
        if "strippath" in attributes:
            model.strips_paths = attributes["strippath"] == "true"


def _not_too_deep(path: Path, depth: int) -> None:
    if depth > MAX_FILES_DEEP:
        raise SceneError(f"{path.name!r} stands in {depth} files, one in the other; up to {MAX_FILES_DEEP} are read.")


def _png_cells(path: Path) -> int:
    """Return the pixels of a PNG file by its header, before MuJoCo unpacks it; 0 for other files, which are not packed.

    Raises: SceneError: the file cannot be read.
    """
    try:
        with path.open("rb") as file:
            start = file.read(24)
    except OSError as cause:
        raise SceneError(f"{quoted(path)} cannot be read: {reason_of(cause)}.") from cause
    if not start.startswith(b"\x89PNG\r\n\x1a\n"):
        return 0
    return int.from_bytes(start[16:20], "big") * int.from_bytes(start[20:24], "big")


def _made_triangles(attributes: Mapping[str, str]) -> int:
    """Estimate the triangles of a built-in mesh: a sphere is subdivided again and again, other shapes into squares."""
    steps = max((_product(number) for number in attributes.get("params", "").split()), default=1)
    return 20 * 4 ** min(steps, 10) if attributes["builtin"] == "sphere" else 4 * steps**2


def _at_most(what: str, number: str, most: int) -> None:
    """Check a number in a text. Raises: SceneError: it is larger. MuJoCo itself refuses texts that are no numbers."""
    if _product(number) > most:
        raise SceneError(f"{what} is {number[:40]!r}; up to {most:,} is read.")


def _plain(name: str) -> str:
    """Replace backslashes by slashes, as MuJoCo does on every system."""
    return name.replace("\\", "/")


def _product(numbers: str) -> int:
    """Return the product of the numbers in a text; 1 if it has invalid numbers, which MuJoCo will refuse."""
    try:
        return prod(max(1, int(float(number))) for number in numbers.split())
    except (ValueError, OverflowError):
        return 1
