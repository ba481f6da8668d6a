"""The client for C against scripted servers: what it sends again, ignores and reports."""

import json
import socket
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from typing import Any

import numpy as np
import pytest
from websockets.exceptions import ConnectionClosed
from websockets.sync.server import ServerConnection, serve

from bridge_clients import ORDER
from c_client import Driver, kinds, needs_c
from scene2hap.bridge.frames import Frame, Gains, decode_frame, encode_gains
from server_thread import running

pytestmark = needs_c


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


def test_a_second_session_is_refused_and_the_first_goes_on(driver: Driver) -> None:
    def handle(ws: ServerConnection, _: int) -> None:
        begin(ws)
        ws.send(gains_of(next_frame(ws).sequence))
        next_request(ws, "leave")
        assert begin(ws)["bundle"] == "c"
        until_closed(ws)

    with scripted(handle) as url:
        start(driver, url)
        assert driver.one("play 0 c phone newest")["request"] == 0
        error = driver.until("error")
        assert error["error"] == "BridgeError"
        assert error["text"] == "play was not sent: this connection plays; call s2h_leave first."
        assert driver.one("frame 0.1")["sent"] == 1
        driver.until("gains")
        driver.one("request leave")
        assert driver.one("play 0 c phone newest")["request"] > 0
        driver.until("playing")


def test_another_session_is_watched_though_the_first_ends_meanwhile(driver: Driver) -> None:
    def watching(ws: ServerConnection) -> None:
        request = next_request(ws, "watch")
        order = {key: value for key, value in ORDER.items() if key not in ("key", "sequence")}
        say(ws, "watching", re=request["id"], **{**order, "session": request["session"], "watchdog_s": 60.0})

    def handle(ws: ServerConnection, _: int) -> None:
        watching(ws)
        ws.send(gains_of(1))
        next_request(ws, "stats")
        say(ws, "state", session="a", **{"is": "ended"})  # before the request to watch another is read
        watching(ws)
        until_closed(ws)

    with scripted(handle) as url:
        driver.do(f"create {url} - 0 0")
        driver.one("request watch a")
        driver.until("gains")
        driver.one("request stats")
        assert driver.one("request watch b")["request"] > 0
        assert not driver.one("felt left phone")["is_felt"], "gains of the session before"
        driver.until("state")
        assert driver.until("playing")["message"]["session"] == "b"


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


def test_a_pose_of_an_object_that_does_not_move_is_reported_once(driver: Driver) -> None:
    def handle(ws: ServerConnection, _: int) -> None:
        begin(ws)
        next_frame(ws)
        say(ws, "warning", message="all")
        until_closed(ws)

    with scripted(handle) as url:
        driver.do(f"create {url} - 0 0")
        driver.one("pose table 0 1 0")  # `play` has not said yet which objects move
        driver.one("play 0 b phone newest")
        driver.until("playing")
        for height_m in (1, 2, 3):
            driver.one(f"pose phone 0 {height_m} 0")
            driver.one(f"pose table 0 {height_m} 0")
            driver.one(f"pose lamp 0 {height_m} 0")  # `add` may bring it later
        driver.do("frame 0.1")
        driver.until("warning")
        (text,) = [one["text"] for one in driver.before if one["event"] == "error"]
    assert text.startswith("table: it is not among the moving objects")


def test_an_object_may_be_posed_and_touched_before_the_answer_to_its_request(driver: Driver) -> None:
    def handle(ws: ServerConnection, _: int) -> None:
        begin(ws)
        requests = [next_request(ws, kind) for kind in ("moving", "spawn")]
        assert len(next_frame(ws).touches) == 0
        for request in requests:
            say(ws, "error", re=request["id"], error="No", message="refused")
        next_frame(ws)
        say(ws, "warning", message="all")
        until_closed(ws)

    with scripted(handle) as url:
        start(driver, url)
        driver.one("request moving phone table")
        driver.one("request spawn")
        driver.one("pose table 0 1 0")
        driver.one("pose phone 0 1 0")
        driver.one("touch left fan 0")
        driver.do("frame 0.1")
        errors = [driver.until("error")["text"] for _ in range(2)]
        assert errors == ["refused", "refused"]
        driver.one("pose table 0 2 0")
        driver.do("frame 0.2")
        driver.until("warning")
        told = [one["text"] for one in driver.before if one["event"] == "error"]
    assert [text.partition(":")[0] for text in told] == ["table", "fan"]


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
