"""Each fault, several times concurrently, through the standard LLM stack; `stress/inference_faults.py` does fifty.

Each request ends in a valid answer or in an error of the library. A received answer is never requested again. The key
is in no error, traceback, log, warning, cache file or recording.
"""

import asyncio
from dataclasses import replace
from pathlib import Path

import pytest

from llm_campaign import BACKENDS, Outcome, run
from llm_faults import FAULTS, Fault

N = 5
REPAIRS = 2
LASTING = ("connection dropped", "429 with Retry-After", "429 quota", "truncated JSON", "missing fields", "zeros")
ELSEWHERE = ("truncated JSON", "modulus in pascal")


async def short(wait_s: float) -> None:
    await asyncio.sleep(wait_s / 100)


def assert_kept_its_promises(outcome: Outcome) -> None:
    assert outcome.foreign == []
    assert sum(outcome.ends.values()) == outcome.requests
    assert outcome.asked_again == 0
    assert outcome.leaks == []


def calls_for_good(fault: Fault, retries: int) -> int:
    if fault.calls == 1:
        return 1
    return 1 + (REPAIRS if fault.breaks_for_good == "UnusableAnswer" else retries)


@pytest.mark.parametrize("name", FAULTS)
def test_recovering_server_is_retried_successfully(
    name: str, tmp_path: Path, tmp_path_factory: pytest.TempPathFactory
) -> None:
    fault = FAULTS[name]
    outcome = run(fault, "openai", tmp_path, n=N, sleep=short)
    if fault.timeout_s < 1.0 and outcome.calls != [fault.calls] * N:
        # On a busy machine the good answers may exceed the short timeout too.
        outcome = run(replace(fault, timeout_s=10.0), "openai", tmp_path_factory.mktemp("again"), n=N, sleep=short)
    assert_kept_its_promises(outcome)
    assert outcome.ends == {fault.ends: N}
    assert outcome.calls == [fault.calls] * N


@pytest.mark.parametrize("name", LASTING)
def test_permanently_failing_server_ends_with_an_error(name: str, tmp_path: Path) -> None:
    fault = FAULTS[name]
    outcome = run(fault, "openai", tmp_path, n=2, for_good=True, retries=1, sleep=short)
    assert_kept_its_promises(outcome)
    assert outcome.ends == {fault.breaks_for_good: 2}
    assert outcome.calls == [calls_for_good(fault, 1)] * 2


@pytest.mark.parametrize("kind", sorted(set(BACKENDS) - {"openai"}))
@pytest.mark.parametrize("name", ELSEWHERE)
def test_faults_of_local_servers_end_as_expected(name: str, kind: str, tmp_path: Path) -> None:
    fault = FAULTS[name]
    outcome = run(fault, kind, tmp_path, n=N, sleep=short)
    assert_kept_its_promises(outcome)
    assert outcome.ends == {fault.ends: N}
