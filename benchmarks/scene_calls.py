"""Requests to a model for many scenes with shared furniture, with and without sharing, as a table in Markdown.

python benchmarks/scene_calls.py [--scenes 200] [--seed 0] [--model gpt-5]

Scenes are the variations of `benchmarks/bake_many.py`. The lexicon answers instead of a model, and every request is
counted, with its estimated tokens (`scene2hap.llm.chain.dry_run`). Pictures are small, since only their equality
matters here. The plan for more scenes is extrapolated from the same run, by requests and tokens per scene and by the
growth of the number of distinct requests.
"""

from __future__ import annotations

import argparse
import asyncio
import sys
import tempfile
import time
import warnings
from collections import Counter
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).parent))

from bake_many import write_variations

from scene2hap import capture_images, load_scene
from scene2hap.llm.chain import infer_scene
from scene2hap.llm.chain.dry_run import estimated_cost_usd
from scene2hap.llm.lexicon import LexiconBackend
from scene2hap.llm.protocol import LLMReply, LLMRequest
from scene2hap.llm.wrappers import CacheBackend, price_list

WAYS = {
    "no sharing": {"share_copies": False},
    "copies within a scene (default)": {},
    "`share_scenes`": {"share_scenes": True},
}
PICTURE_PX = 32
PLANNED = 10_000
QUESTIONS_A_MINUTE = (5_000, 500)
"""Requests a minute that a large and a small account allow (assumed); batches have no limit."""


class Counting:
    """The lexicon as a remote model that counts its requests."""

    def __init__(self, model: str) -> None:
        self.identity = {"model": model, "base_url": "https://nowhere.invalid"}
        self.calls: Counter[str] = Counter()
        self.cost_usd = 0.0
        self._inner, self._prices = LexiconBackend(), price_list()

    async def complete(self, request: LLMRequest) -> LLMReply:
        self.calls[request.component] += 1
        self.cost_usd += estimated_cost_usd(request, str(self.identity["model"]), "low", self._prices) or 0.0
        return await self._inner.complete(request)


def counted(scenes: list[Path], model: str, folder: Path, settings: dict[str, Any]) -> tuple[Counting, int, list[int]]:
    """Counts of the model, number of all requests of the chain, and number of requests sent up to each scene."""
    counting = Counting(model)
    backend = counting if settings.get("share_copies") is False else CacheBackend(counting, folder)
    n_questions, sent = 0, []
    for path in scenes:
        scene = capture_images(
            load_scene(path), config={"size_px": PICTURE_PX}, alone=bool(settings.get("share_scenes"))
        )
        found = asyncio.run(infer_scene(scene, backend, config=settings))
        n_questions += sum(found.report.calls.values())
        sent.append(sum(counting.calls.values()))
    return counting, n_questions, sent


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scenes", type=int, default=200)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--model", default="gpt-5")
    arguments = parser.parse_args()
    warnings.simplefilter("ignore")
    with tempfile.TemporaryDirectory() as place:
        (Path(place) / "scenes").mkdir()
        scenes = write_variations(Path(place) / "scenes", arguments.scenes, arguments.seed)
        n_objects = sum(len(load_scene(path).objects) for path in scenes)
        rows = {}
        for k, (way, settings) in enumerate(WAYS.items()):
            begun = time.perf_counter()
            rows[way] = (*counted(scenes, arguments.model, Path(place) / str(k), settings), time.perf_counter() - begun)
    print(
        f"{arguments.scenes} scenes, {n_objects} objects, seed {arguments.seed}; costs are estimates at the prices of "
        f"{price_list().date} for {arguments.model}, standard tier, pictures in low detail.\n"
    )
    print("| sharing | questions sent | per scene | about objects | cost [dollars] | cost, flex or batch |")
    print("|---|---|---|---|---|---|")
    for way, (counting, _, sent, _) in rows.items():
        cost = counting.cost_usd
        objects = counting.calls["object_analyzer"]
        print(f"| {way} | {sent[-1]:,} | {sent[-1] / len(scenes):.1f} | {objects:,} | {cost:.2f} | {cost / 2:.2f} |")
    print(f"\n{PLANNED:,} scenes like these, extrapolated from the last half of the run, without prompt caching:\n")
    high, low = QUESTIONS_A_MINUTE
    print(f"| sharing | questions | cost, flex or batch [dollars] | time at {high:,} a minute | at {low:,} a minute |")
    print("|---|---|---|---|---|")
    for way, (counting, _, sent, _) in rows.items():
        half = len(sent) // 2
        slope = (sent[-1] - sent[half - 1]) / (len(sent) - half)
        planned = sent[-1] + slope * (PLANNED - len(sent))
        dollars = counting.cost_usd / max(sent[-1], 1) * planned / 2
        hours = [planned / rate / 60 for rate in QUESTIONS_A_MINUTE]
        print(f"| {way} | {planned:,.0f} | {dollars:,.0f} | {hours[0]:.1f} h | {hours[1]:.1f} h |")


if __name__ == "__main__":
    main()
