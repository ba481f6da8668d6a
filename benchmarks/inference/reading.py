"""Labelled scenes as snapshots: scene files, folders of single models, and boxes for names without a file."""

from __future__ import annotations

import warnings
from dataclasses import replace
from pathlib import Path

from inference.labels import LabelledScene
from scene2hap import Box, DominantSurface, Pose, SceneObject, SceneSnapshot, load_scene

MODELS = (".glb", ".gltf")


def read(item: LabelledScene, folder: Path) -> SceneSnapshot:
    """Read a labelled scene as it is in the file: wrong units are part of the task.

    Raises: ValueError: the objects of the scene differ from the labelled ones.
    """
    if not item.path:
        return _boxes(item)
    path = folder / item.path
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        root = folder / item.assets_root if item.assets_root else None
        scene = _library(path) if path.is_dir() else load_scene(path, assets_root=root)
    apart = {thing.id for thing in scene.objects} ^ set(item.labels)
    if apart:
        raise ValueError(f"{item.scene}: not labelled, or labelled and not there: {', '.join(sorted(apart)[:5])}.")
    # The name of the file is often "scene"; a user would see the name of the folder.
    return replace(scene, name=item.scene)


def _library(folder: Path) -> SceneSnapshot:
    """All models of a folder as one scene in which nothing touches anything."""
    files = sorted(path for path in folder.iterdir() if path.suffix in MODELS)
    objects = tuple(thing for path in files for thing in load_scene(path).objects)
    return SceneSnapshot(folder.name, "y", objects, contacts=())


def _boxes(item: LabelledScene) -> SceneSnapshot:
    """One box per name, with the listed longest edge; nothing touches anything."""
    objects = []
    for position, (name, edge) in enumerate(item.longest_m.items()):
        size = (edge, edge / 2, edge / 4)
        surface = DominantSurface(Pose((-size[0] / 2, -size[1] / 2, 0.0)), *size)
        objects.append(SceneObject(name, name, Pose((0.0, 0.0, 100.0 * position)), Box(size), surface))
    return SceneSnapshot(item.scene, "y", tuple(objects), contacts=())
