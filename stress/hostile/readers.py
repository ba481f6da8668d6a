"""All readers, by name."""

from __future__ import annotations

from stress.hostile import bundles, messages, models, scenes, small_files, sounds
from stress.hostile.reader import KEY, READERS, Reader

__all__ = ["KEY", "READERS", "Reader", "bundles", "messages", "models", "scenes", "small_files", "sounds"]
