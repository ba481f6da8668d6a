"""Settings of a session."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal, Self

import numpy as np
from pydantic import BeforeValidator, Field, model_validator

from scene2hap.audio.actuators import actuator_profile
from scene2hap.common import checks
from scene2hap.common.settings import Settings
from scene2hap.devices.protocol import ActuatorSink
from scene2hap.errors import ConfigError
from scene2hap.haptics import ActuatorProfile, Bands
from scene2hap.propagation import MODELS
from scene2hap.propagation.bands.sampling import AROUND
from scene2hap.propagation.exponential_plate import ExponentialPlate
from scene2hap.propagation.protocol import CoupledModel, PropagationModel, follows_poses

MIN_RAMP_S = 0.010
"""Shortest ramp of a gain change; see `scene2hap.render.mixer`."""

MAX_GAIN_DB = 120.0
"""Bound on every gain, far beyond any actuator, so that single precision cannot overflow."""


def _bands(value: object) -> object:
    named = {"dominant": Bands.dominant, "around": lambda: AROUND, "third-octaves": Bands.third_octaves}
    if isinstance(value, Mapping) and value.keys() == {"kind"}:  # as other parts are chosen
        value = value["kind"]
    if isinstance(value, Bands | Mapping):
        return value
    if isinstance(value, str) and value in named:
        return named[value]()
    if isinstance(value, Sequence | np.ndarray) and not isinstance(value, str | bytes):
        return Bands(value)
    near = checks.did_you_mean(value, named, "They are 'dominant', 'around' or 'third-octaves'.")
    raise ConfigError(f"bands are {checks.described(value)}; they must be rising edges [Hz] or a name. {near}")


class SkipConfig(Settings):
    """Switches for the work that a session skips because nobody feels the difference.

    docs/playing.md has the bound of each; `SessionStats.skipped` counts the skipped work.

    unreachable : objects that no source reaches over contacts are left out of the model's input and are not evaluated;
        none are for a model that follows poses.
    below_threshold : sources that are not felt at a hand are left out of its mix.
    silent_bands : bands below -140 dB, and loops whose gains are all 0, are not mixed.
    idle_hands : hands that touch nothing are not computed.
    unchanged_frames : gains are not computed again for an update without a change.
    """

    of_what = "skip"

    unreachable: bool = True
    below_threshold: bool = True
    silent_bands: bool = True
    idle_hands: bool = True
    unchanged_frames: bool = True


def _skip(value: object) -> object:
    if not isinstance(value, bool | Mapping | SkipConfig):
        names = ", ".join(SkipConfig.model_fields)
        raise ConfigError(f"skip is {checks.described(value)}; it must be true or false, or a mapping of {names}.")
    return SkipConfig(**dict.fromkeys(SkipConfig.model_fields, value)) if isinstance(value, bool) else value


class SessionConfig(Settings):
    """Settings of a session, from Python or a TOML or JSON file. A `kind` chooses each exchangeable part.

    propagation : a kind, a mapping with `kind` and settings, or a model; `scene2hap.propagation.MODELS` lists kinds.
    bands : bands of the gains: Bands, their edges [Hz], "dominant" (each source's own frequency, as in the paper),
        "around" (half an octave around it) or "third-octaves" (20 from 10 to 1000 Hz). The default is "around" for a
        model that resonates, else "dominant".
    reference : "source": gains are relative to the source's free vibration; "felt_near": each source is scaled to the
        level of the paper's law at 0.1 m from it, so that models can be exchanged at the same strength.
    prepare : "background": a worker prepares the model while the last field stays in use, and `update` never waits;
        "blocking": `update` waits, so that output depends on input alone. A model with a live field, such as
        `ExponentialPlate`, needs no preparation.
    gain_limit_db : upper bound of the gain of one source at a hand, up to 120 [dB]; None for no bound.
    sample_rate_hz : rate of the samples that `render` returns and sinks get, 1000..192000 [Hz].
    tactile_rate_hz : rate at which loops are mixed, 1000..192000 [Hz]; the sample rate if that is lower. The mix of
        the hands is then resampled once. At least 2.5 times the highest band edge.
    control_period_s : usual time between updates, above 0, up to 1 [s]; gain changes are ramped over it, and over at
        least 10 ms.
    watchdog_s : time without an update after which a sink with a clock of its own fades to zero, 0.02..1 [s].
    actuator : the actuator in use, which gives the safety layer its limits: a name, a CSV file of Hz and dB, fields, or
        an ActuatorProfile. A session whose settings name none plays on the actuator that its bundle was made for.
    skip : work to skip: True for all of it, False for none, or a SkipConfig or its settings.
    impacts : True if a moved object is felt when it lands on another; `HapticSession.strike` works in any case.
    """

    of_what = "session"

    propagation: Annotated[Any, BeforeValidator(MODELS.build)] = Field(default_factory=ExponentialPlate)
    bands: Annotated[Bands, BeforeValidator(_bands)] = Field(default_factory=Bands.dominant)
    reference: Literal["source", "felt_near"] = "source"
    prepare: Literal["background", "blocking"] = "background"
    gain_limit_db: float | None = Field(default=0.0, le=MAX_GAIN_DB, allow_inf_nan=False)
    sample_rate_hz: int = Field(default=48000, ge=1000, le=192000)
    tactile_rate_hz: int = Field(default=8000, ge=1000, le=192000)
    control_period_s: float = Field(default=0.02, gt=0.0, le=1.0)
    watchdog_s: float = Field(default=0.1, ge=0.02, le=1.0)
    actuator: Annotated[ActuatorProfile, BeforeValidator(actuator_profile)] = Field(default_factory=ActuatorProfile)
    skip: Annotated[SkipConfig, BeforeValidator(_skip)] = Field(default_factory=SkipConfig)
    impacts: bool = True

    if TYPE_CHECKING:
        # Type checkers do not know which other forms the validators accept.
        def __init__(
            self,
            *,
            propagation: PropagationModel | Mapping[str, Any] | str = ...,
            bands: Bands | Sequence[float] | Mapping[str, Any] | str = ...,
            reference: Literal["source", "felt_near"] = "source",
            prepare: Literal["background", "blocking"] = "background",
            gain_limit_db: float | None = 0.0,
            sample_rate_hz: int = 48000,
            tactile_rate_hz: int = 8000,
            control_period_s: float = 0.02,
            watchdog_s: float = 0.1,
            actuator: ActuatorProfile | str | Path | Mapping[str, Any] = ...,
            skip: SkipConfig | bool | Mapping[str, bool] = ...,
            impacts: bool = True,
        ) -> None: ...

    @model_validator(mode="after")
    def _bands_of_the_model(self) -> Self:
        if "bands" not in self.model_fields_set:
            # Not marked as set, so that a change of the model changes them as well.
            object.__setattr__(self, "bands", getattr(self.propagation, "usual_bands", self.bands))
        return self

    @model_validator(mode="after")
    def _tactile_rate_holds_the_bands(self) -> Self:
        top_hz = max(self.bands.edges_hz, default=0.0)
        if self.tactile_rate_hz < 2.5 * top_hz:
            raise ValueError(
                f"tactile_rate_hz is {self.tactile_rate_hz} Hz; it must be at least 2.5 times the highest band edge, "
                f"{2.5 * top_hz:g} Hz. Raise it, or use lower bands"
            )
        return self

    def on_actuator(self, actuator: ActuatorProfile | None) -> Self:
        """Return these settings with an actuator, if they name none; None changes nothing."""
        if actuator is None or "actuator" in self.model_fields_set:
            return self
        return self.model_copy(update={"actuator": actuator})

    @property
    def skips_unreachable(self) -> bool:
        """True if objects that no source reaches over contacts are skipped."""
        return self.skip.unreachable and not follows_poses(self.propagation)

    @property
    def prepares_impacts(self) -> bool:
        """True if a worker prepares the scene around touched objects for impacts (coupled models only)."""
        return self.impacts and self.prepare == "background" and isinstance(self.propagation, CoupledModel)


def require_settings(config: object) -> None:
    """Raise a ConfigError if another argument of a session (hands, sink) is given as settings."""
    if isinstance(config, ActuatorSink):
        raise ConfigError(f"config is {checks.described(config)}; write HapticSession(..., sink=sink).")
    for name in ("hands", "sink"):
        if isinstance(config, Mapping) and name in config:
            value = checks.represented(config[name])
            raise ConfigError(f"{name} is an argument, no setting; write HapticSession(..., {name}={value}).")
