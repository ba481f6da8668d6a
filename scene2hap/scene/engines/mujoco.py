"""MuJoCo models as snapshots: a running `MjModel` with its `MjData`, or an MJCF file.

1. Every body with drawn geoms is an object, with all its geoms in one mesh. Doors, drawers and knobs are bodies below
   others, so they are objects too. A body without geoms is no object, and no mocap body whose geoms cannot collide:
   these are targets and markers.
2. Every geom of the world body (floor, walls) is an object.
3. If a body has visible geoms that cannot collide (contype and conaffinity 0), only these are drawn; otherwise all its
   geoms are. Of the world body, visible geoms that cannot collide are drawn, and geoms that collide, except in groups 3
   to 5, which MuJoCo's viewer hides. `geom_groups` overrides these rules, also that for markers.
4. An object's id is the name of the body (or world geom), which is unique in MuJoCo. Without a name, the id is made of
   the parent's id and the body's number there: `cabinet/body2`, `world/geom1`. The object's name is the body's name, or
   by rule (c) of `scene.grouping.groups` the name of a wrapper: a parent without geoms whose only child is this
   body, without a joint between them (`microwave` over `microroot`). If this name says nothing (`object`, or none), the
   object has the words that the names of all its geoms, or their meshes, begin with (`milk_mesh`; `club` of
   `club_handle` and `club_head`). An upright plane of the world is a `floor`. An unnamed body without any of these is
   called by its id, which has the parent's name.
5. A body that turns on another has a hinge (`mujoco_joints`).

Poses are the bodies' own (xpos, xquat). Infinite planes are cut to twice the model's extent. Deformable bodies and
skins are left out. Nothing here steps or changes the simulation.
"""

from __future__ import annotations

import math
import os
from collections.abc import Collection, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from itertools import takewhile
from pathlib import Path
from typing import Any, Literal, NamedTuple
from weakref import WeakKeyDictionary

import numpy as np
from numpy.typing import NDArray

from scene2hap.common import checks
from scene2hap.errors import SceneError, SceneFormatError, UnknownObject
from scene2hap.scene import limits
from scene2hap.scene.copies import name_words
from scene2hap.scene.engines import engine
from scene2hap.scene.engines.mjcf_files import check_files
from scene2hap.scene.engines.mujoco_geoms import GeomReader, authored_pose, colours_rgba
from scene2hap.scene.engines.mujoco_joints import hinges
from scene2hap.scene.grouping.empty_names import says_nothing
from scene2hap.scene.grouping.groups import Group, group_objects, unique_ids
from scene2hap.scene.grouping.object_maker import ObjectMaker
from scene2hap.scene.objects import Contact, with_relative_heights
from scene2hap.scene.plausibility.units import metres_per_unit, warn_if_implausible
from scene2hap.scene.pose_table import PoseTable
from scene2hap.scene.snapshot import SceneSnapshot
from scene2hap.scene.tree import AuthoredNode, Piece

_WORLD = 0
_LAST_SHOWN_GROUP = 2
_IN_GAP = 1
_PLANE, _MESH = 0, 7


class ContactPoints(NamedTuple):
    """Contact points of one or more steps: numbers of the geoms (n, 2), points (n, 3) in the model's unit, and normals
    (n, 3) from the first geom to the second."""

    geoms: NDArray[np.intp]
    points: NDArray[np.float64]
    normals: NDArray[np.float64]


