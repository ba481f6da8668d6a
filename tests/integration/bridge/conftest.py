"""Fixtures: a bridge server in this process, and a small scene for it."""

from collections.abc import Callable, Iterator
from contextlib import ExitStack
from functools import partial
from pathlib import Path

import pytest

from c_client import HERE, Build, Driver, builder
from csharp_client import build_programs, run_trial
from scene2hap import Box, HapticBundle, Pose, SceneObject, SceneSnapshot, bake
from scene2hap.bridge import BridgeServer
from scene2hap.testing.bridge_client import serving


@pytest.fixture(scope="session")
def desk() -> HapticBundle:
    """A table with a phone that vibrates, and a mug."""
    return bake(
        SceneSnapshot.build(
            [
                SceneObject("table", "Wooden table", pose=Pose((0.0, 0.7, 0.0)), geometry=Box((1.2, 0.04, 0.7))),
                SceneObject("phone", "Smartphone", pose=Pose((0.2, 0.724, 0.0)), geometry=Box((0.07, 0.008, 0.15))),
                SceneObject("mug", "Coffee mug", pose=Pose((-0.3, 0.765, 0.0)), geometry=Box((0.08, 0.09, 0.08))),
            ]
        )
    )


@pytest.fixture
def root(tmp_path: Path, desk: HapticBundle) -> Path:
    """A folder with the bundle `desk.bundle`."""
    folder = tmp_path / "root"
    folder.mkdir()
    desk.save(folder / "desk.bundle")
    return folder


@pytest.fixture
def bridge(root: Path) -> Iterator[Callable[..., BridgeServer]]:
    """A function that starts bridges with the folder `root`."""
    with ExitStack() as stack:
        yield lambda **settings: stack.enter_context(serving(**{"root": root, **settings}))


@pytest.fixture(scope="session")
def build(tmp_path_factory: pytest.TempPathFactory) -> Build:
    """A function that compiles a program with the client for C."""
    return builder(tmp_path_factory.mktemp("c"))


@pytest.fixture
def driver(build: Build) -> Iterator[Driver]:
    """The client for C, by commands."""
    one = Driver(build(HERE / "driver.c", HERE / "client.c"))
    try:
        yield one
        assert not one.end()
    finally:
        one.kill()


@pytest.fixture(scope="session")
def programs(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of `game.exe` and `trials.exe`, which use the client for C#."""
    return build_programs(tmp_path_factory.mktemp("csharp"))


@pytest.fixture
def trial(programs: Path) -> Callable[..., list[str]]:
    """A function that runs a trial to its end and returns its output lines."""
    return partial(run_trial, programs)
