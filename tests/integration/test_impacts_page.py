"""The code of docs/impacts.md runs as written."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from pasted import run_pasted
from small_kitchen import small_kitchen

PAGE = (Path(__file__).parents[2] / "docs" / "impacts.md").read_text(encoding="utf-8")


def test_the_code_of_the_page_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Its kitchen has only the objects that the page names, and a floor."""
    path = small_kitchen(tmp_path / "kitchen.glb", "floor", "dining_table", "smartphone")
    monkeypatch.setattr("scene2hap.demo.kitchen_path", lambda: path)
    (code,) = re.findall(r"<!-- ci: run -->\n```python\n(.*?)```", PAGE, re.DOTALL)
    printed = run_pasted(code, tmp_path)
    assert printed.startswith("dining_table struck by smartphone at 0.80 m/s")
    assert "'left': 0.0" in printed or "'left': 0.1" in printed
