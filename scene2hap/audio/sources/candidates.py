"""Candidates of a sound source: how many it returns, and how long they must be."""

from __future__ import annotations

from scene2hap.audio.analysis import sounding_span
from scene2hap.audio.clip import AudioClip
from scene2hap.audio.select import MIN_DURATION_S
from scene2hap.common import checks
from scene2hap.errors import ConfigError

MAX_CANDIDATES = 5
"""Most candidates of a source: as many as the paper retrieves, or generates."""


def how_many(name: str, value: object) -> int:
    """Return the setting as a whole number within 1..5. Raises: ConfigError: it is not."""
    return checks.whole(name, value, "-", at_least=1, at_most=MAX_CANDIDATES, error=ConfigError)


def is_long_enough(clip: AudioClip) -> bool:
    """Return True if a clip without its silent ends is longer than the selection's lower bound."""
    first, end = sounding_span(clip.samples, clip.sample_rate_hz)
    return end - first > MIN_DURATION_S * clip.sample_rate_hz
