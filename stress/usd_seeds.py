"""A small USD scene with most of the supported features, written by usd-core as text, binary file and archive."""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import Any

from PIL import Image


def usd_files() -> dict[str, bytes]:
    """Bytes of the scene by suffix; empty if usd-core is not installed."""
    try:
        from pxr import Usd, UsdUtils
    except ImportError:
        return {}
    with tempfile.TemporaryDirectory() as folder:
        paths = {suffix: str(Path(folder) / f"scene{suffix}") for suffix in (".usda", ".usdc", ".usdz")}
        Image.new("RGB", (4, 4), (120, 80, 40)).save(Path(folder) / "oak.png")
        stage = Usd.Stage.CreateInMemory()
        _fill(stage)
        for suffix in (".usda", ".usdc"):
            stage.GetRootLayer().Export(paths[suffix])
        UsdUtils.CreateNewUsdzPackage(paths[".usdc"], paths[".usdz"])
        return {suffix: Path(path).read_bytes() for suffix, path in paths.items()}


def _fill(stage: Any) -> None:
    from pxr import Gf, Sdf, UsdGeom, UsdPhysics, UsdShade, Vt

    UsdGeom.SetStageMetersPerUnit(stage, 1.0)
    UsdGeom.SetStageUpAxis(stage, "Z")
    world = UsdGeom.Xform.Define(stage, "/World")
    stage.SetDefaultPrim(world.GetPrim())
    table = UsdGeom.Mesh.Define(stage, "/World/table")
    table.CreatePointsAttr([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)])
    table.CreateFaceVertexCountsAttr([4] * 6)
    table.CreateFaceVertexIndicesAttr([0, 3, 2, 1, 4, 5, 6, 7, 0, 1, 5, 4, 1, 2, 6, 5, 2, 3, 7, 6, 3, 0, 4, 7])
    table.AddTranslateOp().Set(Gf.Vec3d(1, 2, 0))
    table.AddRotateXYZOp().Set(Gf.Vec3f(0, 0, 30))
    st = UsdGeom.PrimvarsAPI(table).CreatePrimvar("st", Sdf.ValueTypeNames.TexCoord2fArray, "faceVarying")
    st.Set([(float(i % 4), float(i % 3)) for i in range(24)])
    UsdGeom.Subset.CreateGeomSubset(table, "top", "face", Vt.IntArray([1]), "materialBind")
    wood = UsdShade.Material.Define(stage, "/World/Looks/wood")
    surface = UsdShade.Shader.Define(stage, "/World/Looks/wood/surface")
    surface.CreateIdAttr("UsdPreviewSurface")
    texture = UsdShade.Shader.Define(stage, "/World/Looks/wood/texture")
    texture.CreateIdAttr("UsdUVTexture")
    texture.CreateInput("file", Sdf.ValueTypeNames.Asset).Set("./oak.png")
    color = surface.CreateInput("diffuseColor", Sdf.ValueTypeNames.Color3f)
    color.ConnectToSource(texture.ConnectableAPI(), "rgb")
    wood.CreateSurfaceOutput().ConnectToSource(surface.ConnectableAPI(), "surface")
    UsdShade.MaterialBindingAPI.Apply(table.GetPrim()).Bind(wood)
    cube = UsdGeom.Cube.Define(stage, "/World/crate")
    cube.CreateSizeAttr(0.5)
    UsdPhysics.MassAPI.Apply(cube.GetPrim()).CreateDensityAttr(700.0)
    ball = UsdGeom.Xform.Define(stage, "/World/ball")
    UsdGeom.Sphere.Define(stage, "/World/ball/shape").CreateRadiusAttr(0.1)
    for number in range(2):
        copy = UsdGeom.Xform.Define(stage, f"/World/copy{number}")
        copy.GetPrim().GetReferences().AddInternalReference(ball.GetPath())
        copy.GetPrim().SetInstanceable(True)
        copy.AddTranslateOp().Set(Gf.Vec3d(number, 0, 0))
    points = UsdGeom.PointInstancer.Define(stage, "/World/points")
    points.CreatePrototypesRel().AddTarget(ball.GetPath())
    points.CreateProtoIndicesAttr([0, 0, 0])
    points.CreatePositionsAttr([(0, 0, 0), (1, 1, 1), (2, 2, 2)])
    states = world.GetPrim().GetVariantSets().AddVariantSet("state")
    states.AddVariant("clean")
    states.SetVariantSelection("clean")
