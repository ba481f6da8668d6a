"""A bridge client for tests, built on the blocking client of `websockets`."""

from __future__ import annotations

import json
import os
import time
from collections import Counter
from collections.abc import Sequence
from contextlib import ExitStack
from pathlib import Path
from types import TracebackType
from typing import Any, Self

import numpy as np
from jsonschema import Draft202012Validator
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect

from bridge_frames import decode_gains, encode_frame
from scene2hap.bridge.frames import Gains
from scene2hap.session import Touch
from scene2hap.testing.bridge_game import IDS, game_scene, positions_m, time_s, touches

SCHEMA = Path(__file__).parents[2] / "docs" / "bridge.schema.json"


ANSWER = Draft202012Validator(
    {**json.loads(SCHEMA.read_text(encoding="utf-8")), "anyOf": [{"$ref": "#/$defs/AnyAnswer"}]}
)


MOST_HELD = 100
n_held: Counter[str] = Counter()


def answered(message: str) -> dict[str, Any]:
    """Decode a server message; the first `MOST_HELD` of each kind are checked against the published schema."""
    found: dict[str, Any] = json.loads(message)
    kind = found["type"]
    if kind != "of a later server" and n_held[kind] < MOST_HELD:  # a check takes milliseconds
        n_held[kind] += 1
        ANSWER.validate(found)
    return found


class Refused(Exception):
    """An `error` message of the server."""

    def __init__(self, answer: dict[str, Any]) -> None:
        super().__init__(answer["message"])
        self.kind = answer["error"]


class Client:
    """A connection that has sent `hello`; `heard` keeps all messages that no call waited for."""

    def __init__(self, url: str, token: str | None = None, version: int = 1, **options: Any) -> None:
        self._open = ExitStack()
        self.socket = self._open.enter_context(connect(url, compression=None, max_size=None, **options))
        self.heard: list[dict[str, Any]] = []
        self.gains: list[Gains] = []
        self._id = 1_000_000  # far from the numbers that tests choose
        self.welcome = self.ask("hello", version=version, client="tests", **({} if token is None else {"token": token}))

    def say(self, kind: str, **fields: Any) -> int:
        self._id += 1
        self.socket.send(json.dumps({"type": kind, "id": self._id, **fields}))
        return self._id

    def ask(self, kind: str, **fields: Any) -> dict[str, Any]:
        number = self.say(kind, **fields)
        return self.hear(lambda found: found.get("re") == number)

    def hear(self, is_wanted: Any, timeout_s: float = 60.0) -> dict[str, Any]:
        """Wait for the next JSON message for which `is_wanted` is true. Raises: Refused: it is an error."""
        end_s = time.monotonic() + timeout_s
        while True:
            message = self.socket.recv(timeout=max(0.0, end_s - time.monotonic()))
            if isinstance(message, bytes):
                self.gains.append(decode_gains(message))
                continue
            found = answered(message)
            if is_wanted(found):
                if found["type"] == "error":
                    raise Refused(found)
                return found
            self.heard.append(found)

    def bake(self, **fields: Any) -> int:
        job = self.ask("bake", **fields)["job"]
        self.hear(lambda found: found.get("job") == job and found["type"] in ("baked", "error"))
        return int(job)

    def play(self, **fields: Any) -> dict[str, Any]:
        self.order = self.ask("play", **fields)
        self.key = bytes.fromhex(self.order["key"])
        return self.order

    def frame(self, sequence: int, at_s: float, poses: Any, felt: Sequence[Touch] = ()) -> bytes:
        """Encode a frame message in the current layout."""
        hands, objects = self.order["hands"], self.order["objects"]
        rows = [(hands.index(x.hand), objects.index(x.object_id), x.point_m) for x in felt]
        return encode_frame(self.order["layout"], self.key, sequence, at_s, np.asarray(poses, np.float32), rows)

    def next_gains(self, timeout_s: float = 60.0) -> Gains:
        end_s = time.monotonic() + timeout_s
        while not self.gains:
            message = self.socket.recv(timeout=max(0.0, end_s - time.monotonic()))
            if isinstance(message, bytes):
                self.gains.append(decode_gains(message))
            else:
                self.heard.append(answered(message))
        return self.gains.pop(0)

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._open.close()


def poses_of(frame: int) -> np.ndarray:
    """Poses (30, 7) float32 of the check game in a frame."""
    return np.hstack((positions_m(frame), np.tile(np.array((0, 0, 0, 1), np.float32), (len(IDS), 1))))


def main() -> None:
    """Play the check game of docs/bridge-protocol.md."""
    url, token = os.environ["SCENE2HAP_URL"], os.environ["SCENE2HAP_TOKEN"]
    n_frames, rate_hz = int(os.environ["SCENE2HAP_FRAMES"]), float(os.environ["SCENE2HAP_RATE_HZ"])
    client = Client(url, token)
    job = client.bake(scene=json.loads(game_scene().to_json()))
    client.play(job=job, moving=IDS, frames="every")
    begun_s, lines = time.monotonic(), {}
    for i in range(n_frames):
        while i + 1 not in lines:
            try:
                client.socket.send(client.frame(i + 1, time_s(i), poses_of(i), touches(i)))
                found = client.next_gains()
            except ConnectionClosed:
                session, key = client.order["session"], client.order["key"]
                client = Client(url, token)
                client.order = client.ask("resume", session=session, key=key)
                client.key = bytes.fromhex(key)
                if client.order["sequence"] <= i:
                    continue
                found = client.next_gains()
            cells = found.gains.max(axis=2).ravel()
            lines[found.sequence] = ",".join([str(found.sequence), *(f"{cell:.9g}" for cell in cells)])
        if rate_hz:
            time.sleep(max(0.0, begun_s + (i + 1) / rate_hz - time.monotonic()))
    assert client.ask("leave")["type"] == "left"
    Path(os.environ["SCENE2HAP_OUT"]).write_text("\n".join(lines.values()) + "\n")


if __name__ == "__main__":
    main()
