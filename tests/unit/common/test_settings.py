"""Errors of settings: any wrong value is a ConfigError that speaks of the setting, not of Python's types."""

from __future__ import annotations

import re
from typing import Any

import pytest

from scene2hap import BakeConfig, SessionConfig, UserProfile
from scene2hap.bridge.config import BridgeConfig
from scene2hap.common.settings import Settings
from scene2hap.errors import ConfigError
from scene2hap.scene.capture import CaptureConfig

OF_PYTHON = re.compile(r"[Ii]nput|[Ii]nstance|[Pp]arse|should|[Vv]alid|tuple\[|NoneType|\b(str|int|float|dict)\b")
WRONG = (
    None,
    "{x} {0}",
    "",
    -1,
    1.5,
    1e300,
    10**30,
    float("nan"),
    True,
    [],
    [1],
    [[1, 2, 3]],
    {"{x}": "{y}"},
    {1: 2},
    b"a",
)


@pytest.mark.parametrize("settings", [BakeConfig, BridgeConfig, CaptureConfig, SessionConfig, UserProfile])
def test_a_wrong_value_is_an_error_in_plain_words(settings: type[Settings]) -> None:
    found = {}
    for name in settings.model_fields:
        for value in WRONG:
            try:
                settings(**{name: value})
            except ConfigError as error:
                found[name, repr(value)] = str(error)
    assert len(found) > 2 * len(settings.model_fields)
    assert not {place: words for place, words in found.items() if OF_PYTHON.search(words)}


@pytest.mark.parametrize(
    ("settings", "given", "words"),
    [
        (BakeConfig, {"prices": {"gpt-4o": 3}}, "bake setting prices.gpt-4o: it must be a list, got 3."),
        (
            BakeConfig,
            {"cache_dir": 3},
            "bake setting cache_dir: it must be a path, as a text or a pathlib.Path, got 3.",
        ),
        (BakeConfig, {"seed": 1e300}, "bake setting seed: it is too large, got 1e+300."),
        (SessionConfig, {"impacts": 1}, "session setting impacts: it must be true or false, got 1."),
        (SessionConfig, {"impacts": "no"}, "session setting impacts: it must be true or false, got 'no'."),
        (SessionConfig, {"skip": {1: True}}, "session setting skip.1: a name must be a text."),
        (
            UserProfile,
            {"hands": {"left": {100: 3.0}}},
            "user setting hands.left.100: a name must be a text.",
        ),
    ],
)
def test_an_error_names_setting_reason_and_value(settings: type[Settings], given: dict[str, Any], words: str) -> None:
    with pytest.raises(ConfigError) as caught:
        settings(**given)
    assert str(caught.value) == words
