"""Kill workers and the parent process of a run over many scenes, and compare with an undisturbed run.

python stress/bake_many.py [--scenes 200] [--kills 3] [--seed 0]

Scenes are the variations of `benchmarks/bake_many.py`. The lexicon replaces a remote model and writes each answered
request to a file, as a request that was paid for. In the disturbed run a worker is killed every few seconds. The parent
with all its workers is killed `--kills` times; each time the same command is run again. At the end the bundles must be
equal byte for byte, and no request may be in the file twice.
"""

from __future__ import annotations

import argparse
import os
import random
import signal
import subprocess
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).parents[1] / "benchmarks"))
sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "support"))

from bake_many import digest, write_variations

from scene2hap import bake_many
from scene2hap.llm.lexicon import LexiconBackend
from scene2hap.llm.protocol import LLMReply, LLMRequest
from scene2hap.llm.request_key import request_key
from scene2hap.llm.wrappers import CacheBackend, RepairBackend


class Paid:
    """The lexicon as a remote model. Logs each answered request before it returns the answer."""

    def __init__(self, log: Path) -> None:
        self._log = log
        self._inner = LexiconBackend()

    @property
    def identity(self) -> dict[str, Any]:
        return {"model": "lexicon", "base_url": "https://nowhere.invalid"}

    async def complete(self, request: LLMRequest) -> LLMReply:
        reply = await self._inner.complete(request)
        with self._log.open("a") as file:
            file.write(f"{request_key(request)}\n")
            file.flush()
            os.fsync(file.fileno())
        return reply


def child(folder: Path, scenes: list[str]) -> None:
    backend = CacheBackend(RepairBackend(Paid(folder / "paid")), folder / "cache")
    report = bake_many(scenes, folder / "out", config={"llm": backend}, executor="processes:2")
    print(report, flush=True)
    sys.exit(1 if report.failed else 0)


def undisturbed(folder: Path, scenes: list[Path]) -> float:
    """Bake without interruption. Returns the time [s]."""
    begun = time.perf_counter()
    subprocess.run(_command(folder, scenes), check=True, stdout=subprocess.DEVNULL)
    return time.perf_counter() - begun


def disturbed(folder: Path, scenes: list[Path], whole_s: float, n_kills: int, seed: int) -> tuple[int, int]:
    """Bake while processes are killed. Returns the number of starts of the parent and of workers killed alone."""
    chance = random.Random(seed)
    runs = n_workers = 0
    while True:
        runs += 1
        until = time.monotonic() + chance.uniform(0.5, 1.0) * whole_s / (n_kills + 1)
        with subprocess.Popen(_command(folder, scenes), stdout=subprocess.DEVNULL, start_new_session=True) as run:
            while run.poll() is None:
                time.sleep(chance.uniform(2.0, 5.0))
                workers = _workers(run.pid)
                if runs <= n_kills and time.monotonic() > until:
                    os.killpg(run.pid, signal.SIGKILL)
                elif workers and chance.random() < 0.5:
                    n_workers += 1
                    os.kill(chance.choice(workers), signal.SIGKILL)
        if run.returncode == 0:
            return runs, n_workers
        if runs > n_kills:
            raise SystemExit(f"the run ended with status {run.returncode}")


def _command(folder: Path, scenes: list[Path]) -> list[str]:
    folder.mkdir(exist_ok=True)
    return [sys.executable, __file__, "--child", str(folder), *map(str, scenes)]


def _workers(parent: int) -> list[int]:
    found = []
    for one in Path("/proc").glob("[0-9]*"):
        try:
            is_worker = b"spawn_main" in (one / "cmdline").read_bytes()
            fields = (one / "stat").read_text().rpartition(")")[2].split()
        except OSError:
            continue
        if is_worker and int(fields[1]) == parent:
            found.append(int(one.name))
    return found


def main() -> None:
    if sys.argv[1:2] == ["--child"]:
        child(Path(sys.argv[2]), sys.argv[3:])
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scenes", type=int, default=200)
    parser.add_argument("--kills", type=int, default=3)
    parser.add_argument("--seed", type=int, default=0)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as place:
        (Path(place) / "scenes").mkdir()
        scenes = write_variations(Path(place) / "scenes", arguments.scenes, arguments.seed)
        calm, wild = Path(place) / "calm", Path(place) / "wild"
        whole_s = undisturbed(calm, scenes)
        runs, n_workers = disturbed(wild, scenes, whole_s, arguments.kills, arguments.seed)
        same = digest(calm / "out") == digest(wild / "out")
        paid = [Counter((folder / "paid").read_text().split()) for folder in (calm, wild)]
        twice = sum(n - 1 for n in paid[1].values())
    print(
        f"{arguments.scenes} scenes, seed {arguments.seed}: the parent was killed {runs - 1} times and {n_workers} "
        f"workers were killed alone. Bundles {'equal byte for byte' if same else 'DIFFER'}. "
        f"{sum(paid[0].values()):,} questions in the undisturbed run, {sum(paid[1].values()):,} in the other; "
        f"{twice} paid questions were sent again."
    )
    if not same or twice:
        raise SystemExit(1)


if __name__ == "__main__":
    main()
