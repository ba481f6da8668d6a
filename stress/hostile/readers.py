"""All readers, by name."""

from __future__ import annotations

from hostile import bundles, messages, models, scenes, small_files, sounds
from hostile.reader import KEY, READERS, Reader

__all__ = ["KEY", "READERS", "Reader", "bundles", "messages", "models", "scenes", "small_files", "sounds"]
