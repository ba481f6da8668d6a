"""The report page in headless Chromium: no network request, no error, and a reaction to every click and key."""

from __future__ import annotations

import base64
import gzip
import hashlib
import json
import re
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import Any, TypeVar

import numpy as np
import pytest

from browser_page import NEEDS_CHROMIUM, TIMEOUT_MS, chromium, launched
from others import SCENES, needed
from scene2hap import Box, HapticBundle, Pose, SceneObject, SceneSnapshot, bake, load_scene, rebake
from scene2hap.demo import kitchen_path
from scene2hap.report import report_document, write_report
from scene2hap.report.page import assemble
from server_thread import running

Result = TypeVar("Result")

_STRANGE = "<script>alert(1)</script>\x1b[31m \u202e\"'"


def _scene() -> SceneSnapshot:
    things = {
        "floor": ("floor", (0.0, -0.05, 0.0), (4.0, 0.1, 4.0)),
        "refrigerator": ("refrigerator", (-1.2, 0.9, -1.0), (0.6, 1.8, 0.6)),
        "table": ("oak table", (0.6, 0.4, 0.2), (1.2, 0.8, 0.7)),
        "__proto__": ("smartphone", (0.5, 0.81, 0.2), (0.3, 0.02, 0.2)),
        "cup": (_STRANGE, (0.95, 0.85, 0.3), (0.1, 0.1, 0.1)),
    }
    objects = [SceneObject(key, name, Pose(at), Box(size)) for key, (name, at, size) in things.items()]
    return SceneSnapshot.build(objects, name="room")


@pytest.fixture(scope="module")
def html() -> str:
    return assemble(report_document(bake(_scene()), models=("exponential_plate", "full_propagation")))


@pytest.fixture(scope="module")
def browser(html: str) -> Iterator[Any]:
    # The page is made first: playwright runs an event loop, and `bake` refuses to block an event loop.
    pytest.importorskip("playwright.sync_api", reason=NEEDS_CHROMIUM)
    if chromium() is None:
        pytest.skip(NEEDS_CHROMIUM)
    with launched() as found:
        yield found


class Opened:
    """An open page, with its requests and its errors."""

    def __init__(self, browser: Any, address: str, **options: Any) -> None:
        self.context = browser.new_context(viewport={"width": 1280, "height": 800}, **options)
        self.page = self.context.new_page()
        self.requests: list[str] = []
        self.errors: list[str] = []
        self.page.on("request", lambda request: self.requests.append(request.url))
        self.page.on("pageerror", lambda error: self.errors.append(str(error)))
        self.page.on("console", lambda said: self.errors.append(said.text) if said.type == "error" else None)
        self.page.on("dialog", lambda dialog: (self.errors.append(dialog.message), dialog.dismiss()))
        self.page.set_default_timeout(TIMEOUT_MS)
        self.page.goto(address)
        self.page.wait_for_selector("html[data-ready='1']")

    def report(self, call: str) -> Any:
        return self.page.evaluate(f"window.scene2hapReport.{call}")

    @property
    def requested(self) -> list[str]:
        """Requests other than for the page itself and its data."""
        return [url for url in self.requests[1:] if not url.startswith(("data:", "blob:"))]


@pytest.fixture(scope="module")
def shared(browser: Any, html: str, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Opened]:
    path = tmp_path_factory.mktemp("report") / "report.html"
    path.write_text(html, encoding="utf-8")
    found = Opened(browser, path.as_uri(), accept_downloads=True)
    yield found
    found.context.close()


@pytest.fixture
def opened(shared: Opened) -> Iterator[Opened]:
    """The shared page, reset to its first state; opening a new page would take longer than a test."""
    shared.page.get_by_role("searchbox").fill("")
    shared.page.keyboard.press("Escape")  # leaves the search field, in which other keys are text
    shared.report("setFelt({source: '', model: 'exponential_plate', band: 'all'})")
    shared.report("focus(null)")
    yield shared
    assert shared.errors == []
    assert shared.requested == []


def test_a_click_in_the_picture_selects_an_object(opened: Opened) -> None:
    x, y = opened.report("project('refrigerator')")
    assert opened.report(f"pick({x}, {y})") == "refrigerator"
    opened.page.mouse.click(x, y)
    assert opened.report("selected()") == "refrigerator"
    assert opened.page.locator("#panel h2").inner_text() == "refrigerator"
    assert opened.page.locator("tr[aria-selected=true]").count() == 1


