"""Find likely mistakes in a scene: units, quaternions, masses, hinges, the up axis, merged, floating or sunken objects.

Each finding is a sentence with the value, the bound and the remedy. The checks use AABBs, so a scene takes
milliseconds; only the ground below objects that seem to be sunk is measured in its mesh. All bounds are wide, since a
false alarm costs more than a missed mistake.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from scene2hap.common import checks
from scene2hap.common.counted import first_of
from scene2hap.scene.copies import name_words
from scene2hap.scene.geometry import distances, heights_at
from scene2hap.scene.grouping.empty_names import names_a_place
from scene2hap.scene.hinges import HINGE_PLAY_M
from scene2hap.scene.objects import VERTICAL, SceneData, SceneObject
from scene2hap.scene.plausibility.units import implausible

Kind = Literal["units", "quaternions", "up-axis", "floating", "sunk", "mass", "merged", "hinge"]

_FLOATS_M = 0.25
"""A floating object is farther than this from all others and above the lowest (assumed: objects rest within 0.06 m)."""
# No object touches another that is farther away than this [m], and than this share of its own diagonal: a little more
# than the contact rule allows (assumed).
_REACH_M, _REACH_SIZES = 0.1, 0.3
_SUNK_M = 0.1
"""An object is sunk if its top is this far below the floor's top (assumed: the thickness of a floor)."""
_RESTS_M = 0.06  # Largest gap below an object at rest, about that of the contact rule.
# The up axis is doubted if at least this share of objects rests along the other axis. This share must also be this many
# times the share along the up axis. Tuned: five scenes by others have 0.59-0.83 along the right axis, 1.7 to 2.7 times
# as many as along the wrong axis.
_MOST_RESTING, _MORE_RESTING = 0.5, 1.5
_FEW = 4  # Fewer objects, none of them a floor, are not enough to find the up axis or the order of quaternions.
# This many rotations with a first component of 1 show that w is first: read as (x, y, z, w), they turn objects upside
# down.
_TWO = 2
# The w of a rotation by 74 degrees. Most objects are rotated by less (assumed). Exporters that rotate all objects to
# another up axis use 90 degrees.
_MOSTLY_W = 0.8
_FLOOR_SHARE, _FLOOR_FLATNESS = 0.5, 0.2  # A floor takes up this share of the scene, and is this flat (assumed).
_GROUNDS = frozenset({"floor", "ground", "carpet", "rug"})
_DENSEST_KG_M3 = 22_600.0  # osmium
_NONE = 1e-6
_MOST_NAMED = 5
_BATCH = 256


class Finding(NamedTuple):
    """A probable mistake: its kind, the ids of the objects that show it, and a sentence."""

    kind: Kind
    object_ids: tuple[str, ...]
    sentence: str

    def __str__(self) -> str:
        return self.sentence


