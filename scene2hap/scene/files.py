"""Find and read the files of a scene: its own file, and files inside the assets root."""

from __future__ import annotations

import codecs
import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from urllib.parse import unquote, urlsplit

from scene2hap.common import checks
from scene2hap.common.files import LFS_ADVICE, is_lfs_pointer, is_there
from scene2hap.common.printable import quoted
from scene2hap.errors import SceneError, SceneFormatError, reason_of
from scene2hap.scene import limits

HABITAT_SUFFIX = ".scene_instance.json"


def is_habitat(path: Path) -> bool:
    """Return True if the name of a file is that of a Habitat scene."""
    return path.name.lower().endswith(HABITAT_SUFFIX)


def scene_stem(path: Path) -> str:
    """Return a scene file's name without its suffix, which may have two parts. Never empty."""
    return path.name[: -len(HABITAT_SUFFIX)] or "scene" if is_habitat(path) else path.stem


def inside(assets_root: Path, folder: Path, uri: str, place: str) -> Path:
    """Return the path of `uri`, a relative reference in a scene file, from the file's folder. Either slash is read.

    Raises: SceneError: it is no plain relative path, or leads outside `assets_root` (also through a link).
    """
    with usable_name(uri, place):
        parts = urlsplit(uri)
        if parts.scheme or parts.netloc:
            raise address(place, uri)
        path = (folder / unquote(uri).replace("\\", "/")).resolve()
        if not path.is_relative_to(assets_root.resolve()):
            raise outside(place, uri, assets_root.resolve(), path)
    return path


def address(place: str, name: str) -> SceneError:
    """Return the error of a name that is an address."""
    return SceneError(f"{place} wants {quoted(name)}. Addresses are never fetched: store the file beside the scene.")


def outside(place: str, name: str, assets_root: Path, *paths: Path) -> SceneError:
    """Return the error of a name whose paths lie outside `assets_root`, with the nearest folder that holds both.

    That folder is never the root of a disk. All paths are resolved.
    """
    try:
        nearest = Path(os.path.commonpath([assets_root, *paths]))
    except ValueError:  # on different drives
        nearest = Path(assets_root.anchor)
    needed = "<a folder that holds both>" if nearest == Path(nearest.anchor) else repr(str(nearest))
    return SceneError(
        f"{place} wants {quoted(name)}, which lies outside {quoted(assets_root)}; only files inside it are read. Copy "
        f"it there, or, if you trust the file, give assets_root={needed} (--assets-root)."
    )


@contextmanager
def usable_name(name: str, place: str) -> Iterator[None]:
    """Raise a SceneError that names `place` if a file's name turns out to be invalid within the `with` statement."""
    try:
        yield
    except SceneError:
        raise
    # A broken address, a name that is too long, a zero byte or a cycle of links raises one of these errors.
    except (ValueError, OSError, RuntimeError) as cause:
        raise SceneError(f"{place} wants {quoted(name)}, which is no usable file name: {reason_of(cause)}.") from cause


def read_bytes(path: Path) -> bytes:
    """Return the content of a regular file.

    Raises: SceneError: it is missing, no regular file, unreadable or larger than `limits.MAX_FILE_BYTES`.
    SceneFormatError: it is empty, or a pointer of Git LFS.
    """
    check_file(path)
    try:
        return path.read_bytes()
    except OSError as cause:
        raise SceneError(f"{quoted(path)} cannot be read: {reason_of(cause)}.") from cause


def decoded(data: bytes) -> str:
    """Decode a text file of a scene.

    It is UTF-16 if a mark at its beginning says so, as Windows shells write it, else UTF-8. Text that is not UTF-8 has
    the code page of Western Windows (1252), in which 3ds Max and other programs write names.
    """
    if data.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        return data.decode("utf-16", errors="replace")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        return data.decode("cp1252", errors="replace")


def check_file(path: Path) -> None:
    """Check a file without reading it whole. Raises: the errors of `read_bytes`, except for unreadable content."""
    try:
        if not is_there(path):
            near = checks.near_files(path) or "Check the path, or export the scene with all its files."
            raise SceneError(f"there is no file {quoted(path)}. {near}")
        if (path / "bundle.json").exists():
            raise SceneError(
                f"{quoted(path)} is the folder of a bundle, not a scene file. Give the file it was baked "
                "from. Without it, `scene2hap edit BUNDLE rebake`, or `rebake(HapticBundle.load(path))`, bakes again; "
                "the scene is the bundle's .snapshot."
            )
        if not path.is_file():
            raise SceneError(f"{quoted(path)} is not a file; give the path of the scene file itself, not its folder.")
        limits.at_most(f"the size of {path.name!r} in bytes", path.stat().st_size, "MAX_FILE_BYTES")
        is_empty = path.stat().st_size == 0
        is_pointer = is_lfs_pointer(path)
    except SceneError:
        raise
    # ValueError: the name contains a zero byte.
    except (OSError, ValueError) as cause:
        raise SceneError(f"{quoted(path)} cannot be read: {reason_of(cause)}.") from cause
    if is_empty:
        raise SceneFormatError(f"{path.name!r} is empty (0 bytes). Export it again.")
    if is_pointer:
        raise SceneFormatError(f"{path.name!r} {LFS_ADVICE}.")


def written_first(scene: object) -> str:
    """A sentence that says how to read a scene of trimesh; empty for anything else."""
    is_exported = callable(getattr(scene, "export", None))
    return "Write it first: scene.export('scene.glb'), then load_scene('scene.glb')." if is_exported else ""
