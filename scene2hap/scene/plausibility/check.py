"""Find likely mistakes in a scene: units, sizes, quaternions, masses, hinges, the up axis, merged, floating or sunken
objects.

Each finding is a sentence with the value, the bound and the remedy. The checks use AABBs, so a scene takes
milliseconds. All bounds are wide, since a false alarm costs more than a missed mistake.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from scene2hap.common import checks
from scene2hap.common.arrays import Floats
from scene2hap.scene.hinges import HINGE_PLAY_M
from scene2hap.scene.names import name_words, names_a_place
from scene2hap.scene.objects import VERTICAL, SceneData, SceneObject
from scene2hap.scene.plausibility import Finding, Kind
from scene2hap.scene.plausibility.resting import (
    FEW,
    FLOOR_FLATNESS,
    floating_inside,
    floor_of,
    misplaced,
    misplaced_room,
    resting_share,
)
from scene2hap.scene.plausibility.units import implausible
from scene2hap.scene.shapes import Box

# The up axis is doubted if at least this share of objects rests along the other axis. This share must also be this many
# times the share along the up axis. Tuned: six scenes by others have 0.59-0.95 along the right axis, 1.3 to 4.5 times
# as many as along the wrong axis. Sizes and poses are doubted likewise: 0.04-0.21 rest at half sizes and 0.04-0.38 with
# poses of bottoms for middles. Where the scenes are right, at most 0.7 times as many rest in one of the other readings.
_MOST_RESTING, _MORE_RESTING = 0.5, 1.5
# This many rotations with a first component of 1 show that w is first: read as (x, y, z, w), they turn objects upside
# down.
_LEAST_UNTURNED = 2
# The w of a rotation by 74 degrees. Most objects are rotated by less (assumed). Exporters that rotate all objects to
# another up axis use 90 degrees.
_MOSTLY_W = 0.8
_GROUNDS = frozenset({"floor", "ground", "carpet", "rug"})
_DENSEST_KG_M3 = 22_600.0  # osmium
_ROUNDING = 1e-6


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
    resting, other = resting_share(boxes, up), resting_share(boxes, 3 - up)
    is_doubtful = other >= max(_MOST_RESTING, _MORE_RESTING * resting) and not _has_level_ground(scene, boxes, up)
    if is_doubtful and (len(ids) >= FEW or _has_level_ground(scene, boxes, 3 - up)):
        letter = "xyz"[3 - up]
        yield Finding(
            "up-axis",
            ids,
            f"{resting:.0%} of {len(ids)} objects rest on others along {scene.up_axis}, {other:.0%} along {letter}; "
            f"up_axis is probably {letter!r}. Give up_axis={letter!r}.",
        )
        return
    room = tuple(misplaced_room(scene, boxes, ids, up))
    if not room and (len(ids) >= FEW or _has_level_ground(scene, boxes, up)):
        misread = _misread(scene, boxes, up, resting)
        if misread is not None:
            yield misread
            return
    if sizes is None:
        yield from floating_inside(scene, boxes, ids)
    yield from room or misplaced(scene, boxes, ids, up)


def _misread(scene: SceneData, boxes: Floats, up: int, resting: float) -> Finding | None:
    """Return the finding that most objects would rest if sizes or poses of a `Box` had another meaning, None if they
    would not. Meshes are as they are."""
    halves = np.ptp(boxes, axis=1, keepdims=True) / 2
    halves *= np.array([isinstance(item.geometry, Box) for item in scene.objects])[:, None, None]
    readings: list[tuple[Kind, Floats, str, str]] = [
        (
            "half-sizes",
            boxes + halves * [[-1.0], [1.0]],
            "if all were twice as large",
            "the sizes are probably half sizes, as physics engines have them. Double them: a Box has whole sizes",
        )
    ]
    # Without a floor, middles at one height are as likely: a shaft with its wheels.
    if floor_of(boxes, up) is not None:
        readings.append(
            (
                "bottoms",
                boxes + halves * np.eye(3)[up],
                "if each was raised by half its height",
                "the positions are probably those of bottoms. Raise the poses: that of a Box is its middle",
            )
        )
    shares = [resting_share(read, up) for _, read, _, _ in readings]
    kind, _, how, remedy = readings[int(np.argmax(shares))]
    if max(shares) < max(_MOST_RESTING, _MORE_RESTING * resting):
        return None
    ids = tuple(item.id for item in scene.objects)
    return Finding(kind, ids, f"{resting:.0%} of {len(ids)} objects rest on others, {max(shares):.0%} {how}; {remedy}.")


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
    zeros = (1, 3) if scene.up_axis == "y" else (1, 2)
    tips = np.abs(rotations[:, list(zeros)]).max(axis=1) < _ROUNDING
    first = np.abs(rotations[:, 0])
    is_none = len(tips) >= _LEAST_UNTURNED and bool((first > 1.0 - _ROUNDING).all())
    return is_none or bool(len(tips) >= FEW and tips.all() and (first > _MOSTLY_W).mean() > 0.5)


def _has_level_ground(scene: SceneData, boxes: Floats, up: int) -> bool:
    """Return True if an object that is named as a floor is flat along an axis.

    That shows the up axis even where most objects hang on walls, as in a gallery, and where there are few objects.
    """
    sizes = np.ptp(boxes, axis=1)
    is_flat = sizes[:, up] <= FLOOR_FLATNESS * np.delete(sizes, up, axis=1).min(axis=1)
    return any(
        flat and _GROUNDS & set(name_words(item.name)) for item, flat in zip(scene.objects, is_flat, strict=True)
    )
