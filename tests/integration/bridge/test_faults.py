"""Faults between a client and a bridge: each gives a clear error, and other clients play on."""

import asyncio
import json
import os
import random
import re
import shutil
import signal
import socket
import struct
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from types import SimpleNamespace
from typing import Any
from unittest.mock import Mock

import numpy as np
import pytest
from websockets.asyncio.client import connect as connect_here
from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.sync.client import connect

from bridge_client import Client, Refused
from mutated_messages import ON_TABLE, mutated
from scene2hap import HapticSession, Touch
from scene2hap.bridge import BridgeConfig, BridgeServer
from scene2hap.bridge.client import Client as BridgeClient
from scene2hap.bridge.frames import Gains
from scene2hap.bridge.host import Host
from scene2hap.bridge.hosted_session import HostedSession
from scene2hap.bridge.messages import Play
from scene2hap.bridge.pictures import SentPictures
from scene2hap.bridge.played_session import PlayedSession
from scene2hap.bridge.requests import answer
from scene2hap.cli import main
from scene2hap.common import checks
from scene2hap.errors import BridgeError, ConfigError
from serial_bench import eventually
from systems import needs_links

Bridge = Callable[..., BridgeServer]

TOKEN = "correct horse battery staple"

NO_POSES = np.empty((0, 7), np.float32)


def closing_of(url: str, first: str | bytes | None, **options: Any) -> tuple[int, str, str]:
    """Send a first message. Returns the code and reason with which the server closes, and its text messages before."""
    with connect(url, **options) as raw:
        if first is not None:
            raw.send(first)
        said = ""
        with pytest.raises(ConnectionClosed) as closed:
            while True:
                said += str(raw.recv(timeout=60))
    assert closed.value.rcvd is not None
    return closed.value.rcvd.code, closed.value.rcvd.reason, said


def hello(**fields: Any) -> str:
    return json.dumps({"type": "hello", "version": 1, "client": "tests", **fields})


def assert_plays(client: Client, sequence: int = 1) -> None:
    client.socket.send(client.frame(sequence, float(sequence), NO_POSES, [ON_TABLE]))
    found = client.next_gains()
    while found.sequence != sequence:
        found = client.next_gains()
    assert found.gains.max() > 0.0


def test_the_first_message_is_a_hello(bridge: Bridge) -> None:
    url = bridge().url
    assert closing_of(url, '{"type": "stats"}')[:2] == (4000, "the first message must be a hello")
    assert closing_of(url, b"S2HB")[0] == 4000
    assert closing_of(url, "no json")[0] == 4000
    assert closing_of(url, hello(client="x" * 10_000))[0] == 4000
    assert "at most" in closing_of(url, hello() + " " * 10_000)[1]  # before anything of it is read
    code, _, said = closing_of(url, hello(colour="red"))
    assert code == 4000
    assert "no field 'colour'" in said


def test_other_protocol_version_is_refused(bridge: Bridge) -> None:
    code, _, said = closing_of(bridge().url, json.dumps({"type": "hello", "version": 2, "novelty": []}))
    assert code == 4001
    assert "speaks version 1" in said


def test_a_wrong_token_is_refused_and_never_shown(bridge: Bridge, caplog: pytest.LogCaptureFixture) -> None:
    url = bridge(token=TOKEN).url
    for first in (hello(), hello(token=""), hello(token=TOKEN[:-1]), hello(token="ä" * 10)):
        code, reason, said = closing_of(url, first)
        assert (code, reason) == (4003, "wrong token")
        assert TOKEN not in said
    with Client(url, TOKEN) as client:
        assert client.welcome["type"] == "welcome"
        with pytest.raises(Refused) as refused:
            client.ask("hello", version=1, client="again", token=TOKEN)
        assert TOKEN not in str(refused.value)
    assert TOKEN not in caplog.text


