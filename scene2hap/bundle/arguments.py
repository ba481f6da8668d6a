"""Conversion of a caller's argument into a bundle: a HapticBundle, or the path of its folder."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path

from scene2hap.bundle.haptic_bundle import HapticBundle
from scene2hap.common import checks
from scene2hap.common.settings import Settings
from scene2hap.errors import BundleError
from scene2hap.scene.arguments import given_scene
from scene2hap.scene.snapshot import SceneSnapshot


def given_bundle(bundle: object) -> HapticBundle:
    """Return a bundle unchanged, or load it from the path of its folder.

    Raises: BundleError: another type, such as a scene that is not baked; and as `HapticBundle.load`.
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
    """Return a scene and its bundle, each given as an object or a path, in any order. A bundle alone has its own scene.

    Raises: BundleError: no bundle was given, or two; and as `given_scene` and `given_bundle`.
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
    return given_scene(scene), given_bundle(bundle)


def _is_folder(path: object) -> bool:
    """Return True if a path is meant as a bundle: it is a folder, or has the suffix of a bundle."""
    return isinstance(path, str | os.PathLike) and (os.path.isdir(path) or Path(path).suffix == ".bundle")
