"""The table of materials, and the bounds of material constants."""

import csv
import math

import numpy as np
import pytest

from others import SHARED, needed
from scene2hap import materials
from scene2hap.errors import MaterialError, UnknownMaterial
from scene2hap.materials import Material


@pytest.mark.parametrize(
    ("name", "row"),
    [("oak", "oak"), ("Oak Wood", "oak"), ("SOLID_OAK", "oak"), ("soda-lime glass", "glass"), ("alu", "aluminum")],
)
def test_lookup_by_name_and_alias(name: str, row: str) -> None:
    assert materials.lookup(name).name == row


def test_lookup_gives_the_nominal_constants() -> None:
    steel = materials.lookup("steel")
    assert (steel.density_kg_m3, steel.youngs_modulus_pa, steel.poisson_ratio) == (7850.0, 2e11, 0.3)


def test_unknown_material_names_the_nearest() -> None:
    with pytest.raises(UnknownMaterial, match=r"no material 'plywod'.*'plywood'"):
        materials.lookup("plywod")
    with pytest.raises(UnknownMaterial, match="no material '-'"):
        materials.lookup("-")


def test_every_nominal_value_lies_in_its_range_and_has_a_source() -> None:
    for row in materials.table():
        m = row.material
        for value, (low, high) in (
            (m.density_kg_m3, row.density_range_kg_m3),
            (m.youngs_modulus_pa, row.youngs_range_pa),
            (m.poisson_ratio, row.poisson_range),
            (m.loss_factor, row.loss_range),
        ):
            assert low <= value <= high, m.name
        assert row.source


def test_no_name_stands_for_two_rows() -> None:
    names = [name for row in materials.table() for name in (row.material.name, *row.aliases)]
    assert len(names) == len(set(names))


def test_bar_wave_speeds_are_those_of_handbooks() -> None:
    # sqrt(E / rho) [m/s]: CRC Handbook, sound in thin rods.
    for name, speed in {"steel": 5000, "aluminum": 5000, "copper": 3750, "lead": 1210, "glass": 5200}.items():
        m = materials.lookup(name)
        assert math.sqrt(m.youngs_modulus_pa / m.density_kg_m3) == pytest.approx(speed, rel=0.06)


def test_the_table_is_the_published_one() -> None:
    with needed(SHARED / "materials.csv").open(encoding="utf-8") as file:
        published = {row["material"]: row for row in csv.DictReader(file)}
    assert {row.material.name for row in materials.table()} == set(published)
    for row in materials.table():
        assert row.material.density_kg_m3 == float(published[row.material.name]["density_kg_m3"])


def test_constants_are_kept_as_floats() -> None:
    odd = Material("odd", 700, 10**10, 0, np.float32(0.5))
    assert [type(x) for x in (odd.density_kg_m3, odd.youngs_modulus_pa, odd.poisson_ratio, odd.loss_factor)] == [
        float
    ] * 4


@pytest.mark.parametrize(
    ("field", "value", "bound"),
    [
        ("density_kg_m3", -1.0, "above 0"),
        ("density_kg_m3", 0.0, "above 0"),
        ("youngs_modulus_pa", 0.0, "above 0"),
        ("youngs_modulus_pa", math.nan, "finite"),
        ("poisson_ratio", 0.5, "below 0.5"),
        ("poisson_ratio", -1.0, "above -1"),
        ("loss_factor", 2.1, "at most 2"),
        ("loss_factor", -0.1, "at least 0"),
    ],
)
def test_a_constant_out_of_bounds(field: str, value: float, bound: str) -> None:
    good = {"density_kg_m3": 700.0, "youngs_modulus_pa": 1e10, "poisson_ratio": 0.3, "loss_factor": 0.01}
    with pytest.raises(MaterialError, match=f"{field}.*{bound}.*Material 'odd'"):
        Material("odd", **{**good, field: value})
