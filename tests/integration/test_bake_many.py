"""`bake_many`: equal bundles from every executor; after a crash nothing is lost or paid for twice."""

from __future__ import annotations

import argparse
import asyncio
import json
import shutil
import threading
import warnings
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path
from typing import Any, ClassVar

import pytest
import trimesh

from batch_server import answered
from llm_server import KEY, serving
from rooms_of_things import digests, write_scenes
from scene2hap import (
    CacheBackend,
    HapticBundle,
    LLMReply,
    LLMRequest,
    SceneSnapshot,
    bake,
    bake_many,
    load_scene,
    rebake,
)
from scene2hap.baking.many import plan_many, tasks
from scene2hap.baking.many.record import scene_digest
from scene2hap.baking.many.report import ManyReport
from scene2hap.baking.many.run import abake_many
from scene2hap.cli import bake_many as bake_many_command, main
from scene2hap.common.warning import SceneWarning
from scene2hap.errors import ConfigError
from scene2hap.llm.lexicon import LexiconBackend
from scene2hap.llm.protocol import BackendWarning

N_SCENES = 2

pytestmark = pytest.mark.usefixtures("short_tones")


@pytest.fixture(scope="module")
def scenes(tmp_path_factory: pytest.TempPathFactory) -> list[Path]:
    return write_scenes(tmp_path_factory.mktemp("many") / "scenes", N_SCENES)


