"""Errors from status, headers and body of a reply."""

import pytest

from scene2hap.common.web import WebReply
from scene2hap.errors import RequestRejected
from scene2hap.llm.backends.http_errors import ServerError, failure, server_error

NOW_S = 1_445_412_480.0
"""Wed, 21 Oct 2015 07:28:00 GMT, the example date of RFC 9110."""


def reply(status: int = 429, text: str = "", **headers: str) -> WebReply:
    named = {name.replace("_", "-"): value for name, value in headers.items()}
    return WebReply("http://a/v1", status, text.encode(), named)


@pytest.mark.parametrize(
    ("headers", "wait_s"),
    [
        ({"retry_after": "7"}, 7.0),
        ({"retry_after": "0.5"}, 0.5),
        ({"retry_after_ms": "1500", "retry_after": "7"}, 1.5),
        ({"retry_after": "Wed, 21 Oct 2015 07:28:30 GMT"}, 30.0),
        ({"retry_after": "Wed, 21 Oct 2015 07:27:00 GMT"}, 0.0),
        ({"retry_after": "Wed Oct 21 07:28:30 2015"}, 30.0),
        ({"retry_after": "soon"}, None),
        ({"retry_after": "-3"}, None),
        ({"retry_after": "nan"}, None),
        ({"retry_after": ""}, None),
        ({}, None),
    ],
    ids=str,
)
def test_retry_delay_is_read_from_headers(headers: dict[str, str], wait_s: float | None) -> None:
    error = failure(reply(**headers), now_s=NOW_S)
    assert error.retry_after_s == wait_s
    assert error.retryable


def test_retry_delay_above_two_minutes_is_not_waited_for() -> None:
    error = failure(reply(retry_after="121"))
    assert (error.retryable, error.retry_after_s) == (False, 121.0)
    assert "It asks to wait 121 s" in str(error)
    assert failure(reply(retry_after="120")).retryable


@pytest.mark.parametrize("status", [400, 401, 403, 404, 413, 422, 429, 500])
def test_a_status_tells_whether_other_requests_may_pass(status: int) -> None:
    assert isinstance(failure(reply(status)), RequestRejected) is (status in (400, 413, 422))


@pytest.mark.parametrize(("told", "retryable"), [("true", True), ("false", False), ("maybe", False)])
def test_x_should_retry_is_obeyed(told: str, retryable: bool) -> None:
    assert failure(reply(400, x_should_retry=told)).retryable is retryable
    assert failure(reply(500, x_should_retry=told)).retryable is (told != "false")


@pytest.mark.parametrize(
    ("text", "error"),
    [
        ('{"error": {"message": "m", "type": "t", "param": "p", "code": "c"}}', ServerError("m", "t", "p", "c")),
        ('{"error": {"message": "m", "param": null, "code": 500}}', ServerError("m", code="500")),
        ('{"error": "m"}', ServerError("m")),
        ('{"object": "error", "message": "m", "type": "t", "code": 400}', ServerError("m", "t", code="400")),
        ("Bad Gateway", ServerError("Bad Gateway")),
        ("[1]", ServerError("[1]")),
        ("", ServerError()),
    ],
)
def test_error_message_is_read_from_every_body_form(text: str, error: ServerError) -> None:
    assert server_error(reply(text=text)) == error


def test_message_gives_address_status_code_and_next_step() -> None:
    text = '{"error": {"message": "The model\\n `x` does not exist", "code": "model_not_found"}}'
    assert str(failure(reply(404, text))) == (
        "http://a/v1 answered 404 (model_not_found): The model `x` does not exist. "
        "Check base_url and the name of the model."
    )


def test_html_page_is_shortened_in_the_message() -> None:
    assert len(str(failure(reply(502, "<p>" * 10_000)))) < 600


@pytest.mark.parametrize(
    ("status", "headers", "wait_s"),
    [
        (429, {"x_ratelimit_remaining_requests": "0", "x_ratelimit_reset_requests": "1s"}, 1.0),
        (429, {"x_ratelimit_remaining_tokens": "0", "x_ratelimit_reset_tokens": "1m30s"}, 90.0),
        (429, {"x_ratelimit_remaining_tokens": "0", "x_ratelimit_reset_tokens": "20ms"}, 0.02),
        (429, {"x_ratelimit_remaining_tokens": "0", "x_ratelimit_reset_tokens": "59.56"}, 59.56),
        (429, {"x_ratelimit_remaining_tokens": "12", "x_ratelimit_reset_tokens": "20s"}, None),
        (429, {"x_ratelimit_remaining_tokens": "0", "x_ratelimit_reset_tokens": "soon"}, None),
        (429, {"x_ratelimit_remaining_tokens": "0"}, None),
        (429, {"x_ratelimit_remaining_tokens": "0", "x_ratelimit_reset_tokens": "9s", "retry_after": "2"}, 2.0),
        (500, {"x_ratelimit_remaining_tokens": "0", "x_ratelimit_reset_tokens": "9s"}, None),
    ],
    ids=str,
)
def test_exhausted_rate_limit_gives_its_reset_time(status: int, headers: dict[str, str], wait_s: float | None) -> None:
    assert failure(reply(status, **headers)).retry_after_s == wait_s


def test_later_reset_of_two_limits_counts() -> None:
    both = {
        "x_ratelimit_remaining_requests": "0",
        "x_ratelimit_reset_requests": "3s",
        "x_ratelimit_remaining_tokens": "0",
        "x_ratelimit_reset_tokens": "2s",
    }
    assert failure(reply(**both)).retry_after_s == 3.0
