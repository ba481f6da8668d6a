"""Contract for clients of a bridge, in any language."""

from __future__ import annotations

import asyncio
import math
import os
import subprocess
import tempfile
import threading
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from scene2hap.baking import bake
from scene2hap.engines import EngineLink
from scene2hap.scene.objects import Contact
from scene2hap.scene.pose_table import PoseTable
from scene2hap.session import HapticSession, Touch
from scene2hap.testing.bridge_game import IDS, game_scene, positions_m, time_s, touches

if TYPE_CHECKING:
    from scene2hap.bridge import BridgeServer

TOLERANCE = 1e-6
_TOKEN = "a token of the check"
_NO_TURN = (0.0, 0.0, 0.0, 1.0)


@dataclass(frozen=True)
class ClientCheck:
    """Counters of a client: answered frames, resumed connections, and the largest error of a gain [-]."""

    n_frames: int
    n_resumed: int
    worst: float


def check_bridge_client(
    command: Sequence[str],
    *,
    n_frames: int = 600,
    rate_hz: float = 0.0,
    cuts: bool = True,
    timeout_s: float = 120.0,
    environment: Mapping[str, str] | None = None,
) -> ClientCheck:
    """Start a bridge and a client that plays the game of docs/bridge-protocol.md; compare gains with a local session.

    Parameters: command : starts the client; rate_hz : frames per second, 0 for as fast as answers come; cuts : True to
    cut the connection once in the middle; timeout_s : for the client to end [s]; environment : variables in addition
    to the variables of the protocol.
    Raises: AssertionError: the client ends with an error status, lacks frames, or has other gains.
    """
    with tempfile.TemporaryDirectory() as folder, serving(token=_TOKEN) as server:
        out = Path(folder) / "gains.csv"
        settings = {
            "SCENE2HAP_URL": server.url,
            "SCENE2HAP_TOKEN": _TOKEN,
            "SCENE2HAP_FRAMES": str(n_frames),
            "SCENE2HAP_RATE_HZ": f"{rate_hz:g}",
            "SCENE2HAP_OUT": str(out),
        }
        disturbance = _Disturbance(server, n_frames // 2 if cuts else None)
        process = subprocess.Popen([*command], env={**os.environ, **(environment or {}), **settings})
        try:
            status = disturbance.until(process, timeout_s)
        finally:
            if process.poll() is None:
                process.kill()
                process.wait()
        assert status == 0, f"the client ended with status {status}"
        assert out.exists(), f"the client has not written {out.name}, which SCENE2HAP_OUT names"
        rows = [line.split(",") for line in out.read_text().split()]
    wrong = [row for row in rows if not all(map(_is_number, row))]
    assert not wrong, f"a line of {out.name} is {','.join(wrong[0])!r}; it must be a sequence and gains, as 1,0.5,0"
    sequences = [int(float(row[0])) for row in rows]
    assert sequences == [*range(1, n_frames + 1)], _of_sequences(sequences, n_frames)
    expected = expected_gains(n_frames).reshape(n_frames, -1)
    for row in rows:
        n_gains = len(row) - 1
        assert n_gains == expected.shape[1], f"a line has {n_gains} gains; it must have {expected.shape[1]}"
    heard = np.array([[float(cell) for cell in row[1:]] for row in rows])
    worst = float(np.abs(heard - expected).max())
    frame, cell = np.unravel_index(np.abs(heard - expected).argmax(), heard.shape)
    assert worst <= TOLERANCE, (
        f"gain {cell} of frame {frame} is {heard[frame, cell]:.9g}; in process it is {expected[frame, cell]:.9g}"
    )
    return ClientCheck(n_frames, disturbance.n_cuts, worst)


def expected_gains(n_frames: int) -> NDArray[np.float64]:
    """Return the gains (n_frames, n_hands, n_sources) of the game, played in this process."""
    scene = game_scene()
    session = HapticSession(scene, bake(scene))
    session.wait_prepared(60.0)
    game = _Game()
    link = EngineLink(game, session)
    found = []
    for game.frame in range(n_frames):
        found.append(link.update().gains.max(axis=2))
        before_s = time_s(game.frame - 1)
        session.render_s(time_s(game.frame) - before_s if game.frame else session.config.control_period_s)
    return np.array(found, dtype=np.float64)


class _Game:
    """The game as an engine adapter in this process."""

    frame = 0

    def poses(self) -> PoseTable:
        return PoseTable(IDS, positions_m(self.frame), np.tile(_NO_TURN, (len(IDS), 1)))

    def touches(self) -> Sequence[Touch]:
        return touches(self.frame)

    def contacts(self) -> Sequence[Contact] | None:
        return None


@contextmanager
def serving(**settings: object) -> Iterator[BridgeServer]:
    """Run a bridge on a free port, in a separate thread. Raises: MissingExtra: `websockets` is not installed."""
    from scene2hap.bridge import BridgeServer  # imported here, since it needs the extra `bridge`

    server = BridgeServer({"port": 0, **settings})
    is_up, ends = threading.Event(), asyncio.Event()
    loop = asyncio.new_event_loop()

    async def serve() -> None:
        async with server.listening():
            is_up.set()
            await ends.wait()

    thread = threading.Thread(target=loop.run_until_complete, args=(serve(),), name="scene2hap bridge")
    thread.start()
    try:
        assert is_up.wait(10.0), "the bridge does not listen"
        yield server
    finally:
        loop.call_soon_threadsafe(ends.set)
        thread.join(30.0)
        loop.close()


class _Disturbance:
    """Send a message of an unknown type, and cut the connection once after a given frame; `n_cuts` counts this."""

    def __init__(self, server: BridgeServer, cuts_at: int | None) -> None:
        self._server, self._cuts_at = server, cuts_at
        self._greeted: set[object] = set()
        self.n_cuts = 0

    def until(self, process: subprocess.Popen[bytes], timeout_s: float) -> int | None:
        """Disturb until the client ends. Returns its exit status, None after the timeout [s]."""
        for _ in range(round(timeout_s / 0.01)):
            self._disturb()
            try:
                return process.wait(0.01)
            except subprocess.TimeoutExpired:
                continue
        return None

    def _disturb(self) -> None:
        for one in self._server.connections.copy():
            loop = one.loop
            if one not in self._greeted:
                self._greeted.add(one)
                loop.call_soon_threadsafe(one.client.send, {"type": "of a later server", "with": ["a", {"list": None}]})
            if (
                self._cuts_at is not None
                and one.client.hosted is not None
                and one.client.hosted.played.sequence >= self._cuts_at
            ):
                self._cuts_at, self.n_cuts = None, self.n_cuts + 1
                loop.call_soon_threadsafe(one.abort)


def _of_sequences(found: list[int], n_frames: int) -> str:
    lacking = sorted({*range(1, n_frames + 1)} - {*found})
    if lacking:
        return f"the lines lack {len(lacking)} of {n_frames} frames, the first with sequence {lacking[0]}"
    if len(found) > n_frames:
        return (
            f"{len(found)} lines are written for {n_frames} frames; write one line for each, also if its gains "
            "come twice"
        )
    return "the lines are not in the order of their sequences"


def _is_number(text: str) -> bool:
    try:
        return math.isfinite(float(text))
    except ValueError:
        return False
