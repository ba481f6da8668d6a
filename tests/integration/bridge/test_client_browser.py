"""The browser client: its parts in Node.js, and its example page in headless Chromium against a bridge."""

from __future__ import annotations

import itertools
import json
import os
import re
import shutil
import signal
import socket
import struct
import subprocess
import sys
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import Any

import numpy as np
import pytest

pytest.importorskip("websockets", reason="needs websockets: pip install websockets")

from websockets.sync.client import connect

import browser_page
from browser_page import CLIENT, NEEDS_CHROMIUM, NEEDS_MODULES, address, wait_until
from hinged_doors import check_door
from scene2hap import SceneSnapshot, load_scene
from scene2hap.testing.bridge_client import ClientCheck, check_bridge_client, serving

ROOT = CLIENT.parents[1]
PROTOCOL = ROOT / "docs" / "bridge-protocol.md"
NEEDS_NODE = "needs Node.js 20.19 or newer: apt-get install nodejs"
PLAYING = "document.getElementById('status').dataset.is === 'playing'"
LOST = "document.getElementById('status').dataset.is === 'lost'"
FELT = "scene2hapExample.client.isFelt"


@pytest.fixture(scope="module")
def node() -> str:
    path = shutil.which("node")
    if path is None:
        pytest.skip(NEEDS_NODE)
    said = subprocess.run([path, "--version"], capture_output=True, text=True, check=True).stdout
    if tuple(int(part) for part in said.strip().lstrip("v").split(".")[:2]) < (20, 19):
        pytest.skip(NEEDS_NODE)
    return path


@pytest.fixture(scope="module")
def modules(tmp_path_factory: pytest.TempPathFactory) -> Path:
    found = browser_page.find_modules(tmp_path_factory.mktemp("npm"))
    if found is None:
        pytest.skip(NEEDS_MODULES)
    return found


@pytest.fixture(scope="module")
def port(modules: Path) -> Iterator[int]:
    with browser_page.served(modules) as found:
        yield found


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    pytest.importorskip("playwright.sync_api", reason=NEEDS_CHROMIUM)
    if browser_page.chromium() is None:
        pytest.skip(NEEDS_CHROMIUM)
    with browser_page.launched() as found:
        yield found


def _check(command: Sequence[str], environment: dict[str, str], **settings: Any) -> ClientCheck:
    # In another thread, since playwright runs an event loop in this one, and `bake` refuses to block an event loop.
    with ThreadPoolExecutor(1) as thread:
        return thread.submit(check_bridge_client, command, environment=environment, **settings).result()


# Node.js


def test_the_parts_in_node(node: str, modules: Path) -> None:
    environment = {**os.environ, "SCENE2HAP_NODE_MODULES": str(modules)}
    ended = subprocess.run(
        [node, "--test", "--test-reporter=tap"],
        cwd=CLIENT,
        env=environment,
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
    )
    assert ended.returncode == 0, ended.stdout
    counted = dict(re.findall(r"^# (pass|fail|skipped) (\d+)$", ended.stdout, re.M))
    n_written = sum(path.read_text().count("\ntest(") for path in (CLIENT / "tests").glob("*.test.js"))
    assert counted == {"pass": str(n_written), "fail": "0", "skipped": "0"}


DOOR = """
import { Group, BoxGeometry, Mesh, MeshBasicMaterial, Vector3 } from "THREE";
import { sceneFromThree } from "CLIENT";
const kitchen = new Group();
kitchen.position.set(4, 0, -1);
kitchen.rotation.y = 0.7;
kitchen.scale.set(0.5, 0.5, -0.5);
const cabinet = new Mesh(new BoxGeometry(1.2, 1.6, 0.8), new MeshBasicMaterial());
cabinet.position.y = 1;
cabinet.name = "cabinet";
const door = new Group();
const panel = new Mesh(new BoxGeometry(1.2, 1.6, 0.04), new MeshBasicMaterial());
panel.position.set(0.6, 0, 0.02);
door.position.set(-0.6, 1, 0.41);
door.userData.scene2hap = { id: "door", hinge: "cabinet" };
kitchen.add(door.add(panel), cabinet);
const { scene } = sceneFromThree(kitchen);
console.log(JSON.stringify({ scene, pivot_m: door.getWorldPosition(new Vector3()).toArray() }));
"""


