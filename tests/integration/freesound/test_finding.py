"""Freesound searches, with two loopback servers: the API on 127.0.0.1, previews on localhost."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from freesound_asking import catalogue, describe, freesound, preview
from freesound_server import TOKEN, Get, Page, host, hum, result, results
from scene2hap.audio.sources import SOURCES
from scene2hap.errors import ConfigError

LICENCES = 'license:("Creative Commons 0" OR "Attribution")'


def test_one_call_with_all_fields_a_filter_and_the_token_in_its_header(tmp_path: Path) -> None:
    with catalogue({}) as (api, _):
        (clip,) = freesound(api, tmp_path).find(describe())
    (asked,) = api.asked
    assert asked.path == "/apiv2/search/"
    assert asked.headers["authorization"] == f"Token {TOKEN}"
    assert asked.query == {
        "query": "electric toothbrush buzzing",
        "filter": f"duration:[2.5 TO 30] {LICENCES}",
        "sort": "score",
        "fields": "id,name,username,license,url,duration,previews",
        "page_size": "15",
    }
    credit = clip.credit
    assert (credit.title, credit.author, credit.licence) == ("hum 1", "ann", "CC0-1.0")
    assert credit.address == "https://freesound.org/people/ann/sounds/1/"
    assert (credit.query, credit.origin) == ("electric toothbrush buzzing", "freesound")
    assert clip.duration_s == pytest.approx(3.0, abs=0.01)


def test_the_ladder_goes_from_all_key_words_to_the_head_noun(tmp_path: Path) -> None:
    with host(Page(hum())) as cdn:

        def search(get: Get) -> Page:
            return results(*([result(1, preview(cdn))] if get.query["query"] == "toothbrush" else []))

        with host(by=search) as api:
            source = freesound(api, tmp_path)
            (clip,) = source.find(describe())
            source.find(describe())
    assert [asked.query["query"] for asked in api.asked] == [
        "electric toothbrush buzzing",
        "electric toothbrush",
        "toothbrush buzzing",
        "toothbrush",
    ], "the three rungs without hits are asked once"
    assert clip.credit.query == "toothbrush"
    assert len(cdn.asked) == 1


def test_empty_result_is_cached_and_no_failure(tmp_path: Path) -> None:
    with host(results()) as api:
        assert freesound(api, tmp_path).find(describe("fan", "whirring")) == []
        assert len(api.asked) == 2
        assert freesound(api, tmp_path).find(describe("fan", "whirring")) == []
    assert len(api.asked) == 2


def test_keywords_cannot_add_search_operators(tmp_path: Path) -> None:
    with host(results()) as api:
        freesound(api, tmp_path).find(describe('air-conditioner "x" AND -fan', "license:*"))
    assert all(set(asked.query["query"]).isdisjoint('-":*') for asked in api.asked)
    assert api.asked[0].query["query"] == "air conditioner x and fan license"


def test_first_five_results_keep_the_order_of_the_service(tmp_path: Path) -> None:
    with catalogue(*({} for _ in range(8))) as (api, cdn):
        clips = freesound(api, tmp_path).find(describe())
        assert len(freesound(api, tmp_path, candidates=2).find(describe())) == 2
    assert [clip.credit.title for clip in clips] == [f"hum {i}" for i in range(1, 6)]
    assert len(cdn.asked) == 5
    assert len(api.asked) == 1


def test_cached_results_need_no_network_and_no_token(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with catalogue({}, {}) as (api, _):
        first = freesound(api, tmp_path).find(describe())
    monkeypatch.delenv("FREESOUND_TOKEN")
    again = freesound(api, tmp_path).find(describe())
    assert [clip.credit for clip in again] == [clip.credit for clip in first]
    assert all((a.samples == b.samples).all() for a, b in zip(again, first, strict=True))


def test_cache_contains_no_token_and_no_partial_files(tmp_path: Path) -> None:
    with catalogue({}) as (api, _):
        freesound(api, tmp_path).find(describe())
    files = [path for path in (tmp_path / "cache").rglob("*") if path.is_file()]
    assert sorted(path.suffix for path in files) == [".json", ".ogg"]
    assert all(TOKEN.encode() not in path.read_bytes() for path in files)


@pytest.mark.parametrize("junk", [b"", b"not json", b"[1]", b'{"results": 3}', b"\x00" * 5_000_000])
def test_damaged_cache_entry_is_requested_again(tmp_path: Path, junk: bytes) -> None:
    with catalogue({}) as (api, cdn):
        freesound(api, tmp_path).find(describe())
        for path in (tmp_path / "cache").rglob("*.*"):
            path.write_bytes(junk)
        assert len(freesound(api, tmp_path).find(describe())) == 1
    assert (len(api.asked), len(cdn.asked)) == (2, 2)


def test_without_a_folder_the_user_s_own_cache_is_used(tmp_path: Path) -> None:
    with catalogue({}) as (api, _):
        freesound(api, tmp_path, cache=None).find(describe())
    assert list((tmp_path / "home-cache" / "scene2hap" / "freesound" / "previews").iterdir())


def test_unwritable_cache_is_reported(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with catalogue({}) as (api, _), pytest.raises(ConfigError, match="the cache .* cannot be written.*Set `cache`"):
        freesound(api, tmp_path, cache=tmp_path / "file").find(describe())


@pytest.mark.parametrize(
    "settings",
    [
        {"licences": []},
        {"licences": ["gpl"]},
        {"candidates": 6},
        {"candidates": 0},
        {"candidates": 2.5},
        {"max_duration_s": 2.0},
        {"max_duration_s": 61.0},
        {"timeout_s": 0.0},
        {"sort": "best"},
        {"token": 3},
        {"token_env": ""},
    ],
    ids=str,
)
def test_invalid_settings_are_refused(settings: dict[str, Any]) -> None:
    with pytest.raises(ConfigError, match=f"{next(iter(settings))[:5]}"):
        SOURCES.build({"kind": "freesound", **settings})
