"""Material libraries of OBJ files: diffuse colour, opacity and colour texture.

Colours are read as sRGB, as viewers do. File names are taken literally, and may contain blanks and either slash.

Source: Wavefront, MTL material format, Lightwave/Wavefront (1995): Kd, d, Tr, map_Kd with -s and -o.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from pathlib import Path
from urllib.parse import quote

import numpy as np

from scene2hap.common.arrays import Floats
from scene2hap.errors import SceneError
from scene2hap.scene.files import decoded, inside, read_bytes
from scene2hap.scene.looks.appearance import Appearance, FaceMaterial
from scene2hap.scene.looks.texture_files import TextureFiles

# Most words that follow each option of a texture; numbers may be left out.
_OPTIONS = {
    **dict.fromkeys(("-blendu", "-blendv", "-cc", "-clamp", "-imfchan", "-type", "-bm", "-boost", "-texres"), 1),
    "-mm": 2,
    **dict.fromkeys(("-o", "-s", "-t"), 3),
}
MAX_LIBRARIES = 1_000
"""Most libraries that one OBJ file may name (assumed: a hundred times as many as exporters write)."""
_WORD = re.compile(r"\S+")
_COMMENT = re.compile(r"(?:^|\s)#.*")
_NAMES = re.compile(r"\s*(?:[go]|map_\w+|mtllib|newmtl|usemtl)\s", re.IGNORECASE)
_WORDS_AS_VALUES = ("-blendu", "-blendv", "-cc", "-clamp", "-imfchan", "-type")


@dataclass(frozen=True, eq=False)
class MtlMaterial:
    """A material and its texture mapping: image coordinates are `scale` times the faces' coordinates, plus `offset`."""

    paint: FaceMaterial
    scale: tuple[float, float] = (1.0, 1.0)
    offset: tuple[float, float] = (0.0, 0.0)

    def appearance(self, n_faces: int, uv: Floats | None) -> Appearance:
        """Return the looks of m faces. uv : (m, 3, 2) texture coordinates of their corners, v running up, or None."""
        if uv is None or not self.paint.has_texture:
            return Appearance.plain(self.paint.untextured(), n_faces)
        image = uv * self.scale + self.offset
        image[..., 1] = 1.0 - image[..., 1]
        return Appearance.plain(self.paint, n_faces, image.astype(np.float32))


@dataclass(eq=False)
class MtlLibraries:
    """The materials that the libraries of one OBJ file define, by name; a later one replaces an earlier one."""

    textures: TextureFiles
    materials: dict[str, MtlMaterial] = field(default_factory=dict)
    _read: set[str] = field(default_factory=set)
    _paths: set[Path] = field(default_factory=set)

    def read(self, names: str) -> None:
        """Read the libraries that a `mtllib` statement names: one name with blanks, or several.

        A library that is missing, broken or outside the assets root is recorded in `textures`.
        Raises: SceneError: the file names too many.
        """
        lower = names.lower()
        for name in (names,) if lower.endswith(".mtl") and lower.count(".mtl") == 1 else names.split():
            if name in self._read:
                continue
            if len(self._read) == MAX_LIBRARIES:
                raise SceneError(
                    f"mtllib names {names[:40]!r} and more: over {MAX_LIBRARIES:,} material libraries in all. "
                    "Join them into one, or remove the statements."
                )
            self._read.add(name)
            uri = _uri(name, self.textures.folder)
            try:
                path = inside(self.textures.assets_root, self.textures.folder, uri, "mtllib")
                if path in self._paths:
                    continue
                self._paths.add(path)
                data = read_bytes(path)
            except SceneError as error:
                self.textures.refuse(name, str(error))
                continue
            for material, rows in _blocks(decoded(data)):
                self.materials[material] = self._material(rows, material)

    def _material(self, rows: dict[str, str], name: str) -> MtlMaterial:
        color = _numbers(rows.get("kd", ""), 3) or (0.8, 0.8, 0.8)
        opacity = 1.0
        if (number := _numbers(rows.get("d", "").removeprefix("-halo"), 1)) is not None:
            opacity = number[0]
        elif (number := _numbers(rows.get("tr", ""), 1)) is not None:
            opacity = 1.0 - number[0]
        r, g, b, a = (min(max(channel, 0.0), 1.0) for channel in (*color, opacity))
        file, mapping = _texture(rows.get("map_kd", ""))
        if not file:
            return MtlMaterial(FaceMaterial((r, g, b, a), name=name))
        texture = self.textures.from_file(
            _uri(file, self.textures.folder), f"material {name!r}", keeps_alpha="map_d" in rows
        )
        # Some exporters write black or no colour if there is a texture. Multiplying by it would hide the texture.
        if texture is not None and (r == g == b == 0.0 or "kd" not in rows):
            r = g = b = 1.0
        return replace(mapping, paint=FaceMaterial((r, g, b, a), texture, name))


def without_comment(line: str) -> str:
    """Return a line of an OBJ or MTL file without its comment. A name may contain the sign (`Chair#2`), no number."""
    if "#" not in line:
        return line
    return _COMMENT.sub("", line) if _NAMES.match(line) else line.partition("#")[0]


def _blocks(text: str) -> Iterator[tuple[str, dict[str, str]]]:
    """Yield each material's name and its statements by lower-case keyword."""
    name, rows = None, dict[str, str]()
    for line in text.splitlines():
        keyword, _, rest = without_comment(line).strip().replace("\t", " ").partition(" ")
        if keyword.lower() == "newmtl":
            if name is not None:
                yield name, rows
            name, rows = rest.strip(), {}
        elif keyword:
            rows[keyword.lower()] = rest.strip()
    if name is not None:
        yield name, rows


def _texture(statement: str) -> tuple[str, MtlMaterial]:
    """Return the file that a map statement names, and the texture's mapping."""
    mapping = MtlMaterial(FaceMaterial())
    # A statement may have a megabyte of options, so its words are split once, with their positions.
    words = list(_WORD.finditer(statement))
    at = 0
    while at < len(words) and words[at].group().startswith("-"):
        option = words[at].group().lower()
        at += 1
        values: list[str] = []
        while at < len(words) and len(values) < _OPTIONS.get(option, 0):
            word = words[at].group()
            if option not in _WORDS_AS_VALUES and _numbers(word, 1) is None:
                break
            values.append(word)
            at += 1
        # Three values are for u, v and depth; v and depth may be left out.
        if option == "-s":
            mapping = replace(mapping, scale=_pair(values, 1.0))
        elif option == "-o":
            mapping = replace(mapping, offset=_pair(values, 0.0))
    file = statement[words[at].start() :] if at < len(words) else ""
    return file.strip().strip('"'), mapping


def _pair(words: list[str], default: float) -> tuple[float, float]:
    u, v = [*map(float, words), default, default][:2]
    return u, v


def _numbers(text: str, n: int) -> tuple[float, ...] | None:
    """Return the first n numbers of a text; None if it does not begin with n finite numbers."""
    try:
        values = tuple(map(float, text.split(None, n)[:n]))
    except ValueError:
        return None
    return values if len(values) == n and np.isfinite(values).all() else None


def _uri(name: str, folder: Path) -> str:
    """Return the address of a file. Some exporters write names as addresses already: "wood%20oak.png"."""
    plain = name.strip().strip('"').replace("\\", "/")
    return plain if "%" in plain and not os.path.exists(folder / plain) else quote(plain)
