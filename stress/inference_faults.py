"""Every fault of a model server, in many concurrent requests, through the standard stack of backends.

python stress/inference_faults.py [--requests 50] [--backends openai local ollama] [--time-scale 0.1] [--only NAME ...]

A scripted server on the loopback interface shows each fault to fifty requests at a concurrency of eight: in one row
once per request, in another row always. Each request must end in a valid answer or in an error of scene2hap. A request
whose valid answer was received must never be sent again, neither within the run nor by a second run with the same
cache. The key must be in no error, traceback with its local variables, log at DEBUG, warning, cache file or recording.
Requests to OpenAI, and the replies of the scripted server, are checked against OpenAI's published schema. --time-scale
shortens the waits between retries, but not waits that the server requests. Prints a table and exits with 1 if any of
these rules is broken.
"""

from __future__ import annotations

import argparse
import asyncio
import logging
import platform
import sys
import tempfile
from collections.abc import Awaitable, Callable
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "support"))

from llm_campaign import BACKENDS, Outcome, run
from llm_faults import FAULTS, NOT_OF_OLLAMA, Fault


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--requests", type=int, default=50)
    parser.add_argument("--backends", nargs="+", choices=sorted(BACKENDS), default=sorted(BACKENDS))
    parser.add_argument("--time-scale", type=float, default=0.1)
    parser.add_argument("--only", nargs="+", choices=sorted(FAULTS), default=sorted(FAULTS))
    options = parser.parse_args()
    logging.getLogger("asyncio").setLevel(logging.INFO)
    print(f"Python {platform.python_version()}, {platform.machine()}; {options.requests} requests a row, 8 at once")
    print("| fault | backend | server | valid | errors | calls | sent again | key seen | s |")
    print("|---|---|---|---|---|---|---|---|---|")
    rows = [
        _row(name, FAULTS[name], kind, for_good, options.requests, _shortened(options.time_scale))
        for name in FAULTS
        if name in options.only
        for kind in options.backends
        if not (kind == "ollama" and name in NOT_OF_OLLAMA)
        for for_good in (False, True)
    ]
    broken = sum(not kept for _, kept in rows)
    total = sum(outcome.requests for outcome, _ in rows)
    print(f"\n{len(rows)} rows, {total} requests, {broken} rows with a broken promise")
    return 1 if broken else 0


def _row(
    name: str,
    fault: Fault,
    kind: str,
    for_good: bool,
    n: int,
    sleep: Callable[[float], Awaitable[object]],
) -> tuple[Outcome, bool]:
    with tempfile.TemporaryDirectory() as folder:
        outcome = run(fault, kind, Path(folder), n=n, for_good=for_good, sleep=sleep)
    expected = fault.breaks_for_good if for_good else fault.ends
    kept = outcome.ends == {expected: n} and not outcome.foreign and not outcome.asked_again and not outcome.leaks
    errors = {end: count for end, count in outcome.ends.items() if end != "valid"}
    cells = [
        name,
        kind,
        "always fails" if for_good else "recovers",
        outcome.ends["valid"],
        ", ".join(f"{count} {end}" for end, count in errors.items()) or "-",
        f"{min(outcome.calls)}..{max(outcome.calls)}",
        outcome.asked_again,
        len(outcome.leaks),
        f"{outcome.seconds:.1f}",
    ]
    broken = "" if kept else f" BROKEN: expected {expected} {outcome.foreign[:1]} {outcome.leaks[:1]}"
    print("| " + " | ".join(map(str, cells)) + f" |{broken}", flush=True)
    return outcome, kept


def _shortened(scale: float) -> Callable[[float], Awaitable[object]]:
    async def sleep(wait_s: float) -> None:
        await asyncio.sleep(wait_s * scale)

    return sleep


if __name__ == "__main__":
    sys.exit(main())
