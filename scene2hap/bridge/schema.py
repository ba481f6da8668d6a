"""The JSON schema of the bridge's text messages, for authors of clients.

    python -m scene2hap.bridge.schema > docs/bridge.schema.json

Requests are generated from the types that the server reads. Answers are defined here; tests check every message of the
server against them.
"""

from __future__ import annotations

import json
from typing import Annotated, Any, ClassVar, Literal

from pydantic import BaseModel, ConfigDict, Field, TypeAdapter

from scene2hap.bridge.messages import MODELS, Number, Point

Index = Annotated[int, Field(ge=0)]


class Answer(BaseModel):
    """A message of the server. `re` is the id of the request that it answers."""

    model_config: ClassVar[ConfigDict] = ConfigDict(extra="allow")

    type: str
    re: int | None = None


class Welcome(Answer):
    """The answer to `hello`."""

    type: Literal["welcome"]
    version: Literal[1]
    server: str
    max_message_bytes: Index
    heartbeat_s: Number
    sink: str | None
    udp_port: int | None
    models: list[str]


class Baking(Answer):
    """The answer to `bake`."""

    type: Literal["baking"]
    job: Index


class Progress(Answer):
    """Progress of a bake."""

    type: Literal["progress"]
    job: Index
    stage: str
    item: str
    done: Index
    of: Index


class BakedObject(BaseModel):
    """Inferred properties of an object."""

    id: str
    category: str
    material: str
    vibrates: bool
    states: list[str]


class Baked(Answer):
    """The end of a bake."""

    type: Literal["baked"]
    job: Index
    objects: list[BakedObject]


class Cancelled(Answer):
    """The answer to `cancel`."""

    type: Literal["cancelled"]
    job: Index


class Source(BaseModel):
    """The present state of a vibrating object: `SourceInfo` without `is_running` and `progress`."""

    id: str
    state: str
    states: list[str]
    is_on: bool
    frequency_hz: Number
    gain_db: Number
    is_muted: bool


class Order(Answer):
    """The order of objects, hands and sources in binary frames."""

    type: Literal["order"]
    layout: Annotated[int, Field(ge=1, le=65535)]
    objects: list[str]
    n_moving: Index
    hands: list[str]
    sources: list[Source]
    n_bands: Annotated[int, Field(ge=1)]
    sequence: Index
    watchdog_s: Number


class Watching(Order):
    """The answer to `watch`."""

    type: Literal["watching"]  # type: ignore[assignment]  # the same fields under another type
    session: str


class Playing(Order):
    """The answer to `play` and `resume`."""

    type: Literal["playing"]  # type: ignore[assignment]  # the same fields under another type
    session: str
    key: Annotated[str, Field(pattern="^[0-9a-f]{16}$")]
    sink: str | None
    udp_port: int | None


class Done(Answer):
    """The answer to requests without a result."""

    type: Literal["done", "left"]


class Explanation(Answer):
    """Explanation of the vibration at a hand."""

    type: Literal["explanation"]
    hand: str
    touches: list[str]
    felt: list[dict[str, Any]]
    text: str


class Frames(BaseModel):
    """Counters of frames."""

    received: Index
    skipped: Index
    outdated: Index


class SinkCounters(BaseModel):
    """Counters of the server's sink, and of the samples that its safety layer changed; sinks may have more."""

    model_config: ClassVar[ConfigDict] = ConfigDict(extra="allow")

    frames: Index
    underruns: Index
    connected: bool
    reconnects: Index
    dropped_frames: Index
    faults: Index
    latency_s: Number | None
    watchdog_trips: Index


class Counters(Answer):
    """Counters of the session; the answer to `stats`."""

    type: Literal["stats"]
    updates: Index
    frames: Frames
    sink: SinkCounters | None


class Impact(Answer):
    """An object landed or was struck, and a hand felt it."""

    type: Literal["impact"]
    object: str
    with_object: str | None
    point_m: Point
    frequency_hz: Number
    felt: dict[str, Number]


class State(Answer):
    """State of the session that a client watches."""

    type: Literal["state"]
    session: str
    is_: Annotated[Literal["playing", "waiting", "ended"], Field(alias="is")]


class Warned(Answer):
    """A warning for the player, or about a bake."""

    type: Literal["warning"]
    message: str
    job: int | None = None


class Error(Answer):
    """An error: the given value, the expected one, and the next step."""

    type: Literal["error"]
    error: str
    message: str
    job: int | None = None


ANSWERS: tuple[type[Answer], ...] = (
    *(Welcome, Baking, Progress, Baked, Cancelled, Playing, Watching, Order, Done, Explanation, Counters),
    *(Impact, State, Warned, Error),
)


def schema() -> dict[str, Any]:
    """Return the schema (JSON Schema, 2020-12) of all text messages, with all types under `$defs`."""
    models: tuple[type[BaseModel], ...] = (*MODELS.values(), *ANSWERS)
    adapters: list[tuple[str, Any, TypeAdapter[Any]]] = [
        (model.__name__, "validation", TypeAdapter(model)) for model in models
    ]
    _, found = TypeAdapter.json_schemas(adapters, ref_template="#/$defs/{model}")
    names = found["$defs"]
    requests, answers = ([model.__name__ for model in models] for models in (MODELS.values(), ANSWERS))
    names["AnyRequest"] = {"anyOf": [{"$ref": f"#/$defs/{name}"} for name in requests]}
    names["AnyAnswer"] = {"anyOf": [{"$ref": f"#/$defs/{name}"} for name in answers]}
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "Text messages of a scene2hap bridge, version 1",
        "description": "docs/bridge-protocol.md describes each message.",
        "anyOf": [{"$ref": "#/$defs/AnyRequest"}, {"$ref": "#/$defs/AnyAnswer"}],
        "$defs": names,
    }


if __name__ == "__main__":
    print(json.dumps(schema(), indent=1))