def test_the_felt_map_follows_source_model_and_band(opened: Opened) -> None:
    opened.report("select('table')")
    felt = opened.page.locator(".felt-here strong")
    levels = {}
    for source in ("", "refrigerator", "__proto__"):
        opened.page.get_by_label("source").select_option(source)
        assert opened.report("felt()")["source"] == source
        levels[source] = felt.inner_text()
    assert levels["__proto__"] != levels["refrigerator"]
    before = opened.page.locator("#canvas").screenshot()
    opened.report("setFelt({model: 'full_propagation', source: '', band: 'all'})")
    assert opened.page.get_by_label("model").input_value() == "full_propagation"
    _wait_for_another_picture(opened.page, before)


def test_point_under_the_cursor_shows_its_level(opened: Opened) -> None:
    x, y = opened.report("project('refrigerator')")
    opened.page.mouse.move(x, y)
    tip = opened.page.locator("#tip")
    tip.wait_for(state="visible")
    assert "refrigerator" in tip.inner_text()
    assert re.search(r"-?\d+(\.\d)? dB", tip.inner_text())


def test_point_under_the_cursor_shows_the_path_to_it(opened: Opened) -> None:
    """The phone lies on the table, so that its vibration has only this path."""
    opened.report("setFelt({source: '__proto__'})")
    x, y = opened.report("project('table')")
    for dx in range(0, 200, 10):  # search a free place on the table
        if opened.report(f"pick({x - dx}, {y})") == "table":
            opened.page.mouse.move(x - dx, y)
            break
    opened.page.locator("#tip .path").wait_for()
    assert opened.page.locator("#tip .path").inner_text() == "smartphone \u2192 oak table"
    opened.report("select('table')")
    assert "over smartphone \u2192 oak table" in opened.page.locator(".felt-here").inner_text()


def test_both_players_play_in_step(opened: Opened) -> None:
    opened.report("select('refrigerator')")
    opened.page.locator("body").press("Space")
    _wait_for(opened.page, "[...document.querySelectorAll('audio')].every((a) => !a.paused && a.currentTime > 0.2)")
    sound, touch = opened.page.evaluate("[...document.querySelectorAll('audio')].map((a) => a.currentTime)")
    assert abs(sound - touch) < 0.2
    muted = "[...document.querySelectorAll('audio')].map((a) => a.muted)"
    assert opened.page.evaluate(muted) == [False, False]
    opened.page.get_by_role("button", name="A/B").click()
    assert opened.page.evaluate(muted) == [False, True]
    opened.page.get_by_role("button", name="A/B").click()
    assert opened.page.evaluate(muted) == [True, False]
    opened.page.get_by_role("button", name="Pause").click()
    assert opened.page.evaluate("[...document.querySelectorAll('audio')].every((a) => a.paused)")


def test_only_changed_fields_are_downloaded(opened: Opened) -> None:
    opened.report("select('__proto__')")
    opened.page.locator("[data-field=gain_db]").fill("-3")
    opened.page.locator("[data-field=intensity]").first.fill("0.25")
    opened.page.locator("[data-field=mass_kg]").fill("-1")
    assert opened.page.locator("[data-field=mass_kg]").get_attribute("aria-invalid") == "true"
    with opened.page.expect_download() as download:
        opened.page.get_by_role("button", name="Download changes").click()
    saved = json.loads(Path(download.value.path()).read_text(encoding="utf-8"))
    state = opened.page.locator("[data-field=intensity]").first.get_attribute("data-state")
    assert saved == {
        "format": "scene2hap/overrides",
        "version": 1,
        "overrides": {"__proto__": {"gain_db": -3, "intensity": {state: 0.25}}},
    }
    opened.page.get_by_role("button", name="Undo changes").click()
    assert opened.report("overrides()")["overrides"] == {}


def test_a_name_says_what_an_object_is(opened: Opened) -> None:
    opened.report("select('table')")
    name = opened.page.locator("[data-field=name]")
    assert name.input_value() == "oak table"
    name.fill(" washing machine ")
    assert opened.report("overrides()")["overrides"] == {"table": {"name": "washing machine"}}
    name.fill("oak table")
    assert opened.report("overrides()")["overrides"] == {}


