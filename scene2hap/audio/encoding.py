"""Encoding of samples as the sound files of bundles and exports, and clips as they are after that."""

from __future__ import annotations

import hashlib
import io
from dataclasses import replace
from pathlib import Path
from typing import Literal

import numpy as np
import soundfile
from numpy.typing import ArrayLike, NDArray

from scene2hap.audio.clip import AudioClip
from scene2hap.audio.loop_marks import with_loop
from scene2hap.common import checks
from scene2hap.common.arrays import Ints
from scene2hap.errors import AudioError

PcmSubtype = Literal["PCM_16", "PCM_24"]

_BITS: dict[str, int] = {"PCM_16": 16, "PCM_24": 24}


def fits_flac(sample_rate_hz: int) -> bool:
    """Return True if a FLAC frame can store this rate: 16 bits for hertz, or for tens of hertz."""
    return sample_rate_hz < 2**16 or (sample_rate_hz % 10 == 0 and sample_rate_hz < 10 * 2**16)


def encoded(
    samples: ArrayLike,
    sample_rate_hz: int,
    subtype: PcmSubtype = "PCM_24",
    container: str = "WAV",
    path: Path = Path("samples"),
    *,
    is_loop: bool = False,
    loop: tuple[int, int] | None = None,
) -> bytes:
    """Return the content of a sound file of samples (n,) or (n, channels) in [-1, 1].

    Equal samples give equal bytes (the header of a float WAV would contain the time). Samples become integers of
    2^(bits-1) steps per unit, the scale at which they are read back, so that a file read and written again does not
    change; only +1 itself loses one step.
    Parameters: path : named in errors; is_loop : a WAV marks itself as a loop, for samplers and game audio tools;
    loop : it marks these samples [first, end).
    Raises: AudioError: a sample beyond full scale or not finite, or a wrong shape.
    """
    rate = int(checks.number("sample_rate_hz", sample_rate_hz, "Hz", at_least=1, error=AudioError))
    if subtype not in _BITS:
        raise AudioError(f"subtype is {subtype!r}; it must be one of {', '.join(_BITS)}.")
    content = io.BytesIO()
    steps = _quantised(path, samples, _BITS[subtype])
    soundfile.write(content, steps, rate, subtype=subtype, format=container)
    loop = (0, len(steps)) if is_loop else loop
    return with_loop(content.getvalue(), *loop, rate) if loop and container == "WAV" else content.getvalue()


def as_stored(clip: AudioClip) -> AudioClip:
    """Return the clip as it is after `encoded` and `files.read_clip`, scaled down first if it exceeds full scale."""
    peak = float(np.abs(clip.samples).max())
    samples = clip.samples / peak if peak > 1.0 else clip.samples
    return replace(clip, samples=(_steps(samples, 24) / 2.0**23).astype(np.float32))


def sound_digest(clip: AudioClip) -> str:
    """Return a digest of a clip's samples: equal for clips that have equal files; credits have no effect."""
    samples = _steps(clip.samples, 24)
    return hashlib.sha256(f"{clip.sample_rate_hz} Hz ".encode() + samples.astype("<i4").tobytes()).hexdigest()[:32]


def _steps(samples: ArrayLike, bits: int) -> Ints:
    """Return samples in integer steps of 2^-(bits-1); +1 loses one step."""
    full_scale = 2.0 ** (bits - 1)
    steps = np.rint(np.asarray(samples, dtype=np.float64) * full_scale)
    return np.asarray(np.minimum(steps, full_scale - 1), dtype=np.int64)


def _quantised(path: Path, samples: ArrayLike, bits: int) -> NDArray[np.int32]:
    """Return integers of `bits` bits in the upper bits of int32, where the encoder reads them."""
    values = np.asarray(samples, dtype=np.float64)
    if values.ndim not in (1, 2) or values.size == 0:
        raise AudioError(f"{path}: samples has shape {values.shape}; it must be (n,) or (n, channels) with n > 0.")
    peak = float(np.abs(values).max())
    if not peak <= 1.0:  # also when it is not a number
        raise AudioError(f"{path}: the largest sample is {peak:g}; it must be within 1 [-]. Scale the sound first.")
    return np.left_shift(_steps(values, bits).astype(np.int32), 32 - bits)
