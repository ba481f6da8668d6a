"""Pictures that a client sends before a bake, stored on disk until the bake reads them."""

from __future__ import annotations

import json
import shutil
import tempfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from scene2hap.bridge.frames import decode_picture
from scene2hap.common import checks
from scene2hap.common.files import write_whole
from scene2hap.common.json_texts import parse_json
from scene2hap.errors import BridgeError, unwritable
from scene2hap.scene.capture.given_pictures import INDEX, GivenPictures

MAX_BYTES = 1 << 29
"""Most bytes of a client's pictures before a bake."""


@contextmanager
def temporary_files() -> Iterator[None]:
    """Raises: BridgeError: a temporary file of the bridge cannot be written."""
    try:
        yield
    except OSError as cause:
        hint = "Start the bridge with another TMPDIR."
        raise BridgeError(unwritable("a temporary file of the bridge", cause, hint)) from cause


class SentPictures:
    """The pictures of one client.

    Parameters: parent : returns the parent of its temporary folder; called at the first picture.
    """

    def __init__(self, parent: Callable[[], Path]) -> None:
        self._parent = parent
        self._folder: Path | None = None
        self._rows: dict[tuple[Any, Any, Any], str] = {}
        self._n_bytes = 0

    def take(self, message: bytes) -> None:
        """Store a picture. It replaces an earlier one with the same object, kind and view.

        Raises: BridgeError: its text is no JSON object, there are too many, or the disk is full; SceneError: it cannot
        be used.
        """
        text, file = decode_picture(message)
        try:
            row = parse_json(text)
        except ValueError as cause:
            raise BridgeError(f"the text of a picture is no JSON: {cause}.") from cause
        if not isinstance(row, dict):
            raise BridgeError(f"the text of a picture is {checks.described(row)}; it must be an object.")
        key: tuple[Any, Any, Any] = (row.get("object"), row.get("kind"), row.get("view"))
        GivenPictures({key: file})  # raises an error if the file is no picture, or its key is incomplete
        self._n_bytes += len(file)
        if self._n_bytes > MAX_BYTES:
            raise BridgeError(
                f"the pictures have more than {MAX_BYTES >> 20} MiB; bake, or send fewer or smaller ones."
            )
        with temporary_files():
            if self._folder is None:
                self._folder = Path(tempfile.mkdtemp(prefix="pictures-", dir=self._parent()))
            name = self._rows.get(key, f"{len(self._rows):06d}")
            write_whole(self._folder / name, file)
        self._rows[key] = name

    def hand_over(self) -> Path:
        """Return the folder of pictures for a bake. Later ones get a new folder. Raises: BridgeError: no pictures."""
        if self._folder is None:
            raise BridgeError('there are no pictures; send them before the bake, or leave "pictures" out.')
        folder = self._folder
        rows = [
            {"object": thing, "kind": kind, "view": view, "file": file}
            for (thing, kind, view), file in self._rows.items()
        ]
        with temporary_files():
            write_whole(folder / INDEX, json.dumps(rows))
        self._folder, self._rows, self._n_bytes = None, {}, 0
        return folder

    def clear(self) -> None:
        """Remove pictures that no bake has used."""
        if self._folder is not None:
            shutil.rmtree(self._folder, ignore_errors=True)
            self._folder = None
