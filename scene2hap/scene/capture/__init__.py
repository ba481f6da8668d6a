"""Pictures of a scene, for multimodal models and for people.

    scene = capture_images(load_scene("kitchen.glb"))
    scene.images[0]                                   # PNG: the scene from above
    scene.object("kettle").images.context[0]          # PNG: the kettle in its surroundings, outlined in pink
    render_all(scene, workers=2)                      # all of them now, on two cores

Source: Scene2Hap, sections "Automatic Data Extraction" and "Collecting Multimodal Information".
Differs: objects that hide the target are removed by the rules of `scene2hap.scene.capture.culling`, which keep an
object's support and neighbours; the outline encloses exactly the visible pixels.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from dataclasses import replace
from typing import Any, cast

import numpy as np

from scene2hap.common import checks
from scene2hap.common.calls import clear_call
from scene2hap.errors import ConfigError
from scene2hap.plugins import PluginGroup
from scene2hap.scene.arguments import given_scene
from scene2hap.scene.capture.batch import render_all
from scene2hap.scene.capture.config import CaptureConfig
from scene2hap.scene.capture.lazy_pictures import CaptureStats, LazyPictures
from scene2hap.scene.capture.picture_sheets import contact_sheet, plan_view
from scene2hap.scene.capture.protocol import Renderer, RendererFactory, Selection
from scene2hap.scene.capture.render_scene import RenderScene
from scene2hap.scene.capture.views import Camera
from scene2hap.scene.images import ImageSet, ObjectImages
from scene2hap.scene.objects import VERTICAL, SceneObject, UpAxis
from scene2hap.scene.pose import Pose
from scene2hap.scene.snapshot import SceneSnapshot

__all__ = [
    "RENDERERS",
    "Camera",
    "CaptureConfig",
    "CaptureStats",
    "RenderScene",
    "Renderer",
    "RendererFactory",
    "Selection",
    "capture_images",
    "contact_sheet",
    "plan_view",
    "render_all",
]

RENDERERS = PluginGroup(
    "scene2hap.renderers",
    builtins={
        "embree": "scene2hap.scene.capture.embree:EmbreeRenderer",
        "panda3d": "scene2hap.scene.capture.panda3d_renderer:Panda3DRenderer",
    },
    extras={"embree": "pictures", "panda3d": "panda3d"},
)
"""Registered renderers: classes or functions that are called with a `RenderScene` and a flag for smooth edges."""

_SUBJECT = "object"
"""The id of the object in a scene of its own."""

_DIGITS = 6
"""Decimals of rotations. Rotations of one mesh in two scenes may differ in the last digits, so they are rounded."""


@clear_call
def capture_images(
    scene: SceneSnapshot | str | os.PathLike[str],
    object_ids: Iterable[str] | None = None,
    *,
    size_px: int | None = None,
    renderer: str | RendererFactory | None = None,
    config: CaptureConfig | Mapping[str, Any] | None = None,
    alone: bool = False,
) -> SceneSnapshot:
    """Return the scene with pictures for a multimodal model. Each picture is rendered at its first access.

    Parameters:
    object_ids : the objects that get images, None for all. The scene itself always gets images.
    size_px, renderer : replace the values of `config`, by default 512 pixels and "embree". A renderer is a kind of
        `RENDERERS`, or a factory of your own. Workers need a factory that can be pickled.
    alone : render each object upright at the origin, and no images of its surroundings. Equal objects of several
        scenes then have equal images, so that `share_scenes` needs only one inference for all.

    Returns: a scene with `images`, 4 of the scene from above, and objects with `images.isolated` and `images.context`,
        8 each, of which the first 4 are from above. Pictures are cached by content, in memory and in
        `config.cache_dir`, so a second capture of a scene renders nothing that is cached.
    Raises: UnknownObject; ConfigError: a setting out of bounds; UnknownPlugin: no such renderer; MissingExtra: its
    package is not installed.
    """
    scene = given_scene(scene)
    kind = renderer if isinstance(renderer, str) else None
    settings = CaptureConfig.parse(config, size_px=size_px, renderer=kind)
    if renderer is None or isinstance(renderer, str):
        factory, name = _loaded(settings.renderer), settings.renderer
    else:
        factory, name = renderer, _name_of(renderer)
    if isinstance(object_ids, str):
        raise ConfigError(f"object_ids is the text {object_ids!r}; give a list of ids, [{object_ids!r}].")
    given = None if object_ids is None else checks.items("object_ids", object_ids, error=ConfigError)
    wanted = {item.id for item in scene.objects} if given is None else {scene.object(key).id for key in given}
    pictures = LazyPictures(scene, settings, factory, name)

    def images(item: SceneObject) -> ObjectImages:
        if not alone:
            shots = settings.object_shots
            return ObjectImages(
                ImageSet(pictures, shots("isolated", item.id)), ImageSet(pictures, shots("context", item.id))
            )
        own = LazyPictures(_by_itself(item, scene.up_axis), settings, factory, name)
        return ObjectImages(ImageSet(own, settings.object_shots("isolated", _SUBJECT)), ImageSet(own, ()))

    objects = tuple(replace(item, images=images(item)) if item.id in wanted else item for item in scene.objects)
    return replace(scene, objects=objects, images=ImageSet(pictures, settings.scene_shots()))


def _loaded(kind: str) -> RendererFactory:
    factory = RENDERERS.load(kind)
    if not callable(factory):
        raise ConfigError(f"{RENDERERS.name} kind {kind!r} is {factory!r}; it must be a class or a function.")
    return cast("RendererFactory", factory)


def _name_of(factory: RendererFactory) -> str:
    if not callable(factory):
        raise ConfigError(f"renderer is {factory!r}; it must be a kind ({', '.join(RENDERERS.kinds())}) or a factory.")
    return f"{getattr(factory, '__module__', '')}.{getattr(factory, '__qualname__', repr(factory))}"


def _by_itself(item: SceneObject, up_axis: UpAxis) -> SceneSnapshot:
    """Return a scene of one object, upright at the origin, so that equal objects of all scenes give equal pictures.

    Only its rotation about the vertical is undone.
    """
    # The grey of an object without looks depends on these two fields.
    unnamed = replace(item, id=_SUBJECT, instance_key=item.instance_key if item.appearance else "")
    return SceneSnapshot("object", up_axis, (replace(unnamed, pose=_upright(item.pose, up_axis), images=None),))


def _upright(pose: Pose, up_axis: UpAxis) -> Pose:
    """Return the smallest rotation that leaves the same side of the object up."""
    vertical = VERTICAL[up_axis]
    up = np.eye(3)[vertical]
    side = pose.rotation.T @ up
    # Quaternion from `side` to `up`, not normalised. For opposite vectors, any perpendicular axis is right.
    quaternion = np.array([*np.cross(side, up), 1.0 + side @ up])
    if quaternion[3] < 10.0**-_DIGITS:
        quaternion = np.array([1.0, 0.0, 0.0, 0.0])
    x, y, z, w = (np.round(quaternion / np.linalg.norm(quaternion), _DIGITS) + 0.0).tolist()
    return Pose((0.0, 0.0, 0.0), (x, y, z, w))
