"""A session on another actuator than the bundle's warns once, in one sentence."""

import warnings
from dataclasses import dataclass, replace

import pytest

from edge_scenes import no_source
from scene2hap import HapticBundle, HapticSession
from scene2hap.audio.actuators import ACTUATORS
from scene2hap.haptics import ActuatorProfile
from scene2hap.session.likely_mistakes import OtherActuatorWarning
from scenes import RATE, table_with_two_phones


@dataclass(frozen=True)
class Made:
    """The part of a bundle's metadata that holds its actuator."""

    actuator: ActuatorProfile | None


def made_for(bundle: HapticBundle, actuator: ActuatorProfile | None) -> HapticBundle:
    bundle = replace(bundle)
    object.__setattr__(bundle, "made_with", Made(actuator))
    return bundle


def test_session_warns_of_a_different_actuator() -> None:
    scene, bundle = table_with_two_phones()
    with pytest.warns(OtherActuatorWarning, match="for the actuator .lra., and this session plays on .flat") as told:
        HapticSession(scene, made_for(bundle, ACTUATORS["lra"]), {"sample_rate_hz": RATE})
    assert len(told) == 1
    assert told[0].filename == __file__


def test_session_does_not_warn_of_the_same_or_an_unknown_actuator() -> None:
    scene, bundle = table_with_two_phones()
    lra = ACTUATORS["lra"]
    spared = replace(lra, name="my LRA", max_amplitude=0.5, max_rms=0.2)
    silent = made_for(no_source()[1], lra)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        HapticSession(scene, made_for(bundle, lra), {"sample_rate_hz": RATE, "actuator": "lra"})
        HapticSession(scene, made_for(bundle, lra), {"sample_rate_hz": RATE, "actuator": spared})
        HapticSession(scene, made_for(bundle, None), {"sample_rate_hz": RATE, "actuator": "lra"})
        HapticSession(scene, bundle, {"sample_rate_hz": RATE, "actuator": "lra"})
        HapticSession(silent.snapshot, silent, {"sample_rate_hz": RATE})
