"""A part of the attack table, and of the damaged files; the scripts in `stress/` run any number of cases."""

import subprocess
import sys
from pathlib import Path

import pytest

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="needs fork")
STRESS = Path(__file__).parents[2] / "stress"
ATTACK = STRESS / "attack.py"


FAMILIES = ("scene_files", "servers", "names")


def test_a_slice_of_the_attack_table() -> None:
    # The first cases of this seed are of most kinds.
    command = [sys.executable, str(ATTACK), "--families", *FAMILIES, "--cases", "4", "--seed", "302"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=240)
    assert done.returncode == 0, done.stdout + done.stderr
    for family in FAMILIES:
        assert f"| {family} | 4 |" in done.stdout


def test_a_slice_of_the_damaged_files() -> None:
    readers = ["glTF", "bundle", "AHAP", "WAV FLOAT", "touches JSON", "settings TOML", "answers", "batches"]
    command = [sys.executable, str(STRESS / "hostile_files.py"), "--case", "1", "--readers", *readers]
    done = subprocess.run(command, capture_output=True, text=True, timeout=240)
    assert done.returncode == 0, done.stdout + done.stderr
    assert f"{len(readers)} cases, 0 failed" in done.stdout
