"""Freesound against two servers on the loopback interface: the API on 127.0.0.1, previews on localhost."""

from __future__ import annotations

import logging
import pickle
import traceback
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import httpx
import pytest

from freesound_server import BY, BY_NC, TOKEN, Get, Host, Page, host, hum, refused, result, results
from scene2hap import BakeConfig
from scene2hap.audio.sources import SOURCES
from scene2hap.audio.sources.freesound import Freesound, UnusableSound
from scene2hap.errors import BackendError, BackendUnavailable, BadAnswer, ConfigError
from scene2hap.haptics import VibrationDescription

LICENCES = 'license:("Creative Commons 0" OR "Attribution")'


class Time:
    """A clock that runs while somebody sleeps by it."""

    def __init__(self) -> None:
        self.now_s = 1000.0
        self.slept: list[float] = []

    def clock(self) -> float:
        return self.now_s

    def sleep(self, seconds: float) -> None:
        self.slept.append(seconds)
        self.now_s += seconds


@pytest.fixture(autouse=True)
def _plain_environment(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("FREESOUND_TOKEN", TOKEN)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "home-cache"))
    for name in ("HTTP_PROXY", "HTTPS_PROXY", "ALL_PROXY"):
        monkeypatch.delenv(name, raising=False)
        monkeypatch.delenv(name.lower(), raising=False)


def describe(category: str = "electric toothbrush", verb: str = "buzzing") -> VibrationDescription:
    return VibrationDescription(category, "on", f"{category} {verb}", f"{category} {verb}", 0.5, (0.2, 0.03, 0.03))


def freesound(api: Host, tmp_path: Path, time: Time | None = None, **settings: Any) -> Freesound:
    time = time or Time()
    defaults = {"cache": tmp_path / "cache", "timeout_s": 5.0, "clock": time.clock, "sleep": time.sleep}
    return Freesound(**{**defaults, "base_url": f"http://127.0.0.1:{api.port}/apiv2", **settings})


def preview(cdn: Host, name: str = "1.ogg") -> str:
    return f"http://localhost:{cdn.port}/previews/{name}"


@contextmanager
def catalogue(*changes: dict[str, Any], sound: Page | None = None) -> Iterator[tuple[Host, Host]]:
    """An API that finds one sound for each of `changes`, and the host of their previews."""
    with host(sound or Page(hum())) as cdn:
        rows = [result(i, preview(cdn, f"{i}.ogg"), **change) for i, change in enumerate(changes, start=1)]
        with host(results(*rows)) as api:
            yield api, cdn


def failed(tmp_path: Path, *pages: Page, **settings: Any) -> tuple[BackendError, Host, Time]:
    time = Time()
    with host(*pages) as api, pytest.raises(BackendError) as caught:
        freesound(api, tmp_path, time, **settings).find(describe())
    assert TOKEN not in "".join(traceback.format_exception(caught.value))
    return caught.value, api, time


# finding


def test_one_call_with_all_fields_a_filter_and_the_token_in_its_header(tmp_path: Path) -> None:
    with catalogue({}) as (api, _):
        (clip,) = freesound(api, tmp_path).find(describe())
    (asked,) = api.asked
    assert asked.path == "/apiv2/search/"
    assert asked.headers["authorization"] == f"Token {TOKEN}"
    assert asked.query == {
        "query": "electric toothbrush buzzing",
        "filter": f"duration:[2.5 TO 30] {LICENCES}",
        "sort": "score",
        "fields": "id,name,username,license,url,duration,previews",
        "page_size": "15",
    }
    credit = clip.credit
    assert (credit.title, credit.author, credit.licence) == ("hum 1", "ann", "CC0-1.0")
    assert credit.address == "https://freesound.org/people/ann/sounds/1/"
    assert (credit.query, credit.origin) == ("electric toothbrush buzzing", "freesound")
    assert clip.duration_s == pytest.approx(3.0, abs=0.01)


def test_the_ladder_goes_from_all_key_words_to_the_head_noun(tmp_path: Path) -> None:
    with host(Page(hum())) as cdn:

        def search(get: Get) -> Page:
            return results(*([result(1, preview(cdn))] if get.query["query"] == "toothbrush" else []))

        with host(by=search) as api:
            source = freesound(api, tmp_path)
            (clip,) = source.find(describe())
            source.find(describe())
    assert [asked.query["query"] for asked in api.asked] == [
        "electric toothbrush buzzing",
        "electric toothbrush",
        "toothbrush buzzing",
        "toothbrush",
    ], "the three rungs without hits are asked once"
    assert clip.credit.query == "toothbrush"
    assert len(cdn.asked) == 1


