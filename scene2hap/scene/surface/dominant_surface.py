"""The dominant surface of a mesh: the plate that a person would name first, such as the top of a table.

1. Count triangles that are drawn twice once, and wind all of them alike (`winding`).
2. Fit a bounding box to the mesh in a frame of its own (`frame`). So a shelf authored at 30 degrees has the measures
   of a straight one.
3. Cast a grid of parallel rays through the box along each of the three axes. The plate's normal is the axis with the
   largest projected area. Exception: a chair's seat. If that side is level in less than two thirds of its rectangle, a
   thin flat horizontal plate replaces it. The bottom of the object is no such plate.
4. Thickness is the median length of the first solid that the rays meet from above. Few rays meet table legs, knobs and
   back-rests, so these do not change the median. If the normal is level, the rays come from both sides; a door counts
   rather than a thinner back panel or a whole body (`_rank`). A mesh that is open below has no such solid. Its
   thickness reaches from its top, or from the sheet that forms most of the mesh, down to its lowest rim. A container
   of one sheet, open above with its rim above its bottom, has no thickness. If the surface is no rectangle (a round
   top), its outline is the section through the middle of that solid.
5. Length and width are the median spans of rays in the mid-plane of that solid, without objects fixed to its edge
   (`plate_edge`). If the surface is not flat (a bowl, a curtain), they are the median spans of its outline, seen along
   the normal.

Source: Scene2Hap, section "Automatic Data Extraction": the size of an object is that of its dominant surface, "by
raycasting within the 3D mesh's bounding box and calculating its median values".
Differs: the paper does not say in which frame or on which side the rays start; steps 2, 4 and 5 define both.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from scene2hap.common.arrays import Bools, Floats, Ints
from scene2hap.scene.geometry import SAME_PLACE, welded
from scene2hap.scene.pose import Pose
from scene2hap.scene.shapes import DominantSurface, SurfaceFlag, TriMesh
from scene2hap.scene.surface.cuboid import cuboid_bounds_m
from scene2hap.scene.surface.frame import LIFTED, by_uprightness, facing, pointing, tightest_frame
from scene2hap.scene.surface.outline import Outline
from scene2hap.scene.surface.plate_edge import windows
from scene2hap.scene.surface.rays import Hits, cast_grid, cut, edges_seen, first_solids, median_span, share_open
from scene2hap.scene.surface.section import section_outline
from scene2hap.scene.surface.winding import edges_of, well_wound

RAYS_PER_SIDE = 32
"""Rays along each side of the bounding box. The resolution is about 1/32 of the box (tuned: 5 ms an object)."""

# All of these bounds are tuned on real scenes; a factor of two in any of them matters little.
_OPEN_SHARE = 0.02  # a mesh is open if more than this share of rays enters and does not leave
_FLAT_SHARE = 0.5  # a plate is flat if this share of its rays meets it at one height
_SAME_LEVEL = 0.1  # an open plate is flat if its rays meet it within this share of its box's height
_FILLED_CUT = 0.75  # least area of a cut's rectangle, as a share of the level area that rays see (a disc's is 0.95)
_FILLED_OUTLINE = 0.5  # least area of an outline's rectangle, as a share of the whole area that rays see
_PAIRED_SHARE = 0.5  # a plate has a thickness if this share of its rays leaves the mesh again
_SAME_AREA = 0.99  # sides this near in area are equal, and the more upright normal is chosen
_RANK_DIGITS = 9  # digits of thicknesses [m] by which plates are ordered
_UPRIGHT = 0.9  # least cosine between the vertical and a horizontal plate's normal (26 degrees)
_THIN = 1 / 3  # greatest thickness of a horizontal plate, as a share of its width. It replaces the largest side ...
_LYING_AREA = 0.6  # ... if its area is this share of that side's area (chairs 0.71-0.93) ...
# ... and if that side is level in less than this share of its rectangle (chairs <= 0.58, cupboards >= 0.74).
_FILLED_PLATE = 2 / 3
# a plate may be no rectangle if fewer than this share of the rays in its box meet it. An outline is used if ...
_FULL = 0.97
_SEEN = 0.1  # ... its area differs from the level area that rays see by less than this share of its box ...
_LIKE = 0.5, 1.5  # ... and its area is between these multiples of the rectangle of medians ...
_SAME_EXTENT = 1e-3  # ... or the rectangle is its box, to this share of the edges
# Fixed cost of a mesh and cost of each triangle, in tests of a ray against a triangle (measured: 1.5 ms, 1 us and
# 0.1 us).
_WORK_OF_A_MESH, _WORK_OF_A_FACE = 15_000, 10


class _Side(NamedTuple):
    """A mesh seen along one axis: its projected area [m2], a frame whose w is that axis, and the hits of rays."""

    area_m2: float
    own_to_plate: Floats
    hits: Hits

    def lift(self, upwards: Floats) -> float:
        """Return the absolute cosine between the axis and the vertical."""
        return abs(float(self.own_to_plate[2] @ upwards))

    def from_behind(self) -> _Side:
        """Return this side with the rays in the opposite direction."""
        row, column = np.divmod(self.hits.ray, RAYS_PER_SIDE)
        ray = (RAYS_PER_SIDE - 1 - row) * RAYS_PER_SIDE + column
        order = np.lexsort((self.hits.w, ray))
        hits = Hits(ray[order], -self.hits.w[order], -self.hits.side[order])
        return _Side(self.area_m2, self.own_to_plate * [[-1], [1], [-1]], hits)

    def level_area_m2(self, size_m: float) -> float:
        """Return the area at one level, within half the plate's thickness; the whole area for a sheet [m2]."""
        solids = first_solids(self.hits, SAME_PLACE * size_m)
        thickness = (solids.top - solids.bottom)[np.isfinite(solids.bottom)]
        if len(thickness) < _PAIRED_SHARE * len(solids.top):
            return self.area_m2
        level = np.abs(solids.top - np.median(solids.top)) <= np.median(thickness) / 2
        return self.area_m2 * float(level.mean())


