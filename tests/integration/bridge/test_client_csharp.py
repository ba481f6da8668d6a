"""The C# client: game and examples of the protocol page, server faults, memory allocation. Unity: the file beside."""

import base64
import hashlib
import json
import math
import os
import random
import re
import socket
import struct
import subprocess
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from itertools import chain
from pathlib import Path
from typing import Any

import pytest

from bridge_clients import start_server
from csharp_client import CLIENT, COMPILER, RUNTIME, needs_csharp
from scene2hap.testing import check_bridge_client
from scene2hap.testing.bridge_client import serving
from server_thread import running

pytest.importorskip("websockets", reason="no WebSocket server; pip install websockets")
from websockets.exceptions import ConnectionClosed
from websockets.sync.server import ServerConnection, serve

PAGE = Path(__file__).parents[3] / "docs" / "bridge-protocol.md"
TOKEN = "a token that nobody else may read"
pytestmark = needs_csharp


@contextmanager
def mock(take: Callable[[ServerConnection, str | bytes], None]) -> Iterator[str]:
    """Run a WebSocket server that passes every message to `take`. Yields its URL.

    At its end it reads what clients sent before they ended.
    """
    readers: list[threading.Thread] = []

    def serve_one(connection: ServerConnection) -> None:
        readers.append(threading.current_thread())
        try:
            for message in connection:
                take(connection, message)
        except ConnectionClosed:
            pass

    with serve(serve_one, "127.0.0.1", 0, compression=None, max_size=None) as server, running(server):
        yield f"ws://127.0.0.1:{server.socket.getsockname()[1]}/"
        for reader in readers:
            reader.join(timeout=60.0)


def order(kind: str, n_moving: int, **more: object) -> str:
    document = {
        "type": kind,
        "session": "c2f1a09b",
        "key": "00112233445566ff",
        "layout": 1,
        "objects": [f"o{k}" for k in range(n_moving)],
        "n_moving": n_moving,
        "hands": ["left", "right"],
        "sources": [{"id": "o1", "state": "on", "states": ["on"], "frequency_hz": 100.0}],
        "n_bands": 1,
        "sequence": 0,
        "watchdog_s": 0.1,
    }
    return json.dumps({**document, **more})


def gains(sequence: int, intensity: float) -> bytes:
    """Gains for two hands and one source in one band, encoded from the table of the protocol page."""
    begin = struct.pack("<4sBBH8sIId", b"S2HB", 2, 1, 1, bytes(8), sequence, 0, 0.5)
    return begin + struct.pack("<HHHH4f", 2, 1, 1, 0, intensity, intensity, 0.5, 0.25)


def answer_as_desk(connection: ServerConnection, document: dict[str, Any], n_moving: int = 2) -> None:
    """Answer a request like a bridge that plays the desk of the trials."""
    kind, number = document["type"], document.get("id")
    names = ["table", "phone", *(f"o{k}" for k in range(2, n_moving))]
    if kind == "hello":
        connection.send(json.dumps({"type": "welcome", "max_message_bytes": 1 << 25}))
    elif kind == "bake":
        connection.send(json.dumps({"type": "baking", "re": number, "job": 1}))
        connection.send(json.dumps({"type": "baked", "job": 1, "objects": []}))
    elif kind in ("play", "resume"):
        connection.send(order("playing", n_moving, re=number, objects=names))


def sequence_of(frame: bytes) -> int:
    return int.from_bytes(frame[16:20], "little")


def test_both_examples_of_the_protocol_page(programs: Path) -> None:
    blocks = re.findall(r"```\n(53324842[0-9a-f\s]+)```", PAGE.read_text(encoding="utf-8"))
    frame, answer = ["".join(block.split()) for block in blocks]
    command = [str(RUNTIME), str(programs / "game.exe")]
    environment = {**os.environ, "SCENE2HAP_SELF_TEST": "1"}
    done = subprocess.run(command, input=blocks[1], capture_output=True, text=True, env=environment, check=True)
    assert len(answer) == 2 * 56
    assert done.stdout.splitlines() == [
        f"frame {frame}",
        "gains layout 1 sequence 7 skipped 0 time 0.5 hands 2 sources 1 bands 1",
        "hand 0 intensity 0.125 0.5",
        "hand 1 intensity 0 0",
    ]


