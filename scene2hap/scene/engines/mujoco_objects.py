"""The objects of a MuJoCo model: which bodies and geoms are objects, which geoms are drawn, and their ids and names.

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
5. A body that turns on another has a hinge (`scene.joints`).
"""

from __future__ import annotations

import math
from collections.abc import Collection, Sequence
from dataclasses import dataclass
from itertools import takewhile
from typing import Any
from weakref import WeakKeyDictionary

import numpy as np

from scene2hap.common.arrays import Bools, Floats, Indices
from scene2hap.errors import SceneError
from scene2hap.scene.engines import engine
from scene2hap.scene.engines.mujoco_geoms import colours_rgba
from scene2hap.scene.grouping.groups import Group, group_objects, unique_ids
from scene2hap.scene.names import name_words, says_nothing
from scene2hap.scene.tree import AuthoredNode, Piece

WORLD = 0
_LAST_SHOWN_GROUP = 2
_PLANE, _MESH = 0, 7


def require_model(model: Any, data: Any) -> None:
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


@dataclass(frozen=True)
class ModelObject:
    """A future object: the drawn geoms of a body, or one geom of the world body."""

    id: str
    body: int
    geoms: tuple[int, ...]


class ModelObjects:
    """All future objects, and the rows of their poses."""

    def __init__(self, items: Sequence[ModelObject]) -> None:
        self.all: tuple[ModelObject, ...] = tuple(items)
        self.ids: tuple[str, ...] = tuple(item.id for item in items)
        self.bodies: Indices = np.array([item.body for item in items], dtype=np.intp)
        self.of_world: Indices = np.flatnonzero(self.bodies == WORLD)
        own = [self.all[row].geoms[0] for row in self.of_world.tolist()]
        self.geoms_of_world: Indices = np.array(own, dtype=np.intp)
        self._row_of_geom: Indices | None = None

    def row_of_geom(self, model: Any) -> Indices:
        """Return the row of each geom's object (n + 1,), -1 for none. The last entry is -1."""
        if self._row_of_geom is None:
            of_body = {item.body: row for row, item in enumerate(self.all) if item.body != WORLD}
            of_geom = {item.geoms[0]: row for row, item in enumerate(self.all) if item.body == WORLD}
            rows = [of_body.get(int(body), of_geom.get(geom, -1)) for geom, body in enumerate(model.geom_bodyid)]
            self._row_of_geom = np.array([*rows, -1], dtype=np.intp)
        return self._row_of_geom


_of_models: WeakKeyDictionary[Any, dict[frozenset[int] | None, ModelObjects]] = WeakKeyDictionary()


def objects_of(model: Any, geom_groups: Collection[int] | None, *, read_again: bool = False) -> ModelObjects:
    """Return the items of a model. A snapshot reads them again; later frames use the items of that snapshot."""
    if geom_groups is not None and (isinstance(geom_groups, str) or not isinstance(geom_groups, Collection)):
        raise SceneError(f"geom_groups is {geom_groups!r}; it must be a set of group numbers, such as {{1}}.")
    known = _of_models.setdefault(model, {})
    groups = None if geom_groups is None else frozenset(geom_groups)
    if read_again or groups not in known:
        known[groups] = ModelObjects(_found(model, groups))
    return known[groups]


def _found(model: Any, geom_groups: frozenset[int] | None) -> list[ModelObject]:
    """Return the bodies in order, then the world's geoms. Ids do not depend on which geoms are drawn."""
    ids = ids_of(model)
    drawn: list[list[int]] = [[] for _ in range(model.nbody)]
    for geom in np.flatnonzero(_drawn(model, geom_groups)).tolist():
        drawn[int(model.geom_bodyid[geom])].append(geom)
    bodies = [ModelObject(ids[body - 1], body, tuple(drawn[body])) for body in range(1, model.nbody) if drawn[body]]
    return [*bodies, *(ModelObject(ids[model.nbody - 1 + geom], WORLD, (geom,)) for geom in drawn[WORLD])]


def ids_of(model: Any) -> list[str]:
    """Return the ids of all bodies but the world, then of the world's geoms, by rule 4."""
    ids, n_children = ["world"], [0] * model.nbody
    for body in range(1, model.nbody):
        parent = int(model.body_parentid[body])
        n_children[parent] += 1
        ids.append(model.body(body).name or f"{ids[parent]}/body{n_children[parent]}")
    # In MuJoCo the geoms of the world have the first numbers.
    on_world = range(int(model.body_geomnum[WORLD]))
    ids += [model.geom(geom).name or f"world/geom{geom + 1}" for geom in on_world]
    return unique_ids(ids[1:])


def _drawn(model: Any, geom_groups: frozenset[int] | None) -> Bools:
    """Return a mask of the geoms (n_geoms,) that are drawn by rule 3."""
    drawn: Bools
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
    drawn = is_look | np.where(model.geom_bodyid == WORLD, is_solid_wall, ~has_looks[model.geom_bodyid])
    drawn &= ~is_marker[model.geom_bodyid]
    return drawn


def group_of(model: Any, item: ModelObject, pieces: tuple[Piece, ...]) -> Group:
    """Return the item's pieces, named by rule 4, in the frame of the body."""
    origin = np.eye(4)
    if item.body == WORLD:
        return Group(model.geom(item.geoms[0]).name, origin, tuple((origin, piece) for piece in pieces))
    body, node = item.body, AuthoredNode(model.body(item.body).name, origin, pieces)
    while (
        model.body_jntnum[body] == 0
        and (parent := int(model.body_parentid[body])) != WORLD
        and model.body_geomnum[parent] == 0
        and np.count_nonzero(model.body_parentid[1:] == parent) == 1
    ):
        body, node = parent, AuthoredNode(model.body(parent).name, origin, children=(node,))
    return group_objects([node])[0]


def name_of_geoms(model: Any, item: ModelObject) -> str:
    """Return the words that the names of all geoms, or else of all meshes, begin with; "" if they say nothing.

    Names without common words are of parts (a handle and a head), not of the object.
    """
    first = item.geoms[0]
    if item.body == WORLD and model.geom_type[first] == _PLANE and _is_upright(model.geom_quat[first]):
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


def _is_upright(rotation_wxyz: Floats) -> bool:
    """Return True if a rotation leaves the z axis upwards, within 45 degrees."""
    _, x, y, _ = rotation_wxyz
    return float(1.0 - 2.0 * (x * x + y * y)) > math.sqrt(0.5)