def test_pages_of_foreign_origins_are_refused(bridge: Bridge) -> None:
    url = bridge(origins=["https://game.example"]).url
    foreign = ("https://evil.example", "null", "http://127.0.0.1.evil.example", "http://localhost.evil.example:80", "")
    for origin in foreign:
        with pytest.raises(InvalidStatus) as refused, connect(url, additional_headers={"Origin": origin}):
            pass
        assert refused.value.response.status_code == 403
    for origin in ("http://localhost:8000", "http://127.0.0.1", "http://[::1]:3000", "https://game.example"):
        with Client(url, additional_headers={"Origin": origin}) as client:
            assert client.welcome["type"] == "welcome"


@pytest.mark.parametrize(
    ("request_", "says"),
    [
        ({"type": "play", "bundle": "cut.bundle"}, "cut.bundle/loops.json cannot be read"),
        ({"type": "play", "bundle": "silent.bundle"}, r"silent.bundle lacks sounds/"),
        ({"type": "play", "bundle": "mine"}, r"mine has no bundle.json"),
        ({"type": "play", "bundle": "room.glb"}, "'room.glb' is a file; a bundle is a folder"),
        ({"type": "bake", "path": "mine"}, "'mine' is not a file"),
        ({"type": "bake", "path": "hut.glb"}, "there is no file 'hut.glb'"),
        ({"type": "bake", "path": "room.glb", "save": "mine"}, "mine is not empty and not a bundle"),
        ({"type": "bake", "path": "room.glb", "save": "room.glb/x"}, "room.glb/x cannot be written: room.glb is no"),
    ],
)
def test_an_error_names_a_file_as_the_client_did(
    bridge: Bridge, root: Path, request_: dict[str, Any], says: str
) -> None:
    for name in ("cut.bundle", "silent.bundle"):
        shutil.copytree(root / "desk.bundle", root / name)
    (root / "cut.bundle" / "loops.json").write_text("{")
    shutil.rmtree(root / "silent.bundle" / "sounds")
    (root / "mine").mkdir()
    (root / "mine" / "work.txt").write_text("mine")
    (root / "room.glb").write_text("no GLB")
    with Client(bridge().url) as client:
        client.socket.send(json.dumps(request_))
        with pytest.raises(Refused, match=says) as refused:
            client.hear(lambda one: one["type"] == "error")
    assert str(root) not in str(refused.value)


def test_an_error_of_the_servers_own_settings_does_not_tell_where_its_folders_are(root: Path, tmp_path: Path) -> None:
    sounds = tmp_path / "own" / "recorded sounds"
    bake = {"audio": [{"kind": "library", "folder": str(sounds)}, "synth"]}
    host = Host(BridgeConfig(root=root, bake=bake), owns_process=False)
    assert host.as_told(f"{sounds} is not a folder.") == "a folder of the bridge is not a folder."
    assert host.as_told(f"skipped: {sounds}/fan/a.wav: cut") == "skipped: fan/a.wav: cut"
    assert host.as_told(f"KeyError('a') at {Path(sys.prefix, 'lib', 'a.py')}:3") == "KeyError('a') at lib/a.py:3"
    assert host.as_told(f"{Path.home() / '.cache' / 'x'} cannot be written") == ".cache/x cannot be written"
    assert host.as_told(f"/ {root / 'a'} /etc/x") == "/ a /etc/x"
    assert not host.as_told(f"at {checks.__file__}:3").startswith("at /")