def test_a_thickness_is_corrected(opened: Opened) -> None:
    opened.report("select('table')")
    thickness = opened.page.locator("[data-field=thickness_m]")
    shown = re.search(r"× (\d+) mm", opened.page.locator("body").inner_text())
    assert shown is not None
    assert 1000 * float(thickness.input_value()) == pytest.approx(int(shown[1]), abs=0.5)
    thickness.fill("0")
    assert thickness.get_attribute("aria-invalid") == "true"
    thickness.fill("0.01")
    assert opened.report("overrides()")["overrides"] == {"table": {"thickness_m": 0.01}}


def test_the_table_is_searched_sorted_and_used_by_keys(opened: Opened) -> None:
    body = opened.page.locator("table.list tbody")
    opened.page.get_by_role("button", name="name", exact=True).click()
    names = body.locator("tr td:first-child").all_inner_texts()
    assert len(names) == 5
    opened.page.locator("body").press("/")
    opened.page.keyboard.type("oak")
    assert body.locator("tr").count() == 1
    opened.page.keyboard.press("ArrowDown")
    opened.page.keyboard.press("Enter")
    assert opened.report("selected()") == "table"
    before = opened.report("project('cup')")
    opened.page.keyboard.press("f")
    assert opened.report("project('cup')") != before
    opened.page.keyboard.press("Escape")
    assert opened.report("selected()") is None


def test_names_are_shown_as_plain_text(opened: Opened) -> None:
    opened.report("select('cup')")
    shown = opened.page.locator("#panel h2").inner_text()
    assert shown == _STRANGE.replace("\x1b", "\\x1b")
    assert opened.page.locator("script").count() == 2  # the data and the page's script
    assert opened.page.locator("#panel h2 *").evaluate_all("found => found.map((one) => one.localName)") == ["bdi"]


@pytest.mark.parametrize("theme", ["light", "dark"])
def test_page_fits_a_phone_without_horizontal_scrolling(theme: str, browser: Any, html: str, tmp_path: Path) -> None:
    path = tmp_path / "report.html"
    path.write_text(html, encoding="utf-8")
    opened = Opened(browser, path.as_uri(), color_scheme=theme)
    opened.page.set_viewport_size({"width": 390, "height": 844})
    opened.report("select('refrigerator')")
    assert opened.page.evaluate("document.documentElement.dataset.theme") == theme
    assert opened.page.evaluate("document.documentElement.scrollWidth") <= 390
    smallest = """Math.min(...[...document.querySelectorAll("body *")]
        .filter((one) => one.checkVisibility() && [...one.childNodes].some((node) => node.nodeType === 3))
        .map((one) => parseFloat(getComputedStyle(one).fontSize)))"""
    assert opened.page.evaluate(smallest) >= 12.0
    opened.context.close()
    assert opened.errors == []


def test_paper_is_light_and_holds_the_whole_table(browser: Any, html: str, tmp_path: Path) -> None:
    path = tmp_path / "report.html"
    path.write_text(html, encoding="utf-8")
    opened = Opened(browser, path.as_uri(), color_scheme="dark")
    page = opened.page
    opened.report("select('refrigerator')")
    theme, colour = "document.documentElement.dataset.theme", "getComputedStyle(document.body).color"
    assert page.evaluate(theme) == "dark"
    on_screen = page.evaluate(colour)
    page.set_viewport_size({"width": 1280, "height": 500})  # on the screen the table must be scrolled
    hidden = "(box => box.scrollHeight - box.clientHeight)(document.querySelector('.table-box'))"
    assert page.evaluate(hidden) > 10
    # Read before a frame could be drawn, as a printer does: the browser draws none for it.
    corner = """() => {
      dispatchEvent(new Event('beforeprint'));
      const gl = document.querySelector('#canvas').getContext('webgl2'), pixel = new Uint8Array(4);
      gl.readPixels(2, 2, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
      return [...pixel];
    }"""
    assert page.evaluate(corner) == [0xE9, 0xEB, 0xEE, 255]
    page.evaluate("dispatchEvent(new Event('afterprint'))")
    page.emulate_media(media="print", color_scheme="dark")
    page.evaluate("dispatchEvent(new Event('beforeprint'))")
    assert page.evaluate(theme) == "light"
    assert page.evaluate(colour) != on_screen
    assert page.evaluate(hidden) <= 1
    assert page.evaluate("document.querySelector('#view').getBoundingClientRect().width") <= 700
    assert not page.locator("#toolbar").is_visible()
    assert not page.locator("#save").is_visible()
    panel, table = (page.locator(part).bounding_box() for part in ("#panel", "#tables"))
    assert panel["y"] + panel["height"] <= table["y"] + 1
    page.evaluate("dispatchEvent(new Event('afterprint'))")
    assert page.evaluate(theme) == "dark"
    assert page.evaluate("document.querySelector('#view').getAttribute('style')") == ""
    assert opened.errors == []
    opened.context.close()


