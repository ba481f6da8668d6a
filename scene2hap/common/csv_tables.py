"""CSV tables as spreadsheets of any country write them."""

from __future__ import annotations

import csv
import io
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from _csv import Reader


def csv_reader(text: str) -> Reader:
    """Return a reader of the rows. Columns are separated by semicolons or tabs if the first line has any.

    Programs of countries that write 0,5 separate the columns so. Raises: csv.Error, while rows are read.
    """
    lines = io.StringIO(text, newline="")  # newline: a quoted cell may have lines of its own
    first = lines.readline()
    lines.seek(0)
    return csv.reader(lines, delimiter=next((one for one in ";\t" if one in first), ","))


def with_point(cell: str) -> str:
    """Return a number with a point before its decimals, in place of a comma."""
    return cell.replace(",", ".")
