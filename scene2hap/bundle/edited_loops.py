"""Loops whose WAV files a person has edited: their digests differ from those of the loops that were made."""

from __future__ import annotations

from dataclasses import replace

from scene2hap.audio.encoding import sound_digest
from scene2hap.audio.haptic_loop import HapticLoop

LOOPS = {"loop": "tactile", "audible": "audible"}
"""Parts of a fingerprint, and the loops of which they are the digests."""


def loop_digests(loop: HapticLoop) -> dict[str, str]:
    """Return the digests of the loops themselves."""
    return {part: sound_digest(getattr(loop, kind)) for part, kind in LOOPS.items()}


def is_edited(loop: HapticLoop) -> bool:
    """Return True if a person has changed the samples of the tactile or the audible loop since they were made."""
    return any(made != now for part, now in loop_digests(loop).items() if (made := loop.fingerprint.get(part)))


def to_be_made_again(loop: HapticLoop) -> HapticLoop:
    """Return a loop that `rebake` makes again, if a person has edited it; any other as it is."""
    if not is_edited(loop):
        return loop
    return replace(loop, fingerprint={k: v for k, v in loop.fingerprint.items() if k not in {"sound", *LOOPS}})