def test_touch_input_shows_level_and_path(browser: Any, html: str, tmp_path: Path) -> None:
    path = tmp_path / "report.html"
    path.write_text(html, encoding="utf-8")
    opened = Opened(browser, path.as_uri(), has_touch=True)
    opened.page.set_viewport_size({"width": 390, "height": 844})
    x, y = opened.report("project('refrigerator')")
    opened.page.touchscreen.tap(x, y)
    tip = opened.page.locator("#tip")
    tip.wait_for()
    assert "refrigerator" in tip.inner_text()
    assert opened.report("selected()") == "refrigerator"
    opened.context.close()
    assert opened.errors == []


def test_page_works_without_webgl(browser: Any, html: str, tmp_path: Path) -> None:
    path = tmp_path / "report.html"
    # Without WebGL, `getContext` returns null.
    path.write_text(html, encoding="utf-8")
    context = browser.new_context()
    context.add_init_script(
        "const own = HTMLCanvasElement.prototype.getContext; HTMLCanvasElement.prototype.getContext = "
        "function (kind, ...rest) { return kind.startsWith('webgl') ? null : own.call(this, kind, ...rest); };"
    )
    page = context.new_page()
    page.goto(path.as_uri())
    page.wait_for_selector("html[data-ready='1']", timeout=TIMEOUT_MS)
    assert page.locator("#no-webgl").is_visible()
    page.locator("table.list tbody tr").first.click()
    assert page.evaluate("window.scene2hapReport.selected()") == "floor"
    context.close()


def test_a_served_page_saves_to_its_server(browser: Any, html: str) -> None:
    posted: list[Any] = []

    class Handler(BaseHTTPRequestHandler):
        def do_GET(self) -> None:
            self._answer(html.encode(), "text/html; charset=utf-8")

        def do_POST(self) -> None:
            posted.append((self.path, json.loads(self.rfile.read(int(self.headers["content-length"])))))
            self._answer(b'{"file": "kept.json"}', "application/json")

        def _answer(self, body: bytes, kind: str) -> None:
            self.send_response(200)
            self.send_header("content-type", kind)
            self.send_header("content-length", str(len(body)))
            self.end_headers()
            self.wfile.write(body)

        def log_message(self, format: str, *args: object) -> None:
            pass

    with ThreadingHTTPServer(("127.0.0.1", 0), Handler) as server, running(server):
        opened = Opened(browser, f"http://127.0.0.1:{server.server_port}/")
        opened.report("select('table')")
        opened.page.locator("[data-field=material]").fill("steel")
        opened.page.get_by_role("button", name="Save changes").click()
        opened.page.get_by_text("Saved as kept.json.").wait_for()
        opened.context.close()
    assert opened.errors == []
    assert posted == [
        ("/overrides", {"format": "scene2hap/overrides", "version": 1, "overrides": {"table": {"material": "steel"}}})
    ]
    assert [url.rpartition("/")[2] for url in opened.requested] == ["overrides"]


def test_the_policy_names_the_script_and_the_style_of_the_page(html: str) -> None:
    """Browsers refuse a script or style whose hash differs from the policy."""
    for kind, element in (("script", r"<script>(.*?)</script>"), ("style", r"<style>(.*?)</style>")):
        (text,) = re.findall(element, html, re.S)
        digest = base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()
        assert f"{kind}-src 'sha256-{digest}'" in html


