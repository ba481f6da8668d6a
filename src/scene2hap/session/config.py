"""How a scene is played."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, ValidationError

from scene2hap import checks
from scene2hap.errors import ConfigError
from scene2hap.haptics import Bands
from scene2hap.propagation import MODELS
from scene2hap.propagation.exponential_plate import ExponentialPlate

MIN_RAMP_S = 0.010
"""Shortest time over which a gain change is spread; see `scene2hap.render.mixer`."""

MAX_GAIN_DB = 120.0
"""Bound on every gain, far beyond any actuator, so that single precision cannot overflow."""


class SessionConfig(BaseModel):
    """How a scene is played. Every part with alternatives is chosen by a `kind`, so that a table of TOML will do.

    propagation : a kind, a mapping with `kind` and settings, or a model; `scene2hap.propagation.MODELS` lists kinds.
    bands : bands in which gains are told; `Bands.dominant()` is the paper's.
    gain_limit_db : cap on what one source may gain at a hand by propagation, None for no cap.
    control_period_s : usual time between updates; gain changes are spread over it, and over at least 10 ms.
    """

    model_config = ConfigDict(frozen=True, extra="forbid", arbitrary_types_allowed=True)

    propagation: Annotated[Any, BeforeValidator(MODELS.build)] = Field(default_factory=ExponentialPlate)
    bands: Bands = Field(default_factory=Bands.dominant)
    gain_limit_db: float | None = Field(default=0.0, le=MAX_GAIN_DB, allow_inf_nan=False)
    sample_rate_hz: int = Field(default=48000, ge=1000, le=192000)
    control_period_s: float = Field(default=0.02, gt=0.0, le=1.0)

    @classmethod
    def parse(cls, settings: SessionConfig | Mapping[str, Any] | None) -> SessionConfig:
        """A configuration from settings, or the default.

        Raises: ConfigError: a setting that does not exist or is out of bounds.
        """
        if isinstance(settings, cls):
            return settings
        try:
            return cls.model_validate(settings or {})
        except ValidationError as cause:
            problem = checks.first_problem(cause)
            raise ConfigError(f"session setting {problem.place}: {problem.reason}, got {problem.value!r}.") from cause
