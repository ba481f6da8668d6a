"""Failures of OpenAI: which are retryable, and after which delay."""

import dataclasses
import logging
from typing import Any

import pytest

from llm_asking import ask, failed, openai
from llm_server import Scripted, refused, said
from openai_schema import openai_serving
from scene2hap.errors import BackendUnavailable


@pytest.mark.parametrize("status", [408, 409, 429, 500, 502, 503, 529])
def test_retries_follow_the_rules_of_the_sdk(status: int) -> None:
    assert failed(refused(status, {"message": "busy", "type": "server_error"})).retryable


@pytest.mark.parametrize("status", [301, 400, 401, 403, 404, 413, 422])
def test_client_errors_are_not_retried(status: int) -> None:
    assert not failed(refused(status, {"message": "wrong"})).retryable


@pytest.mark.parametrize(
    "error",
    [
        {"type": "insufficient_quota", "code": None},
        {"type": "requests", "code": "insufficient_quota"},
        {"code": "credit_balance_exhausted"},
        {"code": "organization_spend_limit_exceeded"},
        {"code": "project_spend_limit_exceeded"},
        {"code": "organization_usage_limit_exceeded"},
    ],
    ids=str,
)
def test_fail_fast_on_429_without_money(error: dict[str, Any]) -> None:
    caught = failed(
        refused(429, {"message": "You exceeded your quota", **error}, retry_after="1", x_should_retry="true")
    )
    assert not caught.retryable
    assert "The account is used up" in str(caught)


def test_rate_limit_reply_gives_the_retry_delay() -> None:
    caught = failed(refused(429, {"message": "slow", "code": "rate_limit_exceeded"}, retry_after="20"))
    assert (caught.retryable, caught.retry_after_s) == (True, 20.0)


def test_request_id_is_in_the_message_and_the_log(caplog: pytest.LogCaptureFixture) -> None:
    with caplog.at_level(logging.DEBUG, "scene2hap"):
        error = failed(refused(500, {"message": "oops"}, x_request_id="req_77"))
    assert "Request id req_77." in str(error)
    assert "req_77" in caplog.text


def test_silence_is_a_timeout_that_can_be_retried() -> None:
    error = failed(Scripted(hang=True), timeout_s=0.04)
    assert error.retryable
    assert "did not answer within 0.04 s" in str(error)


def test_slow_trickle_is_a_timeout() -> None:
    """Each byte comes in time, but the whole answer does not."""
    dripping = dataclasses.replace(said(), drip_s=5.0)
    error = failed(dripping, timeout_s=0.1)
    assert error.retryable
    assert "did not answer within 0.1 s" in str(error)


def test_a_connection_that_is_reset_can_be_retried() -> None:
    error = failed(Scripted(reset=True))
    assert error.retryable
    assert "cannot be reached" in str(error)


@pytest.mark.parametrize("status", [200, 404, 502])
def test_html_reply_is_not_a_model_server_except_for_gateway_errors(status: int) -> None:
    page = Scripted(b"<html><h1>Bad gateway</h1></html>", status, {"content-type": "text/html"})
    assert failed(page).retryable is (status == 502)


def test_json_that_breaks_off_under_status_200_can_be_retried() -> None:
    error = failed(Scripted(b'{"id": "chatcmpl-1", "choices": [{"mess'))
    assert error.retryable
    assert "breaks off after 39 characters" in str(error)


def test_dropped_connection_can_be_retried() -> None:
    error = failed(Scripted(drop=True))
    assert error.retryable
    assert "cannot be reached" in str(error)
    assert error.__cause__ is not None


def test_body_cut_short_can_be_retried() -> None:
    assert failed(Scripted(b'{"choices"', headers={"content-length": "500"})).retryable


def test_refused_connection_is_reported() -> None:
    with openai_serving(said()) as server:
        pass
    with pytest.raises(BackendUnavailable, match="cannot be reached") as caught:
        ask(openai(server))
    assert not caught.value.retryable  # on this machine: nothing listens there