def test_a_door_of_three_has_a_hinge(node: str, modules: Path, tmp_path: Path) -> None:
    three, client = (modules / "three/build/three.module.js").as_uri(), (CLIENT / "scene2hap_client.js").as_uri()
    (tmp_path / "door.mjs").write_text(DOOR.replace("THREE", three).replace("CLIENT", client), encoding="utf-8")
    said = json.loads(subprocess.run([node, tmp_path / "door.mjs"], capture_output=True, text=True, check=True).stdout)
    (tmp_path / "scene.json").write_text(json.dumps(said["scene"]), encoding="utf-8")
    check_door(load_scene(tmp_path / "scene.json"), said["pivot_m"])


def test_the_game_in_node(node: str) -> None:
    has_websocket = [node, "--experimental-websocket", "-e", "process.exit(globalThis.WebSocket ? 0 : 1)"]
    assert subprocess.run(has_websocket, check=False).returncode == 0
    game = CLIENT / "example" / "game_in_node.js"
    found = _check([node, "--experimental-websocket", str(game)], {})
    assert found.n_frames == 600
    assert found.n_resumed == 1


# The page


class Opened:
    """An open page, and its console messages and errors."""

    def __init__(self, browser: Any, url: str, script: str = "", **options: Any) -> None:
        self.context = browser.new_context(viewport={"width": 1280, "height": 800}, **options)
        self.page = self.context.new_page()
        self.said: list[str] = []
        self.errors: list[str] = []
        self.page.on("pageerror", lambda error: self.errors.append(str(error)))
        self.page.on("console", self._hear)
        self.page.set_default_timeout(browser_page.TIMEOUT_MS)
        if script:
            self.page.add_init_script(script)
        self.page.goto(url)

    def _hear(self, message: Any) -> None:
        self.said.append(message.text)
        if message.type == "error":
            self.errors.append(message.text)

    def value(self, expression: str) -> Any:
        return self.page.evaluate(f"() => ({expression})")

    def value_once(self, expression: str) -> Any:
        """The value of an expression as soon as it is truthy."""
        found = self.page.wait_for_function(f"() => ({expression})", polling=50)
        return found.json_value()

    def wait(self, condition: str) -> None:
        wait_until(self.page, condition)

    @property
    def status(self) -> str:
        return str(self.page.locator("#status").inner_text())


@contextmanager
def _opened(browser: Any, url: str, script: str = "", **options: Any) -> Iterator[Opened]:
    found = Opened(browser, url, script, **options)
    try:
        yield found
    finally:
        found.context.close()


# A gamepad that records its effects.
PADS = """
window.effects = [];
const actuator = {
  playEffect(kind, effect) {
    effects.push({ kind, at_ms: performance.now(), ...effect });
    return Promise.resolve("complete");
  },
};
navigator.getGamepads = () => [null, { index: 1, connected: true, vibrationActuator: actuator }];
"""


def test_the_pages_examples(browser: Any, port: int) -> None:
    blocks = re.findall(r"```\n(53324842[0-9a-f\s]+)```", PROTOCOL.read_text())
    with _opened(browser, address(port, url="ws://127.0.0.1:1/", **{"self-test": 1})) as opened:
        found = opened.value("window.scene2hapSelfTest")
    assert found["frame"] == re.sub(r"\s", "", blocks[0])
    assert found["gains"]["intensities"] == [0.125, 0.0]
    assert found["gains"]["gains"] == [0.5, 0.0]
    assert (found["gains"]["n_hands"], found["gains"]["n_sources"], found["gains"]["n_bands"]) == (2, 1, 1)


def test_the_game_in_the_page(browser: Any, modules: Path) -> None:
    """The fixture `browser` skips this test where Chromium is missing; the command starts its own browser."""
    command = [sys.executable, browser_page.__file__]
    found = _check(command, {"SCENE2HAP_NODE_MODULES": str(modules)})
    assert found.n_frames == 600
    assert found.n_resumed == 1


def _watched(url: str, session: str) -> dict[tuple[str, str], float]:
    """The gains of a session, by hand and source, received by another client."""
    with connect(url) as line:
        line.send(json.dumps({"type": "hello", "version": 1, "client": "test 1"}))
        line.send(json.dumps({"type": "watch", "session": session}))
        order: dict[str, Any] = {}
        for message in line:
            if isinstance(message, str):
                order = {**order, **json.loads(message)}
                continue
            n_hands, n_sources, n_bands = struct.unpack_from("<3H", message, 32)
            gains = struct.unpack_from(f"<{n_hands * n_sources * n_bands}f", message, 40 + 4 * n_hands)
            columns = itertools.product(order["hands"], [one["id"] for one in order["sources"]])
            assert n_bands == 1
            return dict(zip(columns, gains, strict=True))
    raise AssertionError("no gains came")


