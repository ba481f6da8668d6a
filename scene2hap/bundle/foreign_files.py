"""Foreign files in a bundle's folder, such as notes or a repository. They are kept whenever the bundle is replaced.

A new bundle is built beside the old one and replaces it as a whole folder. Before that, foreign files are linked into
the new folder, so that they exist at every moment. Afterwards the old folder is emptied file by file: the bundle's own
files are removed, and so are files with an identical copy in the new folder. All other files, such as one that an
editor saved in the meantime, are moved to the new folder.
"""

from __future__ import annotations

import filecmp
import os
import shutil
import stat
from collections.abc import Iterator
from itertools import count
from pathlib import Path

from scene2hap.bundle.manifest import MANIFEST, our_files
from scene2hap.common.files import rename


def carry_over(old: Path, new: Path) -> None:
    """Link foreign files of the bundle `old` into `new`; copy them if links are impossible. Raises: OSError.

    If the new bundle has a file of that name, the foreign file gets a new name.
    """
    ours = our_files(old) if any(old.iterdir()) else frozenset[str]()
    _carry(old, new, "", ours)


def discard(old: Path, new: Path) -> None:
    """Remove the folder `old`, which `new` has replaced. Foreign files that are not in `new` are moved there first.

    Raises: OSError: a file cannot be removed or moved; the rest then stays.
    """
    if not any(old.iterdir()):
        old.rmdir()
        return
    _empty(old, new, "", our_files(old))


def _empty(source: Path, target: Path, prefix: str, ours: frozenset[str]) -> None:
    for entry in _entries(source):
        name = prefix + entry.name
        if _is_folder(entry):
            place = _folder_for(target / entry.name)
            place.mkdir(exist_ok=True)  # for a folder that was made in the meantime
            _empty(entry, place, f"{name}/", ours)
        # Delete the manifest last. Without it, a second attempt would take all files for foreign ones.
        elif name not in ours:
            _hand_on(entry, target / entry.name)
        elif name != MANIFEST:
            _remove(entry)
    if not prefix:
        _remove(source / MANIFEST)
    source.rmdir()


def _carry(source: Path, target: Path, prefix: str, ours: frozenset[str]) -> None:
    for entry in _entries(source):
        name = prefix + entry.name
        if _is_folder(entry):
            place = _folder_for(target / entry.name)
            place.mkdir(exist_ok=True)
            _carry(entry, place, f"{name}/", ours)
            shutil.copystat(entry, place)
        elif name not in ours:
            _link(entry, next(_free(target / entry.name)))


def _link(entry: Path, target: Path) -> None:
    if entry.is_symlink():
        target.symlink_to(os.readlink(entry))
        return
    try:
        os.link(entry, target)
    except OSError:  # the file system has no hard links, or its limit of links is reached
        if not stat.S_ISREG(entry.stat().st_mode):
            raise
        shutil.copy2(entry, target)


def _hand_on(entry: Path, target: Path) -> None:
    for place in _names(target):
        if not os.path.lexists(place):
            rename(entry, place)
            return
        if _are_equal(entry, place):
            mode = place.lstat().st_mode
            _remove(entry)
            if place.lstat().st_mode != mode:  # it is the same file by another name
                place.chmod(stat.S_IMODE(mode))
            return


def _remove(entry: Path) -> None:
    """Remove a file, also a write-protected one, which Windows would keep. Version control writes such files."""
    try:
        entry.unlink()
    except PermissionError:
        if entry.lstat().st_mode & stat.S_IWRITE:
            raise
        entry.chmod(stat.S_IWRITE | stat.S_IREAD)
        entry.unlink()


def _are_equal(one: Path, other: Path) -> bool:
    first, second = one.lstat(), other.lstat()
    if os.path.samestat(first, second):
        return True
    if stat.S_ISLNK(first.st_mode) and stat.S_ISLNK(second.st_mode):
        return os.readlink(one) == os.readlink(other)
    both = stat.S_ISREG(first.st_mode) and stat.S_ISREG(second.st_mode)
    return both and filecmp.cmp(one, other, shallow=False)


def _folder_for(path: Path) -> Path:
    """Return the path, or a similar name, that is a folder or is free."""
    return next(name for name in _names(path) if not os.path.lexists(name) or _is_folder(name))


def _free(path: Path) -> Iterator[Path]:
    return (name for name in _names(path) if not os.path.lexists(name))


def _names(path: Path) -> Iterator[Path]:
    """Yield the path, then similar names for use if it is taken: `notes-kept.txt`, `notes-kept-2.txt`, ..."""
    yield path
    yield path.with_name(f"{path.stem}-kept{path.suffix}")
    for number in count(2):
        yield path.with_name(f"{path.stem}-kept-{number}{path.suffix}")


def _entries(folder: Path) -> list[Path]:
    return sorted(folder.iterdir())


def _is_folder(entry: Path) -> bool:
    return stat.S_ISDIR(entry.lstat().st_mode)
