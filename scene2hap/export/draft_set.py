"""Several files that are written whole, and replace their earlier versions together.

Each is first written beside its place, as `.NAME.RANDOM.draft.SUFFIX`. A set holds a shared lock on every folder in
which it has drafts. A set that gets the whole lock of a folder is alone there, so that the drafts in it are those of
programs that died: it removes them.
"""

from __future__ import annotations

import re
from contextlib import ExitStack, suppress
from pathlib import Path
from typing import Self

from scene2hap.common.files import draft_path, require_place
from scene2hap.common.folder_locks import is_old, lock_folder

_KIND = "draft"
_OURS = re.compile(rf"\..*\.[0-9a-f]{{32}}\.{_KIND}(\..*)?", re.DOTALL)


class DraftSet:
    """Drafts of several files, with their paths.

    As a context it removes drafts that have not replaced their files, and the folders that it made if they are empty.
    """

    def __init__(self) -> None:
        self.drafts: list[tuple[Path, Path]] = []
        self._folders: set[Path] = set()
        self._made: list[Path] = []
        self._held = ExitStack()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        for draft, _path in self.drafts:
            with suppress(OSError):
                draft.unlink(missing_ok=True)
        self._held.close()
        for folder in reversed(self._made):
            with ExitStack() as held, suppress(OSError):
                if lock_folder(folder, held) is not False:  # else another set is about to write there
                    folder.rmdir()

    def write(self, path: Path, content: bytes) -> None:
        """Write the draft of one more file. Raises: OSError: it cannot be written, or cannot replace what is there."""
        is_first = path.parent not in self._folders
        if is_first:
            self._make(path.parent)
        require_place(path)
        if is_first:
            self._folders.add(path.parent)
            _remove_abandoned(path.parent)
            # Another process may replace the folder while this one waits, and then the lock is on the old one.
            while lock_folder(path.parent, self._held, wait=True, shared=True) is False:
                self._make(path.parent)
        draft = draft_path(path, _KIND)
        self.drafts.append((draft, path))
        draft.write_bytes(content)

    def _make(self, folder: Path) -> None:
        missing = [one for one in (folder, *folder.parents) if not one.exists()]
        folder.mkdir(parents=True, exist_ok=True)
        self._made += reversed(missing)


def _remove_abandoned(folder: Path) -> None:
    """Remove the drafts in a folder whose program died."""
    with ExitStack() as held, suppress(OSError):
        is_alone = lock_folder(folder, held)
        for path in folder.iterdir() if is_alone is not False else ():
            if _OURS.fullmatch(path.name) and (is_alone or is_old(path)):
                with suppress(OSError):
                    path.unlink()
