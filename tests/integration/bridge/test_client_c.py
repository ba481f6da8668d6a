"""The client for C and C++: compilation, and tests with a real bridge, scripted servers and hostile servers."""

import base64
import hashlib
import json
import os
import re
import shutil
import socket
import struct
import subprocess
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from websockets.exceptions import ConnectionClosed
from websockets.sync.server import ServerConnection, serve

from bridge_clients import hex_of_page, start_server
from scene2hap import Box, SceneSnapshot, TriMesh
from scene2hap.bridge import BridgeServer
from scene2hap.bridge.frames import Frame, Gains, decode_frame, encode_gains
from scene2hap.testing.bridge_client import check_bridge_client, expected_gains
from serial_bench import eventually
from server_thread import running

MAIN = Path(__file__).parents[3]
CLIENT = MAIN / "clients" / "c"
HERE = Path(__file__).parent / "c"
C = shutil.which("cc") or shutil.which("gcc") or shutil.which("clang")
CPP = shutil.which("c++") or shutil.which("g++") or shutil.which("clang++")
WARNINGS = ("-Wall", "-Wextra", "-Wpedantic", "-Werror", "-Wconversion", "-Wsign-conversion", "-Wshadow")
SANITIZERS = ("-g", "-fsanitize=address,undefined", "-fno-sanitize-recover=all")
needs_cpp = pytest.mark.skipif(CPP is None, reason="no C++ compiler; on Debian: apt-get install g++")

pytestmark = [
    pytest.mark.skipif(C is None, reason="no C compiler; on Debian: apt-get install gcc libc6-dev"),
    pytest.mark.skipif(os.name != "posix", reason="the C client is tested on POSIX systems"),
]

Build = Callable[..., Path]


@pytest.fixture(scope="module")
def build(tmp_path_factory: pytest.TempPathFactory) -> Build:
    """A function that compiles a program once, with all warnings as errors."""
    folder, made = tmp_path_factory.mktemp("c"), dict[tuple[object, ...], Path]()
    (folder / "empty.c").write_text("int main(void) { return 0; }\n")
    command = [str(C), *SANITIZERS, "-o", str(folder / "empty"), str(folder / "empty.c")]
    has_sanitizers = not subprocess.run(command, capture_output=True, check=False).returncode

    def built(*sources: Path, language: str = "c99", flags: tuple[str, ...] = (), sanitized: bool = True) -> Path:
        key = (*sources, language, *flags, sanitized)
        if key not in made:
            compiler = [str(CPP), "-x", "c++"] if "++" in language else [str(C)]
            if sanitized and has_sanitizers:
                flags = (*flags, *SANITIZERS)
            program = folder / f"program{len(made)}"
            command = [*compiler, f"-std={language}", *WARNINGS, *flags, f"-I{CLIENT}", "-o", str(program)]
            run = subprocess.run([*command, *map(str, sources)], capture_output=True, text=True, check=False)
            assert run.returncode == 0, run.stderr
            made[key] = program
        return made[key]

    return built


@pytest.fixture
def game(build: Build) -> Path:
    return build(CLIENT / "example_game.c")


# ---- The example ----


def test_frames_and_gains_equal_the_examples_of_the_page(game: Path) -> None:
    environment = {**os.environ, "SCENE2HAP_SELF_TEST": "1"}
    run = subprocess.run([str(game)], env=environment, capture_output=True, text=True, check=True, timeout=120)
    assert run.stdout.splitlines() == [
        f"frame {hex_of_page('A frame in hexadecimal')}",
        f"of {hex_of_page('Gains that answer it')}",
        "layout 1 sequence 7 skipped 0 time 0.5",
        "intensities 0.125 0",
        "gains 0.5 0",
    ]


def test_c_client_plays_the_reference_game(game: Path) -> None:
    found = check_bridge_client([str(game)])
    assert (found.n_frames, found.n_resumed) == (600, 1)
    assert found.worst < 1e-7


def test_the_example_of_the_readme_feels_the_phone(
    build: Build, tmp_path: Path, bridge: Callable[..., BridgeServer]
) -> None:
    found = re.search(r"```c\n(.*?)```", (CLIENT / "README.md").read_text(encoding="utf-8"), re.DOTALL)
    assert found
    changes = {
        "s2h_create(NULL)": f's2h_create(&(s2h_settings){{.url = "{bridge().url}"}})',  # the default port may be in use
        "frame < 600": "s2h_intensity(client, left) == 0",  # the bake may take longer
    }
    code = found[1]
    for written, run_here in changes.items():
        assert code.count(written) == 1
        code = code.replace(written, run_here)
    source = tmp_path / "readme.c"
    source.write_text(code)
    program = build(source, flags=("-Wno-conversion",))
    run = subprocess.run([str(program)], capture_output=True, text=True, check=True, timeout=120)
    # Progress lines begin with a space; other lines must be numbers.
    intensities = [float(line) for line in run.stdout.splitlines() if not line.startswith(" ")]
    assert 0.0 < intensities[-1] <= 1.0
    assert not any(intensities[:-1])


@needs_cpp
def test_c_client_plays_the_game_compiled_as_c_plus_plus(build: Build) -> None:
    found = check_bridge_client([str(build(CLIENT / "example_game.c", language="c++17"))], n_frames=120)
    assert (found.n_frames, found.n_resumed) == (120, 1)


def test_c_client_plays_the_game_at_a_frame_rate(game: Path) -> None:
    begun_s = time.monotonic()
    found = check_bridge_client([str(game)], n_frames=60, rate_hz=60.0, cuts=False)
    assert (found.n_frames, found.n_resumed) == (60, 0)
    assert time.monotonic() - begun_s > 59 / 60


@pytest.mark.parametrize("language", ["gnu11", "c17", pytest.param("c++20", marks=needs_cpp)])
def test_client_compiles_without_warnings_in_every_language_standard(build: Build, language: str) -> None:
    build(CLIENT / "example_game.c", language=language, flags=("-O2",), sanitized=False)


@needs_cpp
def test_c_plus_plus_uses_the_client_of_a_c_file(build: Build, tmp_path: Path) -> None:
    command = [str(C), "-std=c99", *WARNINGS, f"-I{CLIENT}", "-c", "-o", str(tmp_path / "client.o")]
    subprocess.run([*command, str(HERE / "client.c")], check=True)
    (tmp_path / "engine.cpp").write_text(
        '#include "scene2hap_client.h"\n#include "scene2hap_client.h"\n'
        "int main() { s2h_client* client = s2h_create(nullptr); s2h_event event;\n"
        "(void)s2h_poll(client, &event); s2h_destroy(client); return event.type <= S2H_OFFLINE ? 0 : 1; }\n"
    )
    command = [str(CPP), "-std=c++17", *WARNINGS, "-Wold-style-cast", f"-I{CLIENT}", "-o", str(tmp_path / "engine")]
    subprocess.run([*command, str(tmp_path / "engine.cpp"), str(tmp_path / "client.o")], check=True)
    subprocess.run([str(tmp_path / "engine")], check=True, timeout=120)


