"""Samples and rates that `AudioClip` refuses."""

from __future__ import annotations

import numpy as np
import pytest

from scene2hap.audio.clip import AudioClip
from scene2hap.errors import AudioError


@pytest.mark.parametrize(
    ("samples", "how"),
    [
        (np.array([0, -16384, 8192], dtype=np.int16), r"int16.*samples / 32768"),
        (np.array([2**30, 0], dtype=np.int32), r"int32.*samples / 2147483648"),
        (np.array([128, 200], dtype=np.uint8), r"uint8.*\(samples - 128\) / 128"),
    ],
)
def test_whole_numbers_of_a_file_are_refused(samples: np.ndarray, how: str) -> None:
    """A clip of int16, as some readers of WAV return it, was 90 dB beyond full scale."""
    with pytest.raises(AudioError, match=how):
        AudioClip(samples, 48_000)


def test_pulses_of_one_and_zero_are_samples() -> None:
    for samples in (np.array([0, 1, 0, -1]), [0, 1, 0, -1]):
        np.testing.assert_array_equal(AudioClip(samples, 48_000).samples, np.array([0, 1, 0, -1], dtype=np.float32))


def test_rate_must_be_a_whole_number() -> None:
    """44100.5 Hz was played at 44100 Hz."""
    with pytest.raises(AudioError, match=r"sample_rate_hz is 44100\.5; it must be a whole number"):
        AudioClip(np.ones(9), 44100.5)  # type: ignore[arg-type]
    assert AudioClip(np.ones(9), 44100.0).sample_rate_hz == 44100  # type: ignore[arg-type]
