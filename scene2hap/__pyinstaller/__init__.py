"""PyInstaller's hook for games that use scene2hap; PyInstaller finds it by an entry point. See docs/shipping.md."""

from __future__ import annotations

from pathlib import Path


def get_hook_dirs() -> list[str]:
    """Return the folder of the hooks."""
    return [str(Path(__file__).parent)]
