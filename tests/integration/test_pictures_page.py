"""The code of docs/pictures.md runs as written, block by block in order."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

pytest.importorskip("matplotlib", reason="needs the extra plots")

PAGE = (Path(__file__).parents[2] / "docs" / "pictures.md").read_text(encoding="utf-8")


def test_the_code_of_the_page_runs(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    blocks = re.findall(r"<!-- ci: run -->\n```python\n(.*?)```", PAGE, re.DOTALL)
    assert PAGE.count("```") == 2 * len(blocks), "mark new blocks with <!-- ci: run -->"
    monkeypatch.chdir(tmp_path)
    names: dict[str, object] = {}
    for block in blocks:
        exec(block, names)
    assert {path.name for path in tmp_path.iterdir()} == {"bundle.pdf", "felt.png", "both.png"}
    near, *_, far = map(float, re.findall(r"\d\.\d*", capsys.readouterr().out))
    assert 1.0 >= near > far > 0.0
