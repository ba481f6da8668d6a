"""Tables on the console: fitted to the terminal, or only aligned if they are long."""

from __future__ import annotations

import pytest

from scene2hap.cli.console import Console

COLUMNS = ("object", ">size")


def _printed(capsys: pytest.CaptureFixture[str], rows: list[tuple[str, str]]) -> list[str]:
    console = Console(quiet=False)
    console.table("a room", COLUMNS, rows)
    assert console.close() == 0
    return capsys.readouterr().out.splitlines()


def test_a_long_table_holds_every_row_in_aligned_columns(capsys: pytest.CaptureFixture[str]) -> None:
    lines = _printed(capsys, [(f"box{i}", f"{i}.0") for i in range(5000)])
    title, header, *body = lines
    assert title == "a room"
    assert [line.split() for line in body] == [[f"box{i}", f"{i}.0"] for i in range(5000)]
    assert {len(line) for line in (header, *body)} == {len("box4999") + 2 + len("4999.0")}


def test_a_long_name_in_a_long_table_does_not_widen_the_other_rows(capsys: pytest.CaptureFixture[str]) -> None:
    lines = _printed(capsys, [("a" * 500_000, "1"), *[("b", "2")] * 2000])
    assert lines[2].startswith("a" * 500_000)
    assert max(map(len, lines[3:])) < 100


@pytest.mark.parametrize("n", [1, 2000])
def test_a_name_is_neither_markup_nor_a_command_to_the_terminal(capsys: pytest.CaptureFixture[str], n: int) -> None:
    lines = _printed(capsys, [("[red]\x1b[2J\nx", "1")] * n)
    assert "\\x1b" in "".join(lines)
    assert "\x1b" not in "".join(lines)
    assert "[red]" in "".join(lines)


def test_a_table_without_rows_has_its_header(capsys: pytest.CaptureFixture[str]) -> None:
    assert any("object" in line for line in _printed(capsys, []))
