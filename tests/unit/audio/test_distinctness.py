from __future__ import annotations

import math
import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).parents[3] / "benchmarks"))

from percepts import Percept, difference, distinctness, percept_of

from scene2hap.audio.threshold import frequency_jnds
from scene2hap.errors import AudioError

RATE = 8000
T = np.arange(2 * RATE) / RATE


def felt(frequency_hz: float, level_db: float = 20.0, envelope_hz: float | None = None) -> Percept:
    return Percept(frequency_hz, envelope_hz, level_db)


def test_a_jnd_of_frequency_is_a_weber_fraction() -> None:
    assert frequency_jnds(100.0, 122.0) == pytest.approx(1.0)
    assert frequency_jnds(148.84, 100.0) == pytest.approx(2.0)
    with pytest.raises(AudioError, match="two_hz|other_hz is 0 Hz"):
        frequency_jnds(100.0, 0.0)


@pytest.mark.parametrize(
    ("one", "other", "is_distinct"),
    [
        (felt(100), felt(149), True),
        (felt(100), felt(148), False),
        (felt(100, 20.0), felt(123, 25.1), True),
        (felt(100, 20.0), felt(123, 24.9), False),
        (felt(100, 10.0), felt(121, 40.0), False),
        (felt(100, 20.0, 2.0), felt(100, 20.0, 3.0), True),
        (felt(100, 20.0, 2.0), felt(100, 20.0, None), False),
    ],
)
def test_sources_are_distinct_by_frequency_level_or_rhythm(one: Percept, other: Percept, is_distinct: bool) -> None:
    assert difference("a", one, "b", other).is_distinct is is_distinct
    assert difference("b", other, "a", one).is_distinct is is_distinct


def test_far_distinctness_is_zero_where_a_source_is_not_felt() -> None:
    assert difference("a", felt(100, 20.0), "b", felt(200, 13.0)).far_away > 3.0
    assert difference("a", felt(100, 20.0), "b", felt(200, 11.0)).far_away == 0.0


def test_distinctness_lists_all_pairs_with_the_least_distinct_first() -> None:
    pairs = distinctness({"a": felt(100), "b": felt(105), "c": felt(300)})
    assert [(pair.first, pair.second) for pair in pairs] == [("a", "b"), ("b", "c"), ("a", "c")]


def test_feel_is_read_from_the_loop() -> None:
    x = 0.2 * np.sin(2 * np.pi * 180 * T) * (1 + 0.6 * np.sin(2 * np.pi * 8 * T))
    percept = percept_of(x, RATE)
    assert (percept.frequency_hz, percept.envelope_hz) == (180.0, 8.0)
    # The side bands have 2 (m / 2)^2 of the carrier's energy, at nearly the carrier's threshold.
    carrier_db = 20 * math.log10(0.2) + 42.6
    assert percept.level_db == pytest.approx(carrier_db + 10 * math.log10(1 + 0.18), abs=0.3)


def test_a_steady_tone_has_no_envelope_rate_and_silence_no_feel() -> None:
    assert percept_of(0.2 * np.sin(2 * np.pi * 180 * T), RATE).envelope_hz is None
    with pytest.raises(AudioError, match="silent"):
        percept_of(np.zeros(RATE), RATE)


def test_dominant_frequency_is_the_one_felt_most() -> None:
    x = 0.3 * np.sin(2 * np.pi * 40 * T) + 0.05 * np.sin(2 * np.pi * 250 * T)
    assert percept_of(x, RATE).frequency_hz == 250.0
