"""The Freesound token is sent only to the API host, and never shown."""

from __future__ import annotations

import logging
import pickle
import traceback
from pathlib import Path

import httpx
import pytest

from freesound_asking import catalogue, describe, failed, freesound
from freesound_server import TOKEN, Page, host, hum, refused, results
from scene2hap import BakeConfig
from scene2hap.audio.sources import SOURCES
from scene2hap.audio.sources.freesound import Freesound
from scene2hap.errors import BackendUnavailable, BadAnswer, CallError, ConfigError


def test_token_is_sent_only_to_the_api_host(tmp_path: Path) -> None:
    """It is not sent to the host of the previews, nor to a target of a redirect."""
    with host(Page(hum())) as third:
        moved = Page(b"", 302, {"location": f"http://localhost:{third.port}/a.ogg"})
        with catalogue({}, sound=moved) as (api, cdn):
            (clip,) = freesound(api, tmp_path).find(describe())
    assert clip.credit.title == "hum 1"
    assert api.tokens == [f"Token {TOKEN}"]
    assert cdn.tokens == third.tokens == [""]
    for status in (301, 302, 307, 308):
        with host(results()) as elsewhere:
            away = Page(b"", status, {"location": f"http://localhost:{elsewhere.port}/apiv2/search/"})
            error, _, _ = failed(tmp_path / str(status), away)
        assert elsewhere.asked == []
        assert "The token is not sent elsewhere" in str(error)


@pytest.mark.parametrize(
    "base_url",
    [
        "http://freesound.org/apiv2",
        "https://me:pw@freesound.org",
        "https://freesound.org/?token=x",
        "freesound.org",
        "",
    ],
)
def test_insecure_address_is_refused(base_url: str) -> None:
    with pytest.raises(ConfigError, match="base_url must be an https address") as caught:
        Freesound(base_url=base_url)
    assert "pw" not in str(caught.value)


def test_token_is_masked_everywhere(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    caplog.set_level(logging.DEBUG)
    echo, _, _ = failed(tmp_path, refused(401, f"bad token {TOKEN}"))
    assert "bad token ******" in str(echo)
    junk, _, _ = failed(tmp_path / "2", Page(f"<html>{TOKEN}".encode()))
    assert isinstance(junk, BadAnswer)
    assert junk.raw_text == "<html>******"
    with host(results()) as api:
        source = freesound(api, tmp_path, token=TOKEN)
        source.find(describe())
    assert TOKEN not in repr(source) + str(vars(source)) + caplog.text
    with pytest.raises(CallError, match="cannot be pickled") as kept:
        pickle.dumps(source._service.token)
    assert TOKEN not in str(kept.value)
    misspelt = {"kind": "freesound", "token": TOKEN, "colour": "red"}
    for build in (SOURCES.build, lambda spec: BakeConfig.parse({"audio": [spec, "synth"]})):
        with pytest.raises(ConfigError, match="does not take") as caught:
            build(misspelt)
        assert TOKEN not in "".join(traceback.format_exception(caught.value))


def test_no_traceback_frame_contains_the_token(tmp_path: Path) -> None:
    error, _, _ = failed(tmp_path, Page(manner="drop"))
    seen: BaseException | None = error.__cause__
    assert isinstance(seen, httpx.HTTPError)
    while seen is not None:
        assert seen.__traceback__ is None
        seen = seen.__cause__ or seen.__context__


def test_without_a_token_nothing_is_sent(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("FREESOUND_TOKEN", " ")
    error, api, _ = failed(tmp_path, results())
    assert "Set FREESOUND_TOKEN" in str(error)
    assert api.asked == []
    with host(results()) as api, pytest.raises(BackendUnavailable, match="Set MY_TOKEN"):
        freesound(api, tmp_path, token_env="MY_TOKEN").find(describe())


@pytest.mark.parametrize("token", ["a\nb", "schlüssel"])
def test_token_invalid_in_a_header_is_refused(tmp_path: Path, token: str) -> None:
    with host(results()) as api, pytest.raises(ConfigError, match="copy it again") as caught:
        freesound(api, tmp_path, token=token).find(describe())
    assert token not in str(caught.value)
