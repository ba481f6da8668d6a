"""The example of the paper's study 2: the script and its output, and the cells of the notebook in order."""

from __future__ import annotations

import ast
import asyncio
import csv
import inspect
import json
import math
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import soundfile

from pasted import run_pasted
from scene2hap import materials

pytest.importorskip("matplotlib", reason="needs the extra plots")

EXAMPLES = Path(__file__).parents[2] / "examples"
POINTS_M = (0.0, 0.4, 0.8, 1.2)
SCENES = ("speaker on a metal table", "smartphone on a wooden table", "washing machine on a wooden floor")


def test_the_script_writes_every_condition_and_the_levels(tmp_path: Path) -> None:
    run_pasted((EXAMPLES / "paper_study2.py").read_text(encoding="utf-8"), tmp_path, "-o", "study2")
    folder = tmp_path / "study2"
    names = {
        f"{scene} {condition}".replace(" ", "_") for scene in SCENES for condition in ("none", "full", "attenuated")
    }
    assert {path.name for path in folder.iterdir()} == {*(f"{name}.wav" for name in names), "levels.csv", "levels.png"}

    with (folder / "levels.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    levels = {(row["scene"], row["model"], float(row["distance_m"])): float(row["level_db"]) for row in rows}
    assert len(levels) == len(rows) == 3 * 6 * 4
    for scene in SCENES:
        assert [levels[scene, "full_propagation", at] for at in POINTS_M] == [0.0] * 4
        assert [levels[scene, "no_propagation", at] for at in POINTS_M] == [0.0, *[-math.inf] * 3]
        law = [levels[scene, "exponential_plate", at] for at in POINTS_M]
        # Levels in dB fall linearly with distance, like exp(-k d).
        assert [a - b for a, b in pairwise(law)] == pytest.approx([law[0] - law[1]] * 3, abs=0.02)
        for at in POINTS_M:
            modal = levels[scene, "modal_plate", at]
            assert levels[scene, "auto", at] == pytest.approx(modal, abs=1.5)
            assert levels[scene, "mass_spring_damper", at] == pytest.approx(modal, abs=1.5)
    assert all(materials.lookup(row["surface"]) for row in rows)

    for scene in SCENES:
        rms = {}
        for condition in ("none", "full", "attenuated"):
            samples, rate = soundfile.read(folder / f"{scene.replace(' ', '_')}_{condition}.wav")
            stays = samples[: 4 * round(1.5 * rate)].reshape(4, -1)[:, rate // 10 :]
            rms[condition] = np.sqrt((stays**2).mean(axis=1))
        assert rms["none"][0] > 0.001
        # The rest of the fading gain is at most a third of a 16-bit step.
        assert rms["none"][1:] == pytest.approx([0.0] * 3, abs=1e-5)
        assert (rms["full"][1:] > 0.5 * rms["full"][0]).all()
        assert rms["attenuated"][0] > rms["attenuated"][1] > rms["attenuated"][2] >= rms["attenuated"][3]


async def last_values(cells: list[dict[str, Any]]) -> list[object]:
    """Run cells like a notebook: in one namespace, with a running event loop. Returns their last values."""
    names: dict[str, object] = {}
    shown = []
    for cell in cells:
        code = ast.parse("".join(cell["source"]))
        *lines, last = code.body
        if not isinstance(last, ast.Expr):
            lines.append(last)
        waiting = eval(compile(ast.Module(lines, []), cell["id"], "exec", ast.PyCF_ALLOW_TOP_LEVEL_AWAIT), names)
        if inspect.iscoroutine(waiting):
            await waiting
        if isinstance(last, ast.Expr):
            shown.append(eval(compile(ast.Expression(last.value), cell["id"], "eval"), names))
    return shown


def test_notebook_cells_run_in_order(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Cells run in one namespace, and their last values can be displayed."""
    notebook = json.loads((EXAMPLES / "paper_study2.ipynb").read_text(encoding="utf-8"))
    cells = [cell for cell in notebook["cells"] if cell["cell_type"] == "code"]
    assert all(cell["outputs"] == [] and cell["execution_count"] is None for cell in cells), "clear the outputs"
    assert len({cell["id"] for cell in notebook["cells"]}) == len(notebook["cells"])
    monkeypatch.chdir(tmp_path)
    monkeypatch.syspath_prepend(str(EXAMPLES))
    monkeypatch.setenv("MPLBACKEND", "agg")
    shown = asyncio.run(last_values(cells))
    assert [type(one).__name__ for one in shown] == [
        "SceneSnapshot", "HapticBundle", "ShownFigure", "Material", "ShownFigure", "ShownFigure", "Explanation", "list",
        "ShownFigure",
    ]  # fmt: skip
    for one in shown:
        if hasattr(one, "_repr_html_") and not hasattr(one, "savefig"):
            assert one._repr_html_().startswith("<div>")
    assert len(list((tmp_path / "study2").iterdir())) == 9
