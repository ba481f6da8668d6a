"""The example page of clients/browser in headless Chromium.

Run as a program, it plays the check game of docs/bridge-protocol.md in that page. The variables SCENE2HAP_* set it up.
"""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import Any
from urllib.parse import urlencode

from server_thread import running

CLIENT = Path(__file__).parents[2] / "clients" / "browser"
NEEDS_CHROMIUM = "needs chromium: apt-get install chromium, and pip install playwright"
NEEDS_MODULES = "needs three.js and iwer: apt-get install npm, and run npm ci in clients/browser"
TIMEOUT_MS = 60_000
GAME_TIMEOUT_MS = 100_000
_FLAGS = [
    "--no-sandbox",
    "--disable-gpu",
    "--use-gl=angle",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    # evil.test does not exist; mapped to loopback, it gives the page a foreign origin.
    "--host-resolver-rules=MAP evil.test 127.0.0.1",
]


def chromium() -> str | None:
    """Path of Chromium, None if there is none."""
    return shutil.which("chromium") or shutil.which("chromium-browser")


def find_modules(folder: Path) -> Path | None:
    """`node_modules` of the page: the repository's, else a new one in `folder`. None if npm cannot make it."""
    own = CLIENT / "node_modules"
    if all((own / name / "package.json").exists() for name in ("three", "iwer")):
        return own
    npm = shutil.which("npm")
    if npm is None:
        return None
    for name in ("package.json", "package-lock.json"):
        shutil.copy(CLIENT / name, folder)
    command = [npm, "ci", "--no-audit", "--no-fund", "--prefer-offline", "--fetch-retries=0"]
    try:
        ended = subprocess.run(command, cwd=folder, capture_output=True, timeout=60, check=False)
    except subprocess.TimeoutExpired:
        return None
    return folder / "node_modules" if ended.returncode == 0 else None


@contextmanager
def served(modules: Path, pages: Mapping[str, str] | None = None) -> Iterator[int]:
    """Serve clients/browser on loopback, with these modules and pages added. Yields the port."""

    class Handler(SimpleHTTPRequestHandler):
        # Replaces the system's table, which may serve modules as plain text.
        extensions_map = {  # noqa: RUF012
            ".html": "text/html",
            ".css": "text/css",
            ".js": "text/javascript",
            "": "text/plain",
        }

        def __init__(self, *given: Any) -> None:
            super().__init__(*given, directory=str(CLIENT))

        def do_GET(self) -> None:
            html = (pages or {}).get(self.path)
            if html is None:
                super().do_GET()
                return
            self.send_response(200)
            self.send_header("content-type", "text/html; charset=utf-8")
            self.end_headers()
            self.wfile.write(html.encode())

        def translate_path(self, path: str) -> str:
            found = Path(super().translate_path(path))
            own = CLIENT / "node_modules"
            return str(modules / found.relative_to(own)) if found.is_relative_to(own) else str(found)

        def log_message(self, format: str, *args: object) -> None:
            pass

    with ThreadingHTTPServer(("127.0.0.1", 0), Handler) as server, running(server):
        yield server.server_port


@contextmanager
def launched() -> Iterator[Any]:
    """A headless Chromium under playwright."""
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=chromium(), headless=True, args=_FLAGS)
        try:
            yield browser
        finally:
            browser.close()


def address(port: int, host: str = "127.0.0.1", **parameters: object) -> str:
    """URL of the example page."""
    # Draw rarely: software rendering would leave little processor time to the bridge.
    return f"http://{host}:{port}/example/index.html?{urlencode({'draw': 500, **parameters})}"


def wait_until(page: Any, condition: str, timeout_ms: float = TIMEOUT_MS) -> None:
    """Wait until a JavaScript expression is true in a page."""
    page.wait_for_function(f"() => ({condition})", timeout=timeout_ms, polling=50)


def main() -> None:
    """Play the check game."""
    given = os.environ
    with served(Path(given["SCENE2HAP_NODE_MODULES"])) as port, launched() as browser:
        page = browser.new_page(viewport={"width": 800, "height": 500})
        page.on("pageerror", lambda error: print(error, file=sys.stderr))
        page.goto(
            address(
                port,
                url=given["SCENE2HAP_URL"],
                token=given["SCENE2HAP_TOKEN"],
                frames=given["SCENE2HAP_FRAMES"],
                rate=given["SCENE2HAP_RATE_HZ"],
            )
        )
        wait_until(page, "window.scene2hapResults || window.scene2hapProblem", GAME_TIMEOUT_MS)
        lines = page.evaluate("window.scene2hapResults")
        if lines is None:
            sys.exit(page.evaluate("window.scene2hapProblem"))
        Path(given["SCENE2HAP_OUT"]).write_text("".join(f"{line}\n" for line in lines), encoding="utf-8")
        print(json.dumps({"lines": len(lines)}))


if __name__ == "__main__":
    main()
