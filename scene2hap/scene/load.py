"""Read scene files as snapshots: glTF, USD, OBJ, COLLADA, STL, PLY, URDF, MJCF, Habitat, scene2hap's own JSON."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Concatenate, ParamSpec, TypeVar

import numpy as np

from scene2hap.common import checks
from scene2hap.common.calls import clear_call
from scene2hap.common.counted import counted
from scene2hap.common.printable import writable
from scene2hap.common.warning import warn_of
from scene2hap.errors import SceneError, SceneFormatError, reason_of
from scene2hap.scene import limits
from scene2hap.scene.files import HABITAT_SUFFIX, decoded, is_habitat, read_bytes, scene_stem, written_first
from scene2hap.scene.grouping.groups import Grouping, check_grouping, group_objects, unique_ids
from scene2hap.scene.grouping.not_drawn import warn_of_collapsed, without_collapsed
from scene2hap.scene.grouping.object_maker import ObjectMaker
from scene2hap.scene.joints import hinges
from scene2hap.scene.looks.texture_files import TextureFiles
from scene2hap.scene.looks.textures import TextureWarning
from scene2hap.scene.names import says_nothing
from scene2hap.scene.objects import UpAxis, with_relative_heights
from scene2hap.scene.plausibility.units import UnitWarning, warn_if_implausible
from scene2hap.scene.snapshot import SceneSnapshot
from scene2hap.scene.tree import AuthoredScene

__all__ = ["TextureWarning", "UnitWarning", "load_scene"]

_USD_SUFFIXES = (".usd", ".usda", ".usdc", ".usdz")
SUFFIXES = (".glb", ".gltf", *_USD_SUFFIXES, ".obj", ".dae", ".stl", ".ply", ".urdf", ".xml", ".json")
_Rest = ParamSpec("_Rest")
_Found = TypeVar("_Found")
# Textures that a warning lists one by one (assumed: five examples show the cause).
_LISTED = 5


@clear_call
def load_scene(
    path: str | os.PathLike[str],
    *,
    up_axis: UpAxis | None = None,
    unit_m: float | None = None,
    group: Grouping = "authored",
    assets_root: str | os.PathLike[str] | None = None,
    names: Mapping[str, str] | str | os.PathLike[str] | None = None,
) -> SceneSnapshot:
    """Read a scene file: glTF, GLB, OBJ, STL, PLY, COLLADA, USD, URDF, MJCF, Habitat or scene JSON.

    Parameters:
    up_axis : "y" or "z"; None means the file's own axis, else "y". Nothing is rotated; it only declares which axis is
        up.
    unit_m : metres per unit of the file; None means the file's own unit, else 1.
    group : the rule by which nodes become objects; see `scene2hap.scene.grouping.groups`. In a MuJoCo model, bodies are
        objects.
    assets_root : the folder from which files beside the scene are read, with its subfolders; None means the scene's own
        folder. Nothing outside it is opened. If textures are in a sibling folder of the scene's, give the folder that
        holds both. For a Habitat scene (`NAME.scene_instance.json`) it is the dataset's folder; None means the nearest
        folder above the scene, up to five levels, that holds `*.scene_dataset_config.json`.
    names : only for Habitat scenes, whose templates may be hashes: object names by template, or the path of such a
        table. The table is JSON that maps templates to names, or CSV with columns such as id and name. HSSD's own
        tables are found without this parameter; see `scene2hap.scene.formats.habitat.names`.

    Returns: the scene named after the file. An object has the pose of the node that names it, without scale. Copies of
        one mesh share one TriMesh, and one instance_key if they look alike. Ids are the authored names. The second and
        third object of a name, in file order, get `#2`, `#3`, ... Every load gives the same ids. The only object of a
        file has the file's name if its own says nothing, as "object", "base_link" or "Cube.001"; its id stays.
    Raises: SceneFormatError: the file is broken, or its content does not fit its suffix. SceneError: it is missing, too
    large (`scene2hap.scene.limits`), empty, wants a file outside assets_root, or holds invalid geometry. MissingExtra:
    a decoder, MuJoCo or usd-core is not installed.
    Warns: UnitWarning: without unit_m, if sizes are implausible as metres. TextureWarning: textures are missing,
    broken, too large or outside assets_root; the scene is read without them. SceneWarning: nodes without size, or
    something of a Habitat scene, are left out.
    """
    path = checks.path("path", path, error=SceneError, hint=written_first(path))
    if up_axis is not None and not (isinstance(up_axis, str) and up_axis in ("y", "z")):
        raise SceneError(
            f"up_axis is {checks.represented(up_axis)}; it must be 'y' or 'z', or None for what the file says."
        )
    if unit_m is not None:
        unit_m = checks.number(
            "unit_m", unit_m, "m", above=0.0, error=SceneError, hint="A file in centimetres has 0.01."
        )
    if names is not None and not is_habitat(path):
        raise SceneError(
            f"names is for Habitat scenes (NAME{HABITAT_SUFFIX}), and {path.name!r} is none. Leave it out; nodes of "
            "other files get names by group={node: name}."
        )
    check_grouping(group)
    if assets_root is not None:
        assets_root = checks.path("assets_root", assets_root, error=SceneError)
    return _loaded(path, up_axis, unit_m, group, assets_root, names)


def _naming_file(read: Callable[Concatenate[Path, _Rest], _Found]) -> Callable[Concatenate[Path, _Rest], _Found]:
    """Let a function that reads a file put the file's name before the message of an error that does not name it."""

    def reading(path: Path, /, *rest: _Rest.args, **named: _Rest.kwargs) -> _Found:
        try:
            return read(path, *rest, **named)
        except SceneError as error:
            if path.name not in str(error) and repr(path.name)[1:-1] not in str(error):
                error.args = (f"{path.name!r}: {error}",)
            raise

    return reading


