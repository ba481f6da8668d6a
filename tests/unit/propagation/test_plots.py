"""`plot_field`: levels on a plate, marks of contacts and touches, and refused arguments."""

import sys
from dataclasses import replace

import numpy as np
import pytest

from scene2hap import (
    Bands,
    Contact,
    ContactNetwork,
    Excitation,
    ExponentialPlate,
    MassSpringDamper,
    ModalPlate,
    NoPropagation,
    Plate,
    Pose,
    materials,
)
from scene2hap.errors import MissingExtra, ModelDomainError
from scene2hap.propagation.plots import plot_field
from scene2hap.scene.surface.outline import Outline

TOP = Plate(0.8, 0.4, 0.02, materials.lookup("oak"))
PLACE = Pose((1.0, 2.0, 0.5))
NETWORK = ContactNetwork({"top": TOP}, [Contact("phone", "top", (1.2, 2.1, 0.5))], {"top": PLACE})
FIELD = ExponentialPlate().prepare(NETWORK, [Excitation("phone", 150.0, 150.0, 0.2)], Bands((100.0, 200.0, 400.0)))


def test_the_map_is_the_field() -> None:
    pytest.importorskip("matplotlib", reason="matplotlib is not installed; run: pip install 'scene2hap[plots]'")
    figure = plot_field(FIELD, NETWORK, "top", band=1, touch_m=[1.5, 2.3, 0.5])
    axes = figure.axes[0]
    shown = np.asarray(axes.images[0].get_array())  # (n_y, n_x), from the plate's corner
    n_y, n_x = shown.shape
    assert (n_x, n_y) == (64, 32)
    at = PLACE.to_world([[(10 + 0.5) / n_x * 0.8, (20 + 0.5) / n_y * 0.4, 0.0]])
    expected = 20 * np.log10(FIELD.attenuation("top", at)[0, 0, 1])
    assert shown[20, 10] == pytest.approx(expected)
    foot, touch = (line.get_xydata()[0] for line in axes.lines)
    np.testing.assert_allclose(foot, [0.2, 0.1])
    np.testing.assert_allclose(touch, [0.5, 0.3])
    loudest = np.unravel_index(shown.argmax(), shown.shape)
    np.testing.assert_allclose([loudest[1] / n_x * 0.8, loudest[0] / n_y * 0.4], foot, atol=0.03)


def test_a_missing_extra_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "matplotlib.figure", None)
    with pytest.raises(MissingExtra, match=r"scene2hap\[plots\]"):
        plot_field(FIELD, NETWORK, "top")


@pytest.mark.parametrize(
    ("question", "message"),
    [
        ({"object_id": "phone"}, "no plate"),
        ({"object_id": "top", "source_id": "radio"}, "radio"),
        ({"object_id": "top", "band": 2}, "band is 2"),
        ({"object_id": "top", "band": 0.5}, "band is 0.5; it must be a whole number"),
    ],
)
def test_invalid_arguments_are_refused(question: dict, message: str) -> None:
    with pytest.raises(ModelDomainError, match=message):
        plot_field(FIELD, NETWORK, **question)


def test_the_map_ends_at_the_outline() -> None:
    pytest.importorskip("matplotlib", reason="matplotlib is not installed; run: pip install 'scene2hap[plots]'")
    shape = Outline([[(0.0, 0.0), (0.8, 0.0), (0.8, 0.2), (0.3, 0.2), (0.3, 0.6), (0.0, 0.6)]])
    network = replace(NETWORK, bodies={"top": Plate.of_outline(shape, 0.02, materials.lookup("oak"))})
    field = MassSpringDamper().prepare(network, [Excitation("phone", 150.0, 150.0, 0.2)], Bands.dominant())
    shown = np.ma.filled(plot_field(field, network, "top").axes[0].images[0].get_array(), np.nan)
    assert np.isnan(shown[30:, 40:]).all()  # beside both legs of the L
    assert np.isfinite(shown[:15]).all()
    assert np.isfinite(shown[:, :20]).all()


def test_a_source_that_does_not_arrive_is_drawn() -> None:
    pytest.importorskip("matplotlib", reason="matplotlib is not installed; run: pip install 'scene2hap[plots]'")
    silent = NoPropagation().prepare(NETWORK, [Excitation("phone", 150.0, 150.0, 0.2)], Bands.dominant())
    assert plot_field(silent, NETWORK, "top").axes[0].images[0].get_clim() == (-40.0, 0.0)


def test_a_field_without_sources_is_refused() -> None:
    with pytest.raises(ModelDomainError, match="has no source"):
        plot_field(ModalPlate().prepare(NETWORK, [], Bands.dominant()), NETWORK, "top")