def test_the_example_of_the_readme(tmp_path: Path) -> None:
    block = re.findall(r"```csharp\n(.*?)```", (CLIENT / "README.md").read_text(encoding="utf-8"), re.DOTALL)[0]
    head = "using System; using System.Threading; using Scene2Hap; class Readme { static void Main() {"
    with serving() as server:
        source = tmp_path / "readme.cs"
        source.write_text(head + block.replace("ws://127.0.0.1:7862/", server.url).replace("600", "1200") + "} }")
        parts = [str(one) for one in sorted(CLIENT.glob("Scene2Hap*.cs"))]
        program = tmp_path / "readme.exe"
        subprocess.run(
            [str(COMPILER), "-langversion:6", "-warnaserror", f"-out:{program}", str(source), *parts], check=True
        )
        with subprocess.Popen([str(RUNTIME), str(program)], stdout=subprocess.PIPE, text=True) as game:
            try:
                assert game.stdout is not None
                assert any(0 < float(line) <= 1 for line in game.stdout)
            finally:
                game.kill()


def test_the_game_of_the_protocol_page(programs: Path) -> None:
    found = check_bridge_client([str(RUNTIME), str(programs / "game.exe")], n_frames=600)
    assert (found.n_frames, found.n_resumed) == (600, 1)


def test_frames_are_sent_without_waiting_for_gains(programs: Path) -> None:
    found = check_bridge_client([str(RUNTIME), str(programs / "game.exe")], n_frames=120, rate_hz=400, cuts=False)
    assert found.n_frames == 120


def test_every_request(trial: Callable[..., list[str]]) -> None:
    with serving() as server:
        lines = trial("requests", server.url)
    sent = [line.split()[1] for line in lines if line.startswith("sent") and line.endswith("True")]
    changes = ["set_source", "set_source", "set_user", "strike", "add", "moving", "remove", "pause", "unpause"]
    assert sent == [*changes, "explain", "stats", "wrong", "leave"]
    for expected in ("started", "gain True", "frequency True", "muted True", "impact table", "mug 2"):
        assert expected in lines
    assert {"order 2 of 3", "order 3 of 3", "order 2 of 2"} <= {*lines}
    assert any(line.startswith("explanation left touches table") for line in lines)
    received = next(int(line.split()[1]) for line in lines if line.startswith("received"))
    assert 4 + 6 * 10 <= received <= 4 + 6 * 11
    errors = [line for line in lines if line.startswith("error")]
    assert len(errors) == 3, errors  # the object without a pose, and two invalid requests
    assert "no pose was set for mug" in errors[0]
    assert "set_source: UnknownObject" in errors[1]
    assert errors[2] == "error point_m is not finite; give finite numbers."
    assert "not finite False" in lines
    assert lines[-2:] == ["left", "state Ready"]


def test_levels_and_prefabs_are_baked_and_saved(trial: Callable[..., list[str]], tmp_path: Path) -> None:
    with serving(root=str(tmp_path)) as server:
        lines = trial("levels", server.url)
    assert (tmp_path / "desk.bundle").is_dir()
    own = ("hello", "play", "resume", "watch", "leave")
    refused = [(f"error {one} is the client's own request; call Play, Watch or Leave.", "request False") for one in own]
    assert [line for line in lines if not line.startswith(("error play: BundleIncomplete", "warning"))] == [
        "failed play BundleIncomplete",
        "started",
        "source True False 0",
        "error 'phnoe' is no object of the session; its pose is not sent.",
        "error 'table' is not among the moving objects; its pose is not sent. Name it in Moving or SetMoving.",
        "poses False False",
        "error 'Left' is no hand of the session; its touch is not sent.",
        "error 'tabel' is no object of the session; its touch is not sent.",
        "touches False False",
        *2 * ["poses False False", "touches False False"],
        "request True",
        "spawn True",
        "too early False False",
        "order 1 of 3",
        "request True",
        "order 1 of 4",
        *chain.from_iterable(refused),
        "left",
        "started",
        "level 2 of 2",
    ]