def test_c_client_continues_after_a_server_restart(game: Path, tmp_path: Path) -> None:
    with socket.create_server(("127.0.0.1", 0)) as free:
        port = free.getsockname()[1]
    n_frames, out, server = 90, tmp_path / "gains.csv", start_server(port)
    settings = {"SCENE2HAP_URL": f"ws://127.0.0.1:{port}/", "SCENE2HAP_RATE_HZ": "60", "SCENE2HAP_OUT": str(out)}
    player = subprocess.Popen(
        [str(game)],
        env={**os.environ, **settings, "SCENE2HAP_FRAMES": str(n_frames)},
        stderr=subprocess.PIPE,
        text=True,
    )
    try:
        assert player.stderr is not None
        assert next(player.stderr) == "playing from frame 1\n"
        time.sleep(0.5)
        server.kill()
        server.wait()
        server = start_server(port)
        _, said = player.communicate(timeout=120)
        assert player.returncode == 0, said
    finally:
        for process in (player, server):
            process.kill()
            process.wait()
    lines = said.splitlines()
    assert all(line.startswith("offline: ") for line in lines[:-1])
    assert lines[:-1]
    again = re.fullmatch(r"playing from frame (\d+)", lines[-1])
    assert again
    assert 1 < int(again[1]) < n_frames
    rows = [line.split(",") for line in out.read_text().split()]
    assert [int(row[0]) for row in rows] == [*range(1, n_frames + 1)]
    heard = np.array([[float(cell) for cell in row[1:]] for row in rows])
    np.testing.assert_allclose(heard, expected_gains(n_frames).reshape(n_frames, -1), atol=1e-6)


# ---- Random and mutated bytes ----


def test_random_and_mutated_bytes_do_no_harm(build: Build) -> None:
    program = build(HERE / "fuzz.c", flags=("-O1",))
    environment = {**os.environ, "ASAN_OPTIONS": "quarantine_size_mb=8"}
    command = [str(program), "50000"]
    run = subprocess.run(command, env=environment, capture_output=True, text=True, check=False, timeout=120)
    assert run.returncode == 0, run.stderr
    counts = {name: int(n) for name, n in (line.split() for line in run.stdout.splitlines())}
    assert counts["inputs"] == 50_000
    # Enough inputs must reach the code of each state.
    assert min(counts[name] for name in ("playing", "order", "gains", "impact", "answer", "wrong")) > 5000


# ---- The driver ----


class Driver:
    """The client in a driver program that executes commands, one per line."""

    def __init__(self, program: Path, **environment: str) -> None:
        self._process = subprocess.Popen(
            [str(program)],
            env={**os.environ, **environment},
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            encoding="utf-8",
        )
        self.printed: list[str] = []

    def do(self, command: str) -> list[dict[str, Any]]:
        """Send a command. Returns the lines printed until it was done."""
        assert self._process.stdin is not None
        assert self._process.stdout is not None
        self._process.stdin.write(command + "\n")
        self._process.stdin.flush()
        found: list[dict[str, Any]] = []
        for text in self._process.stdout:
            self.printed.append(text)
            found.append(json.loads(text))
            if "did" in found[-1]:
                return found[:-1]
        raise AssertionError(f"the driver ended during {command!r}: {self.end()}")

    def one(self, command: str) -> dict[str, Any]:
        (found,) = self.do(command)
        return found

    def until(self, kind: str, timeout_s: float = 60.0) -> dict[str, Any]:
        """Poll until an event of a kind comes; `before` holds the earlier events."""
        self.before = self.do(f"until {kind} {timeout_s:g}")
        assert self.before, f"no {kind}, and nothing else"
        assert self.before[-1]["event"] == kind, self.before
        return self.before.pop()

    def end(self) -> str:
        """End the program. Returns its error output, which is empty unless a sanitizer found a fault."""
        _, errors = self._process.communicate(timeout=60)
        if self._process.returncode:
            errors += f"status {self._process.returncode}"
        return errors

    def kill(self) -> None:
        self._process.kill()
        self._process.wait()


@pytest.fixture
def driver(build: Build) -> Iterator[Driver]:
    one = Driver(build(HERE / "driver.c", HERE / "client.c"))
    try:
        yield one
        assert not one.end()
    finally:
        one.kill()


def kinds(events: list[dict[str, Any]]) -> list[str]:
    return [one["event"] for one in events]


# ---- Against a bridge ----


def test_client_supports_every_session_request(driver: Driver, bridge: Callable[..., BridgeServer]) -> None:
    driver.do(f"create {bridge().url} - 0 0")
    play = driver.one('play 0 desk.bundle phone,mug newest {"session": {"watchdog_s": 1}}')["request"]
    found = driver.until("playing")
    assert (found["request"], found["is_resumed"], found["sequence"]) == (play, False, 0)
    ids = driver.one("ids")
    assert (ids["objects"], ids["hands"]) == (["phone", "mug", "table"], ["left", "right"])
    (source,) = ids["sources"]
    known = found["message"]["sources"][0]
    assert source.pop("frequency_hz") == pytest.approx(known["frequency_hz"], rel=1e-14)  # 15 digits
    assert source.items() <= known.items()
    assert (source["id"], source["is_on"]) == ("phone", True)
    time_s = 0.0

    def gain() -> tuple[float, float]:
        nonlocal time_s
        time_s += 0.02
        sent = driver.one(f"frame {time_s:g}")["sent"]
        assert sent
        assert driver.until("gains")["of"] == sent
        felt = driver.one("felt left phone")
        assert felt["is_felt"]
        return felt["gain"], felt["intensity"]

    def ask(request: str, answer: str = "answer") -> dict[str, Any]:
        number = driver.one(f"request {request}")["request"]
        found = driver.until(answer)
        assert number
        assert found["request"] == number
        message: dict[str, Any] = found["message"]
        return message

    for command in ("pose phone 0.2 0.724 0", "pose mug -0.3 0.765 0", "touch left table 0"):
        assert driver.one(command)["is_set"] == 1
    full, intensity = gain()
    assert 0.0 < full <= 1.0
    assert 0.0 < intensity <= 1.0
    assert driver.one("felt right phone") == {"is_felt": True, "intensity": 0, "gain": 0}
    assert ask("gain_db phone - -6")["type"] == "done"
    assert gain()[0] == pytest.approx(full * 10 ** (-6 / 20), rel=1e-5)
    ask("gain_db phone - 0")
    ask("mute phone - 1")
    assert gain()[0] == 0.0
    ask("mute phone - 0")
    ask("user_gain_db - - -20")
    assert gain()[0] == pytest.approx(0.1 * full, rel=1e-5)
    ask("user_gain_db - - 0")
    ask("user_mute - - 1")
    assert gain()[0] == 0.0
    ask("user_mute - - 0")
    ask("pause")
    assert gain()[0] == 0.0
    ask("unpause")
    ask("on phone - 0")
    ask("on phone - 1")
    ask(f"state phone {source['state']}")
    assert gain()[0] == pytest.approx(full, rel=1e-4)
    assert driver.one("touch left phone 0.2")["is_set"] == 1
    assert gain()[0] == pytest.approx(1.0)
    driver.do("lift left")
    assert gain()[0] == 0.0
    driver.one("touch left table 0")
    gain()  # the hand must touch the table before the strike
    ask("strike table - 1")
    gain()
    if "impact" not in kinds(driver.before):  # it may come before or after the gains of its frame
        driver.until("impact")
    row = {"id": "tray", "name": "Steel tray", "pose": {"position_m": [0.0, 0.725, -0.2]}}
    row["geometry"] = {"kind": "box", "size_m": [0.3, 0.01, 0.2]}
    assert "tray" in ask(f"add {json.dumps(row)}", "order")["objects"]
    assert driver.one("ids")["objects"][3] == "tray"
    assert ask("remove mug", "order")["objects"] == ["phone", "table", "tray"]
    assert ask("moving tray phone", "order")["n_moving"] == 2
    driver.one("pose tray 0 0.725 -0.2")
    gain()
    text = ask("explain left")["text"]
    assert text
    assert json.loads(driver.printed[-2])["text"] == text
    assert ask("stats")["frames"]["skipped"] == 0
    assert driver.one('request strik {"object": "table"}')["request"]
    error = driver.until("error")
    assert error["error"] == "BridgeError"
    assert "strike" in error["text"]
    ask("leave", "left")
    assert driver.one("frame 9")["sent"] == 0
    assert driver.one("felt left phone") == {"is_felt": False, "intensity": 0, "gain": 0}


