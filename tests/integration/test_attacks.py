"""A part of the attack table; `python stress/attack.py` runs any number of cases."""

import subprocess
import sys
from pathlib import Path

import pytest

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="needs fork")
ATTACK = Path(__file__).parents[2] / "stress" / "attack.py"


FAMILIES = ("scene_files", "servers", "names")


def test_a_slice_of_the_attack_table() -> None:
    command = [sys.executable, str(ATTACK), "--families", *FAMILIES, "--cases", "9", "--seed", "1"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=240)
    assert done.returncode == 0, done.stdout + done.stderr
    for family in FAMILIES:
        assert f"| {family} | 9 |" in done.stdout
