"""Secrets: a key is masked in every representation, in texts and in tracebacks."""

import copy
import html
import json
import pickle
import traceback
from base64 import b32encode, b64encode, encodebytes, urlsafe_b64encode
from collections.abc import Callable
from pathlib import Path
from typing import Any
from urllib.parse import quote

import pytest

from scene2hap import (
    BakeConfig,
    LexiconBackend,
    LocalBackend,
    OpenAIBackend,
    RecordingBackend,
    SerialAmplifierSink,
    UdpSink,
)
from scene2hap.audio.sources.freesound import Freesound
from scene2hap.audio.sources.text_to_audio import TextToAudio
from scene2hap.common import checks
from scene2hap.common.checks import MASK
from scene2hap.common.secret import Secret
from scene2hap.errors import CallError, ConfigError, Scene2HapError

KEY = "sk-0123456789abcdef"


@pytest.mark.parametrize("value", ["sk-0123456789abcdef", None])
def test_secret_is_masked_in_str_and_repr(value: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("A_KEY", "sk-0123456789abcdef")
    secret = Secret(value, "A_KEY")
    assert f"{secret} {secret!r} {[secret]}" == "Secret(******) Secret(******) [Secret(******)]"
    assert secret.reveal() == "sk-0123456789abcdef"
    assert secret.scrub("Bearer sk-0123456789abcdef!") == "Bearer ******!"


@pytest.mark.parametrize("key", ["ab/cd+0123456789==", 'with"quote0123456789', "back\\slash0123456789"])
def test_a_key_is_found_as_json_writes_it(key: str) -> None:
    secret = Secret(key)
    written = json.dumps({"error": key})
    assert json.loads(secret.scrub(written)) == {"error": "******"}
    assert json.loads(secret.scrub(written.replace("/", "\\/"))) == {"error": "******"}


ECHOES: dict[str, Callable[[str], str]] = {
    "percent-encoded": lambda key: quote(key, safe=""),
    "percent-encoded whole": lambda key: "".join(f"%{ord(letter):02X}" for letter in key),
    "percent-encoded twice": lambda key: quote(quote(key, safe=""), safe=""),
    "base64": lambda key: b64encode(key.encode()).decode(),
    "base64 of the header": lambda key: b64encode(f"Bearer {key}".encode()).decode(),
    "base64 of basic": lambda key: b64encode(f"me:{key}:x".encode()).decode(),
    "base64 for addresses": lambda key: urlsafe_b64encode(f"x{key}".encode()).decode().rstrip("="),
    "base64, percent-encoded": lambda key: quote(b64encode(key.encode()).decode(), safe=""),
    "base64 in JSON of PHP": lambda key: b64encode(key.encode()).decode().replace("/", "\\/"),
    "base64 in lines": lambda key: encodebytes(f"{'.' * 50}{key}".encode()).decode(),
    "hex": lambda key: key.encode().hex(),
    "hex with colons": lambda key: key.encode().hex(":").upper(),
    "JSON escapes": lambda key: "".join(f"\\u{ord(letter):04x}" for letter in key),
    "C escapes": lambda key: "".join(f"\\x{ord(letter):02x}" for letter in key),
    "HTML": lambda key: html.escape(key),
    "HTML numbers": lambda key: "".join(f"&#{ord(letter)};" for letter in key),
    "HTML hex numbers": lambda key: "".join(f"&#x{ord(letter):x};" for letter in key),
    "capitals": lambda key: key.upper(),
    "JSON in JSON": lambda key: json.dumps(json.dumps(key)),
    "backwards": lambda key: key[::-1],
    "base64 of UTF-16": lambda key: b64encode(key.encode("utf-16")).decode(),
    "base64 of UTF-16, big endian": lambda key: b64encode(key.encode("utf-16-be")).decode(),
    "base64 of UTF-32": lambda key: b64encode(key.encode("utf-32")).decode(),
    "base64 twice": lambda key: b64encode(b64encode(key.encode())).decode(),
    "base64 of hex": lambda key: b64encode(key.encode().hex().encode()).decode(),
    "base64, backwards": lambda key: b64encode(key[::-1].encode()).decode(),
    "base64 in lines of JSON": lambda key: encodebytes(f"{'.' * 50}{key}".encode()).decode().replace("\n", "\\n"),
    "base32": lambda key: b32encode(f"xy{key}".encode()).decode(),
    "hex of UTF-16": lambda key: key.encode("utf-16-le").hex(),
    "hex as in C": lambda key: ", ".join(f"0x{byte:02x}" for byte in key.encode()),
    "quoted-printable": lambda key: "".join(f"={byte:02X}" for byte in key.encode()),
    "quoted-printable in lines": lambda key: "=\r\n".join([key[:7], key[7:14], key[14:]]),
    "lines": lambda key: "\n    ".join([key[:7], key[7:14], key[14:]]),
    "letters": lambda key: str(list(key)),
    "numbers": lambda key: str(list(key.encode())),
    "octal": lambda key: "".join(f"\\{byte:03o}" for byte in key.encode()),
    "HTML twice": lambda key: html.escape("".join(f"&#{ord(letter)};" for letter in key)),
    "full width": lambda key: "".join(chr(ord(letter) + 0xFEE0) for letter in key),
    "colours of a terminal": lambda key: "\x1b[0m".join(key),
    "UTF-16 as bytes of Python": lambda key: repr(key.encode("utf-16-le")),
}


@pytest.mark.parametrize(
    "key", ["sk-proj-0123456789abcdefgh", "ab/cd+0123456789==", "a&b<c>'d'0123456789", "~~~???>>>ii0123456"]
)
@pytest.mark.parametrize("form", ECHOES)
def test_a_key_is_found_however_it_is_written(form: str, key: str) -> None:
    echoed = ECHOES[form](key)
    shown = Secret(key).scrub(f"You sent {echoed}, which is wrong.")
    assert shown.startswith("You sent ")
    assert shown.endswith(" is wrong.")
    assert MASK in shown
    left = shown.removeprefix("You sent ").removesuffix(", which is wrong.").replace(MASK, "")
    assert len(left) <= len(echoed) - len(key)  # the rest of an escape that also encoded the key
    assert not any(key[at : at + 4] in left for at in range(len(key) - 3))
    assert Secret(key).scrub(echoed) == shown.removeprefix("You sent ").removesuffix(", which is wrong.")


def test_text_without_the_key_stays_as_it_is() -> None:
    text = "sk-0123456 c2stMDEyMzQ1 73 6b 2d &amp; %2F \\u0041 \x1b[2J &#65; =3D ＡＢＣ"
    assert Secret(KEY).scrub(text) == text


@pytest.mark.parametrize("part", [KEY[1:], KEY[:-2], KEY[3:-1]])
def test_most_of_a_key_counts_as_the_key(part: str) -> None:
    assert Secret(KEY).scrub(f"You sent {part}.") == "You sent ******."


def test_text_around_a_key_is_kept_including_partial_escapes() -> None:
    text = f'{{"a": "%41{KEY}&amp;", "b": "\\u0041\\u0073{KEY[1:]}\\n"}}'
    assert Secret(KEY).scrub(text) == '{"a": "%41******&amp;", "b": "\\u0041******\\n"}'


@pytest.mark.parametrize("piece", ["\\", "&#", "0", "%25", "\x1b[0;", KEY[:9], "=", "&amp;"])
def test_masking_time_is_linear_in_text_length(piece: str) -> None:
    secret = Secret(KEY)
    assert secret.scrub(piece * 200_000) == piece * 200_000


def test_short_keys_are_not_masked_in_answers() -> None:
    assert Secret("lm-studio").scrub("made by lm-studio") == "made by lm-studio"


@pytest.mark.parametrize("variable", ["", "OPENAI_API_KEY"])
def test_a_given_key_is_not_pickled_but_may_be_copied(variable: str) -> None:
    secret = Secret(KEY, variable)
    with pytest.raises(CallError, match=f"environment variable {variable}".rstrip()) as caught:
        pickle.dumps(secret)
    assert KEY not in str(caught.value)
    assert copy.deepcopy(secret) is secret


def test_backends_are_pickled_without_the_key_of_the_environment(monkeypatch: pytest.MonkeyPatch) -> None:
    """A sweep sends its settings to worker processes, and each reads the key from its own environment."""
    monkeypatch.setenv("OPENAI_API_KEY", KEY)
    for made in (
        OpenAIBackend("gpt-4o", top_p=0.5),
        LocalBackend("llama3", base_url="http://localhost:11434/v1"),
        BakeConfig(llm={"kind": "openai", "model": "gpt-4o"}),
    ):
        pickled = pickle.dumps(made)
        assert KEY.encode() not in pickled
        assert repr(pickle.loads(pickled)) == repr(made)
    assert pickle.loads(pickle.dumps(Secret(None, "OPENAI_API_KEY"))).reveal() == KEY
    for with_key in (OpenAIBackend(api_key=KEY), LocalBackend("a", base_url="http://localhost:1/v1", api_key=KEY)):
        with pytest.raises(CallError, match="a service with a key cannot be pickled"):
            pickle.dumps(with_key)


def test_what_belongs_to_one_process_says_so(tmp_path: Path) -> None:
    for made, reason in (
        (UdpSink(), "a UdpSink cannot be copied or pickled: it has a thread and a device"),
        (SerialAmplifierSink("/dev/ttyACM0"), "a SerialAmplifierSink cannot"),
        (RecordingBackend(LexiconBackend(), tmp_path / "answers.jsonl"), "two processes would write to its file"),
        (Freesound(token=KEY), "counts the requests"),
        (TextToAudio(command=["make-sounds"]), "once at a time"),
        (BakeConfig(llm="openai", max_cost_usd=2.0), "max_cost = 2 cannot .* spend as much again"),
    ):
        with pytest.raises(Scene2HapError, match=reason):
            pickle.dumps(made)


def test_invalid_key_is_not_in_local_variables_of_the_traceback() -> None:
    secret = Secret(f"{KEY}\n{KEY}")
    with pytest.raises(ConfigError) as caught:
        secret.reveal()
    within = caught.value.__traceback__.tb_next
    shown = traceback.TracebackException(ConfigError, caught.value, within, capture_locals=True)
    assert KEY not in "".join(shown.format())


@pytest.mark.parametrize("name", ["token", "api_keys", "Password", "credentials"])
def test_a_setting_that_may_be_a_key_has_the_same_mask(name: str) -> None:
    assert checks.shown("hunter2", name) == checks.shown({name: "hunter2"})[len(repr(name)) + 3 : -1] == "'******'"


def test_credentials_and_queries_of_an_address_have_the_same_mask() -> None:
    assert checks.shown("https://me:pw@host/x") == "'https://******@host/x'"
    assert checks.shown("https://host/x?token=abc") == "'https://host/x?******'"
