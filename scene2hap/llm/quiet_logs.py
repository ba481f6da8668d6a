"""Keeps a key out of the debug logs of the HTTP library, which show the headers of replies as they came."""

from __future__ import annotations

import logging
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from functools import cache

from scene2hap.secret import Secret

_LOGGERS = ("httpx", "httpcore.connection", "httpcore.http11", "httpcore.http2", "httpcore.proxy")
_IN_USE: ContextVar[Secret | None] = ContextVar("secret in use", default=None)


class _Scrub(logging.Filter):
    def filter(self, record: logging.LogRecord) -> bool:
        secret = _IN_USE.get()
        if secret is not None:
            record.msg, record.args = secret.scrub(record.getMessage()), ()
        return True


@contextmanager
def scrubbed(secret: Secret) -> Iterator[None]:
    """While a request is under way, what the HTTP library logs for it is searched for the key."""
    _install()
    token = _IN_USE.set(secret)
    try:
        yield
    finally:
        _IN_USE.reset(token)


@cache
def _install() -> None:
    for name in _LOGGERS:
        logging.getLogger(name).addFilter(_Scrub())
