"""The client for C and C++: compilation, the example, and every request to a real bridge."""

import json
import os
import re
import socket
import subprocess
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from bridge_clients import hex_of_page, start_server
from c_client import CLIENT, CPP, HERE, WARNINGS, Build, C, Driver, kinds, needs_c, needs_cpp
from scene2hap.bridge import BridgeServer
from scene2hap.testing.bridge_client import check_bridge_client, expected_gains

pytestmark = needs_c


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
        assert watcher.one(f"request watch {session}")["request"]  # in place of the first
        assert watcher.until("playing")["message"]["type"] == "watching"
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
