"""A session that follows a MuJoCo simulation."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from typing import Any, Literal

from scene2hap import checks
from scene2hap.engines.link import EngineLink
from scene2hap.errors import ConfigError
from scene2hap.scene.engines import mujoco as engine
from scene2hap.scene.objects import Contact
from scene2hap.scene.pose_table import PoseTable
from scene2hap.session import HapticSession, Touch


class MuJoCoLink(EngineLink):
    """Follows a model: `link.update()` after each `mj_step`.

    Parameters:
    model, data, geom_groups, unit_m : as `scene.engines.mujoco.snapshot` had them.
    hands : by the session's hands, the body of an actor that stands for each: where the engine has it in contact with
        an object, that hand touches the object; all contact points count, and the strongest is felt.
    contacts : None finds contacts between objects from geometry; "engine" takes the simulation's own.
    Raises: MissingExtra; SceneError: the session is of another model; ConfigError: no such hand or body.
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
        adapter = _MuJoCo(model, data, dict(hands or {}), contacts == "engine", geom_groups, unit_m)
        super().__init__(adapter, session)
        for hand, body in adapter.hands.items():
            if hand not in session.hands:
                raise ConfigError(f"the session has no hand {hand!r}; it has {', '.join(map(repr, session.hands))}.")
            session.snapshot.object(body)


class _MuJoCo:
    """See `EngineAdapter`."""

    def __init__(
        self,
        model: Any,
        data: Any,
        hands: dict[str, str],
        has_contacts: bool,
        geom_groups: Collection[int] | None,
        unit_m: float,
    ) -> None:
        self._model, self._data, self._has_contacts = model, data, has_contacts
        self._how: dict[str, Any] = {"geom_groups": geom_groups, "unit_m": unit_m}
        self.hands = hands

    def poses(self) -> PoseTable:
        return engine.poses(self._model, self._data, **self._how)

    def touches(self) -> Sequence[Touch]:
        if not self.hands:
            return ()
        found = []
        for contact in engine.contacts(self._model, self._data, of=set(self.hands.values()), **self._how):
            for hand, body in self.hands.items():
                if body in (contact.a, contact.b):
                    other = contact.b if body == contact.a else contact.a
                    found.append(Touch(hand, other, contact.point_m))
        return found

    def contacts(self) -> Sequence[Contact] | None:
        return engine.contacts(self._model, self._data, **self._how) if self._has_contacts else None
