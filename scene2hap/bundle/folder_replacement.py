"""Replacement of a bundle's folder as a whole: the new folder is built beside the target, then moved there in one step.

The draft is beside the target as `.NAME.scene2hap-RANDOM-INODE.new`. The system swaps the two folders in one step
(`exchange`), and the old bundle, which now has the draft's name, is removed. Some systems cannot swap folders. There
the old folder is first moved to a name that ends in `.old`, and then the draft to the target. If the process dies
between these two moves, the target is missing, and both folders are beside it: the next load or save moves the new one
to the target (`recover`).

A folder keeps its inode when it is moved. So a folder with a draft's name and the inode in that name is a draft, which
may be removed. With another inode it is an old bundle, which may hold foreign files. A process that works on a folder
locks it, and the system releases the lock when the process dies. A folder without a lock is abandoned; the next save
removes it.
"""

from __future__ import annotations

import hashlib
import os
import re
import shutil
import uuid
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path

from scene2hap.bundle.checking import BundleWarning
from scene2hap.bundle.folder_swap import exchange
from scene2hap.bundle.foreign_files import carry_over, discard
from scene2hap.bundle.manifest import MANIFEST, our_files
from scene2hap.common.files import Stamp, file_stamp, rename
from scene2hap.common.folder_locks import is_old, lock_folder
from scene2hap.common.warning import warn_of
from scene2hap.errors import BundleChanged, BundleError, BundleIncomplete, reason_of, unwritable

_MARK = ".scene2hap-"


def require_replaceable(target: Path) -> None:
    """Check that a target can be replaced: it does not exist, is an empty folder, or is a readable bundle.

    Raises: BundleVersionError: a bundle of a newer scene2hap; BundleError: any other content, too long a name, the
    folder above cannot be written, or the target is or contains the working folder of this process, which a bundle
    would move away.
    """
    place = _resolved(target)
    above = next((folder for folder in place.parents if os.path.exists(folder)), None)
    if above is None:  # on Windows
        raise BundleError(f"{target} cannot be written: there is no drive or share {place.anchor}. Name another.")
    if not above.is_dir() or not os.access(above, os.W_OK | os.X_OK):
        raise BundleError(f"{target} cannot be written: {above} is no folder of yours. Choose another place.")
    try:
        place.lstat()
    except FileNotFoundError:
        return
    except OSError as cause:  # its name is too long
        raise BundleError(unwritable(target, cause)) from cause
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


def save_stamp(target: Path) -> Stamp | None:
    """Return a stamp that changes whenever a bundle is saved at the target; None if there is no bundle.

    Raises, warns: as `recover`, which completes an interrupted save first.
    """
    recover(target)
    return file_stamp(target / MANIFEST)


