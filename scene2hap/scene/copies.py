"""Keys of objects that count as copies of each other."""

from __future__ import annotations

from collections.abc import Hashable, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from scene2hap.scene.names import name_words
from scene2hap.scene.objects import SceneObject
from scene2hap.scene.shapes import TriMesh

_PER_MM = 1000.0


def copy_key(item: SceneObject) -> Hashable:
    """Return a key that is equal for copies, so that one inference serves all of them.

    Copies have equal mesh and looks (`instance_key`), equal words in the name, equal names of materials, and equal size
    to the millimetre. An object without `instance_key` has no copies.
    """
    if not item.instance_key:
        return ("id", item.id)
    size_mm = tuple(round(edge_m * _PER_MM) for edge_m in item.size_m)
    return (item.instance_key, name_words(item.name), material_names(item), size_mm)


def as_copy(item: SceneObject) -> SceneObject:
    """Return an object of unknown looks as a copy of all objects of equal mesh."""
    return replace(item, instance_key=item.geometry.mesh.digest)


def material_names(item: SceneObject) -> tuple[str, ...]:
    """Return the authored names of an object's materials, each once: its own, or else those of its looks."""
    looks = item.appearance
    if looks is None or item.material_names:
        return item.material_names
    return names_by_area(item.geometry.mesh, looks.face_material, [material.name for material in looks.materials])


def names_by_area(mesh: TriMesh, face_rows: NDArray[np.integer], names: Sequence[str]) -> tuple[str, ...]:
    """Return the names of a mesh's materials, each once, that of the largest area first; "" is no name.

    `face_rows` : (m,) the row in `names` of each face. Faces are not counted: a round handle has more of them than the
    cabinet that it is on.
    """
    known = {name: row for row, name in enumerate(dict.fromkeys(names))}
    if not any(known):
        return ()
    corners_m = mesh.vertices_m[mesh.faces]
    sides_m = corners_m[:, 1:] - corners_m[:, :1]
    rows = np.array([known[name] for name in names])[face_rows]
    areas_m2 = np.bincount(rows, np.linalg.norm(np.cross(sides_m[:, 0], sides_m[:, 1]), axis=1) / 2)
    used, named = frozenset(rows.tolist()), list(known)
    return tuple(named[row] for row in np.argsort(-areas_m2, kind="stable").tolist() if row in used and named[row])
