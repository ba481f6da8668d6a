"""The README's example and commands run as written."""

import re
import subprocess
import sys
from pathlib import Path

import pytest
import soundfile

from scene2hap.render.safety import FADE_OUT_S

ROOT = Path(__file__).parents[2]
README = (ROOT / "README.md").read_text(encoding="utf-8")


def block(marker: str) -> str:
    found = re.search(rf"<!-- ci: {marker} -->\n```\w+\n(.*?)```", README, re.DOTALL)
    assert found, f"README.md has no block marked {marker}"
    return found[1]


def test_the_example_works_when_pasted(tmp_path: Path) -> None:
    run = subprocess.run(
        [sys.executable, "-W", "error", "-c", block("example")], cwd=tmp_path, capture_output=True, text=True
    )
    assert run.returncode == 0, run.stderr
    told = re.search(r"#\s(the phone: (-\d+\.\d) dB)\n", block("example"))
    assert told, "the example says what it prints"
    assert run.stdout == told[1] + "\n"
    assert -12 < float(told[2]) < -3  # near enough to be felt, too far to be the phone itself
    samples, rate = soundfile.read(tmp_path / "touch.wav")
    assert samples.shape == (2 * rate + round(FADE_OUT_S * rate), 2)
    assert samples[:, 0].any()
    assert not samples[:, 1].any()
    assert (tmp_path / "kitchen.bundle" / "bundle.json").is_file()


def test_the_example_is_about_ten_lines() -> None:
    assert len([line for line in block("example").splitlines() if line.strip()]) <= 13


@pytest.mark.parametrize("marker", ["demo", "tests"])
def test_the_two_commands_stand_on_the_first_screen(marker: str) -> None:
    first_screen = "\n".join(README.splitlines()[:30])
    assert block(marker).strip() in first_screen
    assert block(marker).startswith("python3 -m venv .venv && .venv/bin/python -m pip install -e ")


def test_every_link_leads_somewhere() -> None:
    for document in (ROOT / "README.md", *(ROOT / "docs").rglob("*.md")):
        for target in re.findall(r"\]\(([^)#]+)(?:#[^)]*)?\)", document.read_text(encoding="utf-8")):
            if "://" not in target:
                assert (document.parent / target).exists(), f"{document.name} links to {target}"
