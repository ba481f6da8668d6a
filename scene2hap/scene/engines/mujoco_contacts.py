"""Contacts of a MuJoCo simulation: between objects, and of a part of the model, such as a hand, with objects."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from typing import Any, NamedTuple

import numpy as np

from scene2hap.common import checks
from scene2hap.common.arrays import Bools, Floats, Indices
from scene2hap.errors import SceneError, UnknownObject
from scene2hap.scene.engines.mujoco_objects import ModelObjects, ids_of, objects_of, require_model
from scene2hap.scene.objects import Contact
from scene2hap.scene.plausibility.units import metres_per_unit

_IN_GAP = 1


class ContactPoints(NamedTuple):
    """Contact points of one or more steps: numbers of the geoms (n, 2), points (n, 3) in the model's unit, and normals
    (n, 3) from the first geom to the second."""

    geoms: Indices
    points: Floats
    normals: Floats


def contact_points(data: Any) -> ContactPoints:
    """Return a copy of the engine's contact points, without those in a geom's gap, which exert no force."""
    given = data.contact
    active = np.flatnonzero(np.asarray(given.exclude) != _IN_GAP)
    geoms, points, frames = (np.asarray(each)[active] for each in (given.geom, given.pos, given.frame))
    return ContactPoints(geoms.astype(np.intp), points, frames[:, :3])


def points_of_steps(steps: Sequence[ContactPoints]) -> ContactPoints:
    """Return the contact points of several steps: for each pair of geoms, those of the last step that has any."""
    geoms, points, normals = (np.concatenate(each) for each in zip(*steps, strict=True))
    step = np.repeat(np.arange(len(steps)), [len(one.geoms) for one in steps])
    _, pair = np.unique(geoms[:, 0] * (geoms.max(initial=0) + 2) + geoms[:, 1], return_inverse=True)
    last = np.zeros(len(geoms), dtype=np.intp)
    np.maximum.at(last, pair, step)
    kept = step == last[pair]
    return ContactPoints(geoms[kept], points[kept], normals[kept])


def contacts(
    model: Any,
    data: Any,
    *,
    points: ContactPoints | None = None,
    geom_groups: Collection[int] | None = None,
    unit_m: float = 1.0,
) -> tuple[Contact, ...]:
    """Return the engine's contacts between objects of the last `snapshot` with the same arguments.

    Parameters: points : those of several steps; None takes the current ones.
    """
    unit_m = metres_per_unit(unit_m)
    require_model(model, data)
    items = objects_of(model, geom_groups)
    return contacts_of(model, contact_points(data) if points is None else points, items, unit_m)


def geoms_below(model: Any, data: Any, body: str) -> Bools:
    """Return a mask of the geoms (n_geoms + 1,) of a body and of the bodies below it, such as a hand's fingers.

    A body without a name is given by its id (rule 4 of `mujoco_objects`). The last entry, for "no geom", is False.
    Raises: UnknownObject: the model has no such body. SceneError: none of the geoms can collide.
    """
    require_model(model, data)
    named = {name: k + 1 for k, name in enumerate(ids_of(model)[: model.nbody - 1])}
    if not isinstance(body, str) or body not in named:
        hint = checks.did_you_mean(body, named) if isinstance(body, str) else "Give the name of one body."
        raise UnknownObject(f"the model has no body {checks.represented(body)}. {hint}".rstrip())
    is_below = np.zeros(model.nbody, dtype=bool)
    is_below[named[body]] = True
    # In MuJoCo a parent has a lower number than its children, so one pass finds all.
    for below in range(named[body] + 1, model.nbody):
        is_below[below] = is_below[model.body_parentid[below]]
    found = is_below[model.geom_bodyid]
    if not (found & _can_collide(model)).any():
        raise SceneError(
            f"body {body!r} has no geom that collides, nor has any body below it, so it touches nothing. Give one "
            "contype and conaffinity, or name another body."
        )
    return np.append(found, False)


def _can_collide(model: Any) -> Bools:
    """Return a mask of the geoms (n_geoms,) that collide with any others."""
    collides: Bools = (model.geom_contype != 0) | (model.geom_conaffinity != 0)
    collides[_paired(model)] = True
    return collides


def _paired(model: Any) -> Indices:
    """Return the geoms that a `<pair>` names."""
    return np.concatenate((model.pair_geom1, model.pair_geom2)).astype(np.intp)


def touched(
    model: Any,
    data: Any,
    part: Bools,
    *,
    points: ContactPoints | None = None,
    geom_groups: Collection[int] | None = None,
    unit_m: float = 1.0,
) -> list[tuple[str, tuple[float, float, float]]]:
    """Return the objects that the geoms of a part, from `geoms_below`, touch, with the contact points [m].

    There is one entry for each contact point with a geom outside the part.
    Parameters: points : those of several steps; None takes the current ones.
    """
    require_model(model, data)
    items = objects_of(model, geom_groups)
    geoms, places, _ = contact_points(data) if points is None else points
    is_own = part[geoms]
    kept = np.flatnonzero(is_own[:, 0] != is_own[:, 1])
    others = geoms[kept, is_own[kept, 0].astype(np.intp)]
    rows = items.row_of_geom(model)[others].tolist()
    places_m = (places[kept] * unit_m).tolist()
    return [(items.ids[row], (x, y, z)) for row, (x, y, z) in zip(rows, places_m, strict=True) if row >= 0]


def out_of_reach(model: Any, part: Bools, geom_groups: Collection[int] | None = None) -> list[str]:
    """Return the ids of the objects whose contacts with a part, from `geoms_below`, MuJoCo leaves out: neither can move
    by itself, as a table that is part of the world and a mocap body. Empty if the model has `<pair>`s of the part."""
    can_move = model.body_dofnum[model.body_weldid[model.geom_bodyid]] > 0
    if can_move[part[:-1]].any() or part[_paired(model)].any():
        return []
    items = objects_of(model, geom_groups)
    rows = items.row_of_geom(model)[:-1]
    fixed = rows[~can_move & ~part[:-1] & _can_collide(model) & (rows >= 0)]
    return [items.ids[row] for row in np.unique(fixed).tolist()]


def contacts_of(model: Any, points: ContactPoints, items: ModelObjects, unit_m: float) -> tuple[Contact, ...]:
    """Return the engine's contacts between objects, without those with geoms that are not drawn."""
    # A deformable body has no geom. Its contacts have geom -1, which indexes the last entry.
    rows = items.row_of_geom(model)[points.geoms]
    kept = np.flatnonzero((rows >= 0).all(axis=1) & (rows[:, 0] != rows[:, 1]))
    places, normals = points.points[kept] * unit_m, points.normals[kept]
    return tuple(
        Contact(items.ids[a], items.ids[b], (x, y, z), (nx, ny, nz))
        for (a, b), (x, y, z), (nx, ny, nz) in zip(rows[kept].tolist(), places.tolist(), normals.tolist(), strict=True)
    )
