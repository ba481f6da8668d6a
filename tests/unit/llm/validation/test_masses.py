"""Masses of objects from the lexicon, a model, the scene and a user, and their effect on a source."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from llm_server import GOOD
from scene2hap import (
    Box,
    FunctionBackend,
    HapticBundle,
    HapticSession,
    LLMRequest,
    Pose,
    SceneObject,
    SceneSnapshot,
    Touch,
    bake,
    materials,
)
from scene2hap.cli import main
from scene2hap.errors import BundleError, ConfigError, SceneError
from scene2hap.llm.answers import ObjectAnswer
from scene2hap.llm.answers.schema import strict_schema
from scene2hap.llm.lexicon import LexiconBackend
from scene2hap.llm.lexicon.table import table
from scene2hap.llm.validation.masses import bounded_mass_kg, mass_fault
from scene2hap.llm.validation.plausibility import row_of
from scene2hap.scene.engines import mujoco as mujoco_adapter
from scenes import table_with_two_phones


def box(name: str, size_m: tuple[float, float, float], at_m: tuple[float, float, float]) -> SceneObject:
    return SceneObject(name, pose=Pose(at_m), geometry=Box(size_m))


def room(**changes: object) -> SceneSnapshot:
    oven = replace(box("microwave", (0.5, 0.3, 0.4), (0.0, 0.87, 0.0)), **changes)
    return SceneSnapshot.build([box("wooden table", (1.2, 0.02, 0.7), (0.0, 0.71, 0.0)), oven])


def answering(mass: object) -> FunctionBackend:
    lexicon = LexiconBackend()

    async def answer(asked: LLMRequest) -> object:
        told = await lexicon.complete(asked)
        if asked.component != "object_analyzer":
            return told.text
        document = ObjectAnswer.model_validate_json(told.text).model_dump()
        return {**document, "estimated_mass_kg": mass}

    return FunctionBackend(answer)


def weighed(scene: SceneSnapshot, backend: object = None) -> tuple[float | None, str, HapticBundle]:
    bundle = bake(scene, {"llm": backend or LexiconBackend()})
    haptics = bundle.objects["microwave"]
    return haptics.mass_kg, haptics.provenance.get("mass_kg", ""), bundle


def test_lexicon_gives_usual_masses() -> None:
    mass, by, bundle = weighed(room())
    assert mass == 14.0
    assert "lexicon" in by
    solid = bundle.objects["wooden table"]  # a slab without legs has its solid mass, not a usual table's 25 kg
    assert solid.material is not None
    assert solid.mass_kg == pytest.approx(1.2 * 0.02 * 0.7 * solid.material.density_kg_m3)


@pytest.mark.parametrize("mass_kg", [1e-8, 1e8])
def test_placeholder_of_a_simulator_is_no_mass(mass_kg: float) -> None:
    """Simulators write 1e-8 kg for bodies that need a mass but have none; the usual mass is used."""
    mass, by, _ = weighed(room(mass_kg=mass_kg))
    assert mass == 14.0
    assert "lexicon" in by


def test_masses_of_the_table_are_plausible_for_their_size() -> None:
    """No mass is above that of a granite cube with the longest usual edge; most everyday sources have a mass."""
    for row in table():
        if row.mass_kg is not None:
            assert row.mass_kg >= 0.005
            if row.max_size_m is not None:
                assert row.mass_kg <= 2700.0 * row.max_size_m**3, row.noun
    sources = [row for row in table() if row.vibrates and set(row.places) & {"kitchen", "bathroom", "office"}]
    assert sum(row.mass_kg is not None for row in sources) > 0.6 * len(sources)


def test_feet_are_taken_from_lexicon_and_override(tmp_path: Path) -> None:
    _, _, bundle = weighed(room())
    assert bundle.objects["microwave"].feet == materials.lookup("rubber")
    folder = bundle.save(tmp_path / "b")
    assert main(["edit", str(folder), "feet", "microwave", "felt", "-q"]) == 0
    loaded = HapticBundle.load(folder)
    assert loaded.objects["microwave"].feet == materials.lookup("felt")
    assert loaded.objects["microwave"].provenance["feet"] == "user"
    with pytest.raises(BundleError, match="feet"):
        bundle.override("microwave", feet=3)


def test_every_foot_of_the_table_is_of_a_known_material() -> None:
    assert all(row_of(row.feet) is not None for row in table() if row.feet)


def test_mass_from_a_model_is_used_within_plausible_bounds() -> None:
    assert weighed(room(), answering(11.5))[0] == 11.5
    assert weighed(room(), answering(None))[0] is None
    impossible, _, bundle = weighed(room(), answering(9e4))
    assert impossible is None
    assert "a box of 0.5 by 0.4 by 0.3 m weighs" in bundle.objects["microwave"].reasons["mass"]


def test_answers_recorded_without_mass_are_read() -> None:
    before = {key: value for key, value in GOOD["object_analyzer"].items() if key != "estimated_mass_kg"}
    assert ObjectAnswer.model_validate(before).estimated_mass_kg is None
    properties = strict_schema(ObjectAnswer.model_json_schema())
    assert "estimated_mass_kg" in properties["required"]


@pytest.mark.parametrize(
    ("mass_kg", "whole_m", "is_wrong"),
    [
        (14.0, (0.5, 0.4, 0.3), False),
        (2000.0, (0.5, 0.4, 0.3), True),
        (0.02, (0.5, 0.4, 0.3), True),
        (5, (1, 0, 1), False),
    ],
)
def test_masses_are_checked_against_the_bounding_box(
    mass_kg: float, whole_m: tuple[float, float, float], is_wrong: bool
) -> None:
    assert bool(mass_fault(mass_kg, whole_m)) == is_wrong


def test_a_usual_mass_is_at_most_that_of_a_solid_box() -> None:
    oak = 700.0
    assert bounded_mass_kg(25.0, (0.2, 0.1, 0.02), oak) == pytest.approx(0.2 * 0.1 * 0.02 * oak)
    assert bounded_mass_kg(60.0, (1.0, 0.6, 2.0), oak) == 60.0  # a wardrobe is hollow
    assert bounded_mass_kg(5.0, (1.0, 0.0, 2.0), oak) == 5.0


def test_mass_of_the_scene_outranks_inference_and_override_outranks_both(tmp_path: Path) -> None:
    scene = room(mass_kg=18.0)
    assert SceneSnapshot.from_json(scene.to_json()).object("microwave").mass_kg == 18.0
    mass, by, bundle = weighed(scene)
    assert (mass, by) == (18.0, "scene")
    folder = bundle.save(tmp_path / "b")
    assert main(["edit", str(folder), "mass", "microwave", "9.5", "-q"]) == 0
    loaded = HapticBundle.load(folder)
    assert loaded.objects["microwave"].mass_kg == 9.5
    assert loaded.objects["microwave"].provenance["mass_kg"] == "user"


@pytest.mark.parametrize("wrong", [0.0, -1.0, float("nan"), 1e9, "heavy"])
def test_invalid_mass_is_refused(wrong: object) -> None:
    scene, bundle = table_with_two_phones()
    with pytest.raises(BundleError, match="mass_kg"):
        bundle.override("table", mass_kg=wrong)
    with pytest.raises(ConfigError, match="mass_kg"):
        replace(bundle.objects["table"], mass_kg=wrong)
    if wrong != 1e9:
        with pytest.raises(SceneError, match="mass_kg"):
            replace(scene.object("table"), mass_kg=wrong)


def test_force_of_a_heavy_source_on_a_compliant_table_grows_with_its_mass() -> None:
    """Below all resonances, a source of mass m on a soft spring and a receiver of low mobility obeys
    v / v_free = Y_receiver / (1/(i w m) + ...). So heavier sources push harder, for small masses in proportion to m."""

    def felt(mass_kg: float) -> float:
        scene, bundle = table_with_two_phones()
        source, other = bundle.loops
        bundle = bundle.override(source, mass_kg=mass_kg).override(other, vibrates=False)
        session = HapticSession(
            bundle, config={"propagation": "modal_plate", "prepare": "blocking", "gain_limit_db": None}
        )
        low, high = scene.object("table").bounds_m
        at = ((low[0] + high[0]) / 2, high[1], (low[2] + high[2]) / 2)
        return float(session.update(touches=[Touch("left", "table", at)]).gains[0].max())

    light, double, heavy = felt(0.001), felt(0.002), felt(1000.0)
    assert double / light == pytest.approx(2.0, rel=0.05)
    assert heavy > 20 * light


def test_exponential_law_ignores_masses() -> None:
    scene, bundle = table_with_two_phones()
    touch = [Touch("left", "table", scene.object("table").bounds_m[1])]
    source = next(iter(bundle.loops))
    gains = [HapticSession(one).update(touches=touch).gains for one in (bundle, bundle.override(source, mass_kg=30.0))]
    np.testing.assert_array_equal(gains[0], gains[1])


def test_engine_masses_are_used_on_request() -> None:
    mujoco = pytest.importorskip("mujoco", reason="needs MuJoCo: pip install 'scene2hap[mujoco]'")
    xml = """<mujoco><worldbody><geom name="floor" type="box" size="2 2 .02"/>
    <body name="fan" pos="0 0 .5"><freejoint/><geom type="box" size=".1 .1 .1" mass="3.5"/></body></worldbody>
    </mujoco>"""
    model = mujoco.MjModel.from_xml_string(xml)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    assert mujoco_adapter.snapshot(model, data, masses="engine").object("fan").mass_kg == pytest.approx(3.5)
    assert mujoco_adapter.snapshot(model, data).object("fan").mass_kg is None
    with pytest.raises(SceneError, match="masses"):
        mujoco_adapter.snapshot(model, data, masses="all")
