"""`bake_many` with worker processes: bundles equal those of one process, also after a crash; one process asks."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from importlib.util import find_spec
from pathlib import Path

import numpy as np
import pytest
import trimesh

from batch_server import answered
from llm_server import KEY, serving
from rooms_of_things import THINGS, digests, write_scenes
from scene2hap import Box, Pose, SceneObject, SceneSnapshot, TriMesh, bake_many

N_SCENES = 2


@pytest.fixture(scope="module")
def scenes(tmp_path_factory: pytest.TempPathFactory) -> list[Path]:
    return write_scenes(tmp_path_factory.mktemp("many") / "scenes", N_SCENES)


@pytest.fixture(scope="module")
def alone(scenes: list[Path], tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The bundles, baked in this process one after another."""
    folder = tmp_path_factory.mktemp("alone")
    assert bake_many(scenes, folder).count("baked") == len(scenes)
    return folder


DASK = """
import os, sys
from distributed import LocalCluster
from scene2hap import bake_many
if __name__ == "__main__":
    os.environ.update(MALLOC_TRIM_THRESHOLD_=str(128 << 20), MALLOC_MMAP_THRESHOLD_=str(32 << 20))
    with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster:
        print(bake_many(sys.argv[2:], sys.argv[1], executor=f"dask:{cluster.scheduler_address}"), flush=True)
"""


def test_dask_makes_the_same_bundles(scenes: list[Path], alone: Path, tmp_path: Path) -> None:
    if find_spec("distributed") is None:
        pytest.skip("distributed is not installed; pip install 'scene2hap[dask]'")
    program = tmp_path / "run.py"
    program.write_text(DASK)
    command = [sys.executable, str(program), str(tmp_path / "out"), *map(str, scenes)]
    run = subprocess.run(command, capture_output=True, text=True, timeout=300)
    assert f"{N_SCENES} scenes baked" in run.stdout, run.stderr[-2000:]
    assert digests(tmp_path / "out") == digests(alone)


def test_model_is_queried_from_the_main_process_once_per_question(
    scenes: list[Path], no_proxies: None, tmp_path: Path
) -> None:
    """Scenes that share an object share its answer; a second run, with sounds made by a worker, sends no request."""
    with serving(by=answered) as server:
        config = {
            "llm": {"kind": "local", "model": "scripted", "base_url": f"{server.base_url}/v1"},
            "cache_dir": str(tmp_path / "cache"),
        }
        report = bake_many(scenes[:2], tmp_path / "a", config=config)
        n_asked = len(server.asked)
        assert report.count("baked") == 2, [one.error for one in report.failed]
        assert 0 < n_asked < report.calls
        assert report.kept > 0
        again = bake_many(scenes[:2], tmp_path / "b", config=config, executor="processes:1")
        assert len(server.asked) == n_asked
        assert again.kept == again.calls
    assert digests(tmp_path / "a") == digests(tmp_path / "b")
    assert not list((tmp_path / "a" / ".bake-many").glob("*.draft"))


def radios(folder: Path, n: int) -> list[Path]:
    """Write rooms with one radio each, at different places and beside different objects."""
    folder.mkdir(parents=True)
    cabinet = trimesh.creation.box((0.3, 0.2, 0.15)).subdivide()
    mesh = TriMesh(np.asarray(cabinet.vertices), np.asarray(cabinet.faces, np.int32))
    for i in range(n):
        beside = [*THINGS][1 + i]
        things = (
            SceneObject(f"radio.{i:03d}", pose=Pose.from_yaw((0.3 * i, 0.1, 0.0), 0.7 * i), geometry=mesh),
            SceneObject(beside, pose=Pose((3.0, THINGS[beside][1] / 2, 0.0)), geometry=Box(THINGS[beside])),
        )
        (folder / f"room_{i}.json").write_text(SceneSnapshot.build(things, name="room").to_json())
    return sorted(folder.glob("*.json"))


