"""Reading authored object names: "kitchenFridge", "SM_Prop_Table_02", "washer(Clone)", "Cupboard_Big_door_upper".

1. A name is split into words at separators, digits and changes of case. Run-together words are split if all pieces are
   known ("kitchentable").
2. A preposition and all words after it are ignored ("table_with_vase"), and so is a remark in parentheses after a noun
   ("train_(railroad_vehicle)"). A "bottle_of_wine" is a wine bottle if the table has one, else a bottle.
3. The last noun is the object, as in English compounds, and the longest match is used: a sink counter is a counter, a
   coffee machine is no coffee. Words for tools, sides, colours and rooms are never the object.
4. Asset kits also write the object first. A two-word noun of the table is found in that order too (tableCoffee,
   wheelchair_electric), but a machine comes before its parts and before what it works with: a printer_label is no label
   printer. A container precedes its content (crate_tomatoes), a noun its material (tableGlass), a wall the opening in
   it (wall_doorway), a piece of furniture the number of its parts (sofa_2_seats), and any object a word that a number
   is written onto (ladder_6step). "Machine" after a machine and "bath" after a noun are not the object. Links of robots
   are called by their joints, limbs or makes (shoulder_pan_link, wrist_roll, upper_arm_link, iiwa_link_4), which are no
   objects. Only the base of a robot is the robot: robot0:base_link and panda_link0, but robot0:elbow_link,
   finger_base_link and finger_link_0 are parts of one, which do not vibrate by themselves.
5. The room, driver, picture, control or wreck of a machine is no machine (engine_room, fan_art, crane_control).
6. The size of a metric thread says that the object belongs to a bolt: "washer_M8" is no washing machine.
7. A name that no rule can read stays unknown. Corrected are plurals, one typing error in a long word or beside the
   other word of a noun ("coffe_machine"), and missing vowels ("prntr") if only one word has the consonants.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache

from scene2hap.llm.lexicon import word_split, words
from scene2hap.llm.lexicon.table import ObjectRow

# Confidence of a reading. Assumed; the values only rank readings by the part of the name that was understood.
_ALL_READ = 0.95
_UNREAD_BEFORE = 0.9  # "zorgon_lamp" is some lamp
_UNREAD_AFTER = 0.5  # "fridge_zorgon" may be a fridge, or a zorgon
_OBJECT_FIRST = 0.8
_UNKNOWN = 0.1

_LONGEST_NOUN = 4  # words

_ANIMAL = "soft tissue"  # the material of animals in the table
_HOLDS = {"container": ("vessel", "content"), "vessel": ("content",)}
# 3ds Max gives its primitives such names; "Box_01" is a box.
_PRIMITIVE = re.compile(r"box\d+", re.IGNORECASE)
_NAMESPACE = re.compile(r"robot(?:\d+[\W_]|:)", re.IGNORECASE)
_LINK_0 = re.compile(r"link_?0$", re.IGNORECASE)
# The Shadow Hand: first, middle, ring and little finger, and thumb.
_HAND_LINK = re.compile(r"(?<![^\W_])(?:[fmrl]f|th)(?:knuckle|proximal|middle|distal|metacarpal|base|hub)(?![^\W_])")
_THREAD = re.compile(r"(?<![^\W_])M\d{1,2}(?![^\W_xX])")


@dataclass(frozen=True)
class NameReading:
    """The parts of an authored name.

    `name` is the name as given; `words` are its words in lower case; `row` is the table's row or None; `confidence` is
    0..1, and at most 0.2 if `row` is None. `head` is the recognised part; `unread` are the unknown words; `material` is
    a material that an adjective names; `toy` is true if the name marks the object as not real; `whole` is the owner of
    a part (the oven of an oven door).
    """

    name: str
    words: tuple[str, ...]
    row: ObjectRow | None
    confidence: float
    head: str = ""
    unread: tuple[str, ...] = ()
    material: str | None = None
    toy: bool = False
    whole: ObjectRow | None = None


@dataclass(frozen=True)
class _Noun:
    """A noun of the table found at words[start:end]."""

    row: ObjectRow
    start: int
    end: int
    plural: bool


@lru_cache(maxsize=4096)
def read_name(name: str) -> NameReading:
    """Read one authored name. Never fails."""
    tokens, trust = word_split.read_words(name)
    trust *= _ALL_READ
    unread = tuple(word for word in tokens if not word_split.is_known(word))
    unknown = NameReading(name, tuple(tokens), None, _UNKNOWN, unread=unread, material=_material_in(tokens))
    if _PRIMITIVE.fullmatch(name.strip()):
        return unknown
    counted, attached = word_split.counted_words(name), word_split.words_with_number(name)
    nouns = _without_robot(tokens, _nouns(tokens, counted | attached))
    clause, remark = _before_preposition(tokens, nouns), _before_remark(name, tokens, nouns)
    said = tokens[remark:]
    clause = min(clause, remark)
    nouns = [noun for noun in nouns if noun.end <= clause]
    if not nouns:
        robot, trust = _robot_of_link(name, tokens), round(trust * _UNREAD_BEFORE, 3)
        link = " ".join(tokens)
        return unknown if robot is None else replace(unknown, row=robot, confidence=trust, head=link, unread=())
    head = _head(tokens, nouns, counted, attached)
    head = (
        _of_a_kind(tokens, head, clause) or _kind_after(tokens[:clause], head) or _of_a_bolt(name, tokens, head) or head
    )
    turned = _object_first(tokens[:clause], nouns)
    if turned is not None:
        trust *= 1.0 if turned.row is head.row else _OBJECT_FIRST
        head = turned
    if _is_robot_part(name, tokens, head):
        head = _Noun(_row("robotpart"), head.start, len(tokens), plural=False)
    elif head.row.vibrates and _is_thing_of_machine(tokens[head.end : clause], attached):
        return unknown
    in_nouns = {i for noun in (*nouns, head) for i in range(noun.start, noun.end)}
    behind = tuple(tokens[i] for i in range(head.end, clause) if i not in in_nouns and not _is_beside(tokens[i]))
    before = tuple(word for word in tokens[: head.start] if word in unread)
    toy = words.TOY_WORDS | words.STUFFED if head.row.material == _ANIMAL else words.TOY_WORDS
    trust *= (_UNREAD_BEFORE if before else 1.0) * (_UNREAD_AFTER if behind else 1.0)
    kinds = {i for noun in nouns if noun.end - noun.start > 1 for i in range(noun.start, noun.end)}
    rest = [word for i, word in enumerate(tokens) if i < clause and i not in kinds and not head.start <= i < head.end]
    return NameReading(
        name,
        tuple(tokens),
        head.row,
        round(trust, 3),
        head=" ".join(tokens[head.start : head.end]),
        unread=before + behind,
        material=_material_in([*rest, *said]),
        toy=not toy.isdisjoint((*tokens[: head.start], *said)),
        whole=_whole(tokens, head, nouns),
    )


def places_named(name: str) -> tuple[str, ...]:
    """Return the kinds of place in a name's words, each once."""
    found = (words.PLACE_WORDS.get(word) for word in word_split.read_words(name)[0])
    return tuple(dict.fromkeys(place for place in found if place is not None))


