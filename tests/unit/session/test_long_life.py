"""Some simulated seconds of stress/session.py: a game at 1 kHz that calls everything a session offers."""

from collections.abc import Iterator
from types import ModuleType

import pytest

from edge_scenes import EDGE_SCENES
from garbage import only_new_garbage
from scripts import script


@pytest.fixture(autouse=True)
def _only_new_garbage() -> Iterator[None]:
    with only_new_garbage():
        yield


@pytest.fixture(scope="module")
def stress() -> ModuleType:
    return script("stress/session.py")


@pytest.fixture
def without_memory(stress: ModuleType, monkeypatch: pytest.MonkeyPatch) -> None:
    """Do not measure the memory of the process, which is read from Linux's /proc and judged by the last test alone."""
    monkeypatch.setattr(stress, "held_bytes", lambda: 0)


@pytest.mark.usefixtures("without_memory")
def test_a_game_of_20_s_runs_without_an_exception_or_drift(stress: ModuleType) -> None:
    found = stress.live(20 / 60)
    assert found.n_events > 170
    assert 0.05 < found.worst_level <= 1.0
    assert found.drift_samples <= 1.0


@pytest.mark.usefixtures("without_memory")
@pytest.mark.parametrize("name", EDGE_SCENES)
def test_edge_scenes_run_without_exceptions(stress: ModuleType, name: str) -> None:
    found = stress.live(3 / 60, bundled=EDGE_SCENES[name]())
    assert found.n_events > 25
    assert found.worst_level <= 1.0


def test_memory_does_not_grow(stress: ModuleType) -> None:
    import tracemalloc

    tracemalloc.start()
    try:
        found = stress.live(0.1, seed=2)
    finally:
        tracemalloc.stop()
    assert found.grown_bytes < 2**18
