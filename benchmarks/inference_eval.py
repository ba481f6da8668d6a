"""Score an inference backend on hand-labelled objects and on the paper's ten materials.

    python benchmarks/inference_eval.py [--llm SPEC] [--scenes DIR] [--half tuning|held-out|both] [--pictures]
                                        [--parts scenes,memory,packs,materials] [--misses] [--json OUT]

SPEC is the `llm` of a settings file of `scene2hap bake`: the kind of a backend ("lexicon"), a JSON object
('{"kind": "openai", "model": "..."}'), or a TOML or JSON settings file with a table [bake]. DIR holds the labelled
scenes. Rules of labelling: docs/inference-evaluation.md; latest figures: docs/figures/inference.md.
"""

from __future__ import annotations

import argparse
import asyncio
import json
import os
import platform
import time
from collections import Counter
from dataclasses import asdict, dataclass
from importlib.metadata import version
from pathlib import Path
from typing import Any, cast

from inference.labels import NAME_LISTS, LabelledScene, labelled_scenes, listed_names
from inference.material_table import CONSTANTS, MaterialRow, material_table
from inference.reading import read
from inference.scoring import Counts, Judgement, judge, same_category

from scene2hap.common.settings import read_settings
from scene2hap.errors import Scene2HapError
from scene2hap.llm import BACKENDS
from scene2hap.llm.chain import infer_scene
from scene2hap.llm.protocol import LLMBackend, LLMReply, LLMRequest
from scene2hap.scene.capture import capture_images

SCENES = Path(__file__).parents[2] / "shared" / "scenes"
COLUMNS = (
    "vibrates_accuracy", "vibrates_precision", "vibrates_recall", "vibrates_accuracy_clear",
    "category_accuracy_known", "family_accuracy_claimed", "unknown_share",
)  # fmt: skip


class Counting:
    """A backend that counts the calls and tokens of another backend."""

    def __init__(self, backend: LLMBackend) -> None:
        self._backend = backend
        self.calls: Counter[str] = Counter()
        self.tokens: Counter[str] = Counter()

    async def complete(self, request: LLMRequest) -> LLMReply:
        """Forward the request, and count its call and tokens."""
        self.calls[request.component] += 1
        reply = await self._backend.complete(request)
        self.tokens.update(reply.usage)
        return reply


@dataclass(frozen=True)
class SceneResult:
    """Result of one scene: its judged objects, or the error that ended the inference."""

    scene: LabelledScene
    judgements: tuple[Judgement, ...]
    place: str
    seconds: float
    calls: dict[str, int]
    tokens: dict[str, int]
    error: str = ""

    @property
    def counts(self) -> Counts:
        """Sum over all objects; objects of a failed scene count as unknown and as not vibrating."""
        return sum((item.counts for item in self.judgements), Counts())


def backend_of(spec: str) -> LLMBackend:
    """Build a backend from SPEC. Raises: ConfigError."""
    if spec.lstrip().startswith("{"):
        return cast("LLMBackend", BACKENDS.build(json.loads(spec)))
    if spec.endswith((".toml", ".json")):
        return cast("LLMBackend", BACKENDS.build(read_settings(spec, "bake").get("llm", "lexicon")))
    return cast("LLMBackend", BACKENDS.build(spec))


async def score(backend: LLMBackend, item: LabelledScene, folder: Path, *, pictures: bool = False) -> SceneResult:
    """Infer one scene and compare every object with its label."""
    scene = read(item, folder)
    if pictures:
        scene = capture_images(scene)
    counting, begin = Counting(backend), time.perf_counter()
    try:
        found = await infer_scene(scene, counting)
    except Scene2HapError as problem:
        judged = tuple(Judgement(label, "unknown", "unknown", False) for label in item.labels.values())
        place, error = "", f"{type(problem).__name__}: {problem}"
    else:
        judged = tuple(judge(label, found.objects[key]) for key, label in item.labels.items())
        place, error = found.scene_category, ""
    seconds = time.perf_counter() - begin
    return SceneResult(item, judged, place, seconds, dict(counting.calls), dict(counting.tokens), error)


def table(title: str, results: list[SceneResult]) -> str:
    """Table in Markdown: one row per scene and one for all."""
    heads = (
        "scene", "objects", "vibrates", "precision", "recall", "vibrates, clear", "category", "family", "unknown",
        "place", "s", "calls",
    )  # fmt: skip
    lines = [f"\n## {title}\n", f"| {' | '.join(heads)} |", "|---" * len(heads) + "|"]
    for item in results:
        right = "" if not item.scene.places else f" ({'ok' if same_category(item.place, item.scene.places) else 'no'})"
        tail = (f"{item.place}{right}", f"{item.seconds:.2f}", str(sum(item.calls.values())))
        lines.append(_line(item.scene.scene, item.counts, tail))
        if item.error:
            lines.append(f"| {item.scene.scene} FAILED: {item.error} |" + " |" * (len(heads) - 1))
    calls = sum(sum(item.calls.values()) for item in results)
    pooled = pool(results)
    lines.append(_line("**all**", pooled, ("", f"{sum(item.seconds for item in results):.2f}", str(calls))))
    named = [item for item in results if item.scene.meaningful]
    lines.append(_line("with meaningful names", pool(named), ("", "", "")))
    return "\n".join(lines)


