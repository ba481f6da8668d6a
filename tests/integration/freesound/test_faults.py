"""Faults of the Freesound service: errors, retries and timeouts."""

from __future__ import annotations

from pathlib import Path

import pytest

from freesound_asking import Time, catalogue, describe, failed, freesound, preview
from freesound_server import Page, host, hum, refused, result, results
from scene2hap.errors import BackendUnavailable, BadAnswer


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
def test_permanent_errors_are_not_retried(tmp_path: Path, page: Page, said: str) -> None:
    error, api, time = failed(tmp_path, page)
    assert said in str(error)
    assert isinstance(error, BackendUnavailable)
    assert not error.retryable
    assert (len(api.asked), time.slept) == (1, [])


@pytest.mark.parametrize("status", [500, 502, 503])
def test_temporary_errors_are_retried_twice(tmp_path: Path, status: int) -> None:
    error, api, time = failed(tmp_path, Page(b"<html>oops", status))
    assert f"answered {status}: nothing more" in str(error)
    assert (len(api.asked), time.slept) == (3, [0.5, 1.0])
    with host(Page(hum())) as cdn, host(refused(status), results(result(1, preview(cdn)))) as api:
        assert len(freesound(api, tmp_path).find(describe())) == 1


def test_rate_limit_waits_a_minute(tmp_path: Path) -> None:
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
def test_invalid_response_is_a_bad_answer(tmp_path: Path, page: Page) -> None:
    error, api, _ = failed(tmp_path, page)
    assert isinstance(error, BadAnswer)
    assert len(api.asked) == 1
    assert not list((tmp_path / "cache").rglob("*")), "nothing of it is kept"


@pytest.mark.parametrize("manner", ["hang", "drip"])
def test_stalled_server_runs_into_the_timeout(tmp_path: Path, manner: str) -> None:
    error, _, time = failed(tmp_path, Page(manner=manner), timeout_s=0.2)
    assert "did not answer within 0.2 s" in str(error)
    assert time.slept == [0.5, 1.0]  # retried, since a busy server may not have read the first request


def test_endless_response_is_cut_off(tmp_path: Path) -> None:
    error, api, _ = failed(tmp_path, Page(manner="endless"))
    assert "sends more than 2000000 bytes" in str(error)
    assert len(api.asked) == 1


def test_lost_connection_and_missing_host_are_reported(tmp_path: Path) -> None:
    error, api, _ = failed(tmp_path, Page(manner="drop"))
    assert "cannot be reached" in str(error)
    assert len(api.asked) == 3
    with pytest.raises(BackendUnavailable, match="cannot be reached"):
        freesound(api, tmp_path).find(describe())


def test_failed_service_is_not_queried_for_a_while(tmp_path: Path) -> None:
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


def test_refused_token_ends_all_queries_and_refused_query_only_itself(tmp_path: Path) -> None:
    for status, calls in ((401, 1), (400, 3)):
        with host(refused(status)) as api:
            source = freesound(api, tmp_path)
            for _ in range(3):
                with pytest.raises(BackendUnavailable):
                    source.find(describe())
        assert len(api.asked) == calls


def test_search_works_inside_a_running_event_loop(tmp_path: Path) -> None:
    import asyncio

    async def find() -> int:
        return len(freesound(api, tmp_path).find(describe()))

    with catalogue({}) as (api, _):
        assert asyncio.run(find()) == 1
