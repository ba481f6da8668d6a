"""Limits and budgets of scene files. Larger files are refused instead of filling time or memory.

All are assumed: some ten times what runs on a headset.
"""

from __future__ import annotations

from dataclasses import dataclass

from scene2hap.errors import SceneError

MAX_FILE_BYTES = 1 << 30
"""Size of a scene file, or of a buffer that it names."""
MAX_NODES = 100_000
"""Nodes of a scene."""
MAX_DEPTH = 200
"""Nodes on the way from the scene down to a leaf."""
MAX_TRIANGLES = 10_000_000
"""Triangles that a scene draws; an instance counts as often as it is drawn."""
MAX_TEXTURE_PX = 8192
"""Width and height of a texture; a larger one is left out, and the scene is read all the same."""
MAX_COORDINATE_M = 1e6
"""Distance of any point from the origin [m]; also keeps squares and cubes of it exact enough."""

MAX_OBJECTS = 4_000
"""Objects of a scene; each takes half a millisecond to place, and a shape of its own two more to measure."""
MAX_DATASET_FILES = 500_000
"""Files and folders of a dataset that are looked through for the templates of a scene."""
MAX_DATASET_BYTES = 1 << 32
"""Size of all files of a dataset that one scene reads."""


def at_most(what: str, value: int, limit: str) -> None:
    """Raise SceneError if `value` of something is above the limit of that name in this module."""
    bound: int = globals()[limit]
    if value > bound:
        raise SceneError(
            f"{what} is {value:,}; scene2hap reads at most {bound:,} (scene2hap.scene.limits.{limit}). "
            "Split or simplify the scene, or raise the limit."
        )


@dataclass
class Budget:
    """A bound on the total that all rows of one file may request.

    A row within its own limit takes a few bytes and may request megabytes. So the total is compared with the bytes of
    the file (or another measure of its content) before anything is allocated: `free`, plus `per_stored` for each byte.
    """

    what: str
    free: int
    per_stored: float = 0.0
    spent: int = 0
    stored: int = 0
    unit: str = "bytes"
    advice: str = "Split or simplify the scene, or export it again without shared or empty data."

    def spend(self, amount: int, place: str) -> None:
        """Count an `amount` that `place` requests. Raises: SceneError: the total exceeds the bound."""
        self.spent += amount
        allowed = self.free + int(self.per_stored * self.stored)
        if self.spent > allowed:
            raise SceneError(
                f"{place} brings {self.what} to {self.spent:,}; at most {allowed:,} are read "
                f"where {self.stored:,} {self.unit} are stored. {self.advice}"
            )
