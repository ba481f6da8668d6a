"""How many processes a pool may have."""

import sys
from concurrent.futures import ProcessPoolExecutor

import pytest

from scene2hap.common.worker_processes import most_workers


@pytest.mark.parametrize(("platform", "given"), [("win32", 61), ("linux", 128), ("darwin", 128)])
def test_windows_alone_bounds_the_workers(monkeypatch: pytest.MonkeyPatch, platform: str, given: int) -> None:
    monkeypatch.setattr(sys, "platform", platform)
    assert most_workers(128) == given
    assert most_workers(4) == 4


def test_a_pool_takes_as_many() -> None:
    ProcessPoolExecutor(most_workers(256)).shutdown()  # it starts none before the first task
