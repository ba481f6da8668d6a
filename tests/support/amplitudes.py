"""Amplitude of one component of a signal."""

from __future__ import annotations

import numpy as np


def amplitude(y: np.ndarray, frequency_hz: float, rate_hz: int = 8000) -> float:
    """Amplitude of the component at a whole number of hertz, over the last second."""
    last = y[-rate_hz:].astype(float)
    return float(2 * abs(np.mean(last * np.exp(-2j * np.pi * frequency_hz * np.arange(rate_hz) / rate_hz))))
