"""Every measured block of docs/figures names an existing command with options that its parser accepts."""

from __future__ import annotations

import argparse
import re
import runpy
import subprocess
import sys
from pathlib import Path
from typing import NoReturn

import pytest

sys.path.insert(0, str(Path(__file__).parents[2] / "benchmarks"))

import figures
from figures import FIGURES, PAGES, Figure

BLOCK = re.compile(r"<!-- figure: (\S+) -->\n(.*?)<!-- end -->", re.DOTALL)


class Accepted(Exception):
    """Raised when a script has parsed its options, before its work."""


def blocks() -> dict[str, tuple[str, str]]:
    """Page and text of each block, by name."""
    return {
        name: (page.stem, text)
        for page in sorted(PAGES.glob("*.md"))
        for name, text in BLOCK.findall(page.read_text(encoding="utf-8"))
    }


def test_pages_and_table_name_the_same_figures() -> None:
    assert {name: page for name, (page, _) in blocks().items()} == {name: one.page for name, one in FIGURES.items()}


@pytest.mark.parametrize("name", FIGURES)
def test_a_block_says_command_commit_date_and_machine(name: str) -> None:
    _, text = blocks()[name]
    assert text.startswith(f"`python {FIGURES[name].command}`"), "measure it again: the command has changed"
    first = "\n".join(text.splitlines()[:3])
    assert re.search(r"[Cc]ommit [0-9a-f]{7}", first)
    assert re.search(r"\b20\d\d-\d\d-\d\d\b", first)
    assert "cores" in first


@pytest.mark.parametrize("name", FIGURES)
@pytest.mark.filterwarnings("ignore")
def test_options_of_every_block_are_accepted_by_its_script(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    figure = FIGURES[name]
    parse = argparse.ArgumentParser.parse_args

    def parse_and_stop(parser: argparse.ArgumentParser) -> NoReturn:
        parse(parser)
        raise Accepted

    monkeypatch.setattr(argparse.ArgumentParser, "parse_args", parse_and_stop)
    monkeypatch.setattr(sys, "argv", [str(figure.script), *figure.options])
    monkeypatch.setattr(sys, "path", [str(figure.script.parent), *sys.path])
    with pytest.raises(Accepted):
        runpy.run_path(str(figure.script), run_name="__main__")


def page_with(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, script: str) -> tuple[Path, Figure]:
    monkeypatch.setattr(figures, "PAGES", tmp_path)
    (tmp_path / "script.py").write_text(script)
    page = tmp_path / "page.md"
    page.write_text("before\n<!-- figure: one -->\nold\n<!-- end -->\nafter\n")
    return page, Figure("page", str(tmp_path / "script.py"), 0)


def test_only_the_block_is_replaced(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    page, figure = page_with(tmp_path, monkeypatch, r"print('| a |\n|---|\n| \\1 |')")
    figures.refresh("one", figure)
    text = page.read_text()
    assert text.startswith("before\n<!-- figure: one -->\n`python ")
    assert text.endswith("| a |\n|---|\n| \\1 |\n<!-- end -->\nafter\n")
    assert "old" not in text
    assert sorted(path.name for path in tmp_path.iterdir()) == ["page.md", "script.py"]


def test_a_command_that_fails_leaves_the_page_as_it_is(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    page, figure = page_with(tmp_path, monkeypatch, "print('half a table'); raise SystemExit(3)")
    before = page.read_text()
    with pytest.raises(subprocess.CalledProcessError):
        figures.refresh("one", figure)
    assert page.read_text() == before