def dominant_surface(
    mesh: TriMesh, *, up: ArrayLike | None = None, spend: Callable[[int], None] | None = None
) -> DominantSurface:
    """Return length, width, thickness and pose of the mesh's dominant surface, in the mesh's own frame.

    Parameters: up : (3,) upward direction in the own frame; the plate's normal points along rather than against it.
        Without it, normals point along the axes of the own frame. spend : called before the work with its size, in
        tests of a ray against a triangle; may raise to prevent the work.
    Returns: length_m >= width_m; exact for boxes and for slabs on legs, else to about a ray's spacing. Flags:
        "open-mesh": rays enter and never leave. "zero-thickness": a sheet. "box-fallback": too few rays met the surface
        twice, so the thickness is the box's, or reaches from the sheet to the lowest rim. Or no rectangle of medians
        fits, so length and width are the box's.
    """
    upwards = np.zeros(3) if up is None else np.asarray(up, dtype=np.float64)
    bounds_m = cuboid_bounds_m(mesh)
    if bounds_m is not None and np.ptp(bounds_m, axis=0).min() > SAME_PLACE * np.ptp(bounds_m, axis=0).max():
        return _cuboid(bounds_m, upwards)
    spend = spend or (lambda work: None)
    spend(_WORK_OF_A_MESH + _WORK_OF_A_FACE * len(mesh.faces))
    used, faces = np.unique(mesh.faces, return_inverse=True)
    points, faces = mesh.vertices_m[used].T.copy(), faces.reshape(-1, 3).T.copy()
    faces = well_wound(points, faces, spend)
    axes = pointing(tightest_frame(points, faces), upwards)
    is_open = False
    best: _Side | None = None
    most_upright: _Side | None = None
    for axis in by_uprightness(axes, upwards):
        own_to_plate = facing(axes, axis, points)
        placed = own_to_plate @ points
        hits = cast_grid(placed[:, faces], RAYS_PER_SIDE, spend)
        area = float(np.prod(np.ptp(placed[:2], axis=1))) * len(hits.starts) / RAYS_PER_SIDE**2
        is_open |= share_open(hits) > _OPEN_SHARE
        if len(hits.ray):
            most_upright = _Side(area, own_to_plate, hits)
            if best is None or area > best.area_m2 * _SAME_AREA:
                best = most_upright
    flags: tuple[SurfaceFlag, ...] = ("open-mesh",) if is_open else ()
    if best is None or most_upright is None:
        return _box(points, axes, flags)
    is_sheet = most_upright.lift(upwards) > _UPRIGHT and _is_container(most_upright, points, faces)
    sides = (best,) if best.lift(upwards) > LIFTED else (best, best.from_behind())
    plate = min((_plate(side, points, faces, flags, is_sheet=is_sheet) for side in sides), key=_rank)
    may_lie = most_upright is not best and most_upright.lift(upwards) > _UPRIGHT
    return (may_lie and _lying_plate(most_upright, sides, plate, points, faces)) or plate