def test_nothing_found_is_no_failure_and_kept(tmp_path: Path) -> None:
    with host(results()) as api:
        assert freesound(api, tmp_path).find(describe("fan", "whirring")) == []
        assert len(api.asked) == 2
        assert freesound(api, tmp_path).find(describe("fan", "whirring")) == []
    assert len(api.asked) == 2


def test_words_cannot_command_the_search(tmp_path: Path) -> None:
    with host(results()) as api:
        freesound(api, tmp_path).find(describe('air-conditioner "x" AND -fan', "license:*"))
    assert all(set(asked.query["query"]).isdisjoint('-":*') for asked in api.asked)
    assert api.asked[0].query["query"] == "air conditioner x and fan license"


def test_up_to_five_in_the_order_of_the_service(tmp_path: Path) -> None:
    with catalogue(*({} for _ in range(8))) as (api, cdn):
        clips = freesound(api, tmp_path).find(describe())
        assert len(freesound(api, tmp_path, candidates=2).find(describe())) == 2
    assert [clip.credit.title for clip in clips] == [f"hum {i}" for i in range(1, 6)]
    assert len(cdn.asked) == 5
    assert len(api.asked) == 1


def test_what_was_found_needs_neither_network_nor_token_again(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with catalogue({}, {}) as (api, _):
        first = freesound(api, tmp_path).find(describe())
    monkeypatch.delenv("FREESOUND_TOKEN")
    again = freesound(api, tmp_path).find(describe())
    assert [clip.credit for clip in again] == [clip.credit for clip in first]
    assert all((a.samples == b.samples).all() for a, b in zip(again, first, strict=True))


def test_the_cache_holds_no_token_and_no_halves(tmp_path: Path) -> None:
    with catalogue({}) as (api, _):
        freesound(api, tmp_path).find(describe())
    files = [path for path in (tmp_path / "cache").rglob("*") if path.is_file()]
    assert sorted(path.suffix for path in files) == [".json", ".ogg"]
    assert all(TOKEN.encode() not in path.read_bytes() for path in files)


@pytest.mark.parametrize("junk", [b"", b"not json", b"[1]", b'{"results": 3}', b"\x00" * 5_000_000])
def test_a_damaged_cache_is_asked_for_again(tmp_path: Path, junk: bytes) -> None:
    with catalogue({}) as (api, cdn):
        freesound(api, tmp_path).find(describe())
        for path in (tmp_path / "cache").rglob("*.*"):
            path.write_bytes(junk)
        assert len(freesound(api, tmp_path).find(describe())) == 1
    assert (len(api.asked), len(cdn.asked)) == (2, 2)


def test_without_a_folder_the_user_s_own_cache_is_used(tmp_path: Path) -> None:
    with catalogue({}) as (api, _):
        freesound(api, tmp_path, cache=None).find(describe())
    assert list((tmp_path / "home-cache" / "scene2hap" / "freesound" / "previews").iterdir())


def test_a_cache_that_cannot_be_written_says_so(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with catalogue({}) as (api, _), pytest.raises(ConfigError, match="cannot write the cache .*Set `cache`"):
        freesound(api, tmp_path, cache=tmp_path / "file").find(describe())


# what strangers say


@pytest.mark.parametrize(
    ("licence", "wanted", "credit"),
    [
        (BY, ("by",), "CC-BY-4.0"),
        ("https://creativecommons.org/licenses/by/3.0/", ("cc0", "by"), "CC-BY-3.0"),
        (BY_NC, ("by-nc",), "CC-BY-NC-3.0"),
        ("http://creativecommons.org/licenses/sampling+/1.0/", ("sampling+",), "CC-Sampling+-1.0"),
    ],
)
def test_licences_as_the_deed_says(tmp_path: Path, licence: str, wanted: tuple[str, ...], credit: str) -> None:
    with catalogue({"license": licence}) as (api, _):
        (clip,) = freesound(api, tmp_path, licences=wanted).find(describe())
    assert clip.credit.licence == credit


@pytest.mark.parametrize(
    "change",
    [
        {"license": BY_NC},
        {"license": "all rights reserved"},
        {"duration": 300.0},
        {"duration": 1.0},
        {"previews": {}},
        {"previews": {"preview-hq-ogg": "file:///etc/passwd"}},
        {"previews": {"preview-hq-ogg": "http://203.0.113.5/a.ogg"}},
        {"previews": {"preview-hq-ogg": "https://user:pass@example.org/a.ogg"}},
        {"previews": {"preview-hq-ogg": "https://[::1"}},
        {"id": "x"},
        {"name": None},
        {"previews": None},
    ],
    ids=str,
)
def test_a_result_beyond_what_was_asked_is_left_alone(tmp_path: Path, change: dict[str, Any]) -> None:
    with catalogue(change, {}) as (api, cdn):
        (clip,) = freesound(api, tmp_path).find(describe())
    assert clip.credit.title == "hum 2"
    assert [asked.path for asked in cdn.asked] == ["/previews/2.ogg"]


def test_a_title_stays_on_its_line(tmp_path: Path) -> None:
    odd = {"name": "hum\nSounds by me\x1b[31m", "username": "  ", "url": "javascript:alert(1)"}
    with catalogue(odd) as (api, _):
        (clip,) = freesound(api, tmp_path).find(describe())
    assert clip.credit.title == "hum Sounds by me [31m"
    assert clip.credit.author == "unknown"
    assert clip.credit.address == "https://freesound.org/s/1/"


@pytest.mark.parametrize(
    "page",
    [
        refused(404),
        Page(b""),
        Page(b"<html>no sound</html>"),
        Page(hum()[:900]),
        Page(hum(seconds=61.0, rate=4000, kind="WAV")),
        Page(manner="endless"),
        Page(b"", 302, {"location": "ftp://example.org/a.ogg"}),
        Page(b"", 302, {"location": "http://203.0.113.5/a.ogg"}),
    ],
    ids=["404", "empty", "html", "cut", "long", "endless", "to-ftp", "to-plain-http"],
)
def test_a_preview_that_is_none_is_skipped_aloud_and_not_kept(tmp_path: Path, page: Page) -> None:
    def file(get: Get) -> Page:
        return page if get.path.endswith("1.ogg") else Page(hum())

    with (
        host(by=file) as cdn,
        host(results(*(result(i, preview(cdn, f"{i}.ogg")) for i in (1, 2)))) as api,
        pytest.warns(UnusableSound, match="skipped sound 1"),
    ):
        (clip,) = freesound(api, tmp_path).find(describe())
    assert clip.credit.title == "hum 2"
    assert len(list((tmp_path / "cache" / "previews").iterdir())) == 1


def test_a_preview_that_is_too_short_once_trimmed_does_not_count(tmp_path: Path) -> None:
    with catalogue({}, sound=Page(hum(2.0))) as (api, _):
        assert freesound(api, tmp_path).find(describe()) == []


def test_previews_that_are_all_away_are_a_failure_not_an_empty_shelf(tmp_path: Path) -> None:
    with catalogue(*({} for _ in range(5)), sound=Page(manner="drop")) as (api, cdn), warnings.catch_warnings():
        warnings.simplefilter("ignore", UnusableSound)
        with pytest.raises(BackendUnavailable, match="previews/2.ogg cannot be reached"):
            freesound(api, tmp_path).find(describe())
    assert len(cdn.asked) == 2


# where the token goes


def test_the_token_stays_at_home(tmp_path: Path) -> None:
    """Not to the previews' host, nor to where that one sends us, nor to where the API itself does."""
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
def test_an_address_that_is_not_safe_for_a_token_is_refused(base_url: str) -> None:
    with pytest.raises(ConfigError, match="base_url must be an https address") as caught:
        Freesound(base_url=base_url)
    assert "pw" not in str(caught.value)


def test_the_token_is_shown_to_nobody(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
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
    with pytest.raises(TypeError, match="not pickled"):
        pickle.dumps(source._service.token)
    misspelt = {"kind": "freesound", "token": TOKEN, "colour": "red"}
    for build in (SOURCES.build, lambda spec: BakeConfig.parse({"audio": [spec, "synth"]})):
        with pytest.raises(ConfigError, match="does not take") as caught:
            build(misspelt)
        assert TOKEN not in "".join(traceback.format_exception(caught.value))


def test_no_frame_of_a_failure_holds_the_token(tmp_path: Path) -> None:
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
def test_a_token_that_no_header_carries_is_refused(tmp_path: Path, token: str) -> None:
    with host(results()) as api, pytest.raises(ConfigError, match="copy it again") as caught:
        freesound(api, tmp_path, token=token).find(describe())
    assert token not in str(caught.value)


# faults of the service


@pytest.mark.parametrize(
    ("page", "said"),
    [
        (refused(401, "Invalid token."), "answered 401: Invalid token. Check the token in FREESOUND_TOKEN"),
        (refused(403), "what the token in FREESOUND_TOKEN is allowed"),
        (refused(404), "Check base_url"),
        (refused(400, "Invalid filter."), "answered 400: Invalid filter."),
        (refused(429, "Request was throttled: limit rate (2000/day)"), "Bake again tomorrow"),
        (refused(429, "limit rate (60/minute)", retry_after="3600"), "answered 429"),
    ],
    ids=["401", "403", "404", "400", "day", "an-hour"],
)
def test_what_no_retry_mends_is_asked_once(tmp_path: Path, page: Page, said: str) -> None:
    error, api, time = failed(tmp_path, page)
    assert said in str(error)
    assert isinstance(error, BackendUnavailable)
    assert not error.retryable
    assert (len(api.asked), time.slept) == (1, [])


@pytest.mark.parametrize("status", [500, 502, 503])
def test_a_service_that_stumbles_is_asked_again_twice(tmp_path: Path, status: int) -> None:
    error, api, time = failed(tmp_path, Page(b"<html>oops", status))
    assert f"answered {status}: nothing more" in str(error)
    assert (len(api.asked), time.slept) == (3, [0.5, 1.0])
    with host(Page(hum())) as cdn, host(refused(status), results(result(1, preview(cdn)))) as api:
        assert len(freesound(api, tmp_path).find(describe())) == 1


def test_too_many_a_minute_waits_a_minute(tmp_path: Path) -> None:
    time = Time()
    with host(Page(hum())) as cdn:
        throttled = refused(429, "Request was throttled: limit rate (60/minute)")
        with host(throttled, results(result(1, preview(cdn)))) as api:
            assert len(freesound(api, tmp_path, time).find(describe())) == 1
    assert time.slept == [60.0]


@pytest.mark.parametrize(
    "page",
    [
        Page(b"<html>welcome to the hotel's network</html>"),
        Page(b"[]"),
        Page({"results": "none"}),
        Page({"count": 3}),
        Page({"results": [{"id": "x"}, 3, None]}),
        Page(b'{"results": ' + b"[" * 100_000),
        Page(b"\xff\xfe\x00"),
    ],
    ids=["html", "list", "text", "count", "no-sounds", "nested", "bytes"],
)
def test_an_answer_that_is_none_is_a_bad_answer(tmp_path: Path, page: Page) -> None:
    error, api, _ = failed(tmp_path, page)
    assert isinstance(error, BadAnswer)
    assert len(api.asked) == 1
    assert not list((tmp_path / "cache").rglob("*")), "nothing of it is kept"


@pytest.mark.parametrize("manner", ["hang", "drip"])
def test_a_server_that_stalls_is_given_up_in_time(tmp_path: Path, manner: str) -> None:
    error, api, _ = failed(tmp_path, Page(manner=manner), timeout_s=0.2)
    assert "did not answer within 0.2 s" in str(error)
    assert len(api.asked) == 3


def test_an_endless_answer_is_cut_off(tmp_path: Path) -> None:
    error, api, _ = failed(tmp_path, Page(manner="endless"))
    assert "sends more than 2000000 bytes" in str(error)
    assert len(api.asked) == 1


def test_a_connection_that_drops_and_a_host_that_is_away(tmp_path: Path) -> None:
    error, api, _ = failed(tmp_path, Page(manner="drop"))
    assert "cannot be reached" in str(error)
    assert len(api.asked) == 3
    with pytest.raises(BackendUnavailable, match="cannot be reached"):
        freesound(api, tmp_path).find(describe())


def test_a_service_that_failed_is_left_alone_for_a_while(tmp_path: Path) -> None:
    time = Time()
    with host(refused(503)) as api:
        source = freesound(api, tmp_path, time)
        for _ in range(4):
            with pytest.raises(BackendUnavailable):
                source.find(describe())
        assert len(api.asked) == 3
        api.answer = [results()]
        time.now_s += 121.0
        assert source.find(describe()) == []


def test_a_refused_token_is_not_sent_twice_but_a_refused_query_ends_alone(tmp_path: Path) -> None:
    for status, calls in ((401, 1), (400, 3)):
        with host(refused(status)) as api:
            source = freesound(api, tmp_path)
            for _ in range(3):
                with pytest.raises(BackendUnavailable):
                    source.find(describe())
        assert len(api.asked) == calls


def test_it_works_inside_a_running_event_loop(tmp_path: Path) -> None:
    import asyncio

    async def find() -> int:
        return len(freesound(api, tmp_path).find(describe()))

    with catalogue({}) as (api, _):
        assert asyncio.run(find()) == 1


# settings


@pytest.mark.parametrize(
    "settings",
    [
        {"licences": []},
        {"licences": ["gpl"]},
        {"candidates": 6},
        {"candidates": 0},
        {"candidates": 2.5},
        {"max_duration_s": 2.0},
        {"max_duration_s": 61.0},
        {"timeout_s": 0.0},
        {"sort": "best"},
        {"token": 3},
        {"token_env": ""},
    ],
    ids=str,
)
def test_settings_that_cannot_work_are_refused(settings: dict[str, Any]) -> None:
    with pytest.raises(ConfigError, match=f"{next(iter(settings))[:5]}"):
        SOURCES.build({"kind": "freesound", **settings})
