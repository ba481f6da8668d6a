"""The clients for Godot 3 and 4, run in the real engines without a window."""

import json
import os
import re
import shutil
import socket
import struct
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from websockets.exceptions import ConnectionClosed
from websockets.sync.server import ServerConnection, serve

import bridge_clients
import godot4_web
from bridge_clients import hex_of_page, start_server
from browser_page import NEEDS_CHROMIUM, chromium
from godot4_web import NEEDS_GODOT4, find_engine
from hinged_doors import check_door
from scene2hap import load_scene
from scene2hap.bridge import BridgeServer
from scene2hap.bridge.frames import Frame, Gains, decode_frame, encode_gains
from scene2hap.testing.bridge_client import check_bridge_client
from server_thread import running

MAIN = Path(__file__).parents[3]
NEEDS_GODOT3 = "needs godot3-server: apt-get install --no-install-recommends godot3-server"


@dataclass(frozen=True)
class Godot:
    """An engine, the client for it, and the project with the scenarios."""

    version: int
    command: tuple[str, ...]
    environment: dict[str, str]

    @property
    def client(self) -> Path:
        return MAIN / "clients" / f"godot{self.version}"

    @property
    def driver(self) -> Path:
        return Path(__file__).parent / f"godot{self.version}"

    def started(self, project: Path, **environment: str) -> subprocess.Popen[str]:
        return subprocess.Popen(
            [*self.command, "--path", str(project)],
            env={**os.environ, **self.environment, **environment},
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )

    def run(self, project: Path, **environment: str) -> str:
        """Run a project. Returns its standard output, without its warnings."""
        with self.started(project, **environment) as game:
            try:
                said, errors = game.communicate(timeout=180)
            finally:
                game.kill()
        assert game.returncode == 0, errors
        assert "SCRIPT ERROR" not in errors, errors
        return said

    def drive(self, scenario: str, **environment: str) -> list[dict[str, Any]]:
        """Run a scenario of driver.gd. Returns its events."""
        return events_of(self.run(self.driver, SCENARIO=scenario, **environment))


@pytest.fixture(scope="session")
def godot3() -> Godot:
    program = shutil.which("godot3-server")
    if program is None:
        pytest.skip(NEEDS_GODOT3)
    # Godot does not know the locale "C", and keeps user files below the home folder.
    return Godot(3, (program,), {"LC_ALL": "C.UTF-8", "CLIENT": str(MAIN / "clients" / "godot3")})


@pytest.fixture(scope="session")
def godot4(tmp_path_factory: pytest.TempPathFactory) -> Godot:
    pytest.importorskip("playwright.sync_api", reason=NEEDS_CHROMIUM)
    engine = find_engine(tmp_path_factory.mktemp("godot4")) if chromium() else None
    if engine is None:
        pytest.skip(NEEDS_GODOT4)
    environment = {"SCENE2HAP_GODOT4": str(engine), "CLIENT": str(MAIN / "clients" / "godot4")}
    return Godot(4, (sys.executable, godot4_web.__file__), environment)


@pytest.fixture(params=["godot3", "godot4"])
def godot(request: pytest.FixtureRequest) -> Godot:
    found: Godot = request.getfixturevalue(request.param)
    return found


def events_of(said: str) -> list[dict[str, Any]]:
    return [json.loads(line) for line in said.splitlines() if line.startswith('{"event"')]


def values(events: list[dict[str, Any]], name: str) -> list[list[Any]]:
    return [one["values"] for one in events if one["event"] == name]


def test_frames_and_gains_equal_the_examples_of_the_page(godot: Godot) -> None:
    lines = godot.run(godot.client / "example", SCENE2HAP_SELF_TEST="1").splitlines()
    assert f"frame {hex_of_page('A frame in hexadecimal')}" in lines
    assert f"of {hex_of_page('Gains that answer it')}" in lines
    plain = [line.lower().replace("0.0", "0") for line in lines[-5:]]  # Godot 3 prints True and 0, Godot 4 true and 0.0
    assert plain == ["read true", "intensities 0.125 0", "gains 0.5 0", "cut false", "stale 0 0"]


