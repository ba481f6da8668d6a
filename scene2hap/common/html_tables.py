"""Small HTML tables for notebooks.

Every text is escaped. A table has no script, no colour of its own and no address. So it is readable in light and dark
themes, and requests nothing from any server.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from html import escape
from itertools import islice

from scene2hap.common.printable import printable

MOST_ROWS = 50
MOST_LETTERS = 120
"""Most letters of a cell: names and sentences come from files, and can have any length."""

_TABLE = "border-collapse:collapse;margin:0.3em 0"
_CELL = "text-align:left;padding:0.15em 0.6em;border-bottom:1px solid rgba(128,128,128,0.4)"


def html_table(title: str, columns: Sequence[str], rows: Iterable[Sequence[str]], n_rows: int) -> str:
    """Return a table with a title, at most `MOST_ROWS` of its `n_rows` rows, and the number of rows left out.

    Parameters: columns : headings with units; rows : texts of the cells, read only as far as they are shown.
    """
    head = "".join(f'<th style="{_CELL}">{_text(name)}</th>' for name in columns)
    body = "".join(
        "<tr>" + "".join(f'<td style="{_CELL}">{_text(cell)}</td>' for cell in row) + "</tr>"
        for row in islice(rows, MOST_ROWS)
    )
    below = f"<div>and {n_rows - MOST_ROWS} more</div>" if n_rows > MOST_ROWS else ""
    table = f'<table style="{_TABLE}"><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>' if n_rows else ""
    return f"<div><div><strong>{_text(title)}</strong></div>{table}{below}</div>"


def number(value: float | None, digits: int = 3) -> str:
    """Format a number with `digits` significant digits, "-" for None."""
    return "-" if value is None else f"{value:.{digits}g}"


def _text(words: str) -> str:
    shown = printable(words)
    return escape(shown if len(shown) <= MOST_LETTERS else f"{shown[: MOST_LETTERS - 1]}…")
