"""No logger of the HTTP library, its dependencies or its successors shows a key."""

import logging

import pytest

from scene2hap.common.checks import MASK
from scene2hap.common.quiet_logs import scrubbed
from scene2hap.common.secret import Secret

KEY = "sk-0123456789abcdefghij"


@pytest.mark.parametrize(
    "name",
    [
        "httpx",
        "httpcore.connection",
        "httpcore.http11",
        "httpcore.http2",
        "httpcore.proxy",
        "httpcore.socks",
        "httpx2",
        "httpcore2.connection",
        "httpcore2.http11",
        "httpcore2.http2",
        "httpcore2.socks",
        "httpcorexyz.http11",
        "hpack.hpack",
    ],
)
def test_a_key_in_a_header_of_a_reply_is_masked(name: str, caplog: pytest.LogCaptureFixture) -> None:
    caplog.set_level(logging.DEBUG)
    headers = [(b"x-echo", KEY.encode())]
    with scrubbed(Secret(KEY).scrub):
        logging.getLogger(name).debug("receive_response_headers.complete return_value=%r", headers)
    assert KEY not in caplog.text
    assert MASK in caplog.text


def test_a_logger_that_a_later_version_adds_is_found(caplog: pytest.LogCaptureFixture) -> None:
    caplog.set_level(logging.DEBUG)
    logger = logging.getLogger("httpcore2.of_a_later_version")
    with scrubbed(Secret(KEY).scrub):
        logger.debug("%s", KEY)
    assert KEY not in caplog.text


def test_every_logger_of_the_installed_library_is_covered() -> None:
    import httpcore  # noqa: F401
    import httpx  # noqa: F401

    with scrubbed(Secret(KEY).scrub):
        names = [name for name in logging.root.manager.loggerDict if name.startswith(("httpx", "httpcore"))]
        assert names
        assert all(logging.getLogger(name).filters for name in names)


def test_filters_do_not_pile_up() -> None:
    for _ in range(3):
        with scrubbed(Secret(KEY).scrub):
            pass
    assert len(logging.getLogger("httpcore.http11").filters) == 1


def test_nothing_is_changed_outside_of_a_request(caplog: pytest.LogCaptureFixture) -> None:
    caplog.set_level(logging.DEBUG)
    with scrubbed(Secret(KEY).scrub):
        pass
    logging.getLogger("httpcore.http11").debug("a %s", "word")
    assert "a word" in caplog.text
