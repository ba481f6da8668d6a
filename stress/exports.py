"""Random exports, read back and checked by a checker that is independent of the exporter.

python stress/exports.py [--draws 2000] [--seed 0]

Each draw is a random track in one format with random settings. The checker (`tests/support/haptic_file_checker.py`)
names every rule that a file breaks. `.haptic` and AHAP files are also read back. The clip, played by the published
rule, may differ from the signal by no more than the export reported, and writing the clip again must give the same
file.
"""

from __future__ import annotations

import argparse
import json
import sys
import tempfile
import time
from collections import Counter
from dataclasses import replace
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "support"))

from export_draws import CHECKED, problems, random_exporter, random_track
from scene2hap.clips.ahap import compose_ahap, read_ahap
from scene2hap.clips.haptic_clip import RANGE_HZ
from scene2hap.clips.haptic_format import compose_haptic, read_haptic
from scene2hap.export.fidelity import fidelity


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--draws", type=int, default=2000)
    parser.add_argument("--seed", type=int, default=0)
    arguments = parser.parse_args()
    begun = time.perf_counter()
    exports, broken, read_back = Counter[str](), Counter[str](), Counter[str]()
    with tempfile.TemporaryDirectory() as place:
        for draw in range(arguments.draws):
            rng = np.random.default_rng([arguments.seed, draw])
            kind = CHECKED[draw % len(CHECKED)]
            track = random_track(rng)
            exporter, settings = random_exporter(rng, kind)
            made = exporter.export(track)
            exports[kind] += 1
            for sentence in problems(kind, settings, dict(made.files)):
                broken[kind] += 1
                print(f"draw {draw}, {kind} {settings}: {sentence}")
            if kind in ("haptic", "ahap"):
                for name, content in made.files.items():
                    (Path(place) / name).write_bytes(content)
                for channel, played in made.played.items():
                    stem = f"track.{channel}" if channel else "track"
                    first = next(name for name in made.files if name.startswith(f"{stem}."))
                    path = Path(place) / first
                    range_hz = settings.get("range_hz", RANGE_HZ)
                    read = read_haptic if kind == "haptic" else read_ahap
                    clip = replace(read(path), range_hz=range_hz)
                    again = {"": compose_haptic(clip)} if kind == "haptic" else compose_ahap(clip)
                    same = all(
                        json.loads(made.files[_name(stem, ending, path)]) == _plain(one)
                        for ending, one in again.items()
                    )
                    reported = fidelity(track.channels[channel], played)
                    found = fidelity(track.channels[channel], clip)
                    if not same or found.p95_db > reported.p95_db + 0.01 or found.median_db > reported.median_db + 0.01:
                        broken[f"{kind} read back"] += 1
                        print(f"draw {draw}, {kind} {settings}: read back {found}, reported {reported}, same {same}")
                    read_back[kind] += 1
                for name in made.files:
                    (Path(place) / name).unlink()
    print(
        f"{sum(exports.values())} exports ({', '.join(f'{kind} {n}' for kind, n in exports.items())}), seed "
        f"{arguments.seed}: {sum(broken.values())} broken rules {dict(broken) or ''}; {sum(read_back.values())} clips "
        f"read back; {time.perf_counter() - begun:.0f} s"
    )


def _name(stem: str, ending: str, path: Path) -> str:
    return f"{stem}{ending}{path.suffix}"


def _plain(document: object) -> object:
    return json.loads(json.dumps(document))


if __name__ == "__main__":
    main()
