"""The scene argument of a caller: a snapshot, or the path of a scene file."""

from __future__ import annotations

import os

from scene2hap.common import checks
from scene2hap.errors import SceneError
from scene2hap.scene.files import written_first
from scene2hap.scene.objects import SceneObject
from scene2hap.scene.snapshot import SceneSnapshot


def given_scene(scene: object) -> SceneSnapshot:
    """Return a snapshot unchanged, or read it from a path with `load_scene`.

    Raises: SceneError: it is something else, such as a bundle or a list of objects; and as `load_scene`.
    """
    if isinstance(scene, SceneSnapshot):
        return scene
    if isinstance(scene, str | os.PathLike):
        from scene2hap.scene.load import load_scene

        return load_scene(scene)
    wanted = f"scene is {checks.described(scene)}; it must be a SceneSnapshot or the path of a scene file."
    if isinstance(getattr(scene, "snapshot", None), SceneSnapshot):
        raise SceneError(
            f"{wanted} The scene of a bundle or a session is its .snapshot; `rebake` bakes a bundle again."
        )
    if isinstance(scene, list | tuple):
        raise SceneError(f"{wanted} `SceneSnapshot.build(objects)` makes one of objects.")
    if isinstance(scene, SceneObject):
        raise SceneError(f"{wanted} `SceneSnapshot.build([object])` makes one of an object.")
    raise SceneError(f"{wanted} {written_first(scene) or '`load_scene(path)` reads one.'}")
