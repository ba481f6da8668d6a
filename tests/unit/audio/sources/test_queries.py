from __future__ import annotations

import pytest

from scene2hap.audio.sources.freesound.queries import LONGEST_QUERY, ladder
from scene2hap.haptics import VibrationDescription


def rungs(category: str, keywords: str) -> tuple[str, ...]:
    return ladder(VibrationDescription(category, "on", "", keywords, 0.5, (0.0, 0.0, 0.0)))


@pytest.mark.parametrize(
    ("category", "keywords", "expected"),
    [
        ("fan", "fan whirring", ("fan whirring", "fan")),
        (
            "electric toothbrush",
            "electric toothbrush buzzing",
            ("electric toothbrush buzzing", "electric toothbrush", "toothbrush buzzing", "toothbrush"),
        ),
        # "machine" alone is too general.
        ("washing machine", "washing machine spinning", ("washing machine spinning", "washing machine")),
        (
            "old Coffee Maker on a counter",
            "coffee maker brewing",
            ("coffee maker brewing", "old coffee maker", "coffee maker"),
        ),
        (
            "sewing machine",
            "sewing machine clattering",
            ("sewing machine clattering", "sewing machine", "machine clattering"),
        ),
        ("thing", "thing", ()),
        ("", "", ()),
        ("12 / 3", "!", ()),
        ("", "boiling water", ("boiling water",)),
    ],
)
def test_each_query_of_the_ladder_has_fewer_words(category: str, keywords: str, expected: tuple[str, ...]) -> None:
    assert rungs(category, keywords) == expected


def test_queries_of_the_ladder_stay_within_the_length_limit() -> None:
    assert all(0 < len(rung) <= LONGEST_QUERY for rung in rungs("pneumatic " * 30 + "drill", "drill " * 50))
