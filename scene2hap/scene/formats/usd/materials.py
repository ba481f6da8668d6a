"""Looks of USD prims: UsdPreviewSurface with its texture, else the primvar displayColor.

A broken material loses its texture, but the scene is still read. Wrap modes are not read: textures repeat. Of materials
of other renderers (MDL, MaterialX), only the names are read.

Source: OpenUSD, "UsdPreviewSurface Specification", version 2.6: nodes UsdPreviewSurface, UsdUVTexture,
UsdPrimvarReader_float2, UsdTransform2d.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from pxr import Sdf, Tf, UsdGeom, UsdShade

from scene2hap.common.arrays import Floats, Ints
from scene2hap.errors import SceneFormatError
from scene2hap.scene.formats.usd.layers import Layers
from scene2hap.scene.formats.usd.meshes import Triangles
from scene2hap.scene.formats.usd.values import name_of, rest_time, value
from scene2hap.scene.looks.appearance import Appearance, FaceMaterial, painted, srgb

# Most nodes between a texture and its primvar: a transform or two (assumed).
_MAX_NODES_OF_ST = 4


@dataclass(frozen=True, eq=False)
class _TexturedMaterial:
    """A material, the primvar of its texture coordinates, and their transform (2, 3)."""

    material: FaceMaterial
    primvar: str = "st"
    transform: Floats = field(default_factory=lambda: np.eye(2, 3))


class UsdMaterials:
    """Reader of a stage's materials. It reads each material once."""

    def __init__(self, layers: Layers) -> None:
        self._layers, self._textures = layers, layers.textures
        self._paints: dict[Any, _TexturedMaterial | None] = {}

    def bound(self, prim: Any) -> Any:
        """Return the material bound to a prim or to one above it (`UsdShade.Material`, false if there is none)."""
        return UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial()[0]

    def looks(self, prim: Any, bound: Any, found: Triangles, rows: Ints) -> Appearance | None:
        """Return the looks of some triangles of a gprim under its bound material; None if the file has none."""
        paint = self._paint(bound) if bound else None
        if paint is None:
            return self._displayed(prim, found, rows)
        material, uv = paint.material, None
        if material.has_texture:
            st = self._primvar(prim, paint.primvar, 2, found)
            if st is None:
                material = material.untextured()
            else:
                uv = st[rows] @ paint.transform[:, :2].T + paint.transform[:, 2]
                uv[..., 1] = 1.0 - uv[..., 1]
        return Appearance.plain(material, len(rows), None if uv is None else uv.astype(np.float32))

    # -- primvars ----------------------------------------------------------------------------------------------------

    def _displayed(self, prim: Any, found: Triangles, rows: Ints) -> Appearance | None:
        colors = self._primvar(prim, "displayColor", 3, found)
        if colors is None:
            return None
        rgba = np.ones((len(rows), 4))
        rgba[:, :3] = srgb(np.nan_to_num(colors[rows].mean(axis=1)))
        opacity = self._primvar(prim, "displayOpacity", 1, found)
        if opacity is not None:
            rgba[:, 3] = opacity[rows].mean(axis=1)[:, 0]
        return painted(rgba, FaceMaterial((1.0, 1.0, 1.0, 1.0)))

    def _primvar(self, prim: Any, name: str, columns: int, found: Triangles) -> Floats | None:
        """Return values (m, 3, columns) at the corners; None if there are none. If they do not fit, the reason is
        recorded."""
        primvar = UsdGeom.PrimvarsAPI(prim).FindPrimvarWithInheritance(name)
        if not primvar or not primvar.HasValue():
            return None
        place = f"primvar {name!r} of {prim.GetPath()}"
        try:
            stored = primvar.ComputeFlattened(rest_time((primvar.GetAttr(),)))
            values = np.array(stored, dtype=np.float64).reshape(-1, columns)
            corners = found.at_corners(values, str(primvar.GetInterpolation()))
        # The values may have another type than the name implies.
        except (Tf.ErrorException, TypeError, ValueError) as cause:
            self._textures.refuse(place, f"{place} makes no sense: {' '.join(str(cause).split())[:200]}.")
            return None
        if corners is None and not found.is_made:
            self._textures.refuse(place, f"{place} has {len(values)} values, which do not fit its interpolation.")
        return corners

    # -- materials ---------------------------------------------------------------------------------------------------

    def _paint(self, bound: Any) -> _TexturedMaterial | None:
        path = bound.GetPath()
        if path not in self._paints:
            try:
                self._paints[path] = self._read(bound)
            # Inputs may hold values of any type.
            except (Tf.ErrorException, TypeError, ValueError, SceneFormatError) as cause:
                self._textures.refuse(f"material {path}", f"material {path} makes no sense: {cause}.")
                self._paints[path] = None
        return self._paints[path]

    def _read(self, bound: Any) -> _TexturedMaterial | None:
        shader = bound.ComputeSurfaceSource()[0]
        if not shader or shader.GetIdAttr().Get() != "UsdPreviewSurface":
            return None
        name, place = name_of(bound.GetPrim()), f"material {bound.GetPath()}"
        opacity, opacity_source = _input(shader, "opacity", 1.0)
        color, source = _input(shader, "diffuseColor", (0.18, 0.18, 0.18))
        alpha = float(np.clip(opacity, 0.0, 1.0)) if opacity_source is None else 1.0
        if source is None:
            r, g, b = srgb(np.nan_to_num(np.array(color, dtype=np.float64))).tolist()
            return _TexturedMaterial(FaceMaterial((r, g, b, alpha), name=name))
        # The image's opacity counts only if the material reads its opacity from the same image.
        keeps_alpha = opacity_source is not None and opacity_source.GetPath() == source.GetPath()
        spec = _file_spec(source)
        texture = None if spec is None else self._layers.texture(spec, place, keeps_alpha=keeps_alpha)
        if texture is None:
            fallback = _input(source, "fallback", None)[0]
            plain = FaceMaterial().color_rgba[:3] if fallback is None else srgb(np.nan_to_num(fallback)).tolist()[:3]
            return _TexturedMaterial(FaceMaterial((*plain, alpha), name=name))
        scale = np.array(_input(source, "scale", (1.0, 1.0, 1.0, 1.0))[0], dtype=np.float64)
        r, g, b = srgb(np.nan_to_num(scale[:3])).tolist()
        primvar, transform = _coordinates(source)
        return _TexturedMaterial(FaceMaterial((r, g, b, alpha), texture, name), primvar, transform)


