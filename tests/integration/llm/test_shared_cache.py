"""Several concurrent runs with one cache folder."""

import json
import subprocess
import sys
import time
from pathlib import Path

import pytest

from llm_server import KEY, Asked, Scripted, said
from openai_schema import openai_serving
from scene2hap import Box, FunctionBackend, LexiconBackend, SceneObject, SceneSnapshot, bake
from scene2hap.errors import BudgetExceeded
from scene2hap.llm.wrappers import standard_stack

RUNS = 2
PROGRAM = """
import asyncio, sys
sys.path.insert(0, sys.argv[3])
from llm_server import request
from scene2hap import OpenAIBackend
from scene2hap.llm.wrappers import standard_stack

stack = standard_stack(OpenAIBackend(api_key=sys.argv[4], base_url=sys.argv[1]), sys.argv[2])

async def ask():
    return await asyncio.gather(*(stack.complete(request(prompt=f"Question {i}.")) for i in range(6)))

print("\\n".join(reply.text for reply in asyncio.run(ask())))
"""


def test_concurrent_runs_pay_for_each_answer_once(tmp_path: Path) -> None:
    def slow(asked: Asked) -> Scripted:
        time.sleep(0.05)
        return said({"scene_category": asked.prompt[:-1]})

    tests = str(Path(__file__).parents[2] / "support")
    with openai_serving(by=slow) as server:
        command = [sys.executable, "-c", PROGRAM, f"{server.base_url}/v1", str(tmp_path / "cache"), tests, KEY]
        runs = [subprocess.Popen(command, stdout=subprocess.PIPE, text=True) for _ in range(RUNS)]
        answers = [run.communicate(timeout=120)[0].splitlines() for run in runs]
    assert [json.loads(answer) for answer in answers[0]] == [{"scene_category": f"Question {i}"} for i in range(6)]
    assert answers == [answers[0]] * RUNS
    assert len(server.asked) == 6
    assert {path.suffix for path in (tmp_path / "cache").iterdir() if path.is_file()} == {".json"}


def test_an_error_that_stops_a_bake_says_what_the_cache_keeps(tmp_path: Path) -> None:
    """In an earlier version nothing said that the paid answers are kept."""
    things = [SceneObject(name, geometry=Box((0.3, 0.5, 0.3))) for name in ("fan", "radio")]
    scene = SceneSnapshot.build(things, name="room")

    def stopped() -> str:
        lexicon = LexiconBackend()
        stack = standard_stack(FunctionBackend(lexicon.complete), tmp_path / "cache", max_calls=2)
        with pytest.raises(BudgetExceeded) as caught:
            bake(scene, {"llm": stack, "concurrency": 1})
        return " ".join(getattr(caught.value, "__notes__", ()))

    assert stopped() == "The cache keeps 2 answers so far; the same command continues from there."
    assert stopped() == "The cache keeps 4 answers so far; the same command continues from there."
