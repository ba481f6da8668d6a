"""scene2hap computes with one BLAS thread, and leaves the process with as many as before."""

from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from threading import Barrier
from typing import Any

import numpy as np
import pytest
import scipy.linalg  # noqa: F401  # loads scipy's library
import soundfile
from threadpoolctl import ThreadpoolController

from contact_scenes import box
from scene2hap import HapticSession, SceneSnapshot, SessionConfig, Touch, bake
from scene2hap.audio import convert
from scene2hap.audio.clip import Samples
from scene2hap.audio.tactile.stages import StageStream
from scene2hap.common.blas_threads import one_blas_thread, set_threads
from scene2hap.propagation.coupled.coupling import couple
from scene2hap.propagation.points import object_points
from serial_bench import eventually

LIBRARIES = ThreadpoolController().select(user_api="blas").lib_controllers


def n_threads() -> set[int]:
    return {library.get_num_threads() for library in LIBRARIES}


@pytest.fixture(autouse=True)
def two_threads() -> Iterator[None]:
    """A program that has set two threads."""
    before = [library.get_num_threads() for library in LIBRARIES]
    for library in LIBRARIES:
        set_threads(library, 2)
    yield
    assert eventually(lambda: n_threads() == {2})  # a session's workers may still prepare
    for library, number in zip(LIBRARIES, before, strict=True):
        set_threads(library, number)


def test_numpy_and_scipy_have_a_library_that_can_be_set() -> None:
    assert LIBRARIES
    assert n_threads() == {2}


def test_one_thread_inside_also_after_an_inner_context() -> None:
    with one_blas_thread:
        with one_blas_thread:
            assert n_threads() == {1}
        assert n_threads() == {1}
    assert n_threads() == {2}


def test_an_error_restores_the_number() -> None:
    @one_blas_thread
    def fails() -> None:
        assert n_threads() == {1}
        raise ValueError

    with pytest.raises(ValueError):
        fails()
    assert n_threads() == {2}


def test_contexts_of_two_threads_overlap() -> None:
    entered, left = Barrier(2), Barrier(2)

    def first() -> None:
        with one_blas_thread:
            entered.wait()
        left.wait()

    def second() -> set[int]:
        with one_blas_thread:
            entered.wait()
            left.wait()
            return n_threads()

    with ThreadPoolExecutor(2) as pool:
        _, inside = pool.submit(first), pool.submit(second)
        assert inside.result() == {1}
    assert n_threads() == {2}


@pytest.mark.parametrize("kind", ["modal_plate", "infinite_plate", "mass_spring_damper", "auto"])
def test_sessions_prepare_and_evaluate_physical_models_with_one_thread(
    kind: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    seen: dict[str, set[int]] = {"prepare": set(), "evaluate": set()}

    def noting(phase: str, call: Callable[..., Any]) -> Callable[..., Any]:
        def noted(*args: Any, **named: Any) -> Any:
            seen[phase] |= n_threads()
            return call(*args, **named)

        return noted

    monkeypatch.setattr("scene2hap.propagation.coupled.substructuring.couple", noting("prepare", couple))
    monkeypatch.setattr("scene2hap.propagation.coupled.substructuring.object_points", noting("evaluate", object_points))
    phone, table = box("phone", (0.15, 0.01, 0.07), (0, 0.005, 0)), box("wooden table", (1, 0.03, 0.6), (0, -0.015, 0))
    scene = SceneSnapshot.build([phone, table])
    session = HapticSession(scene, bake(scene), SessionConfig(propagation={"kind": kind}, impacts=False))
    assert session.wait_prepared(60)
    frame = session.update({}, [Touch("left", "wooden table", (0.3, 0.0, 0.1))])
    assert frame.gain("left", "phone") > 0
    assert seen == {"prepare": {1}, "evaluate": {1}}


def test_a_sound_file_is_converted_with_one_thread(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    seen: set[int] = set()

    def noted(stream: StageStream, block: Samples) -> Samples:
        seen.update(n_threads())
        return process(stream, block)

    process = StageStream.process
    monkeypatch.setattr(StageStream, "process", noted)
    x = np.random.default_rng(1).uniform(-0.5, 0.5, (48_000, 2))
    soundfile.write(tmp_path / "noise.wav", x, 48_000)
    convert(tmp_path / "noise.wav", tmp_path / "felt.wav")
    assert seen == {1}