def test_another_client_watches(driver: Driver, bridge: Callable[..., BridgeServer], build: Build) -> None:
    server, watcher = bridge(), Driver(build(HERE / "driver.c", HERE / "client.c"))
    try:
        driver.do(f"create {server.url} - 0 0")
        driver.one('play 0 desk.bundle phone newest {"session": {"watchdog_s": 1}}')
        session = driver.until("playing")["message"]["session"]
        watcher.do(f"create {server.url} - 0 0")
        assert watcher.one(f"request watch {session}")["request"]
        assert "key" not in watcher.until("playing")["message"]
        driver.one("pose phone 0.2 0.724 0")
        driver.one("touch left table 0")
        assert driver.one("frame 0.1")["sent"] == 1
        assert watcher.until("gains")["of"] == 1
        assert watcher.one("felt left phone")["gain"] > 0.0
        assert watcher.one("frame 0.1")["sent"] == 0
        driver.do("destroy")
        assert watcher.until("state")["text"] == "waiting"
        watcher.until("gains")
        assert watcher.one("felt left phone") == {"is_felt": True, "intensity": 0, "gain": 0}
        watcher.do("destroy")
        assert not watcher.end()
    finally:
        watcher.kill()


def test_a_wrong_token_is_final_and_is_never_shown(driver: Driver, bridge: Callable[..., BridgeServer]) -> None:
    driver.do(f"create {bridge(token='the-right-one').url} another 0 0")
    offline = driver.until("offline")
    assert (offline["code"], offline["wait_s"]) == (4003, -1)
    assert "token" in driver.before[0]["text"]
    assert kinds(driver.before) == ["error"]
    assert not driver.do("run 0.5")
    assert "another" not in "".join(driver.printed)


def test_a_picture_is_taken(driver: Driver, bridge: Callable[..., BridgeServer]) -> None:
    driver.do(f"create {bridge().url} - 0 0")
    driver.until("online")
    assert driver.one("request picture phone front")["request"] == 1
    error = driver.until("error")  # the image is incomplete, but the error names its object
    assert "phone" in error["text"] or "picture" in error["text"]


def test_client_reports_a_missing_server_and_connects_later(driver: Driver) -> None:
    with socket.create_server(("127.0.0.1", 0)) as free:
        port = free.getsockname()[1]
    driver.do(f"create ws://localhost:{port}/ - 0 0")
    waits = [driver.until("offline")["wait_s"] for _ in range(3)]
    assert waits == [0.25, 0.5, 1.0]
    assert driver.one("request pause")["request"] == 0
    assert driver.until("error")["error"] == "ConnectionLost"
    with scripted(until_closed, port):
        driver.until("online")


@pytest.mark.parametrize(
    "url",
    [
        "http://127.0.0.1:1/",
        "ws://",
        "ws://127.0.0.1:0/",
        "ws://127.0.0.1:99999/",
        "ws://127.0.0.1:1x/",
        "ws://[::1/",
        "ws://127.0.0.1:1/\r",
        "ws://user@127.0.0.1:1/",
        "ws://" + "a" * 400 + "/",
        "ws://127.0.0.1:1/" + "a" * 2000,
    ],
)
def test_invalid_url_is_a_final_error(driver: Driver, url: str) -> None:
    driver.do(f"create {url} - 0 0")
    offline = driver.until("offline")
    assert offline["wait_s"] == -1
    assert "cannot be used" in offline["text"]


# ---- Against a scripted server ----

ORDER = {
    "session": "s",
    "key": "00112233445566ff",
    "layout": 1,
    "objects": ["phone", "table"],
    "n_moving": 1,
    "hands": ["left", "right"],
    "sources": [{"id": "phone", "state": "on", "states": ["on"], "is_on": True, "frequency_hz": 100.0}],
    "n_bands": 1,
    "sequence": 0,
    "watchdog_s": 0.5,
}


@contextmanager
def scripted(handle: Callable[[ServerConnection, int], object], port: int = 0, **welcome: object) -> Iterator[str]:
    """Run a server that greets each client, then calls `handle` with its connection and number. Yields its URL."""
    failures: list[BaseException] = []
    connections: list[ServerConnection] = []

    def handler(ws: ServerConnection) -> None:
        connections.append(ws)
        number = len(connections) - 1
        try:
            hello = json.loads(ws.recv(60))
            assert (hello["type"], hello["version"], hello["client"]) == ("hello", 1, "driver")
            ws.send(json.dumps({"type": "welcome", "version": 1, "re": hello["id"], **welcome}))
            handle(ws, number)
        except ConnectionClosed:
            pass
        except BaseException as error:
            failures.append(error)
            raise

    with serve(handler, "127.0.0.1", port, compression=None, max_size=None) as server, running(server):
        try:
            yield f"ws://127.0.0.1:{server.socket.getsockname()[1]}/"
        finally:
            for ws in connections:  # or the server would wait for replies to its close frames
                with suppress(OSError):
                    ws.socket.shutdown(socket.SHUT_RDWR)
    assert not failures, failures


def until_closed(ws: ServerConnection, _: int = 0) -> None:
    """Receive messages until the connection is closed, which raises and ends `handle`."""
    while True:
        ws.recv()


def next_request(ws: ServerConnection, kind: str) -> dict[str, Any]:
    message: dict[str, Any] = json.loads(ws.recv(60))
    assert message["type"] == kind, message
    return message


def say(ws: ServerConnection, kind: str, **fields: object) -> None:
    ws.send(json.dumps({"type": kind, **fields}))


def begin(ws: ServerConnection, **order: object) -> dict[str, Any]:
    """Answer the `play` request. Returns the request."""
    message = next_request(ws, "play")
    say(ws, "playing", re=message["id"], **{**ORDER, **order})
    return message


def next_frame(ws: ServerConnection) -> Frame:
    message = ws.recv(60)
    assert isinstance(message, bytes), message
    return decode_frame(message)


def gains_of(sequence: int, *, layout: int = 1, intensity: float = 0.25, gain: float = 0.75, flags: int = 0) -> bytes:
    gains = np.array([[[0.0]], [[gain]]], np.float32)
    return encode_gains(Gains(layout, sequence, 5, 0.0, flags, np.array([intensity, 0.0], np.float32), gains))


def start(driver: Driver, url: str) -> None:
    """Start playing, and set a pose of the phone."""
    driver.do(f"create {url} - 0 0")
    driver.one("play 0 b phone newest")
    driver.until("playing")
    driver.one("pose phone 1 2 3")


def test_acknowledged_poses_are_not_sent_again(driver: Driver) -> None:
    n_poses = []

    def handle(ws: ServerConnection, _: int) -> None:
        assert begin(ws)["moving"] == ["phone"]
        for answers in (False, True, False, True, False):
            frame = next_frame(ws)
            n_poses.append(len(frame.poses))
            if answers:
                ws.send(gains_of(frame.sequence))
        say(ws, "warning", message="all")
        until_closed(ws)

    with scripted(handle) as url:
        start(driver, url)
        driver.do("frame 0.1")  # not answered, so that the next frame repeats its poses
        driver.do("frame 0.2")
        driver.until("gains")
        driver.do("frame 0.3")
        driver.one("pose phone 1 2 3")  # unchanged
        driver.do("frame 0.4")
        driver.until("gains")
        driver.one("pose phone 1 2 3.5")
        driver.do("frame 0.5")
        driver.until("warning")
    assert n_poses == [1, 1, 0, 0, 1]


