"""The reports in docs/playing.md and the observation in docs/trials.md are those of the built-in kitchen."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

from scene2hap import HapticBundle, HapticSession, Touch

DOCS = Path(__file__).parents[2] / "docs"
TRIALS = (DOCS / "trials.md").read_text(encoding="utf-8")
(OBSERVE,) = re.findall(r"## Vibration as numbers\n.*?```python\n(.*?)\n\n\nprint\(", TRIALS, re.DOTALL)
REPORTS = re.findall(
    r"```\n(left touches back_wall:\n.*?)```", (DOCS / "playing.md").read_text(encoding="utf-8"), re.DOTALL
)


@pytest.mark.parametrize(("kind", "report"), list(zip(["exponential_plate", "modal_plate"], REPORTS, strict=True)))
@pytest.mark.filterwarnings("ignore::scene2hap.propagation.domain.ThinPlateWarning")
def test_explain_gives_the_lines_of_the_page(kitchen_bundle: Path, kind: str, report: str) -> None:
    bundle = HapticBundle.load(kitchen_bundle)
    session = HapticSession(bundle.snapshot, bundle, {"propagation": kind, "prepare": "blocking"})
    session.update(touches=[Touch("left", "back_wall", (2.3, 1.3, 0.0))])
    assert session.explain("left").text.startswith(report.rstrip())


def test_the_observation_of_the_page_is_the_level_that_explain_reports(kitchen_bundle: Path) -> None:
    names = {"bundle": HapticBundle.load(kitchen_bundle), "HapticSession": HapticSession, "Touch": Touch}
    exec(OBSERVE, names)
    agent = names["agent"]
    assert (names["observe"]([]) == 0.0).all()
    agent.set_source("washing_machine", gain_db=-6)
    for object_id, point_m in {
        "dining_table": (2.2, 0.74, 2.2),
        "washing_machine": agent.poses["washing_machine"].position_m,
    }.items():
        (observed,) = names["observe"]([Touch("finger", object_id, point_m)])
        felt = {one.source_id: one.over_threshold_db for one in agent.explain("finger").felt if not one.is_too_weak}
        assert felt
        expected = [felt.get(source_id, 0.0) for source_id in agent.source_ids]
        assert observed == pytest.approx(np.array(expected), abs=1e-3)
