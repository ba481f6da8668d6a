"""Copies of a mesh that a glTF node draws at several places.

Source: EXT_mesh_gpu_instancing. Its attributes TRANSLATION, ROTATION and SCALE are accessors with a row for each copy.
"""

from __future__ import annotations

import numpy as np

from scene2hap.errors import SceneError, SceneFormatError
from scene2hap.scene import limits
from scene2hap.scene.formats.gltf.accessors import vectors
from scene2hap.scene.formats.gltf.container import GltfFile, Json, mapping
from scene2hap.scene.pose import Pose
from scene2hap.scene.tree import Matrix, transform

INSTANCES = "EXT_mesh_gpu_instancing"
_TYPES = {"TRANSLATION": "VEC3", "ROTATION": "VEC4", "SCALE": "VEC3"}
_DEFAULTS = {"TRANSLATION": (0.0, 0.0, 0.0), "ROTATION": (0.0, 0.0, 0.0, 1.0), "SCALE": (1.0, 1.0, 1.0)}


def instances(file: GltfFile, row: Json, place: str) -> list[Matrix] | None:
    """Return the transform of each copy in its node's frame; None if the node draws its mesh once.

    Raises: SceneFormatError: attributes have different lengths, or values that are no transform. SceneError: there are
    too many copies.
    """
    attributes = mapping(mapping(mapping(row.get("extensions")).get(INSTANCES)).get("attributes"))
    read = {
        name: vectors(file, attributes[name], (kind,), f"{place}: its {INSTANCES} {name}")
        for name, kind in _TYPES.items()
        if name in attributes
    }
    if not read:
        return None
    counts = {name: len(values) for name, values in read.items()}
    if len(set(counts.values())) > 1:
        raise SceneFormatError(f"{place}: {INSTANCES} has {counts} values; it must have one of each for each copy.")
    n = next(iter(counts.values()))
    limits.at_most(f"the number of copies of {place}", n, "MAX_NODES")
    moves, turns, scales = (read.get(name, np.tile(_DEFAULTS[name], (n, 1))) for name in _TYPES)
    if not (np.isfinite(moves).all() and np.isfinite(scales).all()):
        raise SceneFormatError(f"{place}: {INSTANCES} has numbers that are not finite.")
    try:
        return [
            transform(Pose(rotation_xyzw=tuple(turn)).rotation * scale, move)
            for turn, scale, move in zip(turns.tolist(), scales, moves, strict=True)
        ]
    except SceneError as cause:
        raise SceneFormatError(f"{place}: {INSTANCES} ROTATION: {cause}") from cause
