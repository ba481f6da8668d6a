"""Checks of results: errors of scene2hap that can be printed, finite numbers, and samples within [-1, 1]."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import numpy as np


def printed(error: Exception) -> int:
    """Print an error of scene2hap as the command line does; its text must be printable. Returns 1."""
    from scene2hap.common.printable import printable

    print(f"scene2hap: error: {printable(str(error))[:2000]}", file=sys.stderr)
    return 1


def is_harmless(made: Any) -> bool:
    """Whether all numbers of a result are finite, and all blocks of samples are within [-1, 1]."""
    if isinstance(made, list | tuple):
        return all(map(is_harmless, made))
    if isinstance(made, float):
        return bool(np.isfinite(made))
    if isinstance(made, np.ndarray) and made.dtype.kind in "fc":
        is_block = made.dtype == np.float32
        return bool(np.isfinite(made).all()) and not (is_block and made.size and np.abs(made).max() > 1.0)
    return True


def wav_is_harmless(path: Path) -> bool:
    """Whether all samples of a sound file are finite and within [-1, 1]; True if there is no file."""
    import soundfile

    if not path.exists():
        return True
    with soundfile.SoundFile(path) as file:
        return all(is_harmless(block.astype(np.float32)) for block in file.blocks(1 << 16, dtype="float64"))
