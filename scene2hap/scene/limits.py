"""Limits and budgets of scene files. Larger files are refused, so that no file fills time or memory.

All are assumed: about ten times the largest scenes that run on a headset.
"""

from __future__ import annotations

from dataclasses import dataclass

from scene2hap.errors import SceneError

MAX_FILE_BYTES = 1 << 30
"""Largest size of a scene file, or of a buffer that it names [bytes]."""
MAX_NODES = 100_000
"""Most nodes of a scene."""
MAX_DEPTH = 200
"""Most nodes on a path from the scene to a leaf."""
MAX_TRIANGLES = 10_000_000
"""Most triangles that a scene draws; each instance counts."""
MAX_TEXTURE_PX = 8192
"""Greatest width and height of a texture. A larger texture is left out, and the scene is still read."""
MAX_COORDINATE_M = 1e6
"""Greatest distance of any point from the origin [m]. Its squares and cubes are still exact enough."""
MAX_MASS_KG = 1e9
"""Greatest mass of an object [kg]."""

MAX_OBJECTS = 5_000
"""Most objects of a scene. Each takes 0.4 ms to place, and 2 ms more to measure unless its shape is a box or a copy."""
MAX_DATASET_FILES = 500_000
"""Most files and folders of a dataset that are searched for the templates of a scene."""
MAX_DATASET_BYTES = 1 << 32
"""Greatest total size of the files of a dataset that one scene reads [bytes]."""


def at_most(what: str, value: int, limit: str) -> None:
    """Raise SceneError if `value` of something is above the limit of that name in this module."""
    bound: int = globals()[limit]
    if value > bound:
        raise SceneError(
            f"{what} is {value:,}; scene2hap reads at most {bound:,} (scene2hap.scene.limits.{limit}). "
            "Split or simplify the scene, or raise the limit."
        )


@dataclass
class TreeSize:
    """The nodes and triangles of a scene that a reader has found so far."""

    n_nodes: int = 0
    n_triangles: int = 0

    def add_nodes(self, n: int, depth: int = 0) -> None:
        """Count nodes; `depth` is the number of nodes on the path to them. Raises: SceneError: too many or too deep."""
        at_most("the depth of the node tree", depth, "MAX_DEPTH")
        self.n_nodes += n
        at_most("the number of nodes", self.n_nodes, "MAX_NODES")

    def add_triangles(self, n: int) -> None:
        """Count triangles. Raises: SceneError: too many."""
        self.n_triangles += n
        at_most("the number of triangles", self.n_triangles, "MAX_TRIANGLES")


@dataclass
class Budget:
    """A bound on the total that all rows of one file may request.

    A row of a few bytes may request megabytes within its own limit. So the total is compared with the bytes of the
    file, or with another measure of its content, before anything is allocated. The bound is `free`, plus `per_stored`
    for each byte.
    """

    what: str
    free: int
    per_stored: float = 0.0
    spent: int = 0
    stored: int = 0
    unit: str = "bytes"
    advice: str = "Split or simplify the scene, or export it again without shared or empty data."

    def spend(self, amount: int, place: str) -> None:
        """Count an `amount` that `place` requests. Raises: SceneError: the total would exceed the bound."""
        total = self.spent + amount
        allowed = self.free + int(self.per_stored * self.stored)
        if total > allowed:
            where = f" where {self.stored:,} {self.unit} are stored" if self.per_stored else ""
            raise SceneError(
                f"{place} brings {self.what} to {total:,}; at most {allowed:,} are read{where}. {self.advice}"
            )
        self.spent = total