def findings(scene: SceneData) -> Iterator[Finding]:
    """Find likely mistakes in a scene."""
    ids = tuple(item.id for item in scene.objects)
    sizes = implausible(scene)
    if sizes is not None:
        unit = f", as for {sizes.name}" if sizes.name else ""
        model = f" ({sizes.of_model_m} if it holds one model and no room)" if sizes.of_model_m else ""
        remedy = (
            f"Load the file with unit_m={sizes.unit_m}{unit}{model}, or multiply positions and sizes by {sizes.unit_m}."
        )
        yield Finding("units", ids, f"{sizes.sentence} {remedy}")
    if _begin_with_w(scene):
        yield Finding(
            "quaternions",
            ids,
            f"all {len(ids)} rotation_xyzw tip objects over, as quaternions do that begin with w: the first is "
            f"{scene.objects[0].pose.rotation_xyzw}. Make poses by Pose.from_wxyz(position_m, rotation_wxyz).",
        )
    yield from _merged(scene, ids)
    for item in scene.objects:
        heavy = None if item.mass_kg is None else too_heavy(item, item.mass_kg)
        if heavy:
            yield Finding("mass", (item.id,), heavy)
    yield from _loose_hinges(scene)
    boxes = np.array([item.bounds_m for item in scene.objects])
    up = VERTICAL[scene.up_axis]
    resting, other = _resting_share(boxes, up), _resting_share(boxes, 3 - up)
    is_doubtful = other >= max(_MOST_RESTING, _MORE_RESTING * resting) and not _has_level_ground(scene, boxes, up)
    if is_doubtful and (len(ids) >= _FEW or _has_level_ground(scene, boxes, 3 - up)):
        letter = "xyz"[3 - up]
        yield Finding(
            "up-axis",
            ids,
            f"{resting:.0%} of {len(ids)} objects rest on others along {scene.up_axis}, {other:.0%} along {letter}; "
            f"up_axis is probably {letter!r}. Give up_axis={letter!r}.",
        )
        return
    if sizes is None:
        yield from _floating_inside(scene, boxes, ids)
    room = list(_room(scene, boxes, ids, up))
    yield from room
    if not room:
        yield from _floating(boxes, ids, up)
        yield from _sunk(scene, boxes, ids, up)


def _loose_hinges(scene: SceneData) -> Iterator[Finding]:
    """Find hinges that hold nothing."""
    by_id = {item.id: item for item in scene.objects}
    for item in scene.objects:
        hinge = item.hinge
        if hinge is None:
            continue
        other, named = by_id.get(hinge.to), f"the hinge of {item.id!r} to {hinge.to!r} holds nothing: "
        if other is None:
            hint = checks.did_you_mean(hinge.to, by_id)
            yield Finding("hinge", (item.id,), f"{named}the scene has no such object. {hint}".rstrip())
            continue
        here, there = item.pose.to_world([hinge.point_m])[0], other.pose.to_world([hinge.other_point_m])[0]
        apart_m = float(np.linalg.norm(here - there))
        if apart_m >= HINGE_PLAY_M:
            yield Finding(
                "hinge",
                (item.id, other.id),
                f"{named}its two points are {apart_m:.2g} m apart, and must be within {HINGE_PLAY_M:g} m. Give each in "
                "its own object's frame, or make it by hinged_on.",
            )


def _merged(scene: SceneData, ids: tuple[str, ...]) -> Iterator[Finding]:
    """Find a room that is one object, since its file was merged into one mesh."""
    if len(ids) > 1 or not names_a_place(scene.objects[0].name):
        return
    # Imported here, since few scenes need scipy.sparse for this.
    from scene2hap.scene.grouping.loose_parts import n_loose_parts

    n_parts = n_loose_parts(scene.objects[0].geometry.mesh)
    if n_parts > 1:
        yield Finding(
            "merged",
            ids,
            f"{scene.name!r} is one object, {ids[0]!r}, of {n_parts} loose parts. Separate and name them in the "
            "program that made it (Blender: Edit Mode, P, By Loose Parts), or load the file with group='loose' "
            "(--group loose): then each part is an object, which `scene2hap edit BUNDLE name` or a model (llm) names.",
        )


def too_heavy(item: SceneObject, mass_kg: float) -> str | None:
    """Return why an object cannot have a mass [kg]: its AABB would be denser than any material. None if plausible."""
    volume_m3 = float(np.prod(np.ptp(item.geometry.mesh.bounds_m, axis=0)))
    density = mass_kg / volume_m3 if volume_m3 > 0 else 0.0  # a sheet has no volume, so its density is unknown
    if density <= _DENSEST_KG_M3:
        return None
    return (
        f"mass_kg of {item.id!r} is {mass_kg:g} kg in a box of {volume_m3:.2g} m3, {density:.2g} kg/m3, more than any "
        f"material has, {_DENSEST_KG_M3:g} kg/m3. Give it in kg, not in g."
    )


