"""Masses of the prims of a USD stage, if the file has them.

The mass of a prim includes all prims below it, whose own masses are ignored. Without a mass, density times volume
counts: the density of the prim, else of the nearest prim above, else of its physics material. Only closed meshes have a
volume. Without mass and density, the mass of the prim is unknown, and so is the mass of the prims above it. The
simulators' default of 1000 kg/m3 is not used.

Source: OpenUSD 26.11, UsdPhysics: MassAPI and MaterialAPI, "physics:mass" and "physics:density".
"""

from __future__ import annotations

from collections.abc import Hashable
from typing import Any

import numpy as np
from pxr import UsdPhysics, UsdShade

from scene2hap.scene import limits
from scene2hap.scene.formats.usd.meshes import Triangles
from scene2hap.scene.formats.usd.values import positive


class Masses:
    """Reader of the masses [kg] of a stage's prims."""

    def __init__(self, stage: Any) -> None:
        scale = UsdPhysics.GetStageKilogramsPerUnit(stage)
        self._kg_per_unit = float(scale) if np.isfinite(scale) and scale > 0 else 1.0
        self._volumes: dict[Hashable, float | None] = {}

    def of_all_below(self, prim: Any) -> float | None:
        """Return the authored mass of a prim [kg]; None if there is none, or it is above the bound of objects."""
        if not prim.HasAPI(UsdPhysics.MassAPI):
            return None
        return self._kg(positive(UsdPhysics.MassAPI(prim).GetMassAttr()))

    def density(self, prim: Any, above: float | None) -> float | None:
        """Return the authored density of a prim, else `above` [stage's mass unit per its length cubed]."""
        own = positive(UsdPhysics.MassAPI(prim).GetDensityAttr()) if prim.HasAPI(UsdPhysics.MassAPI) else None
        return own or above

    def of_shape(self, prim: Any, key: Hashable, found: Triangles, density: float | None, scale: float) -> float | None:
        """Return the mass of a gprim [kg] from its volume; None without a density, or if its mesh is not closed.

        Parameters: key : equal for equal triangles; density : as `density` returns it; scale : factor of volumes in the
            prim's world transform [-].
        """
        density = density or self._density_of_material(prim)
        if density is None:
            return None
        if key not in self._volumes:
            self._volumes[key] = _closed_volume(found)
        volume = self._volumes[key]
        return None if volume is None else self._kg(density * volume * abs(scale))

    def _density_of_material(self, prim: Any) -> float | None:
        material = UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial("physics")[0]
        if not material or not material.GetPrim().HasAPI(UsdPhysics.MaterialAPI):
            return None
        return positive(UsdPhysics.MaterialAPI(material.GetPrim()).GetDensityAttr())

    def _kg(self, mass: float | None) -> float | None:
        kg = None if mass is None else mass * self._kg_per_unit
        return kg if kg is not None and 0 < kg <= limits.MAX_MASS_KG else None


def _closed_volume(found: Triangles) -> float | None:
    """Return the volume of a closed mesh whose faces all face outwards, or all inwards; None for any other mesh."""
    import trimesh

    mesh = trimesh.Trimesh(found.points, found.vertices, process=True)
    if not mesh.is_watertight or not mesh.is_winding_consistent:
        return None
    return float(abs(mesh.volume)) or None