@contextmanager
def replaced(
    target: Path, since: Stamp | None = None, retire: Callable[[Path, Path], None] | None = None
) -> Iterator[Path]:
    """Provide a folder to write to. It replaces `target` if the block succeeds, else it is removed.

    Foreign files in the replaced folder are kept. `since` : the target is replaced only if this is still its
    `save_stamp`; None to replace it in any case. `retire` : moves or removes the replaced folder, given its path now
    and the target; None to remove it.
    Raises: BundleError: as `require_replaceable`; BundleChanged: another process has saved a bundle there; OSError: a
    folder cannot be made or moved.
    Warns: BundleWarning: an earlier save was completed, or the old folder cannot be removed.
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
            _put(draft, place, target, held, since, retire)
        finally:
            # Keep the draft if the target is missing: the next load moves it there.
            if _is_draft(draft) and not os.path.lexists(draft.with_suffix(".old")):
                shutil.rmtree(draft, ignore_errors=True)
    _sync(place.parent)


def recover(target: Path) -> None:
    """Complete an interrupted save: move the new bundle to the target if a process died while the target was missing.

    Raises: BundleError: it cannot be moved. Warns: BundleWarning: it was moved.
    """
    try:
        place = _resolved(target)
    except BundleError:
        return  # the caller's read or write reports the error
    if os.path.lexists(place):
        return
    for old in _left_beside(place, "old"):
        new = old.with_suffix(".new")
        with ExitStack() as held:
            if not (new / MANIFEST).is_file() or lock_folder(new, held) is False or os.path.lexists(place):
                continue  # another process works on it
            try:
                rename(new, place)
            except OSError as cause:
                raise BundleError(
                    f"{target} was being replaced when that process died. The new bundle is whole at {new}, the old "
                    f"one at {old}; move one of them to {target} ({cause.strerror})."
                ) from cause
            warning = f"{target} was being replaced when that process died; the new bundle was whole and is there now."
            warn_of(warning, BundleWarning)
            with suppress(OSError, BundleError):
                discard(old, place)
        return


def _put(
    draft: Path,
    place: Path,
    target: Path,
    held: ExitStack,
    since: Stamp | None,
    retire: Callable[[Path, Path], None] | None,
) -> None:
    os.chmod(draft, 0o755)  # the draft was made private, but a bundle is as readable as any folder
    while True:
        if not os.path.lexists(place):
            try:
                rename(draft, place)
            except OSError:
                if not os.path.lexists(place):
                    raise
                continue  # another process was faster
            return
        with ExitStack() as old_held:
            if lock_folder(place, old_held, wait=True) is False:
                continue  # it has been replaced in the meantime
            require_replaceable(target)
            if since is not None and save_stamp(place) != since:
                raise BundleChanged(f"{target} was saved by another process since it was read. Read it again.")
            carry_over(place, draft)
            shutil.copymode(place, draft)
            old = draft if exchange(draft, place) else _move_in(draft, place)
            try:
                os.chmod(old, 0o700)  # it may be write-protected
                (retire or discard)(old, place)
            except (OSError, BundleError) as cause:
                warning = (
                    f"{target} is written, but {old}, which it replaces, cannot be moved or removed: "
                    f"{reason_of(cause).removesuffix('.')}. Remove it when no program has a file of it open."
                )
                warn_of(warning, BundleWarning)
        return


def _move_in(draft: Path, place: Path) -> Path:
    """Move the draft to the target in two steps. Returns the new path of the old folder."""
    old = draft.with_suffix(".old")
    rename(place, old)
    try:
        rename(draft, place)
    except BaseException:
        rename(old, place)
        raise
    return old


def _new_draft(place: Path, held: ExitStack) -> Path:
    while True:
        made = place.with_name(f"{_stem(place)}{uuid.uuid4().hex[:8]}")
        made.mkdir(mode=0o700)
        draft = made.with_name(f"{made.name}-{made.stat().st_ino}.new")
        try:
            rename(made, draft)
        except FileNotFoundError:
            continue  # another save removed the empty folder before it was locked
        except OSError:
            made.rmdir()
            raise
        if lock_folder(draft, held) is not False:
            return draft


def _remove_abandoned(place: Path) -> None:
    """Remove the drafts of saves to this target whose process died."""
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
    """Return True if a folder with a draft's name is still the draft itself, and not an old bundle after a swap."""
    try:
        return path.suffix == ".new" and path.name.endswith(f"-{path.stat().st_ino}.new")
    except OSError:
        return False


def _is_abandoned(folder: Path, held: ExitStack) -> bool:
    is_locked = lock_folder(folder, held)
    return is_old(folder) if is_locked is None else is_locked


def _resolved(target: Path) -> Path:
    """Resolve links to the folder itself. Raises: BundleError: it has no name, or cannot exist."""
    try:
        place = target.resolve()
    except (OSError, RuntimeError, ValueError) as cause:
        raise BundleError(f"{str(target)[:200]!r} cannot be a folder: {reason_of(cause)}.") from cause
    if not place.name:
        raise BundleError(f"{target} cannot be replaced by a bundle; name a folder in it.")
    return place


def _working_folder() -> Path | None:
    try:
        return Path.cwd()
    except OSError:  # it has been removed
        return None


def _sync(folder: Path) -> None:
    """Write renames in a folder to the disk, on systems that support this for folders."""
    if os.name != "posix":
        return
    with suppress(OSError):
        descriptor = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(descriptor)
        finally:
            os.close(descriptor)