@_naming_file
def _loaded(
    path: Path,
    up_axis: UpAxis | None,
    unit_m: float | None,
    group: Grouping,
    assets_root: Path | None,
    names: Mapping[str, str] | str | os.PathLike[str] | None,
) -> SceneSnapshot:
    if path.suffix.lower() == ".json" and not is_habitat(path):
        return _from_json(path, up_axis, unit_m, group)
    root = path.parent if assets_root is None else assets_root
    if path.suffix.lower() == ".xml":
        unit = unit_m or 1.0
        snapshot = _from_mjcf(path, up_axis, unit, group, root)
    else:
        if is_habitat(path):
            from scene2hap.scene.formats.habitat.reader import read_habitat

            authored = read_habitat(path, None if assets_root is None else root, names, _read)
        else:
            authored = _read(path, root)
        if authored.left_out:
            n = len(authored.left_out)
            first = " ".join(authored.left_out[:_LISTED]) + (f" And {n - _LISTED} more." if n > _LISTED else "")
            message = f"{path.name!r} is read without {counted(n, 'texture')}, in plain colours: {first}"
            warn_of(message, TextureWarning)
        unit = unit_m or authored.metres_per_unit(path.name)
        snapshot = _snapshot(writable(scene_stem(path)), authored, up_axis or authored.up_axis, unit, group)
    snapshot = _named_after_file(snapshot, writable(scene_stem(path)))
    if unit_m is None:
        warn_if_implausible(snapshot, unit)
    return snapshot


@_naming_file
def _read(path: Path, assets_root: Path) -> AuthoredScene:
    suffix = path.suffix.lower()
    if suffix not in SUFFIXES and os.path.isfile(path):
        raise SceneFormatError(
            f"{path.name!r} is of no kind that is read: {', '.join(SUFFIXES)}. Export the scene as GLB (.glb) from the "
            "program that made it."
        )
    # Each reader is imported at its first use: a game that loads GLB pays for no other.
    if suffix in (".glb", ".gltf"):
        from scene2hap.scene.formats.gltf.reader import read_gltf

        return read_gltf(path, assets_root)
    if suffix in _USD_SUFFIXES:
        from scene2hap.scene.formats.usd.process import read_usd

        return read_usd(path, assets_root)
    if suffix == ".urdf":
        from scene2hap.scene.formats.urdf import read_urdf

        return read_urdf(path, assets_root, _read)
    data = read_bytes(path)
    if suffix == ".obj":
        from scene2hap.scene.formats.obj import read_obj

        return read_obj(decoded(data), writable(path.stem), TextureFiles(path.parent, assets_root))
    if suffix == ".dae":
        from scene2hap.scene.formats.dae import read_dae

        return read_dae(data, path.name, TextureFiles(path.parent, assets_root))
    from scene2hap.scene.formats.stl_ply import read_stl_ply

    return read_stl_ply(data, suffix[1:], writable(path.stem))


def _from_json(path: Path, up_axis: UpAxis | None, unit_m: float | None, group: Grouping) -> SceneSnapshot:
    if unit_m not in (None, 1.0) or group != "authored" or up_axis is not None:
        raise SceneError(
            "a scene in JSON states its own axis, metres and objects; leave up_axis, unit_m and group out."
        )
    try:
        text = read_bytes(path).decode("utf-8-sig")
    except UnicodeDecodeError as cause:
        raise SceneFormatError(f"{path.name!r} cannot be read: {reason_of(cause)}.") from cause
    return SceneSnapshot.from_json(text)


def _from_mjcf(path: Path, up_axis: UpAxis | None, unit_m: float, group: Grouping, root: Path) -> SceneSnapshot:
    if group != "authored" or up_axis == "y":
        raise SceneError("a MuJoCo model has Z up, and its bodies are its objects; leave up_axis and group out.")
    from scene2hap.scene.engines.mujoco import load_mjcf

    return load_mjcf(path, assets_root=root, unit_m=unit_m)


def _snapshot(name: str, authored: AuthoredScene, up_axis: UpAxis, unit_m: float, group: Grouping) -> SceneSnapshot:
    roots, collapsed = without_collapsed(authored.roots)
    # Transforms of a broken file may overflow when they are multiplied; ObjectMaker refuses the results.
    with np.errstate(all="ignore"):
        groups = group_objects(roots, group, scene_name=name)
    if not groups and collapsed:
        raise SceneError(
            f"no object in scene {name!r} has a size: the scale is 0, or all vertices are in one point. Check both."
        )
    warn_of_collapsed(name, collapsed)
    if not groups:
        raise SceneError(f"scene {name!r} holds no triangles; nothing in it can be touched. Export it with meshes.")
    limits.at_most("the number of objects", len(groups), "MAX_OBJECTS")
    maker = ObjectMaker(up_axis, unit_m)
    objects = list(map(maker.make, unique_ids([item.name for item in groups]), groups))
    by_key = {each.key: item for each, item in zip(groups, objects, strict=True) if each.key}
    held = hinges(by_key, authored.pivots, unit_m)
    objects = [replace(item, hinge=held[item.id]) if item.id in held else item for item in objects]
    return SceneSnapshot(name, up_axis, with_relative_heights(objects, up_axis))


def _named_after_file(snapshot: SceneSnapshot, stem: str) -> SceneSnapshot:
    """Give the only object of a file the file's name, if its own says nothing. Its id stays, for links to engines."""
    item = snapshot.objects[0]
    if len(snapshot.objects) > 1 or not says_nothing(item.name) or says_nothing(stem):
        return snapshot
    return replace(snapshot, objects=(replace(item, name=stem),))
