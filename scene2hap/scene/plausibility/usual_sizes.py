"""Usual sizes of named objects: height of the top above the floor, or longest edge.

Names are read narrowly: a name that may mean another object (a doormat, a chair leg) has no usual size. The lexicon of
`llm` has far more nouns, with bounds so wide that miniatures and kits at half scale pass. Finding the unit needs
objects whose size varies little.
"""

from __future__ import annotations

import re
from functools import lru_cache
from typing import NamedTuple


class UsualSpan(NamedTuple):
    """The usual span of a kind of object [m]: of its top above the floor, or of its longest edge."""

    kind: str
    low_m: float
    high_m: float
    is_top: bool


DOOR = r"(front |main |room |entrance |folding |sliding |wooden |interior )?door"
"""The kind of doors. Doors are also parts of furniture."""

# Height of the top above the floor [m], by a pattern that the whole name must match (assumed, from usual furniture).
# Objects that hang, rest on another or are only part of another are left out.
_TOPS_M: tuple[tuple[str, float], ...] = (
    (DOOR, 2.0),
    (r"(arm |office |kitchen |dining |desk )?chair", 0.9),
    (r"(dining |kitchen |work |wooden )?table|(reading |writing |office )?desk", 0.75),
    (r"work ?top|(kitchen )?counter( top)?|stove|sink counter", 0.9),
    (r"fridge|refrigerator", 1.7),
    (r"wardrobe", 2.0),
    (r"sofa|couch", 0.85),
    (r"washing machine|washer|tumble dryer|dishwasher", 0.85),
    (r"toilet", 0.75),
    (r"bath ?tub", 0.6),
)

# Span of the longest edge [m] (assumed). Only objects of similar size everywhere that are not in the list above.
_LONGEST_M: tuple[tuple[str, float, float], ...] = (
    (r"(computer |mechanical |gaming |pc |wireless )?keyboard", 0.25, 0.5),
    (r"(computer |pc |wireless |gaming )mouse", 0.08, 0.14),
    (r"(computer |pc )?monitor|computer screen", 0.4, 0.9),
    (r"laptop|notebook computer", 0.28, 0.45),
    (r"(smart|mobile |cell )?phone|smartphone", 0.12, 0.19),
    (r"(coffee |tea )?(mug|cup)", 0.07, 0.15),
    (r"(dinner )?plate", 0.15, 0.35),
    (r"(wine |beer |water )bottle", 0.18, 0.4),
    (r"fork|spoon|knife", 0.14, 0.35),
    (r"pencil|pen|ball ?point pen", 0.1, 0.2),
    (r"toothbrush", 0.14, 0.25),
    (r"microwave( oven)?", 0.4, 0.65),
    (r"toaster", 0.2, 0.45),
    (r"(electric |water |tea )?kettle", 0.18, 0.38),
    (r"bed|double bed|single bed", 1.8, 2.4),
    (r"(park |garden |street )?bench", 1.0, 2.5),
    (r"(street ?|park )?lamp ?post|street ?(lamp|light)|light pole", 2.5, 12.0),
    (r"(oak |pine |birch |maple |palm |fir |broad ?leaf )?tree", 2.0, 30.0),
    (r"car|sedan|taxi|police car|hatchback", 3.4, 5.5),
    (r"(city )?bus", 7.0, 19.0),
    (r"bicycle|(mountain |road |city )?bike", 1.4, 2.1),
    (r"(trash|garbage|rubbish|litter) ?(can|bin)|dust ?bin", 0.25, 1.3),
    (r"(fire )hydrant", 0.5, 1.1),
    (r"(traffic |road )cone", 0.3, 1.0),
    (r"human|person|man|woman|mannequin", 1.5, 2.0),
    (r"(picnic table)", 1.4, 2.6),
    (r"(soccer |foot)ball goal", 1.8, 7.5),
    (r"basket ?ball", 0.22, 0.26),
    (r"brick", 0.19, 0.3),
    (r"(wooden |euro )?pallet", 1.0, 1.3),
)

# Words that exporters, kits and engines add to the noun.
_AROUND = (
    r"(?:sm|sk|mesh|geo|prop|props|obj|object|model|prefab|lod|left|right|front|back|clone|copy|old|new|big|small|"
    r"large|low|high|poly|base|main|group|grp|node|root|var|variant|wooden|metal|modern|black|white|red|blue|green)"
)


@lru_cache(maxsize=4096)
def usual(name: str) -> UsualSpan | None:
    """Return the usual size of an object by its name; None if the name does not show it."""
    words = _words(name)
    for pattern, top_m in _TOPS_M:
        if re.fullmatch(f"({pattern})( (left|right|front|back))?", words):
            return UsualSpan(pattern, top_m, top_m, is_top=True)
    bare = _bare(words)
    for pattern, low_m, high_m in _LONGEST_M:
        if re.fullmatch(f"(?:{pattern})s?", bare):
            return UsualSpan(pattern, low_m, high_m, is_top=False)
    return None


def is_floor(name: str) -> bool:
    """Return True if a name is that of the floor that objects stand on."""
    return re.fullmatch(r"floor|ground( plane)?", _bare(_words(name))) is not None


def _words(name: str) -> str:
    apart = re.sub(r"(?<=[a-z])(?=[A-Z])", " ", name[:_LONGEST_NAME])
    return " ".join(re.findall(r"[a-z]{2,}", apart.lower()))


def _bare(words: str) -> str:
    return re.sub(rf"^(?:{_AROUND} )+|(?: {_AROUND})+$", "", words)


_LONGEST_NAME = 200  # number of letters of a name that are read