def test_godot_client_plays_the_reference_game(godot: Godot) -> None:
    command = [*godot.command, "--path", str(godot.client / "example")]
    n_frames = 600 if godot.version == 3 else 240  # a browser gives 60 frames per second
    found = check_bridge_client(command, n_frames=n_frames, environment=godot.environment)
    assert found.n_frames == n_frames
    assert found.n_resumed == 1
    assert found.worst < 1e-9  # the error of nine printed digits of a float below 1


def test_godot_client_continues_after_a_server_restart(godot: Godot, tmp_path: Path) -> None:
    with socket.create_server(("127.0.0.1", 0)) as free:
        port = free.getsockname()[1]
    out, server = tmp_path / "gains.csv", start_server(port)
    settings = {"SCENE2HAP_URL": f"ws://127.0.0.1:{port}/", "SCENE2HAP_FRAMES": "60", "SCENE2HAP_RATE_HZ": "60"}
    game = godot.started(godot.client / "example", **settings, SCENE2HAP_OUT=str(out), SCENE2HAP_TELL_AT="5")
    try:
        assert game.stdout is not None
        line = ""
        while not line.startswith("frame 5"):
            line = next(game.stdout)
        server.kill()
        server.wait()
        server = start_server(port)
        said, _ = game.communicate(timeout=180)
        assert game.returncode == 0, said
        assert said.count("lost: ") == 1
    finally:
        for process in (game, server):
            process.kill()
            process.wait()
    sequences = [int(line.split(",")[0]) for line in out.read_text().split()]
    assert sequences == [*range(1, 61)]


def test_a_wrong_token_is_an_error_that_does_not_show_it(godot: Godot, bridge: Callable[..., BridgeServer]) -> None:
    server = bridge(token="the right one")
    said = godot.drive("refused", SCENE2HAP_URL=server.url, SCENE2HAP_TOKEN="another")
    if godot.version == 3:  # Godot 4 drops what is unread when the connection closes
        ((kind, message, request),) = values(said, "error")
        assert (kind, request) == ("BridgeError", 0)
        assert "token" in message
    ((reason,),) = values(said, "lost")  # only once, since another attempt would be refused too
    assert "4003" in reason
    assert "another" not in json.dumps(said)


def test_client_reports_a_missing_server_and_connects_later(godot: Godot) -> None:
    with socket.create_server(("127.0.0.1", 0)) as free:
        port = free.getsockname()[1]

    settings = {"SCENARIO": "waits", "SCENE2HAP_URL": f"ws://127.0.0.1:{port}/"}
    with godot.started(godot.driver, **settings) as game:
        try:
            assert game.stdout is not None
            before = next(line for line in game.stdout if '"lost"' in line)
            with scripted(lambda ws: answer_all(ws, []), port):
                after, _ = game.communicate(timeout=180)
        finally:
            game.kill()
    said = events_of(before + after)
    ((reason,),) = values(said, "lost")
    assert "is the bridge running?" in reason
    ((request, answer),) = values(said, "answered")
    assert answer["re"] == request