def _material_in(tokens: Sequence[str]) -> str | None:
    return next((words.MATERIAL_WORDS[word] for word in tokens if word in words.MATERIAL_WORDS), None)


def _nouns(tokens: Sequence[str], counted: frozenset[str]) -> list[_Noun]:
    """Return the table's nouns in a name, longest first from the right, without overlap; in reading order.

    A number divides nouns: "table_4_legs" has no table leg. `counted` are the words after a number.
    """
    found = []
    end = len(tokens)
    while end > 0:
        longest = 1 if tokens[end - 1] in counted else _LONGEST_NOUN
        for start in range(max(0, end - longest), end):
            noun = _noun_at(tokens, start, end)
            if noun is not None:
                found.append(noun)
                end = start
                break
        else:
            end -= 1
    return found[::-1]


def _noun_at(tokens: Sequence[str], start: int, end: int) -> _Noun | None:
    last = tokens[end - 1]
    for form in words.forms(last):
        spelled = (*tokens[start : end - 1], form)
        entry = word_split.nouns().get("".join(spelled))
        # "Table_T" is no tablet: a single letter belongs to a noun only if the table writes it so ("x box").
        if entry is not None and (spelled == entry[1] or min(map(len, spelled)) > 1):
            return _Noun(entry[0], start, end, plural=form != last)
    return None


