"""Answers and replies of language models, recordings, caches, batches, and records of baked scenes."""

from __future__ import annotations

import asyncio
import contextlib
import json
from collections.abc import Callable, Coroutine
from functools import partial
from pathlib import Path
from typing import Any

from stress.hostile.reader import KEY, add


def _answers(folder: Path) -> Path:
    from llm_server import GOOD

    for name, answer in GOOD.items():
        (folder / f"{name}.json").write_text(json.dumps(answer))
    return folder


def _inferred(folder: Path) -> object:
    from scene2hap.llm.backends.function import FunctionBackend
    from scene2hap.llm.chain import infer_scene
    from scene2hap.llm.wrappers import RepairBackend
    from scenes import table_with_two_phones

    texts = {path.stem: path.read_bytes().decode("utf-8", "replace") for path in folder.iterdir() if path.is_file()}
    backend = RepairBackend(FunctionBackend(lambda request: texts.get(request.component, "")))
    scene = table_with_two_phones()[0]
    found = asyncio.run(infer_scene(scene, backend))
    json.dumps(found.report.as_json(), allow_nan=False)
    return found.objects, found.scene_category


add("answers", _answers, _inferred, names_file=False, opens_files=False)


def _completion(folder: Path) -> Path:
    from llm_server import ollama_said, refused, said

    models = {
        "object": "list",
        "data": [{"id": "m", "owned_by": "library", "architecture": {"input_modalities": ["image"]}}],
    }
    fault = refused(400, {"code": "x", "param": "temperature"}).body
    batch = {
        "id": "b1", "status": "completed", "input_file_id": "f", "output_file_id": "o",
        "errors": {"data": [fault["error"]]}, "request_counts": {"completed": 1, "failed": 0, "total": 1},
    }  # fmt: skip
    listed = {"object": "list", "data": [{**batch, "input_file_id": "g"}], "has_more": False}
    replies = {"chat": said().body, "ollama": ollama_said().body, "models": models, "fault": fault, "batch": batch}
    for name, one in {**replies, "batches": listed}.items():
        (folder / f"{name}.json").write_text(json.dumps(one))
    return folder


def _run(asked: Callable[..., Coroutine[Any, Any, object]], *arguments: object) -> object:
    return asyncio.run(asked(*arguments))


def _served(folder: Path) -> object:
    """Give the replies of a server to the parts that read them, each with status 200 and an error."""
    from scene2hap.common.web import WebReply
    from scene2hap.errors import Scene2HapError
    from scene2hap.llm.backends import chat, server_models
    from scene2hap.llm.backends.dialects import Decoding, OllamaChat
    from scene2hap.llm.batch.service import BatchService

    class Server:
        base_url, timeout_s = "http://server/v1", 1.0
        n_asked = 0

        def __init__(self, text: str, status: int) -> None:
            self.reply = WebReply("http://server/v1/x", status, text.encode(), {"retry-after": text[:50]})

        async def get(self, *_: object, **__: object) -> WebReply:
            self.n_asked += 1
            assert self.n_asked < 10_000, "the client asks without end"
            return self.reply

        post = upload = get

    found: list[object] = []
    for path in folder.iterdir():
        text = path.read_bytes().decode("utf-8", "replace")
        for status in (200, 400, 429, 500):
            server: Any = Server(text, status)
            service = BatchService(server, sleep=lambda _: asyncio.sleep(0))
            uses: tuple[Callable[[], object], ...] = (
                partial(chat.read_chat, server.reply, "m"),
                partial(OllamaChat(Decoding(100, 0, 100)).read, server.reply, "m"),
                partial(_run, server_models.openai_models, server),
                partial(_run, server_models.ollama_models, server),
                partial(_run, service.status, "b1"),
                partial(_run, service.begun_with, "f"),
                partial(_run, service.upload, "x", b""),
            )
            for use in uses:
                with contextlib.suppress(Scene2HapError):
                    found.append(use())
    return found


add("replies of servers", _completion, _served, names_file=False, opens_files=False)