def box_surface(mesh: TriMesh, *, up: ArrayLike) -> DominantSurface:
    """Return the box around a mesh, along the axes of its own frame, as its dominant surface (flag "box-fallback").

    It takes a hundredth of the time of `dominant_surface`, see there.
    """
    return _box(mesh.vertices_m.T, pointing(np.eye(3), np.asarray(up, dtype=np.float64)), ())


def _rank(plate: DominantSurface) -> tuple[bool, bool, float]:
    """Return a key that is least for the front of an object: a door rather than a thin back panel, and rather than the
    whole body that rays from behind may meet."""
    is_body = plate.thickness_m > _THIN * plate.width_m
    is_no_solid = bool({"zero-thickness", "box-fallback"} & set(plate.flags))
    # Rounding must not choose between a front and a back of the same thickness.
    thickness_m = round(plate.thickness_m, _RANK_DIGITS)
    return is_no_solid, is_body, thickness_m if is_body else -thickness_m


def _lying_plate(
    side: _Side, largest: Sequence[_Side], standing: DominantSurface, points: Floats, faces: Ints
) -> DominantSurface | None:
    """Return the horizontal plate of an object whose largest side is no plate, such as a chair's seat; else None.

    A chair's projected area is larger from the front than from above: legs, rungs and back are beside and behind each
    other. But the level part in front fills too little of its rectangle. Rays from above meet one thin flat plate,
    which is not the bottom of the whole object, unlike the bottom of a cup.
    """
    size_m = float(np.ptp(points, axis=1).max())
    least_m2 = _FILLED_PLATE * standing.length_m * standing.width_m
    is_plate = all(one.level_area_m2(size_m) >= least_m2 for one in largest)
    is_flat = side.level_area_m2(size_m) >= _FLAT_SHARE * side.area_m2
    if is_plate or not is_flat or side.area_m2 < _LYING_AREA * largest[0].area_m2:
        return None
    flags: tuple[SurfaceFlag, ...] = ("open-mesh",) if "open-mesh" in standing.flags else ()
    plate = _plate(side, points, faces, flags, is_sheet=False)
    is_thin = plate.thickness_m <= _THIN * plate.width_m
    middle_m = float(plate.pose.rotation[:, 2] @ np.asarray(plate.pose.position_m))
    is_raised = middle_m - float((side.own_to_plate[2] @ points).min()) > 1.5 * plate.thickness_m
    return plate if is_thin and is_raised and "box-fallback" not in plate.flags else None


def _cuboid(bounds_m: Floats, upwards: Floats) -> DominantSurface:
    """Return the result that rays would give for a box between bounds (2, 3) [m]."""
    low, high = bounds_m
    edges = high - low
    axes = pointing(np.eye(3), upwards)
    areas = np.prod(edges) / edges
    best, *others = by_uprightness(axes, upwards)
    for axis in others:
        if areas[axis] > areas[best] * _SAME_AREA:
            best = axis
    own_to_plate = facing(axes, best, np.array(bounds_m).T)
    return _placed(np.abs(own_to_plate @ edges), own_to_plate @ (low + high) / 2, own_to_plate, ())


