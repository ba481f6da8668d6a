"""Names that say nothing: those that exporters and modelling tools give when nobody has named an object."""

from __future__ import annotations

import re

from scene2hap.scene.copies import name_words

_WORDS = (
    "object objects obj body link base root world node mesh geom geometry group default scene model main visual "
    "vis collision col part entity untitled unnamed noname polygon poly surface shape primitive "
    "pivot offset locator null empty game transform wrapper "
    # Of Unreal, SketchUp, Maya (pCube1) and Godot (Node3D).
    "instance instanced component static section lod rigid id nurbs csg p d "
    "cube sphere icosphere uvsphere cylinder plane circle cone torus capsule bezier curve text"
)
_EMPTY = frozenset(_WORDS.split())
"""Words without information about an object. "box" is not among them: a box is a thing."""

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
