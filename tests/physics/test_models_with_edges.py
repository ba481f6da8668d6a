"""What holds for every model of a plate with edges, by any method."""

import warnings
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from scene2hap import AutoFidelity, InfinitePlate, MassSpringDamper, Material, ModalPlate, Plate, materials
from scene2hap.errors import ConfigError, ModelDomainError
from scene2hap.propagation import domain

MATERIAL = Material("test", 2500.0, 70e9, 0.3, loss_factor=0.02)
WITH_EDGES = [ModalPlate, MassSpringDamper, AutoFidelity]
TABLE = Plate(1.2, 0.7, 0.025, materials.lookup("oak"))


@pytest.mark.parametrize("model", WITH_EDGES)
@settings(max_examples=15)
@given(
    boundary=st.sampled_from(["FFFF", "SSSS", "CCCC", "CFFF", "SCFS", "SFFF", "FCSF"]),
    aspect=st.floats(0.2, 1.0),
    nu=st.floats(-0.9, 0.49),
    loss=st.floats(0.01, 2.0),
    places=st.lists(st.tuples(st.floats(0.0, 1.0), st.floats(0.0, 1.0)), min_size=3, max_size=3),
)
def test_reciprocal_and_passive(
    model: Any, boundary: str, aspect: float, nu: float, loss: float, places: list[tuple[float, float]]
) -> None:
    plate = Plate(0.8, 0.8 * aspect, 0.008, replace(MATERIAL, poisson_ratio=nu, loss_factor=loss), boundary)
    points = np.array(places) * [plate.length_m, plate.width_m]
    f = np.array([7.0, 90.0, 200.0, 400.0])
    # Y[i, j, f] is the receptance at i of a force at j.
    Y = np.stack([model().plate_receptance(plate, point, points, f) for point in points], axis=1)
    assert np.isfinite(Y).all()
    scale = np.abs(InfinitePlate().plate_receptance(plate, [0.0, 0.0], [0.0, 0.0], f)[0])
    np.testing.assert_allclose(Y / scale, Y.transpose(1, 0, 2) / scale, atol=1e-9)
    # No set of forces extracts work from the plate: the anti-Hermitian part of a receptance is negative.
    for k in range(len(f)):
        lost = np.linalg.eigvalsh(-(Y[..., k] - Y[..., k].conj().T) / 2j)
        assert lost.min() > -1e-6 * scale[k]


@pytest.mark.parametrize("model", WITH_EDGES)
def test_transfer_is_the_ratio_to_the_driven_point(model: Any) -> None:
    plate = Plate(0.9, 0.6, 0.006, MATERIAL)
    ask = plate, [0.2, 0.1], [[0.2, 0.1], [0.5, 0.4], [0.9, 0.6]], [30.0, 300.0]
    transfer, receptance = model().plate_transfer(*ask), model().plate_receptance(*ask)
    np.testing.assert_allclose(transfer, receptance / receptance[0], rtol=1e-9)
    np.testing.assert_allclose(transfer[0], 1.0, rtol=1e-9)


@pytest.mark.parametrize("model", WITH_EDGES)
def test_a_force_on_a_clamp_does_nothing(model: Any) -> None:
    plate = Plate(0.8, 0.5, 0.006, MATERIAL, "CFFF")
    at_clamp = model().plate_receptance(plate, [0.0, 0.2], [[0.4, 0.2], [0.0, 0.2]], [50.0])
    free = model().plate_receptance(plate, [0.4, 0.2], [0.4, 0.2], [50.0])
    assert np.abs(at_clamp).max() < 1e-9 * np.abs(free[0, 0])
    with pytest.raises(ModelDomainError, match=r"driven point \(0, 0.2\) m lies on an edge that does not move"):
        model().plate_transfer(plate, [0.0, 0.2], [0.4, 0.2], [50.0])


@pytest.mark.parametrize("model", WITH_EDGES)
@pytest.mark.parametrize("boundary", ["CFFF", "SSSS"])
def test_a_point_within_rounding_of_a_held_edge_is_on_it(model: Any, boundary: str) -> None:
    plate = Plate(0.8, 0.5, 0.006, MATERIAL, boundary)
    with pytest.raises(ModelDomainError, match="lies on an edge that does not move"):
        model().plate_transfer(plate, [1e-7, 0.2], [0.4, 0.2], [50.0])


@pytest.mark.parametrize("model", WITH_EDGES)
def test_loss_floor(model: Any) -> None:
    bare = Plate(0.8, 0.5, 0.006, replace(MATERIAL, loss_factor=1e-4))
    assembled = replace(bare, material=replace(MATERIAL, loss_factor=0.01))
    ask = ([0.2, 0.1], [[0.5, 0.3]], [50.0, 300.0])
    floored = model().plate_receptance(bare, *ask)
    np.testing.assert_allclose(floored, model().plate_receptance(assembled, *ask), rtol=1e-9)
    assert not np.allclose(floored, model(loss_floor=0.0).plate_receptance(bare, *ask), rtol=1e-4)
    lossless = replace(bare, material=replace(MATERIAL, loss_factor=0.0))
    assert np.isfinite(model().plate_receptance(lossless, *ask)).all()
    with pytest.raises(ModelDomainError, match="loss factor of 0"):
        model(loss_floor=0.0).plate_receptance(lossless, *ask)
    with pytest.raises(ConfigError, match="loss_floor"):
        model(loss_floor=-0.1)


@pytest.mark.parametrize("model", WITH_EDGES)
def test_invalid_requests_are_refused(model: Any) -> None:
    with pytest.raises(ModelDomainError, match="holds 0 Hz"):
        model().plate_receptance(TABLE, [0.1, 0.1], [0.2, 0.2], [0.0])
    with pytest.raises(ModelDomainError, match="outside"):
        model().plate_receptance(TABLE, [0.1, -0.1], [0.2, 0.2], [10.0])
    with pytest.raises(ModelDomainError, match="outside"):
        model().plate_transfer(TABLE, [0.1, 0.1], [[0.2, 0.2], [9.0, 0.2]], [10.0])


@pytest.mark.parametrize("model", WITH_EDGES)
def test_a_thick_plate_warns_once(model: Any) -> None:
    domain._warn_once.cache_clear()  # models share it
    block = Plate(0.5, 0.4, 0.08, materials.lookup("oak"), "SSSS")
    with pytest.warns(domain.ThinPlateWarning, match="80 mm oak"):
        model().plate_transfer(block, [0.1, 0.1], [0.2, 0.2], [5000.0])
    with warnings.catch_warnings(record=True) as again:
        warnings.simplefilter("always")
        model().plate_receptance(block, [0.1, 0.1], [0.2, 0.2], [5000.0])
    assert not again
