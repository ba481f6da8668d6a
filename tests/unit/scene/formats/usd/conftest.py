"""USD files are read in the tests' own process unless a test asks for a child."""

from __future__ import annotations

import pytest

from scene2hap.scene.formats.usd import process
from usd_writing import usd


@pytest.fixture(autouse=True)
def _in_process(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    """Read files in this process, except in tests with `child`: starting Python takes longer than most tests."""
    usd("Usd")
    if "child" not in request.fixturenames:
        monkeypatch.setattr(process, "can_start_python", lambda: False)


@pytest.fixture
def child() -> None:
    """A marker for tests that read in a child process, as users do."""
