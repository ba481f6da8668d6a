"""Dry run: estimated requests and cost of an inference run."""

import asyncio
from collections import Counter
from dataclasses import replace

import pytest

from llm_server import PNG, request
from scene2hap import LexiconBackend, load_scene
from scene2hap.demo import kitchen_path
from scene2hap.llm.backends.image_tokens import image_tokens
from scene2hap.llm.chain import infer_scene
from scene2hap.llm.chain.dry_run import dry_run, estimated_cost_usd
from scene2hap.llm.wrappers.prices import price_list
from scene2hap.scene.images import ImageSet, ObjectImages, Shot
from scripted_backend import SCENE


@pytest.mark.parametrize(
    ("model", "size_px", "detail", "tokens"),
    [
        ("gpt-4o", 1024, "high", 765),  # OpenAI's example: 85 + 4 * 170
        ("gpt-4o", 2048, "high", 765),  # it is scaled down to 768 px first
        ("gpt-4o", 512, "high", 85 + 170),
        ("gpt-4o-2024-08-06", 4096, "low", 85),  # OpenAI's second example
        ("gpt-4o-mini", 512, "high", 2833 + 5667),
        ("gpt-4.1-mini", 1024, "high", 1659),  # 1024 patches * 1.62, rounded up
        ("gpt-4.1-mini", 4096, "high", 2489),  # shrunk to 1536 patches
        ("gpt-5", 512, "low", 70),
        ("gpt-5.4", 512, "low", 256),
        ("olmo-7b", 512, "low", None),
        ("llava", 512, "low", None),
    ],
)
def test_picture_tokens_follow_the_published_rules(model: str, size_px: int, detail: str, tokens: int | None) -> None:
    assert image_tokens(model, size_px, detail) == tokens


def test_dry_run_counts_the_requests_of_a_real_run() -> None:
    scene = load_scene(kitchen_path())
    told = asyncio.run(dry_run(scene, "gpt-4o"))
    done = asyncio.run(infer_scene(scene, LexiconBackend()))
    # For objects that the lexicon does not know, a vision model may name one more material each.
    nameless = Counter(material_estimator=done.report.skipped["unknown_material"])
    assert told.calls == done.report.calls + nameless
    assert told.images == 0
    assert told.image_tokens == 0


class NoCamera:
    def image(self, shot: Shot) -> bytes:
        raise AssertionError("a dry run takes no picture")


def test_dry_run_counts_pictures_without_rendering() -> None:
    shots = ImageSet(NoCamera(), [Shot("isolated", "x", 45.0 * i, 45.0) for i in range(8)])
    objects = tuple(replace(item, images=ObjectImages(shots, shots)) for item in SCENE.objects)
    pictured = replace(SCENE, objects=objects, images=ImageSet(NoCamera(), shots.shots[:4]))
    told = asyncio.run(dry_run(pictured, "gpt-4o", prices={"gpt-4o": (3.0, 7.0)}))
    assert told.images == 4 + 16 * 3
    assert told.image_tokens == 85 * told.images
    read = told.text_tokens + 85 * told.images
    assert told.cost_usd == pytest.approx((3.0 * read + 7.0 * told.answer_tokens) / 1e6)


def test_each_picture_of_a_request_costs() -> None:
    prices = price_list({"gpt-4o": (3.0, 7.0)})
    one, three = (estimated_cost_usd(request(images=(PNG,) * n), "gpt-4o", "low", prices) for n in (1, 3))
    assert one is not None
    assert three is not None
    assert three - one == pytest.approx(2 * 85 * 3.0 / 1e6)


def test_cost_is_tokens_times_price() -> None:
    told = asyncio.run(dry_run(SCENE, "mine", prices={"mine": (3.0, 7.0)}))
    expected = (3.0 * told.text_tokens + 7.0 * told.answer_tokens) / 1e6
    assert told.cost_usd == pytest.approx(expected)
    # Four letters a token, including the schema: each of these prompts has at least 150 letters.
    assert told.text_tokens > 150 / 4 * sum(told.calls.values())


def test_cost_of_an_unlisted_model_is_unknown() -> None:
    told = asyncio.run(dry_run(SCENE, "nobody-knows"))
    assert told.cost_usd is None
    assert ("cost, about", "unknown") in told.rows()
