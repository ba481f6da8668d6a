"""What a person sees: progress on standard error, tables on standard output, one line per trouble."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager

import rich.console
from rich.markup import escape
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn, TimeRemainingColumn
from rich.table import Table

from scene2hap.printable import printable

Tell = Callable[[str, str, int, int], None]
"""Told (stage, what is done, how many are done, of how many)."""


def _safe(text: str, *, lines: bool = False) -> str:
    """Text to print: neither markup nor what a terminal would obey; names come from files and servers."""
    return escape(printable(text, lines=lines))


_FILE_WIDTH = 160
"""Columns for output into a file or a pipe, which have no width of their own."""


class Console:
    """Output for a person; with `quiet`, errors and warnings alone."""

    def __init__(self, *, quiet: bool) -> None:
        self.is_quiet = quiet
        self._out = rich.console.Console(quiet=quiet, highlight=False)
        if not self._out.is_terminal:
            self._out.width = _FILE_WIDTH
        self._error = rich.console.Console(stderr=True, highlight=False, soft_wrap=True)

    def say(self, text: str) -> None:
        """One line on standard output."""
        self._out.print(_safe(text, lines=True), soft_wrap=True)

    def warn(self, text: str) -> None:
        """One line of warning on standard error."""
        self._error.print(f"scene2hap: warning: {_safe(text)}", style="yellow")

    def fail(self, text: str) -> None:
        """One line of error on standard error."""
        self._error.print(f"scene2hap: error: {_safe(text)}", style="red")

    def table(self, title: str, columns: Sequence[str], rows: Iterable[Sequence[str]]) -> None:
        """A table; a column whose name starts with ">" is set to the right."""
        table = Table(title=_safe(title), title_justify="left", title_style="bold")
        for column in columns:
            table.add_column(_safe(column.removeprefix(">")), justify="right" if column.startswith(">") else "left")
        for row in rows:
            table.add_row(*map(_safe, row))
        self._out.print(table)

    @contextmanager
    def progress(self) -> Iterator[Tell]:
        """A progress bar per stage, for as long as the block runs."""
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
