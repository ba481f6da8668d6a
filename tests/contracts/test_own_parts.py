"""The library's parts that need no device and no network pass the contract tests for plugins."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from host import rasteriser_problem
from scene2hap import MemorySink, WavSink
from scene2hap.audio.sources.synth import Synthesizer
from scene2hap.audio.tactile import CONVERTERS
from scene2hap.devices.tee import TeeSink
from scene2hap.export import EXPORTS
from scene2hap.llm.backends.replay import RecordingBackend, ReplayBackend
from scene2hap.llm.lexicon import LexiconBackend
from scene2hap.propagation import MODELS
from scene2hap.scene.capture import RENDERERS
from scene2hap.testing import (
    check_actuator_sink,
    check_audio_source,
    check_exporter,
    check_llm_backend,
    check_propagation_model,
    check_renderer,
    check_tactile_converter,
)

SETTINGS: dict[str, dict[str, Any]] = {"mass_spring_damper": {"resolution": 8}}


@pytest.mark.parametrize("kind", MODELS.kinds())
@pytest.mark.filterwarnings("ignore::scene2hap.propagation.domain.ThinPlateWarning")
def test_own_propagation_models_pass_the_contract(kind: str) -> None:
    check_propagation_model(MODELS.build({"kind": kind, **SETTINGS.get(kind, {})}))


@pytest.mark.parametrize("hand", ["palm", "fingertip"])
@pytest.mark.parametrize("kind", ["infinite_plate", "modal_plate", "auto", "mass_spring_damper"])
@pytest.mark.filterwarnings("ignore::scene2hap.propagation.domain.ThinPlateWarning")
def test_propagation_models_under_a_hand(kind: str, hand: str) -> None:
    check_propagation_model(MODELS.build({"kind": kind, "hand": hand}))


@pytest.mark.parametrize("kind", CONVERTERS.kinds())
def test_own_converters_pass_the_contract(kind: str) -> None:
    check_tactile_converter(CONVERTERS.build(kind))


def test_own_sinks_pass_the_contract(tmp_path: Path) -> None:
    check_actuator_sink(MemorySink)
    check_actuator_sink(lambda: WavSink(tmp_path / "mix.wav"))
    check_actuator_sink(lambda: TeeSink([MemorySink(), WavSink(tmp_path / "both.wav")]), channels=("left",))


def test_own_backends_pass_the_contract(tmp_path: Path) -> None:
    check_llm_backend(LexiconBackend())
    check_llm_backend(RecordingBackend(LexiconBackend(), tmp_path / "answers.jsonl"))
    check_llm_backend(ReplayBackend(tmp_path / "answers.jsonl"))


def test_own_sources_pass_the_contract() -> None:
    check_audio_source(Synthesizer())


@pytest.mark.parametrize("kind", RENDERERS.kinds())
def test_own_renderers_pass_the_contract(kind: str) -> None:
    pytest.importorskip({"embree": "embreex", "panda3d": "panda3d.core"}[kind], exc_type=ImportError)
    if kind == "panda3d" and (problem := rasteriser_problem()):
        pytest.skip(problem)
    check_renderer(RENDERERS.load(kind))


@pytest.mark.parametrize("kind", EXPORTS.kinds())
def test_own_exporters_pass_the_contract(kind: str) -> None:
    check_exporter(EXPORTS.build(kind))
