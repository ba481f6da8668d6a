"""What an attack may leave: sentences of ours that can be printed, numbers that are numbers, samples within [-1, 1]."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import numpy as np


def told(error: Exception) -> int:
    """Print an error of ours as the command line does; its text must be one that can be shown."""
    from scene2hap.printable import printable

    print(f"scene2hap: error: {printable(str(error))[:2000]}", file=sys.stderr)
    return 1


def is_harmless(made: Any) -> bool:
    """Whether arrays among what came back hold finite numbers alone, and blocks of samples none outside of [-1, 1]."""
    if isinstance(made, list | tuple):
        return all(map(is_harmless, made))
    if isinstance(made, float):
        return bool(np.isfinite(made))
    if isinstance(made, np.ndarray) and made.dtype.kind in "fc":
        is_block = made.dtype == np.float32
        return bool(np.isfinite(made).all()) and not (is_block and made.size and np.abs(made).max() > 1.0)
    return True


def wav_is_harmless(path: Path) -> bool:
    """Whether a sound file holds finite samples within [-1, 1] alone; one that was not written does."""
    import soundfile

    if not path.exists():
        return True
    with soundfile.SoundFile(path) as file:
        return all(is_harmless(block.astype(np.float32)) for block in file.blocks(1 << 16, dtype="float64"))
