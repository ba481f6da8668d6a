"""The client for C against servers that write WebSocket frames byte by byte, also hostile ones."""

import base64
import hashlib
import json
import socket
import struct
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

import numpy as np
import pytest

from bridge_clients import ORDER
from c_client import Driver, needs_c
from scene2hap.bridge.frames import decode_frame
from serial_bench import eventually

pytestmark = needs_c


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