def _recording(folder: Path) -> Path:
    from llm_server import GOOD, request
    from scene2hap.llm.backends.function import FunctionBackend
    from scene2hap.llm.backends.replay import RecordingBackend

    path = folder / "answers.jsonl"
    backend = RecordingBackend(FunctionBackend(lambda request: json.dumps(GOOD[request.component])), path)
    for name in GOOD:
        asyncio.run(backend.complete(request(name)))
    return path


def _replayed(path: Path) -> object:
    from llm_server import GOOD, request
    from scene2hap.llm.backends.replay import ReplayBackend

    backend = ReplayBackend(path)
    return [asyncio.run(backend.complete(request(name))) for name in GOOD]


add("recording", _recording, _replayed, names_file=False)


def _cached(folder: Path) -> Any:
    from llm_server import GOOD
    from scene2hap.llm.backends.function import FunctionBackend
    from scene2hap.llm.wrappers import CacheBackend

    return CacheBackend(FunctionBackend(lambda request: json.dumps(GOOD[request.component])), folder)


def _cache(folder: Path) -> Path:
    from llm_server import GOOD, request

    for name in GOOD:
        asyncio.run(_cached(folder).complete(request(name)))
    return folder


def _from_cache(folder: Path) -> object:
    from llm_server import GOOD, request

    backend = _cached(folder)
    return [asyncio.run(backend.complete(request(name))) for name in GOOD], backend.report()


add("cache of answers", _cache, _from_cache, "*.json")


def _batches(folder: Path) -> Path:
    from llm_server import GOOD, request, said
    from scene2hap.llm.batch.backend import BatchBackend
    from scene2hap.llm.batch.folder import BatchFolder
    from scene2hap.llm.wrappers.prices import price_list

    batches = BatchFolder(folder)
    backend = BatchBackend(_model(), batches, price_list(None))
    from scene2hap.errors import BackendUnavailable

    for name in ("scene_analyzer", "material_estimator"):
        with contextlib.suppress(BackendUnavailable):
            asyncio.run(backend.complete(request(name)))
    backend.close()
    (row,) = batches.rows()
    lines = []
    for key, answer in zip(row.requests, (GOOD["scene_analyzer"], GOOD["material_estimator"]), strict=True):
        body = said(answer).body
        lines.append(json.dumps({"custom_id": key, "response": {"status_code": 200, "body": body}, "error": None}))
    fault = json.dumps({"custom_id": row.requests[0], "response": None, "error": {"code": "x", "message": "y"}})
    batches.keep(row, "\n".join(lines) + "\n", fault + "\n")
    return folder


def _model() -> Any:
    from scene2hap.llm.backends.openai import OpenAIBackend

    return OpenAIBackend("gpt-4o", api_key=KEY)


def _resumed(folder: Path) -> object:
    from llm_server import request
    from scene2hap.errors import BackendError
    from scene2hap.llm.batch.backend import BatchBackend
    from scene2hap.llm.batch.folder import BatchFolder, keys_in
    from scene2hap.llm.wrappers.prices import price_list

    batches = BatchFolder(folder)
    batches.discard_unfinished()
    backend = BatchBackend(_model(), batches, price_list(None))
    found: list[object] = [backend.cost_usd, backend.n_answers]
    for name in ("scene_analyzer", "material_estimator"):
        try:
            found.append(asyncio.run(backend.complete(request(name))))
        except BackendError as problem:
            found.append(str(problem))
    backend.close()
    rows = batches.rows()
    found += [rows, sorted(keys_in(rows, "written", "collected"))]
    found += [batches.save(row) for row in rows]
    return found


add("batches", _batches, _resumed, "*.json", "*.json", "*.jsonl")


def _many(folder: Path) -> Path:
    from scene2hap.baking.many import bake_many
    from scenes import table_with_two_phones

    (folder / "room.json").write_text(table_with_two_phones()[0].to_json())
    bake_many([folder / "room.json"], folder / "out")
    return folder


def _many_again(folder: Path) -> object:
    from scene2hap.baking.many import bake_many

    return bake_many([folder / "room.json"], folder / "out").to_data()


add("bake-many", _many, _many_again, "out/.bake-many/**/*.json", "out/report.json", names_file=False, every=6)
