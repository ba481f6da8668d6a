"""The lexicon's table of everyday objects, one row per head noun.

`table.csv` gives for each noun its other names, the places where it stands, and the material and thickness of its
dominant surface. It also gives the span of its longest edge, its use, and the states in which it vibrates by itself.
Each row names its source. Intensities are assumed, on the scale of `haptics.SourceState`; their ranking follows
published hand-arm vibration if there is any. Thicknesses and sizes are assumed unless the row's source says otherwise.
Masses are of usual products of usual size (shop listings and data sheets, from memory). `usual_boxes.csv` has these
sizes, also from memory, for nouns whose objects differ much in size.

`role` resolves names that hold two nouns: a "container" or "vessel" may be followed by its "content"
(crate_tomatoes); a "part" belongs to the noun before it (oven_door). A "vehicle" that is far too small is a toy.
"""

from __future__ import annotations

import csv
import hashlib
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import Literal, cast

Role = Literal["", "container", "vessel", "content", "part", "vehicle"]

PLACES = (
    "kitchen",
    "bathroom",
    "laundry",
    "living-room",
    "bedroom",
    "office",
    "workshop",
    "garden",
    "building-site",
    "gym",
    "hospital",
    "street",
    "warehouse",
)
"""Kinds of place in the table; a row may also stand in "any"."""


@dataclass(frozen=True)
class StateRow:
    """One way to vibrate: state name, intensity 0..1 [-], a verb for its sound, and the contact that it needs.

    `needs_contact` holds nouns. One of them must touch the object (a pan sizzles on a stove); empty means no condition.
    """

    name: str
    intensity: float
    verb: str
    needs_contact: tuple[str, ...] = ()


@dataclass(frozen=True)
class ObjectRow:
    """One everyday object. `min_size_m` and `max_size_m` bound its longest edge [m], or are None.

    `mass_kg` is its usual mass [kg], None if masses differ too much. `feet` is the material of its feet, or None.
    """

    noun: str
    synonyms: tuple[str, ...]
    places: tuple[str, ...]
    material: str
    thickness_m: float
    min_size_m: float | None
    max_size_m: float | None
    mass_kg: float | None
    feet: str | None
    role: Role
    usage: str
    vibrates: bool
    states: tuple[StateRow, ...]
    source: str


@cache
def table() -> tuple[ObjectRow, ...]:
    """Return every row, in the order of the file."""
    return tuple(_row(fields) for fields in rows_of("table.csv"))


@cache
def version() -> str:
    """Return a short digest of the tables, so that an answer's provenance changes exactly when a row does."""
    names = ("table.csv", "start_times.csv", "translations.csv", "usual_boxes.csv")
    rows = [line for name in names for line in text_of(name).splitlines()]
    return hashlib.sha256("\n".join(rows).encode()).hexdigest()[:8]


def rows_of(name: str) -> Iterator[dict[str, str]]:
    """Yield the rows of a CSV file of the lexicon."""
    return csv.DictReader(text_of(name).splitlines())


@cache
def text_of(name: str) -> str:
    """Return the content of a file of the lexicon."""
    return files(__package__).joinpath(name).read_text(encoding="utf-8")


def _row(fields: dict[str, str]) -> ObjectRow:
    return ObjectRow(
        noun=fields["noun"],
        synonyms=_split(fields["synonyms"], ";"),
        places=_split(fields["places"], ";"),
        material=fields["material"],
        thickness_m=float(fields["thickness_m"]),
        min_size_m=_optional(fields["min_size_m"]),
        max_size_m=_optional(fields["max_size_m"]),
        mass_kg=_optional(fields["mass_kg"]),
        feet=fields["feet"] or None,
        role=cast("Role", fields["role"]),
        usage=fields["usage"],
        vibrates=fields["vibrates"] == "yes",
        states=tuple(_state(text) for text in _split(fields["states"], ";")),
        source=fields["source"],
    )


def _state(text: str) -> StateRow:
    name, intensity, verb, *contact = text.split(":")
    return StateRow(name, float(intensity), verb, _split(contact[0], "/") if contact else ())


def _split(text: str, separator: str) -> tuple[str, ...]:
    return tuple(part for part in text.split(separator) if part)


def _optional(text: str) -> float | None:
    return float(text) if text else None
