"""Invalid settings of LLM backends are refused."""

from typing import Any

import pytest

from scene2hap import (
    LocalBackend,
    OpenAIBackend,
)
from scene2hap.errors import ConfigError


@pytest.mark.parametrize(
    ("make", "named"),
    [
        (lambda: OpenAIBackend(detail="original"), "detail is 'original'"),
        (lambda: OpenAIBackend(base_url="api.openai.com"), "base_url is 'api.openai.com'"),
        (lambda: OpenAIBackend(timeout_s=0), "timeout_s is 0 s"),
        (lambda: OpenAIBackend(api_key=b"secret"), "an API key or token must be a text"),
        (lambda: OpenAIBackend(top_p=0), "top_p is 0"),
        (lambda: OpenAIBackend(max_tokens=0), "max_tokens is 0 tokens"),
        (lambda: OpenAIBackend(max_tokens=9.5), "max_tokens is 9.5; it must be a whole number"),
        (lambda: OpenAIBackend(seed=True), "seed is True; it must be a number"),
        (lambda: LocalBackend("m", base_url="http://a", seed=True), "seed is True; it must be a number"),
        (lambda: LocalBackend("m", base_url="http://a", seed=0.5), "seed is 0.5; it must be a whole number"),
        (lambda: LocalBackend("m", base_url="http://a", top_p=1.5), "top_p is 1.5"),
        (lambda: LocalBackend("m", base_url="http://a", extra={"messages": []}), "extra sets messages"),
        (
            lambda: LocalBackend("m", base_url="http://a", dialect="ollama", chat_template_kwargs={}),
            "Ollama has no chat_template_kwargs",
        ),
        (lambda: LocalBackend("m", base_url="http://a", dialect="tgi"), "dialect is 'tgi'"),
        (lambda: LocalBackend("m", base_url="http://a", num_ctx=0), "num_ctx is 0 tokens"),
    ],
)
def test_invalid_settings_are_refused(make: Any, named: str) -> None:
    with pytest.raises(ConfigError, match=named):
        make()
