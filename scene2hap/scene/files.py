"""Find and read the files of a scene: its own file, and files inside the assets root."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from urllib.parse import unquote, urlsplit

from scene2hap import checks
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
    """Return the path of `uri`, a relative reference in a scene file, from the file's folder.

    Raises: SceneError: it is no plain relative path, or leads outside `assets_root` (also through a link).
    """
    refusal = f"{place} wants {uri!r}, which lies outside {assets_root}; only files inside it are read."
    with usable_name(uri, place):
        parts = urlsplit(uri)
        if parts.scheme or parts.netloc:
            raise SceneError(f"{refusal} Addresses are never fetched: store the file beside the scene.")
        path = (folder / unquote(uri)).resolve()
        if not path.is_relative_to(assets_root.resolve()):
            raise SceneError(f"{refusal} Copy it there, or give assets_root={holding_both(path, assets_root)}.")
    return path


@contextmanager
def usable_name(name: str, place: str) -> Iterator[None]:
    """Raise a SceneError that names `place` if a file's name turns out to be invalid within the `with` statement."""
    try:
        yield
    except SceneError:
        raise
    # A broken address, a name that is too long, a zero byte or a cycle of links raises one of these errors.
    except (ValueError, OSError, RuntimeError) as cause:
        raise SceneError(f"{place} wants {name!r}, which is no usable file name: {reason_of(cause)}.") from cause


def holding_both(path: Path, assets_root: Path) -> str:
    """Return the nearest folder that holds both, as text for a message; never the root of a disk."""
    roots = set(assets_root.resolve().parents)
    nearest = next((folder for folder in path.parents if folder in roots and folder != Path(folder.anchor)), None)
    return "<a folder that holds both>" if nearest is None else repr(str(nearest))


def read_bytes(path: Path) -> bytes:
    """Return the content of a regular file.

    Raises: SceneError: it is missing, no regular file, unreadable or larger than `limits.MAX_FILE_BYTES`.
    SceneFormatError: it is empty.
    """
    check_file(path)
    try:
        return path.read_bytes()
    except OSError as cause:
        raise SceneError(f"{str(path)!r} cannot be read: {reason_of(cause)}.") from cause


def check_file(path: Path) -> None:
    """Check a file without reading it. Raises: the errors of `read_bytes`, except for unreadable content."""
    try:
        if not path.exists():
            near = checks.near_files(path) or "Check the path, or export the scene with all its files."
            raise SceneError(f"there is no file {str(path)!r}. {near}")
        if (path / "bundle.json").exists():
            raise SceneError(
                f"{str(path)!r} is the folder of a bundle, not a scene file; `HapticBundle.load` reads it, "
                "its scene is its .snapshot, and `rebake` bakes it again."
            )
        if not path.is_file():
            raise SceneError(f"{str(path)!r} is not a file; give the path of the scene file itself, not its folder.")
        limits.at_most(f"the size of {path.name!r} in bytes", path.stat().st_size, "MAX_FILE_BYTES")
        is_empty = path.stat().st_size == 0
    except SceneError:
        raise
    # ValueError: the name contains a zero byte.
    except (OSError, ValueError) as cause:
        raise SceneError(f"{str(path)!r} cannot be read: {reason_of(cause)}.") from cause
    if is_empty:
        raise SceneFormatError(f"{path.name!r} is empty (0 bytes). Export it again.")
