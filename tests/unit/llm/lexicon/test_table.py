"""The lexicon's table of objects: complete, unambiguous, plausible, and with known materials."""

import csv
from collections import Counter
from importlib.resources import files

import pytest

from scene2hap import materials
from scene2hap.errors import UnknownMaterial
from scene2hap.llm.lexicon import similar_materials, table as lexicon_table, translations, word_split, words
from scene2hap.llm.lexicon.names import read_name
from scene2hap.llm.lexicon.table import PLACES, ObjectRow, table

# From the paper's scenes and studies, and from usual households.
VIBRATING = """
    refrigerator freezer extractor microwave oven dishwasher washer dryer kettle blender mixer fan shaver smartphone
    tablet laptop computer printer copier shredder projector television radio speaker subwoofer stereo heater
    boiler clock
    drill jigsaw chainsaw sander compressor generator lathe engine car truck excavator jackhammer crane pump fountain
    treadmill server stove cooktop burner toaster iron ambulance waterfall barbecue
"""
VIBRATING_WORDS = [
    *VIBRATING.split(),
    *(
        "cooker hood",
        "coffee machine",
        "food processor",
        "handheld fan",
        "electric toothbrush",
        "hair dryer",
        "game pad",
    ),
    *(
        "air conditioner",
        "vacuum cleaner",
        "robot vacuum",
        "sewing machine",
        "alarm clock",
        "circular saw",
        "guitar amp",
    ),
    *(
        "angle grinder",
        "concrete mixer",
        "plate compactor",
        "lawn mower",
        "leaf blower",
        "hedge trimmer",
        "exercise bike",
    ),
    *("massage chair", "game controller", "water heater"),
    # places with machines of their own: ships, stages, surgeries, farms, arcades, laundrettes
    *("bow thruster", "oil separator", "anchor windlass", "fog horn"),
    *("studio monitor", "leslie cabinet", "fog machine", "moving head light"),
    *("dental unit", "ultrasonic cleaner", "amalgamator", "oxygen concentrator"),
    *("milking machine", "milk tank", "grain mill", "log splitter"),
    *("air hockey table", "skee ball", "coin changer", "kiddie ride"),
    *("spin extractor", "rotary iron", "steam press", "plotter"),
]
SILENT = """
    plate chair wall towel table bowl mirror lamp chandelier portrait board carpet rug mat vase sofa curtain wardrobe
    desk ball dumbbell window bathtub sink crate bottle jar stool plant tomato router radiator piano guitar
    floor ceiling door stairs worktop counter shelf cabinet drawer handle knob bed monitor hammer wheelbarrow sword
"""
SILENT_WORDS = [
    *SILENT.split(),
    *(
        "towel rail",
        "trash bin",
        "shoe rack",
        "night stand",
        "cutting board",
        "paper towel",
        "dish rack",
    ),
    *("toilet roll", "security camera", "controller", "tap", "faucet", "shower", "toilet"),
    *("digital clock", "led clock", "audio interface", "drum machine", "effects pedal", "gumball machine"),
    *("drill press table", "leg extension machine", "standing desk", "pump room door", "drum stool", "spring rider"),
    *("cow bell", "bicycle pump", "hand pump", "manual coffee grinder", "soap pump", "folding fan", "dryer sheet"),
]


def names_of(row: ObjectRow) -> list[str]:
    return [row.noun, *row.synonyms]


def test_table_covers_every_kind_of_place() -> None:
    assert len(table()) >= 1500
    for place in PLACES:
        assert sum(place in row.places for row in table()) >= 10, place
    assert {place for row in table() for place in row.places} == {*PLACES, "any"}


def test_names_are_unique_in_the_table() -> None:
    # Compared without spaces, since "dish washer" and "dishwasher" are read equally.
    joined = [name.replace(" ", "").replace("-", "") for row in table() for name in names_of(row)]
    assert [name for name, count in Counter(joined).items() if count > 1] == []
    assert all(name == name.lower().strip() and name for row in table() for name in names_of(row))


def test_every_name_of_the_table_reads_as_its_own_row() -> None:
    wrong = {name: row.noun for row in table() for name in names_of(row) if read_name(name).row is not row}
    assert wrong == {}


def test_categories_are_short() -> None:
    assert max(len(row.noun.split()) for row in table()) <= 3
    assert all(row.usage.endswith(".") and len(row.usage) < 80 for row in table())


