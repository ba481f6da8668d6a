"""Kill a bake at random times and resume it: no answered request is sent again, and the bundle is the same.

    python stress/resume.py [--kills 20] [--latency 0.15]

Each round bakes a scene of 44 objects against a loopback server with an empty cache. The process is killed (SIGKILL) a
random time after a random number of answers; then the scene is baked again to the end. A request counts as answered
once the server has sent its answer. Answers sent less than `GRACE_S` before the kill are excepted, since the process
may not have read or written them yet. The bundle is compared byte by byte with that of an undisturbed bake.
"""

from __future__ import annotations

import argparse
import filecmp
import hashlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "benchmarks"))

from loopback import Answered, answering, kitchen

GRACE_S = 0.25


def main() -> int:
    """Run the campaign. Returns 1 if any round failed."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--kills", type=int, default=20)
    parser.add_argument("--latency", type=float, default=0.15, help="time that the server takes per call [s]")
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    rng = random.Random(arguments.seed)
    with tempfile.TemporaryDirectory() as temporary, answering(arguments.latency) as server:
        work = Path(temporary)
        (work / "kitchen.json").write_text(kitchen().to_json(), encoding="utf-8")
        started = time.monotonic()
        assert baking(work, "whole", server.url).wait() == 0
        whole_s, n_calls_whole = time.monotonic() - started, len(server.answered)
        print(f"undisturbed: {n_calls_whole} calls, {whole_s:.1f} s")
        print(f"{'killed after':>12} {'answered':>9} {'in flight':>10} {'sent again':>12} {'wrongly':>8}  bundle")
        failures = 0
        for round_number in range(arguments.kills):
            server.answered.clear()
            name = f"round{round_number}"
            n_answered, then_s = rng.randrange(n_calls_whole + 1), rng.uniform(0.0, 2 * arguments.latency)
            process = baking(work, name, server.url)
            while len(server.answered) < n_answered and process.poll() is None:
                time.sleep(0.001)
            time.sleep(then_s)
            process.send_signal(signal.SIGKILL)
            killed = time.monotonic()
            process.wait()
            time.sleep(2 * arguments.latency)  # the server writes into closed connections
            before = list(server.answered)
            assert baking(work, name, server.url).wait() == 0
            after = server.answered[len(before) :]
            wrong, again, in_flight = repeated(before, after, killed)
            same = equal(work / "whole", work / name)
            failures += bool(wrong) or not same
            print(
                f"{n_answered:>12} {len(before) - in_flight:>9} {in_flight:>10} {again:>12} {wrong:>8}  "
                f"{'same' if same else 'DIFFERS'}",
                flush=True,
            )
            shutil.rmtree(work / f"{name}.cache")
    print(f"{arguments.kills} kills, {failures} failures")
    return 1 if failures else 0


def baking(work: Path, name: str, url: str) -> subprocess.Popen[bytes]:
    """Start a bake in its own process."""
    command = [sys.executable, "-m", "scene2hap", "bake", "-q", work / "kitchen.json", "-o", work / name]
    command += ["--llm", "openai", "--base-url", url, "--cache", work / f"{name}.cache", "--no-pictures"]
    return subprocess.Popen(
        [str(word) for word in command],
        env={"PATH": "", "OPENAI_API_KEY": "sk-loopback-0123456789abcdef", "HOME": str(work)},
    )


def repeated(before: list[Answered], after: list[Answered], killed: float) -> tuple[int, int, int]:
    """Numbers of answered requests sent again, of requests in flight sent again, and of requests in flight."""
    settled = {digest(one) for one in before if one.sent < killed - GRACE_S}
    flying = {digest(one) for one in before} - settled
    again = {digest(one) for one in after}
    return len(settled & again), len(flying & again), len(flying)


def digest(one: Answered) -> str:
    """Digest of a request."""
    return hashlib.sha256(one.question).hexdigest()


def equal(a: Path, b: Path) -> bool:
    """Whether two folders hold the same files with the same bytes."""
    names = sorted(str(path.relative_to(a)) for path in a.rglob("*") if path.is_file())
    if names != sorted(str(path.relative_to(b)) for path in b.rglob("*") if path.is_file()):
        return False
    return filecmp.cmpfiles(a, b, names, shallow=False)[0] == names


if __name__ == "__main__":
    sys.exit(main())
