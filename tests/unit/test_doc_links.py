"""Links of the documentation lead to files of the repository, and to headings that exist by GitHub's rule.

Files that a page names exist, too.
"""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path
from urllib.parse import unquote

import pytest

ROOT = Path(__file__).parents[2]
# docs/api is written when the site is built, and its links are checked then.
PAGES = [
    *(ROOT / name for name in ("README.md", "CONTRIBUTING.md", "CHANGELOG.md", "SECURITY.md")),
    *(page for page in sorted((ROOT / "docs").rglob("*.md")) if page.parent.name != "api"),
]
LINK = re.compile(r"(?<!\\)\]\(<?([^)\s>]+)>?(?:\s+\"[^\"]*\")?\)|^\[[^\]]+\]:\s+(\S+)", re.MULTILINE)
IMAGE = re.compile(r"<(?:img|a)\s[^>]*(?:src|href)=\"([^\"]+)\"")


def prose(page: Path) -> str:
    """The text without code, in which brackets and # mean something else."""
    text = re.sub(r"^( *)(```+).*?^\1\2 *$", "", page.read_text(encoding="utf-8"), flags=re.DOTALL | re.MULTILINE)
    return re.sub(r"(`+)(?!`).+?(?<!`)\1(?!`)", lambda code: "x" * len(code[0]), text)


def links(page: Path) -> list[str]:
    text = prose(page)
    found = [a or b for a, b in LINK.findall(text)] + IMAGE.findall(text)
    return [target for target in found if not re.match(r"[a-z][a-z0-9+.-]*:", target)]


@cache
def anchors(page: Path) -> frozenset[str]:
    """Slugs of all headings: lower case, without punctuation, hyphens for blanks, numbered where they repeat."""
    text = re.sub(r"^( *)(```+).*?^\1\2 *$", "", page.read_text(encoding="utf-8"), flags=re.DOTALL | re.MULTILINE)
    slugs: dict[str, int] = {}
    found = set(re.findall(r"<a\s+(?:id|name)=\"([^\"]+)\"", text))
    for heading in re.findall(r"^#{1,6}\s+(.+?)\s*#*$", text, re.MULTILINE):
        plain = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).strip().lower()
        slug = re.sub(r"[^\w\- ]", "", plain).replace(" ", "-")
        n = slugs.get(slug, 0)
        slugs[slug] = n + 1
        found.add(f"{slug}-{n}" if n else slug)
    return frozenset(found)


def fault(page: Path, target: str) -> str | None:
    """Why a link leads nowhere, None if it leads somewhere."""
    path, _, anchor = unquote(target).partition("#")
    to = (page.parent / path).resolve() if path else page
    if not to.is_relative_to(ROOT):
        return "leaves the repository"
    if not to.exists():
        return "leads to no file"
    if to.is_dir():
        return "leads to a folder, which the site cannot show: name its README.md"
    if anchor and to.suffix == ".md" and anchor not in anchors(to):
        return f"leads to no heading; there are {sorted(anchors(to))}"
    return None


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.relative_to(ROOT).as_posix())
def test_every_link_leads_somewhere(page: Path) -> None:
    faults = [f"{target} {why}" for target in links(page) if (why := fault(page, target))]
    assert not faults, "\n".join([str(page.relative_to(ROOT)), *faults])


def test_checker_finds_links() -> None:
    assert sum(len(links(page)) for page in PAGES) > 300


# A path in backticks, from the root or from `scene2hap`.
PATH = re.compile(r"`((?:[\w*]+/)+[\w*]+\.(?:py|pyx|pxd))`")


def lost_paths(text: str) -> list[str]:
    return [path for path in PATH.findall(text) if not any([*ROOT.glob(path), *(ROOT / "scene2hap").glob(path)])]


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.relative_to(ROOT).as_posix())
def test_every_file_that_a_page_names_exists(page: Path) -> None:
    if page.name not in ("CHANGELOG.md", "structure.md"):  # their tables have former names
        assert lost_paths(page.read_text(encoding="utf-8")) == []


def test_checker_finds_paths() -> None:
    assert lost_paths("`tests/unit/test_*.py`, `scene/load.py`, `scene/gone.py`") == ["scene/gone.py"]


@pytest.mark.parametrize(
    ("target", "why"),
    [
        ("paper.md#studies", None),
        ("../LICENSE", None),
        ("nowhere.md", "no file"),
        ("paper.md#nothing", "no heading"),
        ("../../etc", "leaves"),
        ("decisions/", "folder"),
    ],
)
def test_dead_link_is_reported(target: str, why: str | None) -> None:
    told = fault(ROOT / "docs" / "README.md", target)
    assert (told is None) if why is None else why in str(told)


def test_headings_become_slugs_by_the_rule_of_github(tmp_path: Path) -> None:
    page = tmp_path / "page.md"
    page.write_text(
        "# A `code_name`, and more!\n## 1. Twice\n## 1. Twice\n```sh\n# no heading\n```\n## [Link](x.md) – so\n"
    )
    assert anchors(page) == {"a-code_name-and-more", "1-twice", "1-twice-1", "link--so"}


def test_the_list_of_decisions_is_whole() -> None:
    folder = ROOT / "docs" / "decisions"
    listed = (folder / "README.md").read_text(encoding="utf-8")
    for page in sorted(folder.glob("0*.md")):
        title = page.read_text(encoding="utf-8").splitlines()[0].removeprefix("# ")
        assert f"- [{title}]({page.name})" in listed


def test_the_site_has_every_page() -> None:
    """A page that no table of contents lists cannot be found; the build would say so, but later."""
    index = (ROOT / "docs" / "index.md").read_text(encoding="utf-8").splitlines()
    for page in (ROOT / "docs").glob("*.md"):
        assert page.stem in index or page.stem == "index", f"docs/index.md does not list {page.stem}"