def _begin_with_w(scene: SceneData) -> bool:
    """Return True if w probably comes first: only then would all rotations be about the vertical."""
    rotations = np.array([item.pose.rotation_xyzw for item in scene.objects])
    # (w, x, y, z) of a rotation about y is (c, 0, s, 0), about z (c, 0, 0, s). Read as (x, y, z, w) it tips objects
    # over.
    none = (1, 3) if scene.up_axis == "y" else (1, 2)
    tips = np.abs(rotations[:, list(none)]).max(axis=1) < _NONE
    first = np.abs(rotations[:, 0])
    is_none = len(tips) >= _TWO and bool((first > 1.0 - _NONE).all())
    return is_none or bool(len(tips) >= _FEW and tips.all() and (first > _MOSTLY_W).mean() > 0.5)


def _resting_share(boxes: NDArray[np.float64], up: int) -> float:
    """Return the share of boxes (n, 2, 3) that rest at the lowest height or on another box."""
    low, high = boxes[:, 0], boxes[:, 1]
    level = [axis for axis in range(3) if axis != up]
    rests = low[:, up] - low[:, up].min() <= _RESTS_M
    for some, near in _batches(boxes):
        gaps = low[some, None, up] - high[None, near, up]
        over = ((low[some, None, :] < high[near]) & (high[some, None, :] > low[near]))[..., level].all(axis=2)
        rests[some] |= (over & (np.abs(gaps) <= _RESTS_M)).any(axis=1)
    return float(rests.mean())


def _has_level_ground(scene: SceneData, boxes: NDArray[np.float64], up: int) -> bool:
    """Return True if an object that is named as a floor is flat along an axis.

    That shows the up axis even where most objects hang on walls, as in a gallery, and where there are few objects.
    """
    sizes = np.ptp(boxes, axis=1)
    is_flat = sizes[:, up] <= _FLOOR_FLATNESS * np.delete(sizes, up, axis=1).min(axis=1)
    return any(
        flat and _GROUNDS & set(name_words(item.name)) for item, flat in zip(scene.objects, is_flat, strict=True)
    )


def _batches(boxes: NDArray[np.float64], reach_m: float = 0.0) -> Iterator[tuple[NDArray[np.intp], NDArray[np.intp]]]:
    """Yield the rows of all boxes (n, 2, 3) in batches along x, each with the rows within a reach of it along x.

    Comparing thousands of boxes with all others would take many seconds, and at once a gigabyte.
    """
    by_x = np.argsort(boxes[:, 0, 0], kind="stable")
    for start in range(0, len(boxes), _BATCH):
        some = by_x[start : start + _BATCH]
        yield some, _along_x(boxes, boxes[some], reach_m)


def _along_x(boxes: NDArray[np.float64], some: NDArray[np.float64], reach_m: float) -> NDArray[np.intp]:
    """Return the rows of the boxes (n, 2, 3) that are within a reach of some boxes along x."""
    low, high = some[:, 0, 0].min() - reach_m, some[:, 1, 0].max() + reach_m
    return np.flatnonzero((boxes[:, 0, 0] <= high) & (boxes[:, 1, 0] >= low))


def _floating(boxes: NDArray[np.float64], ids: tuple[str, ...], up: int) -> Iterator[Finding]:
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


def _floating_inside(scene: SceneData, boxes: NDArray[np.float64], ids: tuple[str, ...]) -> Iterator[Finding]:
    """Find objects that another one surrounds, such as a motor in its housing, and that no surface is near.

    Rooms are left out.

    Boxes of triangles stand for surfaces, so that an object that may touch something is never named.
    """
    reach_m = np.minimum(_REACH_M, _REACH_SIZES * np.linalg.norm(boxes[:, 1] - boxes[:, 0], axis=1))
    holders, held = _holds(boxes)
    n_held = np.bincount(holders, minlength=len(ids))
    is_room = (n_held >= _FEW) & (n_held > (len(ids) - 1) / 2)
    triangles: dict[int, NDArray[np.float64]] = {}
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


