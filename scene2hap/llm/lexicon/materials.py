"""Material of an object and thickness of its plate, from its name, its surface materials, its place, and the table."""

from __future__ import annotations

from collections.abc import Sequence

from scene2hap.llm.lexicon import word_split, words
from scene2hap.llm.lexicon.names import NameReading, places_named
from scene2hap.llm.lexicon.similar_materials import constants
from scene2hap.llm.lexicon.table import ObjectRow

_TILED = frozenset({"kitchen", "bathroom", "laundry"})
_TILE, _TILE_THICKNESS_M = "ceramic", 0.008  # floor tiles of 8 mm; assumed

_GROWN = frozenset({"baked food", "firm food", "soft food", "soft tissue", "plant"})
"""Materials that a word for another one does not replace: a "stone fruit" is food."""

_OF_THE_SHEET = frozenset({"door", "hatch", "drawer", "lid", "handle", "leg", "frame", "case", "arm", "driver cab"})
"""Parts that consist of the same sheet or board as their owner. A tire, a cable or a windshield does not."""

_SOFT_PA = 0.2e9  # Young's modulus; above cloth, foam, rubber and leather, below all boards and hard plastics; assumed


def painted_with(material_names: Sequence[str]) -> str | None:
    """Return the material that all names of surface materials agree on ("M_Wood_Oak": oak); None if they differ.

    The table decides for a chair painted with "wood" and "fabric", since it has the material of the seat. It also
    decides for a cabinet that is mostly "sage_lacquer" with handles of "steel". Names are in the order of their faces.
    """
    found = [_painted_with(name) for name in material_names]
    return found[0] if found and set(found) <= {found[0], None} else None


def _painted_with(material_name: str) -> str | None:
    tokens, _ = word_split.read_words(material_name)
    return next((words.PAINT_WORDS[word] for word in reversed(tokens) if word in words.PAINT_WORDS), None)


def make(reading: NameReading, row: ObjectRow, scene_category: str, material_names: Sequence[str]) -> tuple[str, float]:
    """Return material and plate thickness [m], from the table, and for some parts from the table's row of the owner.

    Name, surface materials or place can replace them. A machine keeps the table's material: an adjective names the
    material that it works on (wood chipper, metal saw). Food, animals and plants keep it too. A soft object stays soft
    whatever the names of its surface materials say, since kits of models name colours so: a rug is painted with "wood".
    """
    whole = reading.whole
    material, thickness_m = row.material, row.thickness_m
    if (
        row.noun in _OF_THE_SHEET
        and whole is not None
        and (whole.vibrates or whole.role in ("container", "vessel", "vehicle"))
    ):
        material, thickness_m = whole.material, whole.thickness_m
    elif row.noun == "floor" and _TILED & {*places_named(reading.name), *places_named(scene_category)}:
        material, thickness_m = _TILE, _TILE_THICKNESS_M
    if not row.vibrates and material not in _GROWN:
        painted = painted_with(material_names)
        if painted is not None and _is_soft(material) and not _is_soft(painted):
            painted = None
        material = reading.material or painted or material
    return material, thickness_m


def _is_soft(material: str) -> bool:
    return constants(material).youngs_modulus_pa < _SOFT_PA