def test_outdated_gains_become_zero_and_invalid_gains_are_ignored(driver: Driver) -> None:
    nan = gains_of(4, gain=float("nan"))
    wrong = [gains_of(4, layout=2), nan, gains_of(4)[:-1], gains_of(4) + b"\0", b"S2HB", b""]

    def handle(ws: ServerConnection, _: int) -> None:
        begin(ws)
        ws.send(gains_of(1, flags=3))
        ws.send(gains_of(2, intensity=7.0))
        ws.send(gains_of(3, intensity=-7.0))
        ws.send(b"S2HB\x09\x01later kind")
        next_request(ws, "pause")
        for one in wrong:
            ws.send(one)
        say(ws, "order", **{**ORDER, "layout": 2})  # after a new order, invalid gains may be reported again
        ws.send(gains_of(4, layout=2))
        ws.send(gains_of(5, layout=1))  # computed before the order
        for one in wrong[1:]:
            ws.send(one)
        until_closed(ws)

    with scripted(handle) as url:
        driver.do(f"create {url} - 0 0")
        driver.one("play 0 b phone newest")
        first = driver.until("gains")
        assert (first["of"], first["n_skipped"], first["is_paused"], first["is_preparing"]) == (1, 5, True, True)
        assert driver.one("felt left phone") == {"is_felt": True, "intensity": 0.25, "gain": 0}
        assert driver.one("felt right phone") == {"is_felt": True, "intensity": 0, "gain": 0.75}
        driver.until("gains")
        assert driver.one("felt left phone")["intensity"] == 1.0
        driver.until("gains")
        assert driver.one("felt left phone")["intensity"] == 0.0
        assert driver.one("felt right other") == {"is_felt": True, "intensity": 0, "gain": 0}
        driver.do("run 0.7")
        assert driver.one("felt right phone") == {"is_felt": False, "intensity": 0, "gain": 0}
        driver.one("request pause")
        found = driver.until("gains")
        assert (found["of"], found["layout"]) == (4, 2)
        assert kinds(driver.before) == ["error", "order"]  # six invalid messages, reported once
        found = driver.until("gains")
        assert (found["of"], found["layout"]) == (5, 1)
        assert driver.one("felt right phone")["gain"] == 0.75
        driver.until("error")
        assert driver.one("felt right phone")["gain"] == 0


def test_forgotten_session_is_baked_and_played_again(driver: Driver) -> None:
    scene = {"objects": [{"id": "é"}]}

    def handle(ws: ServerConnection, number: int) -> None:
        if number == 0:
            message = next_request(ws, "bake")
            assert message["scene"] == scene
            ws.socket.close()  # while it bakes
            return
        if number == 2:
            message = next_request(ws, "resume")
            assert (message["session"], message["key"]) == ("s", ORDER["key"])
            say(ws, "error", error="UnknownSession", message="gone", re=message["id"])
            message = next_request(ws, "play")
            assert message["job"] == 1
            say(ws, "error", error="BridgeError", message="there is no job 1", re=message["id"])
        message = next_request(ws, "bake")
        assert message["scene"] == scene
        say(ws, "baking", re=message["id"], job=number)
        say(ws, "baked", job=number, objects=[])
        message = begin(ws, layout=number)
        assert message["job"] == number
        assert (message["moving"], message["frames"]) == (["phone"], "every")
        assert next_frame(ws).sequence == 1
        if number == 1:
            next_request(ws, "pause")
            ws.socket.close()
        until_closed(ws)

    with scripted(handle) as url:
        driver.do(f"create {url} - 0 0")
        bake = driver.one(f"bake {json.dumps(scene)}")["request"]
        baked = driver.until("baked")
        assert kinds(driver.before) == ["online", "offline", "online", "baking"]
        assert (baked["request"], baked["job"]) == (bake, 1)
        driver.one("play 1 - phone every")
        driver.until("playing")
        driver.one("pose phone 1 2 3")
        assert driver.one("frame 5")["sent"] == 1
        pause = driver.one("request pause")["request"]
        playing = driver.until("playing")
        assert kinds(driver.before) == ["error", "offline", "online", "baking"]
        lost = driver.before[0]
        assert (lost["error"], lost["request"]) == ("ConnectionLost", pause)
        assert not playing["is_resumed"]
        assert driver.one("frame 1")["sent"] == 1  # the clock may restart


def test_a_session_that_ended_is_played_again_without_a_bake(driver: Driver) -> None:
    def handle(ws: ServerConnection, number: int) -> None:
        if number == 0:
            message = next_request(ws, "bake")
            say(ws, "baking", re=message["id"], job=8)
            say(ws, "baked", job=8, objects=[])
        else:
            message = next_request(ws, "resume")
            say(ws, "error", error="UnknownSession", message="gone", re=message["id"])
        assert begin(ws)["job"] == 8
        if number == 0:
            ws.socket.close()
            return
        until_closed(ws)

    with scripted(handle) as url:
        driver.do(f"create {url} - 0 0")
        driver.one("bake {}")
        driver.one("play 0 - phone newest")  # plays the bake once it ends
        assert not driver.until("playing")["is_resumed"]
        assert kinds(driver.before) == ["online", "baking", "baked"]
        assert not driver.until("playing")["is_resumed"]
        assert kinds(driver.before) == ["offline", "online"]


@pytest.mark.parametrize("is_forgotten", [False, True])
def test_a_bake_is_followed_over_the_next_connection(driver: Driver, is_forgotten: bool) -> None:
    def handle(ws: ServerConnection, number: int) -> None:
        if number == 0:
            message = next_request(ws, "bake")
            say(ws, "baking", re=message["id"], job=7)
            ws.socket.close()
            return
        message = next_request(ws, "follow")
        assert message["job"] == 7
        if number == 1:
            say(ws, "baking", re=message["id"], job=7)
            say(ws, "progress", job=7, stage="infer", item="phone", done=1, of=2)
            ws.socket.close()
            return
        if is_forgotten:
            say(ws, "error", error="BridgeError", message="there is no job 7", re=message["id"])
            message = next_request(ws, "bake")
            assert message["scene"] == {"name": "x"}
            say(ws, "baking", re=message["id"], job=9)
            say(ws, "baked", job=9, objects=[])
        else:
            say(ws, "baked", re=message["id"], job=7, objects=[])
        until_closed(ws)

    with scripted(handle) as url:
        driver.do(f"create {url} - 0 0")
        bake = driver.one('bake {"name": "x"}')["request"]
        baked = driver.until("baked")
        assert (baked["request"], baked["job"]) == (bake, 9 if is_forgotten else 7)
        expected = ["online", "baking", "offline", "online", "baking", "progress", "offline", "online"]
        assert kinds(driver.before) == expected + is_forgotten * ["baking"]


def test_a_session_is_resumed_with_its_frames(driver: Driver) -> None:
    frames: list[int] = []

    def handle(ws: ServerConnection, number: int) -> None:
        if number == 0:
            begin(ws)
            frames.extend(next_frame(ws).sequence for _ in range(3))
            ws.send(gains_of(1))
            ws.socket.close()
            return
        message = next_request(ws, "resume")
        say(ws, "playing", re=message["id"], **{**ORDER, "sequence": 2})
        ws.send(gains_of(2))
        frame = next_frame(ws)
        frames.append(frame.sequence)
        assert len(frame.poses) == 1
        say(ws, "warning", message="all")
        until_closed(ws)

    with scripted(handle) as url:
        start(driver, url)
        for time_s in (0.1, 0.2, 0.3):
            driver.do(f"frame {time_s}")
        playing = driver.until("playing")
        assert (playing["is_resumed"], playing["sequence"]) == (True, 2)
        assert driver.one("frame 0.3")["sent"] == 3
        assert driver.until("gains")["of"] == 2
        assert driver.one("felt right phone")["gain"] == 0.75
        driver.until("warning")
    assert frames == [1, 2, 3, 3]


