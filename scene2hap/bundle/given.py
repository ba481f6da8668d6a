"""The bundle that a caller gives: a HapticBundle, or the path of its folder."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path

from scene2hap import checks
from scene2hap.bundle.haptic_bundle import HapticBundle
from scene2hap.errors import BundleError, UnknownObject
from scene2hap.scene.given import given_scene
from scene2hap.scene.snapshot import SceneSnapshot
from scene2hap.settings import Settings


def given_bundle(bundle: object) -> HapticBundle:
    """A bundle as it is, one read from the path of its folder by `HapticBundle.load`.

    Raises: BundleError: it is something else, such as a scene that is not baked; and as `HapticBundle.load`.
    """
    if isinstance(bundle, HapticBundle):
        return bundle
    if isinstance(bundle, str | os.PathLike):
        return HapticBundle.load(bundle)
    hint = "`bake(scene)` makes one" if isinstance(bundle, SceneSnapshot) else "`HapticBundle.load(folder)` reads one"
    raise BundleError(
        f"bundle is {checks.described(bundle)}; it must be a HapticBundle or the path of its folder. {hint}."
    )


def given_pair(scene: object, bundle: object) -> tuple[SceneSnapshot, HapticBundle]:
    """A scene and its bundle, each as an object or a path, in either order; a bundle alone brings its own scene.

    Raises: BundleError: none of them is a bundle, or both are; UnknownObject: the bundle is of another scene; and as
    `given_scene` and `given_bundle`.
    """
    for one in (scene, bundle):
        if isinstance(one, Mapping | Settings):
            raise BundleError(
                f"scene or bundle is {checks.described(one)}; a bundle is a HapticBundle or the path of its folder. "
                "Settings go by name: HapticSession(bundle, config=...)."
            )
    given = [one for one in (scene, bundle) if one is not None]
    if len(given) == 1 and (_is_folder(given[0]) or isinstance(given[0], HapticBundle)):
        alone = given_bundle(given[0])
        return alone.snapshot, alone
    if isinstance(scene, HapticBundle) or isinstance(bundle, SceneSnapshot) or _is_folder(scene):
        scene, bundle = bundle, scene
    if bundle is None:
        given_scene(scene)
        raise BundleError(
            f"there is no bundle for {checks.described(scene)}, only a scene. Bake it first: "
            "HapticSession(scene, bake(scene)); a bundle alone is enough, HapticSession(bundle)."
        )
    found, baked = given_scene(scene), given_bundle(bundle)
    _require_same_scene(found, baked)
    return found, baked


def _is_folder(path: object) -> bool:
    """Whether a path is meant as that of a bundle: it is a folder, or is called as one."""
    return isinstance(path, str | os.PathLike) and (Path(path).is_dir() or Path(path).suffix == ".bundle")


def _require_same_scene(scene: SceneSnapshot, bundle: HapticBundle) -> None:
    """Raise an UnknownObject where a bundle has loops for objects that a scene lacks, or shares no object with it."""
    ids = {item.id for item in scene.objects}
    baked = bundle.loops if bundle.loops or ids & bundle.objects.keys() else bundle.objects
    lacking = [object_id for object_id in baked if object_id not in ids]
    if lacking:
        near = checks.did_you_mean(lacking[0], ids)
        raise UnknownObject(
            f"the bundle was baked for another scene: {scene.name!r} has no object {lacking[0]!r} ({len(lacking)} of "
            f"{len(baked)} are missing). {near}{' ' if near else ''}Give the scene that was baked, bundle.snapshot, or "
            "bake this one."
        )
