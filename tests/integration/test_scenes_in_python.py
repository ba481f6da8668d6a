"""Scenes made in Python: the code of docs/scenes-in-python.md and the game of 30 objects run as written."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import soundfile

from pasted import run_pasted

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "scenes-in-python.md").read_text(encoding="utf-8")
BLOCKS = re.findall(r"<!-- ci: run -->\n```python\n(.*?)```", PAGE, re.DOTALL)
GAME = ROOT / "examples" / "game_in_python.py"


def test_the_code_of_the_page_runs(tmp_path: Path) -> None:
    assert PAGE.count("```") == 2 * len(BLOCKS)
    printed = [run_pasted(code, tmp_path) for code in BLOCKS]
    assert printed[-1].startswith("floating ('lamp',) 'lamp' floats")


def test_a_game_of_thirty_objects_is_right_to_the_sample(tmp_path: Path) -> None:
    """The game has 90 frames a second, which is not a whole number of samples per frame."""
    code = GAME.read_text(encoding="utf-8")
    assert "7 s of 30 objects" in run_pasted(code, tmp_path, "game.wav", "7")
    assert len(code.splitlines()) <= 60
    felt, rate = soundfile.read(tmp_path / "game.wav", always_2d=True)
    fade = len(felt) - 7 * rate  # the fade-out at the stop
    assert 0 <= fade < 0.02 * rate
    level = [np.sqrt((felt[second * rate :][:rate] ** 2).mean(axis=0)) for second in range(7)]
    # The phone lies on the table from 3.15 to 6.28 s, and is felt there, nearer to the left hand.
    assert (level[4] > 3 * level[1]).all()
    assert level[4][0] > level[4][1] > 0.0