def _require_pulses(pulses: Sequence[tuple[float, float]]) -> None:
    """Check that pulses last 100 ms, or 0 ms at intensity 0, and that no two pulses of 0 follow each other.

    On a busy machine gains may be late; then the watchdog sets them to 0.
    """
    assert all((0 < value <= 1 and ms == 100) or value == ms == 0 for value, ms in pulses)
    assert not any(a == b == 0 for (a, _), (b, _) in itertools.pairwise(pulses))


@pytest.fixture(scope="class")
def desk_server() -> Iterator[Any]:
    with serving() as found:
        yield found


@pytest.fixture(scope="class")
def shared(browser: Any, port: int, desk_server: Any) -> Iterator[Opened]:
    with _opened(browser, address(port, url=desk_server.url), PADS) as found:
        found.wait(PLAYING)
        yield found


class TestDesk:
    """Tests that share one page, because baking its scene takes longer than a test."""

    @pytest.fixture
    def opened(self, shared: Opened) -> Iterator[Opened]:
        """The desk at rest, with the left hand on the table and the right hand on the phone."""
        shared.page.locator("#slides").uncheck()
        shared.value("""(() => {
          const { hands, nodes } = scene2hapExample;
          nodes.get("phone").position.set(-0.2, 0.7545, 0.12);
          nodes.get("phone").updateWorldMatrix(true, true);
          hands.placeFromAbove("left", -0.5, -0.3);
          hands.placeFromAbove("right", -0.2, -0.43);
        })()""")
        shared.wait("scene2hapExample.client.gain('right', 'phone') === 1")
        yield shared
        assert shared.errors == []

    def test_the_pages_scene_is_the_desk(self, opened: Opened) -> None:
        scene = SceneSnapshot.from_json(json.dumps(opened.value("scene2hapExample.scene")))
        found = {}
        for item in scene.objects:
            points_m = item.geometry.mesh.vertices_m @ item.pose.rotation.T + item.pose.position_m
            found[item.id] = np.round([points_m.min(axis=0), points_m.max(axis=0)], 4)
        # Known from the page's code: the table with its legs, the phone with its screen, and the mug on the book.
        assert sorted(found) == ["book", "lamp", "laptop", "mug", "phone", "shaver", "table"]
        assert found["table"].tolist() == [[-0.7, 0.0, -0.9], [0.7, 0.75, -0.2]]
        assert found["phone"][0, 1] == 0.75
        assert found["phone"][1, 1] == 0.7595
        assert found["book"][1, 1] == found["mug"][0, 1] == 0.775
        assert scene.objects[0].name == "Wooden table"

    def test_bars_show_the_gains_that_the_server_sends(self, opened: Opened, desk_server: Any) -> None:
        heard = _watched(desk_server.url, opened.value("scene2hapExample.client.order.session"))
        rows = """[...document.querySelectorAll(".hand")].flatMap((hand) =>
          [...hand.querySelectorAll(".level[data-source]")].map((row) => ({
            hand: hand.dataset.hand, source: row.dataset.source, number: row.querySelector(".number").textContent,
            decibels: row.querySelector(".decibels").textContent, now: row.querySelector(".bar").ariaValueNow,
            share: row.querySelector(".bar > div").getBoundingClientRect().width
              / row.querySelector(".bar").getBoundingClientRect().width,
          })))"""
        # Read all rows in one frame with fresh gains, in which one number is 1.
        shown = opened.value_once(f"((rows) => rows.some(({{ number }}) => number === '1.000') && rows)({rows})")
        assert len(shown) == len(heard) == 6
        assert heard["right", "phone"] == 1.0
        for row in shown:
            gain = heard[row["hand"], row["source"]]
            level_db = 20 * np.log10(gain)
            assert 0.0 < gain <= 1.0
            assert row["number"] == row["now"] == f"{gain:.3f}"
            assert row["decibels"].replace("−", "-") == f"{level_db:.1f} dB"
            assert row["share"] == pytest.approx(1 + level_db / 60, abs=0.005)

    def test_the_pointer_touches_and_drags(self, opened: Opened) -> None:
        place = """(() => {
          const { nodes, stage } = scene2hapExample;
          const at = nodes.get("phone").getWorldPosition(new stage.THREE.Vector3()).project(stage.camera);
          const { left, top, width, height } = stage.canvas.getBoundingClientRect();
          return [left + (at.x + 1) * width / 2, top + (1 - at.y) * height / 2];
        })()"""
        position = "scene2hapExample.nodes.get('phone').position.toArray()"
        camera = "scene2hapExample.stage.camera.position.toArray()"
        x, y = opened.value(place)
        before, seen_from = opened.value(position), opened.value(camera)
        opened.value("scene2hapExample.hands.placeFromAbove('right', 0.3, -0.3)")
        opened.wait("scene2hapExample.client.gain('right', 'phone') < 0.9")
        opened.page.mouse.move(x, y)
        opened.wait("scene2hapExample.client.gain('right', 'phone') === 1")
        assert opened.page.locator(".hand[data-hand=right] .touching").inner_text() == "on Smartphone"
        opened.page.mouse.down()
        opened.page.mouse.move(x + 60, y, steps=4)
        opened.page.mouse.up()
        after = opened.value(position)
        assert after[0] > before[0] + 0.03
        assert after[1] == before[1]
        assert opened.value(camera) == seen_from
        assert opened.value("scene2hapExample.hands.touchedBy('right')") == "phone"
        opened.wait("scene2hapExample.client.gain('right', 'phone') === 1")
        # Pointed beside all objects, the hand is lifted.
        opened.page.mouse.move(640, 80)
        opened.wait("scene2hapExample.client.gain('right', 'phone') === 0")

    def test_keys_move_the_hand(self, opened: Opened) -> None:
        point = "scene2hapExample.hands.pointOf('right').toArray()"
        before = opened.value(point)
        opened.page.locator("#canvas").focus()
        for _ in range(4):
            opened.page.keyboard.press("ArrowRight")
        after = opened.value(point)
        assert after[0] == pytest.approx(before[0] + 0.08)
        assert after[1] == pytest.approx(0.75)  # from the phone onto the table
        opened.wait("scene2hapExample.client.gain('right', 'phone') < 1")

    def test_controls_reach_the_session(self, opened: Opened) -> None:
        opened.page.get_by_role("checkbox", name="Smartphone").uncheck()
        opened.wait("scene2hapExample.client.gain('right', 'phone') === 0")
        opened.page.get_by_role("checkbox", name="Smartphone").check()
        opened.wait("scene2hapExample.client.gain('right', 'phone') === 1")
        opened.page.get_by_role("button", name="Knock on the table").click()
        opened.page.get_by_text("Impact on Wooden table").first.wait_for()
        opened.page.get_by_role("button", name="Explain").click()
        opened.page.locator("#explanation").get_by_text("right touches phone").wait_for()

    def test_a_pad_gets_the_intensities_and_stops(self, opened: Opened) -> None:
        effects = "window.effects"
        assert opened.value(effects) == []  # not enabled yet
        opened.value("""(() => {
          const { client } = scene2hapExample;
          window.intensities = [];
          client.on("gains", (detail) => {
            intensities.push([...detail.intensities]);
            window.isPaused = detail.isPaused;
          });
        })()""")
        opened.page.get_by_label("gamepads rumble").check()
        opened.wait("effects.length >= 8")
        opened.page.get_by_role("button", name="Pause").click()
        opened.wait("document.getElementById('pause').ariaPressed === 'true'")
        # A source between two pulses has an effect of 0 as well; a peak of the last frames before the pause may follow.
        opened.wait(
            "isPaused && effects.at(-1).strongMagnitude + effects.at(-1).weakMagnitude === 0"
            " && performance.now() - effects.at(-1).at_ms > 150"
        )
        n = len(opened.value(effects))
        opened.page.wait_for_timeout(300)
        found = opened.value(effects)
        assert len(found) == n  # one effect of 0, then none
        assert found[0]["weakMagnitude"] > 0
        _require_pulses([(max(one["strongMagnitude"], one["weakMagnitude"]), one["duration"]) for one in found])
        # At most one effect in 50 ms, and each with an intensity that the server sent.
        assert min(b["at_ms"] - a["at_ms"] for a, b in itertools.pairwise(found)) >= 48
        left, right = (set(column) | {0} for column in zip(*opened.value("window.intensities"), strict=True))
        assert all(one["strongMagnitude"] in left and one["weakMagnitude"] in right for one in found)
        assert len({one["weakMagnitude"] for one in found}) > 2
        opened.page.get_by_role("button", name="Pause").click()
        opened.wait("effects.at(-1).weakMagnitude > 0")
        opened.page.get_by_label("gamepads rumble").uncheck()

    def test_page_supports_dark_and_light_mode_and_fits_a_phone(self, opened: Opened) -> None:
        sky = "scene2hapExample.stage.scene.background.getHexString()"
        opened.page.set_viewport_size({"width": 390, "height": 844})
        for theme, colour in {"light": "dfe3e8", "dark": "1a1e22"}.items():
            opened.page.emulate_media(color_scheme=theme)
            opened.wait(f"{sky} === '{colour}'")
            assert opened.value("getComputedStyle(document.body).colorScheme") == theme
            assert opened.value("document.documentElement.scrollWidth") <= 390
        opened.page.set_viewport_size({"width": 1280, "height": 800})


