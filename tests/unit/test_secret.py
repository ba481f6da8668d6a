"""A key that shows itself to nobody."""

import copy
import pickle
import traceback
from typing import Any

import pytest

from scene2hap.errors import ConfigError
from scene2hap.secret import Secret

KEY = "sk-0123456789abcdef"


@pytest.mark.parametrize("value", ["sk-0123456789abcdef", None])
def test_secret_shows_itself_to_nobody(value: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("A_KEY", "sk-0123456789abcdef")
    secret = Secret(value, "A_KEY")
    assert f"{secret} {secret!r} {[secret]}" == "Secret(******) Secret(******) [Secret(******)]"
    assert secret.reveal() == "sk-0123456789abcdef"
    assert secret.scrub("Bearer sk-0123456789abcdef!") == "Bearer ******!"


@pytest.mark.parametrize("key", ["ab/cd+0123456789==", 'with"quote0123456789', "back\\slash0123456789"])
def test_a_key_is_found_as_json_writes_it(key: str) -> None:
    import json

    secret = Secret(key)
    written = json.dumps({"error": key})
    assert json.loads(secret.scrub(written)) == {"error": "******"}
    assert json.loads(secret.scrub(written.replace("/", "\\/"))) == {"error": "******"}


def test_a_short_key_is_a_word_that_answers_may_hold() -> None:
    assert Secret("lm-studio").scrub("made by lm-studio") == "made by lm-studio"


def test_a_secret_is_not_pickled_but_may_be_copied() -> None:
    secret = Secret(KEY)
    with pytest.raises(TypeError, match="not pickled"):
        pickle.dumps(secret)
    assert copy.deepcopy(secret) is secret


def test_a_key_that_no_header_may_carry_is_not_among_the_local_variables() -> None:
    secret = Secret(f"{KEY}\n{KEY}")
    with pytest.raises(ConfigError) as caught:
        secret.reveal()
    within = caught.value.__traceback__.tb_next  # type: ignore[union-attr]
    shown = traceback.TracebackException(ConfigError, caught.value, within, capture_locals=True)
    assert KEY not in "".join(shown.format())
