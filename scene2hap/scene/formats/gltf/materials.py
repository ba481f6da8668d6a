"""Materials of a glTF file: base colour (diffuse colour in older files), multiplied with its texture.

A broken material loses its texture, but the scene is still read. Samplers are not read: textures repeat.

Source: glTF 2.0 specification, section 3.9; extensions KHR_materials_pbrSpecularGlossiness, KHR_texture_transform,
EXT_texture_webp.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from scene2hap.common import checks
from scene2hap.errors import SceneError, SceneFormatError
from scene2hap.scene.formats.gltf.accessors import view
from scene2hap.scene.formats.gltf.container import GltfFile, Json, data_uri, mapping, natural
from scene2hap.scene.looks.appearance import FaceMaterial, srgb
from scene2hap.scene.looks.texture_files import TextureFiles
from scene2hap.scene.looks.textures import EncodedTexture

Affine = NDArray[np.float64]
"""(2, 3) matrix from texture coordinates (u, v, 1) of the mesh to those of the image."""


@dataclass(frozen=True, eq=False)
class TexturedMaterial:
    """A material, its set of texture coordinates, and their transform."""

    material: FaceMaterial
    uv_set: int = 0
    transform: Affine = field(default_factory=lambda: np.eye(2, 3))


@dataclass(eq=False)
class GltfMaterials:
    """Reader of a file's materials. It reads each material once."""

    file: GltfFile
    textures: TextureFiles
    _paints: dict[int, TexturedMaterial] = field(default_factory=dict)

    def paint(self, number: int, row: Json) -> TexturedMaterial:
        """Return the paint of row `number` of the materials."""
        if number not in self._paints:
            try:
                self._paints[number] = self._paint(row, f"materials[{number}]")
            except SceneError as error:
                self.textures.refuse(f"materials[{number}]", str(error))
                self._paints[number] = TexturedMaterial(FaceMaterial((1.0, 1.0, 1.0, 1.0)))
        return self._paints[number]

    def _paint(self, row: Json, place: str) -> TexturedMaterial:
        pbr = mapping(row.get("pbrMetallicRoughness"))
        color, info = pbr.get("baseColorFactor"), pbr.get("baseColorTexture")
        older = mapping(mapping(row.get("extensions")).get("KHR_materials_pbrSpecularGlossiness"))
        if older:
            color, info = older.get("diffuseFactor"), older.get("diffuseTexture")
        r, g, b, a = checks.vector(
            f"the colour of {place}", [1.0] * 4 if color is None else color, "-", size=4, error=SceneFormatError
        )
        # Opacity is used only if the material declares it. Images often store other data in that channel.
        keeps_alpha = row.get("alphaMode") in ("MASK", "BLEND")
        r, g, b = srgb((r, g, b)).tolist()
        rgba = (r, g, b, min(max(a, 0.0), 1.0) if keeps_alpha else 1.0)
        name = str(row.get("name", ""))
        if not isinstance(info, dict):
            return TexturedMaterial(FaceMaterial(rgba, name=name))
        place = f"{place}, its texture"
        try:
            texture = self._texture(info.get("index"), place, keeps_alpha)
            transform = mapping(mapping(info.get("extensions")).get("KHR_texture_transform"))
            uv_set = natural(transform.get("texCoord", info.get("texCoord", 0)), f"{place}.texCoord")
            return TexturedMaterial(FaceMaterial(rgba, texture, name), uv_set, _affine(transform, place))
        except SceneError as error:
            self.textures.refuse(place, str(error))
            return TexturedMaterial(FaceMaterial(rgba, name=name))

    def _texture(self, number: object, place: str, keeps_alpha: bool) -> EncodedTexture | None:
        row = self.file.row("textures", number, place)
        webp = mapping(mapping(row.get("extensions")).get("EXT_texture_webp"))
        source = webp.get("source", row.get("source"))
        if source is None:
            kinds = ", ".join(mapping(row.get("extensions"))) or "none"
            raise SceneFormatError(
                f"{place}: textures[{number}] names no image that is read (its extensions: {kinds})."
            )
        image = self.file.row("images", source, place)
        uri, name = image.get("uri"), f"images[{source}]"
        if not isinstance(uri, str):
            return self.textures.named(name, lambda: self._embedded(image.get("bufferView"), name), keeps_alpha)
        if uri.startswith("data:"):
            return self.textures.named(name, lambda: data_uri(uri, name), keeps_alpha)
        return self.textures.from_file(uri, name, keeps_alpha=keeps_alpha)

    def _embedded(self, number: object, place: str) -> bytes:
        data = view(self.file, number, place)[0]
        self.file.image_bytes.spend(len(data), place)
        return bytes(data)


def _affine(row: Json, place: str) -> Affine:
    """Return the matrix that scales, then rotates counter-clockwise as seen on the image (v runs down), then moves."""
    (angle,) = checks.vector(f"{place}.rotation", [row.get("rotation", 0.0)], "rad", size=1, error=SceneFormatError)
    offset = checks.vector(f"{place}.offset", row.get("offset", (0.0, 0.0)), "-", size=2, error=SceneFormatError)
    scale = checks.vector(f"{place}.scale", row.get("scale", (1.0, 1.0)), "-", size=2, error=SceneFormatError)
    turn = np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
    return np.column_stack((turn * scale, offset))
