"""Replace a bundle's folder as a whole: build it beside its place, then move it there in one step.

The draft stands beside the place as `.NAME.scene2hap-RANDOM-INODE.new`. The system exchanges the two folders in one
step (`exchange`), and the old bundle is then removed under the draft's name. Where there is no such step, the
old one is first moved to a name that ends in `.old`, and the draft then to its place. A process that dies between these
two leaves nothing at the place, and both beside it: the next load or save puts the new one there (`recover`).

The inode stays with a folder wherever it is moved. So a folder under a draft's name is a draft, which may be removed,
if it has the inode in that name; else it is an old bundle, which may hold files of others. A process that works on a
folder holds a lock on it, which the system releases when the process dies. A folder that is not locked was left behind;
the next save removes it.
"""

from __future__ import annotations

import hashlib
import os
import re
import shutil
import time
import uuid
import warnings
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path

from scene2hap.bundle.checking import BundleWarning
from scene2hap.bundle.exchange import exchange
from scene2hap.bundle.own_files import MANIFEST, our_files
from scene2hap.bundle.strangers import carry_over, discard
from scene2hap.errors import BundleError, BundleIncomplete

try:
    import fcntl
except ImportError:  # Windows, where a folder cannot be locked
    fcntl = None  # type: ignore[assignment]  # a module elsewhere

ABANDONED_S = 86400.0
"""Age at which a draft counts as left behind where folders cannot be locked [s]; assumed: a save takes seconds."""

_MARK = ".scene2hap-"


def require_replaceable(target: Path) -> None:
    """Require a place that is free, an empty folder, or a bundle that can be read.

    Raises: BundleVersionError: a bundle of a newer scene2hap; BundleError: anything else, or a folder that this process
    works in, which cannot be moved away below it.
    """
    place = _resolved(target)
    if not os.path.lexists(place):
        return
    if not place.is_dir():
        raise BundleError(f"{target} is not a folder; choose another name.")
    here = _working_folder()
    if here is not None and (here == place or place in here.parents):
        raise BundleError(
            f"{target} is the folder that this process works in, or holds it; a bundle replaces a folder as a whole. "
            f"Change to another one, and save to {place}."
        )
    if not any(place.iterdir()):
        return
    if not os.path.lexists(place / MANIFEST):
        raise BundleError(f"{target} is not empty and not a bundle; choose another folder, or empty this one.")
    try:
        our_files(place)
    except BundleIncomplete as cause:
        raise BundleError(
            f"{target} is not empty and not a bundle that can be read ({cause}) Choose another folder."
        ) from cause


@contextmanager
def replaced(target: Path) -> Iterator[Path]:
    """A folder to write to; it takes the place of `target` when the block ends well, and is removed when it does not.

    What is not ours in the folder that is replaced stays where it is.
    Raises: BundleError: as `require_replaceable`; OSError: a folder cannot be made or moved.
    Warns: BundleWarning: an earlier save was completed, or what was replaced cannot be removed.
    """
    recover(target)
    require_replaceable(target)
    place = _resolved(target)
    place.parent.mkdir(parents=True, exist_ok=True)
    _remove_abandoned(place)
    with ExitStack() as held:
        draft = _new_draft(place, held)
        try:
            yield draft
            _put(draft, place, target, held)
        finally:
            # Without anything at the place, it is what will be put there by the next load.
            if _is_draft(draft) and not os.path.lexists(draft.with_suffix(".old")):
                shutil.rmtree(draft, ignore_errors=True)
    _sync(place.parent)


def recover(target: Path) -> None:
    """Put a bundle at its place if the process that replaced it died when nothing was there.

    Raises: BundleError: it cannot be moved there. Warns: BundleWarning: it was.
    """
    try:
        place = _resolved(target)
    except BundleError:
        return  # whoever reads or writes there says why
    if os.path.lexists(place):
        return
    for old in _left_beside(place, "old"):
        new = old.with_suffix(".new")
        with ExitStack() as held:
            if not (new / MANIFEST).is_file() or _lock(new, held) is False or os.path.lexists(place):
                continue  # somebody is at it
            try:
                new.rename(place)
            except OSError as cause:
                raise BundleError(
                    f"{target} was being replaced when that process died. The new bundle is whole at {new}, the old "
                    f"one at {old}; move one of them to {target} ({cause.strerror})."
                ) from cause
            warning = f"{target} was being replaced when that process died; the new bundle was whole and is there now."
            warnings.warn(warning, BundleWarning, stacklevel=4)
            with suppress(OSError, BundleError):
                discard(old, place)
        return


