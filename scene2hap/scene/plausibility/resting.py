"""How the objects of a scene stand in it: which rest, and which float or are sunk into the floor.

AABBs are compared. Only the ground below objects that seem to be sunk, and the surfaces around objects that others
surround, are looked up in meshes.

    boxes : (n, 2, 3) lowest and highest corners of all objects in the world [m]; up : the vertical axis, 1 or 2
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from scene2hap.common.arrays import Bools, Floats, Indices
from scene2hap.common.counted import first_of
from scene2hap.scene.geometry import distances, heights_at
from scene2hap.scene.objects import SceneData, SceneObject
from scene2hap.scene.plausibility import Finding

FLOOR_FLATNESS = 0.2
"""Greatest thickness of a floor, as a share of its narrower side (assumed)."""
_FLOOR_SHARE = 0.5  # A floor takes up this share of the scene (assumed).
_FLOATS_M = 0.25
"""A floating object is farther than this from all others and above the lowest (assumed: objects rest within 0.06 m)."""
# No object touches another that is farther away than this [m], and than this share of its own diagonal: a little more
# than the contact rule allows (assumed).
_REACH_M, _REACH_SIZES = 0.1, 0.3
_SUNK_M = 0.1
"""An object is sunk if its top is this far below the floor's top (assumed: the thickness of a floor)."""
_RESTS_M = 0.06  # Largest gap below an object at rest, about that of the contact rule.
FEW = 4
"""Fewer objects, none of them a floor, are not enough to judge a room, its up axis, or the order of quaternions."""
_MOST_NAMED = 5
_BATCH = 256


def resting_share(boxes: Floats, up: int) -> float:
    """Return the share of boxes (n, 2, 3) that rest at the lowest height or on another box."""
    low, high = boxes[:, 0], boxes[:, 1]
    level = [axis for axis in range(3) if axis != up]
    rests = low[:, up] - low[:, up].min() <= _RESTS_M
    for some, near in _batches(boxes):
        gaps = low[some, None, up] - high[None, near, up]
        over = ((low[some, None, :] < high[near]) & (high[some, None, :] > low[near]))[..., level].all(axis=2)
        over &= some[:, None] != near
        rests[some] |= (over & (np.abs(gaps) <= _RESTS_M)).any(axis=1)
    return float(rests.mean())


def misplaced(scene: SceneData, boxes: Floats, ids: tuple[str, ...], up: int) -> Iterator[Finding]:
    """Find objects that float or are sunk into the floor."""
    yield from _floating(boxes, ids, up)
    yield from _sunk(scene, boxes, ids, up)


def _batches(boxes: Floats, reach_m: float = 0.0) -> Iterator[tuple[Indices, Indices]]:
    """Yield the rows of all boxes (n, 2, 3) in batches along x, each with the rows within a reach of it along x.

    Comparing thousands of boxes with all others would take many seconds, and at once a gigabyte.
    """
    by_x = np.argsort(boxes[:, 0, 0], kind="stable")
    for start in range(0, len(boxes), _BATCH):
        some = by_x[start : start + _BATCH]
        yield some, _along_x(boxes, boxes[some], reach_m)


def _along_x(boxes: Floats, some: Floats, reach_m: float) -> Indices:
    """Return the rows of the boxes (n, 2, 3) that are within a reach of some boxes along x."""
    low, high = some[:, 0, 0].min() - reach_m, some[:, 1, 0].max() + reach_m
    return np.flatnonzero((boxes[:, 0, 0] <= high) & (boxes[:, 1, 0] >= low))


def _floating(boxes: Floats, ids: tuple[str, ...], up: int) -> Iterator[Finding]:
    if len(ids) < 2:
        return
    is_alone = boxes[:, 0, up] - boxes[:, 0, up].min() > _FLOATS_M
    for some, near in _batches(boxes, _FLOATS_M):
        within = distances(boxes[some, None], boxes[near]) <= _FLOATS_M
        within[some[:, None] == near] = False
        is_alone[some] &= ~within.any(axis=1)
    alone = np.flatnonzero(is_alone)
    if len(alone):
        row = alone[0]
        nearest_m = distances(boxes[row], np.delete(boxes, row, axis=0)).min()
        yield Finding(
            "floating",
            tuple(ids[k] for k in alone),
            f"{_named(ids, alone)} {'float' if len(alone) > 1 else 'floats'}: {_first(ids, alone)} is "
            f"{nearest_m:.2f} m from the nearest other object, more than {_FLOATS_M} m. Move {_them(alone)} onto "
            f"something; until then only a hand on {_them(alone)} feels {_them(alone)}.",
        )


