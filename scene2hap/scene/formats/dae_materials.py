"""Materials of COLLADA files: diffuse colour or texture, and opacity.

Colours are read as sRGB, since exporters write them so.

Source: COLLADA 1.4.1 specification (Khronos, 2008), chapter 8: <profile_COMMON>, <transparent>, <bind_vertex_input>.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from scene2hap.common.arrays import Floats32
from scene2hap.scene.looks.appearance import Appearance, FaceMaterial
from scene2hap.scene.looks.texture_files import TextureFiles


@dataclass(eq=False)
class DaeMaterials:
    """Reader of the looks of pycollada's primitives. It reads each effect once."""

    collada: Any
    textures: TextureFiles
    _materials: dict[str, FaceMaterial] = field(default_factory=dict)

    def appearance(self, primitive: Any, link: Any) -> Appearance | None:
        """Return the looks of a triangle set under an <instance_material>. If they are broken: None, and the reason is
        recorded."""
        try:
            return self._appearance(primitive, link)
        # pycollada does not validate these values. Geometry does not depend on them, so a broken material is no error.
        except (ArithmeticError, AttributeError, LookupError, TypeError, ValueError) as cause:
            name = str(link.target.id)
            self.textures.refuse(f"material {name}", f"material {name!r} makes no sense: {cause}.")
            return None

    def _appearance(self, primitive: Any, link: Any) -> Appearance:
        effect = link.target.effect
        key = str(effect.id)
        if key not in self._materials:
            self._materials[key] = self._material(effect, str(link.target.id))
        material, uv = self._materials[key], None
        if material.has_texture:
            uv = _coordinates(primitive, _texture_set(link, _paint(effect).texcoord))
            if uv is None:
                material = material.untextured()
        return Appearance.plain(material, len(primitive.vertex_index), uv)

    def _material(self, effect: Any, name: str) -> FaceMaterial:
        paint, opacity, is_map = _paint(effect), self._opacity(effect), self._is_map
        if not is_map(paint):
            r, g, b = FaceMaterial().color_rgba[:3] if paint is None else _color(paint)
            return FaceMaterial((r, g, b, opacity))
        uri = str(paint.sampler.surface.image.path).strip()
        texture = self.textures.from_file(uri, f"material {name!r}", keeps_alpha=is_map(effect.transparent))
        return FaceMaterial((1.0, 1.0, 1.0, opacity), texture)

    def _is_map(self, value: Any) -> bool:
        return isinstance(value, self.collada.material.Map)

    def _opacity(self, effect: Any) -> float:
        transparent, part = effect.transparent, effect.transparency
        part = 1.0 if part is None else float(part)
        is_plain = transparent is not None and not self._is_map(transparent)
        if effect.opaque_mode == self.collada.material.OPAQUE_MODE.RGB_ZERO:
            opacity = 1.0 - part * (float(np.mean(_color(transparent))) if is_plain else 0.0)
        else:
            opacity = part * (float(transparent[3]) if is_plain and len(transparent) > 3 else 1.0)
        # Exporters that use the opposite convention write 0 for opaque materials. Taken literally, they would be
        # invisible.
        return float(np.clip(opacity, 0.0, 1.0)) or 1.0


def _paint(effect: Any) -> Any:
    """Return the colour or map that decides most of an effect's looks. A constant shader has no diffuse light."""
    return effect.emission if effect.shadingtype == "constant" else effect.diffuse


def _color(value: Any) -> tuple[float, float, float]:
    r, g, b = np.clip(np.nan_to_num(np.asarray(value[:3], dtype=np.float64)), 0.0, 1.0).tolist()
    return r, g, b


def _texture_set(link: Any, symbol: str) -> str | None:
    """Return the set of texture coordinates that is bound to an effect's symbol; None if the file does not say."""
    return next((number for name, kind, number in link.inputs if name == symbol and kind == "TEXCOORD"), None)


def _coordinates(primitive: Any, number: str | None) -> Floats32 | None:
    """Return coordinates (m, 3, 2) of a set, or of the first set if there is no such set. v runs down."""
    tables, indices = primitive.texcoordset, primitive.texcoord_indexset
    if not tables:
        return None
    sets = [row[3] for row in primitive.sources.get("TEXCOORD", [])]
    which = sets.index(number) if number in sets else 0
    uv: Floats32 = np.asarray(tables[which], dtype=np.float32)[np.asarray(indices[which])][..., :2].copy()
    uv[..., 1] = 1.0 - uv[..., 1]
    return uv
