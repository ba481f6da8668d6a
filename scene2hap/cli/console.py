"""Terminal output: progress on standard error, tables on standard output, one line per problem.

A command continues if its output cannot be written, because the reader has gone or the disk is full.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager

import rich.console
import rich.markup
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn, TimeRemainingColumn
from rich.table import Table

from scene2hap.cli import streams
from scene2hap.common.printable import aligned, printable, printable_json

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
        table = Table(title=_safe(title), title_justify="left", title_style="bold")
        for column in columns:
            table.add_column(_safe(column.removeprefix(">")), justify="right" if column.startswith(">") else "left")
        for row in rows:
            table.add_row(*map(_safe, row))
        with self._lasting():
            self._out.print(table)

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