def floating_inside(scene: SceneData, boxes: Floats, ids: tuple[str, ...]) -> Iterator[Finding]:
    """Find objects that another one surrounds, such as a motor in its housing, and that no surface is near.

    Rooms are left out. Boxes of triangles stand for surfaces, so that an object that may touch something is not named.
    """
    reach_m = np.minimum(_REACH_M, _REACH_SIZES * np.linalg.norm(boxes[:, 1] - boxes[:, 0], axis=1))
    holders, held = _holds(boxes)
    n_held = np.bincount(holders, minlength=len(ids))
    is_room = (n_held >= FEW) & (n_held > (len(ids) - 1) / 2)
    triangles: dict[int, Floats] = {}
    found: list[tuple[int, int, float]] = []
    for row in np.unique(held[~is_room[holders]]).tolist():
        near = _along_x(boxes, boxes[[row]], reach_m[row])
        near = near[distances(boxes[near], boxes[row]) <= reach_m[row]]
        first, end = np.searchsorted(held, (row, row + 1))
        hosts = holders[first:end].tolist()
        if not {row, *hosts}.issuperset(near.tolist()):
            continue
        for host in hosts:
            if host not in triangles:
                triangles[host] = _triangle_boxes(scene.objects[host])
        around = [x for x in hosts if not is_room[x] and _surrounds(triangles[x], boxes[row])]
        if around and not any(_is_near(triangles[x], boxes[row], reach_m[row]) for x in hosts):
            gaps_m = [float(distances(triangles[x], boxes[row]).min()) for x in around]
            found.append((row, around[int(np.argmin(gaps_m))], min(gaps_m)))
    if found:
        rows = np.array([row for row, _, _ in found])
        row, host, gap_m = found[0]
        yield Finding(
            "floating",
            tuple(ids[k] for k in rows),
            f"{_named(ids, rows)} {'float' if len(rows) > 1 else 'floats'} inside another object: {ids[row]!r} is "
            f"at least {gap_m:.2g} m from the surface of {ids[host]!r}, so no vibration passes between them. Move "
            f"{_them(rows)} to the surface, add an object that touches both, such as a bracket, or make both one "
            "object (group=).",
        )


def _holds(boxes: Floats) -> tuple[Indices, Indices]:
    """Return the rows of all pairs of boxes (n, 2, 3) of which the first holds the second and is larger.

    The pairs are sorted by the second, then by the first.
    """
    found = [np.empty((2, 0), dtype=np.intp)]
    for some, near in _batches(boxes):
        one, other = boxes[near, None], boxes[None, some]
        holds = ((one[..., 0, :] <= other[..., 0, :]) & (one[..., 1, :] >= other[..., 1, :])).all(axis=2)
        holds &= (one != other).any(axis=(2, 3))
        holder, held = np.nonzero(holds)
        found.append(np.stack([near[holder], some[held]]))
    holder, held = np.concatenate(found, axis=1)
    by_held = np.lexsort((holder, held))
    return holder[by_held], held[by_held]


def _surrounds(boxes: Floats, box: Floats) -> bool:
    """Return True if any of the boxes (m, 2, 3) is on each of the six sides of a box (2, 3)."""
    overlaps = (boxes[:, 0] <= box[1]) & (boxes[:, 1] >= box[0])
    for axis in range(3):
        beside = boxes[np.delete(overlaps, axis, axis=1).all(axis=1), :, axis]
        if not ((beside[:, 0] <= box[0, axis]).any() and (beside[:, 1] >= box[1, axis]).any()):
            return False
    return True


def _is_near(boxes: Floats, box: Floats, reach_m: float) -> bool:
    """Return True if any box (m, 2, 3) meets a box (2, 3) that is enlarged by a reach."""
    # One axis after the other: the first leaves few of the triangles of a room.
    for axis in range(3):
        is_low, is_high = boxes[:, 0, axis] <= box[1, axis] + reach_m, boxes[:, 1, axis] >= box[0, axis] - reach_m
        boxes = boxes[is_low & is_high]
    return len(boxes) > 0


def _triangle_boxes(item: SceneObject) -> Floats:
    """Return the boxes (m, 2, 3) of an object's triangles in the world."""
    mesh = item.geometry.mesh
    corners = item.pose.to_world(mesh.vertices_m)[mesh.faces]
    return np.stack([corners.min(axis=1), corners.max(axis=1)], axis=1)