def test_data_cannot_inject_markup() -> None:
    page = assemble({"scene": "</script><!--<script>\u2028"})
    (data,) = re.findall(r'<script type="application/gzip" id="report">(.*?)</script>', page, re.S)
    assert json.loads(gzip.decompress(base64.b64decode(data))) == {"scene": "</script><!--<script>\u2028"}
    assert re.fullmatch("[A-Za-z0-9+/=]+", data)
    assert page == assemble({"scene": "</script><!--<script>\u2028"})


def test_data_that_are_cut_short_are_said_on_the_page(browser: Any, html: str, tmp_path: Path) -> None:
    path = tmp_path / "report.html"
    path.write_text(re.sub(r'(id="report">.{4000}).*?</script>', r"\1</script>", html, flags=re.S), encoding="utf-8")
    page = browser.new_page()
    page.goto(path.as_uri())
    page.get_by_text("This report cannot be shown").wait_for(timeout=TIMEOUT_MS)
    page.close()


_WALLS = {
    "north": ((0.0, 1.25, -1.95), (4.0, 2.5, 0.1)),
    "south": ((0.0, 1.25, 1.95), (4.0, 2.5, 0.1)),
    "west": ((-1.95, 1.25, 0.0), (0.1, 2.5, 4.0)),
    "east": ((1.95, 1.25, 0.0), (0.1, 2.5, 4.0)),
    "ceiling": ((0.0, 2.55, 0.0), (3.9, 0.1, 3.9)),
    "floor": ((0.0, -0.05, 0.0), (4.0, 0.1, 4.0)),
    "table": ((0.0, 0.4, 0.0), (1.2, 0.8, 1.2)),
    "all": ((0.0, 0.81, 0.4), (0.3, 0.02, 0.2)),
    "fan": ((0.2, 0.9, -0.3), (0.2, 0.2, 0.2)),
}


@pytest.fixture
def walled(browser: Any, tmp_path: Path) -> Iterator[Opened]:
    """A room whose walls are objects, with a phone of the id "all"."""
    objects = [
        SceneObject(key, {"all": "smartphone", "fan": "electric fan"}.get(key, key), Pose(at), Box(size))
        for key, (at, size) in _WALLS.items()
    ]
    path = tmp_path / "walled.html"
    scene = SceneSnapshot.build(objects, name="room")
    path.write_text(_beside(lambda: assemble(report_document(bake(scene), most_points=2000))), encoding="utf-8")
    found = Opened(browser, path.as_uri())
    yield found
    found.context.close()
    assert found.errors == []


def test_walls_towards_the_camera_are_hidden(walled: Opened) -> None:
    x, y = walled.report("project('table')")
    assert walled.report(f"pick({x}, {y})") == "table"
    walled.page.get_by_label("walls").select_option("all")
    assert walled.report(f"pick({x}, {y})") in ("south", "east", "ceiling")
    before = walled.page.locator("#canvas").screenshot()
    walled.page.get_by_label("walls").select_option("cut")
    _wait_for_another_picture(walled.page, before)
    # Walls behind the room stay visible, as the northern wall here.
    x, y = walled.report("project('north')")
    assert walled.report(f"pick({x}, {y - 40})") == "north"


def test_the_table_tells_objects_without_points_from_objects_without_vibration(walled: Opened) -> None:
    ceiling = walled.page.locator("tbody tr", has_text="ceiling")
    assert ceiling.locator("td").nth(5).inner_text() == "not on the map"
    assert "nothing arrives, or not on the map" in walled.page.locator("#legend").inner_text()


def test_source_named_all_is_listed_separately(walled: Opened) -> None:
    sources = walled.page.get_by_label("source", exact=True)
    assert sources.locator("option").all_inner_texts() == ["all sources", "smartphone", "electric fan"]
    walled.report("select('table')")
    felt = walled.page.locator(".felt-here")
    assert "of all sources" in felt.inner_text()
    sources.select_option("all")
    assert walled.report("felt()")["source"] == "all"
    assert "of smartphone" in felt.inner_text()
    assert "over smartphone" in felt.inner_text()


def _beside(work: Callable[[], Result]) -> Result:
    """Run `work` in another thread: playwright runs an event loop in this one, which `bake` refuses to block."""
    with ThreadPoolExecutor(1) as thread:
        return thread.submit(work).result()


