"""Serve engines in other languages, which send poses and touches over a WebSocket and receive gains.

scene2hap bridge --root scenes
scene2hap bridge --sink soundcard
scene2hap bridge --check "./my_client"

docs/bridge.md shows how to play from C, C#, Godot and the browser; docs/bridge-protocol.md shows how to write a client.
"""

from __future__ import annotations

import argparse
import asyncio
import contextlib
import os
import shlex
from pathlib import Path
from typing import Any

from scene2hap.cli.console import Console
from scene2hap.cli.given_spec import given_spec
from scene2hap.common.settings import read_settings
from scene2hap.errors import BridgeError, ConfigError, reason_of

TOKEN_VARIABLE = "SCENE2HAP_BRIDGE_TOKEN"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of ``scene2hap bridge``."""
    parser.add_argument("--host", help="interface to listen on (127.0.0.1); needs a token if it is not loopback")
    parser.add_argument("--port", type=int, help="port to listen on (7862); 0 for a free one")
    parser.add_argument("--token", help=f"secret that clients must send; safer in {TOKEN_VARIABLE}, hidden from others")
    parser.add_argument("--root", metavar="FOLDER", help="folder whose scenes and bundles clients may read and write")
    parser.add_argument("--origin", action="append", metavar="URL", help="web page that may connect, besides loopback")
    parser.add_argument(
        "--sink", metavar="KIND", help="sink of the bridge, such as soundcard: a kind, or JSON with one"
    )
    parser.add_argument("--udp", action="store_true", help="also accept frames as datagrams, on the same port")
    parser.add_argument("--settings", metavar="FILE", help="TOML or JSON with tables [bridge], [bake] and [session]")
    parser.add_argument("--check", metavar="COMMAND", help="run a client with this command, check it, and exit")


def run(arguments: argparse.Namespace, console: Console) -> dict[str, Any]:
    """Serve until Ctrl-C, or check a client."""
    if arguments.check is not None:
        return _check(arguments.check, console)
    # Imported here, since no other command needs the server.
    from scene2hap.bridge import BridgeConfig, BridgeServer
    from scene2hap.bridge.session_warnings import warnings_to_clients

    given = {
        "host": arguments.host,
        "port": arguments.port,
        "token": arguments.token or os.environ.get(TOKEN_VARIABLE) or None,
        "root": arguments.root,
        "origins": arguments.origin,
        "sink": given_spec("--sink", arguments.sink) if arguments.sink else None,
        "udp": arguments.udp or None,
    }
    tables = read_settings(arguments.settings, "bridge", "bake", "session")
    own = tables.pop("bridge")
    server = BridgeServer(BridgeConfig.parse({**tables, **own}, **given), owns_process=True)
    with warnings_to_clients(), contextlib.suppress(KeyboardInterrupt):
        asyncio.run(_serve(server, console))
    return {"url": server.url}


async def _serve(server: Any, console: Console) -> None:
    async with server.listening():
        console.say(f"{server.url} (Ctrl-C ends)")
        await asyncio.Event().wait()  # until Ctrl-C or SIGTERM, by which asyncio cancels this coroutine


def _check(command: str, console: Console) -> dict[str, Any]:
    from scene2hap.testing.bridge_client import check_bridge_client

    words = words_of(command, is_posix=os.name != "nt")
    if not words:
        raise ConfigError("--check has no command; give the one that starts your client.")
    if Path(words[0]).suffix == ".py":
        raise ConfigError(f"--check is {command!r}; write 'python {command}'.")
    try:
        found = check_bridge_client(words)
    except OSError as cause:
        raise ConfigError(f"--check is {command!r}, which cannot be started: {reason_of(cause)}.") from cause
    except AssertionError as cause:
        raise BridgeError(f"the client fails the check: {cause}.") from cause
    console.say(f"{found.n_frames} frames, {found.n_resumed} resumed; gains differ by at most {found.worst:.1e}")
    return {"frames": found.n_frames, "resumed": found.n_resumed, "worst": found.worst}


def words_of(command: str, *, is_posix: bool) -> list[str]:
    """Split a command into words, without their quotes. On Windows a backslash is a part of a path.

    Raises: ConfigError: a quote has no end.
    """
    words = shlex.shlex(command, posix=True, punctuation_chars=False)
    words.whitespace_split, words.commenters = True, ""
    if not is_posix:
        words.escape, words.quotes = "", '"'
    try:
        return list(words)
    except ValueError as cause:
        raise ConfigError(f"--check is {command!r}, which cannot be split into words: {cause}.") from cause
