"""The meter's mean power spectrum, whose pieces are transformed together."""

import numpy as np
import pytest
import scipy.fft

from scene2hap.audio.conversion.meter import Meter

RATE = 4000


@pytest.mark.parametrize(("channels", "seconds", "n_calls"), [(1, 3, 1), (1, 12, 1), (2, 5, 1), (2, 12, 2), (5, 6, 2)])
def test_four_or_more_channels_of_pieces_are_transformed_at_once(
    channels: int, seconds: int, n_calls: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Each piece holds another tone, of which the highest stands for the sound, whichever transform it was in."""
    calls: list[int] = []
    transform = scipy.fft.rfft

    def counting(x: np.ndarray, axis: int) -> np.ndarray:
        calls.append(x.size)
        return np.asarray(transform(x, axis=axis))

    monkeypatch.setattr(scipy.fft, "rfft", counting)
    t = np.arange(seconds * RATE) / RATE
    for loudest in range(seconds // 3):
        calls.clear()
        tones = [(0.3 if k == loudest else 0.1) * np.sin(2 * np.pi * (100 + 50 * k) * t) for k in range(seconds // 3)]
        sound = np.choose(np.minimum((t * len(tones) / seconds).astype(int), len(tones) - 1), tones)
        meter = Meter(RATE, channels, n_frames=len(t))
        for block in np.array_split(np.tile(sound[:, None], channels).astype(np.float32), 7):
            meter.add(block)
        assert meter.dominant_frequency_hz() == pytest.approx(100 + 50 * loudest, abs=0.5)
        assert len(calls) == n_calls
