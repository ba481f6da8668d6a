"""Write USD files with the classes of usd-core, or as text, and load them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import ArrayLike

from looks import QUAD
from scene2hap.scene.load import load_scene
from scene2hap.scene.snapshot import SceneSnapshot

HEADER = "#usda 1.0\n"
CUBE_POINTS = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
CUBE_QUADS = [0, 3, 2, 1, 4, 5, 6, 7, 0, 1, 5, 4, 1, 2, 6, 5, 2, 3, 7, 6, 3, 0, 4, 7]
"""A cube of edge 1 with a corner in the origin, as six quadrilaterals that face outwards."""


def usd(name: str) -> Any:
    """A module of usd-core, such as "UsdGeom"; the test is skipped where that is not installed."""
    return pytest.importorskip(f"pxr.{name}", reason="usd-core is not installed; run: pip install usd-core")


def new_stage(path: Path, *, unit_m: float | None = 1.0, up: str | None = "Y") -> Any:
    """A new stage, which `stage.Save()` writes. None leaves metersPerUnit or upAxis out."""
    stage = usd("Usd").Stage.CreateNew(str(path))
    if unit_m is not None:
        usd("UsdGeom").SetStageMetersPerUnit(stage, unit_m)
    if up is not None:
        usd("UsdGeom").SetStageUpAxis(stage, up)
    return stage


def mesh(
    stage: Any,
    path: str,
    points: ArrayLike = CUBE_POINTS,
    indices: Sequence[int] = CUBE_QUADS,
    counts: Sequence[int] = (4,) * 6,
) -> Any:
    """A `UsdGeom.Mesh`, by default a cube."""
    vt, made = usd("Vt"), usd("UsdGeom").Mesh.Define(stage, path)
    made.CreatePointsAttr(vt.Vec3fArray.FromNumpy(np.asarray(points, np.float32)))
    made.CreateFaceVertexCountsAttr(vt.IntArray.FromNumpy(np.asarray(counts, np.int32)))
    made.CreateFaceVertexIndicesAttr(vt.IntArray.FromNumpy(np.asarray(indices, np.int32)))
    return made


def preview(stage: Any, path: str, **inputs: Any) -> Any:
    """A material with a UsdPreviewSurface with these inputs; a tuple is a colour."""
    shade, types = usd("UsdShade"), usd("Sdf").ValueTypeNames
    material, surface = shade.Material.Define(stage, path), shade.Shader.Define(stage, f"{path}/surface")
    surface.CreateIdAttr("UsdPreviewSurface")
    for name, held in inputs.items():
        surface.CreateInput(name, types.Color3f if isinstance(held, tuple) else types.Float).Set(held)
    material.CreateSurfaceOutput().ConnectToSource(surface.ConnectableAPI(), "surface")
    return material


def textured(stage: Any, path: str, file: str, *, primvar: str = "st") -> Any:
    """A material whose diffuse colour is a texture with coordinates from a primvar."""
    shade, types = usd("UsdShade"), usd("Sdf").ValueTypeNames
    material = preview(stage, path)
    texture, reader = shade.Shader.Define(stage, f"{path}/texture"), shade.Shader.Define(stage, f"{path}/reader")
    texture.CreateIdAttr("UsdUVTexture")
    texture.CreateInput("file", types.Asset).Set(file)
    reader.CreateIdAttr("UsdPrimvarReader_float2")
    reader.CreateInput("varname", types.String).Set(primvar)
    texture.CreateInput("st", types.Float2).ConnectToSource(reader.ConnectableAPI(), "result")
    surface = shade.Shader(stage.GetPrimAtPath(f"{path}/surface"))
    surface.CreateInput("diffuseColor", types.Color3f).ConnectToSource(texture.ConnectableAPI(), "rgb")
    return material


def bind(prim: Any, material: Any, purpose: str = "") -> None:
    """Bind a material to a prim."""
    shade = usd("UsdShade")
    api = shade.MaterialBindingAPI.Apply(prim.GetPrim())
    api.Bind(material, shade.Tokens.fallbackStrength, purpose)


def as_usd(scene: SceneSnapshot, path: Path) -> Path:
    """Write a `SceneSnapshot` as USD: one Xform and one Mesh for each object."""
    gf, geom = usd("Gf"), usd("UsdGeom")
    stage = new_stage(path, up=scene.up_axis.upper())
    geom.Xform.Define(stage, "/World")
    for number, item in enumerate(scene.objects):
        frame = geom.Xform.Define(stage, f"/World/object_{number}")
        frame.GetPrim().SetDisplayName(item.name)
        rows = np.eye(4)
        rows[:3, :3], rows[3, :3] = item.pose.rotation.T, item.pose.position_m
        frame.AddTransformOp().Set(gf.Matrix4d(rows.tolist()))
        triangles = item.geometry.mesh
        mesh(
            stage,
            f"/World/object_{number}/shape",
            triangles.vertices_m,
            triangles.faces.reshape(-1).tolist(),
            [3] * len(triangles.faces),
        )
    stage.Save()
    return path


def scene_of(fill: Callable[[Any], object], folder: Path, *, suffix: str = ".usda", **options: Any) -> SceneSnapshot:
    """Save a stage that `fill` fills, and load it."""
    path = folder / f"scene{suffix}"
    stage = new_stage(path)
    fill(stage)
    stage.Save()
    return load_scene(path, unit_m=options.pop("unit_m", 1.0), **options)


def text_file(folder: Path, text: str, name: str = "scene.usda") -> Path:
    path = folder / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(HEADER + text, encoding="utf-8")
    return path


def ids(scene: SceneSnapshot) -> list[str]:
    return [item.id for item in scene.objects]


def painted_square(stage: Any, file: str = "./floor.png", interpolation: str = "vertex") -> None:
    """A square with an upright texture; in USD, t runs up."""
    square = mesh(stage, "/square", QUAD, [0, 1, 2, 3], [4])
    st = (
        usd("UsdGeom")
        .PrimvarsAPI(square)
        .CreatePrimvar("map1", usd("Sdf").ValueTypeNames.TexCoord2fArray, interpolation)
    )
    st.Set([(0.25, 0.25), (0.75, 0.25), (0.75, 0.75), (0.25, 0.75)])
    bind(square, textured(stage, "/Looks/floor", file, primvar="map1"))


def instancer(stage: Any, *, n: int = 3) -> Any:
    """A point instancer of cubes at x = 0, 2, 4, ...; its only prototype is a prim below it."""
    made = usd("UsdGeom").PointInstancer.Define(stage, "/World/cups")
    mesh(stage, "/World/cups/prototypes/cup")
    made.CreatePrototypesRel().AddTarget("/World/cups/prototypes/cup")
    made.CreateProtoIndicesAttr([0] * n)
    made.CreatePositionsAttr([(2.0 * i, 0, 0) for i in range(n)])
    return made