def test_messages_for_a_user_without_a_home_stay(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("os.path.expanduser", str)
    assert Host(BridgeConfig(), owns_process=False).as_told("takes ~ 3 s") == "takes ~ 3 s"


def test_only_the_root_itself_is_left_out_of_messages(root: Path) -> None:
    host = Host(BridgeConfig(root=root), owns_process=False)
    assert host.as_told(f"{root} and {root}. {root}/a {root}//b") == "the bridge's root and the bridge's root. a b"
    beside = f"{root}2/a {root}-old {root}.bak /data{root.as_posix()} /data{root.as_posix()}/a"
    assert host.as_told(beside) == beside
    for config in (BridgeConfig(root=Path("/")), BridgeConfig()):
        assert Host(config, owns_process=False).as_told(beside) == beside


LINK = pytest.param("link/x", marks=needs_links)


@pytest.mark.parametrize("path", ["../outside.bundle", "/etc", "a/../../outside.bundle", LINK, ".", "", "a\0b"])
def test_paths_outside_the_root_are_refused(bridge: Bridge, root: Path, path: str) -> None:
    (root.parent / "outside.bundle").mkdir()
    if path == "link/x":
        (root / "link").symlink_to(root.parent, target_is_directory=True)
    with Client(bridge().url) as client:
        for kind, field in (("play", "bundle"), ("bake", "path")):
            with pytest.raises(Refused, match="below|cannot be used|at least 1"):
                client.ask(kind, **{field: path})
        with pytest.raises(Refused, match="below|cannot be used|at least 1"):
            client.ask("bake", path="desk.glb", save=path)


def test_without_a_root_there_are_no_files(bridge: Bridge) -> None:
    with Client(bridge(root=None).url) as client, pytest.raises(Refused, match="--root"):
        client.ask("play", bundle="desk.bundle")


def _touch(hand: int, thing: int) -> bytes:
    return struct.pack("<IIfff", hand, thing, 0.0, 0.72, 0.0)


def test_failed_requests_are_reported_and_the_session_continues(bridge: Bridge) -> None:
    with Client(bridge().url) as client:
        with pytest.raises(Refused, match="no session"):
            client.ask("pause")
        with pytest.raises(Refused, match="one of bundle and job"):
            client.ask("play")
        with pytest.raises(Refused, match="no bundle|cannot|missing|not"):
            client.ask("play", bundle="nothing.bundle")
        with pytest.raises(Refused, match="must be a model|propagation|kind"):
            client.ask("play", bundle="desk.bundle", session={"propagation": "telepathy"})
        client.play(bundle="desk.bundle", moving=["phone"])
        with pytest.raises(Refused, match="already"):
            client.ask("play", bundle="desk.bundle")
        for message in (
            client.frame(1, 1.0, np.zeros((2, 7)), []),
            client.frame(1, 1.0, np.zeros((1, 7)), []),
            client.frame(1, 1.0, np.full((1, 7), np.nan), []),
            client.frame(1, 1.0, NO_POSES, [])[:-3],
            client.frame(1, 1.0, NO_POSES, [ON_TABLE])[:-20] + b"\xff" * 20,
            client.frame(1, 1.0, NO_POSES, [ON_TABLE])[:-20] + _touch(len(client.order["hands"]), 0),
            client.frame(1, 1.0, NO_POSES, [ON_TABLE])[:-20] + _touch(0, len(client.order["objects"])),
            client.frame(1, 1.0, NO_POSES, [])[:8] + bytes(8) + client.frame(1, 1.0, NO_POSES, [])[16:],
            b"S2HB\x07\x01",
            b"",
        ):
            client.socket.send(message)
            with pytest.raises(Refused):
                client.hear(lambda one: one["type"] == "error")
        assert_plays(client, 9)


BOX = {"id": "cup", "name": "Cup", "pose": {"position_m": [0, 1, 0]}, "geometry": {"kind": "box", "size_m": [1, 1, 1]}}
ROOM = {"format": "scene2hap/scene", "version": 1, "name": "room", "up_axis": "y", "objects": [BOX]}


def mesh(vertex: list[Any]) -> dict[str, Any]:
    shape = {"kind": "mesh", "vertices_m": [vertex, [1, 0, 0], [0, 1, 0], [0, 0, 1]], "faces": [[0, 2, 1], [0, 1, 3]]}
    return {**ROOM, "objects": [{**BOX, "geometry": shape}]}


PYTHON = re.compile(r"\b(None|True|False|nan|inf|dict|tuple|argument|numpy|sys|session\.\w+|\w+\()")
"""Words of Python, which say nothing to authors of clients in other languages."""


@pytest.mark.parametrize(
    ("message", "says"),
    [
        ("", "it is empty"),
        ('{"type": "stats"', "the text ends before"),
        ('{"type": "stats"} x', "the text goes on after"),
        ("{'type': 'stats'}", "straight double quotes"),
        ("null", "it is null"),
        ('{"type": "\\ud800"}', "surrogate"),
        (f'{{"type": "stats", "id": {"9" * 5000}}}', "thousands of digits"),
        ({"type": None}, "is null, which does not exist"),
        ({"type": "stats", "id": True}, "id of stats: .*, got true"),
        ('{"type": "set_user", "gain_db": NaN}', "must be finite, got NaN"),
        ({"type": "set_user", "gain_db": True}, "must be a number.*, got true"),
        ({"type": "set_user", "gain_db": "3"}, "must be a number.*, got '3'"),
        ({"type": "set_source", "source": "phone", "on": 1}, "must be true or false, got 1"),
        ({"type": "set_source", "source": "phone", "on": "no"}, "must be true or false, got 'no'"),
        ({"type": "set_source", "source": "phone", "state": "off"}, "`on` switches"),
        ({"type": "set_user", "profile": {"gain_db": None}}, "got null"),
        ({"type": "strike", "object": "vase", "point_m": [0, 0, 0]}, "There are 'table', 'phone', 'mug'"),
        ({"type": "strike", "object": "mug", "point_m": [0, True, 0]}, "point_m.1 of strike.*, got true"),
        ({"type": "strike", "object": "mug", "point_m": {"x": 0}}, "must be a list, got an object"),
        ({"type": "strike", "object": "mug", "with_object": "mug", "point_m": [0, 0, 0]}, "leave it out for a finger"),
        ({"type": "moving", "moving": ["vase"]}, "There are 'table', 'phone', 'mug'"),
        ({"type": "spawn", "object": "x", "position_m": [0, 0, 0], "prefab": "desk.bundle"}, "Bake each object alone"),
        ({"type": "spawn", "object": "x", "position_m": [0, 0, 0], "prefab": "desk"}, "Did you mean 'desk.bundle'"),
        ({"type": "spawn", "object": "x", "position_m": [0, 0, 0], "prefab": "cup"}, "`bake` with `save` writes one"),
        (b"S2HB\x03\x01\x02\x00{}", "kind is null"),
        (b"S2HB\x03\x01\x01\x00{", "the text ends before"),
    ],
)
def test_errors_speak_the_words_of_the_protocol(bridge: Bridge, root: Path, message: Any, says: str) -> None:
    with Client(bridge().url) as client:
        client.play(bundle="desk.bundle", moving=["phone"])
        client.socket.send(json.dumps(message) if isinstance(message, dict) else message)
        with pytest.raises(Refused, match=says) as refused:
            client.hear(lambda one: one["type"] == "error")
        assert not PYTHON.search(str(refused.value))
        assert str(root) not in str(refused.value)


@pytest.mark.parametrize(
    ("request_", "says"),
    [
        (
            {"session": {"propagation": {"kind": "modal_plate", "colour": 1}}},
            "no setting 'colour'. There are loss_floor",
        ),
        ({"session": {"actuator": {"colour": 1}}}, "no setting 'colour'. There are name, min_frequency_hz"),
        ({"session": {"bands": 3}}, "rising edges .* or a name"),
        ({"session": {"sample_rate_hz": True}}, "neither true nor false, got true"),
        ({"session": {"skip": 3}}, "must be true or false, or a mapping of"),
        ({"scene": ROOM}, "`snapshot` of the bundle"),
        ({"scene": mesh([0, 0, True])}, "vertices_m is not a table of numbers .*: it has true"),
        ({"scene": mesh([0, 0, None])}, "it has null"),
        ({"scene": mesh([0, 0, "1"])}, "it has '1'"),
        ({"scene": mesh([0, 0])}, "rows are not equally long"),
    ],
)
def test_errors_of_settings_and_scenes_do_so_too(bridge: Bridge, request_: dict[str, Any], says: str) -> None:
    with Client(bridge().url) as client, pytest.raises(Refused, match=says) as refused:
        client.ask("play", bundle="desk.bundle", **request_)
    assert not PYTHON.search(str(refused.value))


def test_a_program_that_serves_a_bridge_keeps_the_words_of_python() -> None:
    async def program() -> tuple[str, list[str]]:
        async with BridgeServer({"port": 0}).listening() as server, connect_here(server.url) as ws:
            await ws.send(json.dumps({"type": None}))
            said = str(await ws.recv())
            loop = asyncio.get_running_loop()
            here = [checks.shown(None), await loop.run_in_executor(None, checks.shown, None)]
            return said, [*here, await asyncio.create_task(asyncio.to_thread(checks.shown, None))]

    said, here = asyncio.run(program())
    assert "is null" in said
    assert here == ["None"] * 3


def test_a_play_without_the_sink_that_fails_does_not_free_it(root: Path) -> None:
    async def two() -> None:
        host = Host(BridgeConfig(root=root, sink="memory"), owns_process=False)
        assert await host.take_sink() == "memory"  # of a session that is made
        client = BridgeClient(SentPictures(lambda: root), host.as_told)
        with pytest.raises(ConfigError, match="hands"):
            await answer(Play(type="play", bundle="desk.bundle", hands=["left", "left"], use_sink=False), client, host)
        with pytest.raises(BridgeError, match="another session plays on the sink"):
            await host.take_sink()

    asyncio.run(two())


def test_messages_above_the_size_limit_are_refused(bridge: Bridge) -> None:
    server = bridge(max_message_bytes=12_000_000)
    with Client(server.url) as client, Client(server.url) as other:
        client.play(bundle="desk.bundle", moving=[])
        client.socket.send("[" * 10_000_000)
        with pytest.raises(Refused, match="no JSON object"):
            client.hear(lambda one: one["type"] == "error")
        client.socket.send(b"S2HB\x01\x01" + bytes(10_000_000))
        with pytest.raises(Refused, match="must have"):
            client.hear(lambda one: one["type"] == "error")
        assert_plays(client)
        other.socket.send("x" * 13_000_000)
        with pytest.raises(ConnectionClosed) as closed:
            other.socket.recv(timeout=60)
        assert closed.value.rcvd is not None
        assert closed.value.rcvd.code == 1009
        assert_plays(client, 2)


def test_client_that_does_not_read_is_disconnected(bridge: Bridge) -> None:
    server = bridge(heartbeat_s=60)
    with Client(server.url) as player:
        session = player.play(bundle="desk.bundle", moving=[], frames="every")["session"]
        raw = socket.create_connection(("127.0.0.1", server.port))
        raw.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
        with connect(server.url, sock=raw, max_queue=1, ping_interval=None) as deaf:
            deaf.send(hello())
            deaf.send(json.dumps({"type": "watch", "session": session}))
            assert eventually(lambda: any(one.client.watched for one in server.connections))
            for sequence in range(1, 1500):
                player.socket.send(player.frame(sequence, sequence / 60, NO_POSES, [ON_TABLE]))
                if sequence % 2:
                    player.say("set_source", source="phone", gain_db=-float(sequence % 7))
                player.next_gains()
            # The player is not delayed; at most one message of gains waits for the other client.
            (other,) = [one for one in server.connections if one.client.watched is not None]
            assert other.client.n_waiting <= 1
            raw.close()


def test_too_many_clients(bridge: Bridge) -> None:
    server = bridge(max_clients=2)
    with Client(server.url), Client(server.url):
        assert closing_of(server.url, None)[0] == 4009
    assert eventually(lambda: not server.connections)
    with Client(server.url) as client:
        assert client.welcome["version"] == 1


def test_a_session_that_ends_is_not_resumed(bridge: Bridge, monkeypatch: pytest.MonkeyPatch) -> None:
    """A session on a sink takes up to a quarter of a second to fade out."""
    begins, may_end, close = threading.Event(), threading.Event(), PlayedSession.close

    def close_slowly(played: PlayedSession) -> None:
        begins.set()
        may_end.wait(60.0)
        close(played)

    monkeypatch.setattr(PlayedSession, "close", close_slowly)
    server = bridge()
    with Client(server.url) as lost:
        playing = lost.play(bundle="desk.bundle", keep_s=0.0)
    assert begins.wait(60.0)
    with Client(server.url) as late:
        for request in ({"kind": "resume", "key": playing["key"]}, {"kind": "watch"}):
            with pytest.raises(Refused) as refused:
                late.ask(**request, session=playing["session"])
            assert refused.value.kind == "UnknownSession"
        may_end.set()
        late.play(bundle="desk.bundle")
        assert_plays(late)


def test_a_dead_connection_is_noticed_by_its_heartbeat(bridge: Bridge) -> None:
    server = bridge(heartbeat_s=0.1)
    raw = socket.create_connection(("127.0.0.1", server.port))
    raw.sendall(
        b"GET / HTTP/1.1\r\nHost: 127.0.0.1\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
        b"Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n\r\n"
    )
    assert b"s3pPLMBiTxaQ9kYGzzhZRbK+xOo=" in raw.recv(4096)  # the accept value of RFC 6455, section 1.3
    text = hello().encode()
    mask = b"\x01\x02\x03\x04"
    assert len(text) < 126
    raw.sendall(bytes([0x81, 0x80 | len(text)]) + mask + bytes(b ^ mask[k % 4] for k, b in enumerate(text)))
    raw.settimeout(60)
    heard = b"".join(iter(lambda: raw.recv(4096), b""))  # until the server cuts: the client never answers pings
    raw.close()
    assert b'"welcome"' in heard
    assert b"no answer to a ping" in heard
    assert eventually(lambda: not server.connections)


def test_a_backlog_of_frames_is_not_a_dead_connection(bridge: Bridge, monkeypatch: pytest.MonkeyPatch) -> None:
    """An answer to a ping is read after the frames before it; to process these takes longer than the heartbeat here."""
    update = HapticSession.update

    def slow(self: HapticSession, *args: Any, **options: Any) -> Any:
        time.sleep(0.01)
        return update(self, *args, **options)

    with Client(bridge(heartbeat_s=0.25).url) as client:
        client.play(bundle="desk.bundle", moving=[], frames="every")
        monkeypatch.setattr(HapticSession, "update", slow)
        for sequence in range(1, 101):
            client.socket.send(client.frame(sequence, sequence / 60, NO_POSES, [ON_TABLE]))
        assert [client.next_gains().sequence for _ in range(100)] == [*range(1, 101)]


def test_random_and_mutated_messages(bridge: Bridge) -> None:
    """A short form of `stress/bridge.py`, which sends a hundred thousand messages."""
    rng = random.Random(0)
    server = bridge()
    with Client(server.url) as honest:
        honest.play(bundle="desk.bundle", moving=[])
        client = Client(server.url)
        client.play(bundle="desk.bundle", moving=["phone"])
        for turn in range(500):
            try:
                client.socket.send(mutated(client, rng))
                if turn % 20 == 0:  # the server drops clients that do not read
                    client.ask("stats")
            except ConnectionClosed:
                client = Client(server.url)
                client.play(bundle="desk.bundle", moving=["phone"])
            if turn % 100 == 0:
                assert_plays(honest, turn + 1)
        client.socket.close()


@contextmanager
def program(*words: str) -> Iterator[tuple[subprocess.Popen[str], str]]:
    """Run `scene2hap bridge` as a program. Yields its process and its address."""
    command = [sys.executable, "-m", "scene2hap", "bridge", *words]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env={**os.environ, "PYTHONUNBUFFERED": "1"})
    try:
        assert process.stdout is not None
        yield process, process.stdout.readline().split()[0]
    finally:
        if process.poll() is None:
            process.kill()
        process.communicate()


