"""How large a scene file may be before it is refused rather than read for minutes or until memory ends.

All are assumed: some ten times what runs on a headset.
"""

from __future__ import annotations

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


def at_most(what: str, value: int, limit: str) -> None:
    """Raise SceneError if `value` of something is above the limit of that name in this module."""
    bound: int = globals()[limit]
    if value > bound:
        raise SceneError(
            f"{what} is {value:,}; scene2hap reads at most {bound:,} (scene2hap.scene.limits.{limit}). "
            "Split or simplify the scene, or raise the limit."
        )
