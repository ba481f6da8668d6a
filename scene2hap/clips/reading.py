"""Read a clip in any supported format: haptic clips and sounds."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np

from scene2hap.audio import files
from scene2hap.audio.clip import AudioClip
from scene2hap.audio.files import read_clip
from scene2hap.clips import ahap, haptic_format
from scene2hap.clips.ahap import read_ahap
from scene2hap.clips.haptic_clip import HapticClip
from scene2hap.clips.haptic_format import read_haptic
from scene2hap.clips.synthesis import RATE_HZ, synthesize
from scene2hap.common import checks
from scene2hap.errors import AudioError, ClipError

SUFFIXES = (haptic_format.SUFFIX, ahap.SUFFIX)
"""Suffixes of haptic clips; files with other suffixes are read as sounds."""


def is_haptic_clip(path: str | os.PathLike[str]) -> bool:
    """Return True if the suffix of a file is that of a haptic clip."""
    return Path(path).suffix.lower() in SUFFIXES


def read_haptic_clip(path: str | os.PathLike[str]) -> HapticClip:
    """Return the clip in a .haptic or .ahap file.

    Raises: ClipError: the file breaks a rule of its format, or has another format.
    Warns: ClipWarning: the frequency curve of a .haptic file continues after its amplitude curve, as in files of
    earlier programs; or there are events that are not haptic.
    """
    path = checks.path("path", path, error=ClipError)
    suffix = path.suffix.lower()
    if suffix == ahap.SUFFIX:
        return read_ahap(path)
    if suffix == haptic_format.SUFFIX:
        return read_haptic(path)
    raise ClipError(f"{path}: a haptic clip is a file with the suffix {' or '.join(SUFFIXES)}.")


def read_any_clip(path: str | os.PathLike[str]) -> AudioClip:
    """Return the sound in a file, or the vibration of a haptic clip.

    Raises: AudioError, ClipError: the file cannot be used.
    """
    if is_haptic_clip(path):
        return as_vibration(read_haptic_clip(path), Path(path).stem)
    try:
        return read_clip(Path(path))
    except AudioError as cause:
        # Other errors are about one sound, such as its channels.
        is_no_sound = str(cause).endswith(f"Use {files.READABLE}.")
        if not is_no_sound or Path(path).suffix.lower() in files.SUFFIXES:
            raise
        raise AudioError(f"{str(cause).rstrip('.')}, or a haptic clip: {', '.join(SUFFIXES)}.") from cause


def as_vibration(clip: HapticClip, title: str = "haptic clip") -> AudioClip:
    """Return the vibration that a player makes of a haptic clip. It is scaled down if its peaks exceed 1.

    Raises: ClipError: the clip is silent.
    """
    signal = synthesize(clip)
    samples = (signal / max(1.0, float(np.abs(signal).max()))).astype(np.float32)
    if not samples.any():
        raise ClipError(f"{title!r} is silent: its amplitude is 0 throughout. Draw one that is not.")
    return AudioClip(samples, RATE_HZ, clip.about.credit(title), is_vibration=True)