def test_session_restarts_after_a_server_restart(programs: Path) -> None:
    port = free_port()
    server = start_server(port)
    command = [str(RUNTIME), str(programs / "trials.exe"), "play", f"ws://127.0.0.1:{port}/", "200"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as game:
        try:
            until(game.stdout, "feels")
            server.kill()
            server.wait()
            lost = [line for line in until(game.stdout, "state Connecting") if line.startswith("feels")]
            if lost[-1:] != ["feels nothing"]:  # the watchdog may come before the system closes the connection
                until(game.stdout, "feels nothing")
            with serving(port=port):
                after = until(game.stdout, "feels")
            # Apart from connection errors, the game sees only a new session.
            after = [line for line in after if not line.startswith("error the connection")]
            assert after == ["state Ready", "started", "state Playing", "feels"]
        finally:
            for process in (game, server):
                process.kill()
                process.wait()


def test_a_wrong_token_is_reported_and_not_tried_again(trial: Callable[..., list[str]]) -> None:
    with serving(token=TOKEN) as server:
        lines = trial("play", server.url, 1000, token="another token")  # ends before the trial's timeout
        assert any("4003" in line for line in lines)
        assert "state Failed" in lines
        assert not any(line in ("started", "state Ready") for line in lines)
        assert not any("another token" in line for line in lines)
        assert "feels" in trial("play-until-felt", server.url, token=TOKEN)


def test_an_address_with_tls_is_refused_at_once(trial: Callable[..., list[str]]) -> None:
    lines = trial("play", "wss://127.0.0.1:1/", 60, timeout_s=30.0)
    assert lines[0].startswith("error wss://127.0.0.1:1/ cannot be used: its address must begin with ws://")
    assert sum(line.startswith("error") for line in lines) == 1
    assert "state Failed" in lines


def test_one_client_watches_another(trial: Callable[..., list[str]]) -> None:
    with serving() as server:
        lines = trial("watch", server.url)
    assert [line for line in lines if not line.startswith("warning")] == [
        "started",
        "started",
        "watches True Watching",
        "sends False",
        "error watch: UnknownSession",
        "goes True Watching",
        "error play: BridgeError",
        "goes True Watching",
        "state Ready 0",
        "started",
        "watches True Watching",
        "watched ended",
        "state Ready",
        "left",
    ]


def test_who_watched_has_left_if_the_connection_is_lost_before_the_answer(trial: Callable[..., list[str]]) -> None:
    types: list[str] = []

    def take(connection: ServerConnection, message: str | bytes) -> None:
        document = json.loads(message)
        types.append(document["type"])
        if document["type"] == "watch":
            connection.send(order("watching", 1, re=document["id"]))
        elif document["type"] == "leave":
            connection.close()
        else:
            answer_as_desk(connection, document)

    with mock(take) as url:
        lines = trial("watch-cut", url)
    assert [line for line in lines if not line.startswith("error")] == ["started", "left"]
    assert types == ["hello", "watch", "leave", "hello"]


def test_who_leaves_before_a_second_watch_is_refused_leaves_the_first(trial: Callable[..., list[str]]) -> None:
    asked: list[str] = []

    def take(connection: ServerConnection, message: str | bytes) -> None:
        document = json.loads(message)
        asked.append(document.get("session", document["type"]))
        if asked[-1] == "c2f1a09b":
            connection.send(order("watching", 1, re=document["id"]))
        elif asked[-1] == "77e1a09b":
            error = {"type": "error", "error": "UnknownSession", "message": "gone", "re": document["id"]}
            connection.send(json.dumps(error))
        elif asked[-1] == "leave":
            connection.send(json.dumps({"type": "left", "re": document["id"]}))
        else:
            answer_as_desk(connection, document)

    with mock(take) as url:
        lines = trial("watch-left", url)
    assert [line for line in lines if not line.startswith("error")] == ["started", "left", "state Ready"]
    assert asked == ["hello", "c2f1a09b", "77e1a09b", "leave"]


def test_missing_server_does_not_block_frames(trial: Callable[..., list[str]]) -> None:
    lines = trial("play", f"ws://127.0.0.1:{free_port()}/", 2)
    # With waits of 0.1, 0.2, 0.4 and 0.8 s between attempts, 4 or 5 attempts fit into 2 s.
    assert 3 <= sum(line.startswith("error the connection") for line in lines) <= 5, lines
    assert float(lines[-2].split()[1]) < 0.5
    assert lines[-1] == "disposed"


@pytest.mark.parametrize("seed", [1, 2])
def test_game_survives_200_damaged_messages(trial: Callable[..., list[str]], seed: int) -> None:
    messages = iter(damaged(random.Random(seed), 200))
    # Repeated, since a delayed client reads only the newest of several gains.
    last = iter([*[math.nan] * 20, *[math.inf] * 20])
    n_sent = 0
    is_through = threading.Event()

    def take(connection: ServerConnection, message: str | bytes) -> None:
        nonlocal n_sent
        if isinstance(message, bytes):
            for one in messages:
                connection.send(one, text=isinstance(one, str) or None)
                n_sent += 1
                if n_sent % 20 == 0:
                    break
            else:
                is_through.set()
                connection.send(order("order", 2, objects=["table", "phone"]))
                connection.send(gains(sequence_of(message), next(last, 0.5)))
            return
        answer_as_desk(connection, json.loads(message))

    with mock(take) as url:
        lines = trial("play-until-felt", url)
    assert is_through.is_set()
    assert n_sent == 200
    assert sum(line.startswith("error") for line in lines) > 20  # invalid messages were reported
    assert any(line.endswith("a number that is not finite.") for line in lines)
    assert "feels" in lines  # the game goes on
    assert lines[-1] == "disposed"


def test_outdated_gains_become_zero(trial: Callable[..., list[str]]) -> None:
    """The connection stays open, but the server answers only the first frame."""
    n_answered = 0

    def take(connection: ServerConnection, message: str | bytes) -> None:
        nonlocal n_answered
        if isinstance(message, str):
            answer_as_desk(connection, json.loads(message))
        elif n_answered == 0:
            n_answered += 1
            connection.send(gains(sequence_of(message), 0.5))

    with mock(take) as url:
        lines = trial("play-until-outdated", url)
    assert lines[-5:-2] == ["feels", "feels nothing", "state Playing"]


@pytest.mark.parametrize("knows_job", [True, False])
def test_bake_continues_after_a_lost_connection(trial: Callable[..., list[str]], knows_job: bool) -> None:
    """The first connection is lost during the bake, the second before `playing`. If the server has restarted meanwhile,
    it does not know the job."""
    types: list[str] = []
    unknown = {"type": "error", "error": "BridgeError", "message": "there is no such job."}

    def take(connection: ServerConnection, message: str | bytes) -> None:
        if isinstance(message, bytes):
            connection.send(gains(sequence_of(message), 0.5))
            return
        document = json.loads(message)
        types.append(document["type"])
        if document["type"] == "bake" and types.count("bake") == 1:
            connection.send(json.dumps({"type": "baking", "re": document["id"], "job": 1}))
            connection.close()
        elif document["type"] == "follow":
            assert document["job"] == 1
            answer = {"type": "baked", "job": 1, "objects": []} if knows_job else unknown
            connection.send(json.dumps({**answer, "re": document["id"]}))
        elif document["type"] == "play" and types.count("play") == 1:
            connection.close()
        elif document["type"] == "play" and types.count("play") == 2 and not knows_job:
            connection.send(json.dumps({**unknown, "re": document["id"]}))
        else:
            answer_as_desk(connection, document)

    with mock(take) as url:
        lines = trial("play-until-felt", url)
    assert "feels" in lines
    assert not [line for line in lines if line.startswith("error") and "connection" not in line]
    if knows_job:
        assert types == ["hello", "bake", "hello", "follow", "play", "hello", "play", "leave"]
    else:
        second = ["hello", "follow", "bake", "play"]
        assert types == ["hello", "bake", *second, "hello", "play", "bake", "play", "leave"]


def test_frames_without_gains_are_sent_again_after_a_resume(programs: Path, tmp_path: Path) -> None:
    """The server receives 3 of 6 frames and answers 2; it repeats the last gains after `playing`. Later it answers
    three frames at once."""
    frames: list[bytes] = []
    cut: ServerConnection | None = None

    def take(connection: ServerConnection, message: str | bytes) -> None:
        nonlocal cut
        if connection is cut:  # sent before the cut
            return
        if isinstance(message, bytes):
            frames.append(message)
            if len(frames) <= 2:
                connection.send(gains(len(frames), 0.5))
            elif len(frames) == 6:
                cut = connection
                connection.close()
            elif cut and sequence_of(message) % 3 == 0:
                for back in (2, 1, 0):
                    connection.send(gains(sequence_of(message) - back, 0.5))
        elif json.loads(message)["type"] == "resume":
            connection.send(order("playing", 30, re=json.loads(message)["id"], sequence=3))
            connection.send(gains(3, 0.5))
        elif json.loads(message)["type"] == "leave":
            connection.send(json.dumps({"type": "left", "re": json.loads(message)["id"]}))
        else:
            answer_as_desk(connection, json.loads(message), 30)

    out = tmp_path / "gains.csv"
    with mock(take) as url:
        game = {"SCENE2HAP_URL": url, "SCENE2HAP_FRAMES": "12", "SCENE2HAP_RATE_HZ": "200", "SCENE2HAP_OUT": str(out)}
        command = [str(RUNTIME), str(programs / "game.exe")]
        subprocess.run(command, env={**os.environ, **game}, check=True, timeout=120)
    assert [sequence_of(frame) for frame in frames] == [*range(1, 7), *range(4, 13)]
    assert frames[3:6] == frames[6:9]
    assert out.read_text().split() == [f"{n},0.5,0.25" for n in range(1, 13)]


def damaged(dice: random.Random, n: int) -> Iterator[str | bytes]:
    """Yield damaged server messages: wrong types and values, cut texts, changed bytes."""
    whole: list[dict[str, Any]] = [
        json.loads(order("order", 2)),
        json.loads(order("playing", 2, re=3)),
        {"type": "welcome", "max_message_bytes": 5},
        {"type": "error", "error": "BridgeError", "message": "some text", "re": 2, "job": 1},
        {"type": "progress", "job": 1, "stage": "objects", "item": None, "done": 1, "of": 2},
        {"type": "impact", "object": "phone", "point_m": [0, 0, 0], "felt": {"left": 0.5}},
        {"type": "baking", "job": 1, "re": 1},
        {"type": "baked", "job": 1, "objects": []},
        {"type": "warning", "message": "some text"},
        {"type": "done", "re": 5},
    ]
    values: list[object] = [
        None,
        True,
        -1,
        0,
        1e308,
        2**64,
        0.5,
        "",
        "x" * 9999,
        "\ud800",
        [],
        [[]],
        [None],
        {},
        {"a": {}},
        ["left", 1],
    ]
    for _ in range(n):
        way = dice.randrange(7)
        if way < 3:
            document = dict(dice.choice(whole))
            document[dice.choice([*document])] = dice.choice(values)
            yield json.dumps(document)
        elif way == 3:
            text = json.dumps(dice.choice(whole))
            yield text[: dice.randrange(len(text))]
        elif way == 4:
            yield dice.choice(
                ["[" * 100_000, '{"a":' * 100_000, "null", '{"type":"\\ud8', '{"n":1e999}', '{"n":-}', "\x00", ""]
            )
        elif way == 5:
            message = bytearray(gains(dice.randrange(2**32), 0.5))
            for _ in range(dice.randrange(1, 6)):
                message[dice.randrange(len(message))] = dice.randrange(256)
            yield bytes(message[: dice.choice([len(message), dice.randrange(len(message))])])
        else:
            yield dice.randbytes(dice.randrange(100))


def test_the_frame_of_a_game_allocates_nothing(trial: Callable[..., list[str]]) -> None:
    types = []

    def take(connection: ServerConnection, message: str | bytes) -> None:
        if isinstance(message, bytes):
            connection.send(gains(sequence_of(message), 0.5))
            return
        document = json.loads(message)
        types.append(document["type"])
        if document["type"] == "hello":
            connection.send(json.dumps({"type": "welcome"}))
        elif document["type"] == "play":
            connection.send(order("playing", 30, re=document["id"]))

    def allocated(*arguments: object) -> tuple[int, int]:
        line = next(one for one in trial("garbage", url, *arguments) if one.startswith("allocated")).split()
        assert int(line[5]) >= 1000
        return int(line[1]), int(line[3])

    with mock(take) as url:
        of_game, collections = allocated(10_000)
        # The code that prints the figure allocates less than this, once.
        assert of_game < 1000
        # This covers all threads: 60 bytes per frame would fill the nursery of 512 KB.
        assert collections == 0
        of_game, _ = allocated(1000, "control")
        assert of_game >= 1000 * 16
    assert types == 2 * ["hello", "play", "leave"]  # Dispose sends the last "leave"


def test_pings_are_answered_and_parts_of_messages_joined(trial: Callable[..., list[str]]) -> None:
    is_answered = False

    def take(connection: ServerConnection, message: str | bytes) -> None:
        nonlocal is_answered
        if isinstance(message, bytes):
            answer = gains(sequence_of(message), 0.5)
            connection.send([answer[:1], b"", answer[1:41], answer[41:]])
        elif json.loads(message)["type"] == "hello":
            # Sent while the client waits and has nothing to send.
            is_answered = connection.ping(b"x" * 125).wait(60)
            answer_as_desk(connection, json.loads(message))
        elif json.loads(message)["type"] == "play":
            # Longer than 65535 bytes, with multi-byte characters that the parts split.
            text = order("playing", 2, re=json.loads(message)["id"], objects=["table", "phone"], more="é" * 70_000)
            connection.send([text[:5], text[5:-9], text[-9:]])
        else:
            answer_as_desk(connection, json.loads(message))

    with mock(take) as url:
        lines = trial("play-until-felt", url)
    assert is_answered
    assert "feels" in lines
    assert not [line for line in lines if line.startswith("error")]


def test_server_without_websocket_is_reported(trial: Callable[..., list[str]]) -> None:
    cases = [
        (b"", b"\xc1\x00", "a frame that WebSockets do not have"),  # a reserved bit
        (b"", b"\x81\x81\x00\x00\x00\x00a", "a frame that WebSockets do not have"),  # masked
        (b"", b"\x89\x7e\x00\x7e" + bytes(126), "a control frame that is too long"),
        (b"", b"\x09\x00", "a control frame that is too long"),  # in parts
        (b"", b"\x80\x01a", "parts of messages out of order"),  # a continuation without a beginning
        (b"", b"\x01\x01a\x81\x01b", "parts of messages out of order"),  # a second beginning
        (b"", b"\x83\x00", "parts of messages out of order"),  # an unknown kind
        (b"", b"\x82\x7f" + b"\xff" * 8, "a message of the server is too large"),
        (b"", b"\x82\x7f" + b"\x00\x00\x00\x00\x20\x00\x00\x00", "a message of the server is too large"),
        (b"", b"\x82\x05abc", "it was lost"),
        (b"", b"\x88\x02\x0f\xa3", "the server closed the connection (4003)"),
        (b"", b"\x88\x00", "the server closed the connection (0)"),
        (b"HTTP/1.1 404 Not Found\r\n\r\n", b"", "the server answered HTTP/1.1 404 Not Found"),
        (b"HTTP/1.1 101 Well\r\nSec-WebSocket-Accept: no\r\n\r\n", b"", "the server is no WebSocket server"),
        (b"x" * 20_000, b"", "the server's answer is too long"),
        (b"SSH-2.0\r\n", b"", "it was lost"),
    ]

    def serve_raw() -> None:
        for head, frame, _ in cases:
            connection, _ = listener.accept()
            with connection:
                asked = b""
                while b"\r\n\r\n" not in asked:
                    asked += connection.recv(4096)
                key = re.search(rb"Sec-WebSocket-Key: (\S+)", asked)
                assert key is not None
                digest = hashlib.sha1(key[1] + b"258EAFA5-E914-47DA-95CA-C5AB0DC85B11").digest()
                accept = b"HTTP/1.1 101 Yes\r\nsec-websocket-accept: " + base64.b64encode(digest) + b"\r\n\r\n"
                connection.sendall((head or accept) + frame)
                connection.shutdown(socket.SHUT_WR)
                while connection.recv(4096):  # until the client has given up
                    pass

    with socket.create_server(("127.0.0.1", 0)) as listener:
        thread = threading.Thread(target=serve_raw)
        thread.start()
        lines = trial("first-errors", f"ws://127.0.0.1:{listener.getsockname()[1]}/", len(cases))
        thread.join(60)
    for line, (_, _, expected) in zip(lines, cases, strict=True):
        assert expected in line


def test_unsupported_url_scheme_is_reported(trial: Callable[..., list[str]]) -> None:
    (line,) = trial("first-errors", "wss://127.0.0.1:1/", 1)
    assert line.startswith(
        "wss://127.0.0.1:1/ cannot be used: its address must begin with ws://. This client has no TLS"
    )


@contextmanager
def stalled(programs: Path, trial: str) -> Iterator[tuple[list[str], list[int | str], threading.Event]]:
    """Run a trial that sends large frames to a server which reads nothing until the event is set.

    Yields the words that the trial printed, what the server reads (frame sequences and request types), and the event.
    """
    reads = threading.Event()
    seen: list[int | str] = []

    def take(connection: ServerConnection, message: str | bytes) -> None:
        if isinstance(message, bytes):
            reads.wait(60)
            seen.append(sequence_of(message))
            return
        document = json.loads(message)
        if document["type"] == "hello":
            connection.send(json.dumps({"type": "welcome"}))
        elif document["type"] == "play":
            connection.send(order("playing", 40_000, re=document["id"]))
        else:
            seen.append(document["type"])

    with mock(take) as url:
        command = [str(RUNTIME), str(programs / "trials.exe"), trial, url]
        with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as game:
            try:
                yield until(game.stdout, "sent")[-1].split(), seen, reads
            finally:
                reads.set()
                game.kill()


def wait_for(last: int, seen: list[int | str]) -> None:
    for _ in range(3000):
        if seen[-1:] == [last]:
            return
        time.sleep(0.02)
    raise AssertionError(f"frame {last} did not come: {seen}")


def test_the_newest_frame_wins_while_the_server_does_not_read(programs: Path) -> None:
    with stalled(programs, "stalled") as (sent, seen, reads):
        assert int(sent[1]) == 100
        assert float(sent[3]) < 20.0  # it never waits for the server, which reads nothing for 60 s
        reads.set()
        wait_for(100, seen)
        assert seen == sorted({*seen})
        assert len(seen) < 60, "frames waited that a newer one should have replaced"


def test_64_frames_wait_if_every_one_is_to_be_answered(programs: Path) -> None:
    with stalled(programs, "stalled-every") as (sent, seen, reads):
        assert int(sent[1]) == 64  # of 70
        reads.set()
        wait_for(64, seen)
        assert seen == [*range(1, 21), "pause", *range(21, 65)]


@pytest.mark.parametrize(
    "text",
    [
        *(
            '{"a":[1,2.5,-3e-2,true,false,null,"x"],"b":{}}',
            '"\\u00e9\\n\\"\\\\\\/ é € 𝄞 \\ud834\\udd1e"',
            "[]",
            "-0.0",
        ),
        *("[[[[[[[[1]]]]]]]]", ' { "a" : 1 } ', "1e-400", "9007199254740992"),
    ],
)
def test_json_is_read_and_written_as_python_does(trial: Callable[..., list[str]], text: str) -> None:
    (line,) = trial("json", given=text + "\n")
    assert line.startswith("read "), line
    assert json.loads(line.removeprefix("read ")) == {"v": json.loads(text)}


def test_invalid_json_is_refused_with_its_position(trial: Callable[..., list[str]]) -> None:
    wrong = ['{"a" "b"', "[1,2", '{"a":}', '"abc', "tru", "1 2", "{1:2}", "[1 2]", '"\\x"', "nul", '"\\u12g4"', "--1"]
    wrong += ["1e999", "\t\x01"]
    lines = trial("json", given="\n".join(wrong) + "\n")
    assert len(lines) == len(wrong)
    for line in lines:
        assert re.fullmatch(r"refused .+ at character \d+", line), line


def free_port() -> int:
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        return int(one.getsockname()[1])


def until(lines: Any, begin: str) -> list[str]:
    """The lines up to the one that equals `begin`, or is `begin` followed by a space and a number."""
    found = []
    for line in lines:
        found.append(line.strip())
        if found[-1] == begin or re.fullmatch(re.escape(begin) + r" \d.*", found[-1]):
            return found
    raise AssertionError(f"{begin!r} did not come: {found}")
