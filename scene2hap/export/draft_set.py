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
    """Drafts of several files, with their paths. As a context it removes drafts that have not replaced their files."""

    def __init__(self) -> None:
        self.drafts: list[tuple[Path, Path]] = []
        self._folders: set[Path] = set()
        self._held = ExitStack()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        for draft, _path in self.drafts:
            with suppress(OSError):
                draft.unlink(missing_ok=True)
        self._held.close()

    def write(self, path: Path, content: bytes) -> None:
        """Write the draft of one more file. Raises: OSError: it cannot be written, or cannot replace what is there."""
        require_place(path)
        if path.parent not in self._folders:
            self._folders.add(path.parent)
            _remove_abandoned(path.parent)
            # Another process may replace the folder while this one waits, and then the lock is on the old one.
            while lock_folder(path.parent, self._held, wait=True, shared=True) is False and path.parent.is_dir():
                pass
        draft = draft_path(path, _KIND)
        self.drafts.append((draft, path))
        draft.write_bytes(content)


def _remove_abandoned(folder: Path) -> None:
    """Remove the drafts in a folder whose program died."""
    with ExitStack() as held, suppress(OSError):
        is_alone = lock_folder(folder, held)
        for path in folder.iterdir() if is_alone is not False else ():
            if _OURS.fullmatch(path.name) and (is_alone or is_old(path)):
                with suppress(OSError):
                    path.unlink()
