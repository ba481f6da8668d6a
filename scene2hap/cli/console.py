"""Terminal output: progress on standard error, tables on standard output, one line per problem.

A command continues if its output cannot be written, because the reader has gone or the disk is full.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager

import rich.box
import rich.console
import rich.markup
from rich.cells import cell_len
from rich.padding import Padding
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn, TimeRemainingColumn
from rich.table import Table
from rich.text import Text

from scene2hap.cli import streams
from scene2hap.common.json_texts import printable_json
from scene2hap.common.printable import aligned, printable

Tell = Callable[[str, str, int, int], None]
"""Called with (stage, item, number done, total number)."""


def _safe(text: str, *, lines: bool = False) -> str:
    """Escape markup and terminal control characters in a text, since names come from files and servers."""
    return rich.markup.escape(printable(text, lines=lines))


_LONGEST = 2000
"""Most characters shown of a warning or an error; a name may have a million."""
_FILE_WIDTH = 160
"""Width in columns of output into a file or a pipe."""
_LAID_OUT = 1000
"""Most rows of a table that is fitted to the terminal, at 0.6 ms a row. Longer tables are only aligned."""


def _one_line(text: str) -> str:
    left = len(text) - _LONGEST
    return _safe(text if left <= 0 else f"{text[:_LONGEST]} ... ({left} characters more)")


def _widths(rows: Sequence[Sequence[str]], width: int, border: int, gap: int) -> list[int] | None:
    """Return the width of each column, or None if the longest words of all columns do not fit into `width` together.

    Words are never cut, since ids are typed again. Only words of more than half the width are broken into lines.
    """
    columns = list(zip(*rows, strict=True))
    left = width - border - gap * (len(columns) - 1)
    whole = [max(map(cell_len, column)) for column in columns]
    found = [
        min(max(cell_len(word) for cell in column for word in cell.split() or [""]), width // 2) for column in columns
    ]
    left -= sum(found)
    if left < 0:
        return None
    # The columns that lack least come first, so that as many as possible are not wrapped at all.
    for n_more, i in enumerate(sorted(range(len(columns)), key=lambda i: whole[i] - found[i])):
        more = min(whole[i] - found[i], left // (len(columns) - n_more))
        found[i], left = found[i] + more, left - more
    return found


class _Output(rich.console.Console):
    def on_broken_pipe(self) -> None:
        raise BrokenPipeError  # rich would end the command here, before its work is done


class Console:
    """Terminal output; with `quiet`, only errors and warnings."""

    def __init__(self, *, quiet: bool) -> None:
        self.is_quiet = quiet
        self._out = _Output(quiet=quiet, highlight=False)
        if not self._out.is_terminal:
            self._out.width = _FILE_WIDTH
        self._error = _Output(stderr=True, highlight=False, soft_wrap=True)
        self._unwritten: OSError | None = None

    def say(self, text: str) -> None:
        """Print one line on standard output."""
        with self._lasting():
            self._out.print(_safe(text, lines=True), soft_wrap=True)

    def warn(self, text: str) -> None:
        """Print one line of warning on standard error."""
        self._tell(f"scene2hap: warning: {_one_line(text)}", "yellow")

    def fail(self, text: str) -> None:
        """Print one line of error on standard error."""
        self._tell(f"scene2hap: error: {_one_line(text)}", "red")

    def table(self, title: str, columns: Sequence[str], rows: Iterable[Sequence[str]]) -> None:
        """Print a table. A column whose name starts with ">" is right-aligned."""
        if self._out.quiet:
            return
        rows = list(rows)
        if len(rows) > _LAID_OUT:
            self.say("\n".join((title, *aligned(columns, rows))))
            return
        with self._lasting():
            self._fitted(title, columns, rows)

    def _fitted(self, title: str, columns: Sequence[str], rows: Sequence[Sequence[str]]) -> None:
        """Print a table with borders, a narrower one without, or a paragraph for each row: the first that fits."""
        names = [column.removeprefix(">") for column in columns]
        cells = [[printable(cell) for cell in row] for row in (names, *rows)]
        bordered = _widths(cells, self._out.width, 4, 3)
        widths = bordered or _widths(cells, self._out.width, 0, 2)
        if widths is None:
            self._paragraphs(title, cells)
            return
        table = Table(
            title=_safe(title),
            title_justify="left",
            title_style="bold",
            box=rich.box.HEAVY_HEAD if bordered else None,
            pad_edge=bool(bordered),
            padding=(0, 1) if bordered else (0, 2, 0, 0),
        )
        for column, name, width in zip(columns, names, widths, strict=True):
            table.add_column(
                _safe(name), justify="right" if column.startswith(">") else "left", width=width, overflow="fold"
            )
        for row in rows:
            table.add_row(*map(_safe, row))
        self._out.print(table)

    def _paragraphs(self, title: str, cells: Sequence[Sequence[str]]) -> None:
        """Print a paragraph for each row below the first, which has the names of the columns."""
        self._out.print(Text(printable(title), "bold"))
        for first, *others in cells[1:]:
            facts = "; ".join(f"{name}: {cell}" for name, cell in zip(cells[0][1:], others, strict=True) if cell)
            self._out.print(Text(first, "bold"), soft_wrap=True)
            if facts:
                self._out.print(Padding(Text(facts), (0, 0, 0, 2), expand=False))

    def outcome(self, outcome: object) -> None:
        """Print JSON on standard output, even if quiet. Letters that the encoding lacks are escaped."""
        text = json.dumps(outcome, indent=1, ensure_ascii=False)
        try:
            text.encode(sys.stdout.encoding or "utf-8")
        except UnicodeEncodeError:
            text = json.dumps(outcome, indent=1)
        with self._lasting():
            print(printable_json(text), flush=True)

    def close(self) -> int:
        """Flush the output. Returns the exit status: 0, or 1 if the output cannot be written."""
        failed = streams.flush() or self._unwritten
        if failed is None or streams.is_unread(failed):
            return 0
        self.fail(f"standard output cannot be written: {failed.strerror}. Everything else has been done.")
        streams.flush()
        return 1

    @contextmanager
    def _lasting(self) -> Iterator[None]:
        try:
            yield
        except OSError as cause:
            self._unwritten = cause
            self._out.quiet = True
            streams.give_up(sys.stdout)

    def _tell(self, text: str, style: str) -> None:
        try:
            self._error.print(text, style=style)
        except OSError:
            self._error.quiet = True
            streams.give_up(sys.stderr)

    @contextmanager
    def progress(self) -> Iterator[Tell]:
        """Show a progress bar per stage, as long as the block runs."""
        columns = (
            TextColumn("{task.description:<12}"),
            BarColumn(),
            MofNCompleteColumn(),
            TimeElapsedColumn(),
            TextColumn("left"),
            TimeRemainingColumn(),
            TextColumn("{task.fields[what]}"),
        )
        with Progress(
            *columns, console=self._error, transient=True, disable=not self._error.is_terminal or self.is_quiet
        ) as bars:
            tasks = {}

            def tell(stage: str, what: str, done: int, total: int) -> None:
                if stage not in tasks:
                    tasks[stage] = bars.add_task(stage, total=total, what="")
                bars.update(tasks[stage], completed=done, total=total, what=_safe(what))

            yield tell
