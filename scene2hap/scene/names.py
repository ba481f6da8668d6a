"""What the authored name of an object, a node or a group tells: nothing, a place, a part, or a thing of its own.

The head noun of "Cabinet_door_L.001" is "door", which is no thing of its own.
"""

from __future__ import annotations

import re
from functools import lru_cache

_HASH = re.compile(r"(?<![^\W_])(?=[0-9a-f]*\d)(?=[0-9a-f]*[a-f])[0-9a-f]{6,}(?![^\W_])", re.IGNORECASE)
"""Serial numbers in base 16 at the end of names in kits ("Mug_3a2f91bc")."""
_SIDES = frozenset({"left", "right"})
_LONGEST_NAME = 1000  # letters of a name that are split into words
_WORD = re.compile("A+(?=Aa)|A?a+|A+")
"""A word in the shape of a name: "A" stands for a capital, "a" for any other letter."""

# Of Unreal, SketchUp, Maya (pCube1) and Godot (Node3D) are those from "instance" to "d". "box" is not among them: a box
# is a thing.
_SAY_NOTHING = """
    object objects obj body link base root world node mesh geom geometry group default scene model main visual vis
    collision col part entity untitled unnamed noname polygon poly surface shape primitive pivot offset locator null
    empty game transform wrapper instance instanced component static section lod rigid id nurbs csg p d cube sphere
    icosphere uvsphere cylinder plane circle cone torus capsule bezier curve text
"""
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
_EMPTY, _OTHER_WORDS = frozenset(_SAY_NOTHING.split()), frozenset(_NO_NOUNS.split())
_PART_WORDS, _COVERING = frozenset(_PARTS.split()), frozenset(_BUILT_OF.split())
_STRUCTURE = frozenset(("wall", "floor", "ceiling"))

_LETTER_AND_NUMBER = re.compile(r"[A-Za-z][ ._-]?\d+")
_EXPORTER_NODE = re.compile(
    r"(sketchfab_model|osg_scene|auxscene|gltf_sceneroot\w*|rootnode\b.*|root|scene|scene root|world|group|empty"
    # Of SketchUp, Assimp (3DS), OpenCOLLADA, Blender, Roblox and Unreal.
    r"|<?sketchup>?|<?3dsroot>?|visualscenenode|collada visual scene group|(scene )?collection([ ._]?\d+)?|workspace"
    r"|persistent ?level"
    r"|.*\.(fbx|obj|dae|3ds|gltf|glb|blend|max|stl|ply|skp|c4d|usdz?)(\..*)?)",
    re.IGNORECASE,
)
# Words for containers of objects: a group of that name is never one object.
_PLACE = re.compile(
    r"(level|map|environment|building|house|home|flat|floorplan|furniture|props"
    # With any word before it: "hotel_room", "Modern Kitchen". A "doll house" and a "world map" are things.
    r"|(.*[ _-])?((living|bed|bath|dining|class)?[ _-]?room|kitchen|office|hall|garage|workshop|apartment|scene)"
    r")[ ._-]?\d*",
    re.IGNORECASE,
)


def words(name: str) -> list[str]:
    """Return the words of a name in lower case, in order: capitals, digits and signs divide them."""
    shape = "".join("A" if one.isupper() else "a" if one.isalpha() else "-" for one in name)
    return [name[found.start() : found.end()].lower() for found in _WORD.finditer(shape)]


def name_words(name: str) -> tuple[str, ...]:
    """Return the words of an authored name in lower case: ("wooden", "table") of "woodenTable.012".

    Running numbers are left out, as are "left" and "right", which also number objects. Text after the first 1,000
    characters is not split.
    """
    found = tuple(word for word in words(_HASH.sub(" ", name[:_LONGEST_NAME])) if word not in _SIDES)
    return found + ((name[_LONGEST_NAME:],) if len(name) > _LONGEST_NAME else ())


def says_nothing(name: str) -> bool:
    """Return True if no word of a name tells what the object is: "base_link", "pCube1", "world/body1", "p3"."""
    return bool(_LETTER_AND_NUMBER.fullmatch(name)) or _EMPTY.issuperset(name_words(name))


def abbreviates(name: str, full: str) -> bool:
    """Return True if a name is another one without some of its vowels: "bsktball" of "basketball"."""
    consonants, all_consonants = (re.sub("[aeiou]", "", text.lower()) for text in (name, full))
    return len(name) < len(full) and consonants == all_consonants


def names_a_thing(name: str) -> bool:
    """Return False for the names of nodes that exporters add, and of places: their nodes are always containers."""
    return bool(name) and not _EXPORTER_NODE.fullmatch(name) and not names_a_place(name)


def names_a_place(name: str) -> bool:
    """Return True for the name of a room, a building or a level."""
    return bool(_PLACE.fullmatch(name))


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
    return bool(head) and head not in words(other)


def names_part(name: str, group_name: str) -> bool:
    """Return True if a name is that of a part or a material, or repeats the group's noun: `chair.001` of `Desk Chair`.

    `Door.001` below `Doors` is no part, but one of several doors. A short word such as `TV` is no part.
    """
    head, above = _head(name), _head(group_name)
    if not head:
        found = words(name)
        return bool(found) and _OTHER_WORDS.issuperset(found)
    is_one_of_several = head != above and head in _singulars(above)
    return not is_one_of_several and (head == above or bool(_singulars(head) & _PART_WORDS))


def names_structure(name: str) -> bool:
    """Return True if a name is that of a wall, a floor or a ceiling."""
    return bool(_singulars(_head(name)) & _STRUCTURE)


# A name is read once for each node above it.
@lru_cache(4096)
def _head(name: str) -> str:
    """Return the last noun of a name, "" if it has none."""
    return next((word for word in reversed(words(name)) if len(word) > 2 and word not in _OTHER_WORDS), "")


def _singulars(word: str) -> frozenset[str]:
    return frozenset((word, word.removesuffix("s"), word.removesuffix("es")))