def test_a_refused_play_is_not_tried_again(driver: Driver) -> None:
    def handle(ws: ServerConnection, number: int) -> None:
        if number == 0:
            message = next_request(ws, "play")
            say(ws, "error", error="BridgeError", message="no bundle", re=message["id"])
            time.sleep(0.2)
            ws.socket.close()
        else:
            next_request(ws, "pause")
            until_closed(ws)

    with scripted(handle) as url:
        driver.do(f"create {url} - 0 0")
        play = driver.one("play 0 b * newest")["request"]
        error = driver.until("error")
        assert (error["error"], error["text"], error["request"]) == ("BridgeError", "no bundle", play)
        driver.until("offline")
        driver.until("online")
        driver.one("request pause")
        driver.do("run 0.2")


def test_requests_carry_all_of_their_values_exactly(driver: Driver) -> None:
    heard: list[dict[str, Any]] = []

    def handle(ws: ServerConnection, _: int) -> None:
        while len(heard) < 64:
            heard.append(json.loads(ws.recv()))
        say(ws, "warning", message="all")
        until_closed(ws)

    commands = {
        "on phone - 0": {"type": "set_source", "source": "phone", "on": False},
        'state a"b\\ loud': {"type": "set_source", "source": 'a"b\\', "state": "loud"},
        "gain_db phone - -6.25": {"type": "set_source", "source": "phone", "gain_db": -6.25},
        "mute \U0001f600 - 1": {"type": "set_source", "source": "\U0001f600", "mute": True},
        "user_gain_db - - 3.5": {"type": "set_user", "gain_db": 3.5},
        "user_mute - - 0": {"type": "set_user", "mute": False},
        "strike table mug 1.5": {
            "type": "strike",
            "object": "table",
            "point_m": [0.1, 0.72, -1e-5],
            "speed_m_s": 1.5,
            "with_object": "mug",
        },
        'add {"id": "mug", "x": [1, {}]}': {"type": "add", "object": {"id": "mug", "x": [1, {}]}},
        "remove mug": {"type": "remove", "object": "mug"},
        "moving a b": {"type": "moving", "moving": ["a", "b"]},
        "pause": {"type": "pause"},
        "unpause": {"type": "unpause"},
        "explain left": {"type": "explain", "hand": "left"},
        'cancel {"job": 1}': {"type": "cancel", "job": 1},
        'spawn { "a\\u0062" : [1.50, true ] , "b":null}': {"type": "spawn", "ab": [1.5, True], "b": None},
        "stats {}": {"type": "stats"},
        "leave": {"type": "leave"},
    }
    refused = ['add {"id": }', "cancel [1]", 'cancel {"job": 1} x', 'cancel {"job": 1}}', 'cancel {"job": 1, "type": }']
    with scripted(handle) as url:
        driver.do(f"create {url} - 0 0")
        driver.until("online")
        sent = [driver.one(f"request {command}")["request"] for command in commands]
        assert all(sent)
        for command in refused:
            assert driver.one(f"request {command}")["request"] == 0
            assert driver.until("error")["error"] == "WrongRequest"
        n_left = 64 - len(commands)
        assert all(driver.one("request pause")["request"] for _ in range(n_left))
        assert driver.one("request pause")["request"] == 0
        assert driver.until("error")["error"] == "TooManyRequests"
        driver.until("warning")
    assert [one.pop("id") for one in heard[: len(sent)]] == sent
    assert heard[: len(sent)] == [*commands.values()]
    assert len(heard) == 64


def test_oversized_messages_are_not_sent(driver: Driver) -> None:
    def handle(ws: ServerConnection, _: int) -> None:
        next_request(ws, "pause")
        until_closed(ws)

    with scripted(handle, max_message_bytes=1000) as url:
        driver.do(f"create {url} - 0 10000")
        driver.until("online")
        assert driver.one("bake_large 2000")["request"] == 0
        error = driver.until("error")
        assert error["error"] == "MessageTooLarge"
        assert "the server takes 1000" in error["text"]
        driver.one("request pause")
        driver.do("run 0.2")
    with scripted(until_closed) as url:
        driver.do(f"create {url} - 0 10000")
        driver.one("bake_large 20000")
        assert driver.until("error")["error"] == "TooMuchToSend"


def test_invalid_frame_data_is_reported_once(driver: Driver) -> None:
    frames: list[Frame] = []

    def handle(ws: ServerConnection, _: int) -> None:
        begin(ws)
        frames.extend(next_frame(ws) for _ in range(3))
        say(ws, "warning", message="all")
        until_closed(ws)

    with scripted(handle) as url:
        driver.do(f"create {url} - 0 0")
        driver.one("play 0 b * newest")
        driver.until("playing")
        for time_s in (3, 1, 2):  # a clock may go back
            assert driver.one("wrong_pose phone")["is_set"] == 0
            driver.one("touch third table 0")
            driver.one("touch left lamp 0")
            driver.one("touch right table 0.5")
            assert driver.one(f"frame {time_s}")["sent"]
        driver.until("warning")
        texts = [one["text"] for one in driver.before]
    assert len(texts) == 4
    for name, text in zip(("phone", "phone", "third", "lamp"), texts, strict=True):
        assert text.startswith(f"{name}: ")
    assert [len(frame.poses) for frame in frames] == [0, 0, 0]
    assert [frame.time_s for frame in frames] == [3.0, 1.0, 2.0]
    for frame in frames:
        ((hand, thing, point),) = frame.touches.tolist()
        assert (hand, thing, [*point]) == (1, 1, [0.5, float(np.float32(0.72)), 0.0])


def test_the_newest_frame_wins_when_the_server_does_not_read(driver: Driver) -> None:
    def serving_slowly(sock: socket.socket) -> None:
        greet(sock)
        answer_play(sock)
        is_flooded.wait(60)
        decoder = read_messages(sock)
        poses.extend(float(decode_frame(payload).poses[0, 0]) for first, payload in decoder if first == 0x82)

    is_flooded, poses = threading.Event(), list[float]()
    with raw(serving_slowly) as url:
        driver.do(f"create {url} - 0 0")
        driver.one("play 0 b phone newest")
        driver.until("playing")
        counted = driver.one("flood 1")
        is_flooded.set()
        assert eventually(lambda: (driver.do("run 0.02"), len(poses) >= counted["n_sent"])[1])
        last = driver.one("frame 1")["sent"]
        assert eventually(lambda: (driver.do("run 0.02"), len(poses) >= last)[1])
        driver.do("destroy")
    assert counted["n_sent"] < counted["n"] / 2  # the network accepted no more
    assert last == counted["n_sent"] + 1
    assert len(poses) == last  # all sent frames arrive in order
    assert poses[-1] == counted["n"]  # the newest pose arrives, though the last frames of the flood were dropped
    assert poses == sorted(poses)


# ---- WebSockets, byte by byte ----


def accept_of(key: str) -> str:
    digest = hashlib.sha1(key.encode() + b"258EAFA5-E914-47DA-95CA-C5AB0DC85B11").digest()
    return base64.b64encode(digest).decode()


