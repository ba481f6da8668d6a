"""Warnings have a category of the library and point at the line of the program that caused them."""

import asyncio
import inspect
import threading
import warnings
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from pathlib import Path

import pytest

import scene2hap
from scene2hap import (
    Box,
    HapticBundle,
    HapticSession,
    Override,
    Pose,
    SceneObject,
    SceneSnapshot,
    SceneWarning,
    abake,
    bake,
    rebake,
)

pytestmark = pytest.mark.usefixtures("short_tones")

TABLE = SceneObject("wooden table", pose=Pose((0.0, 0.36, 0.0)), geometry=Box((1.2, 0.72, 0.7)))
PHONE = SceneObject("smartphone", pose=Pose((0.3, 0.724, 0.1)), geometry=Box((0.07, 0.008, 0.15)))
SCENE = SceneSnapshot.build([TABLE, PHONE])


@pytest.fixture(scope="module")
def bundle() -> HapticBundle:
    return bake(SCENE)


@pytest.fixture
def doubtful(bundle: HapticBundle, tmp_path: Path) -> Path:
    """A bundle with a state that needs something that the scene does not have."""
    folder = bundle.save(tmp_path / "desk.bundle")
    objects = folder / "objects.json"
    told = objects.read_text("utf-8").replace('"needs_contact": null', '"needs_contact": "unicorn"')
    objects.write_text(told, "utf-8")
    return folder


def places_of(call: Callable[[], object]) -> set[tuple[str, bool, bool]]:
    """Name, whether the category is ours, and whether the line is in this file, of each warning of a call."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        call()
    ours = Path(inspect.getfile(scene2hap)).parent.name
    return {
        (one.category.__name__, one.category.__module__.partition(".")[0] == ours, one.filename == __file__)
        for one in caught
    }


def test_bundle_by_path_warns_at_the_callers_line(doubtful: Path) -> None:
    expected = {("BundleWarning", True, True)}
    assert places_of(lambda: HapticBundle.load(doubtful)) == expected
    assert places_of(lambda: HapticSession(doubtful)) == expected
    assert places_of(lambda: rebake(doubtful)) == expected


def test_corrections_warn_at_the_callers_line(bundle: HapticBundle) -> None:
    assert places_of(lambda: bundle.override("smartphone", gain_db=50)) == {("SceneWarning", True, True)}
    lost = {"lamp": Override(gain_db=3.0)}
    assert places_of(lambda: bake(SCENE, overrides=lost)) == {("BundleWarning", True, True)}
    assert places_of(lambda: asyncio.run(abake(SCENE, overrides=lost))) == {("BundleWarning", True, True)}


def in_thread(work: Callable[[], object]) -> None:
    thread = threading.Thread(target=work)
    thread.start()
    thread.join()


def in_pool(work: Callable[[], object]) -> None:
    with ThreadPoolExecutor(1) as pool:
        pool.submit(work).result()


def beside_an_event_loop(work: Callable[[], object]) -> None:
    asyncio.run(asyncio.to_thread(work))  # as `bake_many` reads scenes


@pytest.mark.parametrize("run", [in_thread, in_pool, beside_an_event_loop])
def test_a_warning_on_a_thread_of_the_library_points_at_the_line_that_warns(run: Callable[..., None]) -> None:
    """There is no line of a caller, and one of the standard library says nothing."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        run(partial(Pose.from_yaw, (0, 0, 0), 90))
    assert [one.category for one in caught] == [SceneWarning]
    assert Path(caught[0].filename).is_relative_to(Path(scene2hap.__file__).parent)
