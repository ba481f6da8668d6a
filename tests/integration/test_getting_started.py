"""Every block of docs/getting-started.md runs as written, in order, in an empty folder."""

from __future__ import annotations

import os
import re
import shlex
import subprocess
import sys
from pathlib import Path

import pytest
import soundfile

from pasted import run_pasted
from scene2hap.cli import main
from small_kitchen import small_kitchen

ROOT = Path(__file__).parents[2]
PAGE = ROOT / "docs" / "getting-started.md"
TEXT = PAGE.read_text(encoding="utf-8")
BLOCKS = re.findall(r"<!-- ci: run -->\n```(\w+)\n(.*?)```", TEXT, re.DOTALL)

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="the commands are those of a POSIX shell")


def shown() -> str:
    """The PATH with the folder of the installed commands first."""
    return os.pathsep.join([str(Path(sys.executable).parent), os.environ.get("PATH", "")])


def test_every_block_is_run_or_installs() -> None:
    assert TEXT.count("```") // 2 == len(BLOCKS) + 1, "mark new blocks with <!-- ci: run -->"
    install = re.search(r"<!-- ci: install -->\n```sh\n(.*?) && \. \.venv/bin/activate\n```", TEXT)
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    assert install
    assert install[1] in readme, "the README's own command, which the wheel's test runs"


def test_every_block_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Of "my_scene.glb", the reader's own scene, a small one takes the place.

    The demo, which is the first block, is run by test_cli.py. The first command is the installed one. A shell writes
    down the commands that follow, and this process runs them and the Python blocks: each process would first import.
    """
    monkeypatch.chdir(tmp_path)
    (demo, *blocks), printed = BLOCKS, []
    assert demo == ("sh", "scene2hap demo\n")
    recorder = tmp_path / "commands" / "scene2hap"
    recorder.parent.mkdir()
    recorder.write_text(f'#!/bin/sh\necho "$@" >> "{tmp_path}/asked"\n')
    recorder.chmod(0o755)
    for number, (language, code) in enumerate(blocks):
        if language == "python":
            printed.append(run_pasted(code, tmp_path))
            continue
        path = shown() if number == 0 else os.pathsep.join([str(recorder.parent), shown()])
        environment = {**os.environ, "PATH": path, "COLUMNS": "150"}
        ran = subprocess.run(["sh", "-e", "-c", code], env=environment, capture_output=True, text=True, check=False)
        assert ran.returncode == 0, f"{code}\n{ran.stdout}\n{ran.stderr}"
        asked = tmp_path / "asked"
        lines = asked.read_text().splitlines() if asked.exists() else []
        assert number == 0 or lines
        for line in lines:
            assert main(shlex.split(line)) == 0, line
        asked.unlink(missing_ok=True)
        if number == 0:
            small_kitchen(tmp_path / "my_scene.glb", "floor", "dining_table", "smartphone", "handheld_fan")

    touched, rate = soundfile.read(tmp_path / "touch.wav", always_2d=True)
    assert touched[rate : rate + rate // 4].any()  # on the phone
    assert touched[2 * rate : 2 * rate + rate // 4].any()  # through the table

    near, away = map(float, re.findall(r"gain (\d\.\d\d)", printed[-1]))
    assert near > 0.1
    assert away == 0.0
    assert "left touches dining_table" in printed[-1]