def _plate(
    side: _Side, points: Floats, faces: Ints, flags: tuple[SurfaceFlag, ...], *, is_sheet: bool
) -> DominantSurface:
    """Return the plate of a side, from points (3, n) with triangles `faces` (3, m), without thickness if it is a
    sheet."""
    hits, triangles = side.hits, (side.own_to_plate @ points)[:, faces]
    corners = triangles.reshape(3, -1)
    low, high = corners.min(axis=1), corners.max(axis=1)
    size = float((high - low).max())
    solids = first_solids(hits, SAME_PLACE * size)
    paired = np.isfinite(solids.bottom)
    cell = float(np.prod(high[:2] - low[:2])) / RAYS_PER_SIDE**2
    spans, outline_m = None, None
    if is_sheet:
        thickness = 0.0
    elif paired.mean() >= _PAIRED_SHARE:
        thickness = float(np.median((solids.top - solids.bottom)[paired]))
        middle = float(np.median((solids.top + solids.bottom)[paired])) / 2
        level = np.abs(solids.top - np.median(solids.top)) <= thickness / 2
        if level.mean() >= _FLAT_SHARE:
            is_thick = ~(solids.top - solids.bottom < thickness / 2)
            spans = _flat_spans(cut(triangles, middle), hits.ray[hits.starts], level, is_thick, low, high)
            if level.sum() < _FULL * RAYS_PER_SIDE**2 and thickness <= _THIN * float((high - low)[:2].min()):
                outline_m = _seen_outline(triangles, middle, float(level.sum()) * cell)
    else:
        bottom, top = float(low[2]), _open_top(solids.top, hits.ray[hits.starts], low, high)
        thickness, middle = top - bottom, (top + bottom) / 2
        if thickness > SAME_PLACE * size:
            flags = (*flags, "box-fallback")
    if thickness <= SAME_PLACE * size:
        thickness, middle = 0.0, float(np.median(solids.top))
        flags = (*flags, "zero-thickness")
    spans = spans or _spans(edges_seen(triangles), at_least=_FILLED_OUTLINE * cell * len(paired))
    if spans is None:
        # No rectangle of medians fits an L, a ring with gaps or a heap, so the bounding rectangle is used.
        spans = (high - low)[:2], (high + low)[:2] / 2
        flags = flags if "box-fallback" in flags else (*flags, "box-fallback")
    (u_m, v_m), (u_mid, v_mid) = spans
    size_m, middle_m = np.array([u_m, v_m, thickness]), np.array([u_mid, v_mid, middle])
    return _placed(size_m, middle_m, side.own_to_plate, flags, outline_m)


def _seen_outline(triangles: Floats, middle: float, level_area_m2: float) -> Outline | None:
    """Return the section at a height, with or without holes, if its area matches the level area that rays see."""
    outline = section_outline(triangles, middle)
    if outline is None:
        return None
    whole = Outline(outline.rings_m[:1])
    for found in (outline, whole):
        if abs(found.area_m2 - level_area_m2) < _SEEN * math.prod(whole.extent_m):
            return found
    return None


def _is_container(side: _Side, points: Floats, faces: Ints) -> bool:
    """Return True if a mesh seen from above is one sheet whose rim is clearly above it: a crate, a bowl, a bin."""
    triangles = (side.own_to_plate @ points)[:, faces]
    low, high = triangles[2].min(), triangles[2].max()
    size = float(np.ptp(points, axis=1).max())
    solids = first_solids(side.hits, SAME_PLACE * size)
    if np.isfinite(solids.bottom).mean() >= _PAIRED_SHARE:
        return False
    return _rim_height(triangles, size) > float(np.median(solids.top) + _SAME_LEVEL * (high - low))


def _rim_height(triangles: Floats, size: float) -> float:
    """Return the median height of the edges of triangles (3, 3, m) that have one triangle only; -inf without any."""
    corners = welded(triangles.reshape(3, -1).T, SAME_PLACE * size).reshape(3, -1)
    start, end, keys = edges_of(corners)
    _, first, counts = np.unique(keys, return_index=True, return_counts=True)
    rim = first[(counts == 1) & (start != end)[first]]
    if not len(rim):
        return -math.inf
    ends = np.stack((triangles, np.roll(triangles, -1, axis=1))).reshape(2, 3, -1)[:, :, rim]
    heights = ends[:, 2].mean(axis=0)
    order = np.argsort(heights, kind="stable")
    along = np.cumsum(np.linalg.norm(ends[1] - ends[0], axis=0)[order])
    return float(heights[order][np.searchsorted(along, along[-1] / 2)])


