"""Materials and the sourced table of their constants.

`table.csv` gives nominal value, range and source of each constant for 94 materials of everyday life.
"""

from __future__ import annotations

import csv
from dataclasses import dataclass, fields
from functools import cache
from importlib.resources import files

from scene2hap.common import checks
from scene2hap.common.calls import clear_construction
from scene2hap.common.html_tables import html_table, number
from scene2hap.common.warning import warn_of
from scene2hap.errors import MaterialError, UnknownMaterial

__all__ = ["Material", "MaterialRow", "find_row", "lookup", "lookup_row", "table"]


_USUAL = (("density_kg_m3", "kg/m3", "g/cm3", 10.0), ("youngs_modulus_pa", "Pa", "GPa or MPa", 1e3))
"""The unit in which each constant is often given by mistake; all solids but aerogels and slime exceed the number."""


@clear_construction
@dataclass(frozen=True)
class Material:
    """Elastic constants of an isotropic solid.

    Parameters: density_kg_m3 > 0; youngs_modulus_pa > 0; -1 < poisson_ratio < 0.5 (both bounds make a plate's
        stiffness or the bulk modulus infinite); loss_factor 0..2 [-], twice the damping ratio.
    Raises: MaterialError: a constant is outside its bound.
    Warns: SceneWarning: a constant is probably in another unit.
    """

    name: str
    density_kg_m3: float
    youngs_modulus_pa: float
    poisson_ratio: float
    loss_factor: float = 0.01

    def __post_init__(self) -> None:
        if not isinstance(self.name, str):
            raise MaterialError(
                f"name is {checks.represented(self.name)}; it must be a text. Say what the material is called."
            )
        hint = f"Material {self.name!r}; `materials.lookup` knows usual values."

        def bound(field: str, unit: str, **bounds: float) -> None:
            value = checks.number(field, getattr(self, field), unit, error=MaterialError, hint=hint, **bounds)
            object.__setattr__(self, field, value)

        bound("density_kg_m3", "kg/m3", above=0.0)
        bound("youngs_modulus_pa", "Pa", above=0.0)
        bound("poisson_ratio", "-", above=-1.0, below=0.5)
        bound("loss_factor", "-", at_least=0.0, at_most=2.0)
        for field, unit, other, usual in _USUAL:
            if getattr(self, field) < usual:
                warn_of(
                    f"{field} of {self.name!r} is {getattr(self, field):g} {unit}, less than solids have, {usual:g} "
                    f"{unit}; is it in {other}? Give it in {unit}."
                )

    def _repr_html_(self) -> str:
        rows = (
            ("density [kg/m3]", number(self.density_kg_m3, 4)),
            ("Young's modulus [GPa]", number(self.youngs_modulus_pa / 1e9)),
            ("Poisson's ratio [-]", number(self.poisson_ratio)),
            ("loss factor [-]", number(self.loss_factor)),
        )
        return html_table(f"Material {self.name}", ("constant", "value"), rows, len(rows))


@dataclass(frozen=True)
class MaterialRow:
    """A row of the table: nominal constants, the range that sources give for each, and the sources."""

    material: Material
    aliases: tuple[str, ...]
    density_range_kg_m3: tuple[float, float]
    youngs_range_pa: tuple[float, float]
    poisson_range: tuple[float, float]
    loss_range: tuple[float, float]
    source: str


def lookup(name: str) -> Material:
    """Return the nominal constants of a material by name or alias, upper or lower case.

    Raises: UnknownMaterial: no row has that name; the message names the nearest.
    """
    return lookup_row(name).material


def lookup_row(name: str) -> MaterialRow:
    """Return the row of a material, with ranges and sources. Raises: UnknownMaterial, as `lookup`."""
    row = find_row(checks.text("name", name, error=UnknownMaterial))
    if row is None:
        near = checks.did_you_mean(_key(name), _by_name())
        raise UnknownMaterial(
            f"no material {name!r} in the table of {len(table())}. {near} Or give a Material of your own: "
            f"{', '.join(field.name for field in fields(Material))}."
        )
    return row


def find_row(name: str) -> MaterialRow | None:
    """Return the row of a material, None if no row has that name; a search for similar names would take 7 ms."""
    return _by_name().get(_key(name))


@cache
def table() -> tuple[MaterialRow, ...]:
    """Return every row, in the order of the file."""
    text = files(__package__).joinpath("table.csv").read_text(encoding="utf-8")
    return tuple(_row(fields) for fields in csv.DictReader(text.splitlines()))


@cache
def _by_name() -> dict[str, MaterialRow]:
    return {_key(name): row for row in table() for name in (row.material.name, *row.aliases)}


def _key(name: str) -> str:
    return " ".join(name.lower().replace("_", " ").replace("-", " ").split())


def _row(fields: dict[str, str]) -> MaterialRow:
    def span(name: str) -> tuple[float, float]:
        return float(fields[f"{name}_lo"]), float(fields[f"{name}_hi"])

    return MaterialRow(
        Material(
            fields["material"],
            float(fields["density_kg_m3"]),
            float(fields["youngs_modulus_pa"]),
            float(fields["poisson_ratio"]),
            float(fields["loss_factor"]),
        ),
        tuple(alias for alias in fields["aliases"].split(";") if alias),
        span("density"),
        span("youngs"),
        span("poisson"),
        span("loss"),
        fields["source"],
    )