def test_client_supports_every_session_request(godot: Godot, bridge: Callable[..., BridgeServer]) -> None:
    said = godot.drive("tour", SCENE2HAP_URL=bridge().url)
    answers = dict(values(said, "answered"))
    after = {work: rest for work, *rest in values(said, "after")}

    def kind_of(work: str) -> object:
        return answers[after[work][0]]["type"]

    done = ("set_source", "pause", "unpause", "strike", "set_user")
    assert {kind_of(work) for work in done} == {"done"}
    assert {kind_of("add"), kind_of("remove"), kind_of("set_moving")} == {"order"}
    assert answers[after["explain"][0]]["text"]
    assert answers[after["stats"][0]]["frames"]["received"] == 3 * 9
    gain, intensity, is_paused, objects = after[""][1:]
    assert gain == pytest.approx(1.0)  # the hand touches the phone
    assert 0.0 < intensity <= 1.0
    assert not is_paused
    assert after["set_source"][1] == pytest.approx(10 ** (-6 / 20), rel=1e-3)
    assert [after[work][3] for work in ("pause", "unpause")] == [True, False]
    assert {*after["add"][4]} == {*objects, "lamp"}
    assert {*after["remove"][4]} == {*objects}
    assert len(values(said, "order_changed")) == 3
    assert any(impact["object"] == "table" for (impact,) in values(said, "impact"))
    ((kind, message, request),) = values(said, "error")
    assert (kind, request) == ("BridgeError", after["misspelt"][0])
    assert "strike" in message  # the suggestion "did you mean"
    assert values(said, "playing") == [[False, 0]]


def test_another_client_watches(godot: Godot, bridge: Callable[..., BridgeServer]) -> None:
    said = godot.drive("watches", SCENE2HAP_URL=bridge().url)
    assert values(said, "watched") == [[pytest.approx(1.0), True, 0], [0.0, True, 0]]
    assert values(said, "state_changed") == [["waiting"]]
    assert not values(said, "error")


def test_the_example_of_the_page_runs(godot: Godot, bridge: Callable[..., BridgeServer], tmp_path: Path) -> None:
    page = (godot.client / "README.md").read_text(encoding="utf-8")
    script = page.split("```gdscript\n")[1].split("```")[0]
    assert "ws://127.0.0.1:7862/" in script
    for file in (*godot.client.glob("*.gd"), *godot.driver.iterdir()):
        shutil.copy(file, tmp_path)
    (tmp_path / "level.gd").write_text(script.replace("ws://127.0.0.1:7862/", bridge().url), encoding="utf-8")
    said = events_of(godot.run(tmp_path, SCENARIO="readme"))
    ((intensity, right, left),) = values(said, "felt")
    assert 0.0 < intensity < 1.0
    assert 0.0 < right < 1.0  # through the table
    assert left == 0.0


# ---- Against a scripted server ----


ORDER = {**bridge_clients.ORDER, "watchdog_s": 0.1}


@contextmanager
def scripted(handle: Callable[[ServerConnection], None], port: int = 0) -> Iterator[str]:
    """Run a server that greets each client, then calls `handle`. Yields its URL."""
    failures: list[BaseException] = []

    def handler(ws: ServerConnection) -> None:
        try:
            hello = json.loads(ws.recv(10))
            assert (hello["type"], hello["version"]) == ("hello", 1)
            ws.send(json.dumps({"type": "welcome", "version": 1, "server": "scripted"}))
            handle(ws)
        except ConnectionClosed:
            pass
        except BaseException as error:
            failures.append(error)
            raise

    with serve(handler, "127.0.0.1", port, compression=None) as server, running(server):
        yield f"ws://127.0.0.1:{server.socket.getsockname()[1]}/"
    assert not failures, failures


def answer_all(ws: ServerConnection, heard: list[dict[str, Any]]) -> None:
    """Answer all requests with `done`."""
    while True:
        message = json.loads(ws.recv(10))
        heard.append(message)
        ws.send(json.dumps({"type": "done", "re": message["id"]}))


def begin(ws: ServerConnection, **order: object) -> dict[str, Any]:
    """Answer the `play` request. Returns the request."""
    message: dict[str, Any] = json.loads(ws.recv(10))
    assert message["type"] == "play"
    ws.send(json.dumps({"type": "playing", "re": message["id"], **ORDER, **order}))
    return message


def next_frame(ws: ServerConnection) -> Frame:
    message = ws.recv(10)
    assert isinstance(message, bytes)
    return decode_frame(message)


