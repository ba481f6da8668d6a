"""Several concurrent runs with one cache folder."""

import json
import subprocess
import sys
import time
from pathlib import Path

from llm_server import KEY, Asked, Scripted, said
from openai_schema import openai_serving

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
