"""Peaks of a sampled curve, and the nearest places at whole samples of a finer grid, by a cosine through each peak."""

from __future__ import annotations

import numpy as np

from scene2hap.common.arrays import Floats, Ints


def peaks(curve: Floats) -> Ints:
    """Return the indices of the local maxima of a curve, ends included."""
    padded = np.concatenate([[-np.inf], curve, [-np.inf]])
    return np.flatnonzero((padded[1:-1] >= padded[:-2]) & (padded[1:-1] > padded[2:]))


def at_whole_samples(curve: Floats, found: Ints, first: int, scale: float) -> tuple[Floats, Floats]:
    """Return the value of the cosine through each of the found peaks, and the whole number of samples of its place.

    Parameters: first : place of the curve's beginning; scale : samples of the finer grid per sample of the curve.
    """
    inner = np.clip(found, 1, max(1, len(curve) - 2))
    left, centre, right = (curve[np.clip(inner + step, 0, len(curve) - 1)] for step in (-1, 0, 1))
    centre = np.maximum(centre, 1e-9)
    turn = np.arccos(np.clip(0.5 * (left + right) / centre, 0.0, 1.0 - 1e-12))
    shift = np.clip(np.arctan2(0.5 * (right - left), centre * np.sin(turn)) / turn, -1.0, 1.0)
    place = first + inner + shift
    length = np.round(place * scale)
    return centre / np.cos(turn * shift) * np.cos(turn * (length / scale - place)), length