def _without_robot(tokens: Sequence[str], nouns: Sequence[_Noun]) -> list[_Noun]:
    """Return the nouns but for those that name a joint, a limb, a hand or the make of a robot, and no object.

    The leg of something else that the name says is no limb.
    """
    left = [noun for noun in nouns if not _is_beside_one(tokens, noun, words.ROBOT_NOUNS)]
    return [] if len(left) == 1 and _is_beside_one(tokens, left[0], words.ROBOT_LIMBS) else left


def _is_beside_one(tokens: Sequence[str], noun: _Noun, needed: Mapping[str, frozenset[str]]) -> bool:
    beside = needed.get(" ".join(tokens[noun.start : noun.end]))
    return beside is not None and not beside.isdisjoint(tokens)


def _is_thing_of_machine(after: Sequence[str], attached: frozenset[str]) -> bool:
    """Return True if a word behind a machine says that the object is another one; a "nas_4bay" is a server."""
    ends = {*after[:1], *after[-1:]} - attached
    return any(form in words.NO_MACHINES for word in ends for form in words.forms(word))


def _is_robot_part(name: str, tokens: Sequence[str], head: _Noun) -> bool:
    """Return True if a name begins with a robot's and goes on with a part's; the base stands for the whole robot.

    Without a namespace (`robot0_`, `robot:`) the word "link" or "joint" must be there: a "robot_kuka" is a robot.
    """
    after = tokens[head.end :]
    is_base = "base" in after or ([*after] == ["link"] and _LINK_0.search(name.strip()) is not None)
    if head.row.noun not in words.ROBOTS or is_base or words.WHOLE_ROBOT.issuperset(after):
        return False
    return _NAMESPACE.search(name) is not None or not {"link", "joint"}.isdisjoint(after)


def _robot_of_link(name: str, tokens: Sequence[str]) -> ObjectRow | None:
    """Return the row of a robot or of its part if a name is that of a link, by its joint or make; else None.

    The base of a finger is no robot, and a "finger_link_0" the first of several.
    """
    is_link = not {"link", "joint"}.isdisjoint(tokens)
    has_joint, has_axis, has_make, has_limb = (
        not named.isdisjoint(tokens)
        for named in (words.ROBOT_JOINTS, words.ROBOT_AXES, words.ROBOT_MAKES, words.ROBOT_LIMBS.keys())
    )
    nouns = _nouns(tokens, frozenset())
    is_named = (is_link and (has_joint or has_make)) or (has_joint and has_axis) or _HAND_LINK.search(name)
    if not is_named and len(_without_robot(tokens, nouns)) == len(nouns):
        return None
    is_base = "base" in tokens or _LINK_0.search(name.strip()) is not None
    return _row("robot" if is_base and not (has_joint or has_limb) else "robotpart")


def _row(spelled: str) -> ObjectRow:
    return word_split.nouns()[spelled][0]


def _before_preposition(tokens: Sequence[str], nouns: Sequence[_Noun]) -> int:
    """Return the index of the first preposition after a noun and outside nouns ("chest of drawers" is one noun)."""
    for i, word in enumerate(tokens):
        inside = any(noun.start <= i < noun.end for noun in nouns)
        if word in words.PREPOSITIONS and not inside and any(noun.end <= i for noun in nouns):
            return i
    return len(tokens)


def _before_remark(name: str, tokens: Sequence[str], nouns: Sequence[_Noun]) -> int:
    """Return the number of words before a remark in parentheses, if one of them is a noun; else that of all words."""
    before = len(word_split.read_words(name.partition("(")[0])[0])
    return before if any(noun.end <= before for noun in nouns) else len(tokens)


def _of_a_kind(tokens: Sequence[str], head: _Noun, clause: int) -> _Noun | None:
    """Return the noun of the table that "X of Y" means (Y X), or None."""
    if tokens[clause : clause + 1] != ["of"] or head.end != clause:
        return None
    kind = tokens[clause + 1 :]
    spelled = ([*kind[start:], *tokens[head.start : head.end]] for start in range(len(kind)))
    found = (_noun_at(written, 0, len(written)) for written in spelled if len(written) <= _LONGEST_NOUN)
    return next((_Noun(noun.row, head.start, head.end, head.plural) for noun in found if noun is not None), None)


