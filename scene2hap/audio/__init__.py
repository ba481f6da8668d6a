"""Sound: clips, their analysis and choice, loops, and their conversion into touch.

`convert` turns a sound file into a tactile one, `convert_files` many at once; both are imported when first used.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from scene2hap.audio.conversion import convert as convert, convert_files as convert_files

__all__ = ["convert", "convert_files"]


def __getattr__(name: str) -> Any:
    if name in __all__:
        from scene2hap.audio import conversion

        return getattr(conversion, name)
    raise AttributeError(f"module 'scene2hap.audio' has no attribute {name!r}")