def floor_of(boxes: Floats, up: int) -> tuple[int, Bools] | None:
    """Return the row of the lowest floor, and a mask of the boxes above or below it; None without a floor.

    A plate that nothing reaches above is no floor but a ceiling, a roof or a table top.
    """
    low, high = boxes[:, 0], boxes[:, 1]
    level = [axis for axis in range(3) if axis != up]
    whole = np.ptp(boxes.reshape(-1, 3)[:, level], axis=0).prod()
    sizes = high - low
    is_floor = (sizes[:, level].prod(axis=1) >= _FLOOR_SHARE * whole) & (
        sizes[:, up] <= FLOOR_FLATNESS * sizes[:, level].min(axis=1)
    )
    for plate in np.flatnonzero(is_floor).tolist():
        is_floor[plate] = bool((np.delete(high[:, up], plate) > low[plate, up]).any())
    if not is_floor.any():
        return None
    row = int(np.flatnonzero(is_floor)[high[is_floor, up].argmin()])
    among = np.all((low[:, level] < high[row, level]) & (high[:, level] > low[row, level]), axis=1)
    among &= np.arange(len(among)) != row
    return row, among


def _ground_below(floor: SceneObject, boxes: Floats, up: int) -> Floats:
    """Return the height (n,) of a floor in the middle of each box (n, 2, 3): hills are higher than what stands beside.

    Where the floor has a hole, this is its top.
    """
    mesh = floor.geometry.mesh
    level = [axis for axis in range(3) if axis != up]
    corners = floor.pose.to_world(mesh.vertices_m)[:, [*level, up]][mesh.faces]
    low, high = corners[..., :2].min(axis=1), corners[..., :2].max(axis=1)
    heights = np.full(len(boxes), floor.bounds_m[1][up])
    for row, middle in enumerate(boxes[:, :, level].mean(axis=1)):
        below = corners[((low <= middle) & (high >= middle)).all(axis=1)]
        highest = heights_at(middle[None], below).max(initial=-np.inf)
        if np.isfinite(highest):
            heights[row] = highest
    return heights


def misplaced_room(scene: SceneData, boxes: Floats, ids: tuple[str, ...], up: int) -> Iterator[Finding]:
    """Find a room in which no object is on the floor, or in which most objects are sunk into the floor."""
    found = floor_of(boxes, up)
    if found is None or found[1].sum() < FEW:
        return
    floor, rows = found[0], np.flatnonzero(found[1])
    over = boxes[rows, 0, up] - boxes[floor, 1, up]
    if np.median(over) < -_SUNK_M:
        over = boxes[rows, 0, up] - _ground_below(scene.objects[floor], boxes[rows], up)
    names = tuple(ids[k] for k in rows)
    if over.min() > _FLOATS_M:
        yield Finding(
            "floating",
            names,
            f"the room floats: the lowest of {len(rows)} objects over {ids[floor]!r} is {over.min():.2f} m above it, "
            f"more than {_FLOATS_M} m. Lower them, or raise the floor.",
        )
    elif np.median(over) < -_SUNK_M:
        yield Finding(
            "sunk",
            names,
            f"the room is sunk: most of {len(rows)} objects begin below the top of {ids[floor]!r}, half of them by "
            f"{-np.median(over):.2f} m or more; at most {_SUNK_M} m is usual. Raise them, or lower the floor.",
        )


def _sunk(scene: SceneData, boxes: Floats, ids: tuple[str, ...], up: int) -> Iterator[Finding]:
    found = floor_of(boxes, up)
    if found is None:
        return
    floor, over = found
    depth = boxes[floor, 1, up] - boxes[:, 1, up]
    lower = np.flatnonzero(over & (depth > _SUNK_M))
    if len(lower):
        depth[lower] = _ground_below(scene.objects[floor], boxes[lower], up) - boxes[lower, 1, up]
    sunk = lower[depth[lower] > _SUNK_M]
    if len(sunk):
        row = sunk[0]
        yield Finding(
            "sunk",
            tuple(ids[k] for k in sunk),
            f"{_named(ids, sunk)} {'are' if len(sunk) > 1 else 'is'} below the floor: {_first(ids, sunk)} ends "
            f"{depth[row]:.2f} m under the top of {ids[floor]!r}, more than {_SUNK_M} m. Raise {_them(sunk)}.",
        )


def _them(rows: Indices) -> str:
    return "them" if len(rows) > 1 else "it"


def _first(ids: tuple[str, ...], rows: Indices) -> str:
    """Return the first of several objects that a message has just named, or "it" for a single one."""
    return repr(ids[rows[0]]) if len(rows) > 1 else "it"


def _named(ids: tuple[str, ...], rows: Indices) -> str:
    return first_of([repr(ids[k]) for k in rows], _MOST_NAMED)