def _put(draft: Path, place: Path, target: Path, held: ExitStack) -> None:
    os.chmod(draft, 0o755)  # one that is made privately; a bundle is as readable as any folder
    while True:
        if not os.path.lexists(place):
            try:
                draft.rename(place)
            except OSError:
                if not os.path.lexists(place):
                    raise
                continue  # somebody else was first
            return
        with ExitStack() as old_held:
            if _lock(place, old_held, wait=True) is False:
                continue  # it has been replaced meanwhile
            require_replaceable(target)
            carry_over(place, draft)
            shutil.copymode(place, draft)
            old = draft if exchange(draft, place) else _move_in(draft, place)
            try:
                os.chmod(old, 0o700)  # it may be one that cannot be written
                discard(old, place)
            except (OSError, BundleError) as cause:
                warning = f"{target} is written, but {old}, which it replaces, cannot be removed: {cause}"
                warnings.warn(warning, BundleWarning, stacklevel=6)
        return


def _move_in(draft: Path, place: Path) -> Path:
    """Move the draft to its place in two steps. Returns the path of the old folder."""
    old = draft.with_suffix(".old")
    place.rename(old)
    try:
        draft.rename(place)
    except BaseException:
        old.rename(place)
        raise
    return old


def _new_draft(place: Path, held: ExitStack) -> Path:
    while True:
        made = place.with_name(f"{_stem(place)}{uuid.uuid4().hex[:8]}")
        made.mkdir(mode=0o700)
        draft = made.with_name(f"{made.name}-{made.stat().st_ino}.new")
        try:
            made.rename(draft)
        except FileNotFoundError:
            continue  # an empty folder that nobody holds yet, removed by another save
        except OSError:
            made.rmdir()
            raise
        if _lock(draft, held) is not False:
            return draft


def _remove_abandoned(place: Path) -> None:
    """Remove the drafts of saves to this place that died."""
    for kind in ("", "new", "old"):
        for left in _left_beside(place, kind):
            with ExitStack() as held, suppress(OSError, BundleError):
                if not _is_abandoned(left, held):
                    continue
                if not kind:
                    left.rmdir()
                elif _is_draft(left):
                    shutil.rmtree(left)
                elif place.is_dir():
                    discard(left, place)


def _left_beside(place: Path, kind: str) -> list[Path]:
    rest = rf"-\d+\.{kind}" if kind else ""
    ours = re.compile(re.escape(_stem(place)) + "[0-9a-f]{8}" + rest)
    try:
        return sorted(path for path in place.parent.iterdir() if ours.fullmatch(path.name))
    except OSError:
        return []


def _stem(place: Path) -> str:
    name = place.name
    if len(os.fsencode(name)) > 150:  # the longest name that file systems allow has 255 bytes
        name = f"{name[:30]}-{hashlib.sha256(os.fsencode(name)).hexdigest()[:16]}"
    return f".{name}{_MARK}"


def _is_draft(path: Path) -> bool:
    """Whether a folder under the name of a draft is still the one that was made under it."""
    try:
        return path.suffix == ".new" and path.name.endswith(f"-{path.stat().st_ino}.new")
    except OSError:
        return False


def _lock(folder: Path, held: ExitStack, *, wait: bool = False) -> bool | None:
    """Hold a folder until `held` is closed, or the process dies.

    False: somebody else holds it, or it has gone. None: nobody can tell, since this system has no locks for it.
    """
    try:
        if fcntl is None:
            return None if os.path.lexists(folder) else False
        descriptor = os.open(folder, os.O_RDONLY | os.O_DIRECTORY)
        held.callback(os.close, descriptor)
        fcntl.flock(descriptor, fcntl.LOCK_EX | (0 if wait else fcntl.LOCK_NB))
        return os.path.samestat(os.fstat(descriptor), os.stat(folder))
    except (BlockingIOError, FileNotFoundError, NotADirectoryError):
        return False
    except OSError:  # a file system without locks, or a folder that cannot be read
        return None


def _is_abandoned(folder: Path, held: ExitStack) -> bool:
    is_locked = _lock(folder, held)
    if is_locked is None:
        with suppress(OSError):
            return folder.stat().st_mtime < time.time() - ABANDONED_S
    return bool(is_locked)


def _resolved(target: Path) -> Path:
    """The folder itself, not a link to it. Raises: BundleError: it has no name, or cannot be."""
    try:
        place = target.resolve()
    except (OSError, RuntimeError, ValueError) as cause:
        raise BundleError(f"{str(target)[:200]!r} cannot be a folder: {cause}.") from cause
    if not place.name:
        raise BundleError(f"{target} cannot be replaced by a bundle; name a folder in it.")
    return place


def _working_folder() -> Path | None:
    try:
        return Path.cwd()
    except OSError:  # it has been removed
        return None


def _sync(folder: Path) -> None:
    """Write the renames in a folder to the disk, on systems that offer this for folders."""
    if os.name != "posix":
        return
    with suppress(OSError):
        descriptor = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(descriptor)
        finally:
            os.close(descriptor)