def gains_of(sequence: int, *, layout: int = 1, intensity: float = 0.25, flags: int = 0, skipped: int = 0) -> bytes:
    gains = np.array([[[0.0]], [[0.75]]], np.float32)
    return encode_gains(Gains(layout, sequence, skipped, 0.0, flags, np.float32([intensity, 0.0]), gains))


def test_unresponsive_server_gets_only_the_newest_frames(godot: Godot) -> None:
    frames: list[Frame] = []

    def handle(ws: ServerConnection) -> None:
        assert begin(ws)["moving"] == ["phone"]
        while True:
            frames.append(next_frame(ws))

    with scripted(handle) as url:
        said = godot.drive("flood", SCENE2HAP_URL=url)
    ((n, n_sent, n_replaced),) = values(said, "counted")
    assert n > 30  # in a browser 60 frames come in this second
    # 16 frames at once, then one each quarter of a second.
    assert 17 <= len(frames) <= 21
    assert n_sent in (len(frames), len(frames) - 1)  # the kept frame may leave after this count
    assert n_replaced >= n - n_sent - 1
    sequences = [frame.sequence for frame in frames]
    assert sequences[:16] == [*range(1, 17)]
    steps = np.diff(sequences[15:])
    assert (steps > n / 6).all()  # the frames between were not sent
    for frame in frames:  # each frame has the pose of its time
        assert frame.poses[0, 0] == frame.sequence - 1


def test_acknowledged_poses_are_not_sent_again(godot: Godot) -> None:
    n_poses = []

    def handle(ws: ServerConnection) -> None:
        begin(ws)
        n_poses.append(len(next_frame(ws).poses))
        # The gains of an older frame do not acknowledge the poses of this frame.
        ws.send(struct.pack("<4sBBH", b"S2HB", 9, 1, 0))  # from a later version
        ws.send("no JSON")
        ws.send(gains_of(1))
        for _ in range(4):
            frame = next_frame(ws)
            n_poses.append(len(frame.poses))
            ws.send(gains_of(frame.sequence))
        next_frame(ws)
        ws.send(gains_of(6))

    with scripted(handle) as url:
        said = godot.drive("rest", SCENE2HAP_URL=url)
    assert n_poses == [1, 0, 0, 0, 0]
    assert [one for (one,) in values(said, "gains_received")] == [1, 2, 3, 4, 5, 6]
    assert len(values(said, "warned")) == 1


def test_poses_are_repeated_while_the_server_skips_their_frame(godot: Godot) -> None:
    frames: list[Frame] = []

    def handle(ws: ServerConnection) -> None:
        begin(ws)
        frames.extend((next_frame(ws), next_frame(ws)))
        ws.send(gains_of(1))  # do not acknowledge the poses of frame 2, which this server skips
        for _ in range(2):
            frames.append(next_frame(ws))
            ws.send(gains_of(frames[-1].sequence, skipped=1))

    with scripted(handle) as url:
        godot.drive("skips", SCENE2HAP_URL=url)
    assert [frame.poses[:, 0].tolist() for frame in frames] == [[0], [1], [1], []]


def test_outdated_gains_become_zero_and_gains_of_other_layouts_are_ignored(godot: Godot) -> None:
    def handle(ws: ServerConnection) -> None:
        begin(ws)
        ws.send(gains_of(next_frame(ws).sequence, flags=3, skipped=5))
        ws.send(gains_of(next_frame(ws).sequence, layout=2, intensity=1.0))
        ws.recv(10)

    with scripted(handle) as url:
        said = godot.drive("gains", SCENE2HAP_URL=url)
    first, second = values(said, "now")
    assert first == [0.25, 0.75, 0.75, 0.0, True, True, 5]
    assert second == [0.25, 0.75]
    assert values(said, "later") == [[0.0, 0.0]]


