"""A small vocabulary of closed shapes. Every one is a loft: a skin over a row of rings.

Metres, Y up. A range is a pair (low, high), so that two things that touch are written with the same number.
The shapes are made here rather than by a mesh library so that the file's bytes do not move with its version.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from math import cos, radians, sin, sqrt
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]
Range = tuple[float, float]
Point = tuple[float, float, float]
Axis = Literal["x", "y", "z"]


@dataclass(frozen=True)
class Part:
    """A closed mesh of one colour: vertices (n, 3) [m] and triangles (m, 3) that face outwards."""

    colour: str
    vertices_m: Array
    faces: NDArray[np.int64]

    def moved(self, x: float = 0.0, y: float = 0.0, z: float = 0.0) -> Part:
        """The same part elsewhere."""
        return replace(self, vertices_m=self.vertices_m + np.array((x, y, z)))

    def turned(self, axis: Axis, degrees: float) -> Part:
        """The same part, turned right-handedly about an axis through the origin."""
        c, s = cos(radians(degrees)), sin(radians(degrees))
        rows = {
            "x": [[1, 0, 0], [0, c, -s], [0, s, c]],
            "y": [[c, 0, s], [0, 1, 0], [-s, 0, c]],
            "z": [[c, -s, 0], [s, c, 0], [0, 0, 1]],
        }
        return replace(self, vertices_m=self.vertices_m @ np.array(rows[axis]).T)


def loft(colour: str, rings: ArrayLike, *, loop: bool = False) -> Part:
    """A skin over rings (k, n, 3) [m] of n corners each: capped at both ends, or closed upon itself by `loop`.

    Rings that cap an end must be convex. A ring of radius 0 is a point.
    """
    corners = np.asarray(rings, dtype=np.float64)
    k, n = corners.shape[:2]
    index = np.arange(k * n).reshape(k, n)
    lower = index if loop else index[:-1]
    upper = np.roll(index, -1, axis=0)[: len(lower)]
    right_lower, right_upper = np.roll(lower, -1, axis=1), np.roll(upper, -1, axis=1)
    skin = [np.stack([lower, right_lower, right_upper], axis=-1), np.stack([lower, right_upper, upper], axis=-1)]
    faces = np.concatenate(skin).reshape(-1, 3)
    if not loop:
        fan = np.array([(0, i, i + 1) for i in range(1, n - 1)])
        faces = np.concatenate([faces, index[0][fan[:, ::-1]], index[-1][fan]])
    return _outwards(_welded(Part(colour, corners.reshape(-1, 3), faces)))


def box(colour: str, x: Range, y: Range, z: Range) -> Part:
    """A cuboid."""
    return loft(colour, [_rectangle("y", height, x, z) for height in y])


def slanted_box(colour: str, foot: tuple[Range, Range], head: tuple[Range, Range], y: Range) -> Part:
    """A box whose foot and head are level rectangles (x, z) of their own."""
    return loft(colour, [_rectangle("y", y[0], *foot), _rectangle("y", y[1], *head)])


def frame(colour: str, x: Range, y: Range, z: Range, hole: tuple[Range, Range], *, through: Axis) -> Part:
    """A cuboid with a rectangular hole along one axis; `hole` gives the other two ranges, in the order x, y, z."""
    ranges = {"x": x, "y": y, "z": z}
    low, high = ranges.pop(through)
    outer, inner = tuple(ranges.values()), hole
    rings = [(low, outer), (high, outer), (high, inner), (low, inner)]
    return loft(colour, [_rectangle(through, height, *sides) for height, sides in rings], loop=True)


def tray(colour: str, x: Range, y: Range, z: Range, wall: float, *, opening: Literal["+y", "+z"]) -> Part:
    """A box with walls of one thickness [m] that lacks one side."""
    axis: Axis = "y" if opening == "+y" else "z"
    ranges = {"x": x, "y": y, "z": z}
    floor, rim = ranges.pop(axis)
    outer = tuple(ranges.values())
    inner = tuple((low + wall, high - wall) for low, high in outer)
    rings = [(floor, outer), (rim, outer), (rim, inner), (floor + wall, inner)]
    return loft(colour, [_rectangle(axis, height, *sides) for height, sides in rings])


def stacked(colour: str, levels: Iterable[tuple[float, Range, Range]]) -> Part:
    """Level rectangles (y, x range, z range), skinned in their order; going up and down again makes a vessel."""
    return loft(colour, [_rectangle("y", y, x, z) for y, x, z in levels])


def rounded(colour: str, x: Range, y: Range, z: Range, radius: float) -> Part:
    """A cuboid whose upright edges are rounded."""
    corners = [(x[1], z[1], 0), (x[0], z[1], 90), (x[0], z[0], 180), (x[1], z[0], 270)]
    outline = []
    for corner_x, corner_z, start in corners:
        centre_x = corner_x - radius if corner_x == x[1] else corner_x + radius
        centre_z = corner_z - radius if corner_z == z[1] else corner_z + radius
        for step in range(4):
            angle = radians(start + 30 * step)
            outline.append((centre_x + radius * cos(angle), centre_z + radius * sin(angle)))
    return loft(colour, [[(px, height, pz) for px, pz in outline] for height in y])


def lathe(colour: str, profile: Sequence[tuple[float, float]], sides: int = 18, *, loop: bool = False) -> Part:
    """A turned shape about the Y axis from its profile of (radius, height) [m]; with `loop`, a ring."""
    return loft(colour, [_circle(radius, height, sides) for radius, height in profile], loop=loop)


def cylinder(colour: str, radius: float, y: Range, sides: int = 16) -> Part:
    """An upright cylinder."""
    return lathe(colour, [(radius, height) for height in y], sides)


def ball(colour: str, radius: float, sides: int = 10) -> Part:
    """A sphere about the origin."""
    angles = [radians(-90 + 30 * step) for step in range(7)]
    return lathe(colour, [(radius * cos(angle), radius * sin(angle)) for angle in angles], sides)


def ring(colour: str, inner_radius: float, outer_radius: float, y: Range, sides: int = 18) -> Part:
    """A flat ring about the Y axis."""
    profile = [(outer_radius, y[0]), (outer_radius, y[1]), (inner_radius, y[1]), (inner_radius, y[0])]
    return lathe(colour, profile, sides, loop=True)


def post(colour: str, radius: float, foot: Point, head: Point, sides: int = 12) -> Part:
    """A round bar that may lean; its ends are level, so that it stands flat."""
    return loft(colour, [_circle(radius, 0.0, sides) + np.array(end) for end in (foot, head)])


def tube(colour: str, path: ArrayLike, radius: float, sides: int = 8) -> Part:
    """A round bar bent along a path of points (n, 3) [m]."""
    points = np.asarray(path, dtype=np.float64)
    tangents = np.gradient(points, axis=0)
    side = np.cross(tangents[0], (0.37, 0.61, 0.70))  # any direction that no path here follows
    rings = []
    for point, tangent in zip(points, tangents, strict=True):
        along = tangent / sqrt(float(tangent @ tangent))
        side = side - along * (side @ along)
        side = side / sqrt(float(side @ side))
        up = np.cross(along, side)
        turns = [radians(360 * step / sides) for step in range(sides)]
        rings.append([point + radius * (cos(turn) * side + sin(turn) * up) for turn in turns])
    return loft(colour, rings)


def arc(centre: Point, radius: float, degrees: Range, steps: int) -> list[Point]:
    """Points on a circle in an upright plane x = const; 0 degrees is +Z, 90 degrees is up."""
    angles = [radians(degrees[0] + (degrees[1] - degrees[0]) * step / steps) for step in range(steps + 1)]
    return [(centre[0], centre[1] + radius * sin(angle), centre[2] + radius * cos(angle)) for angle in angles]


def at_each(part: Part, xs: Iterable[float], zs: Iterable[float]) -> list[Part]:
    """Copies of a part wherever an x meets a z: legs, feet, buttons."""
    rows = tuple(zs)
    return [part.moved(x=x, z=z) for x in xs for z in rows]


def facing_front(*parts: Part) -> list[Part]:
    """Parts that were turned about Y, laid so that their axis points to the front, +Z."""
    return [part.turned("x", 90) for part in parts]


def _rectangle(axis: Axis, height: float, a: Range, b: Range) -> Array:
    along = "xyz".index(axis)
    across = [i for i in range(3) if i != along]
    corners = np.full((4, 3), height, dtype=np.float64)
    corners[:, across[0]] = (a[0], a[1], a[1], a[0])
    corners[:, across[1]] = (b[0], b[0], b[1], b[1])
    return corners


def _circle(radius: float, height: float, sides: int) -> Array:
    turns = [radians(360 * step / sides) for step in range(sides)]
    return np.array([(radius * cos(turn), height, radius * sin(turn)) for turn in turns])


def _welded(part: Part) -> Part:
    # Adding 0.0 turns -0.0 into 0.0, which would otherwise differ in its bytes.
    grid = np.round(part.vertices_m, 9) + 0.0
    vertices, row = np.unique(grid, axis=0, return_inverse=True)
    faces = row.reshape(-1)[part.faces]
    flat = (faces == np.roll(faces, 1, axis=1)).any(axis=1)
    return replace(part, vertices_m=vertices, faces=faces[~flat])


def _outwards(part: Part) -> Part:
    a, b, c = (part.vertices_m[part.faces[:, i]] for i in range(3))
    six_volumes = float(np.sum(a * np.cross(b, c)))
    return part if six_volumes > 0 else replace(part, faces=part.faces[:, ::-1])