@contextmanager
def raw(handle: Callable[[socket.socket], object]) -> Iterator[str]:
    """Run a TCP server that passes each connection to `handle`. Yields its URL."""
    failures: list[BaseException] = []
    with socket.create_server(("127.0.0.1", 0)) as listening:

        def run() -> None:
            try:
                while True:
                    with listening.accept()[0] as sock:
                        sock.settimeout(60)
                        handle(sock)
            except OSError:  # the listener was closed
                pass
            except BaseException as error:
                failures.append(error)
                raise

        thread = threading.Thread(target=run)
        thread.start()
        try:
            yield f"ws://127.0.0.1:{listening.getsockname()[1]}/some?path"
        finally:
            listening.shutdown(socket.SHUT_RDWR)
            thread.join()
    assert not failures, failures


def read_head(sock: socket.socket) -> dict[str, str]:
    """Read the client's request. Returns its headers."""
    head = b""
    while not head.endswith(b"\r\n\r\n"):
        head += sock.recv(1)
    request, *lines = head.decode("ascii").split("\r\n")[:-2]
    assert request == "GET /some?path HTTP/1.1"
    return dict(line.split(": ") for line in lines)


def head_of(key: str) -> bytes:
    return (
        "HTTP/1.1 101 Switching Protocols\r\nupgrade: WebSocket\r\nconnection: keep-alive, Upgrade\r\n"
        f"SEC-WEBSOCKET-ACCEPT:{accept_of(key)}  \r\n\r\n"
    ).encode()


def greet(sock: socket.socket, *, with_head: bytes = b"", heartbeat_s: float = 60.0) -> None:
    """Do the handshake, `hello` and `welcome`; `with_head` is sent in the same packet as the head."""
    headers = read_head(sock)
    assert headers["Host"] == f"127.0.0.1:{sock.getsockname()[1]}"
    assert (headers["Upgrade"], headers["Connection"], headers["Sec-WebSocket-Version"]) == (
        "websocket",
        "Upgrade",
        "13",
    )
    assert len(base64.b64decode(headers["Sec-WebSocket-Key"])) == 16
    sock.sendall(head_of(headers["Sec-WebSocket-Key"]) + with_head)
    first, payload = next(read_messages(sock))
    assert first == 0x81
    hello = json.loads(payload)
    welcome = {"type": "welcome", "re": hello["id"], "heartbeat_s": heartbeat_s}
    sock.sendall(frame(0x81, json.dumps(welcome).encode()))


def answer_play(sock: socket.socket) -> None:
    _, payload = next(read_messages(sock))
    sock.sendall(frame(0x81, json.dumps({"type": "playing", "re": json.loads(payload)["id"], **ORDER}).encode()))


def frame(first: int, payload: bytes, length: bytes | None = None) -> bytes:
    """A WebSocket frame of a server; `length` replaces the bytes of its length."""
    n = len(payload)
    if length is None:
        length = bytes([n]) if n < 126 else struct.pack(">BH", 126, n) if n < 1 << 16 else struct.pack(">BQ", 127, n)
    return bytes([first]) + length + payload


def read_exactly(sock: socket.socket, n: int) -> bytes:
    found = b""
    while len(found) < n:
        got = sock.recv(n - len(found))
        if not got:
            raise ConnectionError
        found += got
    return found


def read_messages(sock: socket.socket) -> Iterator[tuple[int, bytes]]:
    """Yield the first byte and payload of each frame of the client, until it closes the connection."""
    masks = set()
    while True:
        try:
            first, second = read_exactly(sock, 2)
        except ConnectionError:
            return
        assert second & 0x80, "a frame of a client must be masked"
        n = second & 0x7F
        if n == 126:
            (n,) = struct.unpack(">H", read_exactly(sock, 2))
        elif n == 127:
            (n,) = struct.unpack(">Q", read_exactly(sock, 8))
        mask = read_exactly(sock, 4)
        masks.add(mask)
        payload = np.frombuffer(read_exactly(sock, n), np.uint8) ^ np.resize(np.frombuffer(mask, np.uint8), n)
        yield first, payload.tobytes()


def test_masks_are_random(driver: Driver) -> None:
    masks: list[bytes] = []

    def handle(sock: socket.socket) -> None:
        greet(sock)
        for _ in range(20):
            _, second = read_exactly(sock, 2)
            masks.append(read_exactly(sock, 4))
            read_exactly(sock, second & 0x7F)
        sock.sendall(frame(0x81, b'{"type": "warning", "message": "all"}'))

    with raw(handle) as url:
        driver.do(f"create {url} - 0 0")
        driver.until("online")
        for _ in range(20):
            driver.one("request pause")
        driver.until("warning")
    assert len({*masks}) == 20
    counts = np.unpackbits(np.frombuffer(b"".join(masks), np.uint8)).sum()
    assert 200 < counts < 440  # of 640 bits; outside by chance once in 10**20


def test_messages_in_pieces_with_pings_between_them(driver: Driver) -> None:
    answered: list[tuple[int, bytes]] = []
    text = json.dumps({"type": "warning", "message": "é" * 40000 + "\U0001f600"}, ensure_ascii=False).encode()

    def handle(sock: socket.socket) -> None:
        # The first message comes in the packet of the head, and its type is unknown to this client.
        greet(sock, with_head=frame(0x81, b'{"type": "early", "re": null}') + frame(0x8A, b"nobody asked for it"))
        sock.sendall(frame(0x01, text[:11]) + frame(0x89, b"one") + frame(0x00, b""))
        sock.sendall(frame(0x00, text[11:70001]))
        for byte in frame(0x80, text[70001:]):
            sock.sendall(bytes([byte]))
        messages = read_messages(sock)
        answered.append(next(messages))
        sock.sendall(frame(0x89, b""))
        answered.append(next(messages))
        sock.sendall(frame(0x89, bytes(range(125))))
        answered.append(next(messages))
        sock.sendall(frame(0x88, struct.pack(">H", 1001) + "until later €".encode()))
        answered.append(next(messages))

    with raw(handle) as url:
        driver.do(f"create {url} - 0 0")
        assert driver.until("warning")["text"] == "é" * 40000 + "\U0001f600"
        offline = driver.until("offline")
        assert offline["code"] == 1001
        assert "until later €" in offline["text"]
    assert answered == [(0x8A, b"one"), (0x8A, b""), (0x8A, bytes(range(125))), (0x88, struct.pack(">H", 1001))]


def test_pings_are_answered_while_a_long_message_is_sent(driver: Driver) -> None:
    """Without answers, the server would close the connection during the upload of a large scene."""
    heard: list[tuple[int, bytes]] = []

    def handle(sock: socket.socket) -> None:
        sock.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 1 << 18)
        greet(sock)
        for i, (first, payload) in enumerate(read_messages(sock)):
            heard.append((first, payload))
            if i == 0:
                sock.sendall(frame(0x89, b"are you there"))
            if first & 0x80 and first & 0x0F == 0:
                break
            time.sleep(0.02 if i < 20 else 0)
        sock.sendall(frame(0x81, b'{"type": "warning", "message": "all"}'))
        read_exactly(sock, 1)

    with raw(handle) as url:
        driver.do(f"create {url} - 0 0")
        driver.until("online")
        driver.one("bake_large 8000000")
        driver.until("warning")
        driver.do("destroy")
    opcodes = [first for first, _ in heard]
    pong = opcodes.index(0x8A)
    assert 0 < pong < len(opcodes) - 20
    pieces = [payload for first, payload in heard if first != 0x8A]
    assert len(pieces) > 100
    name = json.loads(b"".join(pieces))["scene"]["name"]
    assert name == ("abcdefghijklmnopqrstuvwxyz" * 307_693)[:8_000_000]


LONG = bytes(70000)


