"""Pictures that a client sends before a bake, on disk until the bake reads them."""

from __future__ import annotations

import json
import shutil
import tempfile
from pathlib import Path
from typing import Any

from scene2hap import checks
from scene2hap.bridge.frames import decode_picture
from scene2hap.errors import BridgeError

MAX_BYTES = 1 << 29
"""Of all pictures of a client that wait for its bake."""
INDEX = "pictures.json"


class SentPictures:
    """The pictures of one client.

    Parameters: folder : where its own temporary folder is made.
    """

    def __init__(self, folder: Path) -> None:
        self._parent = folder
        self._folder: Path | None = None
        self._rows: list[dict[str, Any]] = []
        self._n_bytes = 0

    def take(self, message: bytes) -> None:
        """Keep a picture. Raises: BridgeError: it cannot be used, or there are too many."""
        text, file = decode_picture(message)
        try:
            row = json.loads(text)
        except (ValueError, RecursionError) as cause:
            raise BridgeError(f"the text of a picture is no JSON: {cause}.") from cause
        if not isinstance(row, dict):
            raise BridgeError(f"the text of a picture is {checks.described(row)}; it must be an object.")
        self._n_bytes += len(file)
        if self._n_bytes > MAX_BYTES:
            raise BridgeError(
                f"the pictures have more than {MAX_BYTES >> 20} MiB; send fewer or smaller ones, or bake."
            )
        if self._folder is None:
            self._folder = Path(tempfile.mkdtemp(prefix="pictures-", dir=self._parent))
        name = f"{len(self._rows):06d}"
        (self._folder / name).write_bytes(file)
        self._rows.append({**row, "file": name})

    def hand_over(self) -> Path:
        """The folder of all pictures, for a bake; later ones go into another. Raises: BridgeError: there are none."""
        if self._folder is None:
            raise BridgeError(
                'the bake is to use pictures, but none was sent; send them first, or leave "pictures" out.'
            )
        folder, rows = self._folder, self._rows
        (folder / INDEX).write_text(json.dumps(rows), encoding="utf-8")
        self._folder, self._rows, self._n_bytes = None, [], 0
        return folder

    def clear(self) -> None:
        """Remove what no bake has used."""
        if self._folder is not None:
            shutil.rmtree(self._folder, ignore_errors=True)
            self._folder = None
