"""Write the documentation page of the command line from its parser: `python tests/support/command_line_page.py`."""

from __future__ import annotations

import argparse
import re
from collections.abc import Iterator
from pathlib import Path
from textwrap import fill

from scene2hap.cli import CommandParser, command_parser

PAGE = Path(__file__).parents[2] / "docs" / "command-line.md"

_HEAD = """# The command line

To look up a command and its arguments. `scene2hap COMMAND --help` shows the same. Every command also takes `-q` (no
progress, no tables) and `--json` (the result as JSON). The exit status is 0; 1 for an error that you can act on; 2 for
wrong usage. `--` ends the options: write it before a name that begins with "-".

On Windows, `cmd` knows double quotes only: write `"levels/*.glb"`, and JSON as `"{\\"kind\\": \\"wav\\"}"`. PowerShell
up to 5.1 takes the single quotes of this page, with `\\"` inside them.

<!-- python tests/support/command_line_page.py writes this page from the parser -->
"""

_COMMON = {"help", "quiet", "json"}
_LIKE_BAKE = ("bake-many", "batch")
"""Commands whose options of `bake` are listed by name only."""


def page() -> str:
    """The text that the page must have."""
    return "\n".join([_HEAD, *_commands(command_parser())]).rstrip() + "\n"


def _commands(parser: argparse.ArgumentParser) -> Iterator[str]:
    commands = _below(parser)
    for command in commands.values():
        if isinstance(command, CommandParser):
            command.load()
    of_bake = [*_rows(commands["bake"])]
    for name, command in commands.items():
        yield f"## {name}\n"
        yield _described(command.description or "")
        rows = [*_rows(command)]
        if name in _LIKE_BAKE:
            shared = [left for left, right in rows if (left, right) in of_bake]
            options = ", ".join(f"`{re.split('[ ,]', left)[0]}`" for left in shared)
            yield fill(f"It takes these options of [bake](#bake): {options}.", 120, break_on_hyphens=False) + "\n"
            rows = [row for row in rows if row not in of_bake]
        explained: set[str] = set()
        rows += [_verb(verb, below, explained) for verb, below in _below(command).items()]
        if rows:
            yield "| argument | meaning |\n|---|---|"
            yield from (f"| `{_cell(left)}` | {_cell(right)} |" for left, right in rows)
            yield ""


def _below(parser: argparse.ArgumentParser) -> dict[str, argparse.ArgumentParser]:
    for action in parser._actions:
        if isinstance(action, argparse._SubParsersAction):
            return dict(action.choices)
    return {}


def _own(parser: argparse.ArgumentParser) -> list[argparse.Action]:
    return [
        action
        for action in parser._actions
        if action.dest not in _COMMON and not isinstance(action, argparse._SubParsersAction)
    ]


def _verb(name: str, parser: argparse.ArgumentParser, explained: set[str]) -> tuple[str, str]:
    """Return the cells of a verb. An option of several verbs is explained at the first of them."""
    own = _own(parser)
    takes = [f"[{_spelled(one)}]" if one.option_strings else _spelled(one) for one in own]
    new = [one for one in own if one.help and one.dest != "id" and not explained & {*one.option_strings}]
    meanings = [f"`{_spelled(one)}`: {one.help}" for one in new]
    explained.update(*(one.option_strings for one in new))
    return " ".join([name, *takes]), "; ".join([parser.description or "", *meanings])


def _rows(parser: argparse.ArgumentParser) -> Iterator[tuple[str, str]]:
    for action in _own(parser):
        yield _spelled(action), action.help or ""


def _spelled(action: argparse.Action) -> str:
    takes = "" if action.nargs == 0 else str(action.metavar or action.dest.upper())
    spelled = f"{', '.join(action.option_strings)} {takes}".strip()
    return f"[{spelled}]" if action.nargs == "?" and not action.option_strings else spelled


def _cell(text: str) -> str:
    return text.replace("|", "\\|")


def _described(text: str) -> str:
    """Keep paragraphs as they are, and put those that begin with the program's name into a code block."""
    paragraphs = []
    for paragraph in re.split(r"\n\s*\n", text.strip()):
        is_code = paragraph.startswith("scene2hap ")
        paragraphs.append(f"```sh\n{paragraph}\n```" if is_code else paragraph)
    return "\n\n".join(paragraphs) + "\n"


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
    print(PAGE)
