"""Names of parts: the head noun of "Cabinet_door_L.001" is "door", which is no thing of its own."""

from __future__ import annotations

import re
from functools import lru_cache

_PARTS = """
    apron arm armrest axle back backrest bar base basket battery bezel blade board body bolt border bottom brace
    bracket bulb bumper burner button cable cage cap case casing caster castor chain control cord corner countertop
    cover crossbar cushion dial display door drawer edge eye face fan feet fender foot footboard footrest frame
    front gasket gear glass globe grate grid grill grip groove handle handlebar handrail headboard headlight
    headrest hinge holder hole hood hose housing hub inlay inside interior key knob label lampshade leaf leaves led
    leg lens lever lid light lock logo mirror motor mount neck nozzle nut outlet outside pane panel part pedal pin
    pipe plank plug pole post rack rail reflector rim ring rivet rod roof screen screw seat seatback shade shaft
    shelf shell shelves side sill slat spindle spoke spool spout spring stand stem strap string strip support
    surface switch tabletop tail taillight tire top tread trigger trim tube tyre valve vent wheel window wing wire
    worktop
"""
# Words for the place or the material of a piece, or words that a program gave it.
_NO_NOUNS = """
    left right upper lower middle center centre inner outer rear small big large long short up down mat material
    mesh node object obj geo geometry geom poly polygon primitive prim surface lod collision collider cube box
    sphere cylinder plane circle cone torus default none wood metal steel chrome plastic fabric leather glass
    rubber ceramic porcelain stone marble paper black white red green blue grey gray brown yellow dark bright
    clone copy instance shape group sub model item element piece pivot joint bezier curve text textured untitled
    icosphere
"""
# Pieces that walls, floors and ceilings are built of.
_BUILT_OF = """
    baseboard beam board brick molding moulding panel plank skirting slab tile trim
"""
_PART_WORDS, _OTHER_WORDS = frozenset(_PARTS.split()), frozenset(_NO_NOUNS.split())
_STRUCTURE, _COVERING = frozenset(("wall", "floor", "ceiling")), frozenset(_BUILT_OF.split())
_WORD = re.compile(r"[A-Z]?[^\W\d_A-Z]+|[A-Z]+(?![^\W\d_A-Z])")


def has_own_noun(name: str, group_name: str) -> bool:
    """Return True if a name ends in a noun that names no part. The group's name is ignored."""
    head = _head(name[len(group_name) :] if name.startswith(group_name) else name)
    return bool(head) and not _singulars(head) & _PART_WORDS


def names_another_thing(name: str, other: str) -> bool:
    """Return True if a name ends in a noun that names no part and is no word of the other name: `Mug` beside `Table`,
    not `chair` beside `chairDesk`."""
    return has_own_noun(name, other) and _has_another_noun(name, other)


def names_thing_in(name: str, structure: str) -> bool:
    """Return True if a name ends in a noun that is no piece of a place, a wall or a floor: `Shelf`, not `Tile`."""
    return _has_another_noun(name, structure) and not _singulars(_head(name)) & _COVERING


def _has_another_noun(name: str, other: str) -> bool:
    """Return True if a name ends in a noun that is no word of the other name."""
    head = _head(name)
    return bool(head) and head not in _words(other)


def names_part(name: str, group_name: str) -> bool:
    """Return True if a name is that of a part or a material, or repeats the group's noun: `chair.001` of `Desk Chair`.

    `Door.001` below `Doors` is no part, but one of several doors. A short word such as `TV` is no part.
    """
    head, above = _head(name), _head(group_name)
    if not head:
        words = _words(name)
        return bool(words) and _OTHER_WORDS.issuperset(words)
    is_one_of_several = head != above and head in _singulars(above)
    return not is_one_of_several and (head == above or bool(_singulars(head) & _PART_WORDS))


def names_structure(name: str) -> bool:
    """Return True if a name is that of a wall, a floor or a ceiling."""
    return bool(_singulars(_head(name)) & _STRUCTURE)


def _words(name: str) -> list[str]:
    return [word.lower() for word in _WORD.findall(name)]


# A name is read once for each node above it.
@lru_cache(4096)
def _head(name: str) -> str:
    """Return the last noun of a name, "" if it has none."""
    return next((word for word in reversed(_words(name)) if len(word) > 2 and word not in _OTHER_WORDS), "")


def _singulars(word: str) -> frozenset[str]:
    return frozenset((word, word.removesuffix("s"), word.removesuffix("es")))
