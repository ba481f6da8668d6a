"""Procedural sounds: voices of machines, and the table that says which voice speaks for what."""

from __future__ import annotations

from scene2hap.audio.sources.synth.synthesizer import Synthesizer

__all__ = ["Synthesizer"]
