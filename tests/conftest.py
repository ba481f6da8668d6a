"""Set-up shared by all tests: helpers on the path, no network, the same Hypothesis examples in every run."""

import gc
import os
import socket
import sys
from collections.abc import Iterator
from pathlib import Path
from shutil import disk_usage, rmtree
from tempfile import mkdtemp

import pytest
from hypothesis import settings

sys.path.insert(0, str(Path(__file__).parent / "support"))

# The workers of pytest share the cores. Several BLAS threads in each worker, and in each process that tests start,
# would wait busily for each other and take many times as long. numpy and scipy read these variables when imported.
for variable in ("OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "OMP_NUM_THREADS"):
    os.environ.setdefault(variable, "1")

# Programs that tests start keep freed memory [bytes]. The C library of Linux would return each large array to the
# system, which clears it before it gives it again: a tenth of a bake.
for variable, kept in {"MALLOC_TRIM_THRESHOLD_": 1 << 27, "MALLOC_MMAP_THRESHOLD_": 1 << 25}.items():
    os.environ.setdefault(variable, str(kept))

MEMORY = Path("/dev/shm")
LEAST_MEMORY_BYTES = 4 << 30

# The same examples in each run make runs comparable; --hypothesis-profile=search draws others, and more of them.
settings.register_profile("same", derandomize=True, deadline=None, max_examples=40)
settings.register_profile("search", deadline=None, print_blob=True)
settings.load_profile("same")


@pytest.hookimpl(tryfirst=True)  # before pytest chooses its folder
def pytest_configure(config: pytest.Config) -> None:
    """Ignore scene warnings, except in the tests that catch them, and write temporary files into memory if it has room.

    Bundles and cached answers wait for the disk at each file, which takes a quarter of the suite's time.
    """
    if config.option.basetemp is None and os.access(MEMORY, os.W_OK) and disk_usage(MEMORY).free > LEAST_MEMORY_BYTES:
        config.option.basetemp = mkdtemp(prefix="scene2hap-tests-", dir=MEMORY)
        config.add_cleanup(lambda: rmtree(config.option.basetemp, ignore_errors=True))
    config.addinivalue_line("filterwarnings", "ignore::scene2hap.common.warning.SceneWarning")


def pytest_addoption(parser: pytest.Parser) -> None:
    """Add an option for environments in which the same code runs once more."""
    parser.addoption("--each-once", action="store_true", help="run each test with the first of its parameters alone")


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Keep the first of the tests that differ in their parameters, with --each-once."""
    if config.option.each_once:
        firsts: dict[str, pytest.Item] = {}
        for item in items:
            firsts.setdefault(item.nodeid.partition("[")[0], item)
        kept = set(firsts.values())
        config.hook.pytest_deselected(items=[item for item in items if item not in kept])
        items[:] = firsts.values()


@pytest.hookimpl(wrapper=True, tryfirst=True)
def pytest_collection() -> Iterator[None]:
    """Keep the garbage collector away while thousands of tests are made, all of which live until the end."""
    gc.disable()  # not frozen afterwards: Hypothesis would find its examples unreliable
    yield
    gc.enable()


@pytest.fixture(autouse=True, scope="session")
def _no_network() -> Iterator[None]:
    connect = socket.socket.connect

    def only_loopback(self: socket.socket, address: object) -> None:
        host = address[0] if isinstance(address, tuple) else ""
        if self.family in (socket.AF_INET, socket.AF_INET6) and host not in ("127.0.0.1", "::1", "localhost"):
            raise AssertionError(f"a test tried to reach {address!r}; tests use no network")
        connect(self, address)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(socket.socket, "connect", only_loopback)
        yield


@pytest.fixture
def no_proxies(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let requests go to servers of this machine directly."""
    for name in ("HTTP_PROXY", "HTTPS_PROXY", "ALL_PROXY", "http_proxy", "https_proxy", "all_proxy"):
        monkeypatch.delenv(name, raising=False)


@pytest.fixture(scope="session")
def kitchen_bundle(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of the demo kitchen's bundle, baked once. Tests that edit a bundle copy it."""
    from scene2hap import bake, load_scene
    from scene2hap.audio.sources.synth import Synthesizer
    from scene2hap.demo import kitchen_path
    from short_tones import SYNTHESIZED

    with pytest.MonkeyPatch.context() as patch:  # a module with `short_tones` may be the first that needs the bundle
        patch.setattr(Synthesizer, "find", SYNTHESIZED)
        return bake(load_scene(kitchen_path())).save(tmp_path_factory.mktemp("baked") / "kitchen.bundle")


@pytest.fixture(scope="module")
def short_tones() -> Iterator[None]:
    """Let the synthesizer give short tones, in this process: a bake takes a fifth of the time."""
    from scene2hap.audio.sources.synth import Synthesizer
    from short_tones import find

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Synthesizer, "find", find)
        yield