def _open_top(tops: Floats, ray: Ints, low: Floats, high: Floats) -> float:
    """Return the height of an open mesh's plate: the level that most rays and most edge rays meet, or the mesh's top.

    So burners and knobs on a hob do not count as part of the sheet, whose rim extends down.
    """
    height, top, n = float(high[2] - low[2]), float(np.median(tops)), RAYS_PER_SIDE
    level = np.abs(tops - top) <= _SAME_LEVEL * height
    at_edge = (np.minimum(ray // n, ray % n) == 0) | (np.maximum(ray // n, ray % n) == n - 1)
    is_sheet = level.mean() >= _FLAT_SHARE and at_edge.any() and level[at_edge].mean() >= _FLAT_SHARE
    return top if is_sheet and top - low[2] > _SAME_LEVEL * height else float(high[2])


def _flat_spans(
    segments: Floats, ray: Ints, level: Bools, is_thick: Bools, low: Floats, high: Floats
) -> tuple[Floats, Floats] | None:
    """Return `_spans` of a cut without objects fixed to the plate's edge.

    `level` marks the rays that meet the plate's level; `is_thick` marks the rays that meet no solid thinner than half
    the plate.
    """
    n = RAYS_PER_SIDE
    grids = np.zeros((3, n * n), dtype=bool)
    grids[:, ray] = np.stack((np.ones_like(level), level, level & is_thick))
    seen, is_level, is_plate = grids.reshape(3, n, n)
    rows = windows(seen, is_plate)
    for along, window in enumerate(rows):
        if not window.is_all:
            bounds_m = window.bounds_m(segments, along, float(low[along]), float(high[along]))
            segments = segments.copy()
            segments[along] = segments[along].clip(*bounds_m)
    (a, b), (c, d) = (window[:2] for window in rows)
    cell = float(np.prod(high[:2] - low[:2])) / n**2
    return _spans(segments, at_least=_FILLED_CUT * cell * is_level[a:b, c:d].sum())


def _spans(segments: Floats, at_least: float) -> tuple[Floats, Floats] | None:
    """Return median extents and middles (2,) [m] along u and v; None if their rectangle is below `at_least` [m2]."""
    along_u, along_v = (median_span(segments, axis, RAYS_PER_SIDE) for axis in (0, 1))
    if along_u is None or along_v is None or along_u[0] * along_v[0] < at_least:
        return None
    extents, middles = np.array([along_u, along_v]).T
    return extents, middles


def _box(points: Floats, axes: Floats, flags: tuple[SurfaceFlag, ...]) -> DominantSurface:
    """Return the box around points (3, n) as a plate, as for meshes that no ray meets, such as needles."""
    own_to_plate = facing(axes, int(np.argmin(np.ptp(axes @ points, axis=1))), points)
    placed = own_to_plate @ points
    size, middle = np.ptp(placed, axis=1), (placed.min(axis=1) + placed.max(axis=1)) / 2
    flags = (*flags, "box-fallback")
    if size[2] <= SAME_PLACE * size.max():
        size[2] = 0.0
        flags = (*flags, "zero-thickness")
    return _placed(size, middle, own_to_plate, flags)


def _placed(
    size: Floats,
    middle: Floats,
    own_to_plate: Floats,
    flags: tuple[SurfaceFlag, ...],
    outline: Outline | None = None,
) -> DominantSurface:
    """Return the surface with its length along x; size, middle and outline [m] are along the rows of `own_to_plate`."""
    x, y, normal = own_to_plate
    is_turned = bool(size[1] > size[0])
    if is_turned:
        x, y = y, -x
        size, middle = size[[1, 0, 2]], middle[[1, 0, 2]] * [1, -1, 1]
    if outline is not None:
        outline = _own_outline(outline, size, middle, is_turned=is_turned)
    frame = np.eye(4)
    frame[:3, :3] = np.stack((x, y, normal), axis=1)
    frame[:3, 3] = frame[:3, :3] @ (middle - [size[0] / 2, size[1] / 2, 0.0])
    return DominantSurface(Pose.from_matrix(frame), float(size[0]), float(size[1]), float(size[2]), flags, outline)


def _own_outline(outline: Outline, size: Floats, middle: Floats, *, is_turned: bool) -> Outline | None:
    """Return the outline from the plate's corner; None if it is a rectangle, or does not fit the plate."""
    share = outline.area_m2 / math.prod(outline.extent_m)
    # A narrow L fills less than half of its box, which is its rectangle.
    is_box = bool(np.allclose(sorted(outline.extent_m), sorted(size[:2]), rtol=_SAME_EXTENT))
    if share > _FULL or not (is_box or _LIKE[0] < outline.area_m2 / float(size[0] * size[1]) < _LIKE[1]):
        return None
    if is_turned:
        outline = Outline(np.array(ring)[:, ::-1] * (1.0, -1.0) for ring in outline.rings_m)
    return outline.placed((1.0, 1.0), (float(size[0] / 2 - middle[0]), float(size[1] / 2 - middle[1])))
