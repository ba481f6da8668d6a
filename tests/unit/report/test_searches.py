"""How often a report searches its scene."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from scene2hap import HapticBundle
from scene2hap.propagation.paths import prepared_paths, traced_paths
from scene2hap.report import report_document


def test_one_search_serves_levels_paths_and_contacts(kitchen_bundle: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A search from each source for the whole document, and none from a point."""
    n_sources = []
    search = prepared_paths.least_costs

    def counted(cost_per_m: Any, sides: Any, source_ids: Any) -> Any:
        n_sources.append(len(source_ids))
        return search(cost_per_m, sides, source_ids)

    def refused(*_: object) -> None:
        raise AssertionError("searched from a point")

    for module in (prepared_paths, traced_paths):
        monkeypatch.setattr(module, "least_costs", counted)
    monkeypatch.setattr("scene2hap.propagation.paths.live_law.LivePaths.least_costs", refused)
    bundle = HapticBundle.load(kitchen_bundle)
    found = report_document(bundle, most_points=300)
    assert n_sources == [len(bundle.loops)]
    assert any(contact["passes_db"] is not None for contact in found["contacts"])
