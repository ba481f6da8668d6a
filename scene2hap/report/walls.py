"""Objects that hide the inside of a room: rooms in one piece, and walls and ceilings that are separate objects."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from itertools import product

import numpy as np
from numpy.typing import NDArray

from scene2hap.scene.geometry import joined
from scene2hap.scene.objects import VERTICAL, SceneObject
from scene2hap.scene.snapshot import SceneSnapshot

Direction = tuple[float, float, float]

_SHELL_SHARE = 0.7
"""Least share of the scene's width and depth of an object that can hide its inside."""
_THIN_SHARE, _RIM_SHARE = 0.08, 0.05
"""Largest thickness of a wall, and its largest distance from the scene's rim, as shares of the scene's size across the
wall; assumed: half a metre, and a window sill, in a room of six metres."""
_HIGH_SHARE, _PIECE_SHARE = 0.5, 0.05
"""Least height of a wall as a share of the scene's, and least length or area of a piece of wall or ceiling."""
_WALL_SHARE = 0.6
"""Least share of a side that its walls must cover together, so that a bookcase at the rim is not taken for a wall."""
_ONE_SIDE = 0.98
"""Least cosine between the directions of walls of one side."""


def shells(scene: SceneSnapshot) -> frozenset[str]:
    """Return the objects that are as wide and deep as the scene: rooms in one piece, ceilings, and long walls."""
    if len(scene.objects) < 2:
        return frozenset()
    boxes = np.array([item.bounds_m for item in scene.objects])
    up = VERTICAL[scene.up_axis]
    sizes = np.ptp(boxes, axis=1)
    whole = np.ptp(joined(boxes), axis=0)
    level = [axis for axis in range(3) if axis != up]
    is_wide = (sizes[:, level] >= _SHELL_SHARE * whole[level]).all(axis=1)
    # A floor is as wide too, but it hides nothing.
    is_high = sizes[:, up] >= 0.3 * whole[up]
    is_above = boxes[:, 0, up] > boxes[:, 0, up].min() + 0.7 * whole[up]
    return frozenset(
        item.id for item, hides in zip(scene.objects, is_wide & (is_high | is_above), strict=True) if hides
    )


def walls(scene: SceneSnapshot, sources: Collection[str] = ()) -> dict[str, Direction]:
    """Return walls and ceilings that are separate objects, with their outward direction.

    A wall is thin along one of its own axes, is at the rim of the scene, and has at least half of its height. Together
    the walls of a side cover most of it. Ceilings are searched only if there are walls or shells. Sources are never
    walls.
    """
    if len(scene.objects) < 2:
        return {}
    whole = shells(scene)
    boxes = [_OwnBox(item) for item in scene.objects]
    corners_m = np.concatenate([box.corners_m for box in boxes])
    up = np.eye(3)[VERTICAL[scene.up_axis]]
    others = [box for box in boxes if box.id not in whole and box.id not in sources]
    at_rim = [side for box in others if (side := _at_rim(box, corners_m)) is not None]
    upright = [
        side for side in at_rim if abs(side.outward @ up) < 0.5 and _share(side.box, up, corners_m) > _HIGH_SHARE
    ]
    found = [
        side for group in _by_side(upright) for side in _covering(group, [np.cross(up, group[0].outward)], corners_m)
    ]
    if found or whole:
        ceilings = [side for side in at_rim if side.outward @ up >= 0.5]
        level = [axis for axis in np.eye(3) if not axis @ up]
        found += [side for group in _by_side(ceilings) for side in _covering(group, level, corners_m)]
    return {side.box.id: _direction(side.outward) for side in found}


class _OwnBox:
    """The box of an object along its own axes, since walls of a rotated house are thin only along these."""

    def __init__(self, item: SceneObject) -> None:
        low, high = item.geometry.mesh.bounds_m
        self.id = item.id
        self.half_m: NDArray[np.float64] = (high - low) / 2.0
        self.axes: NDArray[np.float64] = np.asarray(item.pose.rotation).T
        """Own axes in world coordinates, one per row."""
        self.middle_m: NDArray[np.float64] = item.pose.to_world([(low + high) / 2.0])[0]
        self.corners_m: NDArray[np.float64] = item.pose.to_world(
            np.array([np.where(corner, high, low) for corner in product((0, 1), repeat=3)])
        )


@dataclass(frozen=True, eq=False)
class _Side:
    box: _OwnBox
    outward: NDArray[np.float64]


def _at_rim(box: _OwnBox, corners_m: NDArray[np.float64]) -> _Side | None:
    """Return a thin box at the rim of the scene with its outward direction, None for other boxes."""
    thin = int(box.half_m.argmin())
    normal = box.axes[thin]
    scene, own = corners_m @ normal, box.corners_m @ normal
    size = np.ptp(scene)
    if 2.0 * box.half_m[thin] > _THIN_SHARE * size:
        return None
    sign = 1.0 if own.min() - scene.min() > scene.max() - own.max() else -1.0
    is_at_rim = (sign * scene).max() - (sign * own).max() <= _RIM_SHARE * size
    return _Side(box, sign * normal) if is_at_rim else None


def _by_side(sides: Sequence[_Side]) -> list[list[_Side]]:
    """Group thin boxes by direction."""
    groups: list[list[_Side]] = []
    for side in sides:
        own = next((group for group in groups if group[0].outward @ side.outward > _ONE_SIDE), None)
        if own is None:
            groups.append([side])
        else:
            own.append(side)
    return groups


def _covering(
    group: Sequence[_Side], axes: Sequence[NDArray[np.float64]], corners_m: NDArray[np.float64]
) -> list[_Side]:
    """Return the outer, large boxes of a side if together they cover most of it along these axes, else none."""
    outer = [side for side in group if not any(_is_before(side, other) for other in group)]
    shares = [float(np.prod([_share(side.box, axis, corners_m) for axis in axes])) for side in outer]
    pieces = [(side, share) for side, share in zip(outer, shares, strict=True) if share >= _PIECE_SHARE]
    return [side for side, _ in pieces] if sum(share for _, share in pieces) >= _WALL_SHARE else []


def _is_before(side: _Side, other: _Side) -> bool:
    """Return True if a box is on the inner side of another, like a bookcase at a wall."""
    apart_m = side.box.middle_m - other.box.middle_m
    flat = np.delete(np.abs(other.box.axes @ apart_m) <= other.box.half_m, other.box.half_m.argmin())
    return bool(apart_m @ other.outward < 0.0 and flat.all())


def _share(box: _OwnBox, axis: NDArray[np.float64], corners_m: NDArray[np.float64]) -> float:
    """Return the size of a box along an axis as a share of the scene's."""
    size = float(np.ptp(corners_m @ axis))
    return float(np.ptp(box.corners_m @ axis)) / size if size > 0.0 else 0.0


def _direction(vector: NDArray[np.float64]) -> Direction:
    x, y, z = (round(float(value), 6) + 0.0 for value in vector)
    return x, y, z
