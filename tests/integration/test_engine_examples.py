"""The examples with engines, run as a person would run them, and what they write."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import soundfile

from others import SCENES, there
from rooms.furniture import write_furniture
from scene2hap.render.safety import FADE_OUT_S

ROOT = Path(__file__).parents[2]


def run(example: str, *arguments: str | Path, folder: Path) -> str:
    command = [sys.executable, "-W", "error", ROOT / "examples" / example, *arguments]
    done = subprocess.run(list(map(str, command)), cwd=folder, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert done.stderr == ""
    return done.stdout


def rms(samples: np.ndarray) -> list[float]:
    return [float(value) for value in np.sqrt((samples**2).mean(axis=0))]


def test_a_phone_is_carried_from_table_to_shelf_in_panda3d(tmp_path: Path) -> None:
    pytest.importorskip("panda3d", reason="needs the extra panda3d")
    told = run("panda3d_scene.py", "-o", "felt.wav", folder=tmp_path)
    assert "wrote felt.wav" in told
    samples, rate = soundfile.read(tmp_path / "felt.wav")
    assert samples.shape == (2 * rate + round(FADE_OUT_S * rate), 2)
    before, after = rms(samples[: rate - rate // 10]), rms(samples[rate + rate // 10 :])
    assert before[0] > 0.001  # the hand on the table feels the phone
    assert after[0] < before[0] / 100  # until it is taken away
    assert after[1] > 1.5 * before[1] > 0  # to the shelf, where the fan is


@pytest.mark.parametrize("name", ["own", *there(["furniture_sim"], SCENES.joinpath)])
def test_hands_feel_a_mujoco_dishwasher_while_its_rack_slides(tmp_path: Path, name: str) -> None:
    pytest.importorskip("mujoco", reason="needs the extra mujoco")
    root = write_furniture(tmp_path / "furniture") if name == "own" else SCENES / name
    folder = tmp_path / "felt"
    folder.mkdir()
    told = run("mujoco_kitchen.py", root / "dishwasher.xml", "--seconds", "0.2", "-o", "felt.wav", folder=folder)
    assert re.search(r"^moved: .*top_rack by 0\.\d+ m", told, re.MULTILINE)
    samples, rate = soundfile.read(folder / "felt.wav")
    assert samples.shape == (round(0.2 * rate) + round(FADE_OUT_S * rate), 2)
    left, right = rms(samples)
    assert left > right > 0  # on the source itself, and on what it touches
    assert {path.name for path in folder.iterdir()} == {"felt.wav"}