_SCENES: dict[str, tuple[Path, float | None, int]] = {
    "demo_kitchen": (kitchen_path(), None, 5_000_000),
    "aws_house_living": (SCENES / "aws_house_living" / "aws_house_living.glb", None, 15_000_000),
    "composed_kitchen_kaykit": (
        SCENES / "composed_kitchen_kaykit" / "composed_kitchen_kaykit.glb",
        None,
        15_000_000,
    ),
    "messy_japanese_room": (SCENES / "messy_japanese_room" / "room.glb", 0.1, 15_000_000),
}
"""Scenes: file, metres per unit, and the largest size of their page [bytes]."""


def _baked(name: str) -> HapticBundle:
    path, unit_m, _ = _SCENES[name]
    bundle = bake(load_scene(path, unit_m=unit_m))
    if bundle.loops:
        return bundle
    # These objects are unknown: make all of oak, and let one hum.
    for object_id in bundle.objects:
        bundle = bundle.override(object_id, material="oak")
    return rebake(bundle.override("Object_12", vibrates=True))


@pytest.mark.filterwarnings("ignore")  # scenes by others cause warnings
@pytest.mark.parametrize("name", _SCENES)
def test_page_supports_inspection_correction_and_rebake(name: str, browser: Any, tmp_path: Path) -> None:
    path, _, most_bytes = _SCENES[name]
    if name != "demo_kitchen":
        needed(path)
    bundle = _beside(lambda: _baked(name))
    page_path = _beside(lambda: write_report(bundle, tmp_path / "report.html"))
    assert page_path.stat().st_size <= most_bytes
    opened = Opened(browser, page_path.as_uri(), accept_downloads=True)
    page, source = opened.page, next(iter(bundle.loops))

    clicked = _click_an_object(opened)
    assert opened.report("selected()") == clicked
    assert page.locator("#panel h2").inner_text() == bundle.snapshot.object(clicked).name

    opened.report(f"select({json.dumps(source)})")
    felt = page.locator(".felt-here")
    assert "of all sources" in felt.inner_text()
    page.get_by_label("source", exact=True).select_option(source)
    assert f"of {bundle.snapshot.object(source).name}" in felt.inner_text()

    page.get_by_role("button", name="Play", exact=True).click()
    heard = "!a.paused && !a.muted && a.currentTime > 0.1"
    _wait_for(page, f"[...document.querySelectorAll('audio')].every((a) => {heard})")
    assert page.locator("audio").count() == 2
    page.get_by_role("button", name="Pause").click()

    page.locator("[data-field=gain_db]").fill("-3")
    page.locator("[data-field=intensity]").first.fill("0.25")
    with page.expect_download() as download:
        page.get_by_role("button", name="Download changes").click()
    corrections = Path(download.value.path())
    state = next(iter(bundle.loops[source]))
    again = _beside(lambda: rebake(bundle, corrections=corrections))
    assert again.gain_db(source) == -3.0
    assert again.objects[source].states[0].intensity == 0.25
    before, after = (one.loops[source][state].tactile.samples for one in (bundle, again))
    assert not np.array_equal(before, after)
    opened.context.close()
    assert opened.errors == []
    assert opened.requested == []


def _click_an_object(opened: Opened) -> str:
    """Click an object in the picture, searched from its middle outwards. Returns the object's id."""
    box = opened.page.locator("#canvas").bounding_box()
    assert box is not None
    for share in (0.5, 0.45, 0.55, 0.4, 0.6):
        x, y = box["x"] + share * box["width"], box["y"] + 0.5 * box["height"]
        found = opened.report(f"pick({x}, {y})")
        if found is not None:
            opened.page.mouse.click(x, y)
            return str(found)
    pytest.fail("there is nothing in the middle of the picture")


def _wait_for(page: Any, condition: str) -> None:
    """Wait until a condition is true. `wait_for_function` would evaluate text, which the page's policy forbids."""
    _wait_until(page, lambda: page.evaluate(condition), condition)


def _wait_for_another_picture(page: Any, before: bytes) -> None:
    _wait_until(page, lambda: page.locator("#canvas").screenshot() != before, "another picture")


def _wait_until(page: Any, is_so: Callable[[], object], what: str) -> None:
    for _ in range(1200):
        if is_so():
            return
        page.wait_for_timeout(50)
    pytest.fail(f"never came: {what}")