@pytest.mark.parametrize(
    ("hostile", "code"),
    [
        (frame(0xC1, b"{}"), 1002),  # a reserved bit
        (frame(0x83, b"{}"), 1002),  # an unknown opcode
        (frame(0x8B, b"{}"), 1002),
        (frame(0x81, b"{}", b"\x82"), 1002),  # masked
        (frame(0x81, b"{}", b"\x7e\x00\x02"), 1002),  # a length that is longer than needed
        (frame(0x81, b"{}", b"\x7f\x00\x00\x00\x00\x00\x00\x00\x02"), 1002),
        (frame(0x81, b"{}", b"\x7f" + b"\xff" * 8), 1002),  # a negative length
        (frame(0x80, b"{}"), 1002),  # a continuation without a beginning
        (frame(0x01, b"{") + frame(0x81, b"}"), 1002),  # a message within another
        (frame(0x09, b"ping"), 1002),  # a control frame in pieces
        (frame(0x89, LONG[:126]), 1002),  # a long control frame
        (frame(0x88, b"\x03"), 1002),  # half a code
        (frame(0x88, struct.pack(">H", 1005)), 1002),  # codes that are not sent
        (frame(0x88, struct.pack(">H", 999)), 1002),
        (frame(0x88, struct.pack(">H", 2000)), 1002),
        (frame(0x88, struct.pack(">H", 1000) + b"\xff"), 1002),
        (frame(0x81, b'"\xff"'), 1007),
        (frame(0x01, b'"\xc3') + frame(0x80, b'"'), 1007),
        (frame(0x82, b"", b"\x7f" + struct.pack(">Q", 1 << 62)), 1009),  # announced but never sent
        (frame(0x82, LONG), 1009),
        (frame(0x02, LONG[:60000]) + frame(0x80, LONG[:60000]), 1009),
    ],
)
def test_hostile_frames_end_the_connection(driver: Driver, hostile: bytes, code: int) -> None:
    closed: list[tuple[int, bytes]] = []

    def handle(sock: socket.socket) -> None:
        greet(sock)
        sock.sendall(hostile)
        closed.extend(read_messages(sock))

    with raw(handle) as url:
        driver.do(f"create {url} - 65000 0")
        offline = driver.until("offline")
        assert offline["wait_s"] == 0.25
        assert "broke the rules" in offline["text"]
        driver.do("destroy")
    assert closed == [(0x88, struct.pack(">H", code))]


UPGRADE, CONNECTION, ACCEPT = "Upgrade: websocket\r\n", "Connection: Upgrade\r\n", "Sec-WebSocket-Accept: ACCEPT\r\n"


@pytest.mark.parametrize(
    "answer",
    [
        "HTTP/1.1 403 Forbidden\r\nContent-Length: 0\r\n\r\n",
        f"HTTP/1.1 200 OK\r\n{UPGRADE}{CONNECTION}{ACCEPT}\r\n",
        f"HTTP/1.1 1011\r\n{UPGRADE}{CONNECTION}{ACCEPT}\r\n",
        f"HTTP/1.1 101 X\r\n{UPGRADE}{CONNECTION}\r\n",
        f"HTTP/1.1 101 X\r\n{UPGRADE}{ACCEPT}\r\n",
        f"HTTP/1.1 101 X\r\n{CONNECTION}{ACCEPT}\r\n",
        f"HTTP/1.1 101 X\r\nUpgrade: h2c\r\n{CONNECTION}{ACCEPT}\r\n",
        f"HTTP/1.1 101 X\r\n{UPGRADE}Connection: close\r\n{ACCEPT}\r\n",
        f"HTTP/1.1 101 X\r\n{UPGRADE}{CONNECTION}Sec-WebSocket-Accept: accept\r\n\r\n",
        f"HTTP/1.1 101 X\r\n{UPGRADE}{CONNECTION}Sec-WebSocket-Accept: {28 * 'A'}\r\n\r\n",
        f"HTTP/1.1 101 X\r\n{UPGRADE}{CONNECTION}Sec-WebSocket-Accept: ACCEPTx\r\n\r\n",
        f"HTTP/1.1 101 X\r\n{UPGRADE}{CONNECTION}{ACCEPT}{ACCEPT}\r\n",
        f"HTTP/1.1 101 X\r\n{UPGRADE}{CONNECTION}{ACCEPT}Sec-WebSocket-Extensions: permessage-deflate\r\n\r\n",
        f"HTTP/1.1 101 X\r\n{UPGRADE}{CONNECTION}{ACCEPT}Sec-WebSocket-Protocol: chat\r\n\r\n",
        f"HTTP/1.1 101 X\r\n{UPGRADE}{CONNECTION} folded\r\n{ACCEPT}\r\n",
        f"HTTP/1.1 101 X\r\n{UPGRADE}no colon\r\n{CONNECTION}{ACCEPT}\r\n",
        f"HTTP/1.1 101 X\r\n{UPGRADE}A: \0\r\n{CONNECTION}{ACCEPT}\r\n",
        f"HTTP/1.1 101 X\r\n{UPGRADE}A: b\n{CONNECTION}{ACCEPT}\r\n",
        f"HTTP/1.1 101 X\r\nA: {'a' * 9000}\r\n{UPGRADE}{CONNECTION}{ACCEPT}\r\n",
        "\r\n\r\n",
        "",
        "SSH-2.0-OpenSSH_9.2\r\n",
    ],
)
def test_invalid_handshakes_are_refused(driver: Driver, answer: str) -> None:
    after: list[bytes] = []

    def handle(sock: socket.socket) -> None:
        key = read_head(sock)["Sec-WebSocket-Key"]
        sock.sendall(answer.replace("ACCEPT", accept_of(key)).encode())
        if "\r\n\r\n" not in answer:
            sock.shutdown(socket.SHUT_WR)
        after.append(sock.recv(100))

    with raw(handle) as url:
        driver.do(f"create {url} secret 0 0")
        assert driver.until("offline")["wait_s"] == 0.25
        assert not driver.before
        driver.do("destroy")
    assert after == [b""]  # the client sends nothing, in particular no hello


def test_silent_server_counts_as_lost(driver: Driver) -> None:
    def handle(sock: socket.socket) -> None:
        greet(sock, heartbeat_s=0.1)  # which the client treats as 0.4 s
        read_exactly(sock, 1)

    with raw(handle) as url:
        begun_s = time.monotonic()
        driver.do(f"create {url} - 0 0")
        driver.until("online")
        assert "silent" in driver.until("offline")["text"]
        assert time.monotonic() - begun_s > 1.8
        driver.do("destroy")


def test_many_messages_do_not_delay_a_frame(driver: Driver) -> None:
    def handle(sock: socket.socket) -> None:
        greet(sock)
        many = 1000 * frame(0x81, b'{"type": "later"}') + 100 * frame(0x81, b'{"type": "warning", "message": "w"}')
        while True:
            sock.sendall(many)

    with raw(handle) as url:
        driver.do(f"create {url} - 0 0")
        driver.until("online")
        begun_s = time.monotonic()
        events = driver.do("run 0.5")
        assert time.monotonic() - begun_s < 30.0
        assert len(events) > 100
        driver.do("destroy")


@pytest.mark.parametrize(
    "text", [b"", b"{", b"[1]", b'{"type": 1}', b'{"a": 1}', b"nan", b'{"type": "x"} x', 70 * b"[" + 70 * b"]"]
)
def test_invalid_messages_are_reported(driver: Driver, text: bytes) -> None:
    def handle(ws: ServerConnection, _: int) -> None:
        ws.send(text.decode())
        say(ws, "warning", message="still here")
        until_closed(ws)

    with scripted(handle) as url:
        driver.do(f"create {url} - 0 0")
        driver.until("warning")
        assert [one["error"] for one in driver.before if one["event"] == "error"] == ["WrongMessage"]


