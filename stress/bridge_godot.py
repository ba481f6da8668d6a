"""Campaigns on the bridge with the real Godot 3, without a window; prints Markdown.

python stress/bridge_godot.py [play] [cost] [--seconds 60] [--rate 60] [--godot godot3-server]

play : the game of docs/bridge-protocol.md, 30 nodes, in real time, with the counters and latencies of the client.
    Between two frames it polls every 50 us, so that the latency is that of connection and server, not of a game's
    frames. All gains are compared with those of a session in this process.
cost : time of a frame on the game's thread, for 30 and 500 nodes, without a server.
Needs: apt-get install --no-install-recommends godot3-server
"""

from __future__ import annotations

import argparse
import json
import os
import platform
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from scene2hap.testing.bridge_client import check_bridge_client

EXAMPLE = Path(__file__).parents[1] / "clients" / "godot3" / "example"
CAMPAIGNS = ("play", "cost")


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("campaigns", nargs="*", metavar="CAMPAIGN", help="; ".join(CAMPAIGNS) + "; default all")
    parser.add_argument("--seconds", type=float, default=60.0)
    parser.add_argument("--rate", type=float, default=60.0, metavar="HZ", help="0: as fast as gains come")
    parser.add_argument("--godot", default="godot3-server", metavar="PROGRAM")
    chosen = parser.parse_args()
    if unknown := set(chosen.campaigns) - set(CAMPAIGNS):
        parser.error(f"no campaign {', '.join(sorted(unknown))}; choose from {', '.join(CAMPAIGNS)}")
    if shutil.which(chosen.godot) is None:
        sys.exit(f"no {chosen.godot}; on Debian: apt-get install --no-install-recommends godot3-server")
    version = subprocess.run([chosen.godot, "--version"], stdout=subprocess.PIPE, text=True, check=False).stdout.strip()
    print(f"Python {platform.python_version()}, Godot {version}, {os.cpu_count()} cores\n")
    for name in chosen.campaigns or CAMPAIGNS:
        if name == "play":
            play(chosen.godot, chosen.seconds, chosen.rate)
        else:
            cost(chosen.godot)
    return 0


def play(program: str, seconds: float, rate_hz: float) -> None:
    n_frames = round(seconds * (rate_hz or 60.0))
    with tempfile.TemporaryDirectory() as folder:
        report = Path(folder) / "report.json"
        load_before = os.getloadavg()[0]
        check = check_bridge_client(
            ["sh", "-c", 'exec "$0" "$@" > /dev/null', program, "--path", str(EXAMPLE)],  # its banner is not Markdown
            n_frames=n_frames,
            rate_hz=rate_hz,
            cuts=False,
            timeout_s=2 * seconds + 60,
            environment={"LC_ALL": "C.UTF-8", "SCENE2HAP_REPORT": str(report)},
        )
        load = f"{load_before:.1f} before, {os.getloadavg()[0]:.1f} after"
        found = json.loads(report.read_text(encoding="utf-8"))
    rows = {
        "frames sent": found["sent"],
        "gains received": found["gains"],
        "lost (no gains)": found["sent"] - found["gains"],
        "skipped by the server": found["skipped"],
        "replaced before they were sent": found["replaced"],
        "largest difference to a session in process": f"{check.worst:.1e}",
        "frame to gains, p50 / p99 / max [ms]": _joined(found, "latency", ("p50", "p99", "max"), 1e-3),
        "send_frame, p50 / p99 [us]": _joined(found, "send", ("p50", "p99"), 1.0),
        "load of the machine": load,
    }
    print(f"| {n_frames} frames at {rate_hz:g} Hz, 30 nodes | |\n|---|---|")
    for name, value in rows.items():
        print(f"| {name} | {value} |")
    print(flush=True)


def _joined(found: dict[str, float], name: str, parts: tuple[str, ...], factor: float) -> str:
    digits = 2 if factor < 1 else 0
    return " / ".join(f"{factor * found[f'{name}_{part}_usec']:.{digits}f}" for part in parts)


def cost(program: str) -> None:
    run = subprocess.run(
        [program, "--path", str(EXAMPLE), "--script", "res://measure.gd"],
        env={**os.environ, "LC_ALL": "C.UTF-8"},
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        text=True,
        check=True,
    )
    print("| nodes | of these move | one frame, median [us] |\n|---|---|---|")
    for line in run.stdout.splitlines():
        cells = line.split(", ")
        if len(cells) == 3 and cells[0].isdigit():
            print(f"| {' | '.join(cells)} |")
    print(f"\nLoad of the machine: {os.getloadavg()[0]:.1f}\n", flush=True)


if __name__ == "__main__":
    sys.exit(main())
