"""The game that checks clients of a bridge; docs/bridge-protocol.md describes it for other languages."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from scene2hap.scene.objects import SceneObject
from scene2hap.scene.pose import Pose
from scene2hap.scene.shapes import Box
from scene2hap.scene.snapshot import SceneSnapshot
from scene2hap.session import Touch

FRAME_RATE_HZ = 60
IDS = ("table", "phone", "shaver", *(f"cup_{k:02d}" for k in range(3, 30)))
_KINDS = {
    "table": ("Wooden table", (2.4, 0.04, 0.8)),
    "phone": ("Smartphone", (0.07, 0.008, 0.15)),
    "shaver": ("Electric shaver", (0.05, 0.04, 0.16)),
}
_CUP = ("Coffee mug", (0.08, 0.09, 0.08))
_ROWS_Z_M = (-0.35, 0.0, 0.35)


def positions_m(frame: int) -> NDArray[np.float32]:
    """Return the positions of the objects (30, 3) float32 [m], in the order of `IDS`. None is rotated."""
    shaver_y = 0.94 if 1200 <= frame % 3600 < 1800 else 0.74
    found = [(0.0, 0.7, 0.0), (-1 + frame / 1800, 0.724, 0.2), (0.5, shaver_y, -0.2)]
    for k in range(3, len(IDS)):
        row, column = divmod(k - 3, 9)
        d = abs((frame + 37 * k) % 240 - 120) / 120
        found.append((-0.9 + 0.2 * column + 0.05 * d, 0.765, _ROWS_Z_M[row]))
    return np.array(found, dtype=np.float32)


def touches(frame: int) -> list[Touch]:
    """Return the touches, with points in single precision, as in frames."""
    found = []
    if frame % 600 < 540:
        found.append(("left", "table", (-0.5, 0.72, 0.1)))
    if frame % 1200 < 600:
        found.append(("right", "phone", (-1 + frame / 1800, 0.724 + 0.004, 0.2)))
    else:
        row, column = divmod(12 - 3, 9)
        d = abs((frame + 37 * 12) % 240 - 120) / 120
        found.append(("right", IDS[12], (-0.9 + 0.2 * column + 0.05 * d, 0.765 + 0.045, _ROWS_Z_M[row])))
    return [Touch(hand, thing, _single(point)) for hand, thing, point in found]


def time_s(frame: int) -> float:
    """Return the time of a frame [s]."""
    return frame / FRAME_RATE_HZ


def game_scene() -> SceneSnapshot:
    """Return the scene, with the positions of frame 0."""
    objects = []
    for key, position in zip(IDS, positions_m(0).tolist(), strict=True):
        name, size_m = _KINDS.get(key, _CUP)
        objects.append(SceneObject(key, name, pose=Pose(tuple(position)), geometry=Box(size_m)))
    return SceneSnapshot.build(objects, name="bridge game")


def _single(point: tuple[float, float, float]) -> tuple[float, float, float]:
    x, y, z = np.array(point, dtype=np.float32).tolist()
    return x, y, z
