"""The example plugins of docs/plugins.md: at most thirty lines, they pass their contracts and work in a scene."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from scene2hap import Box, HapticSession, Pose, SceneObject, SceneSnapshot, Touch, bake
from scene2hap.audio.sources import SOURCES
from scene2hap.audio.tactile import CONVERTERS
from scene2hap.devices import SINKS
from scene2hap.export import EXPORTS, export_bundle
from scene2hap.llm import BACKENDS
from scene2hap.propagation import MODELS
from scene2hap.scene.capture import RENDERERS, capture_images
from scene2hap.testing import (
    check_actuator_sink,
    check_audio_source,
    check_exporter,
    check_llm_backend,
    check_propagation_model,
    check_renderer,
    check_tactile_converter,
)

PAGE = (Path(__file__).parents[2] / "docs" / "plugins.md").read_text(encoding="utf-8")
CODE = dict(re.findall(r"<!-- plugin: (\w+) -->\n```python\n(.*?)```", PAGE, re.DOTALL))
ON_TABLE = Touch("left", "wooden table", (0.3, 0.72, 0.0))


def part(kind: str, name: str) -> Any:
    """A class from the code of the page."""
    names: dict[str, Any] = {}
    exec(CODE[kind], names)
    return names[name]


@pytest.fixture
def scene() -> SceneSnapshot:
    return SceneSnapshot.build(
        [
            SceneObject("wooden table", pose=Pose((0.0, 0.36, 0.0)), geometry=Box((1.2, 0.72, 0.7))),
            SceneObject("smartphone", pose=Pose((0.2, 0.724, 0.0)), geometry=Box((0.07, 0.008, 0.15))),
        ]
    )


def test_the_page_has_all_seven_kinds_in_thirty_lines_each() -> None:
    groups = (BACKENDS, SOURCES, CONVERTERS, MODELS, SINKS, RENDERERS, EXPORTS)
    assert {f"scene2hap.{kind}" for kind in CODE} == {group.name for group in groups}
    assert all(f"`{group.name}`" in PAGE for group in groups)
    assert max(len(code.splitlines()) for code in CODE.values()) <= 30


def test_language_model(scene: SceneSnapshot) -> None:
    backend = part("llm", "ByName")()
    check_llm_backend(backend)
    bundle = bake(scene, {"llm": backend})
    assert set(bundle.loops) == {"smartphone"}
    assert bundle.objects["wooden table"].material_category == "oak"


def test_source_of_sounds(scene: SceneSnapshot) -> None:
    source = part("audio", "Hum")()
    check_audio_source(source)
    bundle = bake(scene, {"audio": [source]})
    (loop,) = bundle.loops["smartphone"].values()
    assert loop.frequency_raw_hz == pytest.approx(60.0 / 0.15, rel=0.02)


def test_converter(scene: SceneSnapshot) -> None:
    converter = part("tactile", "Halved")()
    check_tactile_converter(converter)
    assert bake(scene, {"tactile": converter}).loops["smartphone"]


def test_propagation_model(scene: SceneSnapshot) -> None:
    model = part("propagation", "Neighbours")()
    check_propagation_model(model)
    session = HapticSession(scene, bake(scene), {"propagation": model})
    session.update(touches=[ON_TABLE])
    assert session.wait_prepared(60)
    assert session.update(touches=[ON_TABLE]).gain("left", "smartphone") == 0.5


def test_sound_in_air_follows_a_source_that_touches_nothing(scene: SceneSnapshot) -> None:
    names: dict[str, Any] = {}
    (code,) = re.findall(r"<!-- ci: run -->\n```python\n(.*?)```", PAGE, re.DOTALL)
    exec(code, names)
    check_propagation_model(names["SoundInAir"]())
    session = HapticSession(scene, bake(scene), {"propagation": names["SoundInAir"]()})
    for height_m in (0.4, 0.8):
        session.update({"smartphone": Pose((0.3, 0.72 + height_m, 0.0))}, [ON_TABLE])
        assert session.wait_prepared(60)
        gain = session.update(touches=[ON_TABLE]).gain("left", "smartphone")
        assert gain == pytest.approx(0.1 / height_m, rel=1e-6)


def test_actuator(scene: SceneSnapshot) -> None:
    make = part("devices", "LevelMeter")
    check_actuator_sink(make)
    sink = make()
    with HapticSession(scene, bake(scene), sink=sink) as session:
        session.update(touches=[ON_TABLE])
        sink.pull(48_000)
    left, right = sink.largest
    assert left > 0.001
    assert right == 0.0


def test_renderer(scene: SceneSnapshot) -> None:
    factory = part("renderers", "Dots")
    check_renderer(factory)
    images = capture_images(scene, renderer=factory, size_px=64).object("smartphone").images
    assert images is not None
    assert images.isolated[0].startswith(b"\x89PNG")
    assert np.unique(np.frombuffer(images.isolated[0], dtype=np.uint8)).size > 10


def test_export(scene: SceneSnapshot, tmp_path: Path) -> None:
    exporter = part("exports", "Csv")()
    check_exporter(exporter)
    report = export_bundle(bake(scene), tmp_path, exporter)
    (row,) = report.rows
    assert row.fidelity is not None
    assert row.fidelity.p95_db < 1.0
    assert (tmp_path / row.files[0]).read_text().startswith("vibration\n")
