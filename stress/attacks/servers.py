"""Servers whose answers are too long, too slow, oddly encoded, or contain the key; and sound files of hours."""

# ruff: noqa: E501  # tables of cases

from __future__ import annotations

import gzip
import itertools
import json
import random
import socketserver
import struct
import sys
import threading
import time
import zlib
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import soundfile

from stress.attacks import keys
from stress.attacks.attack import Attack
from stress.attacks.keys import KEY

_QUERY = str(Path(__file__).with_name("query.py"))
_SECONDS = 8.0
Send = Callable[[bytes], object]

ECHOES = tuple(spelling for name, spelling in keys.SPELLINGS.items() if name not in keys.NOT_COVERED)


def attacks(seed: int, work: Path) -> Iterator[Attack]:
    """Attacks by replies drawn from the seed, from a loopback server that runs as long as this generator."""
    with _Server(("127.0.0.1", 0), _Handler) as server:
        server.seed = seed
        threading.Thread(target=server.serve_forever, kwargs={"poll_interval": 0.01}, daemon=True).start()
        try:
            for number in itertools.count():
                rng = random.Random(f"servers/{seed}/{number}")
                if number % 8 == 7:
                    where, kind = str(_sound(work / f"{number}.flac", rng)), "sound"
                else:
                    where, kind = f"http://127.0.0.1:{server.server_address[1]}/{number}", rng.choice(KINDS)
                argv = (sys.executable, _QUERY, kind, where)
                yield Attack("servers", f"{number} {kind}", argv, seconds=_SECONDS)
        finally:
            server.shutdown()


KINDS = ("openai", "ollama", "page")


def _sound(path: Path, rng: random.Random) -> Path:
    """Write silence at a high rate in many channels, sometimes as a broken file."""
    rate, channels = rng.choice([(8000, 1), (655_350, 8), (96_000, 8), (48_000, 2)]), rng.choice([1, 2, 8])
    with soundfile.SoundFile(path, "w", rate[0], channels, "PCM_16", format="FLAC") as file:
        for _ in range(rng.choice([1, 40, 200])):
            file.write(np.zeros((1 << 18, channels), np.int16))
    if rng.random() < 0.3:
        data = bytearray(path.read_bytes())
        data[rng.randrange(len(data))] = rng.randrange(256)
        path.write_bytes(data)
    return path


class _Server(socketserver.ThreadingTCPServer):
    daemon_threads = True
    allow_reuse_address = True
    seed = 0

    def handle_error(self, request: object, client_address: object) -> None:
        pass  # the client is expected to close the connection


class _Handler(socketserver.StreamRequestHandler):
    def handle(self) -> None:
        assert isinstance(self.server, _Server)
        line = self.rfile.readline().decode("latin-1")
        while self.rfile.readline().strip():
            pass
        number = line.partition("/")[2].partition("/")[0].partition(" ")[0]
        rng = random.Random(f"reply/{self.server.seed}/{number}")
        _play(rng, self.wfile.write)


def _play_raw(rng: random.Random, send: Send) -> None:
    """Send invalid HTTP: endless or slow heads, wrong lengths, nested compression, the key in a header line."""
    ok, length = b"HTTP/1.1 200 OK\r\n", b"content-length: "
    twice = gzip.compress(gzip.compress(bytes(1 << 24)))
    once = rng.choice(
        [
            b"HTTP/1.0 200 OK\r\n\r\n{}", b"hello", ok + length + b"100\r\n\r\n{}", ok + length + b"1\r\n\r\n{}{}",
            ok + length + b"1\r\n" + length + b"2\r\n\r\n{}", ok + b"content-encoding: gzip, gzip\r\n\r\n" + twice,
            ok + b"content-encoding: gzip\r\n\r\n" + twice, ok + b"content-encoding: gzip\r\n\r\n" + twice[:-20],
            ok + b"transfer-encoding: chunked\r\n\r\n-5\r\nx\r\n", b"HTTP/1.1 -20 x\r\n\r\n", ok + b"x: a\0b\r\n\r\n",
            f"HTTP/1.1 {KEY} x\r\n\r\n".encode(), ok + f"bad {KEY}\r\n\r\n".encode(), b"HTTP/1.1 101 x\r\nupgrade: x\r\n\r\n",
            b"HTTP/1.1 302 x\r\nlocation: http://[::1\r\n\r\n", b"HTTP/1.1 204 x\r\ncontent-length: 5\r\n\r\nxxxxx", b"",
        ]
    )  # fmt: skip
    more, pause_s = rng.choice(
        [
            (b"", 0.0), (b"", 0.0), (b"", 0.0), (b"HTTP/1.1 100 Continue\r\n\r\n" * 100, 0.0), (b"HTTP/1.1 200", 0.3),
            (b"HTTP/1.1 103 Early\r\nlink: " + b"a" * 999 + b"\r\n\r\n", 0.0), (ok + b"a: b\r\n", 0.2),
            (ok + b"transfer-encoding: chunked\r\n\r\n1;" + b"e" * 900 + b"\r\nx\r\n", 0.0),
        ]
    )  # fmt: skip
    if not more:
        send(once)
        return
    first, _, rest = more.partition(ok)
    send(ok if rest else first)
    while True:
        send(rest or more)
        time.sleep(pause_s)