def _holds(boxes: NDArray[np.float64]) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
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


def _surrounds(boxes: NDArray[np.float64], box: NDArray[np.float64]) -> bool:
    """Return True if any of the boxes (m, 2, 3) is on each of the six sides of a box (2, 3)."""
    overlaps = (boxes[:, 0] <= box[1]) & (boxes[:, 1] >= box[0])
    for axis in range(3):
        beside = boxes[np.delete(overlaps, axis, axis=1).all(axis=1), :, axis]
        if not ((beside[:, 0] <= box[0, axis]).any() and (beside[:, 1] >= box[1, axis]).any()):
            return False
    return True


def _is_near(boxes: NDArray[np.float64], box: NDArray[np.float64], reach_m: float) -> bool:
    """Return True if any box (m, 2, 3) meets a box (2, 3) that is enlarged by a reach."""
    # One axis after the other: the first leaves few of the triangles of a room.
    for axis in range(3):
        is_low, is_high = boxes[:, 0, axis] <= box[1, axis] + reach_m, boxes[:, 1, axis] >= box[0, axis] - reach_m
        boxes = boxes[is_low & is_high]
    return len(boxes) > 0


def _triangle_boxes(item: SceneObject) -> NDArray[np.float64]:
    """Return the boxes (m, 2, 3) of an object's triangles in the world."""
    mesh = item.geometry.mesh
    corners = item.pose.to_world(mesh.vertices_m)[mesh.faces]
    return np.stack([corners.min(axis=1), corners.max(axis=1)], axis=1)


def _floor(boxes: NDArray[np.float64], up: int) -> tuple[int, NDArray[np.bool_]] | None:
    """Return the row of the lowest floor, and a mask of the boxes above or below it; None without a floor.

    A plate that nothing reaches above is no floor but a ceiling, a roof or a table top.
    """
    low, high = boxes[:, 0], boxes[:, 1]
    level = [axis for axis in range(3) if axis != up]
    whole = np.ptp(boxes.reshape(-1, 3)[:, level], axis=0).prod()
    sizes = high - low
    is_floor = (sizes[:, level].prod(axis=1) >= _FLOOR_SHARE * whole) & (
        sizes[:, up] <= _FLOOR_FLATNESS * sizes[:, level].min(axis=1)
    )
    for plate in np.flatnonzero(is_floor).tolist():
        is_floor[plate] = bool((np.delete(high[:, up], plate) > low[plate, up]).any())
    if not is_floor.any():
        return None
    row = int(np.flatnonzero(is_floor)[high[is_floor, up].argmin()])
    among = np.all((low[:, level] < high[row, level]) & (high[:, level] > low[row, level]), axis=1)
    among &= np.arange(len(among)) != row
    return row, among


def _ground_below(floor: SceneObject, boxes: NDArray[np.float64], up: int) -> NDArray[np.float64]:
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


def _room(scene: SceneData, boxes: NDArray[np.float64], ids: tuple[str, ...], up: int) -> Iterator[Finding]:
    """Find a room in which no object is on the floor, or in which most objects are sunk into the floor."""
    found = _floor(boxes, up)
    if found is None or found[1].sum() < _FEW:
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


def _sunk(scene: SceneData, boxes: NDArray[np.float64], ids: tuple[str, ...], up: int) -> Iterator[Finding]:
    found = _floor(boxes, up)
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


def _them(rows: NDArray[np.intp]) -> str:
    return "them" if len(rows) > 1 else "it"


def _first(ids: tuple[str, ...], rows: NDArray[np.intp]) -> str:
    """Return the first of several objects that a message has just named, or "it" for a single one."""
    return repr(ids[rows[0]]) if len(rows) > 1 else "it"


def _named(ids: tuple[str, ...], rows: NDArray[np.intp]) -> str:
    return first_of([repr(ids[k]) for k in rows], _MOST_NAMED)