def faults(row: ObjectRow) -> list[str]:
    size_fits = not (row.min_size_m and row.max_size_m) or row.thickness_m < row.min_size_m < row.max_size_m
    held = {
        "thickness": 5e-5 <= row.thickness_m <= 0.3,
        "source": bool(row.source),
        "vibrates": row.vibrates == any(not state.needs_contact for state in row.states),
        "states repeat": len({state.name for state in row.states}) == len(row.states),
        "intensity": all(0.0 < state.intensity <= 1.0 for state in row.states),
        "verb": all(state.verb.endswith("ing") for state in row.states),
        "vibrate": not any("vibrat" in f"{row.noun} {state.name} {state.verb}" for state in row.states),
        "contact": all(read_name(noun).row is not None for state in row.states for noun in state.needs_contact),
        "size": size_fits,
    }
    return [what for what, holds in held.items() if not holds]


def test_every_row_is_plausible() -> None:
    assert {row.noun: faults(row) for row in table() if faults(row)} == {}


def test_every_material_has_constants() -> None:
    for name in {row.material for row in table()} | set(words.PAINT_WORDS.values()):
        assert similar_materials.constants(name).density_kg_m3 > 0.0
    for name, stand_in in similar_materials.STAND_INS.items():
        with pytest.raises(UnknownMaterial):
            materials.lookup(name)
        assert similar_materials.constants(name) == materials.lookup(stand_in)


def test_needed_contacts_are_nouns_of_the_table() -> None:
    # A session compares them with the categories that this table gives.
    nouns = {row.noun for row in table()}
    assert {noun for row in table() for state in row.states for noun in state.needs_contact} <= nouns


def test_roles_are_known() -> None:
    assert {row.role for row in table()} == {"", "container", "vessel", "content", "part", "vehicle"}


def test_source_column_states_assumptions() -> None:
    for row in table():
        assert "assumed" in row.source, row.noun


def test_table_file_has_lines_of_equal_width() -> None:
    lines = files("scene2hap.llm.lexicon").joinpath("table.csv").read_text(encoding="utf-8").splitlines()
    assert {len(fields) for fields in csv.reader(lines)} == {14}


def test_adjectives_of_material_are_in_the_material_table() -> None:
    for name in words.MATERIAL_WORDS.values():
        materials.lookup(name)


@pytest.mark.parametrize("name", VIBRATING_WORDS)
def test_named_sources_vibrate(name: str) -> None:
    row = read_name(name).row
    assert row is not None
    assert row.vibrates


@pytest.mark.parametrize("name", SILENT_WORDS)
def test_named_passive_objects_do_not_vibrate(name: str) -> None:
    row = read_name(name).row
    assert row is None or not row.vibrates


def test_intensity_keeps_the_scale_of_source_states() -> None:
    def intensity(name: str) -> float:
        row = read_name(name).row
        assert row is not None
        return row.states[0].intensity

    assert (intensity("washing machine"), intensity("phone"), intensity("refrigerator")) == (1.0, 0.5, 0.1)
    # HSE's typical hand-arm vibration: road breaker 12, hammer drill 9, angle grinder 4 to 8, brush cutter 4 m/s2.
    tools = [intensity(name) for name in ("road breaker", "hammer drill", "angle grinder", "brush cutter")]
    assert tools == sorted(tools, reverse=True)


def test_version_changes_with_every_file_of_the_lexicon(monkeypatch: pytest.MonkeyPatch) -> None:
    own = lexicon_table.text_of
    before = lexicon_table.version()
    for file in files("scene2hap.llm.lexicon").iterdir():
        if file.name.endswith(".csv"):
            changed = file.name
            monkeypatch.setattr(lexicon_table, "text_of", lambda name, c=changed: own(name) + "x," * (name == c))
            lexicon_table.version.cache_clear()
            assert lexicon_table.version() != before, changed
    monkeypatch.undo()
    lexicon_table.version.cache_clear()


@pytest.mark.parametrize("name", ["yogurt_maker", "baby_monitor", "Babyphone"])
def test_things_without_a_moving_part_are_silent(name: str) -> None:
    """A yogurt maker whirred, and a baby monitor hummed."""
    row = read_name(name).row
    assert row is not None
    assert not row.vibrates


def test_a_stirrer_is_weaker_than_a_centrifuge() -> None:
    (stirrer,), (centrifuge,) = ([row for row in table() if row.noun == n] for n in ("magnetic stirrer", "centrifuge"))
    assert stirrer.states[0].intensity < 0.5 * centrifuge.states[0].intensity


def test_every_translation_is_made_of_words_of_the_lexicon() -> None:
    meanings = translations.english().items()
    assert {word: meaning for word, meaning in meanings if not all(map(word_split.is_known, meaning))} == {}
