"""The dominant surfaces of one scene: each mesh is measured once, and one budget bounds all measurements."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from scene2hap.scene import limits
from scene2hap.scene.shapes import DominantSurface, TriMesh
from scene2hap.scene.surface.dominant_surface import dominant_surface

_FREE = 18_000_000
"""Ray-triangle tests in the budget of any scene (measured: two seconds; about 700 small meshes, all different)."""
_PER_VERTEX = 100.0
"""Further tests for each vertex that the file stores (assumed: 4,000 different meshes of 200 vertices)."""


class Surfaces:
    """Cache of measured surfaces. `work` is the budget; the reader of a file raises it by the file's vertices."""

    def __init__(self) -> None:
        self.work: limits.Budget = limits.Budget(
            "the rays that measure its shapes, times their triangles,",
            _FREE,
            _PER_VERTEX,
            unit="vertices",
            advice="Simplify the meshes, use copies of fewer shapes, or split the scene.",
        )
        self._measured: dict[tuple[object, ...], DominantSurface] = {}

    def of(self, mesh: TriMesh, up: NDArray[np.float64], place: str, *, turns: bool = False) -> DominantSurface:
        """Return the surface of a mesh; `up` (3,) is the upward direction in its frame. See `dominant_surface`.

        Copies share the surface of the first. With `turns`, copies with another up direction are measured separately.
        Raises: SceneError: measuring all shapes of the scene takes too long; the message names `place`.
        """
        key = (mesh.digest, *(np.round(up, 6).tolist() if turns else ()))
        if key not in self._measured:
            self._measured[key] = dominant_surface(mesh, up=up, spend=lambda work: self.work.spend(work, place))
        return self._measured[key]