def test_requests_carry_all_of_their_values_exactly(godot: Godot) -> None:
    heard: list[dict[str, Any]] = []
    with scripted(lambda ws: answer_all(ws, heard)) as url:
        said = godot.drive("requests", SCENE2HAP_URL=url)
    (sent,) = values(said, "sent")
    assert [one["id"] for one in heard[: len(sent)]] == sent
    assert len({*sent}) == len(sent)
    assert {request for request, _ in values(said, "answered")} >= {*sent}
    got = {}
    for one in heard[: len(sent) - 1]:
        number, kind = one.pop("id"), one.pop("type")
        assert number
        got.setdefault(kind, one)
    single = [float(np.float32(x)) for x in (0.1, 0.724, -1e-5)]
    assert got.pop("strike") == {
        "object": "table",
        "point_m": pytest.approx(single, rel=1e-7),
        "impulse_n_s": pytest.approx(1.23456789e-7, rel=1e-9),
    }
    assert got == {
        "bake": {"scene": {"name": 'a "b"\n\t\\ é \U0001f600\x01\x0b'}, "user_prompt": ""},
        "cancel": {"job": 1},
        "watch": {"session": "x"},
        "moving": {"moving": ["a", "b"]},
        "set_source": {"source": "phone", "on": False, "gain_db": -6.1},
        "set_user": {"mute": True},
        "add": {"object": {"id": "mug"}},
        "spawn": {"prefab": "p", "object": "o", "position_m": [1, 2, 3], "rotation_xyzw": [0, 0, 0, 1]},
        "remove": {"object": "mug"},
        "pause": {},
        "unpause": {},
        "explain": {"hand": "left"},
        "stats": {},
        "leave": {},
    }
    odd = heard[len(sent) - 1]
    assert (odd["none"], odd["nan"], odd["list"]) == (None, None, [0.25])
    assert odd["huge"] == pytest.approx(1.5e300, rel=1e-6)
    assert odd["tiny"] == pytest.approx(1.5e-300, rel=1e-6)
    refused = [one for one in values(said, "error") if one[0] == "TooManyRequests"]
    assert len(refused) == 6  # of 70 requests, 64 may wait


def test_a_freed_node_keeps_its_pose_and_any_name_is_found(godot: Godot) -> None:
    frames: list[Frame] = []
    names = ["\U0001f600", "phone"]

    def handle(ws: ServerConnection) -> None:
        begin(ws, objects=[*names, "table"], n_moving=2)
        frames.extend((next_frame(ws), next_frame(ws)))
        ws.send(json.dumps({"type": "order", **ORDER, "layout": 2, "objects": ["phone", names[0]], "n_moving": 2}))
        frames.append(next_frame(ws))
        ws.send(json.dumps({"type": "order", **ORDER, "layout": 3, "objects": ["phone", "lamp"], "n_moving": 2}))
        frames.append(next_frame(ws))
        ws.recv(10)

    with scripted(handle) as url:
        said = godot.drive("freed", SCENE2HAP_URL=url)
    assert values(said, "knows") == [[True, False]]
    assert [frame.layout for frame in frames] == [1, 1, 2, 3]
    first, second, third, fourth = frames
    assert first.poses[:, :3].tolist() == [[1, 2, 3], [0, 0, 0]]
    assert second.poses[:, :3].tolist() == [[1, 2, 3], [7, 8, 9]]
    assert third.poses[:, :3].tolist() == [[7, 8, 9], [1, 2, 3]]
    ((hand, thing, point),) = third.touches.tolist()
    assert (hand, thing, [*point]) == (0, 1, [4, 5, 6])
    # There is no node for the lamp, so that the client sends no poses, instead of wrong ones.
    assert len(fourth.poses) == 0
    ((kind, message, _),) = values(said, "error")
    assert kind == "NotTracked"
    assert "lamp" in message


