"""The kind of place of a scene, by a vote of its objects."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from scene2hap.llm.lexicon.names import places_named, read_name
from scene2hap.llm.lexicon.table import PLACES

UNDEFINED = "undefined"

# Weights of the vote; assumed. Fractions keep ties exact in any order of the objects.
_OBJECT_NAMES_PLACE = Fraction(1, 2)  # "kitchenFridge"
_SCENE_NAMES_PLACE = Fraction(1, 2)  # authored scene names are often left over from another project
_ENOUGH = Fraction(1)
_ENOUGH_VOICES = 2  # a single word may be a misreading


def kind_of_place(scene_name: str, object_names: Sequence[str]) -> str:
    """Return the place to which most objects belong, such as "living room"; "undefined" on a tie or too few votes.

    Each noun votes once, even if it occurs often, since the number of chairs does not change a place. Its vote is
    divided among the places where the object may stand. Objects that may stand anywhere do not vote.
    """
    ballots: list[tuple[str, Fraction]] = []
    readings = [(read_name(name), name) for name in object_names]
    for row in {reading.row.noun: reading.row for reading, _ in readings if reading.row and not reading.toy}.values():
        ballots += [(place, Fraction(1, len(row.places))) for place in row.places]
    named = {(reading.row and reading.row.noun, place) for reading, name in readings for place in places_named(name)}
    ballots += [(place, _OBJECT_NAMES_PLACE) for _, place in named]
    ballots += [(place, _SCENE_NAMES_PLACE) for place in places_named(scene_name)]

    votes = {place: [weight for voted, weight in ballots if voted == place] for place in PLACES}
    ranking = sorted(((sum(weights, Fraction()), place) for place, weights in votes.items()), reverse=True)
    (most, winner), (second, _) = ranking[:2]
    enough = most >= _ENOUGH and len(votes[winner]) >= _ENOUGH_VOICES
    return winner.replace("-", " ") if enough and most > second else UNDEFINED
