"""A file of touches and moves over time, in place of a game.

docs/touches.md describes the JSON and CSV forms. Times are seconds from the start, points are world metres at that
moment. A hand that touches an object stays on it, and follows its moves, until it lifts or touches another object.
"""

from __future__ import annotations

import csv
import os
from itertools import pairwise
from typing import Annotated, Any, ClassVar, Literal

from pydantic import BaseModel, ConfigDict, Discriminator, Field, PrivateAttr, Tag, ValidationError, model_validator

from scene2hap.common import checks
from scene2hap.common.calls import clear_attributes
from scene2hap.common.counted import counted
from scene2hap.common.csv_tables import csv_reader, with_point
from scene2hap.common.files import read_small_text
from scene2hap.common.json_fields import Flag, Real, VersionOne, Yes
from scene2hap.common.json_texts import parse_json
from scene2hap.errors import SessionError, reason_of
from scene2hap.scene.limits import MAX_COORDINATE_M

FORMAT: Literal["scene2hap/touches"] = "scene2hap/touches"
VERSION: Literal[1] = 1

MIN_DURATION_S = 0.001
"""A shorter track may have no sample at all."""
MAX_DURATION_S = 600.0
"""Assumed: demonstrations and trials take minutes; this is also the longest duration of a sound."""
MAX_STEPS = 100_000
"""Assumed: more than two hands need that move in each of 60 frames a second for `MAX_DURATION_S`."""

_Coordinate = Annotated[Real, Field(ge=-MAX_COORDINATE_M, le=MAX_COORDINATE_M)]
_Point = tuple[_Coordinate, _Coordinate, _Coordinate]
_TOUCHES = "touches"
_ACTIONS = ("touch", "lift", "move", "source")


class _Step(BaseModel):
    """What every step has: its time from the start [s]."""

    model_config: ClassVar[ConfigDict] = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)

    time_s: Real = Field(ge=0.0)


class TouchStep(_Step):
    """A hand touches an object: at a point, or in the middle of its dominant surface.

    If the hand is on the object already, it slides to the point within `glide_s` [s].
    """

    hand: str
    touch: str
    point_m: _Point | None = None
    glide_s: Real = Field(default=0.0, ge=0.0)


class LiftStep(_Step):
    """A hand leaves its object."""

    hand: str
    lift: Yes


class MoveStep(_Step):
    """An object moves to a position, or by an offset, in `glide_s` seconds. `rotation_xyzw` None keeps its rotation."""

    move: str
    to_m: _Point | None = None
    by_m: _Point | None = None
    rotation_xyzw: tuple[_Coordinate, _Coordinate, _Coordinate, _Coordinate] | None = None
    glide_s: Real = Field(default=0.0, ge=0.0)

    @model_validator(mode="after")
    def _one_target(self) -> MoveStep:
        if (self.to_m is None) == (self.by_m is None):
            raise ValueError("give either to_m or by_m")
        return self


class SourceStep(_Step):
    """A source is switched on or off, to a state, or to a level."""

    source: str
    on: Flag | None = None
    state: str | None = None
    gain_db: Real | None = None


def _action(step: Any) -> str | None:
    keys = step if isinstance(step, dict) else getattr(type(step), "model_fields", {})
    return next((action for action in _ACTIONS if action in keys), None)


Step = Annotated[
    Annotated[TouchStep, Tag("touch")]
    | Annotated[LiftStep, Tag("lift")]
    | Annotated[MoveStep, Tag("move")]
    | Annotated[SourceStep, Tag("source")],
    Discriminator(_action),
]


@clear_attributes
class TouchTrack(BaseModel):
    """Recorded touches, moves and switches in order of time, as a file of touches has them; and their duration [s]."""

    model_config: ClassVar[ConfigDict] = ConfigDict(frozen=True, extra="forbid")

    format: Literal["scene2hap/touches"] = FORMAT
    version: VersionOne = VERSION
    duration_s: Real = Field(ge=MIN_DURATION_S, le=MAX_DURATION_S, allow_inf_nan=False)
    steps: tuple[Step, ...] = Field(max_length=MAX_STEPS)
    _name: str = PrivateAttr(default=_TOUCHES)

    def __init__(self, *unnamed: Any, **fields: Any) -> None:
        if unnamed:
            raise SessionError(
                f"TouchTrack is given {checks.described(unnamed[0])}; it takes duration_s= and steps=. "
                "TouchTrack.load(path) reads a file, TouchTrack.parse(document) plain values."
            )
        try:
            super().__init__(**fields)
        except ValidationError as cause:
            raise SessionError(f"{_TOUCHES}: {_sentence(checks.first_problem(cause))} See docs/touches.md.") from cause

    @property
    def name(self) -> str:
        """The file that the track was read from, for messages."""
        return self._name

    def __repr__(self) -> str:
        return f"TouchTrack({counted(len(self.steps), 'step')}, {self.duration_s:g} s)"

    def __str__(self) -> str:
        return repr(self)

    def __eq__(self, other: object) -> bool:
        """Compare the contents: tracks of two files may be equal."""
        if not isinstance(other, TouchTrack):
            return NotImplemented
        return (self.duration_s, self.steps) == (other.duration_s, other.steps)

    @model_validator(mode="after")
    def _in_order(self) -> TouchTrack:
        for number, (earlier, later) in enumerate(pairwise(self.steps), start=2):
            if later.time_s < earlier.time_s:
                raise ValueError(f"step {number} is at {later.time_s} s, before the one above it at {earlier.time_s} s")
        if self.steps and self.steps[-1].time_s > self.duration_s:
            raise ValueError(f"the last step is at {self.steps[-1].time_s} s, after the end at {self.duration_s} s")
        return self

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> TouchTrack:
        """Read a .json or .csv file.

        Raises: SessionError: it cannot be read, or a step is wrong; the message names step and field.
        """
        path = checks.path("path", path, error=SessionError)
        try:
            text = read_small_text(path)
            document = _from_csv(text) if path.suffix.lower() == ".csv" else parse_json(text)
        except (OSError, ValueError, csv.Error) as cause:
            raise SessionError(f"{path} cannot be read as touches: {reason_of(cause)}. See docs/touches.md.") from cause
        return cls.parse(document, str(path))

    @classmethod
    def parse(cls, document: Any, name: str = _TOUCHES) -> TouchTrack:
        """Make a track from plain values. Raises: SessionError."""
        if not isinstance(document, dict) or not all(isinstance(key, str) for key in document):
            raise SessionError(f"{name}: whole file: it must be an object with duration_s and steps.")
        steps = document.get("steps")
        if isinstance(steps, (list, tuple)) and len(steps) > MAX_STEPS:  # before each step is validated
            raise SessionError(f"{name}: steps: {len(steps)} items; at most {MAX_STEPS} items. See docs/touches.md.")
        try:
            track = cls(**document)
        except SessionError as cause:
            raise SessionError(f"{name}{str(cause).removeprefix(_TOUCHES)}") from cause
        track._name = name
        return track


