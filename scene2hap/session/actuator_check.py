"""Warning if a session plays on another actuator than its loops were made for."""

from __future__ import annotations

import warnings
from dataclasses import replace

from scene2hap.bundle import HapticBundle
from scene2hap.haptics import ActuatorProfile


class OtherActuatorWarning(UserWarning):
    """A session's actuator is another one than that which the bundle's loops were made for."""


def warn_if_other(bundle: HapticBundle, actuator: ActuatorProfile) -> None:
    """Warn, by `OtherActuatorWarning`, if the loops of a bundle were made for an actuator of another response.

    Limits of amplitude and power do not count: they are the safety layer's, and no loop is made by them. A bundle
    without a record of its actuator, or without loops, fits any.
    """
    made_for = getattr(getattr(bundle, "made_with", None), "actuator", None)
    if not bundle.loops or not isinstance(made_for, ActuatorProfile) or _shape(made_for) == _shape(actuator):
        return
    warnings.warn(
        f"the bundle's loops were made for the actuator {made_for.name!r}, and this session plays on "
        f'{actuator.name!r}: give SessionConfig(actuator=...) the one in use, or rebake(bundle, {{"actuator": ...}}).',
        OtherActuatorWarning,
        stacklevel=4,
    )


def _shape(actuator: ActuatorProfile) -> ActuatorProfile:
    """The parts of an actuator that decide how loops are made: band and response."""
    plain = ActuatorProfile()
    return replace(
        actuator,
        name=plain.name,
        max_amplitude=plain.max_amplitude,
        max_rms=plain.max_rms,
        rms_window_s=plain.rms_window_s,
    )