def test_the_client_for_godot_4_has_the_same_interface() -> None:
    def interface(client: str) -> list[str]:
        text = (MAIN / "clients" / client / "scene2hap_client.gd").read_text(encoding="utf-8")
        return re.findall(r"^(?:signal|static func|func|var|const) (?!_)\w+", text, re.MULTILINE)

    def outside_the_socket(names: list[str]) -> list[str]:
        return [name for name in names if not name.endswith(("_KB", "_BYTES"))]

    three, four = interface("godot3"), interface("godot4")
    assert len(three) > 60
    assert outside_the_socket(three) == outside_the_socket(four)


# ---- Scenes ----


def test_nodes_become_closed_meshes_boxes_and_hinged_doors(godot: Godot, tmp_path: Path) -> None:
    said = godot.run(godot.driver, SCENARIO="scenes")
    path = tmp_path / "scene.json"
    path.write_text(said[said.index('{"format"') :], encoding="utf-8")
    scene = load_scene(path)
    rotation = turned(0.3, 0.5, -0.2)
    assert len(scene.objects) == 9 + 2
    check_door(scene, np.array((4, 0, -1)) + turned(0, 0.7, 0) @ (-0.3, 0.5, 0.2))
    for name, scale in (("plain", (1, 1, 1)), ("scaled", (2, 1, 0.5)), ("mirrored", (-1, 1, 1))):
        size = np.abs(np.array(scale)) * (0.2, 0.4, 0.6)
        for suffix in ("", " box"):
            item = scene.object(name + suffix)
            np.testing.assert_allclose(item.pose.position_m, (1, 2, 3), atol=1e-6)
            np.testing.assert_allclose(matrix(item.pose.rotation_xyzw), rotation, atol=1e-6)
        mesh = scene.object(name).geometry
        # A cuboid and a prism of half the volume of its box; a mesh inside out would have a negative volume.
        expected = size.prod() + np.abs(scale).prod() * 0.3 * 0.2 * 0.1 / 2
        assert volume(mesh) == pytest.approx(expected, rel=1e-5)
        box = scene.object(name + " box").geometry
        low = np.array([-0.5 - 0.15 * abs(scale[0]), -size[1] / 2, -size[2] / 2])
        high = np.array([0.5 + size[0] / 2, size[1] / 2, size[2] / 2])
        np.testing.assert_allclose(box.vertices_m.min(axis=0), low, atol=1e-6)
        np.testing.assert_allclose(box.vertices_m.max(axis=0), high, atol=1e-6)
        assert volume(box) == pytest.approx((high - low).prod(), rel=1e-5)
        centred = scene.object(name + " centred")
        names = [scene.object(name + suffix).material_names for suffix in ("", " box", " centred")]
        assert names == [("Walnut", "Brass"), ("Walnut", "Brass"), ("Walnut",)]  # the largest area first
        np.testing.assert_allclose(centred.geometry.size_m, size, rtol=1e-6)
        np.testing.assert_allclose(
            centred.pose.position_m, np.array((1, 2, 3)) + rotation @ np.array((0.5, 0, 0)), atol=1e-6
        )


def volume(mesh: Any) -> float:
    a, b, c = (np.asarray(mesh.vertices_m, float)[np.asarray(mesh.faces)[:, k]] for k in range(3))
    return float((a * np.cross(b, c)).sum() / 6)


def turned(x: float, y: float, z: float) -> Any:
    """Godot's rotation matrix for three angles: about Z, then X, then Y."""

    def about(axis: int, angle: float) -> Any:
        found = np.eye(3)
        i, j = (axis + 1) % 3, (axis + 2) % 3
        found[[i, j], [i, j]] = np.cos(angle)
        found[j, i], found[i, j] = np.sin(angle), -np.sin(angle)
        return found

    return about(1, y) @ about(0, x) @ about(2, z)


def matrix(quaternion: Any) -> Any:
    x, y, z, w = quaternion
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + 2 * w * cross + 2 * cross @ cross
