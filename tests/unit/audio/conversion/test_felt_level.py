"""Felt level of a whole file, against the closed form of a tone: squared amplitude times its share of the file."""

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from scene2hap.audio.conversion.felt_level import FeltLevel
from scene2hap.audio.levels import threshold_db
from scene2hap.haptics import ActuatorProfile

RATE = 4000


def level_db(samples: np.ndarray, block: int) -> float:
    heard = FeltLevel(RATE, samples.shape[1], ActuatorProfile())
    for start in range(0, len(samples), block):
        heard.add(samples[start : start + block].astype(np.float32))
    return heard.level_db()


@given(
    start=st.integers(0, 2 * RATE),
    n=st.integers(RATE // 10, 2 * RATE),
    rest=st.integers(0, RATE),
    block=st.integers(37, 9000),
)
@settings(max_examples=40)
def test_felt_level_of_a_tone_depends_on_its_share_of_the_file_only(start: int, n: int, rest: int, block: int) -> None:
    samples = np.zeros((start + n + rest, 1))
    samples[start : start + n, 0] = 0.3 * np.sin(2 * np.pi * 250 * np.arange(n) / RATE)
    share_db = 10 * np.log10(n / len(samples))
    expected_db = 20 * np.log10(0.3) - float(threshold_db(250.0)) + share_db
    assert level_db(samples, block) == pytest.approx(expected_db, abs=0.3)


def test_felt_level_is_that_of_the_strongest_channel() -> None:
    t = np.arange(RATE) / RATE
    samples = np.stack([0.01 * np.sin(2 * np.pi * 250 * t), 0.3 * np.sin(2 * np.pi * 250 * t)], axis=1)
    assert level_db(samples, 1000) == pytest.approx(level_db(samples[:, 1:], 1000), abs=1e-4)
    assert level_db(np.zeros((RATE, 1)), 1000) == -np.inf
    assert level_db(np.zeros((0, 1)), 1000) == -np.inf


def test_felt_level_can_be_read_while_blocks_are_added() -> None:
    rng = np.random.default_rng(0)
    heard, parts = FeltLevel(RATE, 1, ActuatorProfile()), rng.normal(size=(5, 3000, 1)).astype(np.float32)
    for n, part in enumerate(parts, 1):
        heard.add(part)
        assert heard.level_db() == heard.level_db()
        # Processors add the components of one or several pieces in another order.
        assert heard.level_db() == pytest.approx(level_db(np.concatenate(parts[:n]), 1234), abs=1e-9)
