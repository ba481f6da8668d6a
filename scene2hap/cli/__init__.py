"""The command line, ``scene2hap COMMAND``: one module per command.

A command returns its result as plain JSON values. ``--json`` prints this result; otherwise the command prints tables.
An error that the user can correct is one line on standard error and exit status 1. Wrong usage is exit status 2.
"""

from __future__ import annotations

import argparse
import contextlib
import re
import sys
import warnings
from collections.abc import Mapping, Sequence
from importlib import import_module
from typing import Any, NoReturn

from scene2hap import __version__
from scene2hap.cli import streams
from scene2hap.cli.console import Console
from scene2hap.common.checks import did_you_mean
from scene2hap.common.printable import printable
from scene2hap.errors import Scene2HapError

COMMANDS = {
    "demo": "bake and play the built-in kitchen",
    "bake": "bake a scene file into a haptic bundle",
    "bake-many": "bake many scene files, each into a bundle",
    "batch": "send questions about many scenes in batches: submit, status, collect, cancel",
    "edit": "correct one object of a bundle",
    "render": "render a file of touches on a bundle to a WAV file",
    "play": "play a bundle with the arrow keys",
    "bridge": "serve engines in other languages over a WebSocket",
    "audition": "play one source of a bundle alone",
    "export": "write a bundle in the haptic formats of other platforms",
    "convert": "convert sound files into vibration",
    "inspect": "show tables of a scene or a bundle",
    "report": "show inferred values with their sources and reasons, as tables or as a page",
    "list": "list names of materials, actuators and kinds",
    "settings": "list every setting with its default",
    "doctor": "show what this machine can do and what is missing, or play a test sweep",
}
"""Every command with its line in the list of commands. Its module is imported when the command is given."""

_WITH_UNIT = re.compile(r"(-[0-9.]+)\s*db", re.IGNORECASE)
"""A level below zero with its unit, which argparse takes for an option."""
_NO_INTEGER, _NO_NUMBER = re.compile(r"invalid int value: (.+)"), re.compile(r"invalid float value: (.+)")
"""What argparse says, in Python's words."""
_DOCS = (
    "Documentation by task: docs/README.md in the folder of the source. Every command: docs/command-line.md, or "
    "scene2hap COMMAND --help. In Python: help(scene2hap.HapticSession)."
)


def main(argv: Sequence[str] | None = None) -> int:
    """Run a command. Returns the exit status."""
    streams.prepare()
    try:
        arguments = command_parser().parse_args(argv)
    except SystemExit:  # argparse exits after help or a usage error, even if neither could be written
        if Console(quiet=True).close():
            return 1
        raise
    console = Console(quiet=arguments.quiet or arguments.json)
    status = _run(arguments, console)
    return console.close() or status


def _run(arguments: argparse.Namespace, console: Console) -> int:
    try:
        with warnings.catch_warnings():
            warnings.showwarning = lambda message, category, *rest, **more: console.warn(str(message))
            warnings.simplefilter("once")
            outcome = arguments.run(arguments, console)
    except Scene2HapError as error:
        console.fail(" ".join([str(error), *getattr(error, "__notes__", ())]))
        return 1
    except KeyboardInterrupt:
        console.fail("interrupted; no file was left incomplete.")
        return 130
    except MemoryError:
        console.fail("out of memory. Use a smaller scene or shorter sounds, or a machine with more memory.")
        return 1
    except OSError as error:
        console.fail(f"{error.filename or 'the system'}: {error.strerror or error}.")
        return 1
    if arguments.json:
        console.outcome(outcome)
    return 0


