"""The table of `benchmarks/recordings.py`."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import soundfile

from scripts import script


def test_sounds_that_have_no_measure_are_listed_without_one(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    tone = 0.3 * np.sin(2 * np.pi * 120 * np.arange(9600) / 8000)
    tone += 0.02 * np.random.default_rng(1).standard_normal(len(tone))
    sounds = {"one": tone[:1], "short": tone[:1599], "silent": 0 * tone, "tone": tone}
    for name, samples in sounds.items():
        soundfile.write(tmp_path / f"{name}.wav", samples, 8000, subtype="FLOAT")
    monkeypatch.setattr("sys.argv", ["recordings.py", *(str(tmp_path / f"{name}.wav") for name in sounds)])
    script("benchmarks/recordings.py").main()
    rows = [[cell.strip() for cell in row.split("|")[1:-1]] for row in capsys.readouterr().out.splitlines()[2:]]
    assert [row[:2] for row in rows] == [
        ["one", "silent"],
        ["short", "too short"],
        ["silent", "silent"],
        ["tone", "steady"],
    ]
    assert {cell for row in rows[:3] for cell in row[2:]} == {"-"}
    assert rows[3][2].endswith("dB, line")
