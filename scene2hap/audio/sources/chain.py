"""Sources tried in order, until enough candidates remain.

The paper's rule (Implementation, "Audio Retrieval/Generation"): up to five retrieved sounds; five generated ones if
nothing was found. With `enough` = 1, and retrieval before generation in the list, this module does the same. A
candidate "remains" if the selection will not drop it for being too short.
"""

from __future__ import annotations

import logging
from collections.abc import Sequence

from scene2hap.audio.clip import AudioClip
from scene2hap.audio.protocol import AudioSource
from scene2hap.audio.sources.candidates import is_long_enough
from scene2hap.common import checks
from scene2hap.common.warning import warn_of
from scene2hap.errors import AudioError, Scene2HapError
from scene2hap.haptics import VibrationDescription

ENOUGH = 1
"""Candidates after which no further source is queried; the paper's rule."""

_LOG = logging.getLogger(__name__)


class SourceWarning(UserWarning):
    """A sound source failed, and the next one was queried."""


def _clips(found: object) -> list[AudioClip]:
    """Check the result of a source. Raises: AudioError: it is no list of clips."""
    if not isinstance(found, list | tuple):
        given = checks.described(found)
    elif wrong := [clip for clip in found if not isinstance(clip, AudioClip)]:
        given = f"a list with {checks.described(wrong[0])}"
    else:
        return list(found)
    raise AudioError(f"find gave {given}; it must give a list of AudioClip, which may be empty.")


def gather(
    subject: str, description: VibrationDescription, sources: Sequence[AudioSource], *, enough: int = ENOUGH
) -> list[AudioClip]:
    """Return the candidates of the first sources that together have `enough` of sufficient length, best first.

    `subject` is the object's name in errors. A source that fails is skipped with a `SourceWarning` and a log entry.
    Raises: AudioError: no source has a candidate; the message states the outcome of each.
    """
    found: list[AudioClip] = []
    fates: list[str] = []
    for source in sources:
        name = type(source).__name__
        try:
            clips = _clips(source.find(description))
        except Exception as cause:
            # Plug-ins may raise anything; a broken source must not end a bake that another source can finish.
            reason = str(cause) if isinstance(cause, Scene2HapError) else f"{type(cause).__name__}: {cause}"
            fates.append(f"{name} failed: {reason}")
            _LOG.info("%s: no sound from %s: %s", subject, name, reason)
            warn_of(f"{subject}: no sound from {name}: {reason}", SourceWarning)
            continue
        fates.append(f"{name} has none")
        found += clips
        if sum(map(is_long_enough, found)) >= enough:
            return found
    if found:
        return found
    raise AudioError(
        f"no sound for {subject!r} ({description.keywords!r}) in any of {len(sources)} sources"
        f"{': ' + '; '.join(fates).removesuffix('.') if fates else ''}. "
        "Add the synthesizer (kind 'synth') as the last source: it always has one."
    )