def _input(shader: Any, name: str, default: Any) -> tuple[Any, Any]:
    """Return the value of a shader's input, and the shader that it is connected to (None if it holds the value)."""
    given = shader.GetInput(name)
    if not given:
        return default, None
    for attribute in given.GetValueProducingAttributes():
        if UsdShade.Utils.GetType(attribute.GetName()) == UsdShade.AttributeType.Output:
            return default, UsdShade.Shader(attribute.GetPrim())
        held = value(attribute)
        return (default if held is None else held), None
    return default, None


def _file_spec(texture: Any) -> Any | None:
    """Return the attribute spec in a layer that names a texture's file. Reading its value would search for the file."""
    given = texture.GetInput("file")
    attributes = given.GetValueProducingAttributes() if given else ()
    for attribute in attributes:
        for spec in attribute.GetPropertyStack():
            if isinstance(spec.default, Sdf.AssetPath) and spec.default.path:
                return spec
    return None


def _coordinates(texture: Any) -> tuple[str, Floats]:
    """Return the primvar of a texture's coordinates, and the transform (2, 3) of its values (u, v, 1)."""
    matrix = np.eye(3)
    _, shader = _input(texture, "st", None)
    for _ in range(_MAX_NODES_OF_ST):
        if shader is None:
            break
        kind = str(shader.GetIdAttr().Get())
        if kind.startswith("UsdPrimvarReader"):
            return str(_input(shader, "varname", "st")[0] or "st"), matrix[:2]
        if kind != "UsdTransform2d":
            break
        angle = np.deg2rad(float(_input(shader, "rotation", 0.0)[0]))
        own = np.eye(3)
        own[:2, :2] = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]]) * np.array(
            _input(shader, "scale", (1.0, 1.0))[0], dtype=np.float64
        )
        own[:2, 2] = _input(shader, "translation", (0.0, 0.0))[0]
        matrix = matrix @ own
        _, shader = _input(shader, "in", None)
    return "st", matrix[:2]