class CommandParser(argparse.ArgumentParser):
    """Suggest similar words, and list the words of a missing command or verb.

    Arguments in messages are escaped as `Console` escapes names, since a file name may hold any character.
    """

    _given: Sequence[str] = ()
    of_commands: Sequence[str] = ()
    """Options that every command takes, and this parser does not."""

    def __init__(self, *arguments: Any, module: str | None = None, **settings: Any) -> None:
        """Take the arguments of argparse, and the module whose command this parser reads."""
        super().__init__(*arguments, **settings)
        self._module = module
        # argparse takes -6 for a number, but -1e1 and -inf for options; some versions know more numbers than others.
        self._negative_number_matcher = re.compile(
            r"-(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$|-(inf|infinity|nan)$", re.IGNORECASE
        )

    def load(self) -> None:
        """Import the module of the command and add its arguments, once: all modules take half a second to import."""
        if self._module is not None:
            module = import_module(self._module)
            self._module = None
            self.description: str | None = module.__doc__
            module.add_arguments(self)
            self.set_defaults(run=module.run)

    def parse_known_args(self, args: Any = None, namespace: Any = None) -> Any:
        """Parse as argparse does, and keep the arguments for `error`. No argument may be left, so that the usage in an
        error is that of the command or verb."""
        self.load()
        self._given = tuple(sys.argv[1:] if args is None else args)
        known, unknown = super().parse_known_args(args, namespace)
        if unknown:
            self.error(f"unrecognized arguments: {' '.join(unknown)}")
        return known, unknown

    def _get_value(self, action: argparse.Action, arg_string: str) -> Any:
        """Reject an empty value, such as that of an unset variable of a shell, where it means nothing."""
        is_command = action.nargs == argparse.PARSER  # its values are all words behind it
        if not arg_string and not is_command and arg_string not in (action.default, action.const):
            raise argparse.ArgumentError(action, "its value is empty; is a variable of the shell not set?")
        return super()._get_value(action, arg_string)

    def _check_value(self, action: argparse.Action, value: Any) -> None:
        try:
            super()._check_value(action, value)
        except argparse.ArgumentError as error:
            near = did_you_mean(value, map(str, action.choices or ()))
            error.message = f"{error.message}. {near}" if near else error.message
            raise

    def error(self, message: str) -> NoReturn:
        """Print the usage and a message, and exit with status 2."""
        for action in self._actions:
            if isinstance(action.choices, Mapping) and message.endswith(str(action.metavar)):
                message = f"{message}, one of {', '.join(action.choices)}"
        message = _NO_INTEGER.sub(r"\1 is no whole number; write it as 5, without a unit", message)
        message = _NO_NUMBER.sub(r"\1 is no number; write it as 0.5, without a unit", message)
        super().error(f"{message}{self._hint(message)}")

    def _hint(self, message: str) -> str:
        """Return how to write the first argument that may be a name but looks like an option, or a similar option."""
        if self._given and self._given[0] in self.of_commands:
            return f". Write {self._given[0]} after the command"
        _, is_unknown, unknown = message.partition("unrecognized arguments: ")
        for text in self._given:
            if text == "--" or "invalid choice" in message:
                break
            if is_unknown and text not in unknown.split():  # an option of the command, which this parser does not know
                continue
            if text.startswith("--") and text.partition("=")[0] in self._options():
                continue
            if text.startswith("--") and (near := did_you_mean(text.partition("=")[0], self._options())):
                return f". {near}"
            is_option = text.startswith("--") or text[:2] in self._option_string_actions
            if (
                len(text) > 1
                and text.startswith("-")
                and not is_option
                and not self._negative_number_matcher.match(text)
            ):
                if number := _WITH_UNIT.fullmatch(text):
                    return f". {text!r} is not a number; write it without its unit, as {number[1]}"
                return f". {text!r} is read as an option; write -- before names, or ./{text} for a file"
        return ""

    def _options(self) -> list[str]:
        """Return the options of the command and verb in the arguments."""
        parser: argparse.ArgumentParser = self
        for text in self._given:
            verbs = next((one.choices for one in parser._actions if isinstance(one.choices, Mapping)), {})
            parser = verbs.get(text, parser)
        return [name for name in parser._option_string_actions if name.startswith("--")]

    def _print_message(self, message: str, file: Any = None) -> None:
        # Some versions of argparse raise this error and others ignore it; `Console.close` reports failed output.
        with contextlib.suppress(OSError):
            super()._print_message(printable(message, lines=True), file)


def command_parser() -> argparse.ArgumentParser:
    """Return the parser of the command line. The parser of a command has its arguments after `load`."""
    parser = CommandParser(prog="scene2hap", description="Scene-wide vibrotactile haptics.", epilog=_DOCS)
    parser.add_argument("--version", action="version", version=f"scene2hap {__version__}")
    common = CommandParser(add_help=False)
    common.add_argument("-q", "--quiet", action="store_true", help="show no progress and no tables")
    common.add_argument("--json", action="store_true", help="print the result as JSON instead of tables")
    parser.of_commands = tuple(common._option_string_actions)
    commands = parser.add_subparsers(title="commands", required=True, metavar="COMMAND")
    for name, line in COMMANDS.items():
        commands.add_parser(
            name,
            parents=[common],
            help=line,
            formatter_class=argparse.RawDescriptionHelpFormatter,
            module=f"scene2hap.cli.{name.replace('-', '_')}",
        )
    return parser