# A three.js game, as the README's example expects.
GAME = """
import * as THREE from "three";
const scene = new THREE.Scene();
const boxes = { table: ["Wooden table", [1.2, 0.04, 0.7], 0.73], phone: ["Smartphone", [0.07, 0.008, 0.15], 0.754] };
for (const [id, [name, size, height]] of Object.entries(boxes)) {
  const mesh = new THREE.Mesh(new THREE.BoxGeometry(...size), new THREE.MeshBasicMaterial());
  mesh.position.y = height;
  mesh.userData.scene2hap = { id, name };
  scene.add(mesh);
}
const camera = new THREE.PerspectiveCamera();
const renderer = new THREE.WebGLRenderer();
"""


def test_the_example_of_the_readme(browser: Any, modules: Path) -> None:
    (code,) = re.findall(r"<!-- ci: example -->\n```js\n(.*?)```", (CLIENT / "README.md").read_text(), re.S)
    imports, rest = code.split("\n", 1)
    places = json.dumps({"imports": {"three": "/node_modules/three/build/three.module.js"}})
    with serving() as server:
        rest = rest.replace("Scene2HapClient()", f"Scene2HapClient({{ url: '{server.url}' }})")
        page = f"""<!doctype html><link rel="icon" href="data:,"><script type="importmap">{places}</script>
            <script type="module">{imports}{GAME}{rest}window.client = client;</script>"""
        # Served by a real server, since Chromium treats a page made by playwright as one from another network.
        with (
            browser_page.served(modules, {"/game.html": page}) as port,
            _opened(browser, f"http://127.0.0.1:{port}/game.html") as opened,
        ):
            gain = opened.value_once("window.client?.isFelt && client.gain('left', 'phone')")
            assert 0.1 < gain < 1.0  # 10 cm beside the middle of the phone
            assert [text for text in opened.said if "GL Driver" not in text] == []
            assert opened.errors == []


