"""The joints of a USD stage as pivots between its rigid bodies, given by their paths.

Read are revolute, spherical and fixed joints that are enabled, and general ones of which limits lock all translations,
such as the hips of a humanoid. Their frame is that of `localPos0` and `localRot0` in the prim of `body0`. Several
joints of one pair make a ball, as in MuJoCo.

`body1` is held on `body0`, as exporters write the tree of a robot from its base; if it is on another body already,
`body0` is held on it. A target that is no rigid body counts as the nearest one above it, and as the world, which does
not move, if there is none. A body that no joint fixes to the world moves, also along a slide.

Source: OpenUSD 26.11, UsdPhysics: Joint, RevoluteJoint, SphericalJoint, FixedJoint, LimitAPI.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Mapping
from typing import Any

import numpy as np
from pxr import Gf, UsdPhysics

from scene2hap.errors import SceneFormatError
from scene2hap.scene.formats.usd.values import value
from scene2hap.scene.joints import Joint, Motion, pivots
from scene2hap.scene.tree import AuthoredPivot, Matrix

_WORLD = ""
_AXES = {"X": (1.0, 0.0, 0.0), "Y": (0.0, 1.0, 0.0), "Z": (0.0, 0.0, 1.0)}


def pivots_of(
    prims: Iterable[Any], bodies: Mapping[str, bool], world_of: Callable[[Any], Matrix]
) -> tuple[AuthoredPivot, ...]:
    """Return the pivots that the joints among prims make between bodies with geometry.

    Parameters: bodies : whether a rigid body has geometry, by its path; world_of : returns a prim's transform in the
    world.
    """
    read = [UsdPhysics.Joint(prim) for prim in prims if _motion(prim) != "other"]
    enabled = [joint for joint in read if value(joint.GetJointEnabledAttr()) is not False]
    between = [(_body(_target(joint, 1), bodies), _body(_target(joint, 0), bodies), joint) for joint in enabled]
    # What is fixed to the world counts first, and what closes a loop last.
    between.sort(key=lambda each: (_WORLD not in each[:2], bool(value(each[2].GetExcludeFromArticulationAttr()))))
    n_of_pair = Counter(frozenset(each[:2]) for each in between)
    found: dict[str, Joint] = {}
    for item, on, joint in between:
        for held, holder in ((item, on), (on, item)):
            if held != _WORLD and held not in found and not _is_on(holder, held, found):
                made = _joint(joint, holder, world_of)
                found[held] = made if n_of_pair[frozenset((item, on))] == 1 else made._replace(axis=None)
                break
    free = {body: Joint(_WORLD, "other") for body in bodies if body not in found}
    return tuple(pivots({**found, **free}, {body for body, is_drawn in bodies.items() if is_drawn}))


def _joint(joint: Any, on: str, world_of: Callable[[Any], Matrix]) -> Joint:
    """Return a joint that holds a body on another."""
    prim = joint.GetPrim()
    motion = _motion(prim)
    if motion == "fixed" or on == _WORLD:
        return Joint(on, motion)
    world = world_of(prim.GetStage().GetPrimAtPath(_target(joint, 0)))
    anchor = (world @ [*(value(joint.GetLocalPos0Attr()) or (0.0, 0.0, 0.0)), 1.0])[:3]
    if not np.isfinite(anchor).all():
        raise SceneFormatError(f"prim {prim.GetPath()} is at {anchor.tolist()}; every coordinate must be finite.")
    if not prim.IsA(UsdPhysics.RevoluteJoint):
        return Joint(on, motion, anchor)
    named = str(value(UsdPhysics.RevoluteJoint(prim).GetAxisAttr()))
    if named not in _AXES:
        raise SceneFormatError(f"prim {prim.GetPath()} turns about the axis {named!r}; it must be X, Y or Z.")
    rotation = Gf.Rotation(Gf.Quatd(value(joint.GetLocalRot0Attr()) or Gf.Quatf(1.0)))
    axis = world[:3, :3] @ rotation.TransformDir(Gf.Vec3d(_AXES[named]))
    length = np.linalg.norm(axis)  # 0 in a body that is scaled to a sheet
    return Joint(on, motion, anchor, axis / length if length > 0 else None)


def _motion(prim: Any) -> Motion:
    """Return how a joint lets a body move; "other" also for prims that are no joints."""
    if prim.IsA(UsdPhysics.FixedJoint):
        return "fixed"
    if prim.IsA(UsdPhysics.RevoluteJoint) or prim.IsA(UsdPhysics.SphericalJoint):
        return "turns"
    if prim.GetTypeName() != "PhysicsJoint" or not _locks(prim, "trans"):
        return "other"
    return "fixed" if _locks(prim, "rot") else "turns"


def _locks(prim: Any, kind: str) -> bool:
    """Return True if a general joint locks all translations ("trans") or rotations ("rot"): low is above high."""
    limits = [UsdPhysics.LimitAPI(prim, f"{kind}{axis}") for axis in _AXES]
    ranges = [(value(limit.GetLowAttr()), value(limit.GetHighAttr())) for limit in limits]
    return all(low is not None and high is not None and low > high for low, high in ranges)


def _target(joint: Any, which: int) -> str:
    """Return the path of the prim of `body0` or `body1`, "" if there is none."""
    paths = (joint.GetBody1Rel() if which else joint.GetBody0Rel()).GetForwardedTargets()
    return str(paths[0].GetPrimPath()) if paths and joint.GetPrim().GetStage().GetPrimAtPath(paths[0]) else ""


def _body(path: str, bodies: Mapping[str, bool]) -> str:
    """Return the path of the rigid body at or above a path, that of the world if there is none."""
    while path and path not in bodies:
        path = path.rpartition("/")[0]
    return path


def _is_on(body: str, other: str, joints: Mapping[str, Joint]) -> bool:
    """Return True if a body is another, or is on it, directly or by others."""
    while body != other and body in joints:
        body = joints[body].on
    return body == other
