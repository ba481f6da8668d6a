"""A session on another actuator than the bundle's warns once, in one sentence."""

import warnings
from dataclasses import dataclass, replace

import numpy as np
import pytest

from edge_scenes import no_source
from scene2hap import HapticBundle, HapticSession, MemorySink, SessionConfig, Touch
from scene2hap.audio.actuators import ACTUATORS
from scene2hap.errors import ConfigError
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
        HapticSession(scene, made_for(bundle, ACTUATORS["lra"]), {"sample_rate_hz": RATE, "actuator": "flat"})
    assert len(told) == 1
    assert told[0].filename == __file__


def test_session_without_a_named_actuator_plays_on_the_bundles() -> None:
    scene, bundle = table_with_two_phones()
    lra = replace(ACTUATORS["lra"], max_amplitude=0.1)
    for settings in (None, {"sample_rate_hz": RATE}, SessionConfig(sample_rate_hz=RATE)):
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            session = HapticSession(scene, made_for(bundle, lra), settings)
        assert session.config.actuator == lra
    assert HapticSession(scene, made_for(bundle, None)).config.actuator == ActuatorProfile()

    sink = MemorySink()
    with HapticSession(scene, made_for(bundle, lra), sink=sink) as session:
        session.update(touches=[Touch("left", "phone", (0.1, 0.73, 0.4))])
        sink.pull_s(0.5)
    assert 0.05 < float(np.abs(sink.samples).max()) <= 0.1 + 1e-6  # the actuator's limit, held by the safety layer


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


def test_correction_for_another_actuator_brings_a_warning() -> None:
    scene, bundle = table_with_two_phones()
    session = HapticSession(scene, made_for(bundle, ACTUATORS["lra"]))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        session.use_bundle(made_for(bundle, ACTUATORS["lra"]))
    with pytest.warns(
        OtherActuatorWarning, match="for the actuator .voice_coil., and this session plays on .lra."
    ) as told:
        session.use_bundle(made_for(bundle, ACTUATORS["voice_coil"]))
    assert told[0].filename == __file__


def test_misspelt_actuator_is_refused_by_a_question() -> None:
    with pytest.raises(ConfigError, match=r"Did you mean 'lra'\?$"):
        SessionConfig(actuator="lra2")
