from __future__ import annotations

import pytest

from scene2hap.audio.sources.freesound.queries import LONGEST_QUERY, queries_for
from scene2hap.haptics import VibrationDescription


def queries(category: str, keywords: str) -> tuple[str, ...]:
    return queries_for(VibrationDescription(category, "on", "", keywords, 0.5, (0.0, 0.0, 0.0)))


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
def test_each_query_has_fewer_words(category: str, keywords: str, expected: tuple[str, ...]) -> None:
    assert queries(category, keywords) == expected


def test_queries_stay_within_the_length_limit() -> None:
    assert all(0 < len(query) <= LONGEST_QUERY for query in queries("pneumatic " * 30 + "drill", "drill " * 50))