@pytest.mark.skipif(sys.platform == "win32", reason="signals")
def test_a_server_that_is_killed_and_started_again(root: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    temporary = tmp_path / "temporary"
    temporary.mkdir()
    monkeypatch.setenv("TMPDIR", str(temporary))
    with program("--port", "0", "--root", str(root)) as (process, url):
        client = Client(url)
        client.play(bundle="desk.bundle", moving=[])
        assert_plays(client)
        process.kill()
        with pytest.raises(ConnectionClosed):
            client.next_gains()
        port = url.rstrip("/").rpartition(":")[2]
    with program("--port", port, "--root", str(root)) as (process, url), Client(url) as again:
        with pytest.raises(Refused, match="play` again") as refused:
            again.ask("resume", session=client.order["session"], key=client.order["key"])
        assert refused.value.kind == "UnknownSession"
        again.play(bundle="desk.bundle", moving=[])
        assert_plays(again)
        process.send_signal(signal.SIGTERM)
        assert process.wait(60) == 0
        with pytest.raises(ConnectionClosed) as closed:
            again.next_gains()
        assert closed.value.rcvd is not None
        assert closed.value.rcvd.code == 1001
    assert not [*temporary.iterdir()]


@pytest.mark.skipif(sys.platform == "win32", reason="signals")
def test_the_server_ends_while_a_client_sends_every_frame_and_reads_nothing(root: Path) -> None:
    with (
        program("--port", "0", "--root", str(root)) as (process, url),
        Client(url, max_queue=1, close_timeout=1) as client,
    ):
        client.play(bundle="desk.bundle", moving=[], frames="every")
        until, sequence = time.monotonic() + 60, 0
        while process.poll() is None and time.monotonic() < until:
            sequence += 1
            with suppress(ConnectionClosed):
                client.socket.send(client.frame(sequence, sequence / 60, NO_POSES, [ON_TABLE]))
            if sequence == 100:
                process.send_signal(signal.SIGTERM)
            time.sleep(0.002)
        assert process.poll() == 0


def test_warnings_reach_the_client(root: Path) -> None:
    with program("--port", "0", "--root", str(root)) as (_, url), Client(url) as client:
        client.play(bundle="desk.bundle", moving=[])
        client.socket.send(client.frame(1, 0.0, NO_POSES, [Touch("left", "table", (0.0, 2.0, 0.0))]))
        client.next_gains()
        client.ask("stats")
        (warning,) = [one for one in client.heard if one["type"] == "warning"]
        assert "table" in warning["message"]


def test_port_in_use_is_reported(bridge: Bridge, capsys: pytest.CaptureFixture[str]) -> None:
    port = bridge().port
    assert main(["bridge", "--port", str(port)]) == 1
    assert f"port {port} cannot be used" in capsys.readouterr().err


def test_the_command_needs_a_token_for_a_public_interface(bridge: Bridge, capsys: pytest.CaptureFixture[str]) -> None:
    port = bridge().port  # in use, so that the command would end if it accepted the host
    assert main(["bridge", "--host", "0.0.0.0", "--port", str(port)]) == 1
    assert "needs a token" in capsys.readouterr().err


def test_a_sink_that_a_session_is_about_to_open_is_taken() -> None:
    async def taken_twice() -> None:
        host = Host(BridgeConfig(sink="memory"), owns_process=False)
        assert await host.take_sink() == "memory"
        with pytest.raises(BridgeError, match="another session plays on the sink"):
            await host.take_sink()
        host.give_sink_back()
        assert await host.take_sink() == "memory"

    asyncio.run(taken_twice())


def test_a_resumed_session_is_not_forgotten_at_the_end_of_its_first_wait() -> None:
    """Else a client that is lost twice would have less than `keep_s` to come back."""
    silence = Gains(1, 0, 0, 0.0, 1, np.zeros(1, np.float32), np.zeros((1, 1, 1), np.float32))
    session = SimpleNamespace(pause=Mock(), resume=Mock())
    played = Mock(is_paused=False, session=session, silence=lambda: silence)

    async def lost_and_resumed() -> list[bool]:
        loop, waits = asyncio.get_running_loop(), []
        wait = loop.call_later
        loop.call_later = lambda *given: waits.append(wait(*given)) or waits[-1]  # type: ignore[method-assign]
        hosted = HostedSession(lambda tell: played, "newest", 600.0, Mock())
        await hosted.open(Mock())
        await hosted.lose(hosted.player)
        await hosted.resume(Mock(), hosted.key.hex().upper())
        await hosted.lose(hosted.player)
        return [one.cancelled() for one in waits]

    assert asyncio.run(lost_and_resumed()) == [True, False]
    session.resume.assert_called_once()
