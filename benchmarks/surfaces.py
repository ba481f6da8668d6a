"""Measured and true dominant surfaces, as a table in Markdown; docs/figures/surfaces.md holds the latest.

python benchmarks/figures.py surfaces

The true values (tests/data/dominant_surfaces.csv) were read by hand: heights of flat faces and extents in a viewer, or
the numbers in the script that builds the demo kitchen.
"""

from __future__ import annotations

import argparse
import csv
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from statistics import median

from scene2hap import SceneSnapshot, load_scene
from scene2hap.demo import kitchen_path

ROOT = Path(__file__).parents[1]
SCENES = ROOT.parent / "shared" / "scenes"
EDGES = ("length_m", "width_m", "thickness_m")
# Files in centimetres.
UNIT_M = {"sketchfab_kitchen/scene.gltf": 0.01}

# Files of a pack are measured in the pack's unit, since relative errors do not depend on the unit.
SAMPLED = ROOT / "tests" / "data" / "sampled_surfaces.csv"
WITHIN = 0.2


@cache
def scene(name: str) -> SceneSnapshot:
    return load_scene(kitchen_path() if name == "demo" else SCENES / name, unit_m=UNIT_M.get(name, 1.0))


def rows() -> Iterator[tuple[dict[str, str], tuple[float, ...], tuple[float, ...]]]:
    """Yield each line of the table of true values with true and measured edges; absent scenes are left out."""
    with (ROOT / "tests" / "data" / "dominant_surfaces.csv").open(encoding="utf-8") as file:
        for line in csv.DictReader(file):
            if line["scene"] == "demo" or (SCENES / line["scene"]).is_file():
                true = tuple(float(line[edge]) for edge in EDGES)
                yield line, true, scene(line["scene"]).object(line["object"]).size_m


def relative_errors(true: tuple[float, ...], measured: tuple[float, ...]) -> list[float]:
    """Relative error of each edge; infinite if the true edge is 0 and the measured one is not."""
    return [abs(m - t) / t if t else (0.0 if m == 0 else float("inf")) for t, m in zip(true, measured, strict=True)]


def sampled() -> Iterator[tuple[dict[str, str], tuple[float, ...], tuple[float, ...]]]:
    """Yield the same as `rows` for the sample, whose true sizes were noted before anything was measured."""
    with SAMPLED.open(encoding="utf-8") as file:
        for line in csv.DictReader(file):
            if (SCENES / line["file"]).is_file():
                (only,) = load_scene(SCENES / line["file"], unit_m=1.0).objects
                length, width = sorted((float(line["length"]), float(line["width"])), reverse=True)
                yield line, (length, width, float(line["thickness"])), only.size_m


def main() -> None:
    argparse.ArgumentParser(description=__doc__.splitlines()[0]).parse_args()
    print("| scene | object | true [m] | measured [m] | largest error | how the truth was read |")
    print("|---|---|---|---|---|---|")
    errors: list[float] = []
    for line, true, measured in rows():
        own = relative_errors(true, measured)
        errors += own
        shown = [" × ".join(f"{edge:.4g}" for edge in edges) for edges in (true, measured)]
        where = line["scene"].partition("/")[0]
        print(f"| {where} | {line['object']} | {shown[0]} | {shown[1]} | {100 * max(own):.1f} % | {line['how']} |")
    print(
        f"\n{len(errors) // 3} objects: median error {100 * median(errors):.3f} %, largest {100 * max(errors):.1f} %."
    )
    lines = [(line, max(relative_errors(true, measured))) for line, true, measured in sampled()]
    if lines:
        clear = [error for line, error in lines if not line["doubtful"]]
        right, right_clear = (sum(error <= WITHIN for error in some) for some in ([e for _, e in lines], clear))
        missed = ", ".join(Path(line["file"]).stem for line, error in lines if error > WITHIN)
        print(
            f"\n{SAMPLED.name}: a sample of two packs, judged by hand before it was measured (21 of 42 were right "
            "then; the rule of lying plates came of it). "
            f"{right} of {len(lines)} objects are within {100 * WITHIN:.0f} % on all three edges, {right_clear} of the "
            f"{len(clear)} whose plate is beyond doubt. Beyond: {missed}."
        )


if __name__ == "__main__":
    main()
