"""Sounds from freesound.org, by its API, version 2."""

from __future__ import annotations

from scene2hap.audio.sources.freesound.source import Freesound, UnusableSound

__all__ = ["Freesound", "UnusableSound"]
