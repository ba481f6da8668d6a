"""The JSON messages of clients; docs/bridge-protocol.md describes them."""

from __future__ import annotations

from typing import Annotated, Any, ClassVar, Literal, get_args

from pydantic import BaseModel, ConfigDict, Field, TypeAdapter, ValidationError

from scene2hap.common import checks
from scene2hap.common.json_fields import WHOLE, Flag, Real, Whole
from scene2hap.common.json_texts import has_surrogates, parse_json
from scene2hap.errors import BridgeError

VERSION = 1

Name = Annotated[str, Field(min_length=1, max_length=1000)]
RelativePath = Annotated[str, Field(min_length=1, max_length=4096)]
Number = Annotated[Real, Field(allow_inf_nan=False)]
Point = tuple[Number, Number, Number]
Document = dict[str, Any]


class Request(BaseModel):
    """A message of a client. The answer to it carries its `id` as `re`."""

    model_config: ClassVar[ConfigDict] = ConfigDict(extra="forbid", frozen=True, hide_input_in_errors=True)

    type: str
    id: Annotated[int, Field(ge=0, lt=2**53), WHOLE] | None = None


class Hello(Request):
    """The first message."""

    type: Literal["hello"]
    version: Whole
    client: Name
    token: str | None = Field(default=None, max_length=1000)


class Bake(Request):
    """Infer the objects of a scene and their vibration, and make a bundle."""

    type: Literal["bake"]
    scene: Document | None = None
    path: RelativePath | None = None
    config: Document = {}
    user_prompt: str = Field(default="", max_length=100_000)
    pictures: Flag = False
    save: RelativePath | None = None


class Cancel(Request):
    """End a bake."""

    type: Literal["cancel"]
    job: Whole


class Follow(Request):
    """Receive the messages of a bake that another connection began."""

    type: Literal["follow"]
    job: Whole


class Play(Request):
    """Begin a session."""

    type: Literal["play"]
    bundle: RelativePath | None = None
    job: Whole | None = None
    scene: Document | None = None
    session: Document = {}
    user: Document | None = None
    hands: list[Name] = Field(default=["left", "right"], min_length=1, max_length=64)
    moving: list[Name] | None = None
    frames: Literal["newest", "every"] = "newest"
    keep_s: Number = Field(default=30.0, ge=0.0, le=600.0)
    use_sink: Flag = True


class Resume(Request):
    """Continue a session whose connection was lost."""

    type: Literal["resume"]
    session: Name
    key: str = Field(min_length=16, max_length=16)


class Watch(Request):
    """Receive the gains of a session that another client plays."""

    type: Literal["watch"]
    session: Name


class Moving(Request):
    """Choose the objects that have poses in frames."""

    type: Literal["moving"]
    moving: list[Name]


class SetSource(Request):
    """Switch a source, choose its state, or set its level."""

    type: Literal["set_source"]
    source: Name
    on: Flag | None = None
    state: str | None = None
    gain_db: Number | None = None
    mute: Flag | None = None


class SetUser(Request):
    """Set the overall level, or the profile of the player."""

    type: Literal["set_user"]
    gain_db: Number | None = None
    mute: Flag | None = None
    profile: Document | None = None


class StrikeObject(Request):
    """Strike an object."""

    type: Literal["strike"]
    object: Name
    point_m: Point
    speed_m_s: Number | None = None
    impulse_n_s: Number | None = None
    with_object: Name | None = None


class Add(Request):
    """Add an object to the scene."""

    type: Literal["add"]
    object: Document


class Spawn(Request):
    """Add a copy of a prefab to the scene."""

    type: Literal["spawn"]
    object: Name
    position_m: Point
    rotation_xyzw: tuple[Number, Number, Number, Number] = (0.0, 0.0, 0.0, 1.0)
    prefab: RelativePath | None = None
    job: Whole | None = None


class Remove(Request):
    """Remove an object from the scene."""

    type: Literal["remove"]
    object: Name


class Pause(Request):
    """Fade out all vibration."""

    type: Literal["pause"]


class Unpause(Request):
    """Continue after a pause."""

    type: Literal["unpause"]


class Explain(Request):
    """Report the vibration at a hand, and the paths from its sources."""

    type: Literal["explain"]
    hand: Name


class Stats(Request):
    """Report counters."""

    type: Literal["stats"]


class Leave(Request):
    """End the session, or stop watching."""

    type: Literal["leave"]


_REQUESTS: tuple[type[Request], ...] = (
    *(Hello, Bake, Cancel, Follow, Play, Resume, Watch, Moving, SetSource, SetUser, StrikeObject, Add, Spawn, Remove),
    *(Pause, Unpause, Explain, Stats, Leave),
)
MODELS: dict[str, type[Request]] = {get_args(model.model_fields["type"].annotation)[0]: model for model in _REQUESTS}
"""The requests by their type."""
_id: TypeAdapter[int] = TypeAdapter(Whole)


def read_document(text: str) -> Document:
    """Return the object in a text message. Raises: BridgeError: it is no JSON object."""
    try:
        found = parse_json(text)
        if not isinstance(found, dict):
            raise ValueError(f"it is {checks.described(found)}")
        if has_surrogates(text):
            raise ValueError("a text of it has half of a surrogate pair")
    except ValueError as cause:
        raise BridgeError(f"the message is no JSON object: {cause}. Send an object with a type.") from cause
    return found


def request_id(document: Document) -> int | None:
    """Return the number that an answer carries as `re`, None if the message has none."""
    try:
        return _id.validate_python(document.get("id"))  # as requests read it: some languages write 7 as 7.0
    except ValidationError:
        return None


def parse_request(document: Document) -> Request:
    """Return the request in a message. Raises: BridgeError: an unknown type or field, or a wrong value."""
    kind = document.get("type")
    model = MODELS.get(kind) if isinstance(kind, str) else None
    if model is None:
        near = checks.did_you_mean(kind, MODELS, f"The types are {', '.join(MODELS)}.")
        raise BridgeError(f"the type of the message is {checks.represented(kind)}, which does not exist. {near}")
    try:
        return model.model_validate(document)
    except ValidationError as cause:
        problem = checks.first_problem(cause)
        if problem.kind == "extra_forbidden":
            near = checks.did_you_mean(problem.place, model.model_fields, f"It has {', '.join(model.model_fields)}.")
            raise BridgeError(f"{kind} has no field {checks.represented(problem.place)}. {near}") from cause
        raise BridgeError(
            f"{problem.place} of {kind}: {problem.reason}{_got(problem)}. The page of the protocol has its fields."
        ) from cause


def _got(problem: checks.Problem) -> str:
    """Return the wrong value for an error; of a list or an object only that it is one, since it may be long."""
    if problem.kind == "missing":
        return ""
    given, name = problem.value, problem.location[-1]
    return f", got {checks.described(given) if isinstance(given, dict | list) else checks.shown(given, name)}"