def _kind_after(tokens: Sequence[str], head: _Noun) -> _Noun | None:
    """Return the noun of the table that a noun means with the adjective behind it (wheelchair_electric), or None."""
    adjective = tokens[head.end : head.end + 1]
    written = [*adjective, *tokens[head.start : head.end]]
    noun = _noun_at(written, 0, len(written)) if adjective and adjective[0] in words.KINDS else None
    return noun and _Noun(noun.row, head.start, head.end + 1, head.plural)


def _of_a_bolt(name: str, tokens: Sequence[str], head: _Noun) -> _Noun | None:
    """Return the ring or nut of a bolt that a noun means beside the size of a thread, or None."""
    written = ["bolt", *tokens[head.start : head.end]]
    noun = _noun_at(written, 0, len(written)) if _THREAD.search(name) else None
    return noun and _Noun(noun.row, head.start, head.end, head.plural)


def _head(tokens: Sequence[str], nouns: Sequence[_Noun], counted: frozenset[str], attached: frozenset[str]) -> _Noun:
    """Return the noun that names the object: the last, but for leftovers, materials, rooms, content, openings, counts.

    The number of a machine is a serial: "truck_2_wheels" are the wheels of one truck. A number that is written onto a
    noun counts it: a "fan_3blade" is a fan, a "ladder_6step" a ladder, a "truck_2wheels" a truck.
    """
    left = list(nouns)
    while len(left) > 1:
        last, previous = left[-1], left[-2]
        word = " ".join(tokens[last.start : last.end])
        is_material = word in words.MATERIAL_NOUNS and not previous.row.vibrates
        held = last.row.role in _HOLDS.get(previous.row.role, ())
        # A vessel counts as content of a container only in the plural: "crate_bottles", but "box_plate".
        is_content = held and (last.plural or last.row.role == "content")
        is_opening = previous.row.noun in words.SHELLS and last.row.noun in words.OPENINGS
        first = tokens[last.start]
        is_counted = first in attached or (first in counted and not previous.row.vibrates and _is_countable(last.row))
        is_general = word in words.GENERAL_NOUNS and previous.row.vibrates
        is_beside = word in words.LEFTOVER_NOUNS or word in words.ROOM_NOUNS or is_material or is_general
        if not (is_beside or is_content or is_opening or is_counted):
            break
        left.pop()
    return left[-1]


def _is_countable(row: ObjectRow) -> bool:
    return row.role == "part" or row.noun in words.COUNTED


def _object_first(tokens: Sequence[str], nouns: Sequence[_Noun]) -> _Noun | None:
    """Return a two-word noun written object first ("table coffee"), with only side words between and after, or None."""
    telling = [
        i
        for i, word in enumerate(tokens)
        if len(word) > 1 and (word not in word_split.side_words() or any(noun.start <= i < noun.end for noun in nouns))
    ]
    telling = [i for i in telling if tokens[i] not in words.MATERIAL_NOUNS | words.LEFTOVER_NOUNS] or telling
    if len(telling) < 2:
        return None
    first, second = telling[-2:]
    is_one = any(noun.start <= first and second < noun.end for noun in nouns)
    if is_one or _is_of_machine(nouns, first, second):
        return None
    entry = word_split.nouns().get(tokens[second] + tokens[first])
    if entry is None or entry[1] != (tokens[second], tokens[first]) or _noun_at((tokens[first], tokens[second]), 0, 2):
        return None
    return _Noun(entry[0], first, second + 1, plural=False)


def _is_of_machine(nouns: Sequence[_Noun], first: int, second: int) -> bool:
    """Return True if a machine is followed by its part or by what it works with: "sander_belt", "printer_label"."""
    before, after = (next((noun for noun in nouns if noun.start == i), None) for i in (first, second))
    if before is None or after is None or before.row.noun in words.GENERAL_NOUNS:
        return False
    return before.row.vibrates and after.row.role in ("part", "content")


def _whole(tokens: Sequence[str], head: _Noun, nouns: Sequence[_Noun]) -> ObjectRow | None:
    """Return the owner of a part: the noun before it, unless that is its material (glass door)."""
    before = [noun for noun in nouns if noun.end <= head.start]
    if head.row.role != "part" or not before or tokens[before[-1].end - 1] in words.MATERIAL_WORDS:
        return None
    return before[-1].row


def _is_beside(word: str) -> bool:
    """Return True if a word after the noun does not change the object: a side, a room, a material, a serial."""
    return len(word) < 3 or any(
        form in word_split.side_words() or form in words.MATERIAL_WORDS for form in words.forms(word)
    )
