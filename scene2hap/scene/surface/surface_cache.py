"""The dominant surfaces of one scene: each mesh is measured once, and one budget bounds all measurements.

Beyond the budget, meshes are measured by the boxes around them.
"""

from __future__ import annotations

import numpy as np

from scene2hap.common.arrays import Floats
from scene2hap.common.warning import warn_of
from scene2hap.errors import SceneError
from scene2hap.scene import limits
from scene2hap.scene.shapes import DominantSurface, TriMesh
from scene2hap.scene.surface.dominant_surface import box_surface, dominant_surface

_FREE = 18_000_000
"""Ray-triangle tests in the budget of any scene (measured: two seconds; about 700 small meshes, all different)."""
_PER_VERTEX = 100.0
"""Further tests for each vertex that the file stores (assumed: 4,000 different meshes of 200 vertices)."""


class SurfaceCache:
    """Measured surfaces by mesh. `work` is the budget; the reader of a file raises it by the file's vertices."""

    def __init__(self) -> None:
        self.work: limits.Budget = limits.Budget(
            "the rays that measure its shapes, times their triangles,",
            _FREE,
            _PER_VERTEX,
            unit="vertices",
            advice="The sizes of what is left are those of the boxes around meshes: a table is as thick as it is high. "
            "Simplify the meshes, use copies of fewer shapes, or split the scene.",
        )
        self._measured: dict[tuple[object, ...], DominantSurface] = {}
        self._has_warned = False

    def of(self, mesh: TriMesh, up: Floats, place: str, *, turns: bool = False) -> DominantSurface:
        """Return the surface of a mesh; `up` (3,) is the upward direction in its frame. See `dominant_surface`.

        Copies share the surface of the first. With `turns`, copies with another up direction are measured separately.
        Warns: SceneWarning: measuring all shapes of the scene takes too long; the message names the first `place` that
        is measured by its box.
        """
        key = (mesh.digest, *(np.round(up, 6).tolist() if turns else ()))
        if key not in self._measured:
            try:
                self._measured[key] = dominant_surface(mesh, up=up, spend=lambda work: self.work.spend(work, place))
            except SceneError as problem:  # of the budget
                self._measured[key] = box_surface(mesh, up=up)
                if not self._has_warned:
                    self._has_warned = True
                    warn_of(str(problem))
        return self._measured[key]