def test_controllers_of_an_emulated_headset(browser: Any, port: int, modules: Path) -> None:
    emulator = (modules / "iwer" / "build" / "iwer.js").read_text(encoding="utf-8")
    device = """
    window.headset = new IWER.XRDevice(IWER.metaQuest3);
    headset.installRuntime({ forceInstall: true });
    window.pulses = [];
    for (const [hand, controller] of Object.entries(headset.controllers)) {
      controller.inputSource.gamepad.hapticActuators[0].pulse = (value, ms) => {
        pulses.push([hand, value, ms, performance.now()]);
        return Promise.resolve(true);
      };
    }
    headset.controllers.left.position.set(-0.6, 1.3, -0.3);
    headset.controllers.right.position.set(0.25, 0.77, -0.3);  // 2 cm above the table, beside everything on it
    """
    with serving() as server, _opened(browser, address(port, url=server.url), emulator + device) as opened:
        opened.wait(PLAYING)
        opened.page.locator("#slides").uncheck()
        opened.page.get_by_role("button", name="Enter VR").click()
        opened.wait("pulses.length >= 5 && scene2hapExample.hands.touchedBy('right') === 'table'")
        opened.wait("scene2hapExample.hands.touchedBy('left') === null")
        opened.value("headset.controllers.right.position.set(0.25, 1.2, -0.3)")
        opened.wait("scene2hapExample.hands.touchedBy('right') === null")
        last = "pulses.filter(([hand]) => hand === 'right').at(-1)"
        opened.wait(f"{FELT} && scene2hapExample.client.gain('right', 'phone') === 0 && {last}[1] === 0")
        n = opened.value("pulses.length")
        opened.page.wait_for_timeout(300)
        pulses = opened.value("pulses.filter(([hand]) => hand === 'right')")
        assert opened.value("pulses.length") == n
        assert pulses[-1][1:3] == [0, 0]
        _require_pulses([(value, ms) for _, value, ms, _ in pulses])
        assert min(b[3] - a[3] for a, b in itertools.pairwise(pulses)) >= 48
        assert opened.errors == []