def _play(rng: random.Random, send: Send) -> None:
    """Send one reply: a head, which may be wrong, and a body."""
    kind = rng.choice(
        ["bomb", "endless", "drip", "headers", "charset", "echo", "odd", "deep", "cut", "redirect", "raw"]
    )
    if kind == "raw":
        return _play_raw(rng, send)
    status = rng.choice([200, 200, 200, 401, 404, 429, 500])
    echoed = rng.choice(ECHOES)(KEY).encode("latin-1", "replace").decode("latin-1")
    good = json.dumps({"choices": [{"message": {"content": '{"scene_category": "kitchen"}'}}]}).encode()
    packings = ["gzip", "deflate", "br", "zstd", "identity", "rot13"]
    charsets = ["rot13", "idna", "zlib", "hex", "utf-7", "%"]
    heads = {
        "bomb": f"content-encoding: {rng.choice(packings)}",
        "charset": f"content-type: application/json; charset={rng.choice(charsets)}",
        "echo": f"x-request-id: {echoed}",
        "odd": rng.choice(
            [
                "content-length: -1",
                "content-length: 99999999999999999999",
                "transfer-encoding: chunked",
                f"retry-after: {rng.choice(['9' * 400, '-1', 'nan', 'inf', 'Sun, 99 Xxx 0000 00:00:00 GMT'])}",
                "content-encoding: gzip, gzip, gzip",
                "x-ratelimit-reset-requests: 1e308s",
                "set-cookie: a=\x1b[2J",
            ]
        ),
        "redirect": f"location: {rng.choice(['/', 'file:///etc/passwd', 'http://10.0.0.1/', '//x', 'x' * 60_000])}",
    }
    send(f"HTTP/1.1 {302 if kind == 'redirect' else status} x\r\nconnection: close\r\n".encode())
    if kind in heads:
        send(heads[kind].encode("latin-1") + b"\r\n")
    if kind == "headers":
        for i in range(rng.choice([100, 10**6])):
            send(b"x-%d: %s\r\n" % (i, b"a" * 1000))
    send(b"\r\n")
    if kind == "bomb":
        packer = zlib.compressobj(9, zlib.DEFLATED, rng.choice([31, 15]))
        for _ in range(1024):
            send(packer.compress(bytes(1 << 20)))
        send(packer.flush())
    elif kind == "endless":
        block = rng.choice([b" ", b"[", b'{"a":', b'\\"', b"<think>"]) * 10_000
        while True:
            send(block)
    elif kind == "drip":
        while True:
            send(b" ")
            time.sleep(0.05)
    elif kind == "echo":
        send(json.dumps({"error": {"message": f"wrong key {echoed}", "code": echoed}}).encode())
    elif kind == "deep":
        text = rng.choice(["[" * 10**6, '{"a":' * 10**5, "9" * 10**6, '{"' + '\\"' * 10**6, "<think>" * 10**5])
        send(rng.choice([text.encode(), json.dumps({"choices": [{"message": {"content": text}}]}).encode()]))
    elif kind == "cut":
        send(good[: rng.randrange(len(good))] + struct.pack("<I", rng.getrandbits(32)))
    else:
        send(good)