@pytest.mark.skipif(find_spec("embreex") is None, reason="needs the extra 'pictures'")
@pytest.mark.parametrize(("share", "executor"), [(False, None), (True, "processes:1")])
def test_equal_objects_of_several_scenes_share_a_request_on_demand(
    share: bool, executor: str | None, no_proxies: None, tmp_path: Path
) -> None:
    """Two rooms give two requests about radios, or one if shared; this process or a worker draws the pictures."""
    with serving(by=answered) as server:
        config = {
            "llm": {"kind": "openai", "api_key": KEY, "base_url": f"{server.base_url}/v1"},
            "cache_dir": str(tmp_path / "cache"),
            "share_scenes": share,
        }
        report = bake_many(
            radios(tmp_path / "scenes", 2), tmp_path / "out", config=config, pictures=True, executor=executor
        )
        assert not report.failed, report.failed[0].error
        about_objects = [one for one in server.asked if '"vibrates"' in json.dumps(one.body["response_format"])]
        n_asked = len(server.asked)
    asked = [one for one in about_objects if "Your last answer was" not in one.prompt]
    about_radios = [one for one in asked if "radio" in one.prompt.split("Authored object name:")[1].splitlines()[0]]
    assert len(about_radios) == (1 if share else 2)
    assert len(asked) == len(about_radios) + 2
    n_pictures = {sum(part["type"] == "image_url" for part in one.body["messages"][0]["content"]) for one in asked}
    assert n_pictures == {8 if share else 16}
    assert report.calls - report.kept == n_asked - report.stack["RepairBackend"]["repairs"]
    assert not list((tmp_path / "out" / ".bake-many").glob("*.pictures"))


UNGUARDED = """
import sys

from scene2hap import bake_many
from scene2hap.baking.many import pool

pool._TRIES = 1
print(bake_many(sys.argv[2:], sys.argv[1], executor="processes:1").failed[0].error)
"""


def test_a_script_without_a_guard_of_its_entry_ends_with_advice(scenes: list[Path], tmp_path: Path) -> None:
    """Its workers bake too; they would wait for the folders of the run that started them."""
    script = tmp_path / "unguarded.py"
    script.write_text(UNGUARDED, encoding="utf-8")
    command = [sys.executable, str(script), str(tmp_path / "bundles"), str(scenes[0])]
    run = subprocess.run(command, capture_output=True, text=True, timeout=120, check=True)
    assert "__main__" in run.stdout
    assert "before the\n        current process has finished its bootstrapping" in run.stderr


PROGRAM = """
import sys
from scene2hap import bake_many
if __name__ == "__main__":
    print(bake_many(sys.argv[2:], sys.argv[1], executor="processes:2"), flush=True)
"""


@pytest.mark.skipif(sys.platform != "linux", reason="children are found in /proc, on Linux")
@pytest.mark.parametrize("who", ["worker", "parent"])
def test_bundles_after_a_killed_run_equal_an_undisturbed_run(
    who: str, scenes: list[Path], alone: Path, tmp_path: Path
) -> None:
    program = tmp_path / "run.py"
    program.write_text(PROGRAM)
    command = [sys.executable, str(program), str(tmp_path / "out"), *map(str, scenes[:2])]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as run:
        children = _children(run.pid, seconds=120.0)
        if who == "worker":
            time.sleep(1.5)
            os.kill(children[-1], signal.SIGKILL)
        else:
            run.kill()
            for child in children:
                os.kill(child, signal.SIGKILL)
        told, errors = run.communicate(timeout=300)
    if who == "worker":
        assert "2 scenes baked" in told, errors[-2000:]
    else:
        report = bake_many(scenes[:2], tmp_path / "out")
        assert not report.failed
    made, undisturbed = digests(tmp_path / "out"), digests(alone)
    assert made == {name: digest for name, digest in undisturbed.items() if name.startswith(("room_0", "room_1"))}


def _children(parent: int, seconds: float) -> list[int]:
    """Wait until a process has two worker processes. Returns their ids."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        found = []
        for one in Path("/proc").glob("[0-9]*"):
            try:
                is_worker = b"spawn_main" in (one / "cmdline").read_bytes()
                fields = (one / "stat").read_text().rpartition(")")[2].split()
            except OSError:
                continue
            if is_worker and int(fields[1]) == parent:
                found.append(int(one.name))
        if len(found) == 2:
            return sorted(found)
        time.sleep(0.05)
    raise AssertionError("no workers began")
