"""A session that follows a MuJoCo simulation."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from typing import Any, Literal

from scene2hap.common import checks
from scene2hap.common.calls import clear_calls
from scene2hap.common.counted import first_of
from scene2hap.common.warning import warn_of
from scene2hap.engines.link import EngineLink
from scene2hap.errors import ConfigError
from scene2hap.scene.engines import mujoco as engine, mujoco_contacts
from scene2hap.scene.objects import Contact
from scene2hap.scene.pose_table import PoseTable
from scene2hap.session import HapticSession, Touch
from scene2hap.session.unknown_names import unknown_hand

_MOST_NAMED = 3


@clear_calls
class MuJoCoLink(EngineLink):
    """Let a session follow a running MuJoCo model: call `link.update()` once per frame, after `mj_step`.

    If a frame has several steps, call `link.collect()` after each of them.

    Parameters:
    model, data, geom_groups, unit_m : as for `scene.engines.mujoco.snapshot`.
    hands : by the session's hands, the body of an actor that represents the hand, with all bodies below it, such as
        fingers. If the engine has such a body in contact with an object, the hand touches the object. Each contact is a
        touch; with several touches, the strongest is felt.
    contacts : None finds contacts between objects from geometry; "engine" uses the contacts of the simulation.
    Raises: MissingExtra; SceneError: the session is of another model; ConfigError: no such hand; UnknownObject: no such
    body. Warns: SceneWarning: MuJoCo has no contacts between a hand and objects, since none of them can move by itself.
    """

    def __init__(
        self,
        model: Any,
        data: Any,
        session: HapticSession,
        *,
        hands: Mapping[str, str] | None = None,
        contacts: Literal["engine"] | None = None,
        geom_groups: Collection[int] | None = None,
        unit_m: float = 1.0,
    ) -> None:
        if contacts not in (None, "engine"):
            raise ConfigError(f"contacts is {checks.represented(contacts)}; it must be 'engine', or None.")
        if hands is not None and not isinstance(hands, Mapping):
            raise ConfigError(
                f"hands is {checks.represented(hands)}; it must be a mapping of hands to bodies, as {{'left': 'palm'}}."
            )
        self._data = data
        self._engine = _MuJoCo(model, data, hands or {}, contacts == "engine", geom_groups, unit_m)
        super().__init__(self._engine, session)
        for hand in hands or ():
            if hand not in session.hands:
                raise ConfigError(unknown_hand(hand, session.hands))
        self._engine.warn_of_fixed_hands(hands or {})

    def _step(self) -> mujoco_contacts.ContactPoints | None:
        # As arrays, since a step may have hundreds of contact points.
        return mujoco_contacts.contact_points(self._data) if self._engine.reports else None

    def _reported(self, steps: Sequence[Any]) -> tuple[Sequence[Touch], Sequence[Contact] | None]:
        if self._engine.reports:
            # From then on the adapter reports these points as those of one step.
            self._engine.points = steps[0] if len(steps) == 1 else mujoco_contacts.points_of_steps(steps)
        return super()._reported([super()._step()])


class _MuJoCo:
    """The `EngineAdapter` of MuJoCo."""

    def __init__(
        self,
        model: Any,
        data: Any,
        hands: Mapping[str, str],
        has_contacts: bool,
        geom_groups: Collection[int] | None,
        unit_m: float,
    ) -> None:
        self._model, self._data, self._has_contacts = model, data, has_contacts
        self._how: dict[str, Any] = {"geom_groups": geom_groups, "unit_m": unit_m}
        self._hands = {hand: mujoco_contacts.geoms_below(model, data, body) for hand, body in hands.items()}
        self.reports = has_contacts or bool(hands)
        self.points: mujoco_contacts.ContactPoints | None = None

    def warn_of_fixed_hands(self, bodies: Mapping[str, str]) -> None:
        for hand, part in self._hands.items():
            fixed = mujoco_contacts.out_of_reach(self._model, part, self._how["geom_groups"])
            if fixed:
                named = first_of([*map(repr, fixed)], _MOST_NAMED)
                warn_of(
                    f"MuJoCo moves neither {bodies[hand]!r} nor {named}, and finds no contacts between such bodies: "
                    f"hand {hand!r} does not feel them. Weld a free body to {bodies[hand]!r} and name that body as the "
                    "hand, or give touches to `update`."
                )

    def poses(self) -> PoseTable:
        return engine.poses(self._model, self._data, **self._how)

    def touches(self) -> Sequence[Touch]:
        return [
            Touch(hand, object_id, point_m)
            for hand, part in self._hands.items()
            for object_id, point_m in mujoco_contacts.touched(
                self._model, self._data, part, points=self.points, **self._how
            )
        ]

    def contacts(self) -> Sequence[Contact] | None:
        if not self._has_contacts:
            return None
        return mujoco_contacts.contacts(self._model, self._data, points=self.points, **self._how)
