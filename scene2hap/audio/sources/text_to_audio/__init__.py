"""Sounds generated from a sentence, by a program of the user's choice in a separate process."""

from __future__ import annotations

from scene2hap.audio.sources.text_to_audio.source import TextToAudio, UnusableTake

__all__ = ["TextToAudio", "UnusableTake"]
