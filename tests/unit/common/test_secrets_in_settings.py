"""A key in a configuration does not appear in any error or traceback."""

import traceback

import pytest

from scene2hap import BakeConfig
from scene2hap.errors import ConfigError

KEY = "sk-0123456789abcdef0123456789abcdef"


@pytest.mark.parametrize(
    "settings",
    [
        {"llm": {"kind": "openai", "api_key": KEY, "modle": "gpt-4o"}},
        {"llm": {"kind": "openai", "api_key": KEY, "detail": "enormous"}},
        {"llm": {"api_key": KEY}},
        {"api_key": KEY},
        {"llm": {"kind": "retry", "inner": {"kind": "openai", "api_key": KEY, "modle": "gpt-4o"}}},
        {"concurrency": {"token": KEY}},
        {"llm": {"kind": "openai", "api_kye": KEY}},
        {"llm": KEY},
        {"actuator": KEY},
        {"cache_dir": [KEY]},
        {"prices": {"gpt-4o": KEY}},
        {"llm": {"kind": "openai", "base_url": f"https://me:{KEY[3:]}@example.org/v1"}},
        {"llm": {"kind": "openai", "base_url": f"https://example.org/v1?{KEY[3:]}"}},
    ],
)
def test_no_error_shows_a_key(settings: dict[str, object]) -> None:
    with pytest.raises(ConfigError) as caught:
        BakeConfig.parse(settings)
    assert KEY[3:] not in "".join(traceback.format_exception(caught.value))
    assert KEY[3:] not in repr(caught.value.__cause__)