# Origins and tokens


def test_a_page_of_a_foreign_origin_is_refused(browser: Any, port: int) -> None:
    origin = f"http://evil.test:{port}"
    with serving() as server, _opened(browser, address(port, "evil.test", url=server.url)) as opened:
        opened.wait(LOST)
        assert f"--origin {origin}" in opened.status
        assert server.connections == set()
        assert opened.value("scene2hapExample.client.sendFrame()") == 0
    # The same page is accepted once the server allows its origin.
    with serving(origins=(origin,)) as other, _opened(browser, address(port, "evil.test", url=other.url)) as opened:
        opened.wait(PLAYING)
        opened.wait(FELT)
        assert opened.errors == []


def test_token_is_sent_only_in_hello(browser: Any, port: int) -> None:
    token = "a token, which nobody else sees"
    with serving(token=token) as server:
        with _opened(browser, address(port, url=server.url, token=token)) as opened:
            opened.wait(PLAYING)
            assert "token" not in opened.value("location.href")
            assert "nobody" not in " ".join([opened.page.content(), *opened.said])
            assert opened.errors == []
        with _opened(browser, address(port, url=server.url, token="another")) as opened:
            opened.wait(LOST)
            assert "4003" in opened.status
            assert "Next attempt" not in opened.status
            assert "another" not in " ".join([opened.page.content(), *opened.said])


# Lost connections


@contextmanager
def _bridge(port: int) -> Iterator[subprocess.Popen[str]]:
    """A bridge in a separate process, which can be killed."""
    command = [sys.executable, "-m", "scene2hap", "bridge", "--port", str(port)]
    process = subprocess.Popen(command, cwd=ROOT, stdout=subprocess.PIPE, text=True)
    assert process.stdout is not None
    try:
        assert f":{port}/" in process.stdout.readline()
        yield process
    finally:
        process.send_signal(signal.SIGTERM)
        process.wait(60)
        process.stdout.close()


def test_page_continues_after_a_server_restart(browser: Any, port: int) -> None:
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        bridge_port = free.getsockname()[1]
    gain = "scene2hapExample.client.gain('left', 'phone')"
    number = "document.querySelector('.hand[data-hand=left] [data-source=phone] .number').textContent"
    with ExitStack() as stack:
        with _bridge(bridge_port) as process:
            opened = stack.enter_context(_opened(browser, address(port, url=f"ws://127.0.0.1:{bridge_port}/")))
            opened.wait(PLAYING)
            opened.page.locator("#slides").uncheck()
            opened.value("""(() => {
              const { client } = scene2hapExample;
              const moving = client.sequence + 1;
              client.on("gains", ({ sequence }) => (window.isAtRest = sequence > moving));
            })()""")
            before = opened.value_once(f"window.isAtRest && {FELT} && {gain}")
            opened.value("void (window.resumed = [])")
            opened.value("""scene2hapExample.client.on("playing", ({ isResumed }) => window.resumed.push(isResumed))""")
            process.kill()
        opened.wait(LOST)
        assert "Next attempt in" in opened.status
        assert opened.value(gain) == 0
        opened.wait(f"{number} === '0.000'")
        with serving(port=bridge_port):
            opened.wait(PLAYING)
            # The phone is at its last position, not at its baked one.
            opened.wait(f"Math.abs({gain} - {before}) < 1e-4")
            assert opened.value("window.resumed") == [False]
        # The browser reports failed connection attempts; the page must report no other error.
        assert [text for text in opened.errors if "ERR_CONNECTION" not in text] == []


def test_no_copy_of_three_is_committed() -> None:
    kept = subprocess.run(
        ["git", "ls-files", "--cached", "--others", "--exclude-standard", "clients/browser"],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=False,
    )
    if kept.returncode != 0:
        pytest.skip("needs a git checkout")
    sizes = {name: (ROOT / name).stat().st_size for name in kept.stdout.split()}
    assert "clients/browser/scene2hap_client.js" in sizes
    assert max(sizes.values()) < 100_000
    versions = [
        json.loads((ROOT / name / "package.json").read_text())["devDependencies"]["three"]
        for name in ("clients/browser", "tools/report")
    ]
    assert versions[0] == versions[1]
