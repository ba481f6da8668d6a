"""The common settings of all loops of a bundle."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any

from scene2hap.audio.spreading import SpreadLimits
from scene2hap.common import checks
from scene2hap.errors import BundleError, ConfigError
from scene2hap.haptics import ActuatorProfile


@dataclass(frozen=True)
class MadeWith:
    """The settings of a bake that decide how a loop is made from its sound.

    `tactile` is the configuration of the converter: its `kind` and settings. A converter that was given ready made and
    is not registered has a `class` instead, and cannot be built again. `seed` is the seed of synthesized sounds.
    """

    actuator: ActuatorProfile
    tactile: Mapping[str, Any]
    spread: SpreadLimits
    seed: int = 0

    def to_document(self) -> dict[str, Any]:
        """Return JSON values."""
        return {
            "actuator": asdict(self.actuator),
            "tactile": dict(self.tactile),
            "spread": self.spread.model_dump(),
            "seed": self.seed,
        }

    @classmethod
    def from_document(cls, document: object, place: str) -> MadeWith | None:
        """Read the result of `to_document`; None gives None, as in older bundles. `place` is its name in errors.

        Raises: BundleError: it is not such a result.
        """
        if document is None:
            return None
        named = document.get("actuator") if isinstance(document, dict) else None
        if isinstance(named, str):
            raise BundleError(
                f"{place}: made_with.actuator is {checks.shown(named)}; it must be an object with the bounds of the "
                "actuator. To choose another one: scene2hap edit BUNDLE rebake --actuator NAME."
            )
        try:
            fields = dict(document)  # type: ignore[call-overload]  # the except clause handles other types
            tactile, seed = fields["tactile"], fields["seed"]
            if not isinstance(tactile, dict):
                raise TypeError("tactile must be an object")
            seed = checks.seed(seed)
            actuator = ActuatorProfile(**fields["actuator"])
            return cls(actuator, tactile, SpreadLimits.parse(fields["spread"]), seed)
        except (ConfigError, KeyError, TypeError, ValueError) as cause:
            why = f"lacks {cause}" if isinstance(cause, KeyError) else f"is wrong: {str(cause).removesuffix('.')}"
            raise BundleError(f"{place}: made_with {why}. Remove made_with, or bake again.") from cause