def snapshot(
    model: Any,
    data: Any,
    *,
    name: str | None = None,
    geom_groups: Collection[int] | None = None,
    contacts: Literal["engine"] | None = None,
    masses: Literal["engine"] | None = None,
    unit_m: float | None = None,
) -> SceneSnapshot:
    """Return the scene of a MuJoCo model, with the poses in `data`.

    Poses are current after `mj_forward`, and one time step old after `mj_step`.

    Parameters:
    model, data : `mujoco.MjModel` and `mujoco.MjData`.
    name : of the scene; None means the model's.
    geom_groups : the numbers of the geom groups that are drawn; None draws geoms by rule 3 of this module.
    contacts : None finds contacts from geometry; "engine" takes `data.contact`. MuJoCo has no contacts between bodies
        that cannot move against each other, such as a kettle welded to its stove.
    masses : None leaves them to inference; "engine" takes `model.body_mass`. Use "engine" only if the model's author
        gave masses: MuJoCo computes missing masses as if all bodies were solid water.
    unit_m : metres per unit of the model; None means metres.
    Raises: MissingExtra: MuJoCo is not installed. SceneError: nothing is drawn, or a number is invalid.
    Warns: UnitWarning: without unit_m, if sizes are implausible as metres.
    """
    _require(model, data)
    metres = metres_per_unit(unit_m)
    if contacts not in (None, "engine"):
        raise SceneError(f"contacts is {contacts!r}; it must be 'engine', or None to find them from geometry.")
    if masses not in (None, "engine"):
        raise SceneError(f"masses is {masses!r}; it must be 'engine', or None to have them inferred.")
    items = _layout(model, geom_groups, read_again=True)
    limits.at_most("the number of objects", len(items.all), "MAX_OBJECTS")
    placed = _poses(model, data, items, metres)
    reader, maker = GeomReader(model), ObjectMaker("z", metres)
    objects = []
    for item in items.all:
        group = _group(model, item, tuple(map(reader.piece, item.geoms)))
        label = group.name
        if says_nothing(label):
            label = _name_of_geoms(model, item) or label or item.id
        mass_kg = float(model.body_mass[item.body]) if masses is not None else 0.0
        objects.append(maker.make(item.id, replace(group, name=label, mass_kg=mass_kg or None), placed[item.id]))
    if not objects:
        why = "the model has no geoms" if geom_groups is None else f"no geom is in geom_groups {set(geom_groups)}"
        raise SceneError(f"{why}; nothing in it can be touched.")
    of_body = {item.body: made for item, made in zip(items.all, objects, strict=True) if item.body != _WORLD}
    held = hinges(model, data, of_body, metres)
    objects = [replace(made, hinge=held.get(made.id)) for made in objects]
    touching = None if contacts is None else _contacts(model, contact_points(data), items, metres)
    title = name or model.names[: model.names.index(b"\0")].decode("utf-8", "replace") or "mujoco"
    scene = SceneSnapshot(title, "z", with_relative_heights(objects, "z"), touching)
    if unit_m is None:
        warn_if_implausible(scene, source="engine")
    return scene


def poses(model: Any, data: Any, *, geom_groups: Collection[int] | None = None, unit_m: float = 1.0) -> PoseTable:
    """Return the current pose of every object of the last `snapshot` with the same arguments."""
    unit_m = metres_per_unit(unit_m)
    _require(model, data)
    return _poses(model, data, _layout(model, geom_groups), unit_m)


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
    _require(model, data)
    items = _layout(model, geom_groups)
    return _contacts(model, contact_points(data) if points is None else points, items, unit_m)


def geoms_below(model: Any, data: Any, body: str) -> NDArray[np.bool_]:
    """Return a mask of the geoms (n_geoms + 1,) of a body and of the bodies below it, such as a hand's fingers.

    A body without a name is given by its id (rule 4). The last entry, for "no geom", is False.
    Raises: UnknownObject: the model has no such body. SceneError: none of the geoms can collide.
    """
    _require(model, data)
    named = {name: k + 1 for k, name in enumerate(_ids(model)[: model.nbody - 1])}
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


def _can_collide(model: Any) -> NDArray[np.bool_]:
    """Return a mask of the geoms (n_geoms,) that collide with any others."""
    collides: NDArray[np.bool_] = (model.geom_contype != 0) | (model.geom_conaffinity != 0)
    collides[_paired(model)] = True
    return collides


def _paired(model: Any) -> NDArray[np.intp]:
    """Return the geoms that a `<pair>` names."""
    return np.concatenate((model.pair_geom1, model.pair_geom2)).astype(np.intp)


def touched(
    model: Any,
    data: Any,
    part: NDArray[np.bool_],
    *,
    points: ContactPoints | None = None,
    geom_groups: Collection[int] | None = None,
    unit_m: float = 1.0,
) -> list[tuple[str, tuple[float, float, float]]]:
    """Return the objects that the geoms of a part, from `geoms_below`, touch, with the contact points [m].

    There is one entry for each contact point with a geom outside the part.
    Parameters: points : those of several steps; None takes the current ones.
    """
    _require(model, data)
    items = _layout(model, geom_groups)
    geoms, places, _ = contact_points(data) if points is None else points
    is_own = part[geoms]
    kept = np.flatnonzero(is_own[:, 0] != is_own[:, 1])
    others = geoms[kept, is_own[kept, 0].astype(np.intp)]
    rows = items.row_of_geom(model)[others].tolist()
    places_m = (places[kept] * unit_m).tolist()
    return [(items.ids[row], (x, y, z)) for row, (x, y, z) in zip(rows, places_m, strict=True) if row >= 0]


