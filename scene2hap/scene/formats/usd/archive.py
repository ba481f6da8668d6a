"""Archives of USD (`.usdz`): ZIP files with uncompressed entries.

Source: OpenUSD, "USDZ File Format Specification": zero compression, no encryption, the first entry is the root layer.
"""

from __future__ import annotations

import zipfile
from pathlib import Path

from scene2hap.errors import SceneError, SceneFormatError
from scene2hap.scene import limits


class Archive:
    """The entries of a `.usdz` file.

    Raises: SceneFormatError: it is no ZIP file, its entries are compressed or overlap, or the first is no layer.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        try:
            self._zip = zipfile.ZipFile(path)
            entries = [entry for entry in self._zip.infolist() if not entry.is_dir()]
        # Broken records may raise any error in zipfile.
        except Exception as cause:
            raise SceneFormatError(f"{path.name!r} cannot be read as USDZ: {cause}.") from cause
        self._sizes = {entry.filename: entry.file_size for entry in entries}
        packed = [
            entry.filename for entry in entries if entry.compress_type != zipfile.ZIP_STORED or entry.flag_bits & 1
        ]
        if packed:
            raise SceneFormatError(
                f"{path.name!r} packs or encrypts {packed[0]!r}; USDZ stores its files as they are. Make it by usdzip."
            )
        # Any number of entries may refer to the same bytes, so their sizes are summed.
        total = sum(entry.file_size for entry in entries)
        if not entries or total > path.stat().st_size:
            raise SceneFormatError(
                f"{path.name!r} promises {len(entries)} files of {total:,} bytes, and has {path.stat().st_size:,}."
            )
        limits.at_most(f"the number of files in {path.name!r}", len(entries), "MAX_NODES")
        self.first: str = entries[0].filename

    def __contains__(self, name: str) -> bool:
        return name in self._sizes

    def read(self, name: str) -> bytes:
        """Return the content of an entry. Raises: SceneError: there is no such entry, or its bytes are damaged."""
        try:
            return self._zip.read(name)
        except Exception as cause:
            raise SceneError(f"{self.path.name!r} holds no usable {name!r}: {cause}.") from cause
