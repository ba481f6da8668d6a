"""HTML tables for notebooks: content, escaped texts, and limited size."""

import dataclasses
from html.parser import HTMLParser

import pytest

from scene2hap import HapticBundle, HapticSession, Material, SceneSnapshot, Touch, materials
from scenes import RATE, box, haptics, scene, table_with_two_phones, tone_loop

EVIL = "</td><script>alert('x')</script><img src=x onerror=y>&amp;\u202e\"'\x1b\n"
KNOWN = {"div", "strong", "table", "thead", "tbody", "tr", "th", "td"}


class Reader(HTMLParser):
    """A strict HTML reader: only known tags, closed in order, with only a style attribute."""

    def __init__(self, html: str) -> None:
        super().__init__()
        self.open: list[str] = []
        self.rows: list[list[str]] = []
        self.text = ""
        self.feed(html)
        self.close()
        assert not self.open

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        assert tag in KNOWN
        assert {name for name, _ in attrs} <= {"style"}
        assert all("url" not in (value or "") for _, value in attrs)
        self.open.append(tag)
        if tag == "tr":
            self.rows.append([])
        if tag in ("th", "td"):
            self.rows[-1].append("")

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        assert not set(data) & set("\u202e\x1b\n")
        self.text += data
        if self.open and self.open[-1] in ("th", "td"):
            self.rows[-1][-1] += data


def read(thing: object) -> Reader:
    return Reader(thing._repr_html_())


def test_a_material_is_a_table() -> None:
    seen = read(materials.lookup("steel"))
    assert ["Young's modulus [GPa]", "200"] in seen.rows
    assert "Material steel" in seen.text


def test_a_scene_is_a_table() -> None:
    seen = read(table_with_two_phones()[0])
    assert seen.rows[0][0] == "object"
    assert seen.rows[1] == ["table", "table", "1.6 × 0.8 × 0.02", "0.7", "-"]
    assert "5 objects" in seen.text


def test_a_bundle_has_each_state_of_its_sources_first() -> None:
    bundle = table_with_two_phones()[1].override("alarm", gain_db=-3.0)
    rows = read(bundle).rows
    assert rows[1] == ["phone", "thing", "glass", "ringing", "0.5", "100", "100", "-", "+0.0"]
    assert rows[2][3] == "alarm"
    assert rows[3][-1] == "-3.0"
    assert rows[4][:3] == ["table", "thing", "oak"]
    assert rows[5][2] == "unknown"
    assert len(rows) == 7


@pytest.mark.parametrize("model", ["exponential_plate", "infinite_plate"])
def test_an_explanation_is_a_table(model: str) -> None:
    session = HapticSession(
        *table_with_two_phones(), {"sample_rate_hz": RATE, "propagation": model, "prepare": "blocking"}
    )
    assert "touches nothing" in read(session.explain("left")).text
    session.update(touches=[Touch("left", "table", (0.3, 0.72, 0.4))])
    session.strike("table", (0.5, 0.72, 0.4))
    explained = session.explain("left")
    seen = read(explained)
    assert seen.rows[1][:3] == [explained.felt[0].source_id, explained.felt[0].state, "table"]
    assert seen.rows[1][3] == f"{explained.felt[0].gain_db:+.1f}"
    assert len(seen.rows) == 1 + len(explained.felt) + len(explained.impacts)


def test_every_text_is_escaped() -> None:
    top = dataclasses.replace(box("top", (1.0, 0.02, 1.0), (0, 0, 0)), name=EVIL)
    source = dataclasses.replace(box("source", (0.1, 0.02, 0.1), (0, 0.02, 0)), id=EVIL)
    snapshot = dataclasses.replace(scene(top, source), name=EVIL)
    material = Material(EVIL, 700.0, 1e10, 0.3)
    inferred = dataclasses.replace(
        haptics("oak", (0.1, 0.1, 0.02), EVIL), object_category=EVIL, material=material, material_category=EVIL
    )
    objects = {"top": haptics("oak", (1.0, 1.0, 0.02)), EVIL: inferred}
    bundle = HapticBundle(snapshot, EVIL, objects, {EVIL: {EVIL: tone_loop(100.0)}})
    session = HapticSession(bundle, config={"sample_rate_hz": RATE}, hands=[EVIL])
    session.update(touches=[Touch(EVIL, "top", (0.1, 0.01, 0.1))])
    explained = session.explain(EVIL)
    assert explained.felt
    for thing in (material, snapshot, bundle, explained):
        assert "<script" not in thing._repr_html_()
        assert "script" in read(thing).text


def test_tables_stay_small() -> None:
    objects = [box(f"{k} {'n' * 5000}", (0.1, 0.1, 0.1), (k, 0.0, 0.0)) for k in range(200)]
    snapshot = SceneSnapshot("many", "y", tuple(objects))
    seen = read(snapshot)
    assert len(seen.rows) == 51
    assert "and 150 more" in seen.text
    assert len(snapshot._repr_html_()) < 60_000
    inferred = {item.id: haptics("oak", (0.1, 0.1, 0.1)) for item in objects}
    bundle = read(HapticBundle(snapshot, "room", inferred, {}))
    assert len(bundle.rows) == 51
    assert "and 150 more" in bundle.text