def out_of_reach(model: Any, part: NDArray[np.bool_], geom_groups: Collection[int] | None = None) -> list[str]:
    """Return the ids of the objects whose contacts with a part, from `geoms_below`, MuJoCo leaves out: neither can move
    by itself, as a table that is part of the world and a mocap body. Empty if the model has `<pair>`s of the part."""
    can_move = model.body_dofnum[model.body_weldid[model.geom_bodyid]] > 0
    if can_move[part[:-1]].any() or part[_paired(model)].any():
        return []
    items = _layout(model, geom_groups)
    rows = items.row_of_geom(model)[:-1]
    fixed = rows[~can_move & ~part[:-1] & _can_collide(model) & (rows >= 0)]
    return [items.ids[row] for row in np.unique(fixed).tolist()]


def load_mjcf(
    path: str | os.PathLike[str], *, assets_root: str | os.PathLike[str] | None = None, unit_m: float = 1.0
) -> SceneSnapshot:
    """Return the scene in an MJCF file in its initial pose, named after the file; see `open_mjcf`."""
    model, data = open_mjcf(path, assets_root=assets_root)
    return snapshot(model, data, name=Path(path).stem, unit_m=unit_m)


def open_mjcf(path: str | os.PathLike[str], *, assets_root: str | os.PathLike[str] | None = None) -> tuple[Any, Any]:
    """Return `MjModel` and `MjData` of an MJCF file, for the caller to step. Only the poses of bodies are computed.

    Parameters: assets_root : the folder that must contain all included files, meshes and textures; None means the
        file's own folder. Nothing outside it is opened.
    Raises: MissingExtra: MuJoCo is not installed. SceneFormatError: the file is not MJCF, or MuJoCo refuses it.
    SceneError: it is missing, too large, or wants a file outside assets_root (the message names the root it needs).
    """
    mujoco = engine("mujoco")
    path = Path(path)
    check_files(path, path.parent if assets_root is None else Path(assets_root))
    try:
        with _silence(mujoco):
            model = mujoco.MjModel.from_xml_path(str(path.resolve()))
            data = mujoco.MjData(model)
            # Kinematics give all poses. Contacts of a model that never moved are useless, and may take minutes to find.
            mujoco.mj_kinematics(model, data)
    except (ValueError, RuntimeError, MemoryError, mujoco.FatalError, mujoco.UnexpectedError) as cause:
        reason = " ".join(str(cause).split()).removeprefix("Error: ")
        raise SceneFormatError(f"MuJoCo cannot read {path.name!r}: {reason}.") from cause
    return model, data


def _require(model: Any, data: Any) -> None:
    """Check that a model and its data are given. Raises: MissingExtra, SceneError: they are something else."""
    mujoco = engine("mujoco")
    if not isinstance(model, mujoco.MjModel) or not isinstance(data, mujoco.MjData):
        raise SceneError(
            f"model is a {type(model).__name__} and data a {type(data).__name__}; they must be mujoco.MjModel and "
            "mujoco.MjData. Wrappers keep them inside (dm_control: physics.model.ptr, physics.data.ptr; gymnasium: "
            "env.unwrapped.model, env.unwrapped.data; an MjSpec: spec.compile(); MJX: mjx.get_data(model, data))."
        )
    has, needs = (len(data.xpos), len(data.geom_xpos), len(data.qpos)), (model.nbody, model.ngeom, model.nq)
    if has != needs:
        raise SceneError(
            f"data is of another model: it has {has} bodies, geoms and coordinates, and model has {needs}. Make it by "
            "mujoco.MjData(model)."
        )
    own = getattr(data, "model", model)
    # A copy of the model is accepted too.
    if own is not model and own.names != model.names:
        raise SceneError("data is of another model, whose names differ. Make it by mujoco.MjData(model).")


# -- bodies and geoms that are objects -------------------------------------------------------------------------------


@dataclass(frozen=True)
class _Item:
    """A future object: the drawn geoms of a body, or one geom of the world body."""

    id: str
    body: int
    geoms: tuple[int, ...]


