"""Caches of pictures by their content: in memory for this process, and in a folder between runs."""

from __future__ import annotations

from collections import OrderedDict
from pathlib import Path
from threading import Lock

from scene2hap.common.files import read_small, write_whole
from scene2hap.common.printable import quoted
from scene2hap.errors import ConfigError, unwritable
from scene2hap.scene.capture.png import PNG_END

MEMORY_BYTES = 256 * 2**20
"""Bound of this process's LRU cache [bytes]: about 2000 pictures of 512 pixels (assumed)."""


class MemoryCache:
    """An LRU cache of PNG files by key, bounded in bytes."""

    def __init__(self, limit_bytes: int = MEMORY_BYTES) -> None:
        self._limit = limit_bytes
        self._size = 0
        self._kept: OrderedDict[str, bytes] = OrderedDict()
        self._lock = Lock()

    def get(self, key: str) -> bytes | None:
        """Return the picture, or None."""
        with self._lock:
            if key in self._kept:
                self._kept.move_to_end(key)
            return self._kept.get(key)

    def put(self, key: str, png: bytes) -> None:
        """Add a picture."""
        with self._lock:
            self._size += len(png) - len(self._kept.get(key, b""))
            self._kept[key] = png
            self._kept.move_to_end(key)
            while self._size > self._limit and len(self._kept) > 1:
                self._size -= len(self._kept.popitem(last=False)[1])

    def clear(self) -> None:
        """Empty the cache."""
        with self._lock:
            self._kept.clear()
            self._size = 0


MEMORY = MemoryCache()
"""The cache that all captures of this process share."""


class FolderCache:
    """PNG files in a folder. Each is written atomically, so several processes may share the folder.

    Raises: ConfigError: the folder cannot be made or written to.
    """

    def __init__(self, folder: Path) -> None:
        self._folder = folder

    def get(self, key: str) -> bytes | None:
        """Return the picture, or None. A file that was cut short is ignored."""
        try:
            png = read_small(self._path(key))
        except (OSError, ValueError):
            return None
        return png if png.endswith(PNG_END) else None

    def put(self, key: str, png: bytes) -> None:
        """Add a picture. Raises: ConfigError: the folder cannot be written to."""
        path = self._path(key)
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
            write_whole(path, png)
        except OSError as cause:
            raise ConfigError(unwritable(f"cache_dir {quoted(self._folder)}", cause, "Name another.")) from cause

    def _path(self, key: str) -> Path:
        return self._folder / key[:2] / f"{key}.png"
