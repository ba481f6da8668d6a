"""Found contacts compared with contacts listed by hand, as a table in Markdown.

python benchmarks/contacts.py [folder of scenes]

`benchmarks/contacts/` holds the lists and the rule for a true pair. Thresholds were tuned on the scenes marked "tuned".
"""

from __future__ import annotations

import argparse
import csv
import warnings
from collections import defaultdict
from pathlib import Path

from scene2hap import load_scene
from scene2hap.contact.graph import ContactGraph
from scene2hap.scene.grouping.groups import Grouping

LISTS = Path(__file__).parent / "contacts"
SCENES = Path(__file__).parents[2] / "shared" / "scenes"
# File below the folder of scenes; its unit [m] if the file declares a wrong one; and the use of the scene: "tuned" on,
# "reported", or "kept" only for regressions.
TABLE = {
    "aws_house_living": ("aws_house_living.glb", None, "tuned"),
    "composed_kitchen_kaykit": ("composed_kitchen_kaykit.glb", None, "tuned"),
    "aws_house_bedroom": ("aws_house_bedroom.glb", None, "reported"),
    "composed_bathroom_kenney": ("composed_bathroom_kenney.glb", None, "reported"),
    "sketchfab_kitchen": ("scene.gltf", 0.01, "reported"),
    "messy_japanese_room": ("room.glb", 0.1, "kept"),
}


# Files of parts (doors, drawers, knobs, covers), in the scales of their packs; every node is an object.
PARTS = "fitted_parts.csv"
PARTS_UNIT_M = {"lib_kenney_furniture": 1.8, "lib_kaykit_restaurant": 0.5, "furniture_sim": 1 / 1.8}

Pairs = set[tuple[str, str]]


def judged(name: str, scenes: Path) -> tuple[Pairs, Pairs, Pairs]:
    """True pairs, found pairs that count, and found pairs that the list marks "either"."""
    file, unit_m, _ = TABLE[name]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        graph = ContactGraph(load_scene(scenes / name / file, unit_m=unit_m))
    with (LISTS / f"{name}.csv").open(encoding="utf-8", newline="") as lines:
        rows = list(csv.DictReader(lines))
    true = {(row["a"], row["b"]) for row in rows if row["truth"] == "true"}
    either = {(row["a"], row["b"]) for row in rows if row["truth"] == "either"}
    return true, set(graph.junctions) - either, set(graph.junctions) & either


def parts(scenes: Path) -> None:
    """Print precision and recall for the parts of single pieces of furniture, all files together."""
    listed: dict[str, dict[str, Pairs]] = defaultdict(lambda: {"true": set(), "either": set()})
    with (LISTS / PARTS).open(encoding="utf-8", newline="") as lines:
        for row in csv.DictReader(lines):
            listed[row["file"]][row["truth"]].add((row["a"], row["b"]))
    true: set[tuple[str, str, str]] = set()
    found: set[tuple[str, str, str]] = set()
    for file, truths in listed.items():
        unit_m = PARTS_UNIT_M[file.partition("/")[0]]
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            group: Grouping = "authored" if file.endswith(".xml") else "leaf"
            graph = ContactGraph(load_scene(scenes / file, unit_m=unit_m, group=group, assets_root=scenes))
        true |= {(file, a, b) for a, b in truths["true"]}
        found |= {(file, a, b) for a, b in set(graph.junctions) - truths["either"]}
    right = true & found
    wrong, missing = (
        "; ".join(f"{file}: {a}–{b}" for file, a, b in sorted(some)) for some in (found - true, true - found)
    )
    print(
        f"\nFitted parts, {len(listed)} files: {len(true)} true pairs, {len(found)} found, "
        f"precision {len(right) / len(found):.3f}, recall {len(right) / len(true):.3f}.\n"
        f"Wrong: {wrong}.\nMissing: {missing}."
    )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("scenes", nargs="?", type=Path, default=SCENES, help="folder of scenes")
    scenes = parser.parse_args().scenes
    print("| scene | use | true pairs | found | marked either | precision | recall | wrong | missing |")
    print("|---|---|---|---|---|---|---|---|---|")
    n_true = n_found = n_right = 0
    for name, (_, _, use) in TABLE.items():
        true, found, either = judged(name, scenes)
        right = true & found
        if use == "reported":
            n_true, n_found, n_right = n_true + len(true), n_found + len(found), n_right + len(right)
        wrong, missing = (", ".join(map("–".join, sorted(pairs))) for pairs in (found - true, true - found))
        print(
            f"| {name} | {use} | {len(true)} | {len(found) + len(either)} | {len(either)} | "
            f"{len(right) / max(len(found), 1):.3f} | "
            f"{len(right) / len(true):.3f} | {wrong} | {missing} |"
        )
    print(f"\nReported, together: precision {n_right / n_found:.3f}, recall {n_right / n_true:.3f}.")
    if (scenes / "lib_kenney_furniture").is_dir():
        parts(scenes)


if __name__ == "__main__":
    main()