def pool(results: list[SceneResult]) -> Counts:
    """Sum of the counts of all scenes, in which each object counts the same."""
    return sum((item.counts for item in results), Counts())


def _line(name: str, counts: Counts, tail: tuple[str, ...]) -> str:
    shares = [counts.figures[column] for column in COLUMNS]
    cells = ["-" if share is None else f"{100 * share:.1f} %" for share in shares]
    return "| " + " | ".join([name, str(counts.objects), *cells, *tail]) + " |"


def misses(results: list[SceneResult]) -> str:
    """List every object whose answer disagrees with its label."""
    lines = []
    for item in results:
        for judged in item.judgements:
            if judged.misses:
                wanted = f"{judged.label.categories[0]}, {'/'.join(judged.label.families)}, {judged.label.vibrates}"
                says = f"{judged.category}, {judged.material}, {judged.vibrates}"
                lines.append(f"{item.scene.scene}: {judged.label.name}: {'+'.join(judged.misses)}: {says} | {wanted}")
    return "\n".join(lines)


def show_materials(rows: list[MaterialRow]) -> str:
    """Table of the ten materials in Markdown, and the number of constants in their range."""
    lines = [
        "\n## The paper's ten materials\n",
        "| material | density kg/m3 | E GPa | nu | range | in range | GPT-4o |",
    ]
    lines.append("|---" * 7 + "|")
    for row in rows:
        values = ["-"] * 3 if row.answer is None else [f"{value:g}" for value in row.answer]
        ranges = "; ".join(f"{low:g}-{high:g}" for low, high in row.ranges)
        cells = [row.material, *values, ranges, f"{sum(row.inside)}/3", f"{sum(row.gpt4o_inside)}/3"]
        lines.append("| " + " | ".join(cells) + " |")
    total, theirs = sum(sum(row.inside) for row in rows), sum(sum(row.gpt4o_inside) for row in rows)
    lines.append(f"\n{total} of {3 * len(rows)} constants in the range; GPT-4o in the paper: {theirs}.")
    return "\n".join(lines)


async def run(options: argparse.Namespace) -> dict[str, Any]:
    """Run and print all requested parts. Returns them as JSON data."""
    backend, parts = backend_of(options.llm), options.parts.split(",")
    print(
        f"scene2hap {version('scene2hap')}, Python {platform.python_version()}, {platform.machine()}, llm {options.llm}"
    )
    report: dict[str, Any] = {"llm": options.llm, "halves": {}}
    wanted = [item for item in labelled_scenes() if "scenes" in parts and options.half in (item.half, "both")]
    for names in NAME_LISTS:
        wanted += listed_names(names) if names in parts else []
    for half in dict.fromkeys(item.half for item in wanted):
        of_half = [item for item in wanted if item.half == half]
        results = [await score(backend, item, options.scenes, pictures=options.pictures) for item in of_half]
        print(table(f"names from {half}" if half in NAME_LISTS else half, results))
        if options.misses:
            print("\n" + misses(results))
        report["halves"][half] = _as_json(results)
    if "materials" in parts:
        rows = await material_table(backend)
        print(show_materials(rows))
        report["materials"] = [
            {"material": row.material, "answer": row.answer, "inside": dict(zip(CONSTANTS, row.inside, strict=True))}
            for row in rows
        ]
    return report


def _as_json(results: list[SceneResult]) -> dict[str, Any]:
    named = [item for item in results if item.scene.meaningful]
    scenes = {
        item.scene.scene: {
            **item.counts.figures, "counts": asdict(item.counts), "place": item.place, "seconds": item.seconds,
            "calls": item.calls, "tokens": item.tokens, "error": item.error,
        }
        for item in results
    }  # fmt: skip
    return {"scenes": scenes, "all": pool(results).figures, "meaningful": pool(named).figures}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--llm", default="lexicon", metavar="SPEC")
    parser.add_argument("--scenes", type=Path, default=SCENES, metavar="DIR")
    parser.add_argument("--half", choices=("tuning", "held-out", "both"), default="both")
    parser.add_argument(
        "--parts", default="scenes,memory,packs,materials", help="which parts to run, with commas between"
    )
    parser.add_argument("--pictures", action="store_true", help="show the backend pictures (extra `pictures`)")
    parser.add_argument("--misses", action="store_true", help="list every object that disagrees with its label")
    parser.add_argument("--json", type=Path, metavar="OUT", help="write the figures as JSON")
    options = parser.parse_args()
    report = asyncio.run(run(options))
    if options.json:
        half_written = options.json.with_suffix(options.json.suffix + ".tmp")
        half_written.write_text(json.dumps(report, indent=1) + "\n", encoding="utf-8")
        os.replace(half_written, options.json)


if __name__ == "__main__":
    main()
