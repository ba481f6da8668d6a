"""How a scene is played."""

from __future__ import annotations

from typing import Annotated, Any

from pydantic import BeforeValidator, Field

from scene2hap.haptics import Bands
from scene2hap.propagation import MODELS
from scene2hap.propagation.exponential_plate import ExponentialPlate
from scene2hap.settings import Settings

MIN_RAMP_S = 0.010
"""Shortest time over which a gain change is spread; see `scene2hap.render.mixer`."""

MAX_GAIN_DB = 120.0
"""Bound on every gain, far beyond any actuator, so that single precision cannot overflow."""


def _bands(value: object) -> object:
    named = {"dominant": Bands.dominant, "third-octaves": Bands.third_octaves}
    return named[value]() if isinstance(value, str) and value in named else value


class SessionConfig(Settings):
    """How a scene is played. Every part with alternatives is chosen by a `kind`, so that a table of TOML will do.

    propagation : a kind, a mapping with `kind` and settings, or a model; `scene2hap.propagation.MODELS` lists kinds.
    bands : bands in which gains are told: Bands, "dominant" (the paper's) or "third-octaves" (20 from 10 to 1000 Hz).
    gain_limit_db : cap on what one source may gain at a hand by propagation, None for no cap.
    control_period_s : usual time between updates; gain changes are spread over it, and over at least 10 ms.
    """

    of_what = "session"

    propagation: Annotated[Any, BeforeValidator(MODELS.build)] = Field(default_factory=ExponentialPlate)
    bands: Annotated[Bands, BeforeValidator(_bands)] = Field(default_factory=Bands.dominant)
    gain_limit_db: float | None = Field(default=0.0, le=MAX_GAIN_DB, allow_inf_nan=False)
    sample_rate_hz: int = Field(default=48000, ge=1000, le=192000)
    control_period_s: float = Field(default=0.02, gt=0.0, le=1.0)