_WANTED = {
    "extra_forbidden": "there is no such field in this step",
    "union_tag_not_found": f"a step has one of the fields {', '.join(_ACTIONS)}",
}
"""Reasons for pydantic's kinds of problems that say more about a step than those of `checks`."""


def _sentence(problem: checks.Problem) -> str:
    """Return place, reason and value of a problem, and that times are in seconds if one is out of bounds."""
    field = str(problem.location[-1]) if problem.location else ""
    wanted = "lift must be true" if field == "lift" else _WANTED.get(problem.kind, "")
    if problem.kind == "union_tag_not_found" and isinstance(problem.value, dict) and "hand" in problem.value:
        wanted = "a step with a hand also has touch, the id of an object, or lift, which is true"
    is_whole = problem.kind == "value_error" or isinstance(problem.value, dict | list | tuple)
    got = "" if is_whole else f", got {checks.shown(problem.value)}"
    hint = " Times are in seconds." if field.endswith("_s") and problem.kind.startswith(("less_", "greater_")) else ""
    return f"{_place(problem.location)}: {wanted or problem.reason}{got}.{hint}"


def _place(location: tuple[int | str, ...]) -> str:
    """Return the place of an error in a file, in the user's terms: "step 3, point_m.1"."""
    if location[:1] == ("steps",) and len(location) > 1:
        field = ".".join(str(part) for part in location[2:] if part not in _ACTIONS)[:200]
        return f"step {int(location[1]) + 1}{', ' + field if field else ''}"
    return ".".join(map(str, location))[:200] or "whole file"


def _from_csv(text: str) -> dict[str, Any]:
    """Parse a CSV file with a row per step. Empty cells are left out. A row with only time_s ends the track."""
    steps: list[dict[str, Any]] = []
    rows = csv_reader(text)
    named = [name.strip() for name in next(rows, [])]
    if "time_s" not in named:
        near = [
            f"; name {checks.represented(name)} time_s, and give seconds"
            for name in named
            if checks.did_you_mean(name, ["time_s"])
        ]
        has = f"it names {checks.represented(named)[1:-1]}" if named else "the file is empty"
        raise ValueError(f"the first row must name the columns, time_s among them; {has}{''.join(near[:1])}")
    twice = [name for place, name in enumerate(named) if name and name in named[:place]]
    if twice:
        raise ValueError(f"two columns are named {checks.represented(twice[0])}; remove one")
    for row in rows:
        if any(cell.strip() for cell in row[len(named) :]):
            raise ValueError(
                f"line {rows.line_num} has {len(row)} cells for {len(named)} columns; quote texts with commas"
            )
        cells = {name: cell.strip() for name, cell in zip(named, row, strict=False) if name and cell.strip()}
        if not cells:
            continue
        values = {name: _value(name, cell) for name, cell in cells.items()}
        step: dict[str, Any] = {key: value for key, value in values.items() if key not in _VECTOR_CELLS}
        for name, columns in _VECTORS.items():
            if any(column in values for column in columns):
                step[name] = [values.get(column, 0.0) for column in columns]
        steps.append(step)
    if not steps or set(steps[-1]) != {"time_s"}:
        raise ValueError("the last row must hold time_s alone, the end of the track")
    return {"duration_s": steps[-1]["time_s"], "steps": steps[:-1]}


def _value(column: str, cell: str) -> bool | float | str:
    """Return the name, the flag or the number in a cell. Any other text stays one, which no step takes."""
    if column in _NAMES:
        return cell
    if column in _FLAGS:
        return _TRUTH.get(cell.lower(), cell)
    try:
        return float(with_point(cell))
    except ValueError:
        return cell


_NAMES = ("hand", "touch", "move", "source", "state")
_FLAGS = ("on", "lift")
_TRUTH = {"true": True, "1": True, "false": False, "0": False}
_VECTORS = {
    "point_m": ("x_m", "y_m", "z_m"),
    "to_m": ("to_x_m", "to_y_m", "to_z_m"),
    "by_m": ("by_x_m", "by_y_m", "by_z_m"),
    "rotation_xyzw": ("qx", "qy", "qz", "qw"),
}
_VECTOR_CELLS = {column for columns in _VECTORS.values() for column in columns}
