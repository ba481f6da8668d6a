"""The folder of a Habitat dataset: its files are found, listed and read within limits."""

from __future__ import annotations

import os
from collections.abc import Iterator
from fnmatch import fnmatchcase
from pathlib import Path
from typing import Any

from scene2hap.common.json_texts import read_json
from scene2hap.common.printable import quoted, writable
from scene2hap.errors import SceneError, SceneFormatError, reason_of
from scene2hap.scene import limits
from scene2hap.scene.files import outside, read_bytes

Json = dict[str, Any]

_DATASET_SUFFIX = ".scene_dataset_config.json"
# Folders above a scene that are searched for its dataset file (assumed: converted datasets have up to four).
_LEVELS_UP = 5


class DatasetFolder:
    """The folder of the dataset of a scene. Nothing outside `root` is opened.

    `path` is the dataset's folder, `dataset_files` are the dataset files in it; `files` are all files that were read,
    or that contain models to be read.
    """

    def __init__(self, scene: Path, assets_root: Path | None) -> None:
        """Find the dataset files of a scene, at most five folders above it and not above `assets_root`.

        Raises: SceneError: the folders have too many files.
        """
        self._n_listed = 0
        self._n_bytes = 0
        self._listings: dict[Path, list[str]] = {}
        self._documents: dict[Path, Json] = {}
        self.outside: list[str] = []
        """Patterns that match something outside the root."""
        self.files: list[Path] = []
        self.path: Path
        self.dataset_files: list[Path]
        self.path, self.dataset_files = self._found(scene, assets_root)
        self.root: Path = self.path if assets_root is None else assets_root

    def _found(self, scene: Path, assets_root: Path | None) -> tuple[Path, list[Path]]:
        """Return the dataset's folder, and the dataset files in it."""
        here = resolved(scene).parent
        folders = [here, *here.parents][: _LEVELS_UP + 1]
        if assets_root is not None:
            top = resolved(assets_root)
            folders = [folder for folder in folders if folder.is_relative_to(top)]
            folders += [] if top in folders else [top]
        for folder in folders:
            files = [folder / name for name in self._listed(folder) if name.endswith(_DATASET_SUFFIX)]
            if files:
                return folder, files
        return (here if assets_root is None else assets_root), []

    def has(self, file: Path) -> bool:
        """Return True if the file exists inside the root."""
        return is_file(file) and resolved(file).is_relative_to(resolved(self.root))

    def count(self, file: Path) -> None:
        """Count a file that is read. Raises: SceneError: all files together are too large."""
        try:
            self._n_bytes += file.stat().st_size
        except (OSError, ValueError):
            return  # the reader of the file reports the error
        self.files.append(file)
        limits.at_most("the size of all files of the dataset in bytes", self._n_bytes, "MAX_DATASET_BYTES")

    def document(self, file: Path) -> Json:
        """Return the object in a JSON file, which is read once.

        Raises: SceneFormatError: it is not JSON, or no object. SceneError: it is missing, unreadable, too large or
        outside the root.
        """
        if file not in self._documents:
            if not resolved(file).is_relative_to(resolved(self.root)):
                raise outside("the dataset", str(file), resolved(self.root), resolved(file))
            self.count(file)
            self._documents[file] = read_object(file)
        return self._documents[file]

    def matching(self, pattern: str) -> list[Path]:
        """Return the folders and files that match a pattern such as `objects/*`."""
        found = [self.path]
        for part in with_slashes(pattern).split("/"):
            if part == "..":
                found = [one.parent for one in found]
            elif any(character in part for character in "*?["):
                found = [one / name for one in found for name in self._listed(one) if fnmatchcase(name, part)]
            elif part not in ("", "."):
                found = [one / part for one in found]
        return found

    def files_of(self, pattern: str, suffix: str) -> Iterator[tuple[str, Path]]:
        """Yield handles and files of a suffix that match a pattern, or that are in folders that match it.

        A handle is a path from the dataset's folder, with slashes.
        """
        top = resolved(self.root)
        for match in self.matching(pattern):
            if not resolved(match).is_relative_to(top):
                self.outside.append(pattern)
                continue
            handle = writable(Path(os.path.relpath(match, self.path)).as_posix())
            if match.name.endswith(suffix):
                yield handle, match
            else:
                for name in self._listed(match):
                    if name.endswith(suffix):
                        yield f"{handle}/{writable(name)}".removeprefix("./"), match / name

    def all_files(self, suffixes: tuple[str, ...]) -> Iterator[tuple[str, Path]]:
        """Yield handles and paths of all files with these suffixes. Links to folders are not followed."""
        folders = [("", self.path)]
        while folders:
            handle, folder = folders.pop()
            for name in self._listed(folder):
                path = folder / name
                if name.endswith(suffixes):
                    yield handle + writable(name), path
                elif path.is_dir() and not path.is_symlink():
                    folders.append((f"{handle}{writable(name)}/", path))

    def _listed(self, folder: Path) -> list[str]:
        """Return the names in a folder in order, without hidden ones; none if it cannot be read."""
        if folder not in self._listings:
            try:
                found = sorted(name for name in os.listdir(folder) if not name.startswith("."))
            except (OSError, ValueError):
                found = []
            self._listings[folder] = found
        names = self._listings[folder]
        # Cached folders count too: a file may hold many patterns for one folder.
        self._n_listed += 1 + len(names)
        limits.at_most("the number of files in the dataset's folders", self._n_listed, "MAX_DATASET_FILES")
        return names


def read_object(file: Path) -> Json:
    """Return the object in a JSON file.

    Raises: SceneFormatError: it is not JSON, or no object. SceneError: it is missing, unreadable or too large.
    """
    try:
        document = read_json(read_bytes(file).decode("utf-8-sig"))
    except SceneError:
        raise
    except ValueError as cause:  # also text that is not UTF-8
        raise SceneFormatError(f"{file.name!r} is not JSON: {cause}.") from cause
    if not isinstance(document, dict):
        raise SceneFormatError(f"{file.name!r} holds a {type(document).__name__}; it must be a JSON object.")
    return document


def with_slashes(path: str) -> str:
    """Return a path with slashes, and without a leading `./`."""
    return path.replace("\\", "/").removeprefix("./")


def resolved(path: Path) -> Path:
    """Return a path without links. Raises: SceneError: it is no usable file name."""
    try:
        return path.resolve()
    except (OSError, ValueError, RuntimeError) as cause:  # a zero byte, a cycle of links
        raise SceneError(f"{quoted(path)} is no usable file name: {reason_of(cause)}.") from cause


def is_file(path: Path) -> bool:
    """Return True if there is a file of this name, False also for a name that no file can have."""
    try:
        return path.is_file()
    except (OSError, ValueError):
        return False
