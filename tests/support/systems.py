"""Marks of tests that need what some systems lack. Each names in its reason what is missing."""

from __future__ import annotations

import os
import sys
import tempfile
from pathlib import Path

import pytest


def _has_links() -> bool:
    """Return True if links can be made and are seen: Windows lets only administrators and developers make them."""
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "there").mkdir()
        link = Path(folder) / "link"
        try:
            link.symlink_to(Path(folder) / "there", target_is_directory=True)
            return link.is_symlink() and link.resolve().name == "there"
        except OSError:
            return False


needs_links = pytest.mark.skipif(not _has_links(), reason="no symbolic links here; on Windows, in developer mode only")

needs_modes = pytest.mark.skipif(os.name != "posix", reason="Windows has no modes of owner, group and others")

needs_long_names = pytest.mark.skipif(
    sys.platform == "win32", reason="paths of Windows end after 260 characters, and a longer one is called absent"
)

needs_removal_of_open_files = pytest.mark.skipif(
    sys.platform == "win32", reason="Windows keeps a file that a program has open"
)

needs_signals = pytest.mark.skipif(sys.platform == "win32", reason="on Windows `os.kill` ends a process at once")
