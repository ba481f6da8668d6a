"""Time of ``import scene2hap`` beyond a bare interpreter: median of new processes.

python benchmarks/import_time.py [--runs 10]
"""

from __future__ import annotations

import argparse
import platform
import statistics
import subprocess
import sys
import time


def seconds(statement: str) -> float:
    begin = time.perf_counter()
    subprocess.run([sys.executable, "-c", statement], check=True)
    return time.perf_counter() - begin


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--runs", type=int, default=10)
    runs = parser.parse_args().runs
    print(f"Python {platform.python_version()}, {platform.machine()}, {runs} runs each, in turn")
    statements = ["pass", "import scene2hap", "from scene2hap import HapticSession"]
    for statement in statements:
        seconds(statement)  # warm the caches
    times: dict[str, list[float]] = {statement: [] for statement in statements}
    for _ in range(runs):
        for statement in statements:
            times[statement].append(seconds(statement))
    bare = statistics.median(times["pass"])
    for statement in statements:
        median = statistics.median(times[statement])
        print(f"{statement:40} median {1e3 * median:7.1f} ms   beyond bare {1e3 * (median - bare):7.1f} ms")


if __name__ == "__main__":
    main()
