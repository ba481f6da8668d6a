"""The reports in docs/playing.md are those of the built-in kitchen."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from scene2hap import HapticBundle, HapticSession, Touch

PAGE = (Path(__file__).parents[2] / "docs" / "playing.md").read_text(encoding="utf-8")
REPORTS = re.findall(r"```\n(left touches back_wall:\n.*?)```", PAGE, re.DOTALL)


@pytest.mark.parametrize(("kind", "report"), list(zip(["exponential_plate", "modal_plate"], REPORTS, strict=True)))
@pytest.mark.filterwarnings("ignore::scene2hap.propagation.domain.ThinPlateWarning")
def test_explain_gives_the_lines_of_the_page(kitchen_bundle: Path, kind: str, report: str) -> None:
    bundle = HapticBundle.load(kitchen_bundle)
    session = HapticSession(bundle.snapshot, bundle, {"propagation": kind, "prepare": "blocking"})
    session.update(touches=[Touch("left", "back_wall", (2.3, 1.3, 0.0))])
    assert session.explain("left").text.startswith(report.rstrip())
