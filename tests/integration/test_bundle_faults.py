"""A save that is killed or refused an operation at any of its steps leaves the old or the new bundle complete."""

import json
import os
import subprocess
import sys
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import pytest

SUPPORT = Path(__file__).parents[1] / "support"
NEVER = 7
STRIDE = "10"  # every tenth of the similar steps that only write the draft; all of them take four minutes

pytestmark = pytest.mark.skipif(not hasattr(os, "fork"), reason="each step is tried in a fork")


@cache
def faults(kind: str, how: str) -> list[dict[str, Any]]:
    """The state after each fault, computed once for all tests."""
    memory = Path("/dev/shm")
    with TemporaryDirectory(dir=memory if os.access(memory, os.W_OK) else None) as work:
        return _tried(Path(work) / "work", kind, how)


def _tried(work: Path, kind: str, how: str) -> list[dict[str, Any]]:
    run = subprocess.run(
        [sys.executable, str(SUPPORT / "bundle_faults.py"), str(work), kind, how, STRIDE],
        env={**os.environ, "PYTHONPATH": str(SUPPORT)},
        capture_output=True,
        text=True,
        check=True,
    )
    rows: list[dict[str, Any]] = json.loads(run.stdout)
    assert len(rows) > 40
    assert rows[-1]["status"] == NEVER
    return rows


@pytest.mark.parametrize("how", ["exchange", "renames"])
@pytest.mark.parametrize("kind", ["kill", "refuse"])
def test_bundle_is_valid_after_a_fault_at_any_step(kind: str, how: str) -> None:
    """The user's files are kept, and the next save removes files that the fault left."""
    rows = faults(kind, how)
    for row in rows:
        assert row["found"] in ("old", "new", "new, recovered"), row
        assert row["thesis"], row
        assert (row["again"], row["thesis_again"]) == ("new", True), row
        assert row["left_again"] == [], row
        assert row["odd"] == [], row
        assert row["status"] in ({"kill": (9,), "refuse": (0, 3)}[kind] + ((NEVER,) if row is rows[-1] else ())), row
        if row["status"] == 3:
            assert (row["found"], row["left"]) == ("old", []), row
    assert {row["found"] for row in rows} >= {"old", "new"}


def test_exchange_always_leaves_a_readable_bundle() -> None:
    if not sys.platform.startswith(("linux", "darwin")):
        pytest.skip("this system has no exchange in one step")
    assert not any(row["was_missing"] for row in faults("kill", "exchange"))


def test_interrupted_rename_is_repaired_with_a_warning() -> None:
    between = [row for row in faults("kill", "renames") if row["was_missing"]]
    assert [row["found"] for row in between] == ["new, recovered"]