class _Items:
    """All future objects, and the rows of their poses."""

    def __init__(self, items: Sequence[_Item]) -> None:
        self.all = tuple(items)
        self.ids = tuple(item.id for item in items)
        self.bodies = np.array([item.body for item in items], dtype=np.intp)
        self.of_world = np.flatnonzero(self.bodies == _WORLD)
        self.geoms_of_world = np.array([self.all[row].geoms[0] for row in self.of_world.tolist()], dtype=np.intp)
        self._row_of_geom: NDArray[np.intp] | None = None

    def row_of_geom(self, model: Any) -> NDArray[np.intp]:
        """Return the row of each geom's object (n + 1,), -1 for none. The last entry is -1."""
        if self._row_of_geom is None:
            of_body = {item.body: row for row, item in enumerate(self.all) if item.body != _WORLD}
            of_geom = {item.geoms[0]: row for row, item in enumerate(self.all) if item.body == _WORLD}
            rows = [of_body.get(int(body), of_geom.get(geom, -1)) for geom, body in enumerate(model.geom_bodyid)]
            self._row_of_geom = np.array([*rows, -1], dtype=np.intp)
        return self._row_of_geom


_layouts: WeakKeyDictionary[Any, dict[frozenset[int] | None, _Items]] = WeakKeyDictionary()


def _layout(model: Any, geom_groups: Collection[int] | None, *, read_again: bool = False) -> _Items:
    """Return the items of a model. A snapshot reads them again; later frames use the items of that snapshot."""
    if geom_groups is not None and (isinstance(geom_groups, str) or not isinstance(geom_groups, Collection)):
        raise SceneError(f"geom_groups is {geom_groups!r}; it must be a set of group numbers, such as {{1}}.")
    known = _layouts.setdefault(model, {})
    groups = None if geom_groups is None else frozenset(geom_groups)
    if read_again or groups not in known:
        known[groups] = _Items(_items(model, groups))
    return known[groups]


def _items(model: Any, geom_groups: frozenset[int] | None) -> list[_Item]:
    """Return the bodies in order, then the world's geoms. Ids do not depend on which geoms are drawn."""
    ids = _ids(model)
    drawn: list[list[int]] = [[] for _ in range(model.nbody)]
    for geom in np.flatnonzero(_drawn(model, geom_groups)).tolist():
        drawn[int(model.geom_bodyid[geom])].append(geom)
    bodies = [_Item(ids[body - 1], body, tuple(drawn[body])) for body in range(1, model.nbody) if drawn[body]]
    return [*bodies, *(_Item(ids[model.nbody - 1 + geom], _WORLD, (geom,)) for geom in drawn[_WORLD])]


def _ids(model: Any) -> list[str]:
    """Return the ids of all bodies but the world, then of the world's geoms, by rule 4."""
    ids, n_children = ["world"], [0] * model.nbody
    for body in range(1, model.nbody):
        parent = int(model.body_parentid[body])
        n_children[parent] += 1
        ids.append(model.body(body).name or f"{ids[parent]}/body{n_children[parent]}")
    # In MuJoCo the geoms of the world have the first numbers.
    on_world = range(int(model.body_geomnum[_WORLD]))
    ids += [model.geom(geom).name or f"world/geom{geom + 1}" for geom in on_world]
    return unique_ids(ids[1:])


def _drawn(model: Any, geom_groups: frozenset[int] | None) -> NDArray[np.bool_]:
    """Return a mask of the geoms (n_geoms,) that are drawn by rule 3."""
    drawn: NDArray[np.bool_]
    if geom_groups is not None:
        drawn = np.isin(model.geom_group, list(geom_groups))
        return drawn
    collides = (model.geom_contype != 0) | (model.geom_conaffinity != 0)
    can_collide = np.zeros(model.nbody, dtype=bool)
    can_collide[model.geom_bodyid[collides]] = True
    is_marker = (model.body_mocapid >= 0) & ~can_collide
    is_look = ~collides & (colours_rgba(model)[:, 3] > 0)
    has_looks = np.zeros(model.nbody, dtype=bool)
    has_looks[model.geom_bodyid[is_look]] = True
    is_solid_wall = collides & (model.geom_group <= _LAST_SHOWN_GROUP)
    drawn = is_look | np.where(model.geom_bodyid == _WORLD, is_solid_wall, ~has_looks[model.geom_bodyid])
    drawn &= ~is_marker[model.geom_bodyid]
    return drawn


