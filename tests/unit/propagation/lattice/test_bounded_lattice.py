"""The mass-spring-damper model bounds its work on any plate by a budget of nodes and modes, not by a clock."""

import dataclasses
import gc
import math
import weakref
from collections.abc import Iterator

import numpy as np
import pytest

from garbage import only_new_garbage
from scene2hap import materials
from scene2hap.errors import ModelDomainError
from scene2hap.propagation import mass_spring_damper
from scene2hap.propagation.bodies.infinite_body import InfiniteBody, SplitBody
from scene2hap.propagation.bodies.lattice_body import LatticeBody
from scene2hap.propagation.lattice import lattice_modes
from scene2hap.propagation.mass_spring_damper import CoarsenedWarning, MassSpringDamper
from scene2hap.propagation.plate import Plate

# Values typical of felt, chosen for its softness; 1.5 m x 1 m x 10 mm.
FELT = dataclasses.replace(materials.lookup("fabric"), name="felt", youngs_modulus_pa=4e6, density_kg_m3=150.0)
RUG = Plate(1.5, 1.0, 0.01, FELT)


@pytest.fixture(autouse=True)
def _only_new_garbage() -> Iterator[None]:
    with only_new_garbage():
        yield


@pytest.fixture
def small_budget(monkeypatch: pytest.MonkeyPatch) -> float:
    monkeypatch.setattr(lattice_modes, "MOST_WORK", 3e6)
    mass_spring_damper._times_coarsened.cache_clear()
    return 3e6


def test_rug_is_coarsened_within_the_budget_with_a_warning(small_budget: float) -> None:
    with pytest.warns(CoarsenedWarning, match=r"1.5 × 1 m of 10 mm felt has some .* modes up to 1000 Hz"):
        body = MassSpringDamper(resolution=8).elastic_body(RUG, 1000.0)
    assert isinstance(body, SplitBody)
    assert isinstance(body.below, LatticeBody)
    assert 1.0 < body.limit_hz < 1000.0
    modes = body.below.modes
    assert modes.lattice.n_nodes * modes.shapes.shape[1] ** 2 <= 2 * small_budget
    at = np.array([[0.4, 0.3], [0.9, 0.6]])
    found = body.receptance(at, at, np.array([0.5 * body.limit_hz, 2 * body.limit_hz, 900.0]))
    assert np.isfinite(found).all()
    assert (found[:, [0, 1], [0, 1]].imag < 0).all()


@pytest.mark.filterwarnings("ignore::scene2hap.propagation.mass_spring_damper.CoarsenedWarning")
def test_plates_that_were_warned_of_do_not_add_up() -> None:
    first = Plate(1.0, 1.0, 0.01, FELT)
    forgotten = weakref.ref(first)
    mass_spring_damper._warn_coarsened(first, 1000.0, 100.0)
    del first
    assert forgotten() is not None  # kept, so that it is not warned of again
    for k in range(4096):
        mass_spring_damper._warn_coarsened(Plate(2.0 + k, 1.0, 0.01, FELT), 1000.0, 100.0)
    gc.collect()
    assert forgotten() is None


def test_a_coarsened_plate_is_mentioned_once_for_all_frequencies(
    small_budget: float, recwarn: pytest.WarningsRecorder
) -> None:
    for top_hz in (1000.0, 990.0, 700.0):
        MassSpringDamper(resolution=8).elastic_body(RUG, top_hz)
    assert [item.category for item in recwarn.list] == [CoarsenedWarning]


@pytest.mark.parametrize("top_hz", np.linspace(120.0, 300.0, 13))
def test_carpet_has_no_edges_at_any_top_frequency(top_hz: float) -> None:
    """A carpet of a living room has some 190 modes per hertz, so no edge is felt: it answers as an infinite plate."""
    carpet = Plate(4.01192, 3.46417, 0.002, materials.lookup("carpet"))
    body = MassSpringDamper(outside_domain="ignore").elastic_body(carpet, float(top_hz))
    at, f = np.array([[1.0, 1.5], [2.0, 1.7]]), np.array([10.0, 60.0, 120.0])
    expected = InfiniteBody(carpet, carpet.material.loss_factor).receptance(at, at, f)
    np.testing.assert_allclose(body.receptance(at, at, f), expected, rtol=1e-12)


def test_coarsening_can_be_refused_or_silent(small_budget: float, recwarn: pytest.WarningsRecorder) -> None:
    with pytest.raises(ModelDomainError, match="too many for masses and springs"):
        MassSpringDamper(resolution=8, outside_domain="raise").elastic_body(RUG, 1000.0)
    MassSpringDamper(resolution=8, outside_domain="ignore").elastic_body(RUG, 1000.0)
    assert not recwarn.list


def test_excessive_single_plate_request_is_refused_before_solving(monkeypatch: pytest.MonkeyPatch) -> None:
    def never(*_: object) -> None:
        raise AssertionError("it was begun")

    monkeypatch.setattr(lattice_modes, "_factorised", never)
    fine = MassSpringDamper(resolution=200)
    with pytest.raises(ModelDomainError, match="times what is solved in seconds"):
        fine.plate_transfer(RUG, [0.4, 0.3], [[0.9, 0.6]], [300.0])
    with pytest.raises(ModelDomainError, match="times what is solved in seconds"):
        fine.natural_frequencies_hz(RUG, 5000)


def test_furniture_is_not_coarsened() -> None:
    table = Plate(1.6, 0.8, 0.02, materials.lookup("oak"))
    assert isinstance(MassSpringDamper().elastic_body(table, 1000.0), LatticeBody)


def test_number_of_modes_is_estimated_closely() -> None:
    table = Plate(1.6, 0.8, 0.02, materials.lookup("oak"))
    found = lattice_modes.lowest_frequencies_hz(table, 16, 40)
    assert math.isclose(lattice_modes.n_modes_up_to(table, float(found[-1])), 40, rel_tol=0.25)
