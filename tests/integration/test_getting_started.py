"""Every block of docs/getting-started.md runs as written, in order, in an empty folder."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
import soundfile

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


def test_every_block_runs(tmp_path: Path) -> None:
    environment = {**os.environ, "PATH": shown(), "COLUMNS": "150"}
    printed = []
    for language, code in BLOCKS:
        command = {"sh": ["sh", "-e", "-c", code], "python": [sys.executable, "-W", "error", "-c", code]}[language]
        run = subprocess.run(command, cwd=tmp_path, env=environment, capture_output=True, text=True, check=False)
        assert run.returncode == 0, f"{code}\n{run.stdout}\n{run.stderr}"
        printed.append(run.stdout)
    assert (tmp_path / "scene2hap-demo" / "tour.wav").is_file()
    assert (tmp_path / "scene2hap-demo" / "tour.png").is_file()

    touched, rate = soundfile.read(tmp_path / "touch.wav", always_2d=True)
    assert touched[rate : rate + rate // 4].any()  # on the phone
    assert touched[2 * rate : 2 * rate + rate // 4].any()  # through the table

    near, away = map(float, re.findall(r"gain (\d\.\d\d)", printed[-1]))
    assert near > 0.1
    assert away == 0.0
    assert "left touches dining_table" in printed[-1]
