"""Files of others in a bundle's folder: a thesis, notes, a repository. They outlive every bundle there.

A new bundle is built beside the old one and takes its place as a whole folder. Before that, files of others are linked
into the new folder, so that they are at their place at every moment. Afterwards the old folder is emptied file by file:
the bundle's own files are removed, and so are files that the new folder has bit for bit. All others, such as a file
that an editor saved meanwhile, are moved over.
"""

from __future__ import annotations

import filecmp
import os
import shutil
import stat
from collections.abc import Iterator
from itertools import count
from pathlib import Path

from scene2hap.bundle.own_files import MANIFEST, our_files


def carry_over(old: Path, new: Path) -> None:
    """Link the files of others in the bundle `old` into `new`; copy where links are impossible. Raises: OSError.

    Where the new bundle has a file of that name, a name is added that is free.
    """
    ours = our_files(old) if any(old.iterdir()) else frozenset[str]()
    _carry(old, new, "", ours)


def discard(old: Path, new: Path) -> None:
    """Remove the folder `old`, which `new` has replaced, but no file of others that is not in `new`.

    Raises: OSError: something cannot be removed or moved; the rest is then still there.
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
            place.mkdir(exist_ok=True)  # one that was made meanwhile
            _empty(entry, place, f"{name}/", ours)
        # The list of our own files goes last, lest a second attempt took all files for those of others.
        elif name not in ours:
            _hand_on(entry, target / entry.name)
        elif name != MANIFEST:
            entry.unlink()
    if not prefix:
        (source / MANIFEST).unlink()
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
    except OSError:  # a file system without hard links, or one that allows no more of them
        if not stat.S_ISREG(entry.stat().st_mode):
            raise
        shutil.copy2(entry, target)


def _hand_on(entry: Path, target: Path) -> None:
    for place in _names(target):
        if not os.path.lexists(place):
            entry.rename(place)
            return
        if _are_equal(entry, place):
            entry.unlink()
            return


def _are_equal(one: Path, other: Path) -> bool:
    first, second = one.lstat(), other.lstat()
    if os.path.samestat(first, second):
        return True
    if stat.S_ISLNK(first.st_mode) and stat.S_ISLNK(second.st_mode):
        return os.readlink(one) == os.readlink(other)
    both = stat.S_ISREG(first.st_mode) and stat.S_ISREG(second.st_mode)
    return both and filecmp.cmp(one, other, shallow=False)


def _folder_for(path: Path) -> Path:
    """The path, or a name beside it, that is a folder or can become one."""
    return next(name for name in _names(path) if not os.path.lexists(name) or _is_folder(name))


def _free(path: Path) -> Iterator[Path]:
    return (name for name in _names(path) if not os.path.lexists(name))


def _names(path: Path) -> Iterator[Path]:
    """The path, and names beside it if it is taken: `notes-kept.txt`, `notes-kept-2.txt`, ..."""
    yield path
    yield path.with_name(f"{path.stem}-kept{path.suffix}")
    for number in count(2):
        yield path.with_name(f"{path.stem}-kept-{number}{path.suffix}")


def _entries(folder: Path) -> list[Path]:
    return sorted(folder.iterdir())


def _is_folder(entry: Path) -> bool:
    return stat.S_ISDIR(entry.lstat().st_mode)
