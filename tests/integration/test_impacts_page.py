"""The code of docs/impacts.md runs as written."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

PAGE = (Path(__file__).parents[2] / "docs" / "impacts.md").read_text(encoding="utf-8")


def test_the_code_of_the_page_runs(tmp_path: Path) -> None:
    (code,) = re.findall(r"<!-- ci: run -->\n```python\n(.*?)```", PAGE, re.DOTALL)
    command = [sys.executable, "-W", "error", "-c", code]
    ran = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert ran.returncode == 0, ran.stderr
    assert ran.stdout.startswith("dining_table struck by smartphone at 0.80 m/s")
    assert "'left': 0.0" in ran.stdout or "'left': 0.1" in ran.stdout
