"""Plates of objects: corrected thicknesses, and the joint loss of furniture, which the paper's law ignores."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from scene2hap import HapticSession, ObjectHaptics, Touch, materials
from scene2hap.bundle import Override
from scene2hap.propagation.bodies.idealisation import no_heavier_than_object
from scene2hap.session.present_scene.network import body_of
from scenes import table_with_two_phones


@pytest.mark.parametrize(
    ("category", "loss"),
    [("dining table", 0.04), ("night stand", 0.04), ("mug", None), ("table tennis ball", None), ("unknown", None)],
)
def test_furniture_has_additional_joint_loss(category: str, loss: float | None) -> None:
    steel = materials.lookup("steel")
    table = replace(table_with_two_phones()[1].objects["table"], object_category=category, material=steel)
    body = body_of(table)
    assert body is not None
    assert body.material.loss_factor == (steel.loss_factor if loss is None else loss)
    assert replace(body.material, loss_factor=steel.loss_factor) == steel


def test_lossy_and_overridden_materials_keep_their_loss() -> None:
    _, bundle = table_with_two_phones()
    rubber = materials.lookup("rubber")
    table = replace(bundle.objects["table"], object_category="table", material=rubber)
    body = body_of(table)
    assert body is not None
    assert body.material == rubber
    chosen = body_of(
        replace(bundle, objects={**bundle.objects, "table": table}).override("table", material="steel").objects["table"]
    )
    assert chosen is not None
    assert chosen.material == materials.lookup("steel")


def test_exponential_law_ignores_loss_factors() -> None:
    scene, bundle = table_with_two_phones()
    named = [replace(bundle.objects["table"], object_category=one) for one in ("table", "slab")]
    touch = [Touch("left", "table", scene.object("table").bounds_m[1])]
    gains = [
        HapticSession(replace(bundle, objects={**bundle.objects, "table": one})).update(touches=touch).gains
        for one in named
    ]
    np.testing.assert_array_equal(gains[0], gains[1])


def test_thickness_of_a_person_outranks_an_estimated_mass_but_no_weighed_one() -> None:
    """Models make a plate thinner that is heavier than its object, as that of a hollow one."""
    inferred = ObjectHaptics("table", "oak", materials.lookup("oak"), (1.6, 0.85, 0.03), "", False, mass_kg=10.0)
    for by, limited in (("lexicon", False), ("scene", True)):
        weighed = replace(inferred, provenance={"mass_kg": by})
        plate = body_of(Override(thickness_m=0.1).applied(weighed))
        assert plate is not None
        assert plate.thickness_m == 0.1
        assert (no_heavier_than_object(plate).thickness_m < 0.1) == limited
