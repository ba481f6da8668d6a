"""One HTML page from a report's document and the committed assets. It requests nothing from any network."""

from __future__ import annotations

import gzip
import json
from base64 import b64encode
from collections.abc import Mapping
from functools import cache
from importlib.resources import files
from typing import Any

from scene2hap.errors import ConfigError

_PARTS = {"/*STYLE*/": "style.css", "/*SCRIPT*/": "report.js"}
_DATA = "<!--DATA-->"


def assemble(document: Mapping[str, Any]) -> str:
    """Return the page of a document. The browser reads its texts as JSON data, and shows them as plain text.

    The data are compressed, since most sources reach few of the points: a page of 540 objects has a tenth of the size.
    Raises: ConfigError: a number without a JSON form.
    """
    try:
        text = json.dumps(document, allow_nan=False, separators=(",", ":"))
    except ValueError as cause:
        raise ConfigError(f"the report has a number that JSON cannot hold: {cause}.") from cause
    # In base64 no text can end the script element or begin a comment.
    data = b64encode(gzip.compress(text.encode(), mtime=0)).decode()
    before, marker, behind = _template().partition(_DATA)
    if not marker:
        raise ConfigError("the page's template has no place for data; install scene2hap again.")
    return f'{before}<script type="application/gzip" id="report">{data}</script>{behind}'


@cache
def _template() -> str:
    page = _asset("page.html")
    for marker, name in _PARTS.items():
        page = page.replace(marker, _asset(name))
    return page


def _asset(name: str) -> str:
    return files(__package__).joinpath("assets", name).read_text(encoding="utf-8")
