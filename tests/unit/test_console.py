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


WIDE = ("object", "type", "material", ">mass kg", ">confidence", "vibrates", ">vibration Hz")
ROWS = [
    ("electric_toothbrush", "electric toothbrush", "abs", "0.13", "0.95", "on (electric toothbrush buzzing)", "263"),
    (
        "refrigerator",
        "refrigerator",
        "stainless steel",
        "75",
        "0.95",
        "on (refrigerator humming)",
        "80 from 98 rough 49",
    ),
    ("cookbook", "book", "paper", "0.45", "0.95", "", ""),
]


@pytest.mark.parametrize("width", [20, 40, 60, 80, 100, 160])
def test_no_word_of_a_table_is_cut_and_no_column_is_lost_on_a_narrow_terminal(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, width: int
) -> None:
    monkeypatch.setattr("scene2hap.cli.console._FILE_WIDTH", width)
    console = Console(quiet=False)
    console.table("a room", WIDE, ROWS)
    printed = capsys.readouterr().out
    assert "…" not in printed
    assert max(map(len, printed.splitlines())) <= width
    shown = set(printed.replace(":", " ").replace(";", " ").split())
    for text in (*(name.removeprefix(">") for name in WIDE[1:]), *(cell for row in ROWS for cell in row)):
        assert set(text.split()) <= shown


def test_a_name_longer_than_the_terminal_is_shown_whole(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("scene2hap.cli.console._FILE_WIDTH", 80)
    printed = "".join(_printed(capsys, [("x" * 200, "1"), ("c", "2")]))
    assert printed.count("x") == 200
