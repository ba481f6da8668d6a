"""MuJoCo models as snapshots: a running `MjModel` with its `MjData`, or an MJCF file.

`mujoco_objects` decides which bodies and geoms are objects. Poses are the bodies' own (xpos, xquat). Infinite
planes are cut to twice the model's extent. Deformable bodies and skins are left out. Nothing here steps or changes the
simulation.
"""

from __future__ import annotations

import os
from collections.abc import Collection, Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any, Literal

import numpy as np

from scene2hap.errors import SceneError, SceneFormatError
from scene2hap.scene import limits
from scene2hap.scene.engines import engine
from scene2hap.scene.engines.mjcf_files import check_files
from scene2hap.scene.engines.mujoco_contacts import contact_points, contacts_of
from scene2hap.scene.engines.mujoco_geoms import GeomReader, authored_pose
from scene2hap.scene.engines.mujoco_objects import (
    WORLD,
    ModelObjects,
    group_of,
    name_of_geoms,
    objects_of,
    require_model,
)
from scene2hap.scene.grouping.object_maker import ObjectMaker
from scene2hap.scene.joints import Joint, Motion, hinges, pivots
from scene2hap.scene.names import says_nothing
from scene2hap.scene.objects import with_relative_heights
from scene2hap.scene.plausibility.units import metres_per_unit, warn_if_implausible
from scene2hap.scene.pose_table import PoseTable
from scene2hap.scene.snapshot import SceneSnapshot

_BALL, _HINGE = 1, 3  # types of joints


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
    geom_groups : the numbers of the geom groups that are drawn; None draws geoms by rule 3 of
        `mujoco_objects`.
    contacts : None finds contacts from geometry; "engine" takes `data.contact`. MuJoCo has no contacts between bodies
        that cannot move against each other, such as a kettle welded to its stove.
    masses : None leaves them to inference; "engine" takes `model.body_mass`. Use "engine" only if the model's author
        gave masses: MuJoCo computes missing masses as if all bodies were solid water.
    unit_m : metres per unit of the model; None means metres.
    Raises: MissingExtra: MuJoCo is not installed. SceneError: nothing is drawn, or a number is invalid.
    Warns: UnitWarning: without unit_m, if sizes are implausible as metres.
    """
    require_model(model, data)
    metres = metres_per_unit(unit_m)
    if contacts not in (None, "engine"):
        raise SceneError(f"contacts is {contacts!r}; it must be 'engine', or None to find them from geometry.")
    if masses not in (None, "engine"):
        raise SceneError(f"masses is {masses!r}; it must be 'engine', or None to have them inferred.")
    items = objects_of(model, geom_groups, read_again=True)
    limits.at_most("the number of objects", len(items.all), "MAX_OBJECTS")
    placed = _poses(model, data, items, metres)
    reader, maker = GeomReader(model), ObjectMaker("z", metres)
    objects = []
    for item in items.all:
        group = group_of(model, item, tuple(map(reader.piece, item.geoms)))
        label = group.name
        if says_nothing(label):
            label = name_of_geoms(model, item) or label or item.id
        mass_kg = float(model.body_mass[item.body]) if masses is not None else 0.0
        objects.append(maker.make(item.id, replace(group, name=label, mass_kg=mass_kg or None), placed[item.id]))
    if not objects:
        why = "the model has no geoms" if geom_groups is None else f"no geom is in geom_groups {set(geom_groups)}"
        raise SceneError(f"{why}; nothing in it can be touched.")
    of_body = {str(item.body): made for item, made in zip(items.all, objects, strict=True) if item.body != WORLD}
    held = hinges(of_body, pivots(_joints(model, data), of_body), metres)
    objects = [replace(made, hinge=held[made.id]) if made.id in held else made for made in objects]
    touching = None if contacts is None else contacts_of(model, contact_points(data), items, metres)
    title = name or model.names[: model.names.index(b"\0")].decode("utf-8", "replace") or "mujoco"
    scene = SceneSnapshot(title, "z", with_relative_heights(objects, "z"), touching)
    if unit_m is None:
        warn_if_implausible(scene, source="engine")
    return scene


def poses(model: Any, data: Any, *, geom_groups: Collection[int] | None = None, unit_m: float = 1.0) -> PoseTable:
    """Return the current pose of every object of the last `snapshot` with the same arguments."""
    unit_m = metres_per_unit(unit_m)
    require_model(model, data)
    return _poses(model, data, objects_of(model, geom_groups), unit_m)


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


def _poses(model: Any, data: Any, items: ModelObjects, unit_m: float) -> PoseTable:
    if model.nbody > 1 and not data.xquat[1:].any():
        raise SceneError("data holds no poses yet; call mujoco.mj_forward(model, data) first.")
    positions, rotations = data.xpos[items.bodies], data.xquat[items.bodies][:, [1, 2, 3, 0]]
    of_world, geoms = items.of_world, items.geoms_of_world
    positions[of_world], rotations[of_world] = model.geom_pos[geoms], model.geom_quat[geoms][:, [1, 2, 3, 0]]
    for k in np.flatnonzero(model.geom_dataid[geoms] >= 0).tolist():  # meshes and height fields
        still = authored_pose(model, int(geoms[k]))
        positions[of_world[k]], rotations[of_world[k]] = still.position_m, still.rotation_xyzw
    return PoseTable(items.ids, positions * unit_m, rotations)


def _joints(model: Any, data: Any) -> dict[str, Joint]:
    """Return the joint of each body, by the body's number: that of several joints turns if all of them turn.

    Source: MuJoCo documentation (Google DeepMind), XML reference, `joint`; mjData: xanchor, xaxis.
    """
    found = {}
    for body in range(1, model.nbody):
        first, n = int(model.body_jntadr[body]), int(model.body_jntnum[body])
        kinds = model.jnt_type[first : first + n].tolist() if n else []
        motion: Motion = "fixed" if not n else "turns" if {*kinds} <= {_BALL, _HINGE} else "other"
        axis = np.array(data.xaxis[first]) if kinds == [_HINGE] else None
        anchor = np.array(data.xanchor[first]) if n else None
        found[str(body)] = Joint(str(model.body_parentid[body]), motion, anchor, axis)
    return found


@contextmanager
def _silence(mujoco: Any) -> Iterator[None]:
    """Keep MuJoCo's warnings off the terminal and out of MUJOCO_LOG.TXT, where they go if there is no handler."""
    before = mujoco.get_mju_user_warning()
    mujoco.set_mju_user_warning(lambda text: None)
    try:
        yield
    finally:
        mujoco.set_mju_user_warning(before)