@pytest.mark.parametrize(
    "wrong",
    [
        {"layout": 0},
        {"layout": 65536},
        {"n_bands": 0},
        {"n_moving": 3},
        {"n_moving": 4294967295},
        {"key": "00112233445566f"},
        {"key": "00112233445566fg"},
        {"key": None},
        {"session": None},
        {"session": 4},
    ],
)
def test_invalid_sessions_are_reported(driver: Driver, wrong: dict[str, Any]) -> None:
    def handle(ws: ServerConnection, _: int) -> None:
        begin(ws, **wrong)
        until_closed(ws)

    with scripted(handle) as url:
        driver.do(f"create {url} - 0 0")
        driver.one("play 0 b phone newest")
        assert driver.until("error")["error"] == "WrongMessage"
        assert driver.one("frame 1")["sent"] == 0


# ---- JSON ----

TEXTS = [
    *("0", "-0", "1", "-1.5", "0.1", "1e3", "1E+3", "1.5e-3", "123456789012345678901234567890", "0.724", "3.5e300"),
    *(
        "1e-310",
        "4.9e-324",
        "2.2250738585072014e-308",
        "0.000000000000000000000000000000001",
        "1e22",
        "1e23",
        "9" * 400,
    ),
    *("[]", "{}", "[1,2, 3]", ' { "a" : 1 , "b\\u00e9" : [ { } ] } ', '"x"', '"\\"\\\\\\/\\b\\f\\n\\r\\t\\u20ac"'),
    *('"\\ud83d\\ude00"', '"é€\U0001f600"', "true", "false", "null", "[[[[[[1]]]]]]", '{"": 2}', "[1e400]", "1e400"),
    *("", " ", "01", "+1", ".5", "1.", "1e", "1e+", "-", "0x1", "NaN", "Infinity", "[1,]", "[,1]", "[1 2]", "{1:2}"),
    *('{"a"}', '{"a":}', '{"a":1,}', '{"a" 1}', "[", "]", "}", "[}", '"', '"\\', '"\\x"', '"\\u12"', '"\t"', "'a'"),
    *("tru", "nulll", "1 1", "\ufeff1", "{", '{"a"', '{"a":1', '"\\u', "[1", "--1", "1-", "1e5.5", "[true false]"),
]


@pytest.mark.parametrize("text", TEXTS)
def test_json_is_read_as_python_reads_it(driver: Driver, text: str) -> None:
    found = driver.one(f"parse {text.encode().hex()}")
    try:
        expected = json.loads(text, parse_constant=lambda name: name[10**9], parse_int=float)  # NaN is not JSON
    except (ValueError, IndexError):
        assert not found["is_json"]
        return
    assert found["is_json"]
    if isinstance(expected, str):
        assert found["string"] == expected
    elif isinstance(expected, float):
        assert_is(found["number"], expected)
    elif isinstance(expected, list):
        assert len(found["items"]) == len(expected)
    elif isinstance(expected, dict):
        assert found["items"][::2] == [*expected]


def assert_is(found: float, expected: float) -> None:
    if np.isinf(expected):
        assert found == -4.5  # the value for "not a number"
    else:
        assert found == pytest.approx(expected, rel=1e-14, abs=5e-324)


def test_json_with_invalid_utf_8_is_refused(driver: Driver) -> None:
    wrong = [b"\xff", b"\xc0\x80", b"\xed\xa0\x80", b"\xf4\x90\x80\x80", b"\xe2\x82", b"\xf0\x8f\xbf\xbf", b"\x80"]
    for text in (b'"' + one + b'"' for one in wrong):
        assert not driver.one(f"parse {text.hex()}")["is_json"]


def test_json_depth_is_bounded(driver: Driver) -> None:
    assert driver.one(f"parse {(64 * b'[' + 64 * b']').hex()}")["is_json"]
    assert not driver.one(f"parse {(65 * b'[' + 65 * b']').hex()}")["is_json"]
    assert not driver.one(f"parse {(30000 * b'[').hex()}")["is_json"]


def test_lone_surrogates_and_zeros_are_replaced(driver: Driver) -> None:
    text = rb'"a\u0000b\ud800c\udc00d\ud800\u0041"'
    assert driver.one(f"parse {text.hex()}")["string"] == "a\ufffdb\ufffdc\ufffdd\ufffdA"


def test_long_strings_are_cut_between_characters(driver: Driver) -> None:
    text = json.dumps("a" + "€" * 100, ensure_ascii=False).encode()
    assert driver.one(f"parse {text.hex()}")["string"] == "a" + "€" * 84  # limited to 255 bytes


def test_numbers_round_trip_exactly(driver: Driver) -> None:
    rng = np.random.default_rng(3)
    bits = rng.integers(0, 1 << 64, 300, dtype=np.uint64)
    numbers = [*bits.view(float), 0.1, 1 / 3, 5e-324, 1.7976931348623157e308, 0.0, 123456789.0, 1e21, 2**53 + 2.0]
    for number in numbers:
        (word,) = struct.unpack("<Q", struct.pack("<d", number))
        found = driver.one(f"bits {word:016x}")
        if np.isfinite(number):
            assert found["number"] == number
            read = driver.one(f"parse {repr(float(number)).encode().hex()}")
            assert read["number"] == pytest.approx(number, rel=1e-14, abs=5e-324)
        else:
            assert found == {"failed": True}


def test_scenes_built_by_the_client_equal_the_expected_scenes(driver: Driver) -> None:
    driver.do("scene")
    scene = SceneSnapshot.from_json(driver.printed[-2])
    assert (scene.name, scene.up_axis) == ('a "study"', "z")
    table, spike = scene.object("table"), scene.object("spike")
    assert table.name == "Oak table €\t\\"
    assert table.pose.position_m == (0.1, -2e-7, 1e3)
    assert table.pose.rotation_xyzw == pytest.approx((0.0, 0.6, 0.0, 0.8))
    assert isinstance(table.geometry, Box)
    assert table.geometry.size_m == (1.2, 0.04, 0.7)
    assert isinstance(spike.geometry, TriMesh)
    assert spike.pose.rotation_xyzw == (0.0, 0.0, 0.0, 1.0)
    vertices = np.asarray(spike.geometry.vertices_m, np.float32)
    np.testing.assert_array_equal(vertices, np.array([[0, 0, 0], [0.1, 0, 0], [0, 0.1, 0], [0, 0, 1 / 3]], np.float32))
    a, b, c = (vertices.astype(float)[np.asarray(spike.geometry.faces)[:, k]] for k in range(3))
    assert (a * np.cross(b, c)).sum() / 6 == pytest.approx(0.1 * 0.1 / 18)  # outwards


def test_a_locale_with_decimal_commas_changes_nothing(build: Build, tmp_path: Path) -> None:
    localedef = shutil.which("localedef")
    made = tmp_path / "de_DE.UTF-8"
    if localedef is not None:
        subprocess.run([localedef, "-i", "de_DE", "-f", "UTF-8", str(made)], capture_output=True, check=False)
    if not (made / "LC_NUMERIC").exists():
        pytest.skip("no locale with decimal commas can be made; on Debian: apt-get install locales")
    program = build(HERE / "driver.c", HERE / "client.c")
    driver = Driver(program, LOCPATH=str(tmp_path), SCENE2HAP_DRIVER_LOCALE="de_DE.UTF-8")
    try:
        assert driver.one("decimal_point")["decimal_point"] == ","
        assert driver.one("bits 3fb999999999999a")["number"] == 0.1
        assert driver.one(f"parse {b'0.25'.hex()}")["number"] == 0.25
        driver.do("scene")
        table = SceneSnapshot.from_json(driver.printed[-2]).object("table")
        assert table.geometry == Box((1.2, 0.04, 0.7))
        assert not driver.end()
    finally:
        driver.kill()
