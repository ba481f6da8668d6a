"""The command `scene2hap play` on a pseudo-terminal, and the floor plan that it shows."""

import contextlib
import json
import os
import select
import sys
import time
from pathlib import Path

import pytest
import soundfile

from host import terminal_problem
from scene2hap.cli import main
from scene2hap.cli.plan import Plan
from scene2hap.cli.play import Player
from scenes import box, scene, table_with_two_phones

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="needs a POSIX terminal")


def test_plan_shows_the_uppermost_objects() -> None:
    scene, bundle = table_with_two_phones()
    plan = Plan.of(scene)
    hits = {plan.touched(row, column) for row in range(22) for column in range(64)}
    touched = {hit[0]: hit[1] for hit in hits if hit}
    assert set(touched) >= {"table", *bundle.loops}
    for object_id, point in touched.items():
        low, high = scene.object(object_id).bounds_m
        assert all(low - 1e-9 <= point)
        assert all(point <= high + 1e-9)
    lines = plan.lines(frozenset(bundle.loops), (0, 0))
    assert lines[0][0] == "@"
    assert "*" in "".join(lines)


def test_plan_shows_small_objects_below_a_ceiling_and_beside_a_wall() -> None:
    room = scene(
        box("floor", (6.0, 0.1, 6.0), (0.0, -0.05, 0.0)),
        box("ceiling", (6.0, 0.1, 6.0), (0.0, 2.5, 0.0)),
        box("wall", (0.1, 2.4, 6.0), (-2.95, 1.2, 0.0)),
        box("phone", (0.07, 0.01, 0.15), (-2.85, 0.005, 0.0)),
        box("mug", (0.08, 0.1, 0.08), (1.0, 0.05, 1.0)),
    )
    plan = Plan.of(room, n_columns=20, n_rows=8)
    assert {room.objects[number].id for number in plan.top.flat} == {"floor", "wall", "phone", "mug"}


def test_keys_move_lift_and_turn() -> None:
    player = Player(table_with_two_phones()[1])
    for _ in range(200):
        player.press("\x1b[A")
        player.press("\x1b[D")
    assert player._hand == (0, 0)  # it stays on the plan
    for _ in range(200):
        player.press("\x1b[B")
        player.press("\x1b[C")
    n_rows, n_columns = player.plan.top.shape
    assert player._hand == (n_rows - 1, n_columns - 1)
    player.press("+")
    assert player.gain_db == 3.0
    player.press(" ")
    assert player.touches() == []
    assert player.press("x")
    assert not player.press("q")


def test_play_without_a_terminal_explains_the_alternative(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["play", str(tmp_path)]) == 1
    assert "terminal" in capsys.readouterr().err


def played(tmp_path: Path, *options: str) -> tuple[int, bytes]:
    """Play the two phones for a moment on a pseudo-terminal. Returns the exit status and the output."""
    if problem := terminal_problem():
        pytest.skip(problem)
    import pty
    import termios

    folder = table_with_two_phones()[1].save(tmp_path / "b")
    child, terminal = pty.fork()
    if child == 0:
        os.environ.update(TERM="xterm", COLUMNS="160", LINES="40")
        os.execv(sys.executable, [sys.executable, "-m", "scene2hap", "play", str(folder), *options])
    mode = termios.tcgetattr(terminal)
    said, started = b"", time.monotonic()
    sent_s = 0.0
    while time.monotonic() - started < 120:
        if select.select([terminal], [], [], 0.1)[0]:
            try:
                said += os.read(terminal, 65536)
            except OSError:  # the child has closed the terminal
                break
        if not sent_s and b"hand on" in said:
            os.write(terminal, b"\x1b[A\x1b[C\x1b[B++ ")
            sent_s = time.monotonic()
        elif sent_s and time.monotonic() - sent_s > 1.0:
            with contextlib.suppress(OSError):
                os.write(terminal, b"q")
    _, status = os.waitpid(child, 0)
    assert termios.tcgetattr(terminal) == mode  # the shell shows what is typed again
    os.close(terminal)
    assert sent_s
    return os.waitstatus_to_exitcode(status), said


def test_a_person_plays(tmp_path: Path) -> None:
    """Into a file, which shows that samples reach the sink."""
    wav = tmp_path / "played.wav"
    code, said = played(tmp_path, "--sink", json.dumps({"kind": "wav", "path": str(wav)}))
    assert code == 0
    assert b"hand on: phone" in said
    assert b"NOT PLAYED" not in said
    assert b"nothing was played" not in said
    samples, rate = soundfile.read(wav)
    assert len(samples) > rate / 2
    assert samples.any()


def test_play_without_an_actuator_warns(tmp_path: Path) -> None:
    pytest.importorskip("serial")
    code, said = played(tmp_path, "--sink", '{"kind": "serial", "port": "/dev/no such port"}')
    assert code == 0
    assert b"NOT PLAYED: no serial port /dev/no such port" in said
    assert b"nothing was played: no serial port" in said
