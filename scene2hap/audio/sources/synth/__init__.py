"""Procedural sounds: voices of machines, and the table from objects to voices."""

from __future__ import annotations

from scene2hap.audio.sources.synth.synthesizer import Synthesizer

__all__ = ["Synthesizer"]
