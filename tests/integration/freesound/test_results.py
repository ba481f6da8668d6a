"""Untrusted search results: licences, titles, addresses and previews."""

from __future__ import annotations

import warnings
from pathlib import Path
from typing import Any

import pytest

from freesound_asking import catalogue, describe, freesound, preview
from freesound_server import BY, BY_NC, Get, Page, host, hum, refused, result, results
from scene2hap.audio.sources.freesound import UnusableSound
from scene2hap.errors import BackendUnavailable


@pytest.mark.parametrize(
    ("licence", "wanted", "credit"),
    [
        (BY, ("by",), "CC-BY-4.0"),
        ("https://creativecommons.org/licenses/by/3.0/", ("cc0", "by"), "CC-BY-3.0"),
        (BY_NC, ("by-nc",), "CC-BY-NC-3.0"),
        ("http://creativecommons.org/licenses/sampling+/1.0/", ("sampling+",), "CC-Sampling+-1.0"),
    ],
)
def test_licences_are_read_from_their_url(tmp_path: Path, licence: str, wanted: tuple[str, ...], credit: str) -> None:
    with catalogue({"license": licence}) as (api, _):
        (clip,) = freesound(api, tmp_path, licences=wanted).find(describe())
    assert clip.credit.licence == credit


@pytest.mark.parametrize(
    "change",
    [
        {"license": BY_NC},
        {"license": "all rights reserved"},
        {"duration": 300.0},
        {"duration": 1.0},
        {"previews": {}},
        {"previews": {"preview-hq-ogg": "file:///etc/passwd"}},
        {"previews": {"preview-hq-ogg": "http://203.0.113.5/a.ogg"}},
        {"previews": {"preview-hq-ogg": "https://user:pass@example.org/a.ogg"}},
        {"previews": {"preview-hq-ogg": "https://[::1"}},
        {"id": "x"},
        {"name": None},
        {"previews": None},
    ],
    ids=str,
)
def test_results_outside_the_filter_are_dropped(tmp_path: Path, change: dict[str, Any]) -> None:
    with catalogue(change, {}) as (api, cdn):
        (clip,) = freesound(api, tmp_path).find(describe())
    assert clip.credit.title == "hum 2"
    assert [asked.path for asked in cdn.asked] == ["/previews/2.ogg"]


def test_titles_are_reduced_to_one_line(tmp_path: Path) -> None:
    odd = {"name": "hum\nSounds by me\x1b[31m", "username": "  ", "url": "javascript:alert(1)"}
    with catalogue(odd) as (api, _):
        (clip,) = freesound(api, tmp_path).find(describe())
    assert clip.credit.title == "hum Sounds by me [31m"
    assert clip.credit.author == "unknown"
    assert clip.credit.address == "https://freesound.org/s/1/"


@pytest.mark.parametrize(
    "page",
    [
        refused(404),
        Page(b""),
        Page(b"<html>no sound</html>"),
        Page(hum()[:900]),
        Page(hum(seconds=61.0, rate=4000, kind="WAV")),
        Page(manner="endless"),
        Page(b"", 302, {"location": "ftp://example.org/a.ogg"}),
        Page(b"", 302, {"location": "http://203.0.113.5/a.ogg"}),
    ],
    ids=["404", "empty", "html", "cut", "long", "endless", "to-ftp", "to-plain-http"],
)
def test_invalid_preview_is_skipped_with_a_warning_and_not_cached(tmp_path: Path, page: Page) -> None:
    def file(get: Get) -> Page:
        return page if get.path.endswith("1.ogg") else Page(hum())

    with (
        host(by=file) as cdn,
        host(results(*(result(i, preview(cdn, f"{i}.ogg")) for i in (1, 2)))) as api,
        pytest.warns(UnusableSound, match="skipped sound 1"),
    ):
        (clip,) = freesound(api, tmp_path).find(describe())
    assert clip.credit.title == "hum 2"
    assert len(list((tmp_path / "cache" / "previews").iterdir())) == 1


def test_preview_too_short_after_trimming_is_skipped(tmp_path: Path) -> None:
    with catalogue({}, sound=Page(hum(2.0))) as (api, _):
        assert freesound(api, tmp_path).find(describe()) == []


def test_failure_of_all_previews_is_an_error(tmp_path: Path) -> None:
    with catalogue(*({} for _ in range(5)), sound=Page(manner="drop")) as (api, cdn), warnings.catch_warnings():
        warnings.simplefilter("ignore", UnusableSound)
        with pytest.raises(BackendUnavailable, match="previews/2.ogg cannot be reached"):
            freesound(api, tmp_path).find(describe())
    assert len(cdn.asked) == 2
