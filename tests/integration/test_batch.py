"""LLM requests in batches: in any order of events no answer is lost, and no answered request is sent again."""

from __future__ import annotations

import asyncio
import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from batch_server import BatchServer, Plan, answered, serving_batches
from llm_server import KEY, Asked, Scripted, refused, said
from rooms_of_things import digests, write_scenes
from scene2hap import bake_many
from scene2hap.baking.many import BatchReport, batch as batch_module, batch_status, collect_batch, submit_batch
from scene2hap.cli import main
from scene2hap.errors import BackendUnavailable, BudgetExceeded, CallError, ConfigError
from scene2hap.llm.batch import folder, service

pytestmark = pytest.mark.usefixtures("short_tones")


@pytest.fixture(autouse=True)
def _no_waits(no_proxies: None, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(service, "_WAITS_S", (0.0, 0.0))


@pytest.fixture
def server() -> Iterator[BatchServer]:
    with serving_batches() as found:
        yield found


@pytest.fixture
def scenes(tmp_path: Path) -> list[Path]:
    return write_scenes(tmp_path / "scenes", 3)


class Run:
    """Batch commands on the same scenes with the same settings."""

    def __init__(self, server: BatchServer, scenes: list[Path], tmp_path: Path, **settings: Any) -> None:
        self.server, self.scenes, self.folder = server, scenes, tmp_path / "out"
        llm = {"kind": "openai", "model": "gpt-5", "api_key": KEY, "base_url": f"{server.base_url}/v1"}
        self.config = {"llm": llm, "cache_dir": str(tmp_path / "cache"), **settings}

    def submit(self) -> BatchReport:
        return submit_batch(self.scenes, self.folder, config=self.config)

    def collect(self) -> BatchReport:
        return collect_batch(self.scenes, self.folder, config=self.config)

    def to_the_end(self, *plans: Plan) -> int:
        """Submit and collect until no request is left. Returns the number of rounds; those without a plan succeed."""
        for turn in range(12):
            if self.submit().n_under_way == 0:
                return turn
            self.server.end(plans[turn] if turn < len(plans) else None)
            self.collect()
        raise AssertionError("it never ends")


@pytest.fixture
def run(server: BatchServer, scenes: list[Path], tmp_path: Path) -> Run:
    return Run(server, scenes, tmp_path)


def nothing_was_asked_twice(server: BatchServer) -> None:
    assert server.answered
    assert max(server.answered.values()) == 1


def test_batch_gives_the_bundles_of_live_requests_without_repeats(
    run: Run, server: BatchServer, scenes: list[Path], tmp_path: Path
) -> None:
    """One batch each for the scene category, objects, materials and states, and repairs of invalid answers."""
    turns = run.to_the_end()
    assert 3 <= turns <= 7
    assert len(server.batches) == turns
    nothing_was_asked_twice(server)
    report = run.collect()
    assert (report.n_ready, report.n_to_send, report.n_under_way) == (3, 0, 0)
    assert report.n_answers == sum(server.answered.values())
    # The server answers as gpt-4o with 1000 tokens in and 20 out, at half of 2.5 and 10 dollars per million
    # (OpenAI's price list).
    usage = said().body["usage"]
    each = (usage["prompt_tokens"] * 2.5 + usage["completion_tokens"] * 10) / 2e6
    assert report.cost_usd == pytest.approx(report.n_answers * each)
    made = bake_many(scenes, run.folder, config=run.config)
    assert made.count("baked") == 3, [one.error for one in made.failed]
    assert not server.live
    fresh = {**run.config, "cache_dir": str(tmp_path / "fresh")}
    assert bake_many(scenes, tmp_path / "live", config=fresh).count("baked") == 3
    assert len(server.live) == report.n_answers
    assert digests(tmp_path / "live") == digests(run.folder)


def test_only_failed_requests_are_sent_again(run: Run, server: BatchServer) -> None:
    """Four batches: three partly expired, failed on the server or cancelled, and one refused as a whole."""
    broken = refused(500, {"message": "try later", "type": "server_error", "param": None, "code": None})
    plans = (
        Plan("expired", lambda place, body: "expired" if place % 3 else "answered"),
        Plan("completed", lambda place, body: broken if place % 3 == 1 else "answered"),
        Plan("cancelled", lambda place, body: "answered" if place % 3 == 0 else "cancelled"),
        Plan("failed", errors=("Enqueued token limit reached.",)),
    )
    run.to_the_end(*plans)
    nothing_was_asked_twice(server)
    assert run.collect().n_ready == 3
    assert max(server.sent.values()) > 1


def test_second_collect_changes_nothing(run: Run, server: BatchServer) -> None:
    run.submit()
    server.end()
    first = run.collect()
    assert sum("content" in line for line in server.log) == 1
    state = {path: path.read_bytes() for path in (run.folder / ".bake-many" / "batch").iterdir() if path.name != "lock"}
    again = run.collect()
    assert again == first
    assert sum("content" in line for line in server.log) == 1
    for path, content in state.items():
        assert path.read_bytes() == content


def test_pending_requests_are_not_sent_again(run: Run, server: BatchServer) -> None:
    assert run.submit().n_under_way == 3  # the scene category of each scene
    again = run.submit()
    assert (again.n_under_way, again.n_to_send) == (3, 0)
    assert run.collect().n_under_way == 3
    assert len(server.batches) == 1


def test_batch_is_found_again_after_a_lost_start_reply(run: Run, server: BatchServer) -> None:
    server.faults.append(("POST /v1/batches", "loses the answer"))
    with pytest.raises(BackendUnavailable):
        run.submit()
    assert len(server.batches) == 1
    report = run.submit()
    assert [row.stage for row in report.batches] == ["begun"]
    assert len(server.batches) == 1
    run.server.end()
    assert run.to_the_end() > 0
    nothing_was_asked_twice(server)


@pytest.mark.parametrize("path", ["POST /v1/files", "POST /v1/batches"])
def test_written_requests_are_sent_by_the_next_run(path: str, run: Run, server: BatchServer) -> None:
    server.faults += [(path, "refuses")] * 3
    with pytest.raises(BackendUnavailable):
        run.submit()
    assert not server.batches
    server.faults.clear()
    assert run.submit().n_under_way == 3
    assert set(server.sent.values()) == {1}


def test_a_lost_download_is_repeated(run: Run, server: BatchServer) -> None:
    run.submit()
    server.end()
    (batch,) = server.batches.values()
    server.faults.append((f"GET /v1/files/{batch.output_file}/content", "loses the answer"))
    assert run.collect().n_answers == 3


def test_refused_parameter_is_left_out_of_the_next_batch(run: Run, server: BatchServer) -> None:
    error = {"message": "no", "type": "invalid_request_error", "param": "temperature", "code": "unsupported_value"}
    wrong = refused(400, error)
    plan = Plan("completed", lambda place, body: wrong if "temperature" in body else "answered")
    run.to_the_end(*[plan] * 12)
    assert run.collect().n_ready == 3
    with_it = [key for key, body in server.bodies.items() if "temperature" in body]
    assert len(with_it) == 3  # only those of the first batch


def test_refused_request_becomes_an_error_and_others_continue(run: Run, server: BatchServer) -> None:
    filtered = refused(400, {"message": "no", "type": "invalid_request_error", "param": None, "code": "content_filter"})

    def each(place: int, body: dict[str, Any]) -> str | Scripted:
        is_fan = '"refrigerator"' in json.dumps(body).replace("\\", "").split("Authored object name:")[-1][:40]
        return filtered if is_fan else "answered"

    run.to_the_end(*[Plan("completed", each)] * 12)
    assert run.collect().n_ready == 3
    refused_ones = [key for key in server.sent if key not in server.answered]
    assert [server.sent[key] for key in refused_ones] == [1]


def test_cancelled_batch_keeps_received_answers(run: Run, server: BatchServer) -> None:
    run.submit()
    report = batch_status(run.folder, config=run.config, cancel=True)
    assert [row.status for row in report.batches] == ["cancelling"]
    server.end(Plan("cancelled", lambda place, body: "answered" if place == 0 else "cancelled"))
    assert run.collect().n_answers == 1
    run.to_the_end()
    nothing_was_asked_twice(server)


def test_status_queries_the_server_without_download(run: Run, server: BatchServer) -> None:
    run.submit()
    server.end()
    report = batch_status(run.folder, config=run.config)
    assert [(row.status, row.completed) for row in report.batches] == [("completed", 3)]
    assert not any("content" in line for line in server.log)


def test_advice_for_a_running_event_loop_works(run: Run, server: BatchServer) -> None:
    async def status() -> BatchReport:
        with pytest.raises(CallError, match=r"Write `await asyncio\.to_thread\(batch_status, \.\.\.\)`"):
            batch_status(run.folder, config=run.config)
        return await asyncio.to_thread(batch_status, run.folder, config=run.config)

    assert asyncio.run(status()).batches == ()


def test_cost_limit_is_checked_before_sending(server: BatchServer, scenes: list[Path], tmp_path: Path) -> None:
    run = Run(server, scenes, tmp_path, max_cost_usd=1e-6)
    with pytest.raises(BudgetExceeded, match="3 questions would bring the cost to about .* Nothing was sent"):
        run.submit()
    assert not server.batches
    run.config["max_cost_usd"] = 10.0
    assert run.submit().n_under_way == 3
    run.config["llm"]["model"] = "of tomorrow"
    with pytest.raises(BudgetExceeded, match="price of 'of tomorrow' is unknown"):
        run.submit()


def test_scenes_that_cannot_be_read_do_not_stop_the_others(run: Run, server: BatchServer, tmp_path: Path) -> None:
    broken = tmp_path / "broken.glb"
    broken.write_bytes(b"glTF" + bytes(40))
    run.scenes = [broken, *run.scenes]
    report = run.submit()
    assert report.n_under_way == 3
    assert list(report.errors) == [str(broken)]


def test_key_is_not_written_to_disk(run: Run, server: BatchServer) -> None:
    run.to_the_end()
    for path in run.folder.rglob("*"):
        if path.is_file():
            assert KEY.encode() not in path.read_bytes()


def test_large_batches_are_split(run: Run, server: BatchServer, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(folder, "_PART_REQUESTS", 2)
    report = run.submit()
    assert [len(row.requests) for row in report.batches] == [2, 1]
    assert len(server.batches) == 2


def test_invalid_requests_get_an_error_message(run: Run, scenes: list[Path], tmp_path: Path) -> None:
    with pytest.raises(ConfigError, match="batches need a model of kind 'openai'.*--llm openai:gpt-4o.*bake-many"):
        submit_batch(scenes, tmp_path / "out", config={"llm": "lexicon"})
    state = run.folder / ".bake-many" / "batch"
    state.mkdir(parents=True)
    (state / "0001.json").write_text("{")
    with pytest.raises(ConfigError, match=r"0001\.json cannot be read.*restore it"):
        run.submit()


def test_concurrent_runs_do_not_send_equal_requests(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    told: list[str] = []

    async def meanwhile(*_: object) -> None:
        with pytest.raises(ConfigError, match="another run is at work") as caught:
            async with batch_module._at_work(batch_module._Given(run.scenes, run.folder, run.config)):
                pass
        told.append(str(caught.value))

    monkeypatch.setattr(batch_module._Work, "send", meanwhile)
    run.submit()
    assert told


def test_the_command_leads_from_step_to_step(
    server: BatchServer, scenes: list[Path], tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: Any
) -> None:
    monkeypatch.setenv("OPENAI_API_KEY", KEY)
    same = [str(scenes[0]), "-o", str(tmp_path / "out"), "--llm", "openai:gpt-5", "--no-pictures"]
    same += ["--base-url", f"{server.base_url}/v1", "--cache", str(tmp_path / "cache")]
    assert main(["batch", "submit", *same]) == 0
    assert "batch collect` with the same arguments" in capsys.readouterr().out
    assert main(["batch", "status", *same[1:], "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["n_under_way"] == 1
    server.end()
    assert main(["batch", "collect", *same]) == 0
    assert "batch submit` with the same arguments" in capsys.readouterr().out
    for _ in range(8):
        assert main(["batch", "submit", *same, "-q"]) == 0
        server.end()
        assert main(["batch", "collect", *same]) == 0
        if "all questions are answered" in capsys.readouterr().out:
            break
    assert main(["bake-many", *same, "-q"]) == 0
    assert not server.live
    assert main(["batch", "collect", *same[1:]]) == 1
    assert "needs the scene files" in capsys.readouterr().err


def test_answer_with_unknown_id_is_ignored(run: Run, server: BatchServer) -> None:
    run.submit()
    server.end()
    (batch,) = server.batches.values()
    lines = server.files[batch.output_file].splitlines()
    stranger = json.dumps({**json.loads(lines[0]), "custom_id": "another"}).encode()
    server.files[batch.output_file] = b"\n".join([stranger, b"not json", b"[]", b"{}", *lines[1:], b'{"custom_id": 1}'])
    report = run.collect()
    # The lost request again; of both other rooms the radio, which is one request, and the object beside it.
    assert report.n_to_send == 1 + 3
    assert report.n_answers == 2


def test_cached_requests_are_not_sent(run: Run, server: BatchServer, tmp_path: Path) -> None:
    bake_many(run.scenes, tmp_path / "live", config=run.config)
    n_live = len(server.live)
    assert n_live
    report = run.submit()
    assert (report.n_ready, report.n_under_way) == (3, 0)
    assert not server.batches


def test_scripted_model_is_used() -> None:
    assert answered(Asked("", {}, {"response_format": {"keywords": 1}})).status == 200
