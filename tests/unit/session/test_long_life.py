"""One simulated minute of stress/session.py: a game at 1 kHz that calls everything a session offers."""

from types import ModuleType

import pytest

from edge_scenes import EDGE_SCENES
from scripts import script


@pytest.fixture(scope="module")
def stress() -> ModuleType:
    return script("stress/session.py")


def test_a_minute_without_an_exception_or_drift(stress: ModuleType) -> None:
    found = stress.live(1.0)
    assert found.n_events > 500
    assert 0.05 < found.worst_level <= 1.0
    assert found.drift_samples <= 1.0


@pytest.mark.parametrize("name", EDGE_SCENES)
def test_edge_scenes_run_without_exceptions(stress: ModuleType, name: str) -> None:
    found = stress.live(0.1, bundled=EDGE_SCENES[name]())
    assert found.n_events > 50
    assert found.worst_level <= 1.0


def test_memory_does_not_grow(stress: ModuleType) -> None:
    import tracemalloc

    tracemalloc.start()
    try:
        found = stress.live(0.1, seed=2)
    finally:
        tracemalloc.stop()
    assert found.grown_bytes < 2**18