@pytest.fixture(scope="module")
def alone(scenes: list[Path], tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The bundles, baked in this process one after another."""
    folder = tmp_path_factory.mktemp("alone")
    report = bake_many(scenes, folder)
    assert report.count("baked") == len(scenes)
    return folder


def test_bundles_equal_those_of_bake(scenes: list[Path], alone: Path, tmp_path: Path) -> None:
    bake(load_scene(scenes[1])).save(tmp_path / f"{scenes[1].stem}.bundle")
    mine = digests(tmp_path)
    assert mine
    assert mine.items() <= digests(alone).items()


def test_other_executors_make_the_same_bundles(scenes: list[Path], alone: Path, tmp_path: Path) -> None:
    with ThreadPoolExecutor(2) as executor:
        report = bake_many(scenes[:2], tmp_path, executor=executor)
    assert [one.scene for one in report.scenes] == [str(path) for path in scenes[:2]]
    assert digests(tmp_path).items() <= digests(alone).items()


def test_finished_bundles_are_kept_until_scene_or_settings_change(scenes: list[Path], tmp_path: Path) -> None:
    copies = write_scenes(tmp_path / "scenes", 2)
    folder = tmp_path / "out"
    assert bake_many(copies, folder).count("baked") == 2
    again = bake_many(copies, folder)
    assert [one.outcome for one in again.scenes] == ["kept", "kept"]
    assert again.scenes[0].n_objects == 2
    copies[0].write_text(copies[0].read_text().replace("radio", "loudspeaker"))
    assert [one.outcome for one in bake_many(copies, folder).scenes] == ["baked", "kept"]
    assert [one.outcome for one in bake_many(copies, folder, config={"actuator": "lra"}).scenes] == ["baked", "baked"]
    shutil.rmtree(folder / "room_1.bundle")
    last = bake_many(copies, folder, config={"actuator": "lra"})
    assert [one.outcome for one in last.scenes] == ["kept", "baked"]
    # Also on Windows, since the folder may be copied to another system.
    paths = [str(row[name]) for row in last.to_data()["scenes"] for name in ("scene", "bundle")]
    paths += [json.loads(file.read_text())["path"] for file in (folder / ".bake-many").glob("room_*.json")]
    assert len(paths) == 6
    assert not any("\\" in path for path in paths)


def test_overrides_stay_when_a_scene_is_baked_again(tmp_path: Path) -> None:
    (scene,) = write_scenes(tmp_path / "scenes", 1)
    folder = tmp_path / "out"
    bake_many([scene], folder)
    target = folder / "room_0.bundle"
    HapticBundle.load(target).override("radio", gain_db=-6.0).save(target)
    bake_many([scene], folder, config={"seed": 1})
    assert HapticBundle.load(target).gain_db("radio") == -6.0


@pytest.mark.parametrize("name", ["objects.json", "overrides.json"])
def test_a_bundle_that_somebody_edited_is_kept_when_its_scene_is_baked_again(name: str, tmp_path: Path) -> None:
    scenes = write_scenes(tmp_path / "scenes", 2)
    folder = tmp_path / "out"
    bake_many(scenes, folder)
    edited = folder / "room_0.bundle" / name
    # As by an editor; objects.json cannot be read afterwards.
    text = '{"radio": {"gain_db": -6.5}}' if name == "overrides.json" else edited.read_text()[:-9]
    edited.write_text(text)
    assert bake_many(scenes, folder).count("kept") == 2
    report = bake_many(scenes, folder, config={"seed": 1})
    kept = folder / "room_0.bundle.before"
    assert [any(kept.name in one for one in scene.warnings) for scene in report.scenes] == [True, False]
    assert "".join((kept / name).read_text().split()) == "".join(text.split())
    assert sorted(path.name for path in folder.glob("room*")) == ["room_0.bundle", kept.name, "room_1.bundle"]
    bake_many(scenes, folder, config={"seed": 2})  # nobody has edited anything since
    assert sorted(path.name for path in folder.glob("room*")) == ["room_0.bundle", kept.name, "room_1.bundle"]


def test_scenes_that_fail_do_not_stop_the_others(scenes: list[Path], tmp_path: Path) -> None:
    broken = tmp_path / "broken.glb"
    broken.write_bytes(b"glTF" + bytes(40))
    (tmp_path / "room").mkdir()
    report = bake_many([broken, tmp_path / "absent.glb", tmp_path / "room", scenes[0]], tmp_path / "out")
    assert [one.outcome for one in report.scenes] == ["failed", "failed", "failed", "baked"]
    assert "SceneFormatError" in report.scenes[0].error
    assert "absent.glb" in report.scenes[1].error
    assert "not its folder" in report.scenes[2].error
    data = json.loads((tmp_path / "out" / "report.json").read_text())
    assert (data["baked"], data["failed"]) == (1, 3)


def test_error_of_the_report_names_the_errors_of_the_scenes(scenes: list[Path], tmp_path: Path) -> None:
    (tmp_path / "out" / "report.json").mkdir(parents=True)
    with pytest.raises(
        ConfigError, match=r"report\.json cannot be written.* 1 scene baked, 0 kept, 1 failed.*absent\.glb"
    ):
        bake_many([tmp_path / "absent.glb", scenes[0]], tmp_path / "out")


def test_a_plan_says_what_a_run_will_do_and_asks_nothing(scenes: list[Path], no_proxies: None, tmp_path: Path) -> None:
    twins = [scenes[0], Path(shutil.copy(scenes[0], tmp_path / "twin.json"))]
    with serving(by=answered) as server:
        config = {
            "llm": {"kind": "local", "model": "scripted", "base_url": f"{server.base_url}/v1"},
            "cache_dir": str(tmp_path / "cache"),
            "prices": {"scripted": (1.0, 1.0)},
        }
        before = plan_many(twins, tmp_path / "a", config=config)
        assert not server.asked
        assert not (tmp_path / "a").exists()
        report = bake_many(scenes[:2], tmp_path / "a", config=config)
        n_asked = len(server.asked)
        after = plan_many([*scenes[:2], tmp_path / "absent.glb"], tmp_path / "a", config=config)
        again = plan_many(scenes[:2], tmp_path / "a", config={**config, "actuator": "lra"})
        assert len(server.asked) == n_asked
    one, twin = (plan.questions for plan in before)
    assert one is not None
    assert twin is not None
    assert [plan.plan for plan in before] == ["bake", "bake"]
    assert (one.kept, twin.n_calls, twin.kept) == (0, 0, one.n_calls)
    assert one.calls["object_analyzer"] == 2
    assert one.cost_usd is not None
    assert one.cost_usd > 0.0
    assert [one.plan for one in after] == ["keep", "keep", "fail"]
    assert "absent.glb" in after[2].error
    assert [one.plan for one in again] == ["bake", "bake"]
    assert [(asked.n_calls, asked.cost_usd) for one in again if (asked := one.questions)] == [(0, 0.0), (0, 0.0)]
    assert sum(one.questions.kept for one in again if one.questions) == report.calls


def test_the_command_shows_a_plan(scenes: list[Path], tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    command = ["bake-many", *map(str, scenes[:2]), "-o", str(tmp_path / "out"), "--dry-run"]
    assert (
        main([*command, "--llm", "openai:gpt-4o", "--no-pictures", "--cache", str(tmp_path / "cache"), "--json"]) == 0
    )
    told = json.loads(capsys.readouterr().out)
    assert [one["plan"] for one in told["scenes"]] == ["bake", "bake"]
    assert told["calls"] > 0
    assert 0.0 < told["cost_usd"] < 1.0
    assert main(command) == 0
    assert "2 scenes: 2 to bake" in capsys.readouterr().out
    assert not (tmp_path / "out").exists()


def test_a_plan_with_a_scene_that_cannot_be_baked_ends_with_status_1(
    scenes: list[Path], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "broken.glb").write_bytes(b"junk")
    command = ["bake-many", str(scenes[0]), str(tmp_path / "broken.glb"), "-o", str(tmp_path / "out"), "--dry-run"]
    assert main([*command, "--json"]) == 1
    told = capsys.readouterr()
    assert [one["plan"] for one in json.loads(told.out)["scenes"]] == ["bake", "fail"]
    assert "1 of 2 scenes cannot be baked." in told.err


@pytest.mark.parametrize("given", [None, 3])
def test_scenes_of_another_type_are_refused(given: Any, tmp_path: Path) -> None:
    for make in (bake_many, plan_many):
        with pytest.raises(ConfigError, match=f"scenes is {given}; it must be a sequence"):
            make(given, tmp_path)


def test_a_model_reads_the_name_that_a_person_gave(no_proxies: None, tmp_path: Path) -> None:
    (scene,) = write_scenes(tmp_path / "scenes", 1)
    target = tmp_path / "out" / "room_0.bundle"
    bake_many([scene], tmp_path / "out")
    HapticBundle.load(target).override("radio", name="flurbelgurk").save(target)
    with serving(by=answered) as server:
        llm = {"kind": "local", "model": "scripted", "base_url": f"{server.base_url}/v1"}
        bake_many([scene], tmp_path / "out", config={"llm": llm, "cache_dir": str(tmp_path / "cache")})
        assert any('"flurbelgurk"' in one.prompt for one in server.asked)
    named = HapticBundle.load(target)
    assert named.objects["radio"].reasons["name"] == "a person calls it 'flurbelgurk'."
    assert rebake(named).objects == named.objects


def test_a_report_names_corrections_of_objects_that_are_gone(tmp_path: Path) -> None:
    (scene,) = write_scenes(tmp_path / "scenes", 1)
    target = tmp_path / "out" / "room_0.bundle"
    bake_many([scene], tmp_path / "out")
    bundle = HapticBundle.load(target).override("radio", gain_db=-6.0)
    bundle.save(target)
    left = [item for item in bundle.snapshot.objects if item.id != "radio"]
    scene.write_text(replace(bundle.snapshot, objects=tuple(left)).to_json(), encoding="utf-8")
    (report,) = bake_many([scene], tmp_path / "out").scenes
    assert report.outcome == "baked", report.error
    assert any("override of 'radio' is dropped" in sentence for sentence in report.warnings), report.warnings


class Held:
    """The lexicon behind a network address. Each call waits until it is released."""

    identity: ClassVar = {"model": "held", "base_url": "http://127.0.0.1:1/v1"}

    def __init__(self) -> None:
        self.calls: list[asyncio.Event] = []

    async def complete(self, request: LLMRequest) -> LLMReply:
        self.calls.append(asyncio.Event())
        await self.calls[-1].wait()
        return await LexiconBackend().complete(request)


def test_a_cancelled_run_keeps_the_answers_that_all_its_scenes_have_paid_for(
    scenes: list[Path], tmp_path: Path
) -> None:
    async def cancelled() -> None:
        held = Held()
        config = {"llm": CacheBackend(held, tmp_path / "answers")}
        running = asyncio.ensure_future(abake_many(scenes[:2], tmp_path / "out", config=config))
        while len(held.calls) < 2:
            await asyncio.sleep(0.01)
        running.cancel()
        for released in held.calls:
            await asyncio.sleep(0.1)
            assert not running.done()
            released.set()
        with pytest.raises(asyncio.CancelledError):
            await running
        assert len(held.calls) == 2

    with pytest.warns(BackendWarning, match="stopping"):
        asyncio.run(cancelled())
    assert len(list((tmp_path / "answers").glob("*.json"))) == 2


def test_a_cancelled_run_sends_no_question_that_waits_for_another_scene(scenes: list[Path], tmp_path: Path) -> None:
    async def cancelled() -> None:
        held = Held()
        running = asyncio.ensure_future(abake_many(scenes[:2], tmp_path, config={"llm": held, "concurrency": 1}))
        while not held.calls:
            await asyncio.sleep(0.01)
        await asyncio.sleep(0.5)  # the other scene waits
        running.cancel()
        await asyncio.sleep(0.1)
        held.calls[0].set()
        with pytest.raises(asyncio.CancelledError):
            await asyncio.wait_for(running, 60.0)
        assert len(held.calls) == 1

    with pytest.warns(BackendWarning, match="1 question to the model"):
        asyncio.run(cancelled())


@pytest.mark.parametrize("is_remote", [False, True])
def test_a_scene_that_is_made_while_the_run_is_cancelled_is_kept_by_the_next_run(
    is_remote: bool, scenes: list[Path], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    begun, name = threading.Event(), "make_sounds" if is_remote else "bake_scene"
    work = getattr(tasks, name)

    def noted(*arguments: Any) -> tasks.Counters:
        begun.set()
        return work(*arguments)

    monkeypatch.setattr(f"scene2hap.baking.many.run.{name}", noted)
    config = {"llm": Unhurried() if is_remote else LexiconBackend()}

    async def cancelled() -> None:
        running = asyncio.ensure_future(abake_many(scenes, tmp_path, config=config))
        await asyncio.to_thread(begun.wait)
        running.cancel()
        with pytest.raises(asyncio.CancelledError):
            await running

    asyncio.run(cancelled())
    report = bake_many(scenes, tmp_path, config=config)
    assert (report.count("kept"), report.count("baked")) == (1, len(scenes) - 1)
    assert [one.warnings for one in report.scenes] == [()] * len(scenes)
    assert not [*tmp_path.glob("*.before*"), *(tmp_path / ".bake-many").glob("*.draft")]


def test_a_second_cancellation_does_not_wait_for_the_scene_that_is_being_made(
    scenes: list[Path], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    begun, released = threading.Event(), threading.Event()

    def held(*arguments: Any) -> tasks.Counters:
        begun.set()
        assert released.wait(60.0)
        return tasks.bake_scene(*arguments)

    monkeypatch.setattr("scene2hap.baking.many.run.bake_scene", held)

    async def cancelled() -> None:
        running = asyncio.ensure_future(abake_many(scenes[:1], tmp_path))
        await asyncio.to_thread(begun.wait)
        running.cancel()
        done, _ = await asyncio.wait([running], timeout=0.1)
        assert not done
        running.cancel()
        with pytest.raises(asyncio.CancelledError):
            await running

    asyncio.run(cancelled())  # which would wait for asyncio's own threads
    released.set()


class Unhurried:
    """The lexicon, with the address of a network model."""

    identity: ClassVar = {"model": "held", "base_url": "http://127.0.0.1:1/v1"}

    async def complete(self, request: LLMRequest) -> LLMReply:
        return await LexiconBackend().complete(request)


def test_a_bundle_whose_record_was_lost_is_not_taken_for_an_edited_one(scenes: list[Path], tmp_path: Path) -> None:
    bake_many(scenes[:1], tmp_path)
    record = next((tmp_path / ".bake-many").glob("*.json"))
    record.unlink()  # as if the run was killed before it wrote the record
    report = bake_many(scenes[:1], tmp_path)
    assert report.count("baked") == 1
    assert report.scenes[0].warnings == ()
    assert not list(tmp_path.glob("*.before*"))
    assert not list((tmp_path / ".bake-many").glob("*.new"))


def test_reading_a_scene_hides_only_the_warnings_that_workers_repeat(
    scenes: list[Path], no_proxies: None, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def reading(*arguments: Any, **more: Any) -> SceneSnapshot:
        warnings.warn("of a model", BackendWarning, stacklevel=1)
        warnings.warn("of the scene", SceneWarning, stacklevel=1)
        return load_scene(*arguments, **more)

    monkeypatch.setattr("scene2hap.baking.many.run.load_scene", reading)
    with serving(by=answered) as server, warnings.catch_warnings(record=True) as seen:
        warnings.simplefilter("always")
        before = list(warnings.filters)
        llm = {"kind": "local", "model": "scripted", "base_url": f"{server.base_url}/v1"}
        bake_many(scenes[:1], tmp_path / "out", config={"llm": llm, "cache_dir": str(tmp_path / "cache")})
        assert warnings.filters == before
    said = [str(warning.message) for warning in seen]
    assert "of a model" in said
    assert "of the scene" not in said


def test_two_runs_on_one_folder_share_the_scenes(scenes: list[Path], tmp_path: Path) -> None:
    async def both(config: dict[str, object]) -> list[ManyReport]:
        return await asyncio.gather(*(abake_many(scenes, tmp_path / "out", config=config) for _ in range(2)))

    with serving(by=answered) as server:
        llm = {"kind": "openai", "api_key": KEY, "base_url": f"{server.base_url}/v1"}
        reports = asyncio.run(both({"llm": llm, "cache_dir": str(tmp_path / "cache")}))
    assert [one.error for report in reports for one in report.failed] == []
    assert sum(report.count("baked") for report in reports) == N_SCENES
    assert sum(report.count("kept") for report in reports) == N_SCENES


class Broken:
    """A plugin executor that raises its own errors."""

    def submit(self, fn: Any, /, *args: Any) -> Future[Any]:
        found: Future[Any] = Future()
        found.set_exception(RuntimeError("the worker is gone"))
        return found


def test_dead_worker_fails_only_its_scene(scenes: list[Path], tmp_path: Path) -> None:
    report = bake_many(scenes[:1], tmp_path, executor=Broken())
    assert "the worker is gone" in report.scenes[0].error
    assert bake_many(scenes[:1], tmp_path).count("baked") == 1


def test_a_folder_that_cannot_be_made_is_refused_before_a_model_is_asked(scenes: list[Path], tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    held = Held()
    with pytest.raises(ConfigError, match="file cannot be written"):
        bake_many(scenes[:1], tmp_path / "file", config={"llm": CacheBackend(held, tmp_path / "answers")})
    assert not held.calls


def test_invalid_requests_get_an_error_message(
    scenes: list[Path], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for given, told in (
        (([], "out"), "scenes is empty"),
        ((str(scenes[0]), "out"), "give a list of paths"),
        (([scenes[0], scenes[0]], tmp_path), "twice; give each scene once"),
    ):
        with pytest.raises(ConfigError, match=told):
            bake_many(*given)
    for executor, told in (("threads", "'processes', 'processes:N'"), ("processes:0", "from 1 to 256"), (3, "submit")):
        with pytest.raises(ConfigError, match=told):
            bake_many(scenes, tmp_path, executor=executor)
    assert main(["bake-many", str(tmp_path / "*.glb"), "-o", str(tmp_path / "out")]) == 1
    assert "no file matches" in capsys.readouterr().err


def test_command_bakes_all_files_that_match_a_pattern(scenes: list[Path], alone: Path, tmp_path: Path) -> None:
    pattern = str(scenes[0].parent / "room_[01].json")
    assert main(["bake-many", pattern, "-o", str(tmp_path), "-q"]) == 0
    assert set(digests(tmp_path)) == {name for name in digests(alone) if name.startswith(("room_0", "room_1"))}


def test_files_beside_a_scene_count(tmp_path: Path) -> None:
    scene = tmp_path / "a.gltf"
    scene.write_text("{}")
    before = scene_digest(scene)
    (tmp_path / "a.bin").write_bytes(b"1")
    assert scene_digest(scene) != before


@pytest.mark.parametrize("output", ["out", "."])
def test_bundles_in_the_folder_of_a_scene_do_not_count(tmp_path: Path, output: str) -> None:
    scene = tmp_path / "radio.obj"
    trimesh.creation.box((0.3, 0.2, 0.15)).export(scene)
    assert bake_many([scene], tmp_path / output).count("baked") == 1
    bundle = tmp_path / output / "radio.bundle"
    assert main(["edit", str(bundle), "gain", "radio", "-3", "-q"]) == 0  # which keeps a step beside the bundle
    assert bake_many([scene], tmp_path / output).count("kept") == 1


def test_equal_file_names_get_separate_bundles(scenes: list[Path], tmp_path: Path) -> None:
    others = write_scenes(tmp_path / "b", 1)
    report = bake_many([scenes[0], others[0]], tmp_path / "out")
    assert len({one.bundle for one in report.scenes}) == 2
    assert report.count("baked") == 2


def test_a_scene_of_an_equal_name_does_not_replace_the_bundle_of_an_earlier_run(tmp_path: Path) -> None:
    (first,), (other,) = (write_scenes(tmp_path / folder, 1) for folder in ("a", "b"))
    other.write_text(other.read_text().replace("radio", "loudspeaker"))
    assert bake_many([first], tmp_path / "out").count("baked") == 1
    before = digests(tmp_path / "out")
    (failed,) = bake_many([other], tmp_path / "out").failed
    assert f"room_0.bundle is the bundle of {first}. Bake both scenes in one run" in failed.error
    assert digests(tmp_path / "out") == before
    assert bake_many([first, other], tmp_path / "out").count("baked") == 2
    copied = tmp_path / "copied"
    shutil.copytree(tmp_path / "a", copied / "a")
    shutil.copytree(tmp_path / "out", copied / "out")
    assert bake_many([copied / "a" / first.name], copied / "out").count("kept") == 1


def test_the_command_line_shares_answers_of_scenes_only_on_request() -> None:
    parser = argparse.ArgumentParser()
    bake_many_command.add_arguments(parser)
    given = ["a.glb", "-o", "out"]
    shared, alone = (
        bake_many_command.many_settings(parser.parse_args([*given, *more])) for more in (["--share-scenes"], [])
    )
    assert shared == {**alone, "share_scenes": True}


def test_a_file_that_several_patterns_match_is_baked_once(tmp_path: Path) -> None:
    one, other = tmp_path / "a.glb", tmp_path / "some" / "more" / "b.glb"
    other.parent.mkdir(parents=True)
    for path in (one, other):
        path.touch()
    assert bake_many_command.files([str(one), f"{tmp_path}/*.glb", f"{tmp_path}/**/*.glb"]) == [str(one), str(other)]