def _group(model: Any, item: _Item, pieces: tuple[Piece, ...]) -> Group:
    """Return the item's pieces, named by rule 4, in the frame of the body."""
    origin = np.eye(4)
    if item.body == _WORLD:
        return Group(model.geom(item.geoms[0]).name, origin, tuple((origin, piece) for piece in pieces))
    body, node = item.body, AuthoredNode(model.body(item.body).name, origin, pieces)
    while (
        model.body_jntnum[body] == 0
        and (parent := int(model.body_parentid[body])) != _WORLD
        and model.body_geomnum[parent] == 0
        and np.count_nonzero(model.body_parentid[1:] == parent) == 1
    ):
        body, node = parent, AuthoredNode(model.body(parent).name, origin, children=(node,))
    return group_objects([node])[0]


def _name_of_geoms(model: Any, item: _Item) -> str:
    """Return the words that the names of all geoms, or else of all meshes, begin with; "" if they say nothing.

    Names without common words are of parts (a handle and a head), not of the object.
    """
    first = item.geoms[0]
    if item.body == _WORLD and model.geom_type[first] == _PLANE and _is_upright(model.geom_quat[first]):
        return "floor"
    meshes = [model.mesh(model.geom_dataid[geom]) for geom in item.geoms if model.geom_type[geom] == _MESH]
    for rows in (map(model.geom, item.geoms), meshes):
        names = [row.name for row in rows if row.name]
        words = set(map(name_words, names))
        shared = takewhile(lambda column: len(set(column)) == 1, zip(*words, strict=False))
        common = names[0] if len(words) == 1 else " ".join(column[0] for column in shared)
        if not says_nothing(common):
            return str(common)
    return ""


def _is_upright(rotation_wxyz: NDArray[np.float64]) -> bool:
    """Return True if a rotation leaves the z axis upwards, within 45 degrees."""
    _, x, y, _ = rotation_wxyz
    return float(1.0 - 2.0 * (x * x + y * y)) > math.sqrt(0.5)


# -- poses and contacts ----------------------------------------------------------------------------------------------


def _poses(model: Any, data: Any, items: _Items, unit_m: float) -> PoseTable:
    if model.nbody > 1 and not data.xquat[1:].any():
        raise SceneError("data holds no poses yet; call mujoco.mj_forward(model, data) first.")
    positions, rotations = data.xpos[items.bodies], data.xquat[items.bodies][:, [1, 2, 3, 0]]
    of_world, geoms = items.of_world, items.geoms_of_world
    positions[of_world], rotations[of_world] = model.geom_pos[geoms], model.geom_quat[geoms][:, [1, 2, 3, 0]]
    for k in np.flatnonzero(model.geom_dataid[geoms] >= 0).tolist():  # meshes and height fields
        still = authored_pose(model, int(geoms[k]))
        positions[of_world[k]], rotations[of_world[k]] = still.position_m, still.rotation_xyzw
    return PoseTable(items.ids, positions * unit_m, rotations)


def _contacts(model: Any, points: ContactPoints, items: _Items, unit_m: float) -> tuple[Contact, ...]:
    """Return the engine's contacts between objects, without those with geoms that are not drawn."""
    # A deformable body has no geom. Its contacts have geom -1, which indexes the last entry.
    rows = items.row_of_geom(model)[points.geoms]
    kept = np.flatnonzero((rows >= 0).all(axis=1) & (rows[:, 0] != rows[:, 1]))
    places, normals = points.points[kept] * unit_m, points.normals[kept]
    return tuple(
        Contact(items.ids[a], items.ids[b], (x, y, z), (nx, ny, nz))
        for (a, b), (x, y, z), (nx, ny, nz) in zip(rows[kept].tolist(), places.tolist(), normals.tolist(), strict=True)
    )


@contextmanager
def _silence(mujoco: Any) -> Iterator[None]:
    """Keep MuJoCo's warnings off the terminal and out of MUJOCO_LOG.TXT, where they go if there is no handler."""
    before = mujoco.get_mju_user_warning()
    mujoco.set_mju_user_warning(lambda text: None)
    try:
        yield
    finally:
        mujoco.set_mju_user_warning(before)
