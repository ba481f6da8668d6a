"""Removal of a key from the debug logs of the HTTP library, which show the headers of replies unchanged."""

from __future__ import annotations

import logging
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar

_FAMILIES = ("httpx", "httpcore", "httpx2", "httpcore2", "httpxyz", "httpcorexyz", "hpack", "h11", "h2", "socksio")
"""The HTTP library, its dependencies, and the names of forks that continue it (pydantic/httpx2, httpxyz)."""
_MODULES = ("connection", "http11", "http2", "proxy", "socks", "hpack", "table")
"""Loggers below a family. Some are created during the first request, too late to add a filter."""
_IN_USE: ContextVar[Callable[[str], str] | None] = ContextVar("what takes the key out", default=None)


class _Scrub(logging.Filter):
    def filter(self, record: logging.LogRecord) -> bool:
        scrub = _IN_USE.get()
        if scrub is not None:
            record.msg, record.args = scrub(record.getMessage()), ()
        return True


_SCRUB = _Scrub()


@contextmanager
def scrubbed(scrub: Callable[[str], str]) -> Iterator[None]:
    """Remove a key with `scrub` from the logs of the HTTP library while the block runs."""
    for name in _loggers():
        logging.getLogger(name).addFilter(_SCRUB)  # the same filter is never added twice
    token = _IN_USE.set(scrub)
    try:
        yield
    finally:
        _IN_USE.reset(token)


def _loggers() -> set[str]:
    """Return loggers that may log a header: the known names, and all existing loggers below them."""
    known = {*_FAMILIES, *(f"{family}.{module}" for family in _FAMILIES for module in _MODULES)}
    return known | {name for name in list(logging.root.manager.loggerDict) if name.partition(".")[0] in _FAMILIES}
